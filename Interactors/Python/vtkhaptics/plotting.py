"""Lets people touch what a plot shows: ``enable(plotter)`` for PyVista, or for plain VTK."""

from . import vtkHapticScene, vtkInteractorStyleHaptic, vtkMouseHapticDevice


class Touch:
    """What enable() has set up; keep it as long as it is used."""

    def __init__(self, scene, style, device):
        self.scene, self.style, self.device = scene, style, device

    def disable(self):
        """Lets go: no force, and nothing is updated any more."""
        self.scene.Release()
        self.scene.RemoveAllSurfaces()


def enable(plotter, device=None, stiffness=500.0, overlay=True):
    """Makes every actor that a plotter shows touchable, by the mouse or by another device.

    `plotter` is a pyvista.Plotter, or a vtkRenderWindowInteractor with a window. The surfaces are
    the visible, pickable actors with polydata; what is added later is added with
    ``touch.scene.AddSurface(actor)``. `stiffness` in N/m. Returns a Touch, whose `scene` is the
    vtkHapticScene. Raises TypeError for anything that is no plotter, and ValueError where there is
    nothing to touch or the device does not open.
    """
    interactor = getattr(plotter, "iren", plotter)
    interactor = getattr(interactor, "interactor", interactor)
    if not hasattr(interactor, "GetRenderWindow") or not interactor.GetRenderWindow():
        raise TypeError(
            f"{plotter!r} is no plotter with an interactor. Give a pyvista.Plotter or a "
            "vtkRenderWindowInteractor whose render window is set."
        )
    renderer = interactor.GetRenderWindow().GetRenderers().GetFirstRenderer()
    scene = vtkHapticScene()
    scene.SetStiffness(stiffness)
    for actor in renderer.GetActors():
        mapper = actor.GetMapper()
        if actor.GetVisibility() and actor.GetPickable() and mapper and mapper.IsA("vtkPolyDataMapper"):
            scene.AddSurface(actor)
    scene.Update()
    device = device or vtkMouseHapticDevice()
    scene.SetDevice(device)
    if not scene.FitWorkspace(renderer.GetActiveCamera()):
        raise ValueError(scene.GetErrorMessage())
    renderer.AddViewProp(scene.GetGodObjectActor())
    if overlay:
        renderer.AddViewProp(scene.GetOverlay())
    style = vtkInteractorStyleHaptic()
    style.SetScene(scene)
    interactor.SetInteractorStyle(style)
    if not scene.Engage():
        raise ValueError(scene.GetErrorMessage())
    return Touch(scene, style, device)
