"""Strokes a torus by script, in virtual time, and writes the picture of it."""

import math
import os
import sys
import tempfile

from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice
from vtkhaptics.picture import add_lights, save_window, surface_actor

torus = vtkParametricFunctionSource()
torus.SetParametricFunction(vtkParametricTorus())  # radii 1 and 0.5, in any unit
torus.Update()
device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(torus.GetOutput())
scene.SetStiffness(20.0)  # the device frame is the world's here: 1 m wide
hand = scene.GetGodObjectActor()
hand.ShowTrailOn()
hand.ColorForceByMagnitudeOn()
for tick in range(1500):
    angle = 2.0 * math.pi * tick / 1800.0
    height = 0.8 if tick < 2 else 0.42
    device.SetPosition(math.cos(angle), math.sin(angle), height)
    scene.Step(1)
assert scene.GetTouching()

renderer = vtkRenderer()
renderer.SetBackground(0.93, 0.94, 0.96)
add_lights(renderer)
renderer.AddActor(surface_actor(torus.GetOutput()))
renderer.AddViewProp(hand)
window = vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetSize(600, 400)
window.AddRenderer(renderer)
renderer.GetActiveCamera().SetPosition(1.0, -3.0, 3.0)
renderer.GetActiveCamera().SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCamera()
hand.IncludeInClippingRange(renderer)
picture = sys.argv[1] if len(sys.argv) > 1 else os.path.join(tempfile.mkdtemp(), "stroke.png")
save_window(window, picture)
print(f"{picture}: {os.path.getsize(picture)} bytes")
assert os.path.getsize(picture) > 10000
