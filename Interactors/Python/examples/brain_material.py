"""Strokes a brain: where the cortex is thin it is soft, deep in its folds it is rough.

usage: brain_material.py [PIAL.vtp [PICTURE.png [TRACE.vtp]]]

The surface is that of `python3 Data/get_surfaces.py pial` (default build/surfaces/pial.vtp) [mm], with
the cortical thickness [mm] and the depth of the folds at its points. A hand without a device strokes
over it. The picture shows the thickness, the stroke and the force along it.
"""

import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject,
    vtkPolyData,
    vtkStaticCellLocator,
    vtkTable,
)
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
)

from vtkhaptics import vtkGodObjectFilter, vtkGodObjectTrace, vtkHapticProperties
from vtkhaptics.display import ensure_script_display
from vtkhaptics.output import write_png, write_polydata
from vtkhaptics.stroke import View

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS

source = os.environ.get("HAPTICS_SOURCE_DIR", ".")
if len(sys.argv) > 2:
    ensure_script_display()  # it draws
name = sys.argv[1] if len(sys.argv) > 1 else os.path.join(source, "build/surfaces/pial.vtp")
if not os.path.exists(name):
    print(f"there is no {name}: get it with `python3 Data/get_surfaces.py pial`")
    sys.exit(0 if len(sys.argv) < 2 else 1)
reader = vtkXMLPolyDataReader()
reader.SetFileName(name)

brain = vtkGodObjectFilter()
brain.SetInputConnection(reader.GetOutputPort())
material = brain.GetProperties()
# The least thickness has 150 N/m, the greatest 700 N/m.
brain.SetInputArrayToProcess(vtkHapticProperties.STIFFNESS, 0, 0, POINTS, "Thickness")
material.SetRange(vtkHapticProperties.STIFFNESS, 150.0, 700.0)
# Smooth on the ridges, rough in the depth of the folds.
brain.SetInputArrayToProcess(vtkHapticProperties.STATIC_FRICTION, 0, 0, POINTS, "Sulc")
material.SetRange(vtkHapticProperties.STATIC_FRICTION, 0.05, 0.5)
brain.SetInputArrayToProcess(vtkHapticProperties.DYNAMIC_FRICTION, 0, 0, POINTS, "Sulc")
material.SetRange(vtkHapticProperties.DYNAMIC_FRICTION, 0.05, 0.4)
material.ForceShadingOn()
material.SetFeatureAngle(60.0)
brain.Update()

# A hand that goes round over the ridges and folds of the outer side, 1.5 mm under their height as a
# finger would stroke it: ten seconds, one place a millisecond.
view = View(brain.GetOutput(), azimuth=180.0, elevation=15.0)
locator = vtkStaticCellLocator()
locator.SetDataSet(brain.GetOutput())
locator.BuildLocator()
ticks = np.arange(0.0, 10.0, 0.001)
coarse = np.linspace(0.0, 10.0, 1000)
right, up = -16.0 + 20.0 * np.cos(0.2 * np.pi * coarse), 24.0 + 10.0 * np.sin(0.4 * np.pi * coarse)
height = view.heights(locator, right, up)
height = np.convolve(np.pad(height, 20, mode="wrap"), np.hanning(43)[1:-1] / 21.0, mode="valid")
height = height[: len(coarse)] - 1.5 + 8.0 * np.exp(-4.0 * coarse) + 8.0 * np.exp(4.0 * (coarse - 10.0))
places = view.to_world(right, up, height)
points = vtkPoints()
points.SetData(
    numpy_to_vtk(np.stack([np.interp(ticks, coarse, c) for c in places.T], axis=1), deep=True)
)
path = vtkPolyData()
path.SetPoints(points)

trace = vtkGodObjectTrace()
trace.SetInputData(path)
trace.SetSurfaceConnection(brain.GetOutputPort())
trace.SetWorldToDeviceScale(0.001)  # a brain in mm, in its own size
trace.Update()
result = trace.GetOutput()


def values(name):
    return vtk_to_numpy(result.GetPointData().GetArray(name))


touching = values("ActiveConstraints") > 0
stiffness, energy = values("Stiffness"), values("Energy")
force = np.linalg.norm(values("Force"), axis=1)
print(
    f"{touching.sum()} of {len(touching)} ticks touch; {stiffness[touching].min():.0f} to "
    f"{stiffness[touching].max():.0f} N/m, up to {force.max():.2f} N; the hand has put in "
    f"{1000 * energy[-1]:.1f} mJ"
)
assert touching.sum() > 5000
assert stiffness[touching].max() < 700.1 and stiffness[touching].min() > 149.9
assert np.ptp(stiffness[touching]) > 50.0, "the thickness counts"
assert energy[-1] > 0.0, "friction takes, and nothing gives"

if len(sys.argv) > 3:
    write_polydata(sys.argv[3], result, inputs=[name])

if len(sys.argv) > 2:
    from vtkmodules.vtkChartsCore import vtkChart, vtkChartXY
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingContext2D import vtkContextActor
    import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401  (registers what draws charts)
    from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkWindowToImageFilter

    colors = vtkColorTransferFunction()
    lowest, highest = brain.GetOutput().GetPointData().GetArray("Thickness").GetRange()
    for share, rgb in ((0.0, (0.20, 0.30, 0.60)), (0.5, (0.87, 0.86, 0.80)), (1.0, (0.75, 0.25, 0.15))):
        colors.AddRGBPoint(lowest + share * (highest - lowest), *rgb)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(brain.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("Thickness")
    mapper.SetLookupTable(colors)
    cortex = vtkActor()
    cortex.SetMapper(mapper)
    tube = vtkTubeFilter()
    tube.SetInputData(result)
    tube.SetRadius(0.5)
    tube.SetNumberOfSides(12)
    line = vtkPolyDataMapper()
    line.SetInputConnection(tube.GetOutputPort())
    line.ScalarVisibilityOff()
    stroke = vtkActor()
    stroke.SetMapper(line)
    stroke.GetProperty().SetColor(0.1, 0.1, 0.1)
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("cortical thickness [mm]")
    bar.SetLabelFormat("%.1f")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.55, 0.01)
    bar.SetWidth(0.42)
    bar.SetHeight(0.09)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
        text.ShadowOff()
        text.ItalicOff()
    scene = vtkRenderer()
    scene.SetViewport(0.0, 0.32, 1.0, 1.0)
    scene.SetBackground(1.0, 1.0, 1.0)
    for prop in (cortex, stroke, bar):
        scene.AddViewProp(prop)
    camera = scene.GetActiveCamera()
    camera.SetFocalPoint(view.center)
    camera.SetPosition(view.center + 3.0 * view.radius * view.out)
    camera.SetViewUp(view.up)
    scene.ResetCamera()
    camera.Zoom(1.4)

    table = vtkTable()
    shown = {"Time [s]": ticks, "force [N]": force, "stiffness [N/m] / 300": stiffness / 300.0}
    for title, column in shown.items():
        array = numpy_to_vtk(np.ascontiguousarray(column[::10]), deep=True)
        array.SetName(title)
        table.AddColumn(array)
    chart = vtkChartXY()
    for column, rgb in ((1, (0.75, 0.25, 0.15)), (2, (0.2, 0.3, 0.6))):
        plot = chart.AddPlot(vtkChart.LINE)
        plot.SetInputData(table, 0, column)
        plot.SetColorF(*rgb)
        plot.SetWidth(2.0)
    chart.GetAxis(0).SetTitle("")
    chart.GetAxis(1).SetTitle("time [s]")
    chart.SetShowLegend(True)
    context = vtkContextActor()
    context.GetScene().AddItem(chart)
    plots = vtkRenderer()
    plots.SetViewport(0.0, 0.0, 1.0, 0.32)
    plots.SetBackground(1.0, 1.0, 1.0)
    plots.AddViewProp(context)
    context.GetScene().SetRenderer(plots)

    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(900, 900)
    window.SetMultiSamples(8)
    window.AddRenderer(scene)
    window.AddRenderer(plots)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    write_png(sys.argv[2], picture.GetOutput(), inputs=[name])
    print(f"picture: {sys.argv[2]}")
