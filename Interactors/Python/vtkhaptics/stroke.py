"""Plans where a hand can stroke a surface that nobody has seen before.

The surface is looked at from a few sides; from each, rays make a height map of what lies in front.
Closed curves of several sizes, places and shapes are laid on the map, and the one that stays on
the surface, over few steps and cliffs, at the largest size, is taken. The hand then follows the
curve a little below the surface. The same surface always gives the same stroke.
"""

import heapq
import math

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter

MAP_SIZE = 64  # rays across the map
CURVE_SAMPLES = 480
STEEP = 1.2  # rise over run that counts as a cliff
CLIFF = 0.03  # of the view's radius: what a closer look takes for a cliff or the rim of a hole
FINALISTS = 12  # curves of each view that are looked at more closely
APPROACH = 0.4  # [s] to come down, and to lift off


class View:
    """An orthographic look at a surface: axes right, up and out (towards the viewer)."""

    def __init__(self, surface, azimuth, elevation):
        azimuth, elevation = math.radians(azimuth), math.radians(elevation)
        self.out = np.array(
            [
                math.cos(elevation) * math.cos(azimuth),
                math.cos(elevation) * math.sin(azimuth),
                math.sin(elevation),
            ]
        )
        self.right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
        self.up = np.cross(self.out, self.right)
        bounds = np.array(surface.GetBounds()).reshape(3, 2)
        self.center = bounds.mean(axis=1)
        # Half the diagonal: the same for all views, so that their curves can be compared.
        self.radius = 0.5 * np.linalg.norm(bounds[:, 1] - bounds[:, 0])

    def to_world(self, u, v, w):
        """World points of coordinates along right, up and out, from the center."""
        return self.center + np.outer(u, self.right) + np.outer(v, self.up) + np.outer(w, self.out)

    def heights(self, locator, u, v):
        """How far out the foremost surface is at each (u, v); NaN where there is none."""
        t, id_ = mutable(0.0), mutable(0)
        part, hit, local = mutable(0), [0.0] * 3, [0.0] * 3
        reach = 1.1 * self.radius
        starts = self.to_world(u, v, np.full(len(u), reach))
        ends = self.to_world(u, v, np.full(len(u), -reach))
        heights = np.full(len(u), np.nan)
        for i, (start, end) in enumerate(zip(starts, ends)):
            if locator.IntersectWithLine(start, end, 1e-6 * reach, t, hit, local, part, id_):
                heights[i] = reach - 2.0 * reach * float(t)
        return heights


def _curves():
    """Candidates in units of the view's radius: (size, u, v), closed, without haste anywhere."""
    s = np.linspace(0.0, 2.0 * math.pi, CURVE_SAMPLES, endpoint=False)
    for half_width in (0.62, 0.5, 0.4, 0.32, 0.25, 0.19, 0.14, 0.1):
        for flatness in (1.0, 0.6, 0.35):
            for turn in (0.0, 45.0, 90.0, 135.0):
                if flatness == 1.0 and turn >= 90.0:
                    continue
                u = half_width * np.sin(2.0 * s)
                v = half_width * flatness * np.sin(5.0 * s + 0.5 * math.pi)
                c, d = math.cos(math.radians(turn)), math.sin(math.radians(turn))
                yield half_width * math.sqrt(flatness), c * u - d * v, d * u + c * v


def _scores(view, grid, u, v):
    """Share of each curve that is good to stroke, given the height map; 0 and less is useless.
    Curves are rows; all are looked at together, as there are tens of thousands."""
    scale = (MAP_SIZE - 1) / (2.0 * view.radius)
    column = np.rint((u + view.radius) * scale).astype(int)
    row = np.rint((v + view.radius) * scale).astype(int)
    inside = (np.minimum(column, row) >= 0).all(axis=1)
    inside &= (np.maximum(column, row) < MAP_SIZE).all(axis=1)
    scores = np.full(len(u), -1.0)
    u, v = u[inside], v[inside]
    height = grid[row[inside], column[inside]]
    missing = np.isnan(height).mean(axis=1)
    rise = np.abs(np.roll(height, -1, axis=1) - height)
    run = np.hypot(np.roll(u, -1, axis=1) - u, np.roll(v, -1, axis=1) - v)
    # Neighbouring map cells may differ by a cell's slope without there being a cliff.
    cliffs = (rise > STEEP * np.maximum(run, 1.5 / scale)).mean(axis=1)
    scores[inside] = 1.0 - 8.0 * missing - 15.0 * cliffs
    return scores


def _best_curves(view, locator):
    """(score, u, v) of the best candidates seen from a view."""
    axis = np.linspace(-view.radius, view.radius, MAP_SIZE)
    columns, rows = np.meshgrid(axis, axis)
    grid = view.heights(locator, columns.ravel(), rows.ravel()).reshape(MAP_SIZE, MAP_SIZE)
    covered = np.isfinite(grid).mean()
    places = np.linspace(-0.6, 0.6, 9)
    cu, cv = (c.ravel() for c in np.meshgrid(places, places, indexing="ij"))
    # Rather near the middle of the picture, and rather a view that shows much.
    weights = (1.0 - 0.15 * np.hypot(cu, cv)) * math.sqrt(covered)
    found = []
    for size, u, v in _curves():
        us = (u + cu[:, None]) * view.radius
        vs = (v + cv[:, None]) * view.radius
        values = np.maximum(_scores(view, grid, us, vs), 0.0) ** 3 * size * weights
        found += [(values[i], us[i], vs[i]) for i in np.flatnonzero(values > 0.0)]
    return heapq.nlargest(FINALISTS, found, key=lambda candidate: candidate[0])


def _cliffs(view, locator, u, v):
    """How many cliffs and rims of holes a curve crosses: the map may have missed narrow ones, and
    a hand that has gone down a hole is caught under its rim."""
    height = view.heights(locator, u, v)
    height = np.where(np.isfinite(height), height, -2.0 * view.radius)
    rise = np.abs(np.diff(height, append=height[0]))
    run = np.hypot(np.diff(u, append=u[0]), np.diff(v, append=v[0]))
    return np.count_nonzero(rise > CLIFF * view.radius + STEEP * run)


def _smooth(values, width):
    """A weighted moving average over 2 width + 1 samples of a closed curve."""
    kernel = np.hanning(2 * width + 3)[1:-1]
    padded = np.concatenate([values[-width:], values, values[:width]])
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


def _lowest_nearby(values, width):
    padded = np.concatenate([values[-width:], values, values[:width]])
    return np.lib.stride_tricks.sliding_window_view(padded, 2 * width + 1).min(axis=1)


class StrokeError(Exception):
    """The message says why no stroke could be planned."""


class Plan:
    """A stroke: the view to touch from, and a closed curve over the surface, seen from there."""

    def __init__(self, view, seconds, u, v, height):
        self.view = view
        self.seconds = seconds
        self._u, self._v, self._height = u, v, height

    def at_depth(self, share):
        """The path of a hand that presses this deep, as a share of half the diagonal of the
        surface's bounds: a vtkPolyData of one line in the world frame with the point array
        Time [s], and the depth [world unit]."""
        depth = share * self.view.radius
        width = max(1, len(self._height) // 100)
        # A mean of minima over the same width is nowhere above the surface.
        height = _smooth(_lowest_nearby(self._height, width), width) - depth
        ramp = np.linspace(0.0, 1.0, int(200 * APPROACH), endpoint=False)
        # The hand has to begin in the open: above the surface itself, not above its lowest nearby.
        clear = self._height[0] - height[0] + 0.05 * self.view.radius
        above = (1.0 - np.sin(0.5 * math.pi * ramp)) * clear
        u = np.pad(self._u, len(ramp), constant_values=self._u[0])
        v = np.pad(self._v, len(ramp), constant_values=self._v[0])
        w = np.concatenate([height[0] + above, height, height[0] + above[::-1]])
        points = self.view.to_world(u, v, w)
        return _polyline(points, np.linspace(0.0, self.seconds, len(u))), depth


def plan_stroke(surface, seconds):
    """Plans a stroke of some seconds. Raises StrokeError where nothing can be stroked."""
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    views = [View(surface, a, e) for e in (28, 55) for a in (-60, 30, 120, 210)]
    found = [
        (value * 0.5 ** _cliffs(view, locator, u, v), view, u, v)
        for view in views
        for value, u, v in _best_curves(view, locator)
    ]
    if not found:
        raise StrokeError(
            "no part of the surface is large and smooth enough for a stroke. Try another surface."
        )
    _, view, u, v = max(found, key=lambda candidate: candidate[0])

    samples = max(50, int(200 * (seconds - 2.0 * APPROACH)))
    s = np.linspace(0.0, CURVE_SAMPLES, samples, endpoint=False)
    u, v = (np.interp(s, np.arange(CURVE_SAMPLES + 1), np.append(c, c[0])) for c in (u, v))
    height = view.heights(locator, u, v)
    known = np.flatnonzero(np.isfinite(height))
    height = np.interp(np.arange(samples), known, height[known], period=samples)
    return Plan(view, seconds, u, v, height)


def in_device_frame(path, to_world):
    """A copy of a path in the world frame, in the frame of a device whose workspace transform is
    the vtkMatrix4x4 `to_world`."""
    to_device = vtkMatrix4x4()
    vtkMatrix4x4.Invert(to_world, to_device)
    transform = vtkTransform()
    transform.SetMatrix(to_device)
    mapped = vtkTransformPolyDataFilter()
    mapped.SetTransform(transform)
    mapped.SetInputData(path)
    mapped.SetOutputPointsPrecision(1)  # float64
    mapped.Update()
    return mapped.GetOutput()


def _polyline(points, time):
    path = vtkPolyData()
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_to_vtk(points, deep=True))
    path.SetPoints(vtk_points)
    line = vtkCellArray()
    line.InsertNextCell(len(points))
    for i in range(len(points)):
        line.InsertCellPoint(i)
    path.SetLines(line)
    array = numpy_to_vtk(time, deep=True)
    array.SetName("Time")
    path.GetPointData().AddArray(array)
    return path
