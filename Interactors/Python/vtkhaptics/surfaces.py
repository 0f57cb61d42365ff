"""Reads a surface from a file and says clearly what is wrong with one that cannot be touched."""

import contextlib
import gzip
import os
import re
import shutil
import tempfile
import zlib

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from . import cortices, volumes
from .interrupt import deferred, is_due
from .trial import Crashed, try_apart
from .units import file_unit
from .volumes import NoSurfaceError

READERS = {
    ".stl": vtkSTLReader,
    ".ply": vtkPLYReader,
    ".obj": vtkOBJReader,
    ".vtp": vtkXMLPolyDataReader,
    **volumes.READERS,
}

FORMATS = sorted([*READERS, ".gii", ".off"])
SAFE = (".stl",)  # what cannot crash its reader once it has been looked at, see _stl_as_read()

NO_POLYGONS_HINT = "Check that the file is whole and holds triangles, polygons or strips."
STRIPS_HINT = (
    "It holds triangle strips, which VTK does not read from PLY: save it with triangles instead, "
    "for example with MeshLab."
)
# With expat 2.6, or an older one that Debian mended against the same attack, VTK 9.1 and 9.2 stop
# with an XML error at the appended data of all but the smallest files.
APPENDED_DATA_HINT = (
    " Its data is of the kind 'appended', which some builds of VTK cannot read: "
    "save it with the data mode 'binary' or as .ply."
)


class SurfaceError(Exception):
    """The message says what is wrong with a file, where, and what to do."""


LARGEST_SHARE = 0.5  # of the memory: what triangles and engine of a file may take
MEMORY_FACTOR = 12.0  # what they take at most, in lengths of a binary file
STL_TEXT_SHARE = 0.25  # of a text's length, at most: a triangle has 50 bytes, or 200 and more of text


# VTK keeps the range of lengths that a writer has found in an array of vectors; where it is infinite
# or NaN no reader of VTK can parse it again. The array itself is read in full.
HARMLESS = "Error reading InformationKey element"


def run_reader(reader, progress=None):
    """Updates the reader and returns its complaints, the most specific one first."""
    errors, warnings, failures = [], [], []

    def listener(messages):
        def keep(_caller, _event, text):
            # "ERROR: In file.cxx, line 1 vtkClass (0x1): what happened" -> "what happened"
            message = re.sub(r"^.*?\(0x[0-9a-f]+\): ", "", " ".join(text.split()))
            if not message.startswith(HARMLESS):
                messages.append(message)

        keep.CallDataType = "string0"
        return keep

    def on_progress(caller, _event):
        if is_due():
            caller.AbortExecuteOn()
        progress(caller.GetProgress())

    reader.AddObserver("ErrorEvent", listener(errors))
    reader.AddObserver("WarningEvent", listener(warnings))
    reader.GetExecutive().AddObserver("ErrorEvent", listener(failures))
    if progress:
        reader.AddObserver("ProgressEvent", on_progress)
    with deferred():
        reader.Update()
    if errors:
        return errors
    if failures:
        return warnings or ["the reader gave up without saying why."]
    return []


def _has_ply_strips(path, extension):
    """Whether the header of a PLY file names triangle strips, which VTK passes over."""
    if extension != ".ply":
        return False
    with open(path, "rb") as file:
        return b"element tristrips" in file.read(4096).split(b"end_header")[0]


PLY_BYTES = {"char": 1, "uchar": 1, "int8": 1, "uint8": 1, "short": 2, "ushort": 2, "int16": 2,
             "uint16": 2, "int": 4, "uint": 4, "int32": 4, "uint32": 4, "float": 4, "float32": 4,
             "double": 8, "float64": 8}


def _is_cut_ply(path):
    """Whether a PLY file ends before all that its header announces: VTK 9.6 then makes up the rest. Of
    lists at least their lengths are counted."""
    with open(path, "rb") as file:
        elements, is_text = [], False  # of each element: how many, and the bytes of one
        for line in iter(file.readline, b""):
            words = line.decode("ascii", "replace").split()
            if words[:1] == ["end_header"]:
                break
            if words[:1] == ["format"]:
                is_text = words[1:2] == ["ascii"]
            elif words[:1] == ["element"] and words[-1].isdigit():
                elements.append([int(words[-1]), 0])
            elif words[:1] == ["property"] and elements:
                kind = words[2] if words[1:2] == ["list"] and len(words) > 2 else words[1] if len(words) > 1 else ""
                elements[-1][1] += PLY_BYTES.get(kind, 1)
        if is_text:
            return sum(1 for line in file if line.strip()) < sum(count for count, _ in elements)
        rest = os.path.getsize(path) - file.tell()
        return rest < sum(count * size for count, size in elements)


def _has_appended_data(path, extension):
    if not extension.startswith(".vt") or extension == ".vtk":
        return False
    with open(path, "rb") as file:
        return b"<AppendedData" in file.read()


def _refuse_enormous(path):
    """Says so before the memory is full."""
    try:
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError):
        return  # a system that does not report it
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        share = STL_TEXT_SHARE if _is_stl_text(file.read(1024)) else 1.0
    if size * share * MEMORY_FACTOR > memory * LARGEST_SHARE:
        raise SurfaceError(
            f"{path}: {size / 2**30:.1f} GB would take more than half of the memory "
            f"({memory / 2**30:.1f} GB) once triangulated. Decimate it first, for example with "
            "vtkQuadricDecimation, or cut out the part to touch."
        )


def _is_stl_text(start):
    """Whether a file that begins so is STL as text. Headers of binary files begin with 'solid' too."""
    return start.lstrip().lower().startswith(b"solid") and b"facet" in start.lower()


@contextlib.contextmanager
def _stl_as_read(path):
    """A path to the same triangles as vtkSTLReader takes them in.

    It takes memory for as many triangles as a binary file says, and ends the process where there is
    not so much; it takes bytes after the last triangle for one more, or refuses them (VTK 9.6); and a
    name in letters beyond ASCII makes it take a text for binary.
    """
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        start = file.read(1024)
    text = bytes([*range(0x20, 0x80), *b"\t\n\r"])  # as VTK distinguishes them, in the first 256 bytes
    others = len(start[:256].translate(None, delete=text))
    if len(start) < 84 or others < 0.05 * len(start[:256]):
        yield path
        return
    if _is_stl_text(start):
        head, skipped, end = b"solid\n", start.index(b"\n") + 1, size
    else:
        stated, held = int.from_bytes(start[80:84], "little"), (size - 84) // 50
        if stated > held:
            raise SurfaceError(
                f"{path}: says that it holds {stated:,} triangles, but its {size:,} bytes are those "
                f"of {held:,}. It was cut short, or is no STL: get or save it again."
            )
        # Some programs write 0, or too few, and then more triangles; others write something after
        # the triangles, which is seldom as long as some of them.
        count = held if stated == 0 or (size - 84) % 50 == 0 else stated
        head, skipped, end = start[:80] + count.to_bytes(4, "little"), 84, 84 + 50 * count
        if count == stated and end == size:
            yield path
            return
    with tempfile.NamedTemporaryFile(suffix=os.path.splitext(path)[1]) as copy:
        copy.write(head)
        with open(path, "rb") as file:
            file.seek(skipped)
            shutil.copyfileobj(file, copy)
        copy.truncate(len(head) + end - skipped)
        copy.flush()
        yield copy.name


def value_arrays(surface):
    """Names of the point and cell arrays that hold values: numbers, but no normals, texture
    coordinates or ids of VTK's own."""
    names = []
    for data in (surface.GetPointData(), surface.GetCellData()):
        special = {data.GetNormals(), data.GetTCoords(), data.GetTangents()}
        for i in range(data.GetNumberOfArrays()):
            array, name = data.GetArray(i), data.GetArrayName(i)
            if array and name and array not in special and not name.startswith("vtk"):
                names.append(name)
    return list(dict.fromkeys(names))


def default_array(surface):
    """Name of the array to colour by where nobody has said: the active one, or else the first with
    one value a point or cell. None where there is none that differs anywhere."""
    points, cells = surface.GetPointData(), surface.GetCellData()
    active = points.GetScalars() or cells.GetScalars()
    if active and active.GetName() and _differs(active):
        return active.GetName()
    for name in value_arrays(surface):
        array = points.GetArray(name) or cells.GetArray(name)
        if array.GetNumberOfComponents() == 1 and _differs(array):
            return name
    return None


def _differs(array):
    """Whether an array has more than one value, in any component."""
    ranges = (array.GetRange(i) for i in range(array.GetNumberOfComponents()))
    return any(low < high for low, high in ranges)


def unit_note(path, surface, unit=None):
    """One line about the size of a surface in `unit`, or else in the one that its file names, and
    that it is not known where neither is."""
    low, high = surface.GetBounds()[::2], surface.GetBounds()[1::2]
    size = " x ".join(f"{b - a:.4g}" for a, b in zip(low, high))
    triangles = sum(
        cells.GetNumberOfConnectivityIds() - 2 * cells.GetNumberOfCells()
        for cells in (surface.GetPolys(), surface.GetStrips())
    )
    length = unit or file_unit(path) or (
        "in the file's own length unit (it names none; the hand's space is fitted to it)"
    )
    return f"{os.path.basename(path)}: {triangles:,} triangles, {size} {length}"


def _unpacked(path):
    """A context with the path to a file as it is, or unpacked where its name ends in .gz."""
    lower = path.lower()
    if not lower.endswith(".gz") or lower.endswith(".nii.gz"):
        return contextlib.nullcontext(path)
    return _gunzipped(path)


@contextlib.contextmanager
def _gunzipped(path):
    suffix = os.path.splitext(path[: -len(".gz")])[1]
    with tempfile.NamedTemporaryFile(suffix=suffix) as copy:
        try:
            with gzip.open(path, "rb") as file:
                shutil.copyfileobj(file, copy)
        except (OSError, EOFError, zlib.error) as error:
            raise SurfaceError(
                f"{path}: could not be unpacked: {error}. Check that the file is whole."
            ) from error
        copy.flush()
        yield copy.name


def _read_off(path):
    """The mesh of an OFF file, which VTK has no reader for: corners, then faces by their numbers."""
    with open(path, encoding="ascii", errors="replace") as file:
        words = [word for line in file for word in line.split("#")[0].split()]
    try:
        if not words or not words[0].upper().endswith("OFF"):
            raise ValueError("it does not begin with OFF")
        points, faces = int(words[1]), int(words[2])
        at = 4 + 3 * points
        corners = np.array(words[4:at], float).reshape(points, 3)
        cells = vtkCellArray()
        for _ in range(faces):
            count = int(words[at])
            ids = [int(word) for word in words[at + 1 : at + 1 + count]]
            if len(ids) != count:
                raise ValueError("it ends in the middle of its faces")
            cells.InsertNextCell(count)
            for id_ in ids:
                cells.InsertCellPoint(id_)
            at += 1 + count
    except (IndexError, ValueError) as error:
        raise SurfaceError(
            f"{path}: could not be read as OFF: {error}. Check that the file is whole; colours of "
            "corners and faces are not read."
        ) from error
    surface = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(corners, deep=True))
    surface.SetPoints(vtk_points)
    surface.SetPolys(cells)
    return surface


def _open_reader(path, extension, whole):
    """A reader for a file whose first bytes are at the path `whole`, or a folder."""
    if os.path.isdir(path):
        return volumes.folder_reader(path)
    reader = READERS[extension]()
    reader.SetFileName(whole)
    return reader


def read_surface(path, progress=None, contour=None):
    """The surface in a file of one of FORMATS, gzipped or not, or in a folder with the slices of a
    DICOM image, as vtkPolyData in the file's own length unit.

    Of data that are no surface it is the outside, or where its values are `contour`. `progress` is called
    with 0 to 1 while the file is read.

    Raises SurfaceError where the file is missing, unreadable, damaged, of another format, or holds
    no polygons or strips.
    """
    try:
        os.stat(path)
    except PermissionError:
        raise SurfaceError(
            f"{path}: a folder on the way to it may not be entered. Check the permissions of the folders."
        ) from None
    except (OSError, ValueError):
        raise SurfaceError(f"{path or repr(path)}: there is no such file. Check the path.") from None
    if not os.access(path, os.R_OK):
        raise SurfaceError(f"{path}: may not be read. Check the file's permissions.")
    if not os.path.isfile(path) and not os.path.isdir(path):
        raise SurfaceError(
            f"{path}: is no regular file but a FIFO or a device, which could be waited for without end. "
            "Write what comes from it to a file, and give that."
        )
    with _unpacked(path) as unpacked:
        return _read_unpacked(path, unpacked, progress, contour)


def _read_unpacked(path, unpacked, progress, contour):
    is_folder = os.path.isdir(path)
    lower = path.lower()
    packed = lower[: -len(".gz")] if lower.endswith(".gz") else lower
    extension = "" if is_folder else os.path.splitext(packed)[1]
    read_cortex = None
    if extension == ".gii":
        read_cortex = cortices.read_gifti
    elif extension not in FORMATS and not is_folder and cortices.is_freesurfer(unpacked):
        read_cortex = cortices.read_freesurfer
    if read_cortex:
        try:
            return read_cortex(unpacked)
        except NoSurfaceError as error:
            raise SurfaceError(f"{path}: {error}") from error
    if not is_folder and extension not in FORMATS:
        raise SurfaceError(
            f"{path}: files of type '{extension}' are not known. "
            f"Convert it to one of {', '.join(FORMATS)}."
        )
    if not is_folder:
        _refuse_enormous(unpacked)
    if extension == ".ply" and _is_cut_ply(unpacked):
        raise SurfaceError(
            f"{path}: ends before all that its header announces. Check that the file is whole."
        )
    # VTK 9.6 refuses a binary STL with bytes after its last triangle; some programs write them.
    as_read = _stl_as_read if extension == ".stl" else contextlib.nullcontext
    with as_read(unpacked) as whole:

        def read():
            if extension == ".off":
                return _read_off(whole), []
            reader = _open_reader(path, extension, whole)
            errors = run_reader(reader, progress)
            return reader.GetOutputDataObject(0), errors

        if extension not in SAFE:
            try:
                try_apart(lambda: volumes.surface_of(read()[0], contour))
            except Crashed as error:
                raise SurfaceError(
                    f"{path}: is damaged, or of a kind that VTK's reader does not bear: that ended "
                    f"by '{error}'. Check that the file is whole, that its faces name points that "
                    "are there, and save it again with the program that made it."
                ) from error
        data, errors = read()
    if errors and is_folder:
        raise SurfaceError(
            f"{path}: is a folder, and what is in it cannot be read as the slices of a DICOM image: {errors[0]} "
            "Give a file with a surface, or a folder with nothing but the slices."
        )
    if errors:
        raise SurfaceError(
            f"{path}: could not be read as {extension[1:].upper()}: {errors[0]} "
            "Check that the file is whole and that its extension is right."
            + (APPENDED_DATA_HINT if _has_appended_data(path, extension) else "")
        )
    try:
        volumes.name_scalars(data)
        for part in volumes.leaves(data):
            volumes.check_cells(part)
        surface = volumes.surface_of(data, contour)
    except NoSurfaceError as error:
        raise SurfaceError(f"{path}: {error}") from error
    if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() == 0:
        raise SurfaceError(
            f"{path}: has no polygons, hence no surface ({surface.GetNumberOfPoints()} points, "
            f"{surface.GetNumberOfLines()} lines). "
            + (STRIPS_HINT if _has_ply_strips(path, extension) else NO_POLYGONS_HINT)
        )
    return surface
