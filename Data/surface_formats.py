"""Turns what packages hold into the bytes of a .vtp file, for get_surfaces.py.

Standard library, NumPy and the installed VTK only. VTK is imported late: most surfaces need none.
"""

import base64
import io
import math
import tempfile
import xml.etree.ElementTree
import zlib


def _write_vtp(data):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetWriteToOutputString(True)
    writer.SetDataModeToBinary()
    if not writer.Write():
        raise RuntimeError("VTK could not write the surface")
    return writer.GetOutputString().encode()


def _make_polydata(points, polygons, arrays=()):
    """`points` (n x 3) keep their precision; `polygons` (m x corners); `arrays`: (name, n values)."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    data = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=True))
    data.SetPoints(vtk_points)
    polygons = numpy.asarray(polygons, dtype=numpy.int64)
    offsets = numpy.arange(0, polygons.size + 1, polygons.shape[1], dtype=numpy.int64)
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(polygons.ravel(), deep=True))
    data.SetPolys(cells)
    for name, values in arrays:
        array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    return data


def off_to_vtp(contents):
    """An OFF file of triangles: "OFF", counts, points, then "3 a b c" each."""
    import numpy

    words = contents[0].decode().split()
    if words[0] != "OFF":
        raise ValueError(f"an OFF file begins with 'OFF', not '{words[0]}'")
    points, faces = int(words[1]), int(words[2])
    coordinates = numpy.array(words[4:4 + 3 * points], dtype=float).reshape(points, 3)
    corners = numpy.array(words[4 + 3 * points:4 + 3 * points + 4 * faces], dtype=int)
    return _write_vtp(_make_polydata(coordinates, corners.reshape(faces, 4)[:, 1:]))


def _read_gifti(content):
    """The arrays of a GIFTI file, each with its shape; little-endian, base64 of zlib, as in ours."""
    import numpy

    types = {"NIFTI_TYPE_FLOAT32": "<f4", "NIFTI_TYPE_INT32": "<i4"}
    arrays = []
    for element in xml.etree.ElementTree.fromstring(content).iter("DataArray"):
        shape = [int(element.get(f"Dim{i}")) for i in range(int(element.get("Dimensionality")))]
        values = zlib.decompress(base64.b64decode(element.find("Data").text))
        arrays.append(numpy.frombuffer(values, types[element.get("DataType")]).reshape(shape))
    return arrays


def gifti_to_vtp(contents):
    """Contents: the surface, then one file for each of four point arrays."""
    points, triangles = _read_gifti(contents[0])
    names = ("Sulc", "Curv", "Thickness", "Area")
    arrays = [(name, _read_gifti(content)[0]) for name, content in zip(names, contents[1:])]
    return _write_vtp(_make_polydata(points, triangles, arrays))


def heights_to_vtp(contents):
    """A grid of heights over longitude and latitude, laid flat in metres about its middle."""
    import numpy

    archive = numpy.load(io.BytesIO(contents[0]))
    heights = archive["elevation"].astype(float)
    rows, columns = heights.shape
    metres_per_degree = 111_200.0
    middle_latitude = 0.5 * (float(archive["ymin"]) + float(archive["ymax"]))
    dx = float(archive["dx"]) * metres_per_degree * math.cos(math.radians(middle_latitude))
    dy = float(archive["dy"]) * metres_per_degree
    x = (numpy.arange(columns) - 0.5 * (columns - 1)) * dx
    y = (0.5 * (rows - 1) - numpy.arange(rows)) * dy  # the first row is the northernmost
    points = numpy.column_stack([numpy.tile(x, rows), numpy.repeat(y, columns), heights.ravel()])
    ids = numpy.arange(rows * columns).reshape(rows, columns)
    north_west, north_east = ids[:-1, :-1].ravel(), ids[:-1, 1:].ravel()
    south_west, south_east = ids[1:, :-1].ravel(), ids[1:, 1:].ravel()
    triangles = numpy.concatenate([
        numpy.column_stack([south_west, south_east, north_east]),
        numpy.column_stack([south_west, north_east, north_west])])
    return _write_vtp(_make_polydata(points, triangles, [("Elevation", heights.ravel())]))


def image_to_vtp(contents):
    """The border of everything above 0.5 in a .vti image."""
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    reader = vtkXMLImageDataReader()
    with tempfile.NamedTemporaryFile(suffix=".vti") as file:
        file.write(contents[0])
        file.flush()
        reader.SetFileName(file.name)
        contour = vtkFlyingEdges3D()
        contour.SetInputConnection(reader.GetOutputPort())
        contour.SetValue(0, 0.5)
        contour.ComputeNormalsOff()
        contour.ComputeScalarsOff()
        contour.Update()
    return _write_vtp(contour.GetOutput())


def knot_to_vtp():
    """A tube around a trefoil knot, about 10 wide: closed, smooth, with concave and narrow places.

    The tube's cross-sections are turned as little as possible along the knot, and the remaining
    twist is spread over its length, so that the ends meet.
    """
    import numpy

    sections, corners, radius = 480, 48, 0.8
    t = numpy.linspace(0.0, 2.0 * math.pi, sections, endpoint=False)
    centres = numpy.column_stack([
        numpy.sin(t) + 2.0 * numpy.sin(2.0 * t),
        numpy.cos(t) - 2.0 * numpy.cos(2.0 * t),
        -1.6 * numpy.sin(3.0 * t)]) * 1.6
    tangents = numpy.roll(centres, -1, axis=0) - numpy.roll(centres, 1, axis=0)
    tangents /= numpy.linalg.norm(tangents, axis=1)[:, None]

    def transport(normal, tangent):
        normal = normal - normal.dot(tangent) * tangent
        return normal / numpy.linalg.norm(normal)

    normals = [transport(numpy.array([0.0, 0.0, 1.0]), tangents[0])]
    for tangent in tangents[1:]:
        normals.append(transport(normals[-1], tangent))
    normals = numpy.array(normals)
    closing = transport(normals[-1], tangents[0])
    twist = math.atan2(numpy.cross(closing, normals[0]).dot(tangents[0]), closing.dot(normals[0]))
    binormals = numpy.cross(tangents, normals)
    angles = (numpy.linspace(0.0, 2.0 * math.pi, corners, endpoint=False)[None, :] +
              (twist * numpy.arange(sections) / sections)[:, None])
    points = (centres[:, None, :] + radius * (
        numpy.cos(angles)[:, :, None] * normals[:, None, :] +
        numpy.sin(angles)[:, :, None] * binormals[:, None, :])).reshape(-1, 3)

    ids = numpy.arange(sections * corners).reshape(sections, corners)
    after, across = numpy.roll(ids, -1, axis=0), numpy.roll(ids, -1, axis=1)
    both = numpy.roll(after, -1, axis=1)
    quads = numpy.column_stack([ids.ravel(), across.ravel(), both.ravel(), after.ravel()])
    return _write_vtp(_make_polydata(points, quads))
