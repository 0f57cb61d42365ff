"""Large surfaces are drawn coarsely while the picture moves, and in full when it rests."""

import time

from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkQuadricClustering
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

LARGE = 400_000  # triangles, beyond which a computer without a graphics card is slow
DIVISIONS = 64  # of the coarse surface along each side of its bounds
FRAME_TIME = 0.04  # [s] that a picture in full may take and still be drawn while it moves
REST = 0.3  # [s] without a new picture, after which the surface is drawn in full


def coarse_copy(surface):
    """A surface of the same shape with far fewer triangles, and the point values of the nearest
    points."""
    cluster = vtkQuadricClustering()
    cluster.SetInputData(surface)
    cluster.AutoAdjustNumberOfDivisionsOff()
    cluster.SetNumberOfDivisions(DIVISIONS, DIVISIONS, DIVISIONS)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(cluster.GetOutputPort())
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    coarse = vtkPolyData()
    coarse.ShallowCopy(normals.GetOutput())
    names = [
        surface.GetPointData().GetArrayName(i)
        for i in range(surface.GetPointData().GetNumberOfArrays())
    ]
    names = [name for name in names if name and name not in ("Normals", "vtkEdgeFlags")]
    if names:
        _copy_values(surface, coarse, names)
    return coarse


def _copy_values(surface, coarse, names):
    locator = vtkStaticPointLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    count = coarse.GetNumberOfPoints()
    nearest = [locator.FindClosestPoint(coarse.GetPoint(i)) for i in range(count)]
    for name in names:
        values = surface.GetPointData().GetAbstractArray(name)
        copy = values.NewInstance()
        copy.SetName(name)
        copy.SetNumberOfComponents(values.GetNumberOfComponents())
        copy.SetNumberOfTuples(count)
        for i, id_ in enumerate(nearest):
            copy.SetTuple(i, id_, values)
        coarse.GetPointData().AddArray(copy)


class DetailSwitch:
    """Draws large actors coarsely and edges unsmoothed in a window that is used, where a picture in
    full takes too long to follow a hand. Ask rest() now and then whether it is time for a picture in full."""

    def __init__(self, renderer):
        self._renderer = renderer
        self._smooth = False
        self._pairs = []
        self._is_live = False
        self._is_coarse = False
        self._full_next = False
        self._full_time = 0.0  # [s] that the last picture in full took
        self._began = self._ended = 0.0

    def add(self, actor):
        """Takes an actor over, where what it shows is large; colour it before."""
        actor.GetMapper().Update()
        surface = actor.GetMapper().GetInput()
        if surface.GetNumberOfPolys() + surface.GetNumberOfStrips() < LARGE:
            return
        full, coarse = actor.GetMapper(), vtkPolyDataMapper()
        coarse.SetInputData(coarse_copy(surface))
        coarse.ScalarVisibilityOff()
        if full.GetScalarVisibility() and surface.GetPointData().HasArray(full.GetArrayName()):
            coarse.ScalarVisibilityOn()
            coarse.SetScalarModeToUsePointFieldData()
            coarse.SelectColorArray(full.GetArrayName())
            coarse.SetLookupTable(full.GetLookupTable())
            coarse.UseLookupTableScalarRangeOn()
        self._pairs.append((actor, full, coarse))

    def watch(self, window):
        """Takes the pictures of a window over; the first ones are in full."""
        self._smooth = self._renderer.GetUseFXAA()
        window.AddObserver("StartEvent", self._on_start)
        window.AddObserver("EndEvent", self._on_end)

    def set_live(self, is_live):
        """Whether the pictures are to follow a hand; else all are in full."""
        self._is_live = is_live

    def rest(self):
        """Whether the picture has rested for a while and is coarse: the next one is in full."""
        self._full_next = self._is_coarse and time.monotonic() - self._ended > REST
        return self._full_next

    def _on_start(self, *_):
        self._began = time.monotonic()
        is_slow = self._full_time > FRAME_TIME
        self._is_coarse = bool(self._pairs) and self._is_live and is_slow and not self._full_next
        self._full_next = False
        self._renderer.SetUseFXAA(self._smooth and not self._is_coarse)
        for actor, full, coarse in self._pairs:
            actor.SetMapper(coarse if self._is_coarse else full)

    def _on_end(self, *_):
        self._ended = time.monotonic()
        if not self._is_coarse:
            self._full_time = self._ended - self._began
