"""A progress bar on standard error, where someone looks at it and it takes long enough."""

import sys
import time

PATIENCE = 0.4  # [s] before the bar appears
WIDTH = 30


class ProgressBar:
    """``with ProgressBar("reading a.stl") as bar: bar.show(0.5)``"""

    def __init__(self, label, stream=None):
        self.label = label
        self.stream = stream or sys.stderr
        self.wanted = self.stream.isatty()
        self.began = time.monotonic()
        self.shown = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.shown is not None:
            self.stream.write("\r" + " " * (len(self.label) + WIDTH + 10) + "\r")
            self.stream.flush()

    def show(self, share):
        """Draws the bar at a share of 0 to 1; cheap to call often."""
        percent = int(100 * min(max(share, 0.0), 1.0))
        if not self.wanted or percent == self.shown or time.monotonic() - self.began < PATIENCE:
            return
        self.shown = percent
        filled = WIDTH * percent // 100
        bar = "#" * filled + "-" * (WIDTH - filled)
        self.stream.write(f"\r{self.label} [{bar}] {percent:3d} %")
        self.stream.flush()
