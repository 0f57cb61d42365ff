"""Strokes a torus by script, in virtual time, and writes the picture of it."""

import math
import os
import sys
import tempfile

from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkFiltersSources import vtkParametricFunctionSource
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from vtkhaptics import vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkhaptics.display import ensure_script_display
from vtkhaptics.picture import add_lights, save_window, surface_actor

ensure_script_display()  # it draws

ring = vtkParametricTorus()
ring.SetRingRadius(0.05)  # [m]: a larger one would make the hand faster than the servo lets it be
ring.SetCrossSectionRadius(0.025)
torus = vtkParametricFunctionSource()
torus.SetParametricFunction(ring)
torus.SetUResolution(80)
torus.SetVResolution(80)
torus.Update()
device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(torus.GetOutput())
view = vtkHapticView()
view.SetScene(scene)
hand = view.GetGodObjectActor()
hand.ShowTrailOn()
hand.ColorForceByMagnitudeOn()
for tick in range(1500):
    angle = 2.0 * math.pi * tick / 1800.0
    height = max(0.022, 0.035 - 0.0002 * tick)
    device.SetPosition(0.05 * math.cos(angle), 0.05 * math.sin(angle), height)
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
