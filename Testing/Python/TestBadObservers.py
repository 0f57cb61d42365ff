"""What an observer raises is raised by the call that caused its event; the hand is served all the same."""

import io
import time
from contextlib import redirect_stderr

from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice
from vtkmodules.vtkFiltersSources import vtkPlaneSource


def raises(_caller, event):
    raise RuntimeError("the observer of " + event)


def make():
    device, scene, table = vtkSimulatedHapticDevice(), vtkHapticScene(), vtkPlaneSource()
    scene.SetDevice(device)
    scene.AddSurface(table.GetOutputPort())
    return device, scene


def test_virtual_time():
    device, scene = make()
    others = []
    scene.AddObserver(scene.ContactBeginEvent, raises)
    scene.AddObserver(scene.ContactBeginEvent, lambda *_: others.append(scene.GetTouching()))
    scene.AddObserver(scene.ContactEndEvent, raises)
    raised = []
    reported = io.StringIO()
    with redirect_stderr(reported):
        for height in (0.01, -0.002, 0.01, 0.01, -0.002, 0.01, -0.002):
            free = scene.GetForce()
            device.SetPosition(0.0, 0.0, height)
            try:
                scene.Step(300)
            except RuntimeError as error:
                raised.append(str(error))
    assert reported.getvalue() == "", reported.getvalue()
    both = ["the observer of ContactBeginEvent", "the observer of ContactEndEvent"]
    assert raised == [*both, *both, both[0]], raised
    assert others == [True] * 3, "the other observers are called"
    assert free == (0.0, 0.0, 0.0), free
    assert abs(scene.GetForce()[2] - 1.0) < 0.01, scene.GetForce()


def test_real_time():
    device, scene = make()
    scene.AddObserver(scene.ContactBeginEvent, raises)
    device.SetPosition(0.0, 0.0, 0.01)
    assert scene.Engage(), scene.GetErrorMessage()
    raised = []
    deadline = time.monotonic() + 20.0
    while not scene.GetTouching() and time.monotonic() < deadline:
        time.sleep(0.01)
        try:
            scene.Update()
        except RuntimeError as error:
            raised.append(str(error))
        device.SetPosition(0.0, 0.0, -0.002)
    assert scene.GetTouching() and scene.IsEngaged()
    assert raised == ["the observer of ContactBeginEvent"], raised
    scene.Release()
    device.Update()
    assert device.GetForce() == (0.0, 0.0, 0.0), device.GetForce()


test_virtual_time()
test_real_time()
