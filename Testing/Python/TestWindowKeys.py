"""Keys do what people type, on keyboards of many countries, and a held space bar is one contact."""

import json
import os
import sys
import tempfile
import time

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

import plot_program
from real_window import Desktop, skip_where_it_cannot_run, wait_for

HAND = os.path.join(os.path.dirname(__file__), "hand_program.py")  # the viewer, which notes what it hears

# By the numbers of the keys: by name some releases of xdotool hold Alt with them.
KEYPAD_PLUS, KEYPAD_MINUS = "86", "82"

# Prints, whenever they change, whether the help is shown and how far the hand goes.
PLOT = plot_program.PLOT + """
home = touch.scene.GetWorkspaceTransform().Determinant()
said = None

def say(*_):
    global said
    scale = touch.scene.GetWorkspaceTransform().Determinant() / home
    now = touch.style.GetView().GetOverlay().GetShowHelp(), round(scale ** (1.0 / 3.0), 3)
    if now != said:
        said = now
        print(*now, flush=True)

shown = None

def say_status(*_):
    global shown
    status = touch.style.GetView().GetOverlay().GetStatus()
    if status != shown:
        shown = status
        print("status:", status, flush=True)

interactor.AddObserver("TimerEvent", say, 5.0)
interactor.AddObserver("TimerEvent", say_status, 5.0)
interactor.Start()
"""


def lines(program):
    return [line for line in program.output().splitlines() if line.startswith(("True", "False"))]


def test_shifted_keys_and_keypads(desktop, folder):
    script = os.path.join(folder, "plot.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(PLOT)
    program = desktop.start([sys.executable, script])
    program.focus()
    program.says("False 1.0")
    count = len(lines(program))
    for layout in ("us", "gb", "de", "fr", "be", "it", "es", "dk", "se"):
        desktop.layout(layout)
        for key, right in (
            ("question", "True 1.0"), ("question", "False 1.0"),
            ("plus", "False 1.25"), ("minus", "False 1.0"),
            (KEYPAD_PLUS, "False 1.25"), ("plus", "False 1.562"), ("0", "False 1.0"),
            (KEYPAD_MINUS, "False 0.8"), (KEYPAD_PLUS, "False 1.0"),
        ):
            program.key(key)
            count += 1
            wait_for(
                lambda: len(lines(program)) >= count, 20.0, f"{key} on a keyboard of '{layout}'")
            assert lines(program)[count - 1] == right, (layout, key, lines(program))
    desktop.layout("us")
    program.key("F1")
    program.says("True 1.0")
    program.key("ctrl+q")  # no command
    program.key("q")
    assert program.ended(20.0) == 0


def test_a_key_says_what_it_did(desktop, folder):
    script = os.path.join(folder, "plot.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(PLOT)
    program = desktop.start([sys.executable, script])
    program.focus()
    program.says("status: in free space")

    def statuses():
        return [line for line in program.output().splitlines() if line.startswith("status: ")]

    rest = statuses()[-1]
    for key, words in (
        ("o", "surface hides the hand|hand is seen through"), ("o", "surface hides the hand|hand is seen through"),
        ("b", "trail: off|trail: on"), ("b", "trail: off|trail: on"), ("t", "touched triangles: on"),
        ("t", "touched triangles: off"), ("g", "colours of the force: on"), ("g", "colours of the force: off"),
        ("plus", "farther: 10 mm move the hand by "), ("plus", "farther: 10 mm move the hand by "),
        ("minus", "less far: 10 mm move the hand by "), ("0", "as far as at first: 10 mm move the hand by "),
        ("v", "fitted to the view"),
    ):
        count = len(statuses())
        program.key(key)
        wait_for(lambda count=count: len(statuses()) > count, 20.0, f"a word on {key}")
        assert any(word in statuses()[count] for word in words.split("|")), (key, statuses())
    assert len(set(statuses())) >= 13, "every other press says something else"
    wait_for(lambda: statuses()[-1] == rest, 20.0, "the state again")
    program.key("plus")
    program.key("c")
    program.says("status: clutched")  # at once, in the place of the words
    program.key("q")
    assert program.ended(20.0) == 0


def test_a_held_space_bar_is_one_contact(desktop, folder):
    source = vtkSphereSource()
    source.SetThetaResolution(200)  # takes a while to draw: events must not queue up behind it
    source.SetPhiResolution(200)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(folder, "ball.vtp"))
    assert writer.Write() == 1
    for size in ((1200, 800), (200, 150)):
        trace, notes = os.path.join(folder, "held.vtp"), os.path.join(folder, f"notes{size[0]}")
        program = desktop.start(
            [sys.executable, HAND, notes, writer.GetFileName(), "--trace", trace, "--size", *map(str, size)])

        def noted(text, notes=notes):
            if not os.path.exists(notes):
                return False
            with open(notes, encoding="utf-8") as file:
                return text in file.read()

        wait_for(lambda: noted("Picture"), 60.0, "the first picture of the hand")
        program.focus()
        desktop.xdo("keydown", "space")
        # A busy window gets to the key late: from then on it is held for so long.
        wait_for(lambda: noted("KeyPressEvent"), 30.0, "the window's event of the key")
        began = time.monotonic()
        time.sleep(3.0)
        desktop.xdo("keyup", "space")
        took = time.monotonic() - began
        time.sleep(1.0)
        program.key("q")
        assert program.ended(20.0) == 0, program.output()
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(trace)
        reader.Update()
        data = reader.GetOutput().GetPointData()
        touching = vtk_to_numpy(data.GetArray("ActiveConstraints")) > 0
        ticks = vtk_to_numpy(data.GetArray("Time"))
        begins = int((touching[1:] & ~touching[:-1]).sum())
        held = ticks[touching]
        print(f"{size}: {begins} contact, {held[-1] - held[0]:.2f} s of {took:.2f} s", flush=True)
        assert begins == 1, begins
        # It ends with the key, not when a queue of old events is empty: within some pictures.
        with open(notes, encoding="utf-8") as file:
            events = [json.loads(line) for line in file][1:]
        pictures = [event["tick"] for event in events if event["event"] == "Picture"]
        longest = max(b - a for a, b in zip(pictures, pictures[1:])) / 1000.0
        assert took - 1.0 < held[-1] - held[0] < took + 0.5 + 3.0 * longest, (took, longest, held[-1] - held[0])


skip_where_it_cannot_run()
with Desktop() as screen, tempfile.TemporaryDirectory() as scratch:
    test_shifted_keys_and_keypads(screen, scratch)
    test_a_key_says_what_it_did(screen, scratch)
    test_a_held_space_bar_is_one_contact(screen, scratch)
