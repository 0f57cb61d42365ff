"""Without a display everything runs, draws off screen, or says what is missing: nothing aborts."""

import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np
import vtkhaptics
from real_window import default_signals, wait_for
from vtkhaptics.display import needs_display
from vtkhaptics.surfaces import SurfaceError

EXAMPLES = os.path.join(os.environ["HAPTICS_SOURCE_DIR"], "Interactors", "Python", "examples")
HEADLESS = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}

TABLE = "OFF 4 1 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n"


def size_of(png):
    """Width and height of a PNG picture."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n", png[:8]
    return struct.unpack(">II", png[16:24])


def processes_with(mark):
    """The processes with this in their environment."""
    found = []
    for id_ in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{id_}/environ", "rb") as file:
                if mark.encode() in file.read().split(b"\0"):
                    found.append(id_)
        except OSError:  # it has ended, or is somebody else's
            continue
    return found


class Headless(unittest.TestCase):
    def setUp(self):
        before = dict(os.environ)
        self.addCleanup(lambda: (os.environ.clear(), os.environ.update(before)))
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):
            os.environ.pop(name, None)

    def test_a_picture_for_a_notebook(self):
        x, y = (0.04 * axis for axis in np.meshgrid([-1.0, 1.0], [-1.0, 1.0]))
        table = (np.stack([x.ravel(), y.ravel(), np.zeros(4)], axis=1), [[0, 1, 3, 2]])
        path = np.linspace([-0.02, 0.0, 0.004], [0.02, 0.0, -0.002], 2500)
        t = vtkhaptics.trace(table, path)
        picture = vtkhaptics.picture_of(table, t, size=(320, 240))
        self.assertEqual(size_of(picture._repr_png_()), (320, 240))
        plain = vtkhaptics.picture_of(table, size=(320, 240))
        self.assertNotEqual(picture.png, plain.png)
        with tempfile.TemporaryDirectory() as folder:
            picture.save(os.path.join(folder, "table.png"))
            self.assertEqual(os.path.getsize(os.path.join(folder, "table.png")), len(picture.png))
        with self.assertRaisesRegex(vtkhaptics.HapticsError, "no array 'Nothing'"):
            vtkhaptics.picture_of(table, scalars="Nothing")

    def test_a_picture_of_a_file_has_its_name(self):
        with tempfile.TemporaryDirectory() as folder:
            pictures = []
            for name in ("surface.off", "a part of another name.off"):
                path = os.path.join(folder, name)
                with open(path, "w") as file:
                    file.write(TABLE)
                pictures.append(vtkhaptics.picture_of(path, size=(320, 240)).png)
            self.assertNotEqual(*pictures)
            missing = os.path.join(folder, "missing.off")
            with self.assertRaisesRegex(vtkhaptics.HapticsError, "missing.off: there is no such file"):
                vtkhaptics.picture_of(missing)
        with self.assertRaisesRegex(SurfaceError, "'': there is no such file"):
            vtkhaptics.picture_of("")  # not the folder where it runs

    def run_example(self, name, *arguments, **environment):
        return subprocess.run(
            [sys.executable, os.path.join(EXAMPLES, name), *arguments],
            env={**HEADLESS, **environment}, capture_output=True, text=True, timeout=300,
        )

    def test_an_example_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "stroke.png")
            done = self.run_example("scripted_stroke.py", file)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(file, "rb") as png:
                size_of(png.read())

    def test_windows_one_after_another_are_drawn(self):
        script = """
from vtkhaptics.display import ensure_script_display
ensure_script_display()
from vtkmodules.vtkRenderingCore import vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2
for _ in range(30):
    window = vtkRenderWindow()
    window.SetSize(50, 50)
    window.Render()
    del window  # its connection to the display ends with it
"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "windows.py")
            with open(path, "w") as file:
                file.write(script)
            done = subprocess.run([sys.executable, path], env=HEADLESS, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_signal_ends_the_viewer_in_order_and_leaves_no_process(self):
        for number, status in ((signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGINT, 130)):
            with tempfile.TemporaryDirectory() as folder:
                surface, trace = (os.path.join(folder, name) for name in ("table.off", "trace.vtp"))
                with open(surface, "w") as file:
                    file.write(TABLE)
                mark = f"HAPTICS_TEST_FOLDER={folder}"
                # Surface and window are soon ready; how long the hand is on its way then depends on the machine.
                for wait in (2.0, 1.2, 0.7, 0.4):
                    program = subprocess.Popen(
                        [sys.executable, "-m", "vtkhaptics", surface, "--offscreen", "--seconds", "600",
                         "--trace", trace],
                        env={**HEADLESS, "HAPTICS_TEST_FOLDER": folder}, stdout=subprocess.PIPE, text=True,
                        preexec_fn=default_signals)
                    self.assertIn("triangles", program.stdout.readline())
                    time.sleep(wait)
                    if program.poll() is None:
                        break
                    program.stdout.close()
                    self.assertEqual(program.returncode, 0)
                    os.remove(trace)
                self.assertIsNone(program.poll(), "the stroke has ended")
                program.send_signal(number)
                self.assertEqual(program.wait(60), status)
                self.assertGreater(os.path.getsize(trace), 1000)
                program.stdout.close()
                wait_for(lambda mark=mark: not processes_with(mark), 20.0, "the end of what it started")

    def test_what_is_missing_is_said(self):
        if not needs_display():
            self.skipTest("this VTK draws without a display")
        folder = os.path.dirname(sys.executable)
        if os.path.exists(os.path.join(folder, "xvfb-run")):
            done = self.run_example("scripted_stroke.py", PATH="/nonexistent")
        else:
            done = self.run_example("scripted_stroke.py", PATH=folder)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("apt-get install xvfb", done.stderr)


if __name__ == "__main__":
    unittest.main()
