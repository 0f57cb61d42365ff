"""What goes wrong is raised: the errors and warnings of the package's VTK classes, as exceptions.

VTK reports by events, `ErrorEvent` and `WarningEvent`, and prints what nobody observes. The package
observes them on its objects (:func:`watch`). What comes while one of their methods runs that was
called from Python (:func:`checked`) ends that call:

- an error is raised as :class:`HapticsError`, with VTK's own text and the object's name;
- a warning goes to :mod:`warnings` as :class:`HapticsWarning`;
- an exception in an observer, which VTK could only print, is raised once the call has done its work.

An object on which the program observes `ErrorEvent` (or `WarningEvent`) itself raises (warns)
nothing: the program handles that, as in VTK. Nor is the same text raised where another object
passes it on, as a scene does with what its servo reports. What happens outside of such a call, in
the event loop of a window for instance, VTK prints as ever.
"""

import functools
import re
import threading
import traceback
import warnings

from vtkmodules.vtkCommonCore import vtkCommand

from .vtkHapticsFilters import vtkReportCollector

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


class _Calls(threading.local):
    """What observers raised, for each of the calls that are under way in this thread, innermost
    last."""

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


def watch(object_):
    """Takes what an object reports, from now on."""
    vtkReportCollector.Watch(object_)


def handle(object_, event, is_handled):
    """Leaves an object's `ERROR` or `WARNING` to the program's own observers, or no longer."""
    vtkReportCollector.SetHandled(object_, event, is_handled)


def checked(method):
    """A method that raises what is reported while it runs."""

    @functools.wraps(method)
    def call(self, *arguments):
        raised = []
        _calls.stack.append(raised)
        vtkReportCollector.Begin(self)
        try:
            result = method(self, *arguments)
        finally:
            count = vtkReportCollector.End()
            _calls.stack.pop()
        if count or raised:
            _pass_on(_reports(count, self), raised, self)
        return result

    return call


def _reports(count, caller):
    """(is_error, reporter, text) of each report of the call that ended that nobody has handled."""
    collector = vtkReportCollector
    texts = [text_of(collector.GetText(i)) for i in range(count)]
    handled = {(collector.IsError(i), texts[i]) for i in range(count) if collector.IsHandled(i)}
    reports = [
        (collector.IsError(i), collector.GetReporter(i) or caller, texts[i]) for i in range(count)
    ]
    return [report for report in reports if (report[0], report[2]) not in handled]


def _pass_on(reports, raised, caller):
    for is_error, reporter, text in reports:
        if not is_error:
            warnings.warn(f"{name_of(reporter)}: {text}", HapticsWarning, stacklevel=3)
    error = None
    errors = [(reporter, text) for is_error, reporter, text in reports if is_error]
    if errors:
        # What the object that was called says comes first; each text once, as others pass it on.
        by_text = {}
        for reporter, text in sorted(errors, key=lambda report: report[0] is not caller):
            by_text.setdefault(text, (reporter, text))
        errors = list(by_text.values())
        lines = [f"{name_of(reporter)}: {text}" for reporter, text in errors]
        error = HapticsError("\n".join(lines), *errors[0])
    if raised:
        first, *others = raised
        for other in others:
            _note(first, other)
        raise first from error
    if error:
        # A device in Python keeps what its program raised.
        causes = (getattr(reporter, "failure", None) for reporter, _ in errors)
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
            _calls.stack[-1].append(error)

    return notify
