"""What goes wrong is raised: the errors and warnings of the package's VTK classes, as exceptions.

VTK reports by events, `ErrorEvent` and `WarningEvent`, and prints what nobody observes. The package
observes them on its objects (:func:`watch`). What comes while one of their methods runs that was
called from Python (:func:`checked`) ends that call:

- an error is raised as :class:`HapticsError`, with VTK's own text and the object's name;
- a warning goes to :mod:`warnings` as :class:`HapticsWarning`;
- an exception in an observer, which VTK could only print, is raised once the call has done its work.

An object on which the program observes `ErrorEvent` (or `WarningEvent`) itself raises (warns)
nothing: the program has taken that over, as in VTK. What happens outside of such a call, in the
event loop of a window for instance, VTK prints as ever.
"""

import functools
import re
import threading
import traceback
import warnings

from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkCommand, vtkObject, vtkOutputWindow

ERROR, WARNING = int(vtkCommand.ErrorEvent), int(vtkCommand.WarningEvent)


class HapticsError(RuntimeError):
    """What a VTK object of the package reported as an error.

    `reporter` is the object, `text` what it reported. ``str()`` has the object's name and the text,
    and all else that was reported in the same call, a line each.
    """

    def __init__(self, message, reporter=None, text=""):
        super().__init__(message)
        self.reporter = reporter
        self.text = text


class HapticsWarning(UserWarning):
    """What a VTK object of the package reported as a warning."""


class _Call:
    """One call that is under way: what was reported, and what observers raised."""

    __slots__ = ("errors", "warnings", "raised")

    def __init__(self):
        self.errors, self.warnings, self.raised = [], [], []


class _Calls(threading.local):
    """The calls that are under way in this thread, innermost last."""

    def __init__(self):
        self.stack = []


_calls = _Calls()


def name_of(reporter):
    """The class of an object, and its name where it has one (VTK 9.3 and later)."""
    name = getattr(reporter, "GetObjectName", lambda: "")()
    return f"{reporter.GetClassName()} '{name}'" if name else reporter.GetClassName()


def text_of(report):
    """What happened, of "ERROR: In file.cxx, line 1 vtkClass (0x1): what happened"."""
    return re.sub(r"^(ERROR|Warning|Generic Warning):.*?\(0x[0-9a-f]+\): ", "", " ".join(report.split()))


@calldata_type(VTK_STRING)
def _on_report(reporter, event, report):
    is_error = event == "ErrorEvent"
    if getattr(reporter, "_own_observers", {}).get(ERROR if is_error else WARNING):
        return
    if _calls.stack:
        now = _calls.stack[-1]
        (now.errors if is_error else now.warnings).append((reporter, text_of(report)))
    elif is_error:
        vtkOutputWindow.GetInstance().DisplayErrorText(report)
    else:
        vtkOutputWindow.GetInstance().DisplayWarningText(report)


def watch(object_):
    """Takes what an object reports, from now on; once."""
    if not getattr(object_, "_watched", False):
        for event in (ERROR, WARNING):
            vtkObject.AddObserver(object_, event, _on_report)
        object_._watched = True


def checked(method):
    """A method that raises what is reported while it runs."""

    @functools.wraps(method)
    def call(self, *arguments):
        watch(self)
        now = _Call()
        _calls.stack.append(now)
        try:
            result = method(self, *arguments)
        finally:
            _calls.stack.pop()
        if now.warnings or now.errors or now.raised:
            _pass_on(now, self)
        return result

    return call


def _pass_on(now, caller):
    for reporter, text in now.warnings:
        warnings.warn(f"{name_of(reporter)}: {text}", HapticsWarning, stacklevel=3)
    error = None
    if now.errors:
        # What the object that was called says comes first; each text once, as others pass it on.
        by_text = {}
        for reporter, text in sorted(now.errors, key=lambda report: report[0] is not caller):
            by_text.setdefault(text, (reporter, text))
        reports = list(by_text.values())
        lines = [f"{name_of(reporter)}: {text}" for reporter, text in reports]
        error = HapticsError("\n".join(lines), *reports[0])
    if now.raised:
        first, *others = now.raised
        for other in others:
            _note(first, other)
        raise first from error
    if error:
        # A device in Python keeps what its program raised.
        causes = (getattr(reporter, "failure", None) for reporter, _ in now.errors)
        raise error from next((cause for cause in causes if cause), None)


def _note(error, other):
    """Adds what else was raised to an exception's print-out (Python 3.11 and later)."""
    if hasattr(error, "add_note"):
        error.add_note("Another observer raised:\n" + "".join(traceback.format_exception(other)))


def guarded(observer):
    """An observer whose exceptions the call that caused its event raises."""

    def notify(*arguments):
        try:
            return observer(*arguments)
        except BaseException as error:  # Ctrl-C too, for which VTK would end the process
            if not _calls.stack:
                raise  # nobody to raise it to: VTK prints it
            _calls.stack[-1].raised.append(error)

    return notify
