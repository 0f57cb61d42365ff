"""Touch what ParaView shows, from pvpython and from ParaView's Python shell.

    from paraview.simple import *
    from vtkhaptics.paraview import touch

    hand = touch(Sphere(), Device="simulated")
    hand.step(1500)                     # ticks of 1 ms in virtual time; hand.engage() in real time
    print(hand.ForceMagnitude, "N at", hand.GodObject)

``hand`` is the scene of the session: every property of the proxy (haptics, HapticScene) is an
attribute of it. Its servo runs on the client, also where the data are on a server.
"""

import functools
import glob
import math
import os
import time

from paraview import servermanager, simple

from . import vtkHapticScene  # noqa: F401  (lets the wrappers know the class)

__all__ = ["HapticsError", "Scene", "load_plugin", "scene", "touch"]


class HapticsError(Exception):
    """What went wrong and what to do, for people."""


def load_plugin(path=None, names=None):
    """Loads the plugin Haptics, on the server too where there is one, unless it is loaded.

    path: the plugin's file; by default the one that was built or installed with this package.
    names: where the functions for the new filters are put, by default paraview.simple.
    """
    definitions = servermanager.ProxyManager().GetProxyDefinitionManager()
    if definitions.HasDefinition("haptics", "HapticScene"):
        return
    path = path or _find_plugin()
    if servermanager.ActiveConnection.IsRemote():
        simple.LoadPlugin(path, remote=True)
    simple.LoadPlugin(path, remote=False, ns=vars(simple) if names is None else names)
    if not definitions.HasDefinition("haptics", "HapticScene"):
        raise HapticsError(f"{path}: ParaView could not load this plugin. Its messages tell why.")


def _find_plugin():
    manager = servermanager.vtkSMProxyManager
    version = f"paraview-{manager.GetVersionMajor()}.{manager.GetVersionMinor()}"
    folder = os.path.dirname(os.path.abspath(__file__))
    while folder != os.path.dirname(folder):
        found = glob.glob(os.path.join(folder, version, "plugins", "Haptics", "Haptics.*"))
        if found:
            return found[0]
        folder = os.path.dirname(folder)
    raise HapticsError(
        f"There is no plugin Haptics for {version} beside this package. Give load_plugin() its path."
    )


class Scene:
    """A haptic scene of ParaView. The proxy's properties are its attributes."""

    def __init__(self, proxy):
        """A haptic scene of ParaView. The proxy's properties are its attributes."""
        object.__setattr__(self, "proxy", proxy)

    def __getattr__(self, name):
        prop = self.proxy.SMProxy.GetProperty(name)
        if not prop:
            raise AttributeError(f"a haptic scene has no {name}")
        if name == "WorkspaceTransform":
            self.proxy.SMProxy.UpdatePropertyInformation()  # fitting and the clutch change it
        elif prop.GetInformationOnly():
            self.proxy.SMProxy.UpdatePropertyInformation(prop)
        return getattr(self.proxy, name)

    def __setattr__(self, name, value):
        self.set(**{name: value})

    def __dir__(self):
        return sorted(set(super().__dir__()) | set(self.proxy.ListProperties()))

    def set(self, **properties):
        """Sets properties, for example set(Stiffness=800, Device="simulated").

        Raises ValueError for a number that is out of range, HapticsError for what is no device.
        """
        for name, value in properties.items():
            prop = self.proxy.SMProxy.GetProperty(name)
            if not prop:
                raise AttributeError(f"a haptic scene has no {name}; it has {_names(self.proxy)}")
            if name == "Device":
                _check_device(value)
            _check_range(name, prop, value)
            setattr(self.proxy, name, value)

    @property
    def vtk(self):
        """The vtkHapticScene, for events, probes, the servo's statistics."""
        # Known to Python only once its module is there, which needs the plugin's library.
        from . import vtkHapticsRepresentations  # noqa: F401

        return self.proxy.GetClientSideObject().GetScene()

    @property
    def picture(self):
        """The vtkHapticView: how the hand and its force are drawn."""
        from . import vtkHapticsRepresentations  # noqa: F401

        return self.proxy.GetClientSideObject().GetPicture()

    def touch(self, source=None, view=None):
        """Makes a source (by default the active one) touchable, however it is drawn; adds it to the scene."""
        source = source or simple.GetActiveSource()
        if not source:
            raise HapticsError("There is no source to touch. Give one, or make one active.")
        if not hasattr(source, "SMProxy"):
            raise HapticsError(
                f"{source!r} is no source of ParaView. Give what a function of paraview.simple has "
                f"made, or FindSource(NAME); there are {sorted(n for n, _ in simple.GetSources())}."
            )
        view = view or self.View or simple.GetActiveViewOrCreate("RenderView")
        if not view.SMProxy.IsA("vtkSMRenderViewProxy"):
            raise HapticsError(
                f"A view of the kind {view.GetXMLLabel()} cannot be touched. Give a render view."
            )
        try:
            display = simple.Show(source, view)
        except RuntimeError as error:
            raise HapticsError(f"{source.GetXMLLabel()} cannot be shown: {error}") from error
        _make_touchable(display)
        if self.View != view:
            self.set(View=view, Surfaces=[])
        if display not in self.Surfaces:
            self.set(Surfaces=list(self.Surfaces) + [display])
        _bring(view)
        return display

    def touch_only(self, *displays):
        """Touches these representations, of one view, and nothing else."""
        for display in displays:
            _make_touchable(display)
        view = simple.LocateView(displays[0]) if displays else None
        if view and self.View != view:
            self.set(View=view)
        self.set(Surfaces=list(displays))
        if view:
            _bring(view)

    def engage(self):
        """Starts the servo in real time. Raises HapticsError where it cannot.

        A device that takes its time to open (State tells) is engaged by an update() when it is
        ready.
        """
        self.proxy.Engaged = 0  # what was asked for before may have come to an end by itself
        self.proxy.Engaged = 1
        while self.Building and not self.EngagedInfo:
            time.sleep(0.005)
            self.update()
        if self.Message and not self.EngagedInfo:
            raise HapticsError(self.Message)

    def release(self):
        """Stops the servo: zero force."""
        self.proxy.Engaged = 0

    def update(self):
        """Takes in what the servo did; call it about as often as the view is rendered."""
        self.proxy.InvokeCommand("Update")

    def step(self, ticks):
        """Runs ticks in virtual time, as fast as they come. Raises HapticsError.

        Needs no picture, hence no display, but with several processes, where renders bring the
        surfaces to the client.
        """
        if self.View and not _needs_render():
            _bring(self.View)  # what has changed upstream, or come with a state
        # Not proxy.Step = ticks, which does nothing when it is the same number again.
        self.proxy.SMProxy.GetProperty("Step").SetElement(0, ticks)
        self.proxy.SMProxy.UpdateProperty("Step", 1)
        self.proxy.SMProxy.UpdateVTKObjects()
        if self.Message:
            raise HapticsError(self.Message)

    def fit(self):
        """Maps what the device reaches to the surfaces, as the view sees them."""
        self.proxy.InvokeCommand("Fit")
        if not any(self.WorkspaceTransform):
            raise HapticsError(self.Message)

    def drop_landmark(self):
        """Marks where the hand touches."""
        before = self.NumberOfLandmarks
        self.proxy.InvokeCommand("DropLandmark")
        if self.NumberOfLandmarks == before:
            raise HapticsError(self.Message)

    def trace(self):
        """What was felt while RecordTrace was on, as vtkPolyData; see vtkHapticScene::GetTrace()."""
        return self.vtk.GetTrace()

    def landmarks(self):
        """The landmarks as vtkPolyData."""
        return self.vtk.GetLandmarks().GetOutput()

    def trace_source(self, name="HapticTrace"):
        """The trace as a new source of the pipeline."""
        return _source(self.trace(), name)

    def curve_source(self, name="HapticCurves"):
        """The strokes of the trace that touched as a new source: a curve each, with the arrays along it."""
        from vtkmodules.vtkCommonDataModel import vtkPolyData

        from .vtkHapticsRepresentations import vtkHapticRecordSource

        curves = vtkPolyData()
        vtkHapticRecordSource.MakeCurves(self.trace(), 0, curves)
        return _source(curves, name)

    def landmark_source(self, name="HapticLandmarks"):
        """The landmarks as a new source of the pipeline."""
        return _source(self.landmarks(), name)


def _names(proxy):
    return ", ".join(sorted(proxy.ListProperties()))


def _check_device(name):
    if name not in ("mouse", "simulated", "falcon", "none") and not os.path.isfile(name):
        raise HapticsError(
            f"'{name}' is neither a device (mouse, simulated, falcon) nor a file with a recording "
            "or a path."
        )


def _check_range(name, prop, value):
    domain = prop.FindDomain("vtkSMDoubleRangeDomain") if prop.IsA("vtkSMDoubleVectorProperty") else None
    for number in value if isinstance(value, (list, tuple)) else [value]:
        if domain and not math.isfinite(number):
            raise ValueError(f"{name}: {number} is not finite")
        if domain and domain.GetMinimumExists(0) and number < domain.GetMinimum(0):
            raise ValueError(f"{name}: {number} is less than {domain.GetMinimum(0)}")
        if domain and domain.GetMaximumExists(0) and number > domain.GetMaximum(0):
            raise ValueError(f"{name}: {number} is more than {domain.GetMaximum(0)}")


def _describe(proxy):
    """What each property of a scene is, for help()."""
    lines = [Scene.__init__.__doc__ or "A haptic scene of ParaView.", "", "Its properties:", ""]
    for name in sorted(proxy.ListProperties()):
        prop = proxy.SMProxy.GetProperty(name)
        text = prop.GetDocumentation() if prop else None
        described = " ".join(text.GetDescription().split()) if text and text.GetDescription() else ""
        kind = "read only. " if prop and prop.GetInformationOnly() else ""
        lines.append(f"{name}: {kind}{described}")
    return "\n".join(lines)


def _needs_render():
    """Whether surfaces come to the client by a render alone: from other processes."""
    controller = servermanager.vtkProcessModule.GetProcessModule().GetGlobalController()
    alone = not controller or controller.GetNumberOfProcesses() == 1
    return servermanager.ActiveConnection.IsRemote() or not alone


def _bring(view):
    """Brings the triangles to the client."""
    if _needs_render():
        simple.Render(view)
    else:
        view.SMProxy.Update()


def state_lines():
    """Lines of Python that restore the scene after the sources and views of a Python state; [] for none."""
    proxy = servermanager.ProxyManager().GetProxy("haptics", "HapticScene")
    if not proxy:
        return []
    hand = Scene(servermanager._getPyProxy(proxy))
    names = {source.SMProxy: name for (name, _), source in simple.GetSources().items()}
    shown = [display for display in hand.Surfaces if display.Input.SMProxy in names]
    if not hand.View or not shown:
        return []
    view = hand.View.SMProxy
    view_name = view.GetSessionProxyManager().GetProxyName("views", view)
    chosen = {name: getattr(hand, name) for name in _kept_in_states(hand.proxy)}
    lines = [
        "",
        "# what was touched",
        "import vtkhaptics.paraview",
        f"touchedView = FindViewOrCreate({view_name!r}, viewtype={hand.View.GetXMLName()!r})"
        if view_name
        else "touchedView = GetActiveViewOrCreate('RenderView')",
        "vtkhaptics.paraview.scene().touch_only(",
    ]
    for display in shown:
        source = f"FindSource({names[display.Input.SMProxy]!r})"
        lines.append(f"    GetDisplayProperties({source}, view=touchedView),")
    lines.append(")")
    lines.append("vtkhaptics.paraview.scene().set(")
    for name, value in chosen.items():
        if not isinstance(value, (str, int, float)):
            value = value[0] if len(value) == 1 else list(value)
        lines.append(f"    {name}={value!r},")
    return lines + [")"]


def _kept_in_states(proxy):
    """The values that a state file keeps too."""
    properties = {name: proxy.SMProxy.GetProperty(name) for name in proxy.ListProperties()}
    return [
        name
        for name, prop in properties.items()
        if prop and prop.IsA("vtkSMVectorProperty")
        and not prop.GetInformationOnly() and not prop.IsStateIgnored()
    ]


def _extend_states():
    """Lets ParaView's Python states have the scene: ParaView asks no plugin what to write there."""
    from paraview import smstate

    if not hasattr(smstate.get_state, "without_haptics"):
        original = smstate.get_state

        @functools.wraps(original)
        def get_state(*args, **kwargs):
            state = original(*args, **kwargs)
            raw = kwargs.get("raw", False) or not isinstance(state, str)
            return state if raw else "\n".join([state, *state_lines()])

        get_state.without_haptics = original
        smstate.get_state = get_state


def _make_touchable(display):
    if not display.SMProxy.GetProperty("Touchable"):
        raise HapticsError(
            f"{display.Input.GetXMLLabel()} has no surface to touch here. Give a source of surfaces or "
            "volumes, for example the output of Extract Surface or Contour."
        )
    display.Touchable = 1
    if display.Representation == "Outline":
        display.SetRepresentationType("Surface")  # an outline hides what is touched


def _source(record, name):
    from .vtkHapticsRepresentations import vtkHapticRecordSource

    return simple.HapticRecord(
        registrationName=name, Contents=vtkHapticRecordSource.MakeContents(record)
    )


def scene():
    """The scene of this session; made if there is none yet."""
    load_plugin()
    manager = servermanager.ProxyManager()
    proxy = manager.GetProxy("haptics", "HapticScene")
    if not proxy:
        proxy = servermanager._getPyProxy(manager.NewProxy("haptics", "HapticScene"))
        proxy.UpdateVTKObjects()
        manager.RegisterProxy("haptics", "HapticScene", proxy.SMProxy)
    made = Scene(servermanager._getPyProxy(proxy))
    Scene.__doc__ = _describe(made.proxy)  # help(hand) shows it
    return made


def touch(source=None, view=None, **properties):
    """Makes a source (by default the active one) touchable, sets properties; returns the scene."""
    hand = scene()
    hand.set(**properties)
    hand.touch(source, view)
    return hand


_extend_states()
