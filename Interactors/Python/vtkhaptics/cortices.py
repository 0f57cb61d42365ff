"""Surfaces from the files of brain imaging, GIfTI and FreeSurfer, as nibabel reads them."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .interrupt import held_back
from .volumes import NoSurfaceError

FREESURFER = b"\xff\xff\xfe"  # how a surface of triangles begins; its name is like lh.pial
INSTALL = "Install it (pip install nibabel; Debian: apt-get install python3-nibabel)."


def is_freesurfer(path):
    """Whether a file begins as FreeSurfer's surfaces of triangles do."""
    with open(path, "rb") as file:
        return file.read(len(FREESURFER)) == FREESURFER


def read_freesurfer(path):
    """The mesh of a FreeSurfer file. Raises NoSurfaceError."""
    try:
        with held_back():
            from nibabel.freesurfer import read_geometry
    except ImportError as error:
        raise NoSurfaceError(f"FreeSurfer's files need nibabel. {INSTALL}") from error
    try:
        points, triangles = read_geometry(path)
    except MemoryError:
        raise
    except Exception as error:  # NumPy's own, of many kinds: all mean the file
        raise NoSurfaceError(
            f"could not be read as FreeSurfer's: {error}. Check that the file is whole."
        ) from error
    return _polydata([points], [triangles])


def read_gifti(path):
    """The meshes of a GIfTI file as one, with the other arrays that fit. Raises NoSurfaceError."""
    try:
        with held_back():
            import nibabel
    except ImportError as error:
        raise NoSurfaceError(f"GIfTI needs nibabel. {INSTALL}") from error
    try:
        image = nibabel.load(path)
        points, triangles = (
            [array.data for array in image.get_arrays_from_intent(intent)]
            for intent in ("NIFTI_INTENT_POINTSET", "NIFTI_INTENT_TRIANGLE")
        )
    except MemoryError:
        raise
    except Exception as error:  # nibabel's own, expat's, zlib's and OSError: all mean the file
        raise NoSurfaceError(
            f"could not be read as GIfTI: {error}. Check that the file is whole."
        ) from error
    if not points or not triangles:
        raise NoSurfaceError(
            "has no mesh, only values. Give the surface's file (such as pial.gii)."
        )
    if len(points) != len(triangles):
        raise NoSurfaceError(
            f"has {len(points)} sets of points but {len(triangles)} of triangles; it should have "
            "one of each for every mesh. Save the meshes one by one."
        )
    surface = _polydata(points, triangles)
    for array in image.darrays:
        if array.data.ndim == 1 and len(array.data) == surface.GetNumberOfPoints():
            values = numpy_to_vtk(np.ascontiguousarray(array.data), deep=True)
            values.SetName(array.meta.get("Name") or "values")
            surface.GetPointData().AddArray(values)
    return surface


def _polydata(points, triangles):
    """One vtkPolyData of several meshes: n x 3 coordinates and m x 3 ids each."""
    sets = points, triangles
    if not all(a.ndim == 2 and a.shape[1] == 3 for arrays in sets for a in arrays):
        shapes = ", ".join(str(a.shape) for arrays in sets for a in arrays)
        raise NoSurfaceError(
            f"its points and triangles are no rows of three, but {shapes}. Check that the file is "
            "whole."
        )
    begins = np.cumsum([0, *(len(p) for p in points)])
    ids = np.concatenate([t.astype(np.int64) + b for t, b in zip(triangles, begins)])
    own = np.concatenate([(t >= 0).all(axis=1) & (t < len(p)).all(axis=1)
                          for p, t in zip(points, triangles)])
    if not own.all():
        raise NoSurfaceError(
            f"triangle {int(np.argmin(own))} names a point that its mesh has not. Repair it, or save "
            "it again with the program that made it."
        )
    surface, vtk_points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(np.concatenate(points)), deep=True))
    offsets = np.arange(0, 3 * len(ids) + 1, 3, dtype=np.int64)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(ids.ravel(), deep=True)
    )
    surface.SetPoints(vtk_points)
    surface.SetPolys(cells)
    return surface
