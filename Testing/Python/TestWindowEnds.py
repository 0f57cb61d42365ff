"""A window ends by q, e, its close button and Ctrl-C: in two seconds, with its results written. Programs
that write results end so by SIGTERM and SIGHUP as well, whenever those come.

Real keys, a real window manager, real processes. usage: TestWindowEnds.py [C++ PROGRAM]
"""

import fcntl
import gzip
import os
import signal
import subprocess
import sys
import tempfile
import termios
import time

import vtkmodules.vtkCommonCore  # noqa: F401  (before PyVista, so that it takes the same VTK)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import plot_program
from real_window import Desktop, Program, default_signals, skip_where_it_cannot_run, wait_for_servo

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
PROGRAM_WAYS = {
    **WAYS,
    "SIGTERM": (lambda program: program.process.send_signal(signal.SIGTERM), 143),
    "SIGHUP": (lambda program: program.process.send_signal(signal.SIGHUP), 129),
}


def end(program, way, name):
    act, status = PROGRAM_WAYS[way]
    program.focus()
    began = time.monotonic()
    act(program)
    found = program.ended(20.0)  # a busy machine takes its time; what it was is printed
    took = time.monotonic() - began
    assert found == status, (program.command, way, found, program.output())
    assert "Traceback" not in program.output(), program.output()
    print(f"{name}: {way}: {found} after {took:.2f} s", flush=True)


def test_viewer(desktop, folder):
    for number, way in enumerate(PROGRAM_WAYS):
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
        *((way, 60, "touching for") for way in PROGRAM_WAYS), ("q", 2, "trace: "), ("close button", 2, "trace: "),
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


# The viewer, which sends itself a signal at a step of its way to the window: real signals, which reach
# Python where VTK calls it, as those of a person do.
AT_A_STEP = """
import os, sys
from vtkhaptics import detail, progress, surfaces, viewer

number, step = int(sys.argv.pop(1)), sys.argv.pop(1)
own = {"reads": (progress.ProgressBar, "show"), "draws": (detail.DetailSwitch, "_on_end"),
       "tries": (surfaces, "try_apart"), "builds": (viewer.Viewer, "_update"), "connects": (viewer.Viewer, "connect"),
       "steps": (viewer.Viewer, "_step"), "writes": (viewer, "save_window")}[step]
before = getattr(*own)

def after(*arguments, **more):
    os.kill(os.getpid(), number)
    return before(*arguments, **more)

setattr(*own, after)
sys.exit(viewer.main())
"""


def test_signals_on_the_way_to_the_window(desktop, folder):
    script = os.path.join(folder, "step.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(AT_A_STEP)
    temporary = os.path.join(folder, "temporary")
    os.mkdir(temporary)
    packed = ball(folder) + ".gz"
    with open(ball(folder), "rb") as plain, gzip.open(packed, "wb") as file:
        file.write(plain.read())
    environment = {**desktop.environment, "TMPDIR": temporary}
    for step in ("tries", "reads", "draws", "builds", "connects", "steps", "writes"):
        more = ("--offscreen", "--seconds", "2") if step in ("steps", "writes") else ()
        results = [os.path.join(folder, f"{step}.{kind}") for kind in ("vtp", "png")]
        for number, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)):
            done = subprocess.run(
                [sys.executable, script, str(int(number)), step, packed, "--trace", results[0], "--screenshot",
                 results[1], "--size", "200", "150", *more],
                env=environment, preexec_fn=default_signals, capture_output=True, text=True, check=False, timeout=60.0)
            said = step, number, done.returncode, done.stdout, done.stderr
            assert done.returncode == status and done.stderr == "", said
            written = [os.path.exists(result) for result in results]
            assert written == [bool(more)] * 2, said
            assert os.listdir(temporary) == [], said
            for result in filter(os.path.exists, results):
                os.remove(result)


def test_a_terminal_that_is_closed(desktop, folder, unbuffered):
    results = [os.path.join(folder, f"closed{unbuffered}.{kind}") for kind in ("vtp", "png", "csv")]
    terminal, inner = os.openpty()

    def lead():  # the terminal's session, as `xterm -e` has it
        default_signals()
        os.setsid()
        fcntl.ioctl(inner, termios.TIOCSCTTY, 0)

    program = subprocess.Popen(
        [sys.executable, "-m", "vtkhaptics", ball(folder), "--size", "400", "300", "--trace", results[0],
         "--screenshot", results[1], "--landmarks", results[2]],
        env={**desktop.environment, "PYTHONUNBUFFERED": unbuffered}, stdin=inner, stdout=inner, stderr=inner, preexec_fn=lead)
    os.close(inner)
    said = b""
    while b"triangles" not in said:  # what it writes has nowhere to go later
        said += os.read(terminal, 1024)
    desktop.xdo("search", "--sync", "--onlyvisible", "--name", "VTK Haptics")
    wait_for_servo(program)
    time.sleep(1.0)
    os.close(terminal)
    assert program.wait(30.0) == 129
    for result in results:
        assert os.path.getsize(result) > 0, result


def test_a_reader_that_goes(desktop, folder):
    """`| head -1`: the pipe's other end is closed while the window is open."""
    for unbuffered in ("", "1"):
        for act, status in (("q", 0), (signal.SIGINT, 130), (signal.SIGTERM, 143)):
            stem = os.path.join(folder, f"unread{unbuffered}{status}")
            surface = ball(folder)
            for command, results, began in (
                (["vtkhaptics", surface, "--size", "400", "300", "--trace", stem + ".vtp", "--screenshot",
                  stem + ".png", "--landmarks", stem + ".csv"], [stem + ".vtp", stem + ".png", stem + ".csv"],
                 b"triangles"),
                (["vtkhaptics.demo", "--surface", surface, "--output", stem, "--seconds", "60"],
                 [os.path.join(stem, name) for name in ("trace.vtp", "touched.png")], b"touching"),
            ):
                errors = tempfile.TemporaryFile()
                program = subprocess.Popen(
                    [sys.executable, "-m", *command], env={**desktop.environment, "PYTHONUNBUFFERED": unbuffered},
                    stdout=subprocess.PIPE, stderr=errors, preexec_fn=default_signals)
                said = b""
                while began not in said:
                    said += os.read(program.stdout.fileno(), 1024)
                program.stdout.close()
                window = desktop.xdo("search", "--sync", "--onlyvisible", "--name", "VTK Haptics").split()[-1]
                wait_for_servo(program)
                time.sleep(1.0)
                if act == "q":
                    desktop.xdo("mousemove", "--window", window, "200", "150")
                    desktop.xdo("windowfocus", "--sync", window)
                    desktop.xdo("key", "q")
                else:
                    program.send_signal(act)
                found = program.wait(30.0)
                errors.seek(0)
                assert found == status and errors.read() == b"", (command, act, found)
                errors.close()
                for result in results:
                    assert os.path.getsize(result) > 0, (act, result)


def test_nohup(desktop, folder):
    program = desktop.start(
        ["nohup", sys.executable, "-m", "vtkhaptics", ball(folder), "--size", "400", "300"])
    program.engages()
    program.process.send_signal(signal.SIGHUP)
    time.sleep(1.0)
    assert program.process.poll() is None, (program.process.returncode, program.output())
    end(program, "SIGTERM", "viewer under nohup")


skip_where_it_cannot_run()
with Desktop() as screen, tempfile.TemporaryDirectory() as scratch:
    test_style(screen, scratch)
    test_interrupt_on_the_way_into_the_event_loop(screen, scratch)
    test_viewer(screen, scratch)
    test_signals_on_the_way_to_the_window(screen, scratch)
    for is_unbuffered in ("", "1"):
        test_a_terminal_that_is_closed(screen, scratch, is_unbuffered)
    test_a_reader_that_goes(screen, scratch)
    test_nohup(screen, scratch)
    test_demo(screen, scratch)
    if len(sys.argv) > 1:
        test_cxx(screen, scratch)
