"""A PyVista plot in a real window, as its user has it: touched, stroked, turned, closed.

Real keys and mouse. Needs PyVista on this VTK.
"""

import importlib.util
import os
import sys
import tempfile
import time

from real_window import Desktop, skip_where_it_cannot_run, wait_for

PLOT = """
import sys
import vtkmodules.vtkCommonCore  # before PyVista, so that it takes the same VTK
import pyvista
import vtkhaptics

plotter = pyvista.Plotter(shape=SHAPE, window_size=(400, 300), title="VTK Haptics")
ADD
touch = vtkhaptics.enable(plotter)
for event in ("ContactBeginEvent", "ContactEndEvent"):
    touch.scene.AddObserver(
        event, lambda scene, event, probe: print(event, probe.GetSurfaceName(), flush=True))
plotter.iren.interactor.CreateOneShotTimer(300)
said = []

def ready(*_):
    if not said:
        said.append(1)
        print("ready", flush=True)

plotter.iren.interactor.AddObserver("TimerEvent", ready)
SHOW
print("shown", touch.scene.IsEngaged(), flush=True)
plotter.close()
print("closed", flush=True)
"""

BALL = 'plotter.add_mesh(pyvista.Sphere(), name="ball")'


def plot(desktop, folder, add=BALL, shape=(1, 1), show="plotter.show()"):
    script = os.path.join(folder, "plot.py")
    with open(script, "w", encoding="utf-8") as file:
        file.write(PLOT.replace("ADD", add).replace("SHAPE", str(shape)).replace("SHOW", show))
    program = desktop.start([sys.executable, script])
    program.says("ready")
    program.focus()
    return program


def touches(program):
    """The names of what has been touched so far, one for each contact."""
    return [line.partition(" ")[2] for line in program.output().splitlines()
            if line.startswith("ContactBeginEvent")]


def press(program, x, y, name):
    """Holds the space bar over a place, until what is there is touched; and lets go."""
    before, ended = len(touches(program)), program.output().count("ContactEndEvent")
    program.move(x, y)
    time.sleep(0.3)
    program.desktop.xdo("keydown", "space")
    wait_for(lambda: len(touches(program)) > before, 20.0, f"{name} to be touched")
    assert touches(program)[-1] == name, (touches(program), name)
    program.desktop.xdo("keyup", "space")
    wait_for(lambda: program.output().count("ContactEndEvent") > ended, 20.0, f"{name} to be let go")


def misses(program, x, y):
    """Holds the space bar where nothing can be touched."""
    before = len(touches(program))
    program.move(x, y)
    time.sleep(0.3)
    program.desktop.xdo("keydown", "space")
    time.sleep(0.7)
    program.desktop.xdo("keyup", "space")
    assert len(touches(program)) == before, touches(program)


def ends(program, act, status, name):
    began = time.monotonic()
    act(program)
    found = program.ended(20.0)
    output = program.output()
    assert found == status and "Traceback" not in output, (name, found, output)
    assert status or ("shown False" in output and "closed" in output), (name, output)
    print(f"{name}: {found} after {time.monotonic() - began:.2f} s", flush=True)


def test_touches_and_ends(desktop, folder):
    for name, act, status in (
        ("q", lambda program: program.key("q"), 0),
        ("e", lambda program: program.key("e"), 0),
        ("close button", lambda program: program.close_button(), 0),
        ("Ctrl-C", lambda program: program.interrupt(), 130),
    ):
        program = plot(desktop, folder)
        press(program, 0.5, 0.5, "ball")
        ends(program, act, status, name)


def test_stays_open_until_it_is_closed_by_the_program(desktop, folder):
    program = plot(desktop, folder, show="plotter.show(auto_close=False)")
    press(program, 0.5, 0.5, "ball")
    ends(program, lambda program: program.key("q"), 0, "auto_close=False")


def test_closes_from_a_key_of_the_program(desktop, folder):
    add = BALL + '\nplotter.add_key_event("k", plotter.close)'
    program = plot(desktop, folder, add)
    press(program, 0.5, 0.5, "ball")
    program.key("q")  # the key's own close() is PyVista's affair; the window's end is ours
    ends(program, lambda program: None, 0, "with key events")


def test_two_plots_one_after_the_other(desktop, folder):
    again = """plotter.show()
print("first", flush=True)
plotter = pyvista.Plotter(window_size=(400, 300), title="VTK Haptics")
plotter.add_mesh(pyvista.Cube(), name="cube")
touch = vtkhaptics.enable(plotter)
touch.scene.AddObserver("ContactBeginEvent", lambda s, e, p: print(e, p.GetSurfaceName(), flush=True))
touch.scene.AddObserver("ContactEndEvent", lambda s, e, p: print(e, p.GetSurfaceName(), flush=True))
plotter.show()"""
    program = plot(desktop, folder, show=again)
    press(program, 0.5, 0.5, "ball")
    program.key("q")
    program.says("first")
    program.find_window("VTK Haptics", 30.0)
    time.sleep(1.0)
    program.focus()
    press(program, 0.5, 0.5, "cube")
    ends(program, lambda program: program.key("q"), 0, "the second plot")


def test_subplots(desktop, folder):
    add = """plotter.subplot(0, 0)
plotter.add_mesh(pyvista.Cube(), name="cube")
plotter.subplot(0, 1)
plotter.add_mesh(pyvista.Sphere(), name="ball")"""
    program = plot(desktop, folder, add, shape=(1, 2))
    press(program, 0.75, 0.5, "ball")
    misses(program, 0.25, 0.5)
    press(program, 0.75, 0.5, "ball")
    program.move(0.2, 0.5)  # the other one is turned as ever
    program.desktop.xdo("mousedown", "1")
    program.drag(0.3, 0.4)
    program.desktop.xdo("mouseup", "1")
    press(program, 0.75, 0.5, "ball")
    ends(program, lambda program: program.key("q"), 0, "subplots")


def test_widgets_work_and_are_not_touched(desktop, folder):
    # A slider across the lower edge, and the sphere of a widget, far larger than the ball next to it.
    add = BALL + """
plotter.add_slider_widget(lambda value: print("slider", value, flush=True), (0.0, 1.0), value=0.5,
                          pointa=(0.2, 0.1), pointb=(0.8, 0.1))
plotter.add_sphere_widget(lambda center: None, center=(1.4, 0.0, 0.0), radius=0.4)
plotter.camera_position = "xy\""""
    program = plot(desktop, folder, add)
    count = program.output().count("slider")
    program.move(0.5, 0.895)  # its knob
    program.desktop.xdo("mousedown", "1")
    program.drag(0.7, 0.895)
    program.desktop.xdo("mouseup", "1")
    wait_for(lambda: program.output().count("slider") > count, 20.0, "the slider to move")
    names = program.output()
    assert "ContactBeginEvent" not in names, names
    for x in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8):  # across both spheres
        program.move(x, 0.5)
        program.desktop.xdo("keydown", "space")
        time.sleep(0.4)
        program.desktop.xdo("keyup", "space")
        time.sleep(0.2)
    wait_for(lambda: touches(program), 20.0, "the ball to be touched")
    assert set(touches(program)) == {"ball"}, touches(program)
    ends(program, lambda program: program.key("q"), 0, "widgets")


def test_what_is_replaced_and_cleared(desktop, folder):
    add = BALL + """
def cube():
    plotter.add_mesh(pyvista.Cube(), name="ball")
    plotter.add_mesh(pyvista.Cube(x_length=1.2, z_length=1.2), name="cube")
    print("replaced", flush=True)
def nothing():
    plotter.clear()
    print("cleared", flush=True)
plotter.add_key_event("k", cube)
plotter.add_key_event("n", nothing)"""
    program = plot(desktop, folder, add)
    press(program, 0.5, 0.5, "ball")
    program.key("k")
    program.says("replaced")
    time.sleep(1.0)
    press(program, 0.5, 0.5, "cube")
    program.key("n")
    program.says("cleared")
    time.sleep(1.0)
    misses(program, 0.5, 0.5)
    ends(program, lambda program: program.key("q"), 0, "replaced and cleared")


if not importlib.util.find_spec("pyvista"):
    print(
        "skipped: PyVista is not installed for this VTK. Debian has it for VTK alone, not for "
        "ParaView: python3-pyvista on Debian 13."
    )
    sys.exit(77)
skip_where_it_cannot_run()
with Desktop() as screen, tempfile.TemporaryDirectory() as scratch:
    chosen = sys.argv[1:] or [name for name in list(globals()) if name.startswith("test_")]
    for chosen_name in chosen:
        print(chosen_name, flush=True)
        globals()[chosen_name](screen, scratch)
