"""A recording, analysed in pandas and drawn by matplotlib: how long, how firm is each contact?

usage: study_recording.py [RECORDING.haptic [PICTURE.png]]     default: records a hand that taps
"""

import os
import sys
import tempfile

import numpy as np
import vtkhaptics
from vtkhaptics.figures import lines
from vtkmodules.vtkFiltersSources import vtkPlaneSource

try:
    import pandas
except ImportError:
    print("skipped: pandas is not installed (pip install pandas)")
    sys.exit(77)

file = sys.argv[1] if len(sys.argv) > 1 else os.path.join(tempfile.mkdtemp(), "taps.haptic")
if len(sys.argv) < 2:
    table, device = vtkPlaneSource(), vtkhaptics.vtkSimulatedHapticDevice()
    scene = vtkhaptics.vtkHapticScene()
    scene.SetDevice(device)
    scene.AddSurface(table.GetOutputPort())
    scene.GetServo().SetRecordingFileName(file)
    for tick in range(3000):  # five taps, each firmer than the last
        swing = np.sin(2.0 * np.pi * tick / 600.0)
        device.SetPosition(0.0, 0.0, 0.003 - 0.002 * swing * (2.0 + tick / 3000.0))
        scene.Step(1)
    scene.Release()

recording = vtkhaptics.vtkRecordedHapticDevice()
recording.SetFileName(file)
recording.Open()
ticks = (recording.GetTick(tick) for tick in range(recording.GetNumberOfTicks()))
frame = pandas.DataFrame(
    ([time, *position, *force] for time, position, force in ticks),
    columns=["time", "x", "y", "z", "force_x", "force_y", "force_z"],  # [s], [m], [N]
)
frame["force"] = np.linalg.norm(frame[["force_x", "force_y", "force_z"]], axis=1)
touching = frame["force"] > 0.0
frame["contact"] = (touching & ~touching.shift(fill_value=False)).cumsum()
contacts = frame[touching].groupby("contact").agg(
    start=("time", "min"), ticks=("time", "size"), peak=("force", "max"), mean=("force", "mean")
)
print(contacts.round(3).to_string())
if len(sys.argv) < 2:
    assert len(contacts) == 5 and contacts["peak"].is_monotonic_increasing
picture = sys.argv[2] if len(sys.argv) > 2 else os.path.join(tempfile.mkdtemp(), "recording.png")
lines(picture, "tick", "force [N]", [frame["force"]])
