"""Replays a path over a sphere, without a device, and prints what would be felt."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from vtkhaptics import vtkGodObjectTrace

sphere = vtkSphereSource()
sphere.SetRadius(0.05)  # [m]
sphere.SetThetaResolution(60)
sphere.SetPhiResolution(60)

# A hand that comes from the left and goes 2 mm under the top: one point a millisecond.
hand = np.zeros((1000, 3))
hand[:, 0] = np.linspace(-0.06, 0.06, len(hand))
hand[:, 2] = 0.048
points = vtkPoints()
points.SetData(numpy_to_vtk(hand))  # the same memory: `hand` has to stay
path = vtkPolyData()
path.SetPoints(points)

trace = vtkGodObjectTrace()
trace.SetInputData(path)
trace.SetSurfaceConnection(sphere.GetOutputPort())
trace.Update()

data = trace.GetOutput().GetPointData()
force = np.linalg.norm(vtk_to_numpy(data.GetArray("Force")), axis=1)  # no copy out of VTK either
touching = vtk_to_numpy(data.GetArray("ActiveConstraints")) > 0
print(f"{touching.sum()} of {len(touching)} ticks touch; the largest force is {force.max():.2f} N")
assert 100 < touching.sum() < 900
assert abs(force.max() - 500.0 * 0.002) < 0.02, "stiffness times depth"
