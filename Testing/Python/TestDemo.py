"""The demo leaves its picture, trace and table, and says what is wrong with bad input."""

import math
import os
import subprocess
import sys
import tempfile

import numpy as np
from vtkhaptics.picture import stroke_lines
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkParametricFunctionSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def demo(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "vtkhaptics.demo", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def write(source, path):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    assert writer.Write() == 1
    return path


def test_touches_a_surface(folder):
    torus = vtkParametricFunctionSource()
    torus.SetParametricFunction(vtkParametricTorus())
    torus.Update()
    stray = vtkPolyData()
    stray.DeepCopy(torus.GetOutput())
    stray.GetPoints().InsertNextPoint(math.nan, math.nan, math.nan)  # of no triangle
    stray.GetPointData().Initialize()
    producer = vtkTrivialProducer()
    producer.SetOutput(stray)
    surface = write(producer, os.path.join(folder, "torus.vtp"))
    output = os.path.join(folder, "made", "here")
    done = demo("--surface", surface, "--output", output, "--seconds", "3", "--offscreen")
    assert done.returncode == 0, done.stdout + done.stderr
    for row in ("ticks", "in contact", "rate", "E[T^2]/E[T]", "T_max", "median", "p99.9"):
        assert row in done.stdout, row
    picture = vtkPNGReader()
    picture.SetFileName(os.path.join(output, "touched.png"))
    picture.Update()
    assert picture.GetOutput().GetDimensions() == (1200, 800, 1)
    assert picture.GetOutput().GetScalarRange()[1] > 200, "the picture is dark"
    trace = vtkXMLPolyDataReader()
    trace.SetFileName(os.path.join(output, "trace.vtp"))
    trace.Update()
    data = trace.GetOutput().GetPointData()
    ticks = trace.GetOutput().GetNumberOfPoints()
    assert ticks > 1000, ticks  # 3000 on a machine that keeps up
    touched = sum(
        data.GetArray("ActiveConstraints").GetValue(i) > 0 for i in range(ticks)
    )
    assert touched > ticks / 2, (touched, ticks)
    for name in ("Time", "HapticInterfacePoint", "Force", "Surface", "OriginalCellId"):
        assert data.HasArray(name), name


def test_bad_input(folder):
    output = os.path.join(folder, "out")
    lines = write(vtkLineSource(), os.path.join(folder, "lines.vtp"))
    garbage = os.path.join(folder, "garbage.stl")
    empty = os.path.join(folder, "empty.ply")
    with open(garbage, "w", encoding="ascii") as file:
        file.write("no surface")
    with open(empty, "w", encoding="ascii"):
        pass
    for path, text in (
        (lines, "no polygons"),
        (garbage, "could not be read"),
        (empty, "could not be read"),
        (os.path.join(folder, "missing.stl"), "no such file"),
        (__file__, "not known"),
    ):
        failed = demo("--surface", path, "--output", output, "--offscreen")
        assert failed.returncode == 2, (path, failed.returncode, failed.stderr)
        assert text in failed.stderr and path in failed.stderr, failed.stderr
        assert "Traceback" not in failed.stderr, failed.stderr
    for options in (("--surface", "", "--output", output), ("--surface", lines, "--output", "")):
        failed = demo(*options, "--offscreen")
        assert failed.returncode == 2 and "is empty; give a name" in failed.stderr, failed
    assert not os.path.exists(output), "nothing is written before there is a surface"


def test_a_stroke_is_drawn_by_its_length():
    # Of a minute and more, of a hand that rests for the second half: who closes the window waits for it.
    ticks = 100_000
    way = np.minimum(np.linspace(0.0, 2.0, ticks), 1.0)
    trace = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([way, 0.0 * way, 0.0 * way], axis=1), deep=True))
    trace.SetPoints(points)
    touching = np.ones(ticks)
    touching[25_000:25_100] = 0.0
    for name, values in (("Force", np.ones((ticks, 3))), ("ActiveConstraints", touching)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        trace.GetPointData().AddArray(array)
    lines = stroke_lines(trace, 0.01)
    assert lines.GetNumberOfLines() == 2, lines.GetNumberOfLines()
    assert 95 <= lines.GetNumberOfPoints() <= 105, lines.GetNumberOfPoints()
    assert abs(lines.GetLength() - 1.0) < 0.02, lines.GetBounds()


def test_arguments(folder):
    assert "examples:" in demo("--help").stdout
    assert demo("--surface", "a.stl").returncode == 2
    assert demo("--surface", "a.stl", "--output", folder, "--seconds", "0").returncode == 2


with tempfile.TemporaryDirectory() as scratch:
    test_touches_a_surface(scratch)
    test_bad_input(scratch)
    test_arguments(scratch)
test_a_stroke_is_drawn_by_its_length()
