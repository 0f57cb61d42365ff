"""Large surfaces are drawn coarsely while the picture moves, and in full when it rests."""

import time

from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkQuadricClustering
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

LARGE = 400_000  # triangles, beyond which a computer without a graphics card is slow
DIVISIONS = 120  # of the coarse surface along each side of its bounds
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
    if any(name and name != "Normals" for name in names):
        _copy_values(surface, coarse, [name for name in names if name and name != "Normals"])
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
    """Draws actors coarsely while pictures follow on each other, by the renderer's StartEvent; ask
    rest() now and then whether it is time for a picture in full."""

    def __init__(self, renderer):
        self._pairs = []
        self._last = 0.0
        self._is_coarse = False
        renderer.AddObserver("StartEvent", self._on_start)

    def add(self, actor, surface):
        """Takes an actor over, where its surface is large; colour it before."""
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

    def rest(self):
        """Whether the last picture was coarse and is to be drawn anew, in full."""
        if not self._is_coarse or time.monotonic() - self._last < REST:
            return False
        self._last = 0.0
        return True

    def _on_start(self, *_):
        now = time.monotonic()
        self._is_coarse = bool(self._pairs) and now - self._last < REST
        self._last = now
        for actor, full, coarse in self._pairs:
            actor.SetMapper(coarse if self._is_coarse else full)
