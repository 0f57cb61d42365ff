"""The path of a hand in a trace that was written before."""

import os

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from .devices import known_devices
from .surfaces import run_reader


class RecordingError(Exception):
    """The message says what is wrong with a recording and what to do."""


def read_recording(path):
    """The path of the hand in a trace, world frame, with its array Time [s]. Raises RecordingError."""
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
    return _hand_path(trace)


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
