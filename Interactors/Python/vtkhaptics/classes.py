"""The package's VTK classes, as Python programs see them.

Every class of the compiled modules is extended here by a Python class of the same name, which is
what ``vtkhaptics.vtkHapticScene`` is. It adds that

- what fails raises, see :mod:`vtkhaptics.errors`;
- observers take events by name, ``scene.AddObserver("ContactBeginEvent", ...)``, get an event's data
  as a third argument where they have one, and raise;
- getters return tuples: ``device.GetPosition()`` as well as VTK's ``device.GetPosition(list)``;
- ``with scene.engaged(): ...`` releases the hand however the block ends.

From VTK 9.2 on objects that C++ has made are of these classes too (``scene.GetServo()``); with
VTK 9.1 only those that Python has made.
"""

import contextlib
import functools
import inspect

from vtkmodules.util.vtkConstants import VTK_INT, VTK_OBJECT
from vtkmodules.vtkCommonCore import reference, vtkCommand, vtkObject, vtkObjectBase
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from . import vtkHapticsDevices, vtkHapticsFilters, vtkHapticsScene, vtkHapticsView
from .errors import ERROR, WARNING, HapticsError, checked, guarded, handle, watch

MODULES = (vtkHapticsFilters, vtkHapticsDevices, vtkHapticsScene, vtkHapticsView)

# Getters that fill lists, and how long these are; None stands for a number that is filled.
OUTPUTS = {
    "vtkHapticDevice": {"GetPosition": (3,), "GetForce": (3,)},
    "vtkSimulatedHapticDevice": {"GetPositionAt": (3,)},
    "vtkRecordedHapticDevice": {"GetTick": (None, 3, 3)},
    "vtkMouseHapticDevice": {"GetTarget": (3,)},
    "vtkSharedHapticDevice": {"Exchange": (3,)},
    "vtkDriverHapticDevice": {"GetOrientation": (4,)},
    "vtkHapticReadings": {
        name: (3,)
        for name in (
            "GetHapticInterfacePoint", "GetGodObject", "GetForce", "GetWorldForce",
            "GetDevicePosition",
        )
    },
    "vtkHapticSceneParts": {"IntersectRay": (3,)},
    "vtkHapticSurfaces": {"IntersectRay": (3, 3)},
    "vtkHapticLandmarks": {"GetPosition": (3,)},
}

# The data of an event: a probe or a number; none where it is not here.
CALL_DATA = {
    **dict.fromkeys(
        ("ContactBeginEvent", "ContactEndEvent", "ContactSlideEvent", "OverloadEvent",
         "SqueezeEvent"),
        VTK_OBJECT,
    ),
    **dict.fromkeys(
        ("ButtonPressEvent", "ButtonReleaseEvent", "DeviceStateEvent", "LandmarkEvent",
         "GripEvent", "LetGoEvent"),
        VTK_INT,
    ),
}


def returning(method, outputs):
    """A getter that returns what it would fill; with lists given, as VTK has it. Where the method
    returns False there is nothing to return: None."""

    @functools.wraps(method)
    def get(self, *arguments):
        filled = [reference(0.0) if size is None else [0.0] * size for size in outputs]
        try:
            result = method(self, *arguments, *filled)
        except TypeError:
            return method(self, *arguments)  # the lists are among the arguments, or it is an error
        if result is False:
            return None
        values = tuple(tuple(v) if isinstance(v, list) else float(v) for v in filled)
        return values[0] if len(values) == 1 else values

    return get


def events_of(class_):
    """From the names of a class's own events to their numbers."""
    return {
        name: int(value)
        for base in class_.__mro__
        if base not in vtkObject.__mro__
        for name, value in vars(base).items()
        if name.endswith("Event") and isinstance(value, int)
    }


def takes_data(observer):
    """Whether an observer has a place for an event's data after the caller and the event."""
    try:
        inspect.signature(observer).bind(None, "", None)
    except (TypeError, ValueError):
        return False
    return True


class Extended:
    """What each class has besides VTK's own."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        watch(self)

    def AddObserver(self, event, observer, priority=0.0):
        """AddObserver(event, observer, priority=0.0) -> int

        Calls ``observer(caller, event)``, or ``observer(caller, event, data)`` where it takes three:
        the event's vtkHapticProbe or number, None for events without. `event` is a name such as
        "ContactBeginEvent", VTK's or one of this class, or its number. An exception in the observer
        is raised by the call that caused the event, once that has done its work. Returns a tag for
        RemoveObserver().
        """
        events = events_of(type(self))
        if isinstance(event, str):
            if event not in events and not vtkCommand.GetEventIdFromString(event):
                raise ValueError(
                    f"{self.GetClassName()} has no event {event!r}. Its own are "
                    f"{', '.join(events) or 'none'}; besides, VTK's such as 'ModifiedEvent'."
                )
            event = events.get(event) or vtkCommand.GetEventIdFromString(event)
        name = next((known for known, number in events.items() if number == event), None)
        tag = vtkObject.AddObserver(self, event, _observer(observer, name), priority)
        if event in (ERROR, WARNING):
            self.__dict__.setdefault("_own_observers", {}).setdefault(int(event), set()).add(tag)
            handle(self, event, True)
        return tag

    def RemoveObserver(self, observer):
        """RemoveObserver(tag) -> None"""
        vtkObject.RemoveObserver(self, observer)
        for event, tags in self.__dict__.get("_own_observers", {}).items():
            if observer in tags:
                tags.discard(observer)
                handle(self, event, bool(tags))

    def RemoveObservers(self, event):
        """RemoveObservers(event) -> None: all of an event, by its name or number."""
        if isinstance(event, str):
            event = events_of(type(self)).get(event) or vtkCommand.GetEventIdFromString(event)
        vtkObject.RemoveObservers(self, event)
        if event in (ERROR, WARNING):
            self.__dict__.get("_own_observers", {}).pop(int(event), None)
            watch(self)

    def RemoveAllObservers(self):
        """RemoveAllObservers() -> None"""
        vtkObject.RemoveAllObservers(self)
        self.__dict__.pop("_own_observers", None)
        watch(self)


def _observer(observer, name):
    """What VTK is to call for an event of ours with this name, or of VTK with none."""
    data = getattr(observer, "CallDataType", None)
    wants_data = data is None and name is not None and takes_data(observer)
    if wants_data:
        data = CALL_DATA.get(name)

    def call(caller, event, *arguments):
        if wants_data and not arguments:
            arguments = (None,)
        return observer(caller, name or event, *arguments)  # VTK calls others' events "UserEvent"

    notify = guarded(call)
    if data is not None:
        notify.CallDataType = data
    return notify


class Filter(Extended):
    """What a filter has besides."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        watch(self.GetExecutive())  # which reports what is wrong with the pipeline


class Scene(Extended):
    """What a scene has besides."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        watch(vtkHapticsScene.vtkHapticScene.GetServo(self))

    @contextlib.contextmanager
    def engaged(self, camera=None):
        """Engages for a ``with`` block, and releases the hand however that ends.

        Where the workspace was never set it is fitted to the surfaces if a camera is given, as
        EngageInView() does. Gives the scene. Raises HapticsError where it does not engage.

            with scene.engaged():
                time.sleep(5.0)
        """
        self.EngageInView(camera) if camera is not None else self.Engage()
        try:
            yield self
        except BaseException:
            with contextlib.suppress(HapticsError):  # the servo has stopped too: not what matters
                self.Release()
            raise
        self.Release()


def methods_of(class_):
    """The methods that the package's classes define, by name; the nearest definition of each."""
    methods = {}
    for base in reversed(class_.__mro__):
        if base.__module__.startswith("vtkhaptics."):
            methods.update(
                (name, value)
                for name, value in vars(base).items()
                if type(value).__name__ == "method_descriptor"
                and name not in OF_EVERY_CLASS
                and "C++: static " not in (value.__doc__ or "")
            )
    if issubclass(class_, vtkAlgorithm):
        methods["Update"] = class_.Update
    return methods


OF_EVERY_CLASS = set(vars(vtkObject)) | set(vars(vtkObjectBase)) | {"NewInstance", "SafeDownCast"}


def extend(class_):
    """The Python class for one of a compiled module."""
    outputs = {}
    for base in reversed(class_.__mro__):
        outputs.update(OUTPUTS.get(base.__name__, {}))
    own = {}
    for name, method in methods_of(class_).items():
        if name in outputs:
            method = returning(method, outputs[name])
        own[name] = checked(method)
    base = Scene if class_.__name__ == "vtkHapticScene" else Extended
    if issubclass(class_, vtkAlgorithm):
        base = Filter
    extended = type("Extended" + class_.__name__, (base, class_), own)
    if hasattr(class_, "override"):
        class_.override(extended)
    # Not before: VTK takes a class of that name for its own.
    extended.__name__ = extended.__qualname__ = class_.__name__
    extended.__module__ = "vtkhaptics"
    extended.__doc__ = class_.__doc__
    return extended


_native = {
    name: value
    for module in MODULES
    for name, value in vars(module).items()
    if isinstance(value, type) and issubclass(value, vtkObjectBase)
    and value.__module__ == module.__name__
    and name != "vtkReportCollector"  # the package's own, see errors.py
}
# Abstract ones stay as they are, so that isinstance() says what it should.
_ABSTRACT = (
    "vtkHapticDevice", "vtkThreadedHapticDevice", "vtkDriverHapticDevice", "vtkHapticPatchAlgorithm",
    "vtkHapticSceneParts",
)
CLASSES = {
    name: class_ if name in _ABSTRACT else extend(class_)
    for name, class_ in _native.items()
}
