"""Takes a surface as researchers have it, and makes a vtkPolyData of it."""

import os
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput


def polydata(surface: Any) -> vtkPolyData:
    """The vtkPolyData of a surface, in the surface's own length unit.

    `surface` is one of

    - a vtkPolyData, or a PyVista mesh, which is one: returned as it is;
    - any other vtkDataSet or composite of such: its outer surface;
    - a filter or an output port of one, which is updated: what it gives;
    - an object with `vertices` and `faces`, as a trimesh.Trimesh has, or a tuple of the two:
      `vertices` (n, 3), `faces` (m, 3) or (m, k), or a sequence of corners for each face;
    - the name of a file: .stl, .ply, .obj, .vtp, .vtk, .gii.

    Raises TypeError for anything else, ValueError for arrays of another shape and cells of points that are
    not there, and surfaces.SurfaceError for a file that cannot be read.
    """
    if isinstance(surface, vtkPolyData):
        return surface
    if isinstance(surface, (str, os.PathLike)):
        from .surfaces import read_surface

        return read_surface(os.fspath(surface))
    if isinstance(surface, vtkAlgorithm):
        surface.Update()
        return polydata(surface.GetOutputDataObject(0))
    if isinstance(surface, vtkAlgorithmOutput):
        producer, port = surface.GetProducer(), surface.GetIndex()
        producer.Update()
        return polydata(producer.GetOutputDataObject(port))
    if isinstance(surface, (vtkDataSet, vtkCompositeDataSet)):
        return _outer_surface(surface)
    if hasattr(surface, "vertices") and hasattr(surface, "faces"):
        return from_arrays(surface.vertices, surface.faces)
    if isinstance(surface, (tuple, list)) and len(surface) == 2:
        return from_arrays(*surface)
    raise TypeError(
        f"a surface cannot be made of a {type(surface).__name__}. Give a vtkPolyData, a PyVista mesh, "
        "an object with vertices and faces, a tuple (vertices, faces) or the name of a file."
    )


def from_arrays(vertices, faces):
    """A vtkPolyData with copies of `vertices` (n, 3) and `faces` (m, k), or a list of faces of any
    number of corners each; ids count from 0. Raises ValueError."""
    surface = vtkPolyData()
    surface.SetPoints(points(vertices, "vertices"))
    try:
        corners = np.asarray(faces)
    except ValueError:  # faces of different lengths
        corners = np.empty(0, object)
    if corners.ndim == 2 and corners.shape[1] >= 3:
        lengths = np.full(len(corners), corners.shape[1])
        corners = corners.ravel()
    elif len(faces) and all(np.ndim(face) == 1 and len(face) >= 3 for face in faces):
        lengths = np.array([len(face) for face in faces])
        corners = np.concatenate([np.asarray(face) for face in faces])
    else:
        raise ValueError(
            f"faces have the shape {np.shape(corners)}; give (m, 3), or a sequence of at least three "
            "corners for each face."
        )
    if not np.issubdtype(corners.dtype, np.integer):
        raise ValueError(f"faces are of {corners.dtype}; they must be whole numbers, ids of vertices.")
    wrong = (corners < 0) | (corners >= surface.GetNumberOfPoints())
    if wrong.any():
        raise ValueError(
            f"a face names vertex {corners[wrong][0]}, but there are {surface.GetNumberOfPoints()} "
            "vertices, counted from 0."
        )
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.concatenate([[0], np.cumsum(lengths)]).astype(np.int64), deep=True),
        numpy_to_vtkIdTypeArray(corners.astype(np.int64), deep=True),
    )
    surface.SetPolys(cells)
    return surface


def points(coordinates, name="points"):
    """vtkPoints with a copy of `coordinates` (n, 3), float32 or float64. Raises ValueError."""
    array = np.asarray(coordinates)
    if array.ndim != 2 or array.shape[1] != 3 or not np.issubdtype(array.dtype, np.number):
        raise ValueError(
            f"{name} have the shape {array.shape} of {array.dtype}; they must be (n, 3) numbers."
        )
    if np.iscomplexobj(array):
        raise ValueError(f"{name} are complex; they must be real.")
    wrong = ~np.isfinite(array).all(axis=1)
    if wrong.any():
        first = int(np.argmax(wrong))
        raise ValueError(f"{name}[{first}] is {array[first].tolist()}, which is not finite.")
    if array.dtype != np.float32:
        array = array.astype(np.float64)
    result = vtkPoints()
    result.SetData(numpy_to_vtk(np.ascontiguousarray(array), deep=True))
    return result


def _outer_surface(data):
    from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkGeometryFilter

    from .volumes import check_cells, leaves

    for part in leaves(data):
        check_cells(part)
    outside = (
        vtkGeometryFilter() if isinstance(data, vtkDataSet) else vtkCompositeDataGeometryFilter()
    )
    outside.SetInputData(data)
    outside.Update()
    return outside.GetOutput()
