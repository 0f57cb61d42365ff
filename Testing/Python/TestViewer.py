"""The viewer draws, records, replays and says what is wrong, each with its exit status."""

import os
import subprocess
import sys
import tempfile

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def viewer(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "vtkhaptics", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def write(data, path):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    assert writer.Write() == 1
    return path


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def ball(x, folder):
    source = vtkSphereSource()
    source.SetCenter(x, 0.0, 0.0)
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    source.Update()
    surface = source.GetOutput()
    height = vtkDoubleArray()
    height.SetName("Height")
    for i in range(surface.GetNumberOfPoints()):
        height.InsertNextValue(surface.GetPoint(i)[2])
    surface.GetPointData().AddArray(height)
    return write(surface, os.path.join(folder, f"ball{x:g}.vtp"))


def colors(path):
    """How many pixels of a picture have a strong colour."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    return int((pixels.max(axis=1) - pixels.min(axis=1) > 90).sum())


def test_touches_with_the_mouse_and_replays_it(folder):
    surface = ball(0.0, folder)
    picture, trace = (os.path.join(folder, name) for name in ("a.png", "a.vtp"))
    common = ("--offscreen", "--size", "300", "200", "--seconds", "2")
    done = viewer(surface, *common, "--screenshot", picture, "--trace", trace)
    assert done.returncode == 0, done.stderr
    assert "length unit" in done.stdout, "a file without a unit is said to be one"
    touched = vtk_to_numpy(read(trace).GetPointData().GetArray("ActiveConstraints")) > 0
    assert touched.mean() > 0.5, touched.mean()
    plain = colors(picture)

    again = os.path.join(folder, "again.vtp")
    done = viewer(surface, *common, "--device", trace, "--trace", again)
    assert done.returncode == 0, done.stderr
    arrays = [
        vtk_to_numpy(read(path).GetPointData().GetArray("HapticInterfacePoint"))
        for path in (trace, again)
    ]
    count = min(map(len, arrays)) - 2
    assert abs(arrays[0][:count] - arrays[1][:count]).max() < 1e-3, "the recording is followed"

    done = viewer(
        surface, ball(1.1, folder), *common, "--scalars", "Height", "--side", "both",
        "--screenshot", picture,
    )
    assert done.returncode == 0, done.stderr
    assert colors(picture) > 2 * plain, "the values are not coloured"


def test_simulated(folder):
    trace = os.path.join(folder, "s.vtp")
    done = viewer(
        ball(0.0, folder), "--device", "simulated", "--offscreen", "--seconds", "2", "--trace", trace
    )
    assert done.returncode == 0, done.stderr
    touched = vtk_to_numpy(read(trace).GetPointData().GetArray("ActiveConstraints")) > 0
    assert touched.mean() > 0.3, touched.mean()


def test_bad_input(folder):
    surface = ball(0.0, folder)
    line = vtkLineSource()
    line.Update()
    lines = write(line.GetOutput(), os.path.join(folder, "lines.vtp"))
    empty = os.path.join(folder, "empty.stl")
    with open(empty, "w", encoding="ascii"):
        pass
    for status, told, arguments in (
        (2, "no polygons", (lines,)),
        (2, "could not be read", (empty,)),
        (2, "no such file", (os.path.join(folder, "missing.stl"),)),
        (2, "not known", (__file__,)),
        (2, "It has: ", (surface, "--scalars", "Hieght")),
        (1, "neither a device", (surface, "--device", "mice")),
        (1, "holds no recorded hand", (surface, "--device", lines)),
        (1, "could not be written", (surface, "--trace", os.path.join(folder, "no", "t.vtp"))),
        (2, "out of range", (surface, "--stiffness", "-1")),
        (2, "must end in .png", (surface, "--screenshot", "a.jpg")),
        (2, "required", ()),
    ):
        failed = viewer(*arguments, "--offscreen", "--seconds", "2")
        assert failed.returncode == status, (arguments, failed.returncode, failed.stderr)
        assert told in failed.stderr, (told, failed.stderr)
        assert "Traceback" not in failed.stderr, failed.stderr


def test_help():
    done = viewer("--help")
    assert done.returncode == 0
    for named in ("examples:", "exit status:", "--device", ".gii"):
        assert named in done.stdout, named


def test_without_a_display_says_so(folder):
    environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    done = subprocess.run(
        [sys.executable, "-m", "vtkhaptics", ball(0.0, folder)],
        env=environment, capture_output=True, text=True, check=False,
    )
    assert done.returncode == 3 and "--offscreen" in done.stderr, done.stderr


with tempfile.TemporaryDirectory() as scratch:
    for test in (test_touches_with_the_mouse_and_replays_it, test_simulated, test_bad_input):
        test(scratch)
    test_help()
    test_without_a_display_says_so(scratch)
