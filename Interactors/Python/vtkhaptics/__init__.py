"""Feel the surface of any vtkPolyData with a haptic device.

Every class of the VTK Haptics modules is here: ``from vtkhaptics import vtkGodObjectFilter``.
``python3 -m vtkhaptics.demo --help`` tells how to touch a surface from the command line.
"""

try:
    # vtkGodObjectActor is made of actors, which only exist with a rendering back end.
    import vtkmodules.vtkRenderingFreeType
    import vtkmodules.vtkRenderingOpenGL2

    from .vtkHapticsFilters import *
    from .vtkHapticsDevices import *
    from .vtkHapticsInteractors import *
except ImportError as error:
    raise ImportError(
        "vtkhaptics: a compiled module could not be loaded (" + str(error) + "). "
        "Source the env.sh of the build folder first, for example `. build/env.sh`, and run the "
        "Python that the VTK or ParaView packages were made for, on Debian /usr/bin/python3."
    ) from error

from .plotting import enable
