"""enable() makes a plot touchable, and disable() leaves it as it was."""

from types import SimpleNamespace

import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
import vtkhaptics
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkAssembly,
    vtkDataSetMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
    vtkTextActor,
)
from vtkhaptics.picture import surface_actor


class NamingRenderer(vtkRenderer):
    """One that knows its actors by name, as PyVista's does; from VTK 9.4 on vtkRenderer has an
    attribute of this name, which cannot be set."""

    actors = None


def plot(*props):
    renderer, window = NamingRenderer(), vtkRenderWindow()
    for prop in props:
        renderer.AddViewProp(prop)
    window.SetSize(100, 100)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    interactor = vtkRenderWindowInteractor()
    interactor.SetRenderWindow(window)
    interactor.Initialize()
    return interactor


def ball():
    sphere = vtkSphereSource()
    sphere.Update()
    return surface_actor(sphere.GetOutput())


def test_touches_and_leaves_no_trace():
    interactor = plot(ball())
    style = interactor.GetInteractorStyle()
    renderer = interactor.GetRenderWindow().GetRenderers().GetFirstRenderer()
    touch = vtkhaptics.enable(interactor)
    assert touch.scene.GetNumberOfSurfaces() == 1
    assert touch.scene.IsEngaged()
    assert interactor.GetInteractorStyle() is touch.style
    touch.scene.Release()
    touch.device.SetScene(touch.scene)
    touch.device.SetInteractor(interactor)
    touch.device.MoveTo(50, 50)
    touch.device.SetPressed(True)
    touch.scene.Step(300)
    assert touch.scene.GetTouching() and max(map(abs, touch.scene.GetForce())) > 0.5
    touch.disable()
    assert not touch.scene.IsEngaged()
    assert touch.scene.GetForce() == (0.0, 0.0, 0.0)
    assert interactor.GetInteractorStyle() is style
    assert renderer.GetViewProps().GetNumberOfItems() == 1


def test_takes_what_can_be_touched():
    hidden, unpickable, part = ball(), ball(), ball()
    hidden.VisibilityOff()
    unpickable.PickableOff()
    assembly = vtkAssembly()
    assembly.AddPart(part)
    text = vtkTextActor()
    touch = vtkhaptics.enable(plot(hidden, unpickable, assembly, text), overlay=False)
    assert touch.scene.GetNumberOfSurfaces() == 1
    assert touch.scene.GetSurfaceActor(touch.scene.GetSurfaces().GetId(0)) is part
    touch.disable()


def test_names_of_the_plot():
    named, unnamed, replaced = ball(), ball(), ball()
    interactor = plot(named, unnamed)
    renderer = interactor.GetRenderWindow().GetRenderers().GetFirstRenderer()
    # As PyVista keeps them; one that is given no name has the address of its data for it.
    renderer.actors = {"skull": named, "PolyData(Addr=0x1)": unnamed}
    touch = vtkhaptics.enable(SimpleNamespace(iren=SimpleNamespace(interactor=interactor), renderer=renderer))
    scene = touch.scene
    names = [scene.GetSurfaces().GetName(scene.GetSurfaces().GetId(i)) for i in range(2)]
    assert names == ["skull", ""], names
    renderer.RemoveActor(named)
    renderer.AddActor(replaced)
    renderer.actors = {"skull": replaced}
    interactor.GetRenderWindow().Render()
    names = [scene.GetSurfaces().GetName(scene.GetSurfaces().GetId(i)) for i in range(2)]
    assert names == ["", "skull"], names
    spoilt = vtkhaptics.polydata(([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    spoilt.GetPoints().SetPoint(1, float("nan"), 0.0, 0.0)
    replaced.GetMapper().SetInputDataObject(spoilt)
    try:
        scene.Update()
    except vtkhaptics.HapticsError as error:
        assert "(skull)" in str(error), error
    else:
        raise AssertionError("NaN was taken")
    touch.disable()


def test_refuses_what_cannot_be_touched():
    for nothing, error, text in (
        ("plot", TypeError, "pyvista.Plotter"),
        (plot(), ValueError, "no surface that can be touched"),
        (vtkRenderer(), TypeError, "vtkRenderWindowInteractor"),
    ):
        try:
            vtkhaptics.enable(nothing)
        except error as e:
            assert text in str(e), e
        else:
            raise AssertionError(f"{nothing} was taken for a plotter with something to touch")


def test_follows_what_is_shown():
    first, second = ball(), ball()
    interactor = plot(first)
    renderer = interactor.GetRenderWindow().GetRenderers().GetFirstRenderer()
    touch = vtkhaptics.enable(interactor)
    try:
        vtkhaptics.enable(interactor)
    except ValueError as error:
        assert "already" in str(error), error
    else:
        raise AssertionError("two touches on one view")
    renderer.AddActor(second)
    renderer.RemoveActor(first)
    interactor.GetRenderWindow().Render()
    scene = touch.scene
    assert scene.GetNumberOfSurfaces() == 1
    assert scene.GetSurfaceActor(scene.GetSurfaces().GetId(0)) is second
    touch.disable()
    vtkhaptics.enable(interactor).disable()


def test_clipping_planes_of_meshes_are_followed():
    sphere, mesh, mapper, actor = vtkSphereSource(), vtkAppendFilter(), vtkDataSetMapper(), vtkActor()
    mesh.SetInputConnection(sphere.GetOutputPort())
    mapper.SetInputConnection(mesh.GetOutputPort())
    actor.SetMapper(mapper)
    interactor = plot(actor)
    touch = vtkhaptics.enable(interactor)
    hit = [0.0, 0.0, 0.0]

    def height():
        interactor.GetRenderWindow().Render()
        touch.scene.Update()
        assert touch.scene.IntersectRay([0.05, 0.1, 10.0], [0.0, 0.0, -1.0], hit)
        return hit[2]

    assert height() > 0.0
    plane = vtkPlane()
    plane.SetNormal(0.0, 0.0, -1.0)
    mapper.AddClippingPlane(plane)
    assert height() < 0.0
    plane.SetOrigin(0.0, 0.0, 1.0)
    assert height() > 0.0
    plane.SetOrigin(0.0, 0.0, 0.0)
    assert height() < 0.0
    mapper.RemoveAllClippingPlanes()
    assert height() > 0.0
    touch.disable()


def test_touches_the_outside_of_meshes():
    append, lines = vtkAppendFilter(), vtkLineSource()
    sphere = vtkSphereSource()
    sphere.Update()
    append.SetInputData(sphere.GetOutput())
    actors = []
    for source in (append, lines):
        mapper = vtkDataSetMapper()
        mapper.SetInputConnection(source.GetOutputPort())
        actors.append(vtkActor())
        actors[-1].SetMapper(mapper)
    actors[0].SetPosition(10.0, 0.0, 0.0)
    touch = vtkhaptics.enable(plot(*actors))
    assert touch.scene.GetNumberOfSurfaces() == 1, "no surface is made of lines"
    assert touch.scene.IntersectRay((10.0, 0.0, 5.0), (0.0, 0.0, -1.0)) is not None
    assert touch.scene.IntersectRay((0.0, 0.0, 5.0), (0.0, 0.0, -1.0)) is None
    touch.disable()


def test_the_hand_waits_over_another_subplot():
    interactor = plot(ball())
    window = interactor.GetRenderWindow()
    left, right = window.GetRenderers().GetFirstRenderer(), vtkRenderer()
    left.SetViewport(0.0, 0.0, 0.5, 1.0)
    right.SetViewport(0.5, 0.0, 1.0, 1.0)
    right.AddViewProp(ball())
    window.AddRenderer(right)
    right.ResetCamera()
    touch = vtkhaptics.enable(interactor)
    touch.style.UpdateScene()  # connects the mouse
    touch.scene.Release()
    touch.scene.Step(1)
    touch.device.SetPressed(True)
    for x, touches in ((25, True), (75, False), (25, True)):
        touch.device.MoveTo(x, 50)
        touch.scene.Step(300)
        assert touch.scene.GetTouching() == touches, x
        assert touch.device.GetWaiting() != touches, x
    touch.disable()



test_touches_and_leaves_no_trace()
test_takes_what_can_be_touched()
test_names_of_the_plot()
test_refuses_what_cannot_be_touched()
test_follows_what_is_shown()
test_touches_the_outside_of_meshes()
test_clipping_planes_of_meshes_are_followed()
test_the_hand_waits_over_another_subplot()
