"""What tests of an engaged servo share: patience with a busy machine, and waiting for a condition."""

import time

PATIENCE = 20.0  # [s]


def be_patient(servo):
    """A busy machine is no fault in a test."""
    servo.SetStallLimit(60.0)
    servo.GetSafety().LoosenMissedTickShare(60.0)
    servo.GetSafety().LoosenWatchdogTime(1.0)


def wait_for(condition, scene=None):
    """Waits until a condition holds, and updates the scene meanwhile where one is given."""
    end = time.monotonic() + PATIENCE
    while not condition():
        limits = f": {scene.GetServo().GetReadings().DescribeForceLimits()}" if scene else ""
        assert time.monotonic() < end, f"waited for {PATIENCE} s{limits}"
        time.sleep(0.002)
        if scene:
            scene.Update()
