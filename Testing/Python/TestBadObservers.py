"""A script that raises in an observer is told so, and the hand is served all the same."""

import io
import time
from contextlib import redirect_stderr

from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice
from vtkmodules.vtkFiltersSources import vtkPlaneSource


def pressing(scene, device):
    """Brings the hand from above into the table, and back, in virtual time."""
    for height in (0.01, -0.002, 0.01):
        device.SetPosition(0.0, 0.0, height)
        scene.Step(200)


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
    told = io.StringIO()
    with redirect_stderr(told):
        pressing(scene, device)
        pressing(scene, device)
        free = scene.GetForce()
        device.SetPosition(0.0, 0.0, -0.002)
        scene.Step(300)
    assert told.getvalue().count("RuntimeError: the observer") == 5, told.getvalue()
    assert others == [True] * 3, "the other observers are called"
    assert free == (0.0, 0.0, 0.0), free
    assert abs(scene.GetForce()[2] - 1.0) < 0.01, scene.GetForce()


def test_real_time():
    device, scene = make()
    scene.AddObserver(scene.ContactBeginEvent, raises)
    device.SetPosition(0.0, 0.0, 0.01)
    assert scene.Engage(), scene.GetErrorMessage()
    with redirect_stderr(io.StringIO()) as told:
        deadline = time.monotonic() + 20.0
        while not scene.GetTouching() and time.monotonic() < deadline:
            time.sleep(0.01)
            scene.Update()
            device.SetPosition(0.0, 0.0, -0.002)
    assert scene.GetTouching() and scene.IsEngaged()
    assert "RuntimeError" in told.getvalue()
    scene.Release()
    force = [0.0, 0.0, 0.0]
    device.Update()
    device.GetForce(force)
    assert force == [0.0, 0.0, 0.0], force


test_virtual_time()
test_real_time()
