"""Touches in ParaView's real window, with a user's mouse and keys: Wavelet, Contour, Touch, hover, press.

Run by Python with the plugin's file. ParaView itself reports what the hand does, as State has it.
"""

import os
import re
import shutil
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
import real_window

PLUGIN, PARAVIEW = sys.argv[1:]
SECONDS = 60.0

# What a user does in the menus before, and what the test reads afterwards.
SCENE = """
from paraview import servermanager
from paraview.simple import *

view = GetActiveViewOrCreate("RenderView")
contour = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
Show(contour, view)
SetActiveSource(contour)
ResetCamera()
Render()


def report(*_):
    proxy = servermanager.ProxyManager().GetProxy("haptics", "HapticScene")
    if proxy:
        hand = servermanager._getPyProxy(proxy)
        proxy.UpdatePropertyInformation()
        cells = contour.SMProxy.GetSelectionInput(0)
        curves = [source for (name, _), source in GetSources().items() if name.startswith("HapticCurves")]
        points = curves[0].GetDataInformation().GetNumberOfPoints() if curves else 0
        print(f"STATE {hand.State} | {hand.ForceMagnitude:.3f} | {hand.NumberOfLandmarks}"
              f" | {cells is not None} | {list(hand.HapticInterfacePoint)}"
              f" | {points}", flush=True)


view.SMProxy.AddObserver("EndEvent", report)
print("READY", flush=True)
"""


class Hand:
    """The last state that ParaView has reported."""

    def __init__(self, program):
        self.program = program

    def state(self):
        found = re.findall(r"^STATE (.*) \| (.*) \| (.*) \| (.*) \| (.*) \| (.*)$", self.program.output(), re.M)
        if not found:
            return "", 0.0, 0, False, "", 0
        name, force, landmarks, painted, place, points = found[-1]
        return name, float(force), int(landmarks), painted == "True", place, int(points)

    def wait(self, condition, what):
        """Moves the mouse by a pixel now and then, as a hand that waits does."""
        real_window.wait_for(lambda: condition(*self.state()), SECONDS, f"{what}; it is {self.state()}")


def touch_a_contour(desktop, program):
    hand = Hand(program)
    program.says("READY", SECONDS)
    real_window.wait_for(
        lambda: desktop.xdo("search", "--onlyvisible", "--name", "^ParaView"), SECONDS, "the window"
    )
    program.focus()
    # Keys alone: the keyboard is in the view afterwards, so that the space bar presses at once.
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch to engage")
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    desktop.xdo("keydown", "space")
    hand.wait(lambda state, force, *_: state == "Engaged, touching Contour1" and force > 1.0, "contact")

    program.key("l")
    hand.wait(
        lambda state, force, landmarks, *_: landmarks == 1 and force > 1.0,
        "a landmark without losing contact",
    )
    program.key("p")
    program.drag(0.48, 0.71)
    hand.wait(lambda state, force, landmarks, painted, *_: painted, "a painted cell")
    program.key("p")

    # A stroke becomes a curve, a source of its own.
    program.key("c")
    before = hand.state()[4]
    program.drag(0.46, 0.70)
    hand.wait(lambda *state: state[4] != before, "the stroke")
    program.key("c")
    hand.wait(lambda *state: state[-1] > 1, "a curve")
    desktop.xdo("keyup", "space")
    hand.wait(lambda state, force, *_: force == 0.0, "letting go")

    # The camera turns, the hand stays.
    before = hand.state()[4]
    desktop.xdo("mousedown", "1")
    program.drag(0.52, 0.72)
    during = hand.state()[4]
    desktop.xdo("mouseup", "1")
    assert during == before, (before, during)

    # Pressed by a key alone, without a held one.
    program.drag(0.46, 0.70)
    program.key("shift+p")
    hand.wait(lambda state, force, *_: force > 1.0, "Press to press")
    program.key("shift+p")
    hand.wait(lambda state, force, *_: force == 0.0, "Press to let go")

    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state == "Released", "Touch to release")


def main():
    real_window.skip_where_it_cannot_run()
    folder = tempfile.mkdtemp()
    script = os.path.join(folder, "scene.py")
    with open(script, "w") as file:
        file.write(SCENE)
    for place in ("HOME", "XDG_CONFIG_HOME", "HAPTICS_TEST_OUTPUT"):
        os.environ[place] = folder  # a user's settings and other tests' logs are not this test's
    command = [PARAVIEW, "--dr", f"--plugin-search-paths={os.path.dirname(PLUGIN)}",
               "--plugins=Haptics", f"--script={script}"]
    try:
        with real_window.Desktop() as desktop:
            program = desktop.start(command, "ParaView", SECONDS)
            try:
                touch_a_contour(desktop, program)
            except AssertionError:
                print(program.output())
                raise
            program.process.terminate()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


main()
