"""Records a stroke, then lets a simulated hand repeat it: the forces are the same."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkFiltersSources import vtkSphereSource

from vtkhaptics import vtkHapticScene, vtkSimulatedHapticDevice

sphere = vtkSphereSource()
sphere.SetRadius(0.05)


def record(device, ticks, lead=None):
    """The trace of a hand; `lead` puts it somewhere before each tick."""
    scene = vtkHapticScene()
    scene.SetDevice(device)
    scene.AddSurface(sphere.GetOutputPort())
    scene.StartRecording()
    for tick in range(ticks):
        if lead:
            lead(tick)
        scene.Step(1)
    scene.StopRecording()
    trace = vtkPolyData()
    trace.DeepCopy(scene.GetTrace())
    return trace


led = vtkSimulatedHapticDevice()
first = record(led, 300, lambda tick: led.SetPosition(0.0001 * tick, 0.0, 0.07 - 0.00012 * tick))

path = vtkPolyData()
points = vtkPoints()
points.SetData(first.GetPointData().GetArray("HapticInterfacePoint"))
path.SetPoints(points)
path.GetPointData().AddArray(first.GetPointData().GetArray("Time"))
follower = vtkSimulatedHapticDevice()
follower.SetMotionToPolyline()
follower.SetPath(path)
again = record(follower, 300)

forces = [vtk_to_numpy(trace.GetPointData().GetArray("Force")) for trace in (first, again)]
difference = np.abs(forces[0] - forces[1]).max()
print(f"largest force {np.abs(forces[0]).max():.2f} N, largest difference {difference:.1e} N")
assert np.abs(forces[0]).max() > 0.5
assert difference < 1e-6
