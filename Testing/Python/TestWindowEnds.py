"""A window ends by q, e, its close button and Ctrl-C: in two seconds, with its results written.

Real keys, a real window manager, real processes. usage: TestWindowEnds.py [C++ PROGRAM]
"""

import os
import signal
import sys
import tempfile
import time

import vtkmodules.vtkCommonCore  # noqa: F401  (before PyVista, so that it takes the same VTK)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import plot_program
from real_window import Desktop, Program, skip_where_it_cannot_run

PLOT = plot_program.PLOT + """
import subprocess
if "--observed" in sys.argv:  # Python's own code runs in the event loop, and so signal handlers
    interactor.AddObserver("TimerEvent", lambda *_: None, 5.0)
print("ready", flush=True)
if "--interrupted" in sys.argv:  # by another process, some time after this
    subprocess.Popen(["sh", "-c", f"sleep {sys.argv[-1]}; kill -INT $PPID"])
interactor.Start()
print("ended", flush=True)
touch.disable()
print("left", touch.scene.IsEngaged(), flush=True)
"""


def ball(folder):
    source = vtkSphereSource()
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(folder, "ball.vtp"))
    assert writer.Write() == 1
    return writer.GetFileName()


# What a person does, and the exit status that is right then.
WAYS = {
    "q": (lambda program: program.key("q"), 0),
    "e": (lambda program: program.key("e"), 0),
    "close button": (lambda program: program.close_button(), 0),
    "Ctrl-C": (lambda program: program.interrupt(), 130),
}


def end(program, way, name):
    act, status = WAYS[way]
    program.focus()
    began = time.monotonic()
    act(program)
    found = program.ended(20.0)  # a busy machine takes its time; what it was is printed
    took = time.monotonic() - began
    assert found == status, (program.command, way, found, program.output())
    assert "Traceback" not in program.output(), program.output()
    print(f"{name}: {way}: {found} after {took:.2f} s", flush=True)


def test_viewer(desktop, folder):
    for number, way in enumerate(WAYS):
        results = [os.path.join(folder, f"{number}.{kind}") for kind in ("vtp", "png")]
        program = desktop.start(
            [sys.executable, "-m", "vtkhaptics", ball(folder), "--size", "400", "300",
             "--trace", results[0], "--screenshot", results[1]])
        program.engages()
        time.sleep(1.0)  # something to record
        end(program, way, "viewer")
        for result in results:
            assert os.path.getsize(result) > 1000, (way, result, program.output())


def test_demo(desktop, folder):
    # In the middle of a stroke that would go on for longer than end() waits, and after a short one.
    for number, (way, seconds, begun) in enumerate([
        *((way, 60, "touching for") for way in WAYS), ("q", 2, "trace: "), ("close button", 2, "trace: "),
    ]):
        output = os.path.join(folder, f"demo{number}")
        program = desktop.start(
            [sys.executable, "-m", "vtkhaptics.demo", "--surface", ball(folder), "--output", output,
             "--seconds", str(seconds), "--stay"])
        program.says(begun)
        time.sleep(0.5)
        end(program, way, f"demo --seconds {seconds} --stay")
        for result in ("trace.vtp", "touched.png"):
            assert os.path.getsize(os.path.join(output, result)) > 1000, (way, program.output())


def test_style(desktop, folder):
    script = os.path.join(folder, "plot.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(PLOT)
    for way in WAYS:
        for more in ((), ("--observed",)):
            program = desktop.start([sys.executable, script, *more])
            program.says("ready")
            end(program, way, f"enable() {' '.join(more)}")
            assert ("left False" in program.output()) == (way != "Ctrl-C"), program.output()


def test_interrupt_on_the_way_into_the_event_loop(desktop, folder):
    script = os.path.join(folder, "plot.py")
    for milliseconds in (0, 1, 2, 3, 4, 6, 8, 16):
        command = [sys.executable, script, "--interrupted", str(0.001 * milliseconds)]
        program = Program(desktop, command, os.path.join(folder, "interrupted.log"))
        found = program.ended(60.0)
        # As Python does it where the script has not come to the event loop, or as that ends.
        assert found in (-signal.SIGINT, 130), (milliseconds, found, program.output())


def test_cxx(desktop, _folder):
    for way in WAYS:
        program = desktop.start([sys.argv[1]])
        end(program, way, "C++")
        assert "the event loop has ended" in program.output(), program.output()


skip_where_it_cannot_run()
with Desktop() as screen, tempfile.TemporaryDirectory() as scratch:
    test_style(screen, scratch)
    test_interrupt_on_the_way_into_the_event_loop(screen, scratch)
    test_viewer(screen, scratch)
    test_demo(screen, scratch)
    if len(sys.argv) > 1:
        test_cxx(screen, scratch)
