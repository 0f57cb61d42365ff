"""Opens a window with surfaces of a program's own, to touch them."""

import os
from typing import Any, Optional

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor

from .errors import HapticsError
from .meshes import polydata
from .plotting import enable
from .tracing import Trace


def touch(
    *surfaces: Any,
    device: Any = None,
    stiffness: float = 500.0,
    scalars: Optional[str] = None,
    size: tuple[int, int] = (1200, 800),
) -> Trace:
    """Opens a window with surfaces to touch, by the mouse or by another device, until it is closed.

    Parameters
    ----------
    surfaces
        What :func:`vtkhaptics.polydata` takes, each: a file, a vtkPolyData, a PyVista mesh, an
        object with vertices and faces, ``(vertices, faces)``.
    device : vtkHapticDevice, optional
        Default: the mouse. The space bar held presses, the wheel sets how deep, ? lists the keys.
    stiffness : float
        Of the surfaces in the hand [N/m].
    scalars : str, optional
        The array to colour by. Default: the active one, or the first with one value a point or
        cell; "none" for no colours.
    size : (int, int)
        Of the window [pixel].

    Returns
    -------
    Trace
        The trace.

    Raises what :func:`vtkhaptics.polydata` and :func:`vtkhaptics.enable` do, ValueError for a surface
    without polygons or with cells of points that are not there, and HapticsError where there is no display. For files alone ``python3 -m vtkhaptics FILE`` does more.
    """
    from .coloring import color_by, scalar_bar
    from .display import needs_display
    from .picture import BACKGROUND, add_lights, fill_view, surface_actor, touched_actor

    if not surfaces:
        raise TypeError("touch() needs at least one surface.")
    shown = [polydata(surface) for surface in surfaces]
    actors = []
    for index, surface in enumerate(shown):
        if not surface.GetNumberOfPolys() + surface.GetNumberOfStrips() or not surface.GetNumberOfPoints():
            raise ValueError(
                f"surface {index} has no polygons, hence nothing to touch "
                f"({surface.GetNumberOfPoints()} points, {surface.GetNumberOfLines()} lines)."
            )
        try:
            actors.append(surface_actor(surface))
        except ValueError as error:
            raise ValueError(f"surface {index}: {error}") from error
    if needs_display():
        raise HapticsError(
            "there is no display to open a window on (DISPLAY is not set). Run it from a desktop or "
            "under xvfb-run; vtkhaptics.trace() needs none."
        )
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(*BACKGROUND[0])
    renderer.SetBackground2(*BACKGROUND[1])
    renderer.GradientBackgroundOn()
    add_lights(renderer)
    for surface, actor in zip(shown, actors):
        renderer.AddActor(actor)
        actor._vtkhaptics_touched = touched_actor(surface, actor)
        name, table = (None, None) if scalars == "none" else color_by(actor, surface, scalars)
        if table and surface is shown[0]:
            renderer.AddViewProp(scalar_bar(table, name, size))
    points = np.concatenate([vtk_to_numpy(surface.GetPoints().GetData()) for surface in shown])
    fill_view(
        renderer.GetActiveCamera(), points, (0.45, -0.75, 0.5), (0.0, 0.0, 1.0),
        size[0] / size[1], margin=1.3,
    )
    window.SetSize(*size)
    window.SetMultiSamples(8)
    window.SetWindowName("VTK Haptics - ? lists the keys")
    window.AddRenderer(renderer)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.Initialize()
    window.Render()
    hand = enable(interactor, device, stiffness)
    for given, actor in zip(surfaces, actors):
        if isinstance(given, (str, os.PathLike)):
            hand.scene.GetSurfaces().SetName(hand.add(actor), os.path.basename(os.fspath(given)))
    hand.scene.StartRecording()
    interactor.Start()
    hand.scene.StopRecording()
    hand.disable()
    window.Finalize()
    return Trace(hand.scene.GetTrace())
