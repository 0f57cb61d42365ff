"""Touches a surface with values and reads them at each contact, from the events' data."""

from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_OBJECT
from vtkmodules.vtkFiltersCore import vtkElevationFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource

from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice

sphere = vtkSphereSource()
sphere.SetRadius(0.05)
sphere.SetThetaResolution(60)
sphere.SetPhiResolution(60)
height = vtkElevationFilter()  # the array Elevation: 0 at the bottom, 1 at the top
height.SetInputConnection(sphere.GetOutputPort())
height.SetLowPoint(0.0, 0.0, -0.05)
height.SetHighPoint(0.0, 0.0, 0.05)

device, scene = vtkSimulatedHapticDevice(), vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(height.GetOutputPort())

values = []


@calldata_type(VTK_OBJECT)
def on_slide(_scene, _event, probe):
    values.append(probe.GetValue("Elevation"))


scene.AddObserver(scene.ContactSlideEvent, on_slide)
device.SetPosition(0.0, 0.0, 0.07)
scene.Step(1)
for step in range(50):
    device.SetPosition(0.0006 * step, 0.0, 0.04)
    scene.Step(1)
print(f"{len(values)} values, from {values[0]:.3f} at the top to {values[-1]:.3f}")
print(scene.GetProbe().GetText())
assert values[0] > 0.99 and values[-1] < 0.95
assert all(a >= b - 1e-3 for a, b in zip(values, values[1:])), "it goes downhill"
scene.DropLandmark()
assert scene.GetLandmarks().GetNumberOfLandmarks() == 1
