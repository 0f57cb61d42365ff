"""Finds out whether this VTK can draw here, and borrows a virtual display where it cannot."""

import os
import shutil
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
    # Without -noreset the server starts anew once a first window is closed, and may turn the next away.
    server = ["-a", "-s", "-noreset -screen 0 1280x1024x24"]
    os.execv(xvfb, [xvfb, *server, sys.executable, *program, *arguments])
