"""Pictures for notebooks and for machines without a display: drawn by a process of their own."""

import os
import subprocess
import sys
import tempfile
from typing import Any, Optional

from .errors import HapticsError
from .meshes import polydata
from .output import write_bytes, write_polydata


class Picture:
    """A PNG picture: a notebook shows it inline; save() writes it; `png` has its bytes."""

    def __init__(self, png: bytes) -> None:
        self.png = png

    def _repr_png_(self) -> bytes:
        return self.png

    def save(self, path: Any) -> None:
        """Writes it to a file, whole or not at all. Raises OutputError, which is an OSError."""
        write_bytes(path, self.png)


def picture_of(
    surface: Any,
    trace: Any = None,
    *,
    scalars: Optional[str] = None,
    size: tuple[int, int] = (800, 600),
) -> Picture:
    """A picture of a surface and of a hand that follows a trace over it.

    `surface` is what :func:`vtkhaptics.polydata` takes, `trace` what :func:`vtkhaptics.trace` returns
    (without one a hand strokes the middle of the view), `scalars` the array to colour by and `size`
    in pixels. Needs no display: the viewer draws it, ``python3 -m vtkhaptics --offscreen``, in a
    process of its own, under a virtual display where there is none. Raises HapticsError with the
    viewer's words where it cannot, as for a file that cannot be read.

    >>> vtkhaptics.picture_of("part.stl", t)       # the last line of a notebook's cell
    """
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, name) for name in ("surface.vtp", "trace.vtp", "picture.png")]
        if isinstance(surface, (str, os.PathLike)) and os.fspath(surface):
            files[0] = os.path.abspath(surface)  # whose name the picture has
        else:
            write_polydata(files[0], polydata(surface))
        command = [sys.executable, "-m", "vtkhaptics", files[0], "--offscreen"]
        command += ["--screenshot", files[2], "--size", *map(str, size)]
        if trace is not None:
            write_polydata(files[1], trace.polydata)
            seconds = float(trace.time[-1] - trace.time[0])
            command += ["--device", files[1], "--seconds", str(min(max(0.7 * seconds, 2.0), 600.0))]
            pressed = trace["Stiffness"][trace["Penetration"] > 0]
            if len(pressed) and pressed.min() == pressed.max():
                command += ["--stiffness", str(pressed[0])]
        if scalars:
            command += ["--scalars", scalars]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode or not os.path.isfile(files[2]):
            raise HapticsError(f"there is no picture: {done.stderr.strip() or done.stdout.strip()}")
        with open(files[2], "rb") as file:
            return Picture(file.read())
