"""Makes what a plot shows touchable: ``enable(plotter)`` for PyVista, or for plain VTK."""

from vtkmodules.vtkCommonDataModel import vtkPlaneCollection
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkDataSetSurfaceFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

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
        self._surfaces = {}  # by prop: the id of its surface, and the actor in its place or None
        # The props as they come and go, and before each picture what has changed of them.
        self._observers = [
            (source, source.AddObserver(event, lambda *_: self.follow()))
            for source, event in (
                (self._renderer.GetViewProps(), "ModifiedEvent"), (self._renderer, "StartEvent"))
        ]
        # PyVista up to 0.45 calls this on its style when the plot is closed.
        self.style.remove_observers = self.scene.Release
        interactor._vtkhaptics_touch = self

    def add(self, prop):
        """Makes an actor or an assembly touchable, which is followed; the id of the surface. An
        actor that shows no polydata is touched by the outside of what it shows."""
        if prop not in self._surfaces:
            stand_in = getattr(prop, "_vtkhaptics_touched", None)
            if not stand_in and not _shows_polydata(prop):
                stand_in = _outside_actor(prop)
            id_ = _add(self.scene, stand_in or prop)
            self._surfaces[prop] = (id_, stand_in)
        return self._surfaces[prop][0]

    def _name(self, id_, prop):
        name = _name_of(prop, self._renderer)
        # Parts of an assembly have ids of their own.
        if name and prop.IsA("vtkActor") and name != self.scene.GetSurfaces().GetName(id_):
            self.scene.GetSurfaces().SetName(id_, name)

    def follow(self):
        """Takes in what the plot shows now, and only that: each picture calls it."""
        shown = [prop for prop in self._renderer.GetViewProps() if _can_be_touched(prop)]
        new = [
            prop for prop in shown
            if prop not in self._surfaces and prop.GetVisibility() and prop.GetPickable()
        ]
        looks = self._looks_of_widgets() if new else []
        for prop in new:
            if not (prop.IsA("vtkActor") and any(prop.GetProperty() is look for look in looks)):
                self.add(prop)
        present = set(shown)
        for prop in [prop for prop in self._surfaces if prop not in present]:
            id_, _ = self._surfaces.pop(prop)
            self.scene.RemoveSurface(id_)
        for prop, (id_, stand_in) in self._surfaces.items():
            self._name(id_, prop)  # a plot names an actor after it has taken it in
            if stand_in:
                stand_in.SetVisibility(prop.GetVisibility())
                stand_in.SetPickable(prop.GetPickable())
                _clip_alike(stand_in, prop)

    def _looks_of_widgets(self):
        """What the actors look like that are parts of PyVista's widgets: as their widget says."""
        owner = getattr(self._plotter, "widgets", self._plotter)  # from PyVista 0.48 on
        return [
            getattr(widget, name)()
            for attribute, widgets in vars(owner).items()
            if attribute.endswith("_widgets") and isinstance(widgets, list)
            for widget in widgets
            for name in dir(widget)
            if name.startswith("Get") and name.endswith("Property")
        ]

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
        for source, observer in self._observers:
            source.RemoveObserver(observer)
        self.scene.Release()
        self.scene.RemoveAllSurfaces()
        self._surfaces.clear()
        view = self.style.GetView()
        for prop in (view.GetGodObjectActor(), view.GetOverlay()):
            self._renderer.RemoveViewProp(prop)
        self.device.ConnectView(None, None)
        interactor, _ = _view_of(self._plotter)
        interactor.__dict__.pop("_vtkhaptics_touch", None)
        self._leave_interrupts(interactor)
        if interactor.GetInteractorStyle() is self.style:
            _set_style(self._plotter, self._style_before)


def enable(plotter, device=None, stiffness=500.0, overlay=True):
    """Makes all that a plotter shows touchable, by the mouse or by another device.

    `plotter` is a pyvista.Plotter, or a vtkRenderWindowInteractor with a window. The surfaces are
    what its visible, pickable actors and assemblies show, of volume meshes the outside; what comes,
    goes or is replaced later is followed at each picture. PyVista's
    widgets are left alone. Names that the plot gives them are those of
    messages, read-out and traces. Of several subplots the active one is touched; over the others the
    mouse's hand waits. `stiffness` in N/m. Returns a Touch, whose `scene` is the vtkHapticScene. Raises
    TypeError for anything that is no plotter, and ValueError where there is nothing to touch, the
    device does not open, or the plot is touched already.
    """
    interactor, renderer = _view_of(plotter)
    if getattr(interactor, "_vtkhaptics_touch", None):
        raise ValueError("the plot is touched already. Call disable() of that touch first.")
    scene = vtkHapticScene()
    scene.SetStiffness(stiffness)
    device = device or vtkMouseHapticDevice()
    if isinstance(device, vtkMouseHapticDevice):
        device.SetRenderer(renderer)
    scene.SetDevice(device)
    style = vtkInteractorStyleHaptic()
    style.SetScene(scene)
    touch = Touch(scene, style, device, plotter)
    touch.follow()
    try:
        scene.Update()
        scene.FitWorkspace(renderer.GetActiveCamera())
        scene.Engage()
    except HapticsError as error:
        touch.disable()
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
    if not (
        hasattr(interactor, "IsA")
        and interactor.IsA("vtkRenderWindowInteractor")
        and interactor.GetRenderWindow()
    ):
        raise TypeError(
            f"{plotter!r} is no plotter with an interactor. Give a pyvista.Plotter or a "
            "vtkRenderWindowInteractor whose render window is set."
        )
    renderers = interactor.GetRenderWindow().GetRenderers()
    active = getattr(plotter, "renderer", None)  # of PyVista's subplots
    if active is not None and renderers.IsItemPresent(active):
        return interactor, active
    return interactor, renderers.GetFirstRenderer()


def _name_of(prop, renderer):
    """What a plot calls an actor: the name of PyVista's ``add_mesh(name=...)``, or VTK's from 9.3
    on; empty where nobody has given it one."""
    actors = getattr(renderer, "actors", None)
    # From VTK 9.4 on a renderer of VTK's own has a vtkActorCollection of that name.
    for name, actor in actors.items() if hasattr(actors, "items") else ():
        # PyVista makes one of the address where it is given none.
        if actor is prop and "Addr=" not in str(name):
            return str(name)
    return prop.GetObjectName() or "" if hasattr(prop, "GetObjectName") else ""


def _set_style(plotter, style):
    # PyVista remembers a style of its own, and would put it back when the plot is shown.
    if hasattr(getattr(plotter, "iren", None), "_style_class"):
        plotter.iren._style_class = style
    _view_of(plotter)[0].SetInteractorStyle(style)


def _add(scene, prop):
    # Not AddSurface(): see vtkHapticScene::AddSurfaceActor().
    return scene.AddSurfaceActor(prop) if prop.IsA("vtkActor") else scene.AddSurface(prop)


def _data_of(prop):
    # PyVista draws polydata by a vtkDataSetMapper: what the mapper gets decides, not what it is.
    mapper = prop.GetMapper() if prop.IsA("vtkActor") else None
    if not mapper or not mapper.GetNumberOfInputConnections(0):
        return None
    mapper.GetInputAlgorithm().Update()
    return mapper.GetInputDataObject(0, 0)


def _shows_polydata(prop):
    data = _data_of(prop)
    return prop.IsA("vtkAssembly") or bool(data and data.IsA("vtkPolyData"))


def _can_be_touched(prop):
    if prop.IsA("vtkAssembly"):
        return True
    data = _data_of(prop)
    if not data or not data.IsA("vtkDataSet"):
        return bool(data) and data.IsA("vtkCompositeDataSet")
    if data.IsA("vtkPolyData"):  # points and lines have no surface
        return data.GetNumberOfPolys() + data.GetNumberOfStrips() > 0
    return data.GetNumberOfCells() > 0


def _outside_actor(actor):
    """An actor of the outside of what another one shows, at its place."""
    mapper = actor.GetMapper()
    outside = vtkDataSetSurfaceFilter()
    if _data_of(actor).IsA("vtkCompositeDataSet"):
        outside = vtkCompositeDataGeometryFilter()
    outside.SetInputConnection(mapper.GetInputConnection(0, 0))
    touched = vtkPolyDataMapper()
    touched.SetInputConnection(outside.GetOutputPort())
    stand_in = vtkActor()
    stand_in.SetMapper(touched)
    stand_in.SetUserMatrix(actor.GetMatrix())
    _clip_alike(stand_in, actor)
    return stand_in


def _clip_alike(stand_in, actor):
    planes = actor.GetMapper().GetClippingPlanes()
    stand_in.GetMapper().SetClippingPlanes(vtkPlaneCollection() if planes is None else planes)
