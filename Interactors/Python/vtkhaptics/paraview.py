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
from vtkmodules.vtkCommonCore import vtkStringArray

from . import vtkHapticDevice
from . import vtkHapticScene  # noqa: F401  (lets the wrappers know the class)

__all__ = ["HapticsError", "Scene", "load_plugin", "scene", "touch"]


class HapticsError(Exception):
    """The message says what went wrong and what to do."""


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
        raise HapticsError(f"{path}: ParaView could not load this plugin. Its messages say why.")


def _find_plugin():
    manager = servermanager.vtkSMProxyManager
    version = f"paraview-{manager.GetVersionMajor()}.{manager.GetVersionMinor()}"
    folder = os.path.realpath(os.path.dirname(__file__))  # the folder may be a link
    while folder != os.path.dirname(folder):
        for libraries in (folder, os.path.join(folder, "*")):  # Debian's are in a folder of the machine
            found = glob.glob(os.path.join(libraries, version, "plugins", "Haptics", "Haptics.*"))
            if found:
                return found[0]
        folder = os.path.dirname(folder)
    raise HapticsError(
        f"There is no plugin Haptics for {version} next to this package. Give load_plugin() its path."
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
        # Fitting, the clutch and touch change those two.
        if name in ("WorkspaceTransform", "LandmarkContents") or prop.GetInformationOnly():
            self.proxy.SMProxy.UpdatePropertyInformation(prop)
        return getattr(self.proxy, name)

    def __setattr__(self, name, value):
        self.set(**{name: value})

    def __dir__(self):
        return sorted(set(super().__dir__()) | set(self.proxy.ListProperties()))

    def set(self, **properties):
        """Sets properties, for example set(Stiffness=800, Device="simulated"); help() describes each.

        Raises AttributeError for a name that is none or that can only be read, ValueError for a value
        that is out of range, TypeError for one of another kind, HapticsError for a name that is no
        device and for what the scene refuses. What is refused changes nothing.
        """
        for name, value in properties.items():
            prop = self.proxy.SMProxy.GetProperty(name)
            if not prop:
                raise AttributeError(f"a haptic scene has no {name}; it has {_names(self.proxy)}")
            if prop.GetInformationOnly():
                raise AttributeError(f"{name} can only be read")
            if name == "Device":
                _check_device(value)
            _check_value(name, prop, value)
            if name == "LandmarkContents":
                _check_landmarks(value)
            setattr(self.proxy, name, value)
            if name == "WorkspaceTransform" and any(value) and list(self.WorkspaceTransform) != list(value):
                raise ValueError(f"{name}: {self.Message}")

    def _prove_materials(self):
        """Raises where a constant of a surface is out of its range, which ParaView lets it be."""
        for display in self.Surfaces:
            material = display.HapticProperties
            for name in material.ListProperties():
                of = f"HapticProperties.{name} of {display.Input.GetXMLLabel()}"
                _check_value(of, material.SMProxy.GetProperty(name), getattr(material, name))

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

        return self.proxy.GetClientSideObject().GetPicture().GetContents()

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
        _check_proxies("View", view)
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

        A device that takes its time to open (see State) is engaged by an update() when it is
        ready.
        """
        self._prove_materials()
        self.proxy.Engaged = 0  # what was asked for before may have come to an end by itself
        self.proxy.Engaged = 1
        while self.Building and not self.EngagedInfo:
            time.sleep(0.005)
            self.update()
        if self.Message and not self.EngagedInfo:
            raise HapticsError(self.Message)

    def release(self):
        """Stops the servo, in virtual time too: zero force."""
        self._push("Engaged", 0)  # which it may be by name, while ticks are run by step()

    def update(self):
        """Takes in what the servo did; call it about as often as the view is rendered."""
        self.proxy.InvokeCommand("Update")

    def step(self, ticks):
        """Runs ticks in virtual time, as fast as they come. Raises HapticsError.

        Needs no picture, hence no display, but with a server, where renders bring the surfaces to
        the client.
        """
        self._prove_materials()
        if self.View and not _needs_render():
            _bring(self.View)  # what has changed upstream, or come with a state
        self._push("Step", ticks)  # also where it is the same number again
        if self.Message:
            raise HapticsError(self.Message)

    def _push(self, name, value):
        """Sets a property also where it has that value."""
        self.proxy.SMProxy.GetProperty(name).SetElement(0, value)
        self.proxy.SMProxy.UpdateProperty(name, 1)
        self.proxy.SMProxy.UpdateVTKObjects()

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
        """The trace of the ticks while RecordTrace was on, as vtkPolyData; see vtkHapticScene::GetTrace()."""
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
    """Whether it is one: "none" and what the chooser of the panel knows, with or without ":ID", or a file."""
    if not isinstance(name, str):
        raise TypeError(f"Device: {name!r} is no text")
    problem = vtkHapticDevice.GetNameProblem(name)
    if name != "none" and problem and not os.path.isfile(name):
        raise HapticsError(
            f"'{name}' is neither a device nor a file with a recording or a path. {problem}"
        )


def _check_landmarks(contents):
    from .vtkHapticsRepresentations import vtkPVHapticRecords

    problem = vtkPVHapticRecords.GetProblemOf(contents)
    if problem:
        raise HapticsError(problem)


def _choices(prop):
    """What an enumeration can be, as (text, number); [] for any other property."""
    domain = prop.FindDomain("vtkSMEnumerationDomain")
    if not domain or domain.IsA("vtkSMBooleanDomain"):
        return []
    return [(domain.GetEntryText(i), domain.GetEntryValue(i)) for i in range(domain.GetNumberOfEntries())]


def _range(prop):
    """The least and the greatest value, None where there is no such bound."""
    for kind in ("vtkSMDoubleRangeDomain", "vtkSMIntRangeDomain"):
        domain = prop.FindDomain(kind)
        if domain:
            return (
                domain.GetMinimum(0) if domain.GetMinimumExists(0) else None,
                domain.GetMaximum(0) if domain.GetMaximumExists(0) else None,
            )
    return None, None


def _check_value(name, prop, value):
    """Raises where a property cannot have a value. ParaView itself takes any number."""
    if prop.IsA("vtkSMProxyProperty"):
        _check_proxies(name, value)
        return
    if not prop.IsA("vtkSMVectorProperty"):
        raise AttributeError(f"{name} is a command: proxy.InvokeCommand({name!r}) runs it")
    if prop.IsA("vtkSMStringVectorProperty"):
        if not isinstance(value, str):
            raise TypeError(f"{name}: {value!r} is no text")
        return
    choices = _choices(prop)
    if isinstance(value, str):
        if value not in [text for text, _ in choices]:
            texts = ", ".join(text for text, _ in choices) or "a number"
            raise ValueError(f"{name}: {value!r} is not {texts}")
        return
    numbers = list(value) if hasattr(value, "__iter__") else [value]
    if len(numbers) != prop.GetNumberOfElements() and not prop.GetRepeatable():
        raise ValueError(f"{name}: {len(numbers)} numbers, where {prop.GetNumberOfElements()} are needed")
    least, most = _range(prop)
    for number in numbers:
        if not hasattr(number, "__float__"):
            raise TypeError(f"{name}: {number!r} is not a number")
        if not math.isfinite(number):
            raise ValueError(f"{name}: {number} is not finite")
        if not prop.IsA("vtkSMDoubleVectorProperty") and number != int(number):
            raise ValueError(f"{name}: {number} is no whole number")
        if choices and number not in [entry for _, entry in choices]:
            raise ValueError(f"{name}: {number} is none of {dict(choices)}")
        if prop.FindDomain("vtkSMBooleanDomain") and number not in (0, 1):
            raise ValueError(f"{name}: {number} is neither 0 nor 1")
        if least is not None and number < least:
            raise ValueError(f"{name}: {number} is less than {least}")
        if most is not None and number > most:
            raise ValueError(f"{name}: {number} is more than {most}")
        if name == "ScaleWorkspace" and number <= 0:
            raise ValueError(f"{name}: {number} is not above 0")


def _check_proxies(name, value):
    for proxy in value if isinstance(value, (list, tuple)) else [value]:
        if proxy is not None and not hasattr(proxy, "SMProxy"):
            raise TypeError(f"{name}: {proxy!r} is nothing that paraview.simple has made")
    if name == "View" and value is not None and not value.SMProxy.IsA("vtkSMRenderViewProxy"):
        raise HapticsError(f"A view of the kind {value.GetXMLLabel()} cannot be touched. Give a render view.")


def _values(prop):
    """In words what a property can be: its range or choices, and its default."""
    if not prop.IsA("vtkSMVectorProperty") or prop.GetInformationOnly():
        return "read only" if prop.GetInformationOnly() else ""
    choices = ", ".join(f"{text} ({number})" for text, number in _choices(prop))
    least, most = _range(prop)
    words = []
    if choices:
        words.append(choices)
    elif prop.FindDomain("vtkSMBooleanDomain"):
        words.append("0 or 1")
    elif prop.IsA("vtkSMStringVectorProperty"):
        words.append("text")
    elif least is not None or most is not None:
        words.append(
            f"from {least:g} to {most:g}" if None not in (least, most)
            else f"at least {least:g}" if most is None
            else f"at most {most:g}"
        )
    else:
        count = prop.GetNumberOfElements()
        kind = "finite" if prop.IsA("vtkSMDoubleVectorProperty") else "whole"
        words.append(f"{count} {kind} numbers" if count > 1 else f"a {kind} number")
    if prop.GetNumberOfElements() == 1 and not prop.IsStateIgnored():
        words.append(f"default {_default(prop)}")
    return "; ".join(words)


def _default(prop):
    scene = prop.GetParent()
    prototype = scene.GetSessionProxyManager().GetPrototypeProxy(scene.GetXMLGroup(), scene.GetXMLName())
    value = prototype.GetProperty(scene.GetPropertyName(prop)).GetElement(0)
    named = [text for text, number in _choices(prop) if number == value]
    return repr(named[0] if named else value)


def _describe(proxy):
    """What each property of a scene is, for help()."""
    lines = [Scene.__init__.__doc__ or "A haptic scene of ParaView.", "", "Its properties:", ""]
    for name in sorted(proxy.ListProperties()):
        prop = proxy.SMProxy.GetProperty(name)
        text = prop.GetDocumentation() if prop else None
        described = " ".join(text.GetDescription().split()) if text and text.GetDescription() else ""
        values = _values(prop) if prop else ""
        if name == "Device":
            values += "; devices: " + ", ".join(_device_names())
        lines.append(f"{name}: {described}" + (f" ({values})" if values else ""))
    return "\n".join(lines)


def _device_names():
    names, titles = vtkStringArray(), vtkStringArray()
    vtkHapticDevice.GetKnownNames(names, titles)
    return sorted(names.GetValue(i) for i in range(names.GetNumberOfValues()))


def _needs_render():
    """Whether surfaces come to the client by a render alone: from a server."""
    return servermanager.ActiveConnection.IsRemote()


def _bring(view):
    """Brings the triangles to the client."""
    if _needs_render():
        simple.Render(view)
    else:
        view.SMProxy.Update()


def state_lines(with_hidden=True):
    """Lines of Python that restore the scene after the sources and views of a Python state; [] for none.

    with_hidden: also where what is touched is hidden, which ParaView leaves out of a state unless asked.
    """
    proxy = _registered()
    if not proxy:
        return []
    hand = Scene(servermanager._getPyProxy(proxy))
    names = {source.SMProxy: name for (name, _), source in simple.GetSources().items()}
    shown = [
        display
        for display in hand.Surfaces
        if display.Input.SMProxy in names and (with_hidden or display.Visibility)
    ]
    if not hand.View or not shown:
        return []
    view = hand.View.SMProxy
    view_name = view.GetSessionProxyManager().GetProxyName("views", view)
    chosen = {name: getattr(hand, name) for name in _kept_in_states(hand.proxy)}
    lines = [
        "",
        "# ----------------------------------------------------------------",
        "# restore what was touched; hand.engage() starts the device",
        "# ----------------------------------------------------------------",
        "hand = vtkhaptics.paraview.scene()",
        f"touchedView = FindViewOrCreate({view_name!r}, viewtype={hand.View.GetXMLName()!r})"
        if view_name
        else "touchedView = GetActiveViewOrCreate('RenderView')",
        "hand.touch_only(",
    ]
    for display in shown:
        source = f"FindSource({names[display.Input.SMProxy]!r})"
        lines.append(f"    GetDisplayProperties({source}, view=touchedView),")
    lines.append(")")
    lines.append("hand.set(")
    for name, value in chosen.items():
        if not isinstance(value, (str, int, float)):
            value = value[0] if len(value) == 1 else list(value)
        lines.append(f"    {name}={value!r},")
    return [*lines, ")"]


def _kept_in_states(proxy):
    """The values that a state file keeps too."""
    properties = {name: proxy.SMProxy.GetProperty(name) for name in proxy.ListProperties()}
    return [
        name
        for name, prop in properties.items()
        if prop and prop.IsA("vtkSMVectorProperty")
        and not prop.GetInformationOnly() and not prop.IsStateIgnored()
    ]


def _with_scene(state, options, source_set):
    """The text of a Python state with what it needs of this package, and the scene."""
    options = options and servermanager._getPyProxy(options)
    has_views = not (options and options.SkipRenderingComponents)
    with_hidden = bool(options and not options.SkipHiddenDisplayProperties)
    lines = state_lines(with_hidden) if has_views and not source_set else []
    if lines or "Haptic" in state or "GodObject" in state:
        start = "from paraview.simple import *\n"  # with what the plugin adds to it
        load = "import vtkhaptics.paraview\nvtkhaptics.paraview.load_plugin()\n"
        before, found, after = state.partition(start)
        state = before + load + found + after if found else load + state
    return "\n".join([state, *lines])


def _extend_states():
    """Lets ParaView's Python states have the scene: ParaView asks no plugin what to write there."""
    from paraview import smstate

    if not hasattr(smstate.get_state, "without_haptics"):
        original = smstate.get_state

        @functools.wraps(original)
        def get_state(options=None, source_set=(), *args, **kwargs):
            state = original(options, source_set, *args, **kwargs)
            return _with_scene(state, options, source_set) if isinstance(state, str) else state

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


def _registered():
    """The proxy of this session's scene, under whatever name a state has brought it; None where there is none."""
    manager = servermanager.ProxyManager()
    name = manager.GetProxyName("haptics", 0)
    return manager.GetProxy("haptics", name) if name else None


def scene():
    """The scene of this session; made if there is none yet. A state that is loaded brings another one."""
    load_plugin()
    manager = servermanager.ProxyManager()
    proxy = _registered()
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
