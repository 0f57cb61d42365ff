"""Image guidance: an isosurface of a volume is touched, and a plane cuts the volume at the contact.

usage: study_image_guided.py [PICTURE.png]
"""

import os
import sys
import tempfile

import numpy as np
import vtkhaptics
from vtkhaptics.figures import lines
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter, vtkFlyingEdges3D

SIZE, SPACING, LEVEL = 64, 0.002, 0.5  # samples a side; [m]
axis = SPACING * (np.arange(SIZE) - 0.5 * (SIZE - 1))
x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
samples = np.exp(-(x**2 + y**2 + 2.0 * z**2) / 0.04**2) + np.exp(-((x - 0.02) ** 2 + y**2 + z**2) / 0.01**2)
volume = vtkImageData()
volume.SetDimensions(SIZE, SIZE, SIZE)
volume.SetSpacing(SPACING, SPACING, SPACING)
volume.SetOrigin(axis[0], axis[0], axis[0])
volume.GetPointData().SetScalars(numpy_to_vtk(samples.ravel(order="F"), deep=True))
organ = vtkFlyingEdges3D()
organ.SetInputData(volume)
organ.SetValue(0, LEVEL)
plane = vtkPlane()
plane.SetNormal(0.0, 1.0, 0.0)
slice_ = vtkCutter()
slice_.SetInputData(volume)
slice_.SetCutFunction(plane)

device, scene = vtkhaptics.vtkSimulatedHapticDevice(), vtkhaptics.vtkHapticScene()
scene.SetDevice(device)
scene.AddSurface(organ.GetOutputPort())
cuts = []


def cut(scene, event, probe):
    """Moves the plane to the contact and looks at what it shows there."""
    plane.SetOrigin(probe.GetPosition())
    slice_.Update()
    cuts.append((probe.GetPosition(), vtk_to_numpy(slice_.GetOutput().GetPointData().GetScalars())))


scene.AddObserver("ContactBeginEvent", cut)
scene.AddObserver("ContactSlideEvent", cut)
for tick in range(400):
    device.SetPosition(0.0, 0.0001 * tick - 0.02, 0.05 if tick < 1 else 0.018)
    scene.Step(1)
heights = np.array([1e3 * position[1] for position, _ in cuts])
inside = np.array([(values > LEVEL).mean() for _, values in cuts])
print(f"{len(cuts)} cuts from y = {heights.min():.1f} to {heights.max():.1f} mm, {inside.max():.0%} organ at most")
assert len(cuts) > 100 and np.ptp(heights) > 20.0 and inside.min() > 0.0
picture = sys.argv[1] if len(sys.argv) > 1 else os.path.join(tempfile.mkdtemp(), "cuts.png")
lines(picture, "cut", "share of the organ", [inside])
