"""A hand that gives way presses on a table: does it come to rest, where, and what does it spend?

usage: study_closed_loop.py [PICTURE.png]

The hand is a spring and a damper that draw a device with mass, friction and damping to a point 10 mm
below the table. At rest the table's force is the hand's: K x = K_hand (10 mm - x).
"""

import os
import sys
import tempfile

import numpy as np
import vtkhaptics
from vtkhaptics.figures import lines
from vtkmodules.vtkFiltersSources import vtkPlaneSource

GOAL = 0.01  # [m] below the table
table = vtkPlaneSource()
device = vtkhaptics.vtkSimulatedHapticDevice()
device.SetPreset(device.Omni)
device.SetCoulombFriction(0.0)
scene = vtkhaptics.vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(table.GetOutputPort())
depths, names = [], []
for hand, stiffness in ((50.0, 300.0), (100.0, 300.0), (100.0, 600.0), (300.0, 600.0)):
    device.SetHandStiffness(hand)  # [N/m]; another setting: the next step begins anew
    device.SetHandDamping(2.0)  # [N s/m]
    scene.SetStiffness(stiffness)  # [N/m]
    device.SetPosition(0.0, 0.0, 0.005)
    scene.Step(1)
    scene.StartRecording()
    device.SetPosition(0.0, 0.0, -GOAL)
    scene.Step(3000)
    t = vtkhaptics.Trace(scene.GetTrace())
    depth, force = -t.hip[:, 2].copy(), t.force[-1, 2]
    spring = t.stiffness[-1]  # in effect: the servo keeps it below what the device can hold
    expected = hand * GOAL / (hand + spring)
    swing = np.ptp(depth[-500:])  # of the last half second
    print(
        f"hand {hand:3.0f} N/m, table {spring:3.0f} N/m: at rest {1e3 * depth[-1]:.2f} mm deep "
        f"(by the balance {1e3 * expected:.2f}), {force:.2f} N, swings by {1e6 * swing:.0f} um"
    )
    assert swing < 1e-4, "it comes to rest"
    assert abs(depth[-1] - expected) < 0.05 * expected + 1e-4  # the encoder's step is 55 um
    depths.append(1e3 * depth)
    names.append(f"hand {hand:g}, table {spring:.0f} N/m")
picture = sys.argv[1] if len(sys.argv) > 1 else os.path.join(tempfile.mkdtemp(), "closed_loop.png")
lines(picture, "time [ms]", "depth [mm]", depths, names)
