"""Files of many kinds become surfaces, and no file ends the process by a signal."""

import gzip
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingCore import vtkImageShiftScale, vtkRTAnalyticSource
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOImage import vtkNIFTIImageWriter
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkStructuredPointsWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLMultiBlockDataWriter,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter,
)

from vtkhaptics import surfaces
from vtkhaptics.surfaces import SurfaceError, read_surface


def write(writer, source, path):
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(path)
    if hasattr(writer, "SetDataModeToBinary"):
        writer.SetDataModeToBinary()
    assert writer.Write() in (1, None), path
    return path


def ball():
    source = vtkSphereSource()
    source.SetThetaResolution(16)
    source.SetPhiResolution(16)
    source.GenerateNormalsOff()
    source.Update()
    return source


def mesh():
    append = vtkAppendFilter()
    append.SetInputData(ball().GetOutput())
    return append


def image():
    source = vtkRTAnalyticSource()
    source.Update()
    short = vtkImageShiftScale()  # NIfTI takes few types
    short.SetInputData(source.GetOutput())
    short.SetOutputScalarTypeToShort()
    return short


def write_off(path):
    surface = ball().GetOutput()
    with open(path, "w", encoding="ascii") as file:
        print("OFF # a comment", surface.GetNumberOfPoints(), surface.GetNumberOfPolys(), 0, sep="\n",
              file=file)
        for i in range(surface.GetNumberOfPoints()):
            print(*surface.GetPoint(i), file=file)
        for i in range(surface.GetNumberOfCells()):
            ids = surface.GetCell(i).GetPointIds()
            print(3, *(ids.GetId(k) for k in range(3)), file=file)
    return path


def write_blocks(path):
    blocks = vtkMultiBlockDataSet()
    for i in range(2):
        blocks.SetBlock(i, ball().GetOutput())
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputData(blocks)
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    assert writer.Write() == 1
    return path


def test_surfaces_of_many_kinds(folder):
    triangles = ball().GetOutput().GetNumberOfPolys()
    files = {
        write(vtkSTLWriter(), ball(), os.path.join(folder, "a.stl")): triangles,
        write(vtkPLYWriter(), ball(), os.path.join(folder, "a.ply")): triangles,
        write(vtkOBJWriter(), ball(), os.path.join(folder, "a.obj")): triangles,
        write(vtkPolyDataWriter(), ball(), os.path.join(folder, "a.vtk")): triangles,
        write(vtkXMLPolyDataWriter(), ball(), os.path.join(folder, "a.vtp")): triangles,
        write(vtkXMLUnstructuredGridWriter(), mesh(), os.path.join(folder, "a.vtu")): triangles,
        write_off(os.path.join(folder, "a.off")): triangles,
        write_blocks(os.path.join(folder, "a.vtm")): 2 * triangles,
    }
    for path, count in files.items():
        assert read_surface(path).GetNumberOfPolys() == count, path
        if not path.endswith(".vtm"):  # its pieces lie in a folder of their own
            with open(path, "rb") as file, gzip.open(path + ".gz", "wb") as packed:
                shutil.copyfileobj(file, packed)
            assert read_surface(path + ".gz").GetNumberOfPolys() == count, path
    return list(files)


def test_images_and_contours(folder):
    for path in (
        write(vtkXMLImageDataWriter(), image(), os.path.join(folder, "i.vti")),
        write(vtkStructuredPointsWriter(), image(), os.path.join(folder, "i.vtk")),
        write(vtkNIFTIImageWriter(), image(), os.path.join(folder, "i.nii")),
        write(vtkNIFTIImageWriter(), image(), os.path.join(folder, "i.nii.gz")),
    ):
        outside, contour = read_surface(path), read_surface(path, contour=157.0)
        assert outside.GetNumberOfPolys() == 6 * 20 * 20, (path, outside.GetNumberOfPolys())
        assert contour.GetNumberOfPolys() > 1000, (path, contour.GetNumberOfPolys())
        try:
            read_surface(path, contour=1e6)
        except SurfaceError as error:
            assert "go from" in str(error) and path in str(error), error
        else:
            raise AssertionError(f"{path}: a contour where there is none")
    nrrd = os.path.join(folder, "i.nrrd")
    voxels = image()
    voxels.Update()
    values = vtk_to_numpy(voxels.GetOutput().GetPointData().GetScalars())
    with open(nrrd, "wb") as file:
        file.write(b"NRRD0004\ntype: short\ndimension: 3\nsizes: 21 21 21\nencoding: raw\n"
                   b"endian: little\nspacings: 1 1 1\n\n")
        file.write(values.astype("<i2").tobytes())
    assert read_surface(nrrd, contour=157.0).GetNumberOfPolys() > 1000


def run(path):
    return subprocess.run(
        [sys.executable, "-c",
         "import sys\nfrom vtkhaptics.surfaces import SurfaceError, read_surface\n"
         "for path in sys.argv[1:]:\n"
         "    try:\n        print(read_surface(path).GetNumberOfPolys())\n"
         "    except SurfaceError as error:\n        print(error)\n", *path],
        capture_output=True, encoding="utf-8", errors="replace", check=False)


def test_no_file_ends_the_process(folder, files):
    rng = random.Random(7)
    damaged = []
    for path in files:
        if path.endswith(".vtm"):
            continue
        with open(path, "rb") as file:
            whole = file.read()
        for number in range(12):
            name, extension = os.path.splitext(path)
            bad = f"{name}-{number}{extension}"
            data = bytearray(whole[: rng.randrange(len(whole))] if number % 2 else whole)
            for _ in range(20 if number % 2 == 0 else 0):
                data[rng.randrange(len(data))] = rng.randrange(256)
            with open(bad, "wb") as file:
                file.write(data)
            damaged.append(bad)
    corners = "".join(f"v {x} {y} 0\n" for x in (0, 1) for y in (0, 1))
    header = (
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    )
    for name, text in (
        ("from_zero.obj", corners + "f 0 1 2\n"),
        ("beyond.obj", corners + "f 1 2 998\n"),
        ("no_vt.obj", corners + "vn 0 0 1\n" * 4 + "f 1/1/1 2/2/2 3/3/3\n"),
        ("beyond.ply", header + "0 0 0\n0 1 0\n1 0 0\n1 1 0\n3 0 1 999\n"),
        ("cut.ply", header + "0 0 0\n0 1 0\n"),
    ):
        damaged.append(os.path.join(folder, name))
        with open(damaged[-1], "w", encoding="ascii") as file:
            file.write(text)
    done = run(damaged)
    assert done.returncode == 0, (done.returncode, done.stdout[-500:], done.stderr[-500:])
    named = [os.path.join(folder, name) for name in ("beyond.obj", "beyond.ply", "cut.ply")]
    for path in named:
        assert path in done.stdout, (path, done.stdout[-2000:])


def test_strips_of_a_ply_file_are_named(folder):
    path = os.path.join(folder, "strip.ply")
    header = (
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nelement tristrips 1\n"
        "property list int int vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        file.write(struct.pack("<12f5i", 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 4, 0, 1, 2, 3))
    try:
        surfaces.read_surface(path)
    except surfaces.SurfaceError as error:
        assert "strips" in str(error) and "save it with triangles" in str(error), error
    else:
        raise AssertionError("VTK reads strips from PLY by now: let them be touched")


def test_an_array_that_is_the_same_everywhere_colours_nothing(folder):
    path = os.path.join(folder, "plain.obj")  # VTK's reader adds ids of groups and materials
    with open(path, "w", encoding="ascii") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
    surface = surfaces.read_surface(path)
    assert surfaces.default_array(surface) is None, surfaces.default_array(surface)
    values = numpy_to_vtk(np.array([0.0, 0.0, 1.0, 0.0]), deep=True)
    values.SetName("height")
    surface.GetPointData().AddArray(values)
    assert surfaces.default_array(surface) == "height"


def test_formats_are_told():
    for extension in (".vtu", ".vti", ".vtm", ".off", ".glb", ".nii", ".nrrd", ".gii"):
        assert extension in surfaces.FORMATS, extension


with tempfile.TemporaryDirectory() as scratch:
    made = test_surfaces_of_many_kinds(scratch)
    test_images_and_contours(scratch)
    test_no_file_ends_the_process(scratch, made)
    test_strips_of_a_ply_file_are_named(scratch)
    test_an_array_that_is_the_same_everywhere_colours_nothing(scratch)
test_formats_are_told()
