"""Lets people touch what a plot shows: ``enable(plotter)`` for PyVista, or for plain VTK."""

from . import vtkHapticScene, vtkInteractorStyleHaptic, vtkMouseHapticDevice


class Touch:
    """What enable() has set up; keep it as long as it is used.

    `scene` is the vtkHapticScene, `style` the interactor style, `device` the haptic device.
    """

    def __init__(self, scene, style, device, interactor, renderer):
        self.scene, self.style, self.device = scene, style, device
        self._interactor, self._renderer = interactor, renderer
        self._style_before = interactor.GetInteractorStyle()

    def disable(self):
        """Lets go: no force, the plot as it was before, and nothing is updated any more."""
        self.scene.Release()
        self.scene.RemoveAllSurfaces()
        for prop in (self.scene.GetGodObjectActor(), self.scene.GetOverlay()):
            self._renderer.RemoveViewProp(prop)
        if self._interactor.GetInteractorStyle() is self.style:
            self._interactor.SetInteractorStyle(self._style_before)


def enable(plotter, device=None, stiffness=500.0, overlay=True):
    """Makes all that a plotter shows touchable, by the mouse or by another device.

    `plotter` is a pyvista.Plotter, or a vtkRenderWindowInteractor with a window. The surfaces are
    the visible, pickable actors with polydata, and assemblies; what is added later is added with
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
    for prop in renderer.GetViewProps():
        if prop.GetVisibility() and prop.GetPickable() and _can_be_touched(prop):
            scene.AddSurface(prop)
    scene.Update()
    device = device or vtkMouseHapticDevice()
    scene.SetDevice(device)
    if not scene.FitWorkspace(renderer.GetActiveCamera()):
        raise ValueError(scene.GetErrorMessage())
    style = vtkInteractorStyleHaptic()
    style.SetScene(scene)
    touch = Touch(scene, style, device, interactor, renderer)
    if not scene.Engage():
        raise ValueError(scene.GetErrorMessage())
    renderer.AddViewProp(scene.GetGodObjectActor())
    if overlay:
        renderer.AddViewProp(scene.GetOverlay())
    interactor.SetInteractorStyle(style)
    return touch


def _can_be_touched(prop):
    if prop.IsA("vtkActor"):
        return bool(prop.GetMapper()) and prop.GetMapper().IsA("vtkPolyDataMapper")
    return prop.IsA("vtkAssembly")
