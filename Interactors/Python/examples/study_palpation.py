"""Palpation: 30 strokes over a cortex [mm], as CSV (force, cell, values) and as a plot.

usage: study_palpation.py [SURFACE [FOLDER]]     default: a folded sheet with the array Depth
"""

import os
import sys
import tempfile

import numpy as np
import vtkhaptics
from vtkhaptics.figures import lines
from vtkhaptics.output import text_cell, whole_file
from vtkhaptics.surfaces import value_arrays
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals

x, y = np.meshgrid(np.linspace(-60.0, 60.0, 161), np.linspace(-60.0, 60.0, 161))
folds = 3.0 * np.sin(0.4 * x + np.sin(0.1 * y)) * np.cos(0.15 * y)
corner = np.arange(160 * 161).reshape(160, 161)[:, :-1].ravel()
faces = corner[:, None] + [0, 1, 162, 161]
cortex = vtkhaptics.polydata(
    sys.argv[1] if len(sys.argv) > 1 else (np.stack([x, y, folds], axis=2).reshape(-1, 3), faces)
)
if len(sys.argv) < 2:
    depth = numpy_to_vtk(-folds.ravel(), deep=True)
    depth.SetName("Depth")
    cortex.GetPointData().AddArray(depth)
shaded = vtkPolyDataNormals()
shaded.SetInputData(cortex)
shaded.SplittingOff()
surface = vtkhaptics.vtkGodObjectFilter()  # prepared once for all strokes
surface.SetInputConnection(shaded.GetOutputPort())
surface.Update()
cortex = shaded.GetOutput()
data = cortex.GetPointData()
points, normals = (vtk_to_numpy(a) for a in (cortex.GetPoints().GetData(), data.GetNormals()))
arrays = {n: data.GetArray(n) for n in value_arrays(cortex) if data.HasArray(n)}
values = [name for name, array in arrays.items() if array.GetNumberOfComponents() == 1]

random, rows, forces = np.random.default_rng(1), [], []
for stroke in range(30):  # down to 2 mm below the surface, and 10 mm along it
    start = random.integers(len(points))
    side = np.cross(normals[start], np.eye(3)[np.argmin(np.abs(normals[start]))])
    down = points[start] + normals[start] * np.linspace(5.0, -2.0, 100)[:, None]
    along = down[-1] + side * np.linspace(0.1, 10.0, 100)[:, None]
    t = vtkhaptics.trace(surface, np.vstack([down, along]), scale=0.001)
    forces.append(t.magnitude)
    # The trace has the surface's arrays, as they are where the god-object touches.
    columns = [np.full(len(t), stroke), np.arange(len(t)), t.magnitude, t.cell, *(t[n] for n in values)]
    rows.append(np.column_stack(columns)[t.touching])
folder = sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()
names = ",".join(["stroke", "tick", "force", "cell", *map(text_cell, values)])
with whole_file(os.path.join(folder, "palpation.csv")) as file:
    np.savetxt(file, np.vstack(rows), "%.9g", ",", header=names, comments="")
print(f"{sum(map(len, rows))} ticks in contact, up to {np.max(forces):.2f} N: {folder}/palpation.csv")
assert np.min(np.max(forces, axis=1)) > 0.05, "every stroke touches"
lines(os.path.join(folder, "palpation.png"), "tick", "force [N]", forces)
