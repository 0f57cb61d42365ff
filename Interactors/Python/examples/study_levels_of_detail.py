"""Two levels of detail of a body, compared by the error of the force along one path.

usage: study_levels_of_detail.py [SURFACE [PICTURE.png]]     default: a dented ball of R = 50 mm [m]
"""

import os
import sys
import tempfile

import numpy as np
import vtkhaptics
from vtkhaptics.figures import lines
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource

ball = vtkSphereSource()
ball.SetRadius(0.05)
ball.SetThetaResolution(150)
ball.SetPhiResolution(150)
ball.Update()
points = vtk_to_numpy(ball.GetOutput().GetPoints().GetData())
points *= (1.0 + 0.02 * np.sin(150.0 * points[:, :1]) * np.sin(150.0 * points[:, 1:2])).astype("f4")
fine = vtkTriangleFilter()
fine.SetInputData(vtkhaptics.polydata(sys.argv[1]) if len(sys.argv) > 1 else ball.GetOutput())
fine.Update()
coarse = vtkQuadricDecimation()
coarse.SetInputConnection(fine.GetOutputPort())
coarse.SetTargetReduction(0.9)
coarse.Update()

low, high = np.reshape(fine.GetOutput().GetBounds(), (3, 2)).T
middle, size = 0.5 * (low + high), np.linalg.norm(high - low) / np.sqrt(3.0)
turn = np.linspace(0.0, 1.5, 1500)[:, None]  # a half circle, 3 % of the size below the bounds
path = middle + 0.47 * size * (np.sin(turn) * [1.0, 0.0, 0.0] + np.cos(turn) * [0.0, 0.0, 1.0])
path = np.vstack([middle + np.linspace(0.7, 0.47, 300)[:, None] * size * [0.0, 0.0, 1.0], path])

scale = 0.1 / size  # the hand's space: 100 mm across
traces = [vtkhaptics.trace(level, path, scale=scale) for level in (fine, coarse)]
error = np.linalg.norm(traces[0].force - traces[1].force, axis=1)
both = traces[0].touching & traces[1].touching
strongest = traces[0].magnitude.max()
for level, trace in zip((fine, coarse), traces):
    print(f"{level.GetOutput().GetNumberOfPolys():7d} triangles: {trace.touching.mean():.0%} in contact")
print(
    f"error of the force: {np.sqrt(np.mean(error[both] ** 2)):.3f} N (r.m.s.), at most "
    f"{error.max():.3f} N, of forces up to {strongest:.2f} N"
)
assert both.any() and 0.0 < np.sqrt(np.mean(error[both] ** 2)) < 0.5 * strongest
picture = sys.argv[2] if len(sys.argv) > 2 else os.path.join(tempfile.mkdtemp(), "levels.png")
lines(picture, "tick", "force [N]", [t.magnitude for t in traces], ("fine", "coarse"))
