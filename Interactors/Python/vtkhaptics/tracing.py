"""Replays a path over a surface: NumPy in, NumPy out."""

import csv
import os
import warnings
from typing import Any, Optional, Union

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkAlgorithmOutput

from .classes import CLASSES
from .errors import HapticsWarning
from .interrupt import held_back
from .meshes import points, polydata
from .output import text_cell, whole_file
from .units import metres

# [m]: what is larger or smaller is not meant to be in metres, as in vtkGodObjectTrace.
LARGEST = 2.0
SMALLEST = 1e-3
SIDES = {"automatic": 2, "front": 0, "both": 1}


def trace(
    surface: Any,
    path: Any,
    *,
    time: Any = None,
    stiffness: float = 500.0,
    maximum_force: float = 3.3,
    unit: Union[str, float, None] = None,
    scale: Optional[float] = None,
    period: float = 0.001,
    side: str = "automatic",
    substeps: int = 1,
    tip_radius: float = 0.0,
) -> "Trace":
    """The forces on a hand that follows a path over a surface, without a device.

    Parameters
    ----------
    surface
        What :func:`vtkhaptics.polydata` takes: a vtkPolyData, a PyVista mesh, an object with
        vertices and faces, ``(vertices, faces)``, the name of a file. A filter, or an output port,
        is connected; a vtkGodObjectFilter with its own side, engine and properties.
    path : (n, 3) array, or vtkPolyData
        Positions of the haptic interface point (HIP) in the surface's frame and unit, one a tick.
        The first is taken as free space.
    time : (n,) array, optional
        When each position was taken [s]: kept with the trace, and without any other effect.
    stiffness : float
        Of the spring between HIP and god-object, in the device's frame [N/m].
    maximum_force : float
        Longer forces are shortened to this [N].
    unit : str or float
        Length unit of the surface: "mm", "m", "cm", "um", "nm", "km", "in", "ft", or its metres.
        Lengths in the trace have it in their information. Default: not known.
    scale : float
        Metres in the hand for one unit of the surface [m]. Default: its true size, by `unit`, or
        as if in metres where that is not known; with a HapticsWarning where that makes the surface
        larger than 2 m or smaller than 1 mm.
    period : float
        From one position to the next [s].
    side : "automatic", "front" or "both"
        Which side of the surface can be touched; automatic is the front of closed surfaces.
    substeps : int
        In how many substeps a tick may follow the straight way from one position to the next, 1 to 16,
        on rough ground and in folds, where the trace else depends on how densely the path is sampled:
        1 is off, 4 are enough nearly everywhere.
    tip_radius : float
        Of the ball about each position that touches, in the device's frame [m]: it rounds edges and
        comes into no gap narrower than itself; ``.god_object`` is its centre. 0: a point.

    Returns
    -------
    Trace
        One row for each position: ``.force`` (n, 3) [N], ``.god_object`` (n, 3), ...

    Raises ValueError and TypeError for arguments that are none of these, and HapticsError for a
    surface that cannot be touched. An empty one, as of a contour that has vanished, can: nothing
    holds.

    >>> t = vtkhaptics.trace((vertices, faces), path)
    >>> t.force                             # (n, 3) [N]
    """
    if side not in SIDES:
        raise ValueError(f"side is {side!r}; give one of {', '.join(map(repr, SIDES))}.")
    for name, value in (("stiffness", stiffness), ("maximum_force", maximum_force), ("tip_radius", tip_radius)):
        if not (np.isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} is {value}; it must be finite and not below 0.")
    if not (1 <= substeps <= 16 and int(substeps) == substeps):
        raise ValueError(f"substeps is {substeps}; it must be a whole number from 1 to 16.")
    unit_length = 0.0 if unit is None else metres(unit)
    for name, value in (("scale", 1.0 if scale is None else scale), ("period", period)):
        if not (np.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} is {value}; it must be finite and above 0.")
    filter_ = CLASSES["vtkGodObjectTrace"]()
    filter_.SetInputData(0, path_data(path, time))
    if isinstance(surface, vtkAlgorithm):  # held by its name: a port does not hold its filter
        filter_.SetSurfaceConnection(surface.GetOutputPort())
    elif isinstance(surface, vtkAlgorithmOutput):
        filter_.SetSurfaceConnection(surface)
    else:
        filter_.SetSurfaceData(polydata(surface))
    filter_.SetStiffness(stiffness)
    filter_.SetMaximumForce(maximum_force)
    filter_.SetUnitLength(unit_length)
    # Given where it is the default too: then the filter does not warn in words of its own.
    filter_.SetWorldToDeviceScale(scale or unit_length or 1.0)
    filter_.SetTickPeriod(period)
    filter_.SetSubstepLimit(int(substeps))
    filter_.SetTipRadius(tip_radius)
    filter_.SetSide(SIDES[side])
    filter_.Update()
    if scale is None:
        _warn_of_size(filter_.GetInputDataObject(1, 0), unit_length)
    trace = Trace(filter_.GetOutput(), period)
    if isinstance(surface, (str, os.PathLike)):
        trace._inputs = [os.fspath(surface)]
    return trace


def _warn_of_size(surface, unit_length):
    if not surface.GetNumberOfCells():
        return
    low, high = np.reshape(surface.GetBounds(), (3, 2)).T
    size = (high - low).max()
    in_hand = size * (unit_length or 1.0)
    if SMALLEST <= in_hand <= LARGEST or size == 0.0:
        return
    remedy = f"scale={0.1 / size:.3g} to have it 0.1 m across, scale={unit_length or 1.0:.3g} if it is so"
    warnings.warn(
        f"the surface is {size:.4g} units across, {in_hand:.4g} m in the hand"
        + (". " if unit_length else " as no unit is given. Give unit='mm' for millimetres, or ")
        + ("Give " if unit_length else "")
        + remedy
        + ".",
        HapticsWarning,
        stacklevel=3,
    )


def path_data(path, time=None):
    """A vtkPolyData whose points are a path, (n, 3) or a vtkPolyData already, with the point array
    `Time` [s] where `time` (n,) is given. Raises ValueError."""
    if isinstance(path, vtkPolyData):
        data = vtkPolyData()
        data.ShallowCopy(path)
    else:
        data = vtkPolyData()
        data.SetPoints(points(path, "path"))
    if not data.GetNumberOfPoints():
        raise ValueError("path has no points; give at least one position.")
    if time is not None:
        seconds = np.asarray(time, float)
        if seconds.shape != (data.GetNumberOfPoints(),):
            raise ValueError(
                f"time has the shape {seconds.shape}; for {data.GetNumberOfPoints()} positions it "
                f"must be ({data.GetNumberOfPoints()},)."
            )
        array = numpy_to_vtk(seconds, deep=True)
        array.SetName("Time")
        data.GetPointData().AddArray(array)
    return data


class Trace:
    """A trace, one row a tick, as NumPy arrays over VTK's memory: no copies.

    Of a polydata as vtkGodObjectTrace and ``vtkHapticScene.GetTrace()`` make it, which `polydata`
    is: ``vtkhaptics.Trace(scene.GetTrace())``. An array that has no attribute here is found by its
    VTK name, ``trace["Energy"]``; ``trace.names`` lists all.

    "world" is the surface's frame and unit, and the axes of forces are the world's.
    """

    def __init__(self, polydata: Any, period: float = 0.001) -> None:
        self.polydata = polydata
        self._period = period
        self._inputs: list[str] = []  # files that it was made of

    def __len__(self) -> int:
        return self.polydata.GetNumberOfPoints()

    def __repr__(self):
        return f"<vtkhaptics.Trace of {len(self)} ticks: {', '.join(self.names)}>"

    def __contains__(self, name: str) -> bool:
        return bool(self.polydata.GetPointData().HasArray(name))

    def __getitem__(self, name: str) -> np.ndarray:
        """The array of a VTK name, (n,) or (n, components). Raises KeyError."""
        array = self.polydata.GetPointData().GetArray(name)
        if array is None:
            raise KeyError(f"the trace has no array {name!r}. It has {', '.join(self.names)}.")
        return vtk_to_numpy(array)

    @property
    def names(self) -> list[str]:
        """The names of the arrays of numbers."""
        data = self.polydata.GetPointData()
        return [data.GetArrayName(i) for i in range(data.GetNumberOfArrays()) if data.GetArray(i)]

    @property
    def time(self) -> np.ndarray:
        """When each tick was [s], (n,)."""
        return self["Time"] if "Time" in self else self._period * np.arange(len(self))

    @property
    def hip(self) -> np.ndarray:
        """Haptic interface point: where the hand was [world], (n, 3)."""
        return self["HapticInterfacePoint"]

    @property
    def god_object(self) -> np.ndarray:
        """The point that stays outside of the surface [world], (n, 3)."""
        if not len(self):
            return np.empty((0, 3))
        return vtk_to_numpy(self.polydata.GetPoints().GetData())

    @property
    def force(self) -> np.ndarray:
        """On the hand [N], (n, 3)."""
        return self["Force"]

    @property
    def magnitude(self) -> np.ndarray:
        """Length of the force [N], (n,). Computed at each call."""
        return np.linalg.norm(self.force, axis=1)

    @property
    def touching(self) -> np.ndarray:
        """Whether the surface holds the god-object, (n,) of bool. Computed at each call."""
        return self["ActiveConstraints"] > 0

    @property
    def constraints(self) -> np.ndarray:
        """Planes that hold the god-object, 0 in free space to 3, (n,)."""
        return self["ActiveConstraints"]

    @property
    def cell(self) -> np.ndarray:
        """Id of the cell touched, of the surface as it was given; -1 in free space, (n,)."""
        return self["OriginalCellId"]

    @property
    def penetration(self) -> np.ndarray:
        """Distance from HIP to god-object [world], (n,)."""
        return self["Penetration"]

    @property
    def stiffness(self) -> np.ndarray:
        """In effect [N/m], (n,)."""
        return self["Stiffness"]

    @property
    def energy(self) -> np.ndarray:
        """What the hand has put in and not got out [J], (n,)."""
        return self["Energy"]

    def columns(self) -> dict[str, np.ndarray]:
        """The arrays by column name, each (n,): `Time` first, then `GodObject_X`, `_Y`, `_Z` and so
        on for vectors; components that are not three are numbered from 0."""
        columns = {"Time": self.time}
        for name, values in [("GodObject", self.god_object)] + [(n, self[n]) for n in self.names]:
            if values.ndim == 1:
                columns[name] = values
            else:
                axes = "XYZ" if values.shape[1] == 3 else range(values.shape[1])
                columns.update((f"{name}_{axis}", values[:, i]) for i, axis in enumerate(axes))
        return columns

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with :meth:`columns`, a row a tick. Raises ImportError without pandas."""
        try:
            with held_back():
                import pandas
        except ImportError as error:
            raise ImportError(
                "to_dataframe() needs pandas (pip install pandas; Debian: apt-get install "
                "python3-pandas). to_csv() and columns() need nothing."
            ) from error
        return pandas.DataFrame(self.columns())

    def to_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes :meth:`columns` as CSV, a line with the names first; numbers in full precision.

        A name that a spreadsheet would run as a formula (=, +, - or @ first) gets an apostrophe before
        it. Replaces a file of that name as a whole. Raises output.OutputError, which is an OSError,
        where it cannot be written or is the file that the surface was read from; then the file that
        was there stays."""
        columns = self.columns()
        with whole_file(path, self._inputs, text=True) as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(map(text_cell, columns))
            writer.writerows(zip(*(values.tolist() for values in columns.values())))
