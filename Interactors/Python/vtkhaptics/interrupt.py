"""Ctrl-C ends a window as its close button does: results are written, and nothing is torn off."""

import signal
import sys
import threading

EXIT_INTERRUPTED = 130  # as shells give it to what SIGINT has ended


class Interrupts:
    """Takes SIGINT while it is entered.

    In an event loop that run() started, SIGINT closes the window, and run() raises
    KeyboardInterrupt when the loop has ended. Elsewhere it raises KeyboardInterrupt at once, as
    ever. VTK ends the process with status 1 where an observer raises it, hence this class. Does
    nothing in a thread that gets no signals, or where SIGINT is ignored or has a handler of the
    program's own.

    Enter it before the scene engages, which takes SIGINT too and passes it on to this.
    """

    def __init__(self):
        self._interactor = None
        self._came = False
        self._taken = False

    def __enter__(self):
        self._taken = (
            threading.current_thread() is threading.main_thread()
            and signal.getsignal(signal.SIGINT) is signal.default_int_handler
        )
        if self._taken:
            signal.signal(signal.SIGINT, self._on_signal)
        return self

    def __exit__(self, *_):
        if self._taken and signal.getsignal(signal.SIGINT) == self._on_signal:
            signal.signal(signal.SIGINT, signal.default_int_handler)

    def run(self, interactor, start=None):
        """Runs the event loop of an interactor until its window is closed."""
        self._came = False
        self._interactor = interactor
        try:
            if not self._came:
                (start or interactor.Start)()
        finally:
            self._interactor = None
        if self._came:
            raise KeyboardInterrupt

    def _on_signal(self, _signal, _frame):
        if self._interactor is None:
            raise KeyboardInterrupt
        self._came = True
        if not self._interactor.GetDone():  # again too: the loop may have begun after the first
            self._interactor.ExitCallback()


def is_interactive():
    """Whether somebody types at this Python, so that an end of the program is not meant."""
    return hasattr(sys, "ps1") or bool(sys.flags.interactive)
