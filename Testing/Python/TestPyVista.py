"""A PyVista plot is touched by the mouse, and its window shows it. Needs PyVista on this VTK."""

import importlib.util
import os
import subprocess
import sys

import vtkmodules.vtkCommonCore  # noqa: F401, before PyVista, so that it takes the same VTK
import vtkhaptics

if not importlib.util.find_spec("pyvista"):
    print(
        "skipped: PyVista is not installed for this VTK. Debian has it for VTK alone, not for "
        "ParaView: python3-pyvista on Debian 13."
    )
    sys.exit(77)

import pyvista


def test_touch():
    plotter = pyvista.Plotter(window_size=(200, 200))
    plotter.add_mesh(pyvista.Sphere(radius=30.0), name="ball")
    touch = vtkhaptics.enable(plotter)
    assert touch.scene.GetNumberOfSurfaces() == 1
    touch.add(plotter.add_mesh(pyvista.Plane(i_size=5.0, j_size=5.0), name="plate"))
    assert touch.scene.GetNumberOfSurfaces() == 2
    assert touch.scene.IsEngaged()
    plotter.show(auto_close=False, interactive_update=True)
    interactor = plotter.iren.interactor
    assert interactor.GetInteractorStyle() is touch.style, interactor.GetInteractorStyle()
    touch.style.UpdateScene()  # connects the mouse
    touch.scene.Release()
    touch.device.MoveTo(100, 100)
    touch.device.SetPressed(True)
    touch.scene.Step(300)
    assert touch.scene.GetTouching(), touch.scene.GetErrorMessage()
    plotter.render()
    with_hand = plotter.screenshot(None, return_img=True).astype(int)
    touch.disable()
    assert touch.scene.GetForce() == (0.0, 0.0, 0.0)
    plotter.render()
    without = plotter.screenshot(None, return_img=True).astype(int)
    assert (abs(with_hand - without).max(axis=2) > 60).sum() > 50, "the hand was not shown"
    plotter.close()


def touched_at(touch, x, y):
    """The name of the surface that is touched at a place in the window [pixel from the lower left];
    None where there is none."""
    touch.scene.Step(1)
    touch.device.SetPressed(False)
    touch.device.MoveTo(x, y)
    touch.device.SetPressed(True)
    touch.scene.Step(100)
    name = touch.scene.GetProbe().GetSurfaceName() if touch.scene.GetTouching() else None
    touch.device.SetPressed(False)
    touch.scene.Step(100)
    return name


def shown(plotter):
    """Enables the mouse on a plot and steps it in virtual time."""
    touch = vtkhaptics.enable(plotter)
    plotter.show(auto_close=False, interactive_update=True)
    touch.style.UpdateScene()
    touch.scene.Release()
    return touch


def step(touch):
    touch.style.UpdateScene()  # as its timer does
    touch.scene.Step(2)


def test_meshes_of_any_kind():
    ball = pyvista.Sphere(radius=10.0)
    for mesh in (ball, ball.cast_to_unstructured_grid(), pyvista.MultiBlock([ball, pyvista.Cube()]),
                 pyvista.ParametricEllipsoid(10, 10, 10).cast_to_unstructured_grid()):
        plotter = pyvista.Plotter(window_size=(100, 100))
        plotter.add_mesh(mesh)
        touch = shown(plotter)
        assert touched_at(touch, 50, 50) is not None, type(mesh)
        assert touched_at(touch, 1, 1) is None, type(mesh)
        plotter.close()


def test_what_comes_and_goes():
    plotter = pyvista.Plotter(window_size=(100, 100))
    plotter.add_mesh(pyvista.Sphere(radius=10.0), name="one")
    touch = shown(plotter)
    assert touched_at(touch, 50, 50)
    plotter.add_mesh(pyvista.Cube(x_length=9.0, y_length=9.0, z_length=9.0), name="one")
    step(touch)
    assert touch.scene.GetNumberOfSurfaces() == 1
    assert touched_at(touch, 50, 50)
    plotter.clear()
    step(touch)
    assert touched_at(touch, 50, 50) is None, "it is no longer there"
    plotter.close()


def test_subplots():
    plotter = pyvista.Plotter(shape=(1, 2), window_size=(200, 100))
    plotter.subplot(0, 0)
    plotter.add_mesh(pyvista.Sphere(radius=10.0))
    plotter.subplot(0, 1)
    plotter.add_mesh(pyvista.Cube(x_length=2.0, y_length=2.0, z_length=2.0))
    touch = shown(plotter)
    assert touched_at(touch, 150, 50), "the active one"
    assert touched_at(touch, 50, 50) is None, "the ball there is no surface of the scene"
    plotter.close()


ENDS = """
import vtkmodules.vtkCommonCore
import vtkhaptics, pyvista
plotter = pyvista.Plotter(window_size=(200, 150))
plotter.add_mesh(pyvista.Sphere())
touch = vtkhaptics.enable(plotter)
interactor = plotter.iren.interactor
interactor.Initialize()
interactor.CreateRepeatingTimer(300)
interactor.AddObserver("TimerEvent", lambda *_: interactor.ExitCallback())
plotter.show()
print("ended", touch.scene.IsEngaged())
plotter.close()
"""


def test_show_and_close_end():
    done = subprocess.run([sys.executable, "-c", ENDS], capture_output=True, text=True, timeout=120,
                          env=os.environ, check=False)
    assert done.returncode == 0 and "Traceback" not in done.stderr, (done.returncode, done.stderr)
    assert "ended False" in done.stdout, done.stdout


test_touch()
test_meshes_of_any_kind()
test_what_comes_and_goes()
test_subplots()
test_show_and_close_end()
