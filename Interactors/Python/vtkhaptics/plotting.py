"""Lets people touch what a plot shows: ``enable(plotter)`` for PyVista, or for plain VTK."""

from . import vtkHapticScene, vtkInteractorStyleHaptic, vtkMouseHapticDevice
from .errors import HapticsError
from .interrupt import EXIT_INTERRUPTED, Interrupts, is_interactive


class Touch:
    """What enable() has set up; keep it as long as it is used.

    `scene` is the vtkHapticScene, `style` the interactor style, `device` the haptic device.
    """

    def __init__(self, scene, style, device, plotter):
        self.scene, self.style, self.device = scene, style, device
        self._plotter = plotter
        interactor, self._renderer = _view_of(plotter)
        self._style_before = interactor.GetInteractorStyle()
        self._interrupts = Interrupts()
        self._take_interrupts(interactor)

    def add(self, prop):
        """Makes an actor or an assembly touchable too; the id of the surface."""
        return _add(self.scene, prop)

    def _take_interrupts(self, interactor):
        """Lets Ctrl-C end the event loop, whoever starts it, and after that the program."""
        self._interrupts.__enter__()
        start = interactor.Start

        def run():
            try:
                self._interrupts.run(interactor, start)
            except KeyboardInterrupt:
                if is_interactive():
                    raise
                raise SystemExit(EXIT_INTERRUPTED) from None

        interactor.Start = run

    def _leave_interrupts(self, interactor):
        interactor.__dict__.pop("Start", None)
        self._interrupts.__exit__()

    def disable(self):
        """Lets go: no force, the plot as it was before, and nothing is updated any more."""
        self.scene.Release()
        self.scene.RemoveAllSurfaces()
        view = self.style.GetView()
        for prop in (view.GetGodObjectActor(), view.GetOverlay()):
            self._renderer.RemoveViewProp(prop)
        self.device.ConnectView(None, None)
        interactor, _ = _view_of(self._plotter)
        self._leave_interrupts(interactor)
        if interactor.GetInteractorStyle() is self.style:
            _set_style(self._plotter, self._style_before)


def enable(plotter, device=None, stiffness=500.0, overlay=True):
    """Makes all that a plotter shows touchable, by the mouse or by another device.

    `plotter` is a pyvista.Plotter, or a vtkRenderWindowInteractor with a window. The surfaces are
    the visible, pickable actors with polydata, and assemblies; what comes later is added with
    ``touch.add(actor)``. `stiffness` in N/m. Returns a Touch, whose `scene` is the
    vtkHapticScene. Raises TypeError for anything that is no plotter, and ValueError where there is
    nothing to touch or the device does not open.
    """
    _, renderer = _view_of(plotter)
    scene = vtkHapticScene()
    scene.SetStiffness(stiffness)
    for prop in renderer.GetViewProps():
        if prop.GetVisibility() and prop.GetPickable() and _can_be_touched(prop):
            _add(scene, prop)
    scene.Update()
    device = device or vtkMouseHapticDevice()
    scene.SetDevice(device)
    try:
        scene.FitWorkspace(renderer.GetActiveCamera())
    except HapticsError as error:
        raise ValueError(error.text) from error
    style = vtkInteractorStyleHaptic()
    style.SetScene(scene)
    touch = Touch(scene, style, device, plotter)
    try:
        scene.Engage()
    except HapticsError as error:
        raise ValueError(error.text) from error
    renderer.AddViewProp(style.GetView().GetGodObjectActor())
    if overlay:
        renderer.AddViewProp(style.GetView().GetOverlay())
    _set_style(plotter, style)
    return touch


def _view_of(plotter):
    """The interactor and the renderer of a plotter. Raises TypeError."""
    interactor = getattr(plotter, "iren", plotter)
    interactor = getattr(interactor, "interactor", interactor)
    if not hasattr(interactor, "GetRenderWindow") or not interactor.GetRenderWindow():
        raise TypeError(
            f"{plotter!r} is no plotter with an interactor. Give a pyvista.Plotter or a "
            "vtkRenderWindowInteractor whose render window is set."
        )
    return interactor, interactor.GetRenderWindow().GetRenderers().GetFirstRenderer()


def _set_style(plotter, style):
    # PyVista remembers a style of its own, and would put it back when the plot is shown.
    if hasattr(getattr(plotter, "iren", None), "_style_class"):
        plotter.iren._style_class = style
    _view_of(plotter)[0].SetInteractorStyle(style)


def _add(scene, prop):
    # Not AddSurface(): see vtkHapticScene::AddSurfaceActor().
    return scene.AddSurfaceActor(prop) if prop.IsA("vtkActor") else scene.AddSurface(prop)


def _can_be_touched(prop):
    if prop.IsA("vtkAssembly"):
        return True
    # PyVista draws polydata by a vtkDataSetMapper: what the mapper gets decides, not what it is.
    mapper = prop.GetMapper() if prop.IsA("vtkActor") else None
    if not mapper or not mapper.GetNumberOfInputConnections(0):
        return False
    mapper.GetInputAlgorithm().Update()
    data = mapper.GetInputDataObject(0, 0)
    return bool(data) and data.IsA("vtkPolyData")
