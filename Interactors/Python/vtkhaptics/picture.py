"""Draws a touched surface: the surface well lit, the stroke over it coloured by force, the hand."""

import math

import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers the text renderer)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the render window)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

from .coloring import force_colors, scalar_bar
from .output import write_png
from .polygons import drawable, has_polygons
from .surfaces import SurfaceError
from .volumes import check_cells

SIZE = (1200, 800)
BACKGROUND = ((0.93, 0.94, 0.96), (0.66, 0.71, 0.78))


def surface_actor(surface, color=(0.74, 0.80, 0.86), progress=None):
    """An actor that shows a vtkPolyData smooth, but for edges sharper than 35 degrees; polygons, too, as
    they are touched. It follows later changes of one whose polygons VTK draws so by itself. `progress` is
    called with 0 to 1. Raises NoSurfaceError, a ValueError, where a cell names a point that is not there."""
    check_cells(surface)
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SetFeatureAngle(35.0)
    normals.ConsistencyOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    if has_polygons(surface):
        normals.Update()
        drawn = drawable(normals.GetOutput(), progress)
        if drawn is not normals.GetOutput():
            mapper.SetInputData(drawn)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*color)
    look.SetAmbient(0.12)
    look.SetDiffuse(0.85)
    look.SetSpecular(0.22)
    look.SetSpecularPower(24.0)
    return actor


def touched_actor(surface, shown):
    """An actor, not to be drawn, that a scene touches in the place of `shown`, which follows it: what is
    shown has its sharp edges split, and what is touched is the surface with the ids of its cells."""
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(surface)
    actor.SetMapper(mapper)
    shown.SetUserMatrix(actor.GetMatrix())
    return actor


def add_lights(renderer):
    """A warm key from the upper left, a cool fill from the right, a rim from behind."""
    renderer.AutomaticLightCreationOff()
    renderer.RemoveAllLights()
    for position, color, intensity in (
        ((-0.9, 1.1, 1.1), (1.0, 0.97, 0.92), 1.0),
        ((1.2, 0.1, 0.7), (0.86, 0.92, 1.0), 0.5),
        ((0.2, 0.9, -1.0), (1.0, 1.0, 1.0), 0.35),
    ):
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetFocalPoint(0.0, 0.0, 0.0)
        light.SetColor(*color)
        light.SetIntensity(intensity)
        renderer.AddLight(light)


def smooth_edges(renderer, window):
    """Smooths edges in a pass over the finished picture. Several samples a pixel, which VTK takes
    by default, make a picture drawn without a graphics card five to eight times as slow."""
    window.SetMultiSamples(0)
    renderer.UseFXAAOn()


def save_window(window, path, scale=2, inputs=()):
    """Writes a PNG of a window, drawn at a multiple of its size and averaged down for clean edges.

    With what is drawn over the picture in pixels use a scale of 1. Raises output.OutputError where
    it cannot be written or is one of the files `inputs`."""
    window.Render()
    shot = vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.SetScale(scale)
    shot.SetShouldRerender(scale > 1)
    shot.ReadFrontBufferOff()
    resize = vtkImageResize()
    resize.SetInputConnection(shot.GetOutputPort())
    resize.SetOutputDimensions(*window.GetSize(), 1)
    resize.Update()
    write_png(path, resize.GetOutput(), inputs)


def fill_view(camera, points, out, up, aspect, margin=1.12):
    """Looks at points (n x 3) from the direction `out`, as near as shows them all; `aspect` is the
    picture's width through its height. Points with NaN or infinite coordinates are passed over.

    Raises SurfaceError where no others are left."""
    points = points[np.isfinite(points).all(axis=1)].astype(float)
    if not len(points):
        raise SurfaceError(
            "no point of the surface has finite coordinates, so there is nothing to look at. "
            "Check the program that made it."
        )
    out = np.asarray(out) / np.linalg.norm(out)
    right = np.cross(up, out)
    right /= np.linalg.norm(right)
    axes = np.array([right, np.cross(out, right), out])
    low, high = (f(points @ axes.T, axis=0) for f in (np.min, np.max))
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    angle = 24.0
    need = max(half[0] / aspect, half[1]) * margin
    distance = need / math.tan(math.radians(0.5 * angle)) + half[2]
    focus = middle @ axes
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(focus + distance * out))
    camera.SetViewUp(*axes[1])
    camera.SetViewAngle(angle)


class Picture:
    """A render window with a surface, seen from where it is touched."""

    def __init__(self, surface, view, title, offscreen):
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND[0])
        self.renderer.SetBackground2(*BACKGROUND[1])
        self.renderer.GradientBackgroundOn()
        self.surface_actor = self._add_surface(surface)
        add_lights(self.renderer)
        self._aim(view, surface)
        self.add_text(title, 0.95, 20)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(offscreen)
        self.window.SetSize(*SIZE)
        smooth_edges(self.renderer, self.window)
        self.window.SetWindowName("VTK Haptics: " + title)
        self.window.AddRenderer(self.renderer)

    def _add_surface(self, surface):
        actor = surface_actor(surface)
        self.renderer.AddActor(actor)
        return actor

    def _aim(self, view, surface):
        """Fills the picture with the surface, as seen along the view."""
        points = vtk_to_numpy(surface.GetPoints().GetData())
        fill_view(
            self.renderer.GetActiveCamera(), points, view.out, view.up, SIZE[0] / SIZE[1]
        )
        self.renderer.ResetCameraClippingRange()

    def add_text(self, words, height, size, color=(0.18, 0.21, 0.27)):
        """Writes words at the left, at a share of the picture's height."""
        text = vtkTextActor()
        text.SetInput(words)
        text.GetTextProperty().SetFontSize(size)
        text.GetTextProperty().SetColor(*color)
        text.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        text.SetPosition(0.02, height)
        self.renderer.AddViewProp(text)

    def add_stroke(self, stroke, radius, strongest):
        """Draws lines as tubes of a radius [world unit], coloured by ForceMagnitude, 0 to the
        strongest force [N]."""
        tubes = vtkTubeFilter()
        tubes.SetInputData(stroke)
        tubes.SetRadius(radius)
        tubes.SetNumberOfSides(8)
        tubes.CappingOn()
        colors = force_colors(strongest)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(tubes.GetOutputPort())
        mapper.SelectColorArray("ForceMagnitude")
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SetLookupTable(colors)
        mapper.UseLookupTableScalarRangeOn()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.PickableOff()
        actor.GetProperty().SetAmbient(0.35)
        actor.GetProperty().SetDiffuse(0.75)
        self.renderer.AddActor(actor)
        self.renderer.AddViewProp(scalar_bar(colors, "force [N]"))

    def world_size(self, share_of_height):
        """A length [world unit] that is a share of the picture's height, at the focal point."""
        camera = self.renderer.GetActiveCamera()
        half = math.tan(math.radians(0.5 * camera.GetViewAngle()))
        return share_of_height * 2.0 * camera.GetDistance() * half

    def save(self, path, inputs=(), scale=2):
        """Writes a PNG, as save_window() does."""
        save_window(self.window, path, scale, inputs)


def stroke_lines(trace, step):
    """The parts of a trace in contact, as lines with the point array ForceMagnitude [N]; their points
    are about a `step` apart [world unit], however long the hand took or rested."""
    way = vtk_to_numpy(trace.GetPoints().GetData()).astype(float)
    way = np.cumsum(np.linalg.norm(np.diff(way, axis=0, prepend=way[:1]), axis=1))
    force = np.linalg.norm(vtk_to_numpy(trace.GetPointData().GetArray("Force")), axis=1)
    touching = vtk_to_numpy(trace.GetPointData().GetArray("ActiveConstraints")) > 0
    lines = vtkCellArray()
    edges = np.flatnonzero(np.diff(np.concatenate([[False], touching, [False]]).astype(int)))
    for begin, end in edges.reshape(-1, 2):
        _, first = np.unique(np.floor(way[begin:end] / step), return_index=True)
        ids = [int(i) for i in begin + first]
        lines.InsertNextCell(len(ids))
        for id_ in ids:
            lines.InsertCellPoint(id_)
    stroke = vtkPolyData()
    stroke.SetPoints(trace.GetPoints())
    stroke.SetLines(lines)
    magnitude = numpy_to_vtk(force, deep=True)
    magnitude.SetName("ForceMagnitude")
    stroke.GetPointData().AddArray(magnitude)
    # A hand at rest leaves equal points, which a tube cannot go through.
    clean = vtkCleanPolyData()
    clean.SetInputData(stroke)
    clean.ToleranceIsAbsoluteOn()
    clean.SetAbsoluteTolerance(0.0)
    clean.ConvertLinesToPointsOff()
    clean.Update()
    return clean.GetOutput()


def add_hand(picture, actor, trace):
    """Shows the hand in the tick whose force is seen best from the camera, the odd peak left out."""
    points = vtk_to_numpy(trace.GetPoints().GetData())
    data = trace.GetPointData()
    force = vtk_to_numpy(data.GetArray("Force"))
    hip = vtk_to_numpy(data.GetArray("HapticInterfacePoint"))
    toward = np.array(picture.renderer.GetActiveCamera().GetDirectionOfProjection())
    across = np.linalg.norm(force - np.outer(force @ toward, toward), axis=1)
    strength = np.linalg.norm(force, axis=1)
    across[strength > 1.5 * np.median(strength[strength > 0.0])] = 0.0
    tick = int(across.argmax())
    actor.SetGodObject(points[tick])
    actor.SetHapticInterfacePoint(hip[tick])
    actor.SetForce(force[tick])
    actor.SetTouching(bool(data.GetArray("ActiveConstraints").GetValue(tick) > 0))
    actor.ShowTrailOff()
    actor.SetReferenceForce(max(float(strength[tick]), 1e-12))
    actor.SetSize(0.015)
    for i, (words, look) in enumerate(
        (
            ("force", actor.GetForceProperty()),
            ("device (HIP)", actor.GetHapticInterfacePointProperty()),
            ("god-object", actor.GetGodObjectProperty()),
        )
    ):
        color = [0.75 * c for c in look.GetColor()]
        picture.add_text(words, 0.03 + 0.03 * i, 16, color)
    if not picture.renderer.HasViewProp(actor):
        picture.renderer.AddViewProp(actor)
    picture.renderer.ResetCameraClippingRange()
    actor.IncludeInClippingRange(picture.renderer)
