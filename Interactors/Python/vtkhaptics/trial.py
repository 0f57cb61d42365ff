"""Tries what may end a process in a child process first."""

import os
import signal
import warnings


class Crashed(Exception):
    """What a trial ended with."""


def try_apart(action):
    """Runs `action` in a child process and forgets its results and exceptions.

    Raises Crashed where that ended by a signal, as a reader of VTK does at some damaged files. Does
    nothing where the system cannot fork."""
    if not hasattr(os, "fork"):
        return
    with warnings.catch_warnings():
        # From Python 3.12 on it warns where there are threads, as VTK's own: the child only reads a file, and
        # waits for none of them.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        try:
            # What it has to say the parent says, when it does the same.
            with open(os.devnull, "wb") as nothing:
                os.dup2(nothing.fileno(), 1)
                os.dup2(nothing.fileno(), 2)
            action()
        finally:
            os._exit(0)
    try:
        _, status = os.waitpid(child, 0)
    except BaseException:  # Ctrl-C: nobody waits for it any more
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        raise
    if os.WIFSIGNALED(status):
        raise Crashed(signal.strsignal(os.WTERMSIG(status)))
