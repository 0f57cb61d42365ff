"""Touch the surface of any vtkPolyData with a haptic device.

Where to begin
--------------
A path over a surface, without a device, in three lines::

    import vtkhaptics
    t = vtkhaptics.trace("part.stl", path, scale=0.001)   # path: (n, 3), one position a millisecond
    t.force                                               # (n, 3) [N]; t.to_dataframe(), t.to_csv()

A surface is a file, a vtkPolyData, a PyVista mesh, an object with vertices and faces (trimesh), or
a tuple (vertices, faces). With a mouse, in a window::

    vtkhaptics.touch("part.stl")                          # or any other surface
    vtkhaptics.enable(plotter)                            # what a PyVista or VTK plot shows

In a notebook, or without a display::

    vtkhaptics.picture_of("part.stl", t)                  # drawn inline; .save("part.png")

With a device, a thousand times a second::

    scene = vtkhaptics.vtkHapticScene()
    scene.SetDevice(vtkhaptics.vtkSimulatedHapticDevice())
    scene.AddSurface(vtkhaptics.polydata("part.stl"))
    with scene.engaged():
        ...

What fails raises HapticsError. Lengths of surfaces are in their own unit, what concerns the hand is
in metres, newtons and seconds. ``help(vtkhaptics.trace)``, ``help(vtkhaptics.vtkHapticScene)`` and
so on have the details; ``python3 -m vtkhaptics --help`` is the viewer.
"""

try:
    from .interrupt import held_back

    with held_back():
        # vtkGodObjectActor is made of actors, which only exist with a rendering back end.
        import vtkmodules.vtkRenderingFreeType
        import vtkmodules.vtkRenderingOpenGL2

        from . import vtkHapticsDevices, vtkHapticsFilters, vtkHapticsScene, vtkHapticsView
except ImportError as error:
    import glob
    import os

    if glob.glob(os.path.join(os.path.dirname(__file__), "lib", "libvtkHaptics*.so")):  # made by pip
        from ._version import vtk_version

        series = vtk_version.rpartition(".")[0]
        try:
            from vtkmodules.vtkCommonCore import vtkVersion

            found = f"VTK {vtkVersion.GetVTKVersion()}"
        except ImportError:
            found = "no VTK"
        remedy = (
            f"It was made for VTK {series}, and this Python has {found}. Install that VTK "
            f"(python3 -m pip install 'vtk=={series}.*'), or install vtkhaptics again with the pip of "
            "the Python that runs, and where that imports vtkmodules."
        )
    else:
        remedy = (
            "Source the env.sh of the build folder first, for example `. build/env.sh`, and run the "
            "Python that the VTK or ParaView packages were made for, on Debian /usr/bin/python3."
        )
    raise ImportError(
        f"vtkhaptics: a compiled module could not be loaded ({error}). {remedy}"
    ) from error

with held_back():
    from ._version import __version__
    from .classes import CLASSES
    from .errors import HapticsError, HapticsWarning

    globals().update(CLASSES)

    from .device import HapticDevice, share
    from .devices import create_device, known_devices, list_devices
    from .inline import picture_of
    from .meshes import polydata
    from .plotting import enable
    from .sharing import SharedHand
    from .touching import touch
    from .tracing import Trace, trace

__all__ = [
    "HapticDevice",
    "HapticsError",
    "HapticsWarning",
    "SharedHand",
    "Trace",
    "create_device",
    "enable",
    "known_devices",
    "list_devices",
    "picture_of",
    "polydata",
    "share",
    "touch",
    "trace",
    *CLASSES,
]
