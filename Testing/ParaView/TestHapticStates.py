"""Saves states, a trace from the middle and a recording in ParaView's real window, by keys, and restores them.

Run by Python with the files of the plugin, paraview and pvpython, and 1 where the plugin has pages of help, else 0.
ParaView finds the package vtkhaptics by its plugin alone, as where that was loaded by hand.
"""

import os
import re
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
import real_window
import window_scene

PLUGIN, PARAVIEW, PVPYTHON, HAS_HELP = sys.argv[1:]
SECONDS = 60.0
REDO = "ctrl+y"  # Qt's on a plain X desktop
STIFFNESS = 321.0

# Labels and places of the landmarks, and the source that each was dropped on.
MARKED = """
def marked(hand):
    marks = hand.vtk.GetLandmarks()
    points = hand.landmarks().GetPoints()
    return [(marks.GetLabel(i), marks.GetLandmark(i).GetSurfaceName(), *(round(c, 6) for c in points.GetPoint(i)),
             round(marks.GetLandmark(i).GetValue("RTData"), 3)) for i in range(marks.GetNumberOfLandmarks())]
"""

SCENE = window_scene.scene(
    MARKED + """

def show(hand):
    print("STATE", hand.State, "|", hand.RecordingFileName)
    print("PLAYS", hand.Device)
    print("LANDMARKS", hand.NumberOfLandmarks, "|", round(hand.ForceMagnitude, 2))
    if hand.NumberOfLandmarks == 2:
        import vtkhaptics.paraview

        print("MARKED", marked(vtkhaptics.paraview.scene()))
""",
    before='settings = servermanager.ProxyManager().GetProxy("settings", "HapticSettings")\n'
    f"settings.Stiffness = {STIFFNESS}",
    properties='registrationName="Bone", ',
)

CHECK = f"""
import sys
import vtkhaptics.paraview as haptics
{MARKED}

kind, file = sys.argv[1:]
if kind == "pvsm":
    haptics.load_plugin({PLUGIN!r})
from paraview.simple import *

if kind == "trace":
    haptics.load_plugin({PLUGIN!r})
    view = GetActiveViewOrCreate("RenderView")
    bone = Contour(registrationName="Bone", Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
    Show(bone, view)
if kind == "pvsm":
    LoadState(file)
else:
    with open(file) as script:
        exec(compile(script.read(), file, "exec"), {{"__name__": "state"}})
hand = haptics.scene()
names = {{source.SMProxy: name for (name, _), source in GetSources().items()}}
hand.release()
print("RESTORED", hand.Stiffness, hand.Device, [names[shown.Input.SMProxy] for shown in hand.Surfaces],
      hand.View is not None)
hand.Device = "simulated"
hand.WorkspaceTransform = [0.0] * 16
hand.RecordTrace = 1
hand.step(1500)
print("MARKED", marked(hand))
print("ON", hand.landmarks().GetPointData().GetArray("Surface").GetRange() if hand.NumberOfLandmarks else None)
force = hand.trace().GetPointData().GetArray("Force")
print("TOUCHED", max(abs(component) for component in force.GetRange(-1)) > 1.0)
"""


def restored(kind, file, folder, marked):
    script = os.path.join(folder, "check.py")
    with open(script, "w") as written:
        written.write(CHECK)
    ended = subprocess.run(
        [PVPYTHON, "--force-offscreen-rendering", script, kind, file], timeout=120, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )
    assert ended.returncode == 0, (kind, ended.stdout)
    expected = f"RESTORED {STIFFNESS} mouse ['Bone'] True"
    assert expected in ended.stdout and "TOUCHED True" in ended.stdout, (kind, ended.stdout)
    if marked:
        assert f"MARKED {marked}\nON (0.0, 0.0)" in ended.stdout, (kind, marked, ended.stdout)


class User:
    """Menus and dialogs of ParaView, by keys."""

    def __init__(self, desktop, program):
        self.desktop, self.program = desktop, program

    def window(self, title):
        """Waits for a window, and for the keyboard to be there."""
        found = real_window.wait_for(
            lambda: self.desktop.xdo("search", "--onlyvisible", "--name", title, check=False), SECONDS, title
        ).split()[-1]
        self.desktop.xdo("windowactivate", "--sync", found)
        time.sleep(0.5)
        return found

    def is_open(self, title):
        return self.desktop.xdo("search", "--onlyvisible", "--name", title, check=False)

    def menu(self, *keys):
        for key in keys:
            self.program.key(key)
            time.sleep(0.5)

    def give(self, file):
        """A file to the dialog that has the keyboard; relative names would be those of a folder seen before."""
        self.desktop.type(file)
        time.sleep(0.5)
        self.program.key("Return")

    def load_script(self, file):
        """A Python state to the dialog of states. Where ParaView, as 5.13 and 6.1 do, takes but files of the type that
        is chosen, the dialog stays open: the next type is that of scripts."""
        title = "^Load State File"
        self.window(title)
        self.give(file)
        end = time.monotonic() + 10.0
        while self.is_open(title):
            if time.monotonic() > end:
                self.menu("Tab", "Down", "shift+Tab", "End", "BackSpace")
                self.give(file[-1])
                break
            time.sleep(0.1)

    def written(self, file):
        real_window.wait_for(lambda: os.path.isfile(file) and os.path.getsize(file) > 0, SECONDS, file)

    def main(self):
        self.window("^ParaView [0-9]")

    def toggle(self, state):
        """Engages or releases, and waits until the last that ParaView has said is so."""
        self.program.key("ctrl+shift+e")
        real_window.wait_for(
            lambda: self.program.output().rpartition("STATE ")[2].startswith(state), SECONDS, state
        )


def stops_traces(desktop, program):
    """Debian's ParaView 5.13.2 ends by SIGSEGV where any trace is stopped, in pqPythonSyntaxHighlighter."""
    if "5.13" not in desktop.xdo("getwindowname", program.window):
        return True
    print("No trace is tried: ParaView 5.13 itself ends where one is stopped.")
    return False


def save_trace(user, trace):
    """A trace that begins in the middle, and has all that was set before."""
    user.menu("alt+t", "Up", "Up", "Return")
    user.window("^Trace Options")
    user.program.key("Return")
    time.sleep(1.0)
    user.main()
    user.toggle("Released")
    user.toggle("Engaged")
    user.menu("alt+t", "Up", "Up", "Return")
    user.window("Script Editor")
    user.program.key("ctrl+s")
    user.window("^Save File")
    user.give(trace)
    user.written(trace)
    user.window("Script Editor")
    user.program.key("alt+F4")
    user.main()


def drop_landmarks(user):
    """Two, the last of which undo takes back, and redo brings again; what ParaView says of both."""
    def wait(number, what):
        real_window.wait_for(
            lambda: user.program.output().rpartition("LANDMARKS ")[2].startswith(f"{number} |"), SECONDS, what)

    user.program.move(0.46, 0.70)
    user.program.drag(0.47, 0.71)
    user.desktop.xdo("keydown", "space")
    for number, place in ((1, 0.50), (2, 0.44)):
        real_window.wait_for(
            lambda: float(re.findall(r"^LANDMARKS .* \| (.*)$", user.program.output(), re.M)[-1]) > 0.5,
            SECONDS, "contact")
        user.program.key("l")
        wait(number, f"{number} landmarks")
        user.program.drag(place, 0.71)
    user.desktop.xdo("keyup", "space")
    marked = re.findall(r"^MARKED (.*)$", user.program.output(), re.M)[-1]
    user.program.key("ctrl+z")
    wait(1, "undo to take a landmark back")
    user.program.key(REDO)
    wait(2, "redo to bring it again")
    assert re.findall(r"^MARKED (.*)$", user.program.output(), re.M)[-1] == marked, (marked, user.program.output())
    return marked


def save(desktop, program, folder, _marked):
    user = User(desktop, program)
    state, python, trace = (os.path.join(folder, name) for name in ("state.pvsm", "state.py", "trace.py"))
    program.says("READY", SECONDS)
    program.focus()
    program.key("ctrl+shift+t")
    program.says("STATE Engaged", SECONDS)

    marked = drop_landmarks(user)
    for file in (python, state):
        user.menu("alt+f", "s")
        user.window("^Save State File")
        user.give(file)
        if file == python:
            user.window("^Python State Options")
            program.key("Return")
        user.written(file)
        user.main()

    if stops_traces(desktop, program):
        save_trace(user, trace)

    # A recording: it says so, ends with the run, and is not written over unasked.
    recording = os.path.join(folder, "stroke.hrec")
    program.key("ctrl+shift+r")
    user.window("^Record What the Hand Does")
    user.give(recording)
    time.sleep(0.5)
    user.main()
    user.toggle("Released")
    user.toggle("Engaged")
    program.says(f"| {recording}", SECONDS)
    time.sleep(1.0)
    user.toggle("Released")
    user.written(recording)
    before = os.stat(recording)
    program.key("ctrl+shift+r")
    user.window("^Record What the Hand Does")
    user.give(recording)
    time.sleep(1.0)
    program.key("Escape")  # of the question
    time.sleep(0.5)
    program.key("Escape")
    user.main()
    after = os.stat(recording)
    assert (before.st_size, before.st_mtime) == (after.st_size, after.st_mtime)

    # It is played from the chooser of devices, by its last entry: the hand that touches is the recording's.
    def opened():
        user.menu("alt+d", "alt+Down", "End", "Return")
        time.sleep(2.0)
        return user.is_open("^Play a Haptic Recording") or program.key("Escape")  # a list that opened late

    real_window.wait_for(opened, SECONDS, "the dialog of a recording")
    user.window("^Play a Haptic Recording")
    user.give(recording)
    user.main()
    user.toggle("Engaged")
    program.says(f"PLAYS {recording}", SECONDS)
    return marked


def load_and_touch(desktop, program, folder, marked):
    """The Python state in another ParaView, where the hand is engaged; and the tutorial in Help."""
    user = User(desktop, program)
    python = os.path.join(folder, "loaded.py")
    shutil.copyfile(os.path.join(folder, "state.py"), python)
    with open(python, "a") as file:
        file.write(
            window_scene.PRINT +
            "\nprint('RESTORED', hand.Stiffness, hand.Device, hand.Surfaces[0].Input == FindSource('Bone'),"
            " hand.EngagedInfo)\n"
            + MARKED + "\nprint('MARKED', marked(hand))\n"
            "hand.View.GetRenderWindow().AddObserver('EndEvent', lambda *_: print('STATE', hand.State))\n"
        )
    user.main()
    user.menu("alt+f", "l")
    user.load_script(python)
    program.says(f"RESTORED {STIFFNESS} mouse True 0", SECONDS)
    program.says(f"MARKED {marked}", SECONDS)
    user.main()
    user.toggle("Engaged")
    if HAS_HELP == "1":
        user.menu("alt+h", "Up", "Return")
        user.window("Online Help")


def main():
    real_window.skip_where_it_cannot_run()
    packages = os.environ.pop("PYTHONPATH", "")
    command = [PARAVIEW, "--dr", f"--plugin-search-paths={os.path.dirname(PLUGIN)}",
               "--plugins=Haptics"]
    with window_scene.home(SCENE) as (folder, script), real_window.Desktop() as desktop:
        marked = None
        for use, more in ((save, [f"--script={script}"]), (load_and_touch, [])):
            program = desktop.start(command + more, "ParaView", SECONDS)
            try:
                marked = use(desktop, program, folder, marked) or marked
            except AssertionError:
                print(program.output())
                raise
            assert "ERR|" not in program.output() and "WARN|" not in program.output(), program.output()
            program.process.terminate()
            program.process.wait()
        os.environ.update(PYTHONPATH=packages, DISPLAY=desktop.environment["DISPLAY"])
        restored("python", os.path.join(folder, "state.py"), folder, marked)
        restored("pvsm", os.path.join(folder, "state.pvsm"), folder, marked)
        if os.path.exists(os.path.join(folder, "trace.py")):
            restored("trace", os.path.join(folder, "trace.py"), folder, None)


main()
