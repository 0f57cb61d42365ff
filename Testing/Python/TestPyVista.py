"""A PyVista plot is touched by the mouse, and its window shows it. Needs PyVista on this VTK."""

import importlib.util
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


test_touch()
