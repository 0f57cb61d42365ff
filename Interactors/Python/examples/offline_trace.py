"""Replays a path over a sphere, without a device, and plots the forces.

usage: offline_trace.py [PICTURE.png]
"""

import os
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from vtkhaptics import vtkGodObjectTrace
from vtkhaptics.output import whole_file

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

try:
    import matplotlib
except ImportError:
    print("no plot: matplotlib is not installed (pip install matplotlib)")
    sys.exit()
matplotlib.use("Agg")  # draws into a file, without a display
from matplotlib import pyplot

god = vtk_to_numpy(trace.GetOutput().GetPoints().GetData())
figure, (side, forces) = pyplot.subplots(2, sharex=True, layout="constrained")
side.plot(1e3 * hand[:, 0], 1e3 * hand[:, 2], label="device")
side.plot(1e3 * god[:, 0], 1e3 * god[:, 2], label="god-object")
side.set_ylabel("height [mm]")
side.legend()
forces.plot(1e3 * hand[:, 0], force, color="firebrick")
forces.set(xlabel="x [mm]", ylabel="force [N]")
picture = sys.argv[1] if len(sys.argv) > 1 else os.path.join(tempfile.mkdtemp(), "trace.png")
with whole_file(picture) as file:
    figure.savefig(file, format="png")
print(f"{picture}: {os.path.getsize(picture)} bytes")
assert os.path.getsize(picture) > 10000
