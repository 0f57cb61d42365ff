"""Touches in ParaView's real window, with a user's mouse and keys: Wavelet, Contour, Touch, hover, press.

Run by Python with the plugin's file. ParaView itself reports what the hand does, as State has it.
"""

import os
import re
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
import real_window
import window_scene

PLUGIN, PARAVIEW = sys.argv[1:]
SECONDS = 60.0

# What the view shows.
SHOWN = """
def print_shown():
    drawn = [display.Input.SMProxy for display in view.Representations if hasattr(display, "Input")
             and display.Visibility]
    print("SHOWN", *sorted(name for (name, _), source in GetSources().items() if source.SMProxy in drawn))
"""

SCENE = window_scene.scene(
    SHOWN + """

import os
import time

from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

BUSY = os.path.join(os.environ["HOME"], "busy")
depth = vtkImplicitPolyDataDistance()  # how far outside of the contour
depth.SetInput(servermanager.Fetch(contour))


def show(hand):
    if os.path.exists(BUSY):
        print("BUSY")
        while os.path.exists(BUSY):  # the window gets to nothing
            time.sleep(0.01)
    cells = contour.SMProxy.GetSelectionInput(0)
    curves = [source for (name, _), source in GetSources().items() if name.startswith("HapticCurves")]
    data = curves[0].GetDataInformation() if curves else None
    points = sum(source.GetDataInformation().GetNumberOfPoints() for source in curves)
    if data:
        arrays = data.GetPointDataInformation()
        print("ALONG", *sorted(arrays.GetArrayInformation(i).GetName()
                               for i in range(arrays.GetNumberOfArrays())))
    selection = cells and cells.GetProperty("Input").GetProxy(0)
    ids = selection and selection.GetProperty("IDs")
    if ids:
        print("PAINTED", *sorted(ids.GetElement(i) for i in range(1, ids.GetNumberOfElements(), 2)))
    print("OUTSIDE", depth.EvaluateFunction(hand.HapticInterfacePoint))
    print_shown()
    print(f"STATE {hand.State} | {hand.ForceMagnitude:.3f} | {hand.NumberOfLandmarks}"
          f" | {cells is not None} | {list(hand.HapticInterfacePoint)}"
          f" | {points}")
"""
)

# Its value of the stiffness, and how many pixels have the colour of landmarks' balls.
VALUES = window_scene.scene("""
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray


def ball_pixels():
    window = view.GetRenderWindow()
    width, height = window.GetSize()
    pixels = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
    red, green, blue = vtk_to_numpy(pixels).reshape(-1, 3).T.astype(int)
    return int(((green > 100) & (green > 2 * red) & (blue > green)).sum())


def show(hand):
    print("STIFFNESS", hand.Stiffness)
    if hand.NumberOfLandmarks:
        print("BALLS", ball_pixels())
    print(f"STATE {hand.State} | {hand.ForceMagnitude:.3f} | {hand.NumberOfLandmarks} | False | [] | 0")
""")

# A view in which nothing is shown yet.
EMPTY = window_scene.PRINT + """
from paraview import servermanager
from paraview.simple import *

view = GetActiveViewOrCreate("RenderView")

""" + SHOWN + """

def report(*_):
    print_shown()
    proxy = servermanager.ProxyManager().GetProxy("haptics", "HapticScene")
    if proxy:
        proxy.UpdatePropertyInformation()
        print(f"STATE {servermanager._getPyProxy(proxy).State} | 0 | 0 | False | [] | 0")


view.GetRenderWindow().AddObserver("EndEvent", report)
Render()
print("READY")
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

    def painted(self):
        """The cells that are selected, in a text."""
        return (re.findall(r"^PAINTED (.*)$", self.program.output(), re.M) or [""])[-1]

    def outside(self):
        """How far the hand is outside of the contour [world unit]; its bounds are 20 wide."""
        return float(re.findall(r"^OUTSIDE (.*)$", self.program.output(), re.M)[-1])

    def shown(self):
        """The names of the sources that the view shows."""
        return re.findall(r"^SHOWN(.*)$", self.program.output(), re.M)[-1].split()

    def says(self, name):
        """The last that ParaView has said under a name, as a number."""
        return float((re.findall(rf"^{name} (.*)$", self.program.output(), re.M) or ["nan"])[-1])

    def wait_shown(self, *names):
        real_window.wait_for(lambda: self.shown() == list(names), SECONDS, f"{names}; shown is {self.shown()}")

    def wait(self, condition, what):
        real_window.wait_for(lambda: condition(*self.state()), SECONDS, f"{what}; it is {self.state()}")

    def settle(self):
        """Waits until ParaView has got to all that the mouse and the keys have done, by a landmark after it; and by
        another one to what it does a little later, as the end of a held key."""
        for _ in range(2):
            dropped = self.state()[2]
            end = pressed = time.monotonic()
            while self.state()[2] <= dropped:
                assert time.monotonic() < end + SECONDS, f"no landmark; it is {self.state()}"
                if time.monotonic() >= pressed:
                    self.program.key("l")  # which does nothing where nothing is touched just then
                    pressed += 5.0
                time.sleep(0.05)
            time.sleep(0.3)


def hover_and_turn_the_wheel(desktop, program, hand):
    """The hand is over the surface under the mouse; the wheel presses by a notch, and lets go by as many."""
    def free(state, force, *_):
        return state == "Engaged, in free space" and force == 0.0 and 0.0 < hand.outside() < 0.5

    def pressed(least, most):
        return lambda state, force, *_: state == "Engaged, touching Contour1" and least < force < most

    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    hand.wait(free, "a hand that hovers")
    before = hand.state()[4]
    program.drag(0.50, 0.71)
    hand.wait(lambda *state: state[4] != before and free(*state), "a hand that hovers elsewhere")
    program.move(0.32, 0.30)
    hand.wait(lambda state, *_: state == "Engaged, waiting: move the mouse over a surface",
              "a mouse that is over nothing")
    program.move(0.49, 0.71)
    program.drag(0.47, 0.71)
    hand.wait(free, "a hand that hovers again")
    desktop.xdo("click", "4")
    hand.wait(pressed(0.3, 0.7), "a notch of the wheel to press")
    desktop.xdo("click", "--repeat", "2", "--delay", "100", "4")
    hand.wait(pressed(1.2, 1.8), "three notches to press harder")
    # Over the contour's open end, and back: it never gets deeper in than it is pressed.
    for x, y in ((0.44, 0.65), (0.47, 0.60), (0.50, 0.65), (0.47, 0.71)):
        program.drag(x, y)
        assert hand.outside() > -2.0, hand.outside()
    hand.wait(pressed(1.2, 1.8), "the same press afterwards")
    desktop.xdo("click", "--repeat", "3", "--delay", "100", "5")
    hand.wait(free, "as many notches back to let go")


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
    hover_and_turn_the_wheel(desktop, program, hand)
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

    # A brush: it paints as long as its key is held, and each stroke anew.
    before = hand.painted()
    time.sleep(0.2)  # a press within 10 ms of a release is the keyboard's repetition
    desktop.xdo("keydown", "p")
    program.drag(0.50, 0.71)
    real_window.wait_for(lambda: hand.painted() != before, SECONDS, "other painted cells")
    desktop.xdo("keyup", "p")
    hand.settle()
    before = hand.painted()
    program.drag(0.49, 0.72)
    program.drag(0.46, 0.70, seconds=2.0)
    hand.settle()
    assert hand.painted() == before, (before, hand.painted())

    # The clutch by its key: no force, the hand stays; and back.
    program.key("k")
    hand.wait(lambda state, force, *_: state == "Engaged, clutched: nothing is touched" and force == 0.0,
              "the clutch")
    program.key("k")
    program.drag(0.48, 0.71)
    hand.wait(lambda state, force, *_: state == "Engaged, touching Contour1" and force > 0.1,
              "contact after the clutch")

    # And as long as its key is held.
    desktop.xdo("keydown", "k")
    hand.wait(lambda state, *_: state == "Engaged, clutched: nothing is touched", "the held clutch")
    time.sleep(1.0)  # longer than a short press, which would leave it on
    desktop.xdo("keyup", "k")
    hand.wait(lambda state, *_: state != "Engaged, clutched: nothing is touched", "the end of the held clutch")
    program.drag(0.47, 0.71)
    hand.wait(lambda state, force, *_: state == "Engaged, touching Contour1" and force > 0.1,
              "contact after the held clutch")

    # How long it is held is what the keyboard says, not when a busy window gets to it.
    before = hand.state()[4]
    busy = os.path.join(os.environ["HOME"], "busy")
    with open(busy, "w"):
        program.drag(0.475, 0.71)  # a picture, at which it begins
        real_window.wait_for(lambda: "BUSY" in program.output(), SECONDS, "the window to be busy")
    desktop.xdo("keydown", "k")
    time.sleep(1.0)
    desktop.xdo("keyup", "k")
    os.remove(busy)
    program.drag(0.48, 0.71)
    hand.settle()  # which needs contact
    assert hand.state()[4] != before, before

    # A stroke becomes a curve, a source of its own, with the surface's arrays along it.
    program.key("c")
    hand.settle()
    program.drag(0.46, 0.70)
    hand.settle()
    program.key("c")
    hand.wait(lambda *state: state[-1] > 1, "a curve")
    along = re.findall(r"^ALONG (.*)$", program.output(), re.M)[-1].split()
    assert {"ForceMagnitude", "Time", "arc_length", "RTData"} <= set(along), along
    # A brush for curves too: a second one, while the key is held.
    points = hand.state()[-1]
    desktop.xdo("keydown", "c")
    program.drag(0.48, 0.71, seconds=2.0)
    hand.settle()
    desktop.xdo("keyup", "c")
    hand.wait(lambda *state: state[-1] > points, "a curve by a held key")
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
    # Also while the mouse is outside of the view, at a button of the panel for example.
    program.move(0.5, 0.02)
    time.sleep(0.5)
    assert hand.state()[1] > 1.0, hand.state()
    dropped = hand.state()[2]
    program.key("l")
    hand.wait(lambda state, force, landmarks, *_: landmarks > dropped and force > 1.0, "another landmark")
    program.key("shift+p")
    hand.wait(lambda state, force, *_: force == 0.0, "Press to let go")

    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state == "Released", "Touch to release")
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch to engage again")

    # Clip hides what it clips, as it always does; the hand waits for what can be touched to be shown again.
    program.key("ctrl+space")
    real_window.wait_for(lambda: desktop.xdo("getwindowfocus") != program.window, SECONDS, "the search of filters")
    desktop.type("Clip")
    time.sleep(0.5)
    program.key("shift+Return")
    hand.wait(lambda state, *_: state == "Engaged, waiting: nothing that can be touched is shown",
              "a clip of what is touched")
    assert "Clip1" in hand.shown() and "Contour1" not in hand.shown(), hand.shown()
    program.key("ctrl+z")
    hand.wait(lambda state, *_: "Contour1" in hand.shown(), "undo")
    program.key("ctrl+shift+e")
    hand.wait(lambda state, *_: state == "Released", "Engage to release")


def touch_what_is_applied_again(desktop, program):
    """A source is made, touched, and undone to before it was applied; applied again it can be touched again."""
    hand = Hand(program)
    program.says("READY", SECONDS)
    program.key("ctrl+space")
    real_window.wait_for(lambda: desktop.xdo("getwindowfocus") != program.window, SECONDS, "the search of sources")
    desktop.type("Sphere")
    time.sleep(0.5)
    program.key("shift+Return")
    time.sleep(1.0)
    program.key("alt+a")
    hand.wait_shown("Sphere1")
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch")
    program.key("ctrl+z")  # Touch
    time.sleep(2.0)
    program.key("ctrl+z")  # Apply
    hand.wait_shown()
    program.key("alt+a")
    hand.wait_shown("Sphere1")
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch of what is applied again")


# Where ParaView 5.11 and later ones (5.13, 6.1) put what is clicked on: in widths and heights of ParaView's window.
PLACES = {
    "5.11": {"stiffness": (0.851, 0.481), "Fit": (0.672, 0.785), "contour": (0.07, 0.286), "search": (0.10, 0.596),
          "material's stiffness": (0.158, 0.841)},
    "later": {"stiffness": (0.833, 0.450), "Fit": (0.688, 0.728), "contour": (0.064, 0.276), "search": (0.137, 0.611),
          "material's stiffness": (0.158, 0.841)},
}


def click(desktop, program, name):
    version = desktop.xdo("getwindowname", program.window).split()[1]
    program.move(*PLACES["5.11" if version.startswith("5.11.") else "later"][name])
    desktop.xdo("click", "1")


def type_stiffness(desktop, program, value, *keys):
    """Clicks into the panel's box, types a value and keys, and goes over the contour."""
    click(desktop, program, "stiffness")
    for key in ("ctrl+a", *value, *keys):
        program.key(key)
        time.sleep(0.1)
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)


def press_after_other_widgets(desktop, program):
    """The space bar presses under the mouse after a value, a button and a name had the keyboard; a name has its own."""
    def press(force, what):
        time.sleep(0.3)
        desktop.xdo("keydown", "space")
        hand.wait(lambda state, now, *_: state.startswith("Engaged, touching") and abs(now - force) < 0.1, what)
        desktop.xdo("keyup", "space")
        hand.wait(lambda state, now, *_: state == "Engaged, in free space", f"letting go {what}")

    hand = Hand(program)
    program.says("READY", SECONDS)
    program.focus()
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch to engage")
    # What it presses by is 3 mm.
    type_stiffness(desktop, program, "742", "Return")
    press(2.226, "after a value and Return")
    type_stiffness(desktop, program, "613")
    press(1.839, "while a value is typed")

    click(desktop, program, "Fit")
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    press(1.839, "while a button has the keyboard")

    # A name is typed with its spaces wherever the mouse is.
    click(desktop, program, "contour")
    time.sleep(0.5)
    program.key("F2")
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    desktop.type("My Bone")
    program.key("Return")
    program.drag(0.48, 0.71)
    press(1.839, "after a name")
    assert "Engaged, touching My Bone" in program.output(), program.output()

    # A material's value in the Properties panel, and Return: the keyboard is the hand's, wherever the mouse is.
    click(desktop, program, "search")  # which shows it
    desktop.type("haptic prop")
    time.sleep(1.0)
    click(desktop, program, "material's stiffness")
    for key in ("ctrl+a", *"400", "Return"):
        program.key(key)
        time.sleep(0.1)
    time.sleep(0.5)
    program.key("k")
    hand.wait(lambda state, *_: state == "Engaged, clutched: nothing is touched", "the clutch by its key")
    time.sleep(0.5)  # or it may pass for the first one, held
    program.key("k")
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    press(1.2, "with a value of the material")


def see_landmarks(desktop, program):
    """A landmark has a ball in the picture, of the size that it has in the viewer."""
    hand = Hand(program)
    program.says("READY", SECONDS)
    program.focus()
    program.key("ctrl+shift+t")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "Touch to engage")
    program.move(0.46, 0.70)
    program.drag(0.47, 0.71)
    desktop.xdo("keydown", "space")
    hand.wait(lambda state, force, *_: force > 1.0, "contact")
    program.key("l")
    hand.wait(lambda state, force, landmarks, *_: landmarks == 1, "a landmark")
    program.drag(0.42, 0.71)
    desktop.xdo("keyup", "space")
    hand.wait(lambda state, force, *_: force == 0.0, "letting go")
    real_window.wait_for(lambda: hand.says("BALLS") > 20, SECONDS, "the landmark's ball")


def touch_one_example_after_another(desktop, program):
    """Each is seen alone, and touched; undo brings back what the view showed before."""
    def choose(number):
        for key in ("alt+h", "Left", "Up", "Right", *["Down"] * number, "Return"):
            program.key(key)
            time.sleep(0.5)

    def press(name):
        program.move(0.46, 0.40)
        program.drag(0.46, 0.55)
        desktop.xdo("keydown", "space")
        hand.wait(lambda state, *_: state == f"Engaged, touching {name}", f"contact with {name}")
        desktop.xdo("keyup", "space")

    hand = Hand(program)
    program.says("READY", SECONDS)
    program.focus()
    choose(0)
    hand.wait_shown("Contour1")
    hand.wait(lambda state, *_: state.startswith("Engaged"), "the first example to be touched")
    choose(1)
    hand.wait_shown("Elevation1")
    press("Elevation1")
    choose(2)
    hand.wait_shown("GodObjectFilter1")
    press("GodObjectFilter1")
    program.key("ctrl+z")
    hand.wait_shown("Elevation1")


def run(scene, test):
    with window_scene.home(scene) as (_, script), real_window.Desktop() as desktop:
        program = desktop.start([PARAVIEW, "--dr", f"--plugin-search-paths={os.path.dirname(PLUGIN)}",
                                 "--plugins=Haptics", f"--script={script}"], "ParaView", SECONDS)
        try:
            test(desktop, program)
        except AssertionError:
            print(program.output())
            raise
        program.process.terminate()


def main():
    real_window.skip_where_it_cannot_run()
    run(SCENE, touch_a_contour)
    run(EMPTY, touch_what_is_applied_again)
    run(VALUES, press_after_other_widgets)
    run(VALUES, see_landmarks)
    run(EMPTY, touch_one_example_after_another)


main()
