"""enable() makes a plot touchable: plain VTK everywhere, PyVista where it runs on this VTK."""

import importlib.util

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
import vtkhaptics
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor
from vtkhaptics.picture import surface_actor


def check(touch):
    assert touch.scene.GetNumberOfSurfaces() == 1
    assert touch.scene.IsEngaged()
    touch.disable()
    assert not touch.scene.IsEngaged()
    assert touch.scene.GetForce() == (0.0, 0.0, 0.0)


def test_plain_vtk():
    sphere = vtkSphereSource()
    sphere.Update()
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.AddActor(surface_actor(sphere.GetOutput()))
    window.SetSize(100, 100)
    window.AddRenderer(renderer)
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.Initialize()
    check(vtkhaptics.enable(interactor))


def test_refuses_what_is_no_plotter():
    try:
        vtkhaptics.enable("plot")
    except TypeError as error:
        assert "pyvista.Plotter" in str(error)
    else:
        raise AssertionError("a string was taken for a plotter")


def test_pyvista():
    if not importlib.util.find_spec("pyvista"):
        print("skipped: PyVista is not installed (Debian 13: python3-pyvista, against VTK alone)")
        return
    import pyvista

    plotter = pyvista.Plotter(window_size=(100, 100))
    plotter.add_mesh(pyvista.Sphere())
    plotter.iren.initialize()
    check(vtkhaptics.enable(plotter))
    plotter.close()


test_plain_vtk()
test_refuses_what_is_no_plotter()
test_pyvista()
