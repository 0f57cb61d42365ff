"""A saddle coloured by its stiffness, stroked with friction, looks as in the baseline.

Seen to fail without friction (the god-object is not dragged behind the hand), and with the stiffness
array left out (another force arrow).

usage: TestPropertyImage.py BASELINE OUTPUT_FOLDER
"""

import sys

from image_test import compare, look_from, make_window
from vtkhaptics import vtkHapticProperties, vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
)

# As TestTouchImage.
THRESHOLD = 0.2

baseline, output = sys.argv[1:3]

plane = vtkPlaneSource()
plane.SetOrigin(-0.05, -0.05, 0.0)
plane.SetPoint1(0.05, -0.05, 0.0)
plane.SetPoint2(-0.05, 0.05, 0.0)
plane.SetResolution(40, 40)
plane.Update()
surface = plane.GetOutput()
stiffness = vtkDoubleArray()
stiffness.SetName("stiffness")
for i in range(surface.GetNumberOfPoints()):
    x, y, _ = surface.GetPoint(i)
    surface.GetPoints().SetPoint(i, x, y, 6.0 * (x * x - y * y))
    stiffness.InsertNextValue(550.0 if x < 0.0 else 120.0)
surface.GetPointData().AddArray(stiffness)

device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
table = scene.AddSurface(surface)
scene.SetSurfacePropertyArray(
    table, vtkHapticProperties.STIFFNESS, vtkDataObject.FIELD_ASSOCIATION_POINTS, "stiffness"
)
scene.GetSurfaceProperties(table).SetStaticFriction(1.2)
scene.GetSurfaceProperties(table).SetDynamicFriction(0.9)
view = vtkHapticView()
view.SetScene(scene)
hand = view.GetGodObjectActor()
hand.ShowTrailOn()
hand.SetSize(0.03)
device.SetPosition(-0.035, 0.005, 0.03)
scene.Step(1)
for tick in range(400):
    x = -0.035 + 1.75e-4 * tick
    device.SetPosition(x, 0.005, 6.0 * x * x - 0.006)
    scene.Step(1)
assert scene.GetTouching(), "the hand does not touch the saddle: " + scene.GetErrorMessage()
pull, push = -scene.GetForce()[0], scene.GetForce()[2]
assert pull > 0.5 * push, "friction drags"

colors = vtkColorTransferFunction()
colors.AddRGBPoint(120.0, 0.35, 0.5, 0.85)
colors.AddRGBPoint(550.0, 0.85, 0.45, 0.3)
normals = vtkPolyDataNormals()
normals.SetInputData(surface)
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(normals.GetOutputPort())
mapper.SetScalarModeToUsePointFieldData()
mapper.SelectColorArray("stiffness")
mapper.SetLookupTable(colors)
actor = vtkActor()
actor.SetMapper(mapper)
renderer, window = make_window(actor, hand)
look_from(renderer, (0.05, -0.22, 0.16), (0.0, 0.0, 1.0), 1.1)
sys.exit(compare(renderer, window, hand, baseline, output, THRESHOLD))
