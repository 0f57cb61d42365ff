"""Surfaces of volumes: outsides of meshes and contours of images."""

import os

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataSet, vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkCellDataToPointData,
    vtkContourFilter,
    vtkFlyingEdges3D,
)
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOImage import vtkDICOMImageReader, vtkNIFTIImageReader, vtkNrrdReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader,
    vtkXMLMultiBlockDataReader,
    vtkXMLRectilinearGridReader,
    vtkXMLStructuredGridReader,
    vtkXMLUnstructuredGridReader,
)

READERS = {
    ".glb": vtkGLTFReader,
    ".gltf": vtkGLTFReader,
    ".nii": vtkNIFTIImageReader,
    ".nrrd": vtkNrrdReader,
    ".nhdr": vtkNrrdReader,
    ".vtk": vtkGenericDataObjectReader,
    ".vti": vtkXMLImageDataReader,
    ".vtm": vtkXMLMultiBlockDataReader,
    ".vtr": vtkXMLRectilinearGridReader,
    ".vts": vtkXMLStructuredGridReader,
    ".vtu": vtkXMLUnstructuredGridReader,
}


class NoSurfaceError(ValueError):
    """Why no surface can be made of data, and what to do."""


def folder_reader(path):
    """A reader of a folder with the slices of a DICOM image."""
    reader = vtkDICOMImageReader()
    reader.SetDirectoryName(os.path.abspath(path))
    return reader


def leaves(data):
    """The data sets of which a data object is made."""
    if isinstance(data, vtkDataSet):
        return [data]
    if not isinstance(data, vtkCompositeDataSet):
        return []
    found = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        found += leaves(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return found


def surface_of(data, contour=None):
    """The outside of a data object as vtkPolyData, or where its values are `contour`.

    Raises NoSurfaceError where there is no data set in it, or it has no values to contour."""
    parts = leaves(data)
    if not parts:
        raise NoSurfaceError(
            f"it holds a {data.GetClassName()}, which has no surface. Give a file of a mesh, of an image, "
            "or of several in blocks."
        )
    if contour is not None:
        parts = [_contour(part, contour) for part in parts]
    elif len(parts) == 1 and isinstance(parts[0], vtkPolyData):
        return parts[0]
    else:
        parts = [_outside(part) for part in parts]
    if len(parts) == 1:
        return parts[0]
    append = vtkAppendPolyData()
    for part in parts:
        append.AddInputData(part)
    append.Update()
    return append.GetOutput()


def _outside(part):
    if isinstance(part, vtkPolyData):
        return part
    outside = vtkDataSetSurfaceFilter()
    outside.SetInputData(part)
    outside.Update()
    return outside.GetOutput()


def _contour(part, value):
    """The contour of a data set's active values, or else of its first array with one component."""
    if not part.GetPointData().GetNumberOfArrays() and part.GetCellData().GetNumberOfArrays():
        average = vtkCellDataToPointData()
        average.SetInputData(part)
        average.Update()
        part = average.GetOutput()
    points = part.GetPointData()
    arrays = [points.GetScalars(), *(points.GetArray(i) for i in range(points.GetNumberOfArrays()))]
    array = next((a for a in arrays if a and a.GetNumberOfComponents() == 1), None)
    if not array:
        raise NoSurfaceError("it has no values to contour; leave out --contour for its outside.")
    low, high = array.GetRange()
    if not low <= value <= high:
        raise NoSurfaceError(
            f"its values, {array.GetName()}, go from {low:g} to {high:g}, so that there is no "
            f"contour at {value:g}. Choose a value between them."
        )
    image = part.IsA("vtkImageData") and min(part.GetDimensions()) > 1
    contour = vtkFlyingEdges3D() if image else vtkContourFilter()
    contour.SetInputData(part)
    contour.SetInputArrayToProcess(0, 0, 0, 0, array.GetName())
    contour.SetValue(0, value)
    contour.Update()
    return contour.GetOutput()


def name_scalars(data):
    """Gives values without a name one, as images have them, so that they can be asked for."""
    for part in leaves(data):
        scalars = part.GetPointData().GetScalars()
        if scalars and not scalars.GetName():
            scalars.SetName("values")


def check_cells(part):
    """Raises NoSurfaceError where a cell of a surface or a mesh names a point that is not there: VTK
    would end the process at some filter behind, or touch what is elsewhere in its memory."""
    if part.IsA("vtkPolyData"):
        arrays = (part.GetVerts(), part.GetLines(), part.GetPolys(), part.GetStrips())
    else:
        arrays = (part.GetCells(),) if part.IsA("vtkUnstructuredGrid") else ()
    count = part.GetNumberOfPoints()
    for cells in arrays:
        if cells and cells.GetNumberOfConnectivityIds():
            ids = vtk_to_numpy(cells.GetConnectivityArray())
            if not cells.IsValid():
                raise NoSurfaceError(
                    "it does not say rightly where its cells begin and end. Check that the file is "
                    "whole, or save it again with the program that made it."
                )
            wrong = np.flatnonzero((ids < 0) | (ids >= count))
            if len(wrong):
                raise NoSurfaceError(
                    f"a cell names point {ids[wrong[0]]}, but there are {count} points. "
                    "Repair it, or save it again with the program that made it."
                )
