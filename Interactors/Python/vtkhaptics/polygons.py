"""Polygons as they are touched: VTK draws each as a fan of triangles about its first corner, which covers
what a concave one leaves open and folds a warped one along another diagonal."""

import contextlib

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes, vtkPolyData

from . import vtkGodObjectFilter
from .errors import HapticsError
from .volumes import check_cells

FACING = 0.99  # cosine of the angle by which a triangle of the fan may differ from its polygon
SLIVER = 1e-6  # of a polygon's area: what is smaller faces anywhere
AT_ONCE = 100_000  # polygons that are looked at: for the memory, and for who waits or presses Ctrl-C


def has_polygons(surface):
    """Whether a vtkPolyData has polygons of other than three corners. Takes no time a triangle."""
    return surface.GetPolys().IsHomogeneous() not in (0, 3)


def drawable(surface, progress=None):
    """A vtkPolyData that VTK draws as it is touched, in filled triangles and in lines: `surface` itself
    where it does so, else a copy with triangles in place of some polygons, and the values of those.
    Where nothing can be touched, which other places report, it is `surface` too. `progress` is called with
    0 to 1. Raises NoSurfaceError, a ValueError, where a cell names a point that is not there."""
    check_cells(surface)
    if not has_polygons(surface):
        return surface
    points = vtk_to_numpy(surface.GetPoints().GetData())
    polygons, corners = surface.GetPolys(), vtk_to_numpy(surface.GetPolys().GetConnectivityArray())
    size = polygons.IsHomogeneous()
    offsets = (  # from VTK 9.5 on equal ones may be no array in memory
        np.arange(polygons.GetNumberOfCells() + 1) * size if size > 0
        else vtk_to_numpy(polygons.GetOffsetsArray()))
    wrong = _wrong_fans(points, offsets, corners)
    if not len(wrong):
        return surface
    sizes = np.diff(offsets)
    is_kept = np.ones(len(sizes), bool)
    is_kept[wrong] = False
    is_kept_corner = np.repeat(is_kept, sizes)
    of_wrong = corners[~is_kept_corner]
    ends = np.cumsum(sizes[wrong])
    begins = ends - sizes[wrong]
    parts = []
    for first in range(0, len(wrong), AT_ONCE):
        part = slice(first, first + AT_ONCE)
        begin = begins[first]
        cut, of_cells = _as_touched(points[of_wrong[begin : ends[part][-1]]], sizes[wrong[part]])
        parts.append((cut + begin, wrong[part][of_cells]))
        if progress:
            progress((first + len(begins[part])) / len(wrong))
    triangles, of_cells = map(np.concatenate, zip(*parts))
    if not len(triangles):
        return surface
    following = np.arange(1, len(of_wrong) + 1)
    following[ends - 1] = begins
    is_edge = following[triangles] == np.roll(triangles, -1, axis=1)
    return _with_triangles(
        surface, is_kept, sizes[is_kept], corners[is_kept_corner], of_wrong[triangles], of_cells, is_edge)


def _wrong_fans(points, offsets, corners):
    """The polygons whose fan does not face everywhere as they do."""
    sizes = np.diff(offsets)
    wrong = [np.empty(0, np.int64)]
    large = np.flatnonzero(sizes > 3)
    for cells in (large[i : i + AT_ONCE] for i in range(0, len(large), AT_ONCE)):
        counts = sizes[cells] - 2
        first = np.cumsum(counts) - counts  # triangle of each polygon
        in_fan = np.arange(counts.sum()) - np.repeat(first, counts)
        begins = np.repeat(offsets[cells], counts)
        a, b, c = (
            points[corners[at]].astype(float) for at in (begins, begins + in_fan + 1, begins + in_fan + 2))
        with np.errstate(all="ignore"):  # coordinates that are not finite face nowhere
            across = np.cross(b - a, c - a)
            normals = np.repeat(np.add.reduceat(across, first), counts, axis=0)
            area, all_ = (np.linalg.norm(vectors, axis=1) for vectors in (across, normals))
            turned = (across * normals).sum(axis=1) < FACING * area * all_
            turned &= area > SLIVER * all_
        wrong.append(cells[np.logical_or.reduceat(turned, first)])
    return np.concatenate(wrong)


def _as_touched(corners, sizes):
    """Triangles (n, 3) of polygons as the hand meets them, by the numbers of their corners, and for each
    the polygon that it is of. Corners (n, 3) belong to one polygon each."""
    cells = vtkCellArray()
    offsets = np.concatenate([[0], np.cumsum(sizes)])
    cells.SetData(*(numpy_to_vtkIdTypeArray(a, deep=True) for a in (offsets, np.arange(len(corners)))))
    polygons = vtkPolyData()
    polygons.SetPoints(vtkPoints())
    polygons.GetPoints().SetData(numpy_to_vtk(corners, deep=True))
    polygons.SetPolys(cells)
    number = numpy_to_vtkIdTypeArray(np.arange(len(corners)), deep=True)
    number.SetName("Number")  # of its own for each, so that equal points stay several
    polygons.GetPointData().AddArray(number)
    cutter = vtkGodObjectFilter()
    cutter.SetSideToBoth()
    cutter.SetInputData(polygons)
    for event in ("ErrorEvent", "WarningEvent"):  # the scene reports the same
        cutter.AddObserver(event, lambda *_: None)
    with contextlib.suppress(HapticsError):
        cutter.Update()
    result = cutter.GetOutput()
    if result.GetNumberOfPolys() == 0:
        return np.empty((0, 3), np.int64), np.empty(0, np.int64)
    names = vtk_to_numpy(result.GetPointData().GetArray("Number"))
    triangles = names[vtk_to_numpy(result.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    return triangles, vtk_to_numpy(result.GetCellData().GetArray("OriginalCellId"))


def _with_triangles(surface, is_kept, sizes, corners, triangles, of_cells, is_edge):
    """A copy of a surface with the polygons that are kept, of their sizes and corners, and with triangles
    in place of the others. Their corners are points of their own, which say what is no edge of a polygon
    and hence no line of a wireframe."""
    count, others = surface.GetNumberOfPoints(), surface.GetNumberOfVerts() + surface.GetNumberOfLines()
    corners = np.concatenate([corners, count + np.arange(triangles.size)]).astype(np.int64)
    sizes = np.concatenate([[0], sizes, np.full(len(triangles), 3)])
    cells = vtkCellArray()
    cells.SetData(*(
        numpy_to_vtkIdTypeArray(a, deep=True) for a in (np.cumsum(sizes).astype(np.int64), corners)))

    copy = vtkPolyData()
    points = np.concatenate([np.arange(count), triangles.ravel()])
    copy.SetPoints(vtkPoints())
    copy.GetPoints().SetData(numpy_to_vtk(vtk_to_numpy(surface.GetPoints().GetData())[points], deep=True))
    for name in ("Verts", "Lines"):
        getattr(copy, f"Set{name}")(getattr(surface, f"Get{name}")())
    copy.SetPolys(cells)
    strips = np.arange(others + len(is_kept), surface.GetNumberOfCells())
    copy.SetStrips(surface.GetStrips())
    _take(surface.GetPointData(), copy.GetPointData(), points)
    _take(surface.GetCellData(), copy.GetCellData(), np.concatenate(
        [np.arange(others), others + np.flatnonzero(is_kept), others + of_cells, strips]))
    flags = numpy_to_vtk(np.concatenate([np.ones(count), is_edge.ravel()]).astype(np.uint8), deep=True)
    flags.SetName("vtkEdgeFlags")
    copy.GetPointData().SetActiveAttribute(
        copy.GetPointData().AddArray(flags), vtkDataSetAttributes.EDGEFLAG)
    return copy


def _take(source, target, ids):
    """Gives `target` the tuples `ids` of the arrays of numbers of `source`, and what they are for."""
    for i in range(source.GetNumberOfArrays()):
        array = source.GetArray(i)
        if not array or array.IsA("vtkBitArray"):
            continue
        values = numpy_to_vtk(vtk_to_numpy(array)[ids], deep=True, array_type=array.GetDataType())
        values.SetName(array.GetName())
        at = target.AddArray(values)
        purpose = source.IsArrayAnAttribute(i)
        if purpose >= 0:
            target.SetActiveAttribute(at, purpose)
