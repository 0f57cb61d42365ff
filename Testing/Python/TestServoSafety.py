"""From Python: statistics while the servo runs, safety, recordings, and Ctrl-C with force."""

import os
import signal
import time

from vtkhaptics import (
    vtkHapticScene,
    vtkHapticReadings,
    vtkRecordedHapticDevice,
    vtkSimulatedHapticDevice,
)
from vtkmodules.vtkFiltersSources import vtkPlaneSource

from servo_tools import be_patient, wait_for

plane = vtkPlaneSource()
plane.SetOrigin(-0.1, -0.1, 0.0)
plane.SetPoint1(0.1, -0.1, 0.0)
plane.SetPoint2(-0.1, 0.1, 0.0)
plane.Update()

device = vtkSimulatedHapticDevice()
device.SetPreset(device.Omni)
device.SetMotionToStroke()
device.SetStrokeBounds(-0.02, 0.02, -0.02, 0.02, 0.0, 0.0)
device.SetPressDepth(0.01)
device.SetStrokeClearance(0.002)
device.LoopOn()
scene = vtkHapticScene()
scene.AddSurface(plane.GetOutputPort())
scene.SetDevice(device)
servo = scene.GetServo()
be_patient(servo)
safety = servo.GetSafety()
assert safety.IsLoosened()


def device_force():
    force = [0.0, 0.0, 0.0]
    device.GetForce(force)
    return max(map(abs, force))


recording = "TestServoSafety.haptic"
servo.SetRecordingFileName(recording)
assert scene.Engage(), scene.GetErrorMessage()
wait_for(lambda: device_force() > 0.2 and servo.GetNumberOfTicks() > 200, scene)
assert servo.GetReadings().GetPeriodRatio() >= servo.GetReadings().GetMeanPeriod() > 0.0, "readable while it runs"
assert sum(
    servo.GetReadings().GetPeriodCount(i) for i in range(vtkHapticReadings.GetNumberOfHistogramBins())
) >= 200
assert servo.GetReadings().GetStiffness() > 0.0

servo.PausedOn()
# Both: between two strokes there is no force anyway, before the servo has heard of the pause.
wait_for(lambda: "paused" in servo.GetReadings().DescribeForceLimits() and device_force() == 0.0, scene)
servo.PausedOff()
wait_for(lambda: device_force() > 0.2, scene)

# Ctrl-C is Python's KeyboardInterrupt as ever, but the hand is free by then.
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(20.0)
    raise AssertionError("no KeyboardInterrupt came")
except KeyboardInterrupt:
    assert device_force() == 0.0
errors = []
servo.AddObserver("ErrorEvent", lambda *_: errors.append(servo.GetErrorMessage()))
scene.Update()
assert servo.GetStateAsString() == "Interrupted", servo.GetStateAsString()
assert not scene.IsEngaged() and not errors, "what somebody wanted is no error"
assert "asked to end" in scene.GetErrorMessage(), scene.GetErrorMessage()
assert servo.GetNumberOfRecordedTicks() == servo.GetNumberOfTicks()
servo.SetRecordingFileName("")
assert scene.Engage(), "the program went on, and so may the hand"
wait_for(lambda: device_force() > 0.2, scene)
scene.Release()
assert device_force() == 0.0

recorded = vtkRecordedHapticDevice()
recorded.SetFileName(recording)
assert recorded.Open(), recorded.GetErrorMessage()
assert recorded.GetNumberOfTicks() > 200 and recorded.GetNote() == ""
scene.SetDevice(recorded)
assert scene.Step(recorded.GetNumberOfTicks()) == recorded.GetNumberOfTicks()
os.remove(recording)
print(servo)
