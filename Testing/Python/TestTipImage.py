"""A ball in a groove that is narrower than it below looks as in the baseline: at its true size.

The groove is of 60 degrees, so that a ball of radius r touches both walls where its centre is 2 r
above the crease. Seen to fail with the mark of a point in its place, and with half its radius.

usage: TestTipImage.py BASELINE OUTPUT_FOLDER
"""

import math
import sys

from image_test import compare, look_from, make_window
from vtkhaptics import vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

THRESHOLD = 0.05  # VTK's default of 10 would miss the ball's rim
RADIUS = 0.005  # [m], of device and surface, which are in one frame here

baseline, output = sys.argv[1:3]
points, polys = vtkPoints(), vtkCellArray()
half, height = 0.02 * math.tan(math.radians(30.0)), 0.02
for x, z in ((-half - 0.01, height), (-half, height), (0.0, 0.0), (half, height), (half + 0.01, height)):
    for y in (0.0, 0.03):
        points.InsertNextPoint(x, y, z)
for i in range(4):
    polys.InsertNextCell(4, (2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1))
surface = vtkPolyData()
surface.SetPoints(points)
surface.SetPolys(polys)

device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.SetTipRadius(RADIUS)
scene.AddSurface(surface)
view = vtkHapticView()
view.SetScene(scene)
hand = view.GetGodObjectActor()
hand.SetSize(0.012)
for tick in range(200):
    device.SetPosition(0.0, 0.015, 0.03 - 1.5e-4 * tick)
    scene.Step(1)
assert scene.GetTouching(), "the hand does not touch the groove: " + scene.GetErrorMessage()
held = scene.GetGodObject()
assert max(abs(a - b) for a, b in zip(held, (0.0, 0.015, 2.0 * RADIUS))) < 1e-8, held

mapper = vtkPolyDataMapper()
mapper.SetInputData(surface)
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.6, 0.7, 0.6)
renderer, window = make_window(actor, hand)
renderer.GetActiveCamera().ParallelProjectionOn()
look_from(renderer, (0.0, -1.0, 0.25), (0.0, 0.0, 1.0), 1.4)
sys.exit(compare(renderer, window, hand, baseline, output, THRESHOLD))
