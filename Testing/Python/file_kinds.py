"""A small file of each kind that the viewer reads, made here: see TestFiles.py."""

import gzip
import json
import os
import shutil
import struct

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkRectilinearGrid
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
    vtkXMLRectilinearGridWriter,
    vtkXMLStructuredGridWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid
from vtkmodules.vtkCommonCore import vtkPoints

try:
    import nibabel
except ImportError:
    nibabel = None

VALUE = 157.0  # between the values of image()


def write(writer, source, path):
    """Writes what a source makes, or a data object, with a writer of VTK's; the path."""
    if hasattr(source, "GetOutputPort"):
        writer.SetInputConnection(source.GetOutputPort())
    else:
        writer.SetInputData(source)
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


def triangles_of(surface):
    """Points and triangles of a surface, as arrays."""
    return (
        vtk_to_numpy(surface.GetPoints().GetData()),
        vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3),
    )


def image():
    source = vtkRTAnalyticSource()
    source.Update()
    short = vtkImageShiftScale()  # NIfTI takes few types
    short.SetInputData(source.GetOutput())
    short.SetOutputScalarTypeToShort()
    short.Update()
    return short


def voxels():
    """The values of image() as an array, slice by slice."""
    data = image().GetOutput()
    return vtk_to_numpy(data.GetPointData().GetScalars()).reshape(data.GetDimensions()[::-1])


def structured():
    data = image().GetOutput()
    grid, points = vtkStructuredGrid(), vtkPoints()
    for i in range(data.GetNumberOfPoints()):
        points.InsertNextPoint(data.GetPoint(i))
    grid.SetPoints(points)
    grid.SetDimensions(data.GetDimensions())
    grid.GetPointData().ShallowCopy(data.GetPointData())
    return grid


def rectilinear():
    from vtkmodules.util.numpy_support import numpy_to_vtk

    data = image().GetOutput()
    grid = vtkRectilinearGrid()
    grid.SetDimensions(data.GetDimensions())
    for name, count in zip("XYZ", data.GetDimensions()):
        getattr(grid, f"Set{name}Coordinates")(numpy_to_vtk(np.arange(float(count)), deep=True))
    grid.GetPointData().ShallowCopy(data.GetPointData())
    return grid


def mesh():
    append = vtkAppendFilter()
    append.SetInputData(ball().GetOutput())
    return append


def write_off(path):
    points, triangles = triangles_of(ball().GetOutput())
    with open(path, "w", encoding="ascii") as file:
        print("OFF # a comment", len(points), len(triangles), 0, sep="\n", file=file)
        for point in points:
            print(*point, file=file)
        for triangle in triangles:
            print(3, *triangle, file=file)
    return path


def write_blocks(path):
    blocks = vtkMultiBlockDataSet()
    for i in range(2):
        blocks.SetBlock(i, ball().GetOutput())
    return write(vtkXMLMultiBlockDataWriter(), blocks, path)


def write_nrrd(path):
    with open(path, "wb") as file:
        file.write(b"NRRD0004\ntype: short\ndimension: 3\nsizes: 21 21 21\nencoding: raw\n"
                   b"endian: little\nspacings: 1 1 1\n\n")
        file.write(voxels().astype("<i2").tobytes())
    return path


def write_glb(path):
    """glTF 2.0 in one binary file: a chunk of JSON that describes a chunk of numbers."""
    points, triangles = triangles_of(ball().GetOutput())
    numbers = points.astype("<f4").tobytes() + triangles.astype("<u2").tobytes()
    begin = len(points) * 12
    numbers += b"\0" * (-len(numbers) % 4)
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": begin, "target": 34962},
             {"buffer": 0, "byteOffset": begin, "byteLength": triangles.size * 2, "target": 34963}]
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
         "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()},
        {"bufferView": 1, "componentType": 5123, "count": triangles.size, "type": "SCALAR"}]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
        "buffers": [{"byteLength": len(numbers)}], "bufferViews": views, "accessors": accessors,
    }).encode("ascii")
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(numbers)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(numbers), b"BIN\0") + numbers)
    return path


def _element(group, number, kind, value):
    """An element of a DICOM file in explicit little endian."""
    value += (b"\0" if kind == b"UI" else b" ") * (len(value) % 2)
    size = struct.pack("<HI", 0, len(value)) if kind in (b"OW", b"OB") else struct.pack("<H", len(value))
    return struct.pack("<HH2s", group, number, kind) + size + value


def write_dicom(folder):
    """A folder with one file for each slice of image()."""
    os.makedirs(folder)
    for i, slice_ in enumerate(voxels()):
        rows, columns = slice_.shape
        meta = _element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1")
        body = b"".join(_element(group, number, kind, value) for group, number, kind, value in (
            (0x20, 0x0D, b"UI", b"1.2.3"), (0x20, 0x0E, b"UI", b"1.2.3.4"),
            (0x20, 0x13, b"IS", str(i + 1).encode()),
            (0x20, 0x32, b"DS", f"0\\0\\{i}".encode()),
            (0x20, 0x37, b"DS", b"1\\0\\0\\0\\1\\0"),
            (0x28, 0x02, b"US", struct.pack("<H", 1)),
            (0x28, 0x04, b"CS", b"MONOCHROME2"),
            (0x28, 0x10, b"US", struct.pack("<H", rows)),
            (0x28, 0x11, b"US", struct.pack("<H", columns)),
            (0x28, 0x30, b"DS", b"1\\1"),
            (0x28, 0x100, b"US", struct.pack("<H", 16)),
            (0x28, 0x101, b"US", struct.pack("<H", 16)),
            (0x28, 0x102, b"US", struct.pack("<H", 15)),
            (0x28, 0x103, b"US", struct.pack("<H", 1)),
            (0x28, 0x1052, b"DS", b"0"), (0x28, 0x1053, b"DS", b"1"),
            (0x7FE0, 0x10, b"OW", slice_.astype("<i2").tobytes()),
        ))
        with open(os.path.join(folder, f"{i:03}.dcm"), "wb") as file:
            file.write(b"\0" * 128 + b"DICM")
            file.write(_element(2, 0, b"UL", struct.pack("<I", len(meta))) + meta + body)
    return folder


def write_gifti(path, meshes=1):
    """GIfTI with one mesh or several, each with values."""
    points, triangles = triangles_of(ball().GetOutput())
    image_ = nibabel.gifti.GiftiImage()
    for i in range(meshes):
        for data, intent in (
            (points + 2.0 * i, "NIFTI_INTENT_POINTSET"),
            (triangles.astype(np.int32), "NIFTI_INTENT_TRIANGLE"),
        ):
            image_.add_gifti_data_array(nibabel.gifti.GiftiDataArray(data, intent=intent))
    depths = nibabel.gifti.GiftiDataArray(
        np.tile(points[:, 2], meshes).astype(np.float32), intent="NIFTI_INTENT_SHAPE")
    depths.meta = nibabel.gifti.GiftiMetaData(Name="depth")
    image_.add_gifti_data_array(depths)
    nibabel.save(image_, path)
    return path


def write_freesurfer(path):
    """FreeSurfer's binary surface, whose files have no extension of their own (lh.pial)."""
    points, triangles = triangles_of(ball().GetOutput())
    with open(path, "wb") as file:
        file.write(b"\xff\xff\xfecreated by a test\n\n" + struct.pack(">2i", len(points), len(triangles)))
        file.write(points.astype(">f4").tobytes() + triangles.astype(">i4").tobytes())
    return path


def pack(path):
    with open(path, "rb") as file, gzip.open(path + ".gz", "wb") as packed:
        shutil.copyfileobj(file, packed)
    return path + ".gz"


def surfaces_in(folder):
    """Files with a surface each, by path, with the number of its triangles."""
    count = ball().GetOutput().GetNumberOfPolys()

    def at(name):
        return os.path.join(folder, name)

    files = {
        write(vtkSTLWriter(), ball(), at("a.stl")): count,
        write(vtkPLYWriter(), ball(), at("a.ply")): count,
        write(vtkOBJWriter(), ball(), at("a.obj")): count,
        write(vtkPolyDataWriter(), ball(), at("a.vtk")): count,
        write(vtkXMLPolyDataWriter(), ball(), at("a.vtp")): count,
        write(vtkXMLUnstructuredGridWriter(), mesh(), at("a.vtu")): count,
        write_off(at("a.off")): count,
        write_glb(at("a.glb")): count,
        write_blocks(at("a.vtm")): 2 * count,
    }
    if nibabel:
        files[write_freesurfer(at("lh.pial"))] = count
        files[write_gifti(at("a.gii"))] = count
        files[write_gifti(at("several.gii"), 3)] = 3 * count
    return files


def images_in(folder):
    """Files with the values of image() each, and a folder of slices."""

    def at(name):
        return os.path.join(folder, name)

    return [
        write(vtkXMLImageDataWriter(), image(), at("i.vti")),
        write(vtkXMLStructuredGridWriter(), structured(), at("i.vts")),
        write(vtkXMLRectilinearGridWriter(), rectilinear(), at("i.vtr")),
        write(vtkStructuredPointsWriter(), image(), at("i.vtk")),
        write(vtkNIFTIImageWriter(), image(), at("i.nii")),
        write(vtkNIFTIImageWriter(), image(), at("i.nii.gz")),
        write_nrrd(at("i.nrrd")),
        write_dicom(at("slices")),
    ]
