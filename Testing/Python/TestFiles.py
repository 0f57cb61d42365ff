"""Files of many kinds become surfaces, and no file ends the process by a signal."""

import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile

import file_kinds
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from vtkhaptics import surfaces
from vtkhaptics.surfaces import SurfaceError, read_surface


def test_surfaces_of_many_kinds(folder):
    files = file_kinds.surfaces_in(folder)
    for path, count in files.items():
        assert read_surface(path).GetNumberOfPolys() == count, path
        if not path.endswith(".vtm"):  # its pieces lie in a folder of their own
            assert read_surface(file_kinds.pack(path)).GetNumberOfPolys() == count, path
    return list(files)


def test_images_and_contours(folder):
    paths = file_kinds.images_in(folder)
    for path in paths:
        outside, contour = read_surface(path), read_surface(path, contour=file_kinds.VALUE)
        assert outside.GetNumberOfPolys() == 6 * 20 * 20, (path, outside.GetNumberOfPolys())
        assert contour.GetNumberOfPolys() > 1000, (path, contour.GetNumberOfPolys())
        try:
            read_surface(path, contour=1e6)
        except SurfaceError as error:
            assert "go from" in str(error) and path in str(error), error
        else:
            raise AssertionError(f"{path}: a contour where there is none")
    return paths


def test_several_meshes_in_one_file(folder):
    if not file_kinds.nibabel:
        print("left out: GIfTI and FreeSurfer need nibabel (Debian: python3-nibabel)")
        return
    surface = read_surface(os.path.join(folder, "several.gii"))
    depth = vtk_to_numpy(surface.GetPointData().GetArray("depth"))
    low, high = surface.GetBounds()[::2], surface.GetBounds()[1::2]
    assert len(depth) == surface.GetNumberOfPoints()
    assert high[0] - low[0] > 4.9, "they lie next to each other"


def run(path):
    return subprocess.run(
        [sys.executable, "-c",
         "import sys\nfrom vtkhaptics.surfaces import SurfaceError, read_surface\n"
         "for path in sys.argv[1:]:\n"
         "    try:\n        print(read_surface(path).GetNumberOfPolys())\n"
         "    except SurfaceError as error:\n        print(error)\n", *path],
        capture_output=True, encoding="utf-8", errors="replace", check=False)


def damage(path, number, rng):
    """A copy of a file, or of a folder with one of its files, that is cut or has wrong bytes."""
    base, dot, extension = os.path.basename(path).partition(".")
    bad = target = os.path.join(os.path.dirname(path), f"{base}-{number}{dot}{extension}")
    if os.path.isdir(path):
        shutil.copytree(path, bad)
        target = os.path.join(bad, rng.choice(sorted(os.listdir(bad))))
    else:
        shutil.copy(path, bad)
    with open(target, "rb") as file:
        data = bytearray(file.read())
    if number % 2:
        data = data[: rng.randrange(len(data))]
    else:
        begin = len(data) if number % 4 else min(len(data), 600)  # anywhere, or in what describes it
        for _ in range(12):
            data[rng.randrange(begin)] = rng.randrange(256)
    with open(target, "wb") as file:
        file.write(data)
    return bad


def test_no_file_ends_the_process(folder, files):
    rng = random.Random(7)
    damaged = [damage(path, number, rng) for path in files for number in range(6)]
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
        ("beyond.vtu", grid(connectivity="0 1 2 77")),
        ("beyond.vtp", plane(connectivity="0 1 77")),
        ("offsets.vtp", plane(offsets="9999")),
        ("many.vtp", plane(points=99999999999)),
    ):
        damaged.append(os.path.join(folder, name))
        with open(damaged[-1], "w", encoding="ascii") as file:
            file.write(text)
    done = run(damaged)
    assert done.returncode == 0, (done.returncode, done.stdout[-500:], done.stderr[-500:])
    named = (
        "beyond.obj", "beyond.ply", "cut.ply", "beyond.vtu", "beyond.vtp", "offsets.vtp", "many.vtp")
    for name in named:
        assert os.path.join(folder, name) in done.stdout, (name, done.stdout[-2000:])


def xml(kind, points, cells, piece):
    """A file of VTK's with the corners of a unit square, as text."""
    return (
        f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64"><{kind}>'
        f'<Piece NumberOfPoints="{points}" {piece}><Points><DataArray type="Float32" '
        'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points>'
        f"{cells}</Piece></{kind}></VTKFile>"
    )


def plane(points=4, connectivity="0 1 2", offsets="3"):
    return xml("PolyData", points, '<Polys><DataArray type="Int64" Name="connectivity" '
               f'format="ascii">{connectivity}</DataArray><DataArray type="Int64" Name="offsets" '
               f'format="ascii">{offsets}</DataArray></Polys>', 'NumberOfPolys="1"')


def grid(connectivity):
    return xml("UnstructuredGrid", 4, '<Cells><DataArray type="Int64" Name="connectivity" '
               f'format="ascii">{connectivity}</DataArray><DataArray type="Int64" Name="offsets" '
               'format="ascii">4</DataArray><DataArray type="UInt8" Name="types" format="ascii">10'
               "</DataArray></Cells>", 'NumberOfCells="1"')


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


def test_formats_are_known():
    for extension in (".vtu", ".vti", ".vtm", ".off", ".glb", ".nii", ".nrrd", ".gii"):
        assert extension in surfaces.FORMATS, extension


with tempfile.TemporaryDirectory() as scratch:
    made = test_surfaces_of_many_kinds(scratch)
    made += test_images_and_contours(scratch)
    test_several_meshes_in_one_file(scratch)
    test_no_file_ends_the_process(scratch, made)
    test_strips_of_a_ply_file_are_named(scratch)
    test_an_array_that_is_the_same_everywhere_colours_nothing(scratch)
test_formats_are_known()
