"""Reads a surface from a file and says clearly what is wrong with one that cannot be touched."""

import os
import re

from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

READERS = {
    ".stl": vtkSTLReader,
    ".ply": vtkPLYReader,
    ".obj": vtkOBJReader,
    ".vtp": vtkXMLPolyDataReader,
    ".vtk": vtkPolyDataReader,
}

# With expat 2.6, or an older one that Debian mended against the same attack, VTK 9.1 and 9.2 stop
# with an XML error at the appended data of all but the smallest files.
APPENDED_DATA_HINT = (
    " Its data is of the kind 'appended', which some builds of VTK cannot read: "
    "save it with the data mode 'binary' or as .ply."
)


class SurfaceError(Exception):
    """What is wrong with a file, where, and what to do; for people."""


def _run(reader):
    """Updates the reader and returns what it complained of, most telling first."""
    errors, warnings, failures = [], [], []

    def listener(messages):
        def keep(_caller, _event, text):
            # "ERROR: In file.cxx, line 1 vtkClass (0x1): what happened" -> "what happened"
            messages.append(re.sub(r"^.*?\(0x[0-9a-f]+\): ", "", " ".join(text.split())))

        keep.CallDataType = "string0"
        return keep

    reader.AddObserver("ErrorEvent", listener(errors))
    reader.AddObserver("WarningEvent", listener(warnings))
    reader.GetExecutive().AddObserver("ErrorEvent", listener(failures))
    reader.Update()
    if errors:
        return errors
    if failures:
        return warnings or ["the reader gave up without saying why."]
    return []


def _has_appended_data(path):
    with open(path, "rb") as file:
        return b"<AppendedData" in file.read()


def read_surface(path):
    """The vtkPolyData in a file of one of READERS' formats, in the file's own length unit.

    Raises SurfaceError where the file is missing, unreadable, of another format, or holds no
    polygons or strips.
    """
    if not os.path.isfile(path):
        raise SurfaceError(f"{path}: there is no such file. Check the path.")
    if not os.access(path, os.R_OK):
        raise SurfaceError(f"{path}: may not be read. Check the file's permissions.")
    extension = os.path.splitext(path)[1].lower()
    if extension not in READERS:
        raise SurfaceError(
            f"{path}: files of type '{extension}' are not known. "
            f"Convert it to one of {', '.join(sorted(READERS))}."
        )
    reader = READERS[extension]()
    reader.SetFileName(path)
    errors = _run(reader)
    if errors:
        raise SurfaceError(
            f"{path}: could not be read as {extension[1:].upper()}: {errors[0]} "
            "Check that the file is whole and that its extension is right."
            + (APPENDED_DATA_HINT if extension == ".vtp" and _has_appended_data(path) else "")
        )
    surface = reader.GetOutput()
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise SurfaceError(
            f"{path}: has no polygons, hence no surface ({surface.GetNumberOfPoints()} points, "
            f"{surface.GetNumberOfLines()} lines). "
            "Check that the file is whole and holds triangles, polygons or strips."
        )
    return surface
