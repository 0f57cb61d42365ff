"""A saddle touched from Python in virtual time looks as in the baseline.

Seen to fail with the god-object drawn at the HIP, without the trail and without the arrow.

usage: TestTouchImage.py BASELINE OUTPUT_FOLDER
"""

import math
import sys

from image_test import compare, look_from, make_window
from vtkhaptics import vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
)

# VTK's default of 10 would not even miss the arrow; this leaves room for another driver's edges.
THRESHOLD = 0.05

baseline, output = sys.argv[1:3]


def saddle(size):
    """size by size quads of z = (x^2 - y^2) * 6 over a square of 10 cm."""
    points, polys = vtkPoints(), vtkCellArray()
    for j in range(size + 1):
        for i in range(size + 1):
            x, y = 0.1 * i / size - 0.05, 0.1 * j / size - 0.05
            points.InsertNextPoint(x, y, 6.0 * (x * x - y * y))
    for j in range(size):
        for i in range(size):
            corner = j * (size + 1) + i
            polys.InsertNextCell(4, (corner, corner + 1, corner + size + 2, corner + size + 1))
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(polys)
    return surface


surface = saddle(40)
device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(surface)
view = vtkHapticView()
view.SetScene(scene)
hand = view.GetGodObjectActor()
hand.ShowTrailOn()
hand.SetSize(0.03)
device.SetPosition(0.03, 0.0, 0.03)
scene.Step(1)
for tick in range(200):
    angle = 2.0 * math.pi * tick / 230.0
    device.SetPosition(0.03 * math.cos(angle), 0.03 * math.sin(angle), -0.012)
    scene.Step(1)
assert scene.GetTouching(), "the hand does not touch the saddle: " + scene.GetErrorMessage()

normals = vtkPolyDataNormals()
normals.SetInputData(surface)
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(normals.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.6, 0.7, 0.6)
renderer, window = make_window(actor, hand)
look_from(renderer, (0.1, -0.2, 0.22), (0.0, 0.0, 1.0), 1.1)
sys.exit(compare(renderer, window, hand, baseline, output, THRESHOLD))
