"""Finds out whether this VTK can draw here, and borrows a virtual display where it cannot."""

import contextlib
import os
import shutil
import signal
import subprocess
import sys

from vtkmodules.vtkRenderingCore import vtkRenderWindow


class DisplayError(Exception):
    """The message says why nothing can be drawn and what to do."""


def needs_display():
    """Whether this VTK can only draw with an X server, and there is none."""
    return vtkRenderWindow().IsA("vtkXOpenGLRenderWindow") and not os.environ.get("DISPLAY")


def ensure_script_display():
    """For a script that draws: where this VTK can only draw with an X server and there is none, runs
    it again under a virtual one, or ends it with what to install."""
    try:
        ensure_display(None, sys.argv)
    except DisplayError as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {error}")


def ensure_display(module, arguments):
    """Where VTK can only draw with an X server and there is none, runs the module again under a
    virtual one, and does not return; where `module` is None the script that `arguments` begin with.
    Raises DisplayError where there is none to be had."""
    if not needs_display():
        return
    xvfb = shutil.which("xvfb-run")
    if not xvfb:
        raise DisplayError(
            "this VTK needs an X server to draw, and DISPLAY is not set. "
            "Install xvfb (Debian: apt-get install xvfb xauth) and try again."
        )
    program = ["-m", module] if module else []
    sys.exit(_run_displayed(xvfb, [sys.executable, *program, *arguments]))


def _run_displayed(xvfb, command):
    """Runs a command under a virtual display; its exit status, as shells have it. What is to end this
    process is passed on to that: xvfb-run would die of it, and leave the command and the display behind."""
    # Without -noreset the server starts anew once a first window is closed, and may turn the next away.
    server = ["-a", "-s", "-noreset -screen 0 1280x1024x24"]
    read, write = os.pipe()
    tell_id = ["sh", "-c", 'echo $$ >"$0"; exec "$@"', f"/proc/self/fd/{write}"]
    inner, waiting = 0, []

    def pass_on(number, _frame):
        if not inner:
            waiting.append(number)
            return
        with contextlib.suppress(ProcessLookupError):
            os.kill(inner, number)

    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT"):
        number = getattr(signal, name)
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, pass_on)
    # A session of its own: Ctrl-C would end the server before the command has drawn its last picture.
    shell = subprocess.Popen(
        [xvfb, *server, *tell_id, *command], pass_fds=[write], start_new_session=True)
    os.close(write)
    with open(read, "rb") as line:
        inner = int(line.readline() or 0)
    for number in waiting:
        pass_on(number, None)
    status = shell.wait()
    return status if status >= 0 else 128 - status
