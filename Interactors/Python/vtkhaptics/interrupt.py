"""Ctrl-C ends a window as its close button does, and so do SIGTERM and SIGHUP in a program: results are
written, and nothing is torn off."""

import contextlib
import signal
import sys
import threading

EXIT_INTERRUPTED = 130  # as shells give it to what SIGINT has ended
EXIT_SIGNAL = 128  # and this, with the signal's number added, to what another one has
# What a program ends by: Ctrl-C, another program or the system, a terminal that is closed.
ENDS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))


class _Deferral:
    """How many deferred() blocks the main thread is in, and whether a signal came meanwhile."""

    depth = 0
    is_due = False


def is_due():
    """Whether a signal waits for the end of a deferred() block: give up what takes long."""
    return _Deferral.is_due


@contextlib.contextmanager
def deferred():
    """For a call of VTK in which it calls Python: it ends the process with status 1 where an observer
    raises KeyboardInterrupt. The signals of Interrupts raise that when the block has ended."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _Deferral.depth += 1
    try:
        yield
    finally:
        _Deferral.depth -= 1
        if _Deferral.depth == 0 and _Deferral.is_due:
            _Deferral.is_due = False
            raise KeyboardInterrupt


@contextlib.contextmanager
def held_back():
    """Keeps Ctrl-C until the block, which imports compiled modules, has ended: where it comes while one of
    them imports another they report that as missing, those of VTK and of NumPy."""
    came, handler = [], signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(handler):
        yield
        return
    signal.signal(signal.SIGINT, lambda *arguments: came.append(arguments))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, handler)
        if came:
            handler(*came[0])


class Interrupts:
    """Takes `signals` while it is entered: SIGINT, or all of ENDS in a program that writes its results
    when it ends.

    In an event loop that run() started, they close the window, and run() raises KeyboardInterrupt when
    the loop has ended. Elsewhere they raise KeyboardInterrupt at once, as SIGINT ever does, or at the
    end of a deferred() block. VTK ends the process with status 1 where an observer raises it, hence
    this class. Takes nothing in a thread that gets no signals, and no signal that is ignored (as SIGHUP
    is under nohup) or has a handler of the program's own.

    Enter it before the scene engages, which takes the signals too and passes them on to this.
    """

    def __init__(self, signals=(signal.SIGINT,)):
        self._signals = signals
        self._interactor = None
        self._came = False
        self._before = {}
        self._status = None

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for number in self._signals:
                usual = signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL
                if signal.getsignal(number) is usual:
                    signal.signal(number, self._on_signal)
                    self._before[number] = usual
        return self

    def __exit__(self, *_):
        for number, usual in self._before.items():
            if signal.getsignal(number) == self._on_signal:
                signal.signal(number, usual)
        self._before.clear()

    def exit_status(self):
        """What the program ends with, as shells have it: that of the first signal that came."""
        return self._status or EXIT_INTERRUPTED

    def run(self, interactor, start=None):
        """Runs the event loop of an interactor until its window is closed."""
        self._came = False
        self._interactor = interactor
        observer = None
        if len(self._before) > 1:
            # Python hears of a signal where its code runs, and one that came on the way into the
            # loop ends it now. (The style does that for SIGINT.)
            observer = interactor.AddObserver("TimerEvent", self._on_timer, 6.0)
        try:
            if not self._came:
                (start or interactor.Start)()
        finally:
            self._interactor = None
            if observer is not None:
                interactor.RemoveObserver(observer)
        if self._came:
            raise KeyboardInterrupt

    def _on_timer(self, interactor, _event):
        if self._came and not interactor.GetDone():
            interactor.ExitCallback()

    def _on_signal(self, number, _frame):
        self._status = self._status or EXIT_SIGNAL + number
        if self._interactor is not None:
            self._came = True
            if not self._interactor.GetDone():  # again too: the loop may have begun after the first
                self._interactor.ExitCallback()
        elif _Deferral.depth:
            _Deferral.is_due = True
        else:
            raise KeyboardInterrupt


def is_interactive():
    """Whether somebody types at this Python, so that an end of the program is not meant."""
    return hasattr(sys, "ps1") or bool(sys.flags.interactive)
