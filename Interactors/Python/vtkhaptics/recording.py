"""The path of a hand in a trace that was written before."""

import os
from typing import Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from .devices import known_devices
from .surfaces import run_reader


class RecordingError(Exception):
    """The message says what is wrong with a recording and what to do."""


def read_recording(path):
    """The path of the hand in a trace, world frame, with its array Time [s], and scale_of() of the trace, where that
    is known, as its field array Scale. Raises RecordingError."""
    known = ", ".join(name for name, _ in known_devices())
    what = f"{path}: neither a device ({known}) nor a recording"
    if not os.path.isfile(path):
        raise RecordingError(f"{what}: there is no such file.")
    if not path.lower().endswith(".vtp"):
        raise RecordingError(f"{what}: it does not end in .vtp. Give a file that --trace wrote.")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    errors = run_reader(reader)
    trace = reader.GetOutput()
    hip, time = (trace.GetPointData().GetArray(name) for name in ("HapticInterfacePoint", "Time"))
    if errors or not hip or not time or hip.GetNumberOfTuples() < 2:
        raise RecordingError(
            f"{path}: holds no recorded hand. Give a file that --trace wrote, with at least two "
            "points and the point arrays HapticInterfacePoint and Time."
        )
    path = _hand_path(trace)
    scale = scale_of(trace)
    if scale is not None:
        array = numpy_to_vtk(np.array([scale]), deep=True)
        array.SetName("Scale")
        path.GetFieldData().AddArray(array)
    return path


def scale_of(trace) -> Optional[float]:
    """How long a metre in the hand was in the world when a trace was made [world unit/m], by what the spring's force
    was for how deep the hand was. None where it touched nothing, or the trace does not have that."""
    names = ("Force", "Penetration", "Stiffness")
    arrays = [trace.GetPointData().GetArray(name) for name in names]
    if not all(arrays):
        return None
    force, penetration, stiffness = (vtk_to_numpy(array) for array in arrays)
    magnitude = np.linalg.norm(force, axis=1)
    # A force that was limited, or is not the spring's, is not in proportion.
    pressed = (penetration > 0) & (magnitude > 0) & (magnitude < 0.999 * magnitude.max())
    with np.errstate(all="ignore"):
        scales = (stiffness * penetration / magnitude)[pressed]
    scale = float(np.median(scales)) if len(scales) else 0.0
    return scale if np.isfinite(scale) and scale > 0 else None


def _hand_path(trace):
    path = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(trace.GetPointData().GetArray("HapticInterfacePoint"))
    path.SetPoints(points)
    time = vtk_to_numpy(trace.GetPointData().GetArray("Time"))
    array = numpy_to_vtk(time - time[0], deep=True)
    array.SetName("Time")
    path.GetPointData().AddArray(array)
    return path
