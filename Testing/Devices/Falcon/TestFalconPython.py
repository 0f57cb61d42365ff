"""The Falcon from Python, without one: what scripts see of its states and errors."""

import sys
import time

from vtkhaptics import vtkFalconHapticDevice, vtkHapticDevice

failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


falcon = vtkFalconHapticDevice()
events = []
errors = []
falcon.AddObserver(vtkHapticDevice.StateChangedEvent,
                   lambda device, _: events.append(device.GetStateAsString()))
falcon.AddObserver("ErrorEvent", lambda *_: errors.append(falcon.GetErrorMessage()))

check(falcon.GetStateAsString() == "Closed", "starts closed")
check(falcon.GetTorqueScale() == -3500.0, "has the documented torque scale")
falcon.SetTorqueScale(1.0)
check(falcon.GetTorqueScale() == -3500.0 and len(errors) == 1, "refuses a torque scale of 1")
falcon.SetLeds(vtkFalconHapticDevice.BlueLed | vtkFalconHapticDevice.RedLed)
check(falcon.GetLeds() == 6, "takes lamps")

# Nobody has sixteen: this fails wherever the test runs.
falcon.SetDeviceIndex(15)
check(falcon.Open() is False, "is not open at once")
deadline = time.monotonic() + 10.0
while falcon.GetState() == vtkHapticDevice.Opening and time.monotonic() < deadline:
    time.sleep(0.01)
    falcon.Update()
check(falcon.GetState() == vtkHapticDevice.Faulted, "faults where there is no such device")
message = falcon.GetErrorMessage()
check("Falcon" in message or "USB" in message, "says why: " + repr(message))
check(falcon.GetStatusMessage() == message, "has the error as its status")
check(events == ["Opening", "Faulted"], "reports its states: " + repr(events))
check("StatusMessage: " + message in str(falcon), "prints it")
falcon.Close()
check(falcon.GetErrorMessage() == "" and falcon.GetStateAsString() == "Closed", "closes")

for failure in failures:
    print("FAILED: " + failure)
sys.exit(1 if failures else 0)
