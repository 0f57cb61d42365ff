"""What is drawn is what is touched: polygons that are concave, have holes or are warped, with the values of
their cells, and no lines of a wireframe but their edges."""

import io
import os
import signal
import sys
import tempfile
from contextlib import redirect_stdout

import numpy as np
import vtkhaptics
from vtkhaptics import detail, polygons
from vtkhaptics.arguments import parse
from vtkhaptics.picture import surface_actor
from vtkhaptics.polygons import drawable
from vtkhaptics.viewer import Viewer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_QUAD, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

SIZE = 300, 200

# Outlines in the plane, counter-clockwise.
SLOT = [(-2, -1), (2, -1), (2, 1), (0.4, 1), (0.4, -0.6), (-0.4, -0.6), (-0.4, 1), (-2, 1)]
# With a hole that two edges join to the outline.
WINDOW = [(-2, -1), (-1, -0.5), (-1, 0.5), (1, 0.5), (1, -0.5), (-1, -0.5), (-2, -1), (2, -1), (2, 1), (-2, 1)]


def surface_of(points, cells):
    surface = vtkhaptics.polydata((np.array(points, float), cells))
    values = numpy_to_vtk(np.arange(float(len(cells))), deep=True)
    values.SetName("Part")
    surface.GetCellData().AddArray(values)
    return surface


def prism(outline):
    """A body with this outline: caps, whose values are 0 and 1, and walls, from 2 on."""
    count = len(outline)
    points = [(x, y, z) for z in (0.0, 1.0) for x, y in outline]
    walls = [[i, (i + 1) % count, count + (i + 1) % count, count + i] for i in range(count)]
    walls = [wall for wall in walls if not _is_bridge(outline, *wall[:2])]
    return surface_of(points, [list(range(count, 2 * count)), list(range(count - 1, -1, -1)), *walls])


def _is_bridge(outline, a, b):
    edges = list(zip(outline, [*outline[1:], outline[0]]))
    return (outline[b], outline[a]) in edges


def roof():
    """Quads that are warped: the hand meets ridges along their shorter diagonals."""
    points = [(x, y, 0.8 * ((x + y) % 2) * (1 + 0.1 * x)) for y in range(4) for x in range(4)]
    cells = [
        [i, i + 1, i + 5, i + 4][k:] + [i, i + 1, i + 5, i + 4][:k]
        for y in range(3) for x in range(3) for i, k in [(4 * y + x, (x + 2 * y) % 4)]]
    return surface_of(points, cells)


def write(surface, folder, name):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(folder, name))
    assert writer.Write() == 1
    return writer.GetFileName()


def open_viewer(path, *more):
    shown = Viewer(parse([path, "--offscreen", "--size", *map(str, SIZE), "--side", "both", *more]))
    with redirect_stdout(io.StringIO()):
        shown.add_surfaces()
    shown.open()
    assert shown.build()
    shown.hand.VisibilityOff()
    shown.style.GetView().GetOverlay().VisibilityOff()
    return shown


def places(shown):
    """Pixels, and where the surfaces that are touched lie under them, NaN where there is none; and where
    the drawn ones do."""
    shown.renderer.ResetCameraClippingRange()
    shown.window.Render()
    touched, drawn = [], []
    pixels = [(x, y) for y in range(2, SIZE[1], 5) for x in range(2, SIZE[0], 5)]
    for x, y in pixels:
        ends = []
        depth = shown.renderer.GetZ(x, y)
        for z in (0.0, 1.0, depth):
            shown.renderer.SetDisplayPoint(x + 0.5, y + 0.5, z)
            shown.renderer.DisplayToWorld()
            *point, w = shown.renderer.GetWorldPoint()
            ends.append(np.array(point) / w)
        hit = [0.0, 0.0, 0.0]
        found = shown.scene.IntersectRay(ends[0], ends[1] - ends[0], hit)
        touched.append(hit if found else [np.nan] * 3)
        drawn.append(ends[2] if depth < 1.0 else [np.nan] * 3)
    return np.array(pixels), np.array(touched), np.array(drawn)


def picture(shown):
    """Its pixels, rows from below."""
    shown.window.Render()
    shot = vtkWindowToImageFilter()
    shot.SetInput(shown.window)
    shot.ShouldRerenderOff()
    shot.ReadFrontBufferOff()
    shot.Update()
    pixels = vtk_to_numpy(shot.GetOutput().GetPointData().GetScalars())
    return pixels[:, :3].astype(int).reshape(SIZE[1], SIZE[0], 3)


def red(shown):
    pixels = picture(shown)
    return pixels[..., 0] - pixels[..., 1] > 60


def test_what_is_drawn_is_touched(folder):
    for name, surface in (("slot", prism(SLOT)), ("window", prism(WINDOW)), ("roof", roof())):
        shown = open_viewer(write(surface, folder, f"{name}.vtp"), "--scalars", "none")
        _, touched, drawn = places(shown)
        there = np.isfinite(touched[:, 0])
        assert 0.1 < there.mean() < 0.8, (name, there.mean())
        with np.errstate(invalid="ignore"):
            same = (there & (np.linalg.norm(touched - drawn, axis=1) < 1e-4)) | (
                ~there & np.isnan(drawn[:, 0]))
        print(f"{name}: {(~same).sum()} of {len(same)} pixels are of another place")
        assert (~same).mean() < 0.002, name  # a pixel at an edge


def test_values_are_those_of_the_cells(folder):
    outline = prism(SLOT)
    shown = open_viewer(write(outline, folder, "parts.vtp"), "--scalars", "Part")
    camera = shown.renderer.GetActiveCamera()
    camera.SetPosition(0.0, 0.0, 12.0)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 1.0, 0.0)
    actor = shown.renderer.GetActors().GetLastActor()
    actor.GetProperty().LightingOff()
    for prop in shown.renderer.GetViewProps():
        if prop.IsA("vtkScalarBarActor"):
            prop.VisibilityOff()
    pixels, touched, _ = places(shown)
    colors = picture(shown)
    right = 255.0 * np.array(actor.GetMapper().GetLookupTable().GetColor(0.0))
    looked_at = 0
    for (x, y), place in zip(pixels, touched):
        if place[2] > 0.999 and 0.6 < np.abs(place[0]) < 1.8 and np.abs(place[1]) < 0.8:  # no edge near
            assert np.abs(colors[y, x] - right).max() < 4.0, (x, y, place, colors[y, x], right)
            looked_at += 1
    assert looked_at > 100, looked_at


def test_wireframes_have_the_edges_of_polygons_alone(folder):
    for name, surface in (("slot", prism(SLOT)), ("roof", roof())):
        shown = open_viewer(write(surface, folder, f"lines_{name}.vtp"), "--scalars", "none")
        actor = shown.renderer.GetActors().GetLastActor()
        actor.GetProperty().SetRepresentationToWireframe()
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetColor(1.0, 0.0, 0.0)
        pictures = [red(shown)]
        # As VTK draws the lines of the polygons themselves.
        actor.GetMapper().SetInputData(surface)
        pictures.append(red(shown))
        other = (pictures[0] != pictures[1]).sum() / pictures[1].sum()
        assert pictures[1].sum() > 300 and other < 0.02, (name, pictures[1].sum(), other)


def test_what_vtk_draws_well_is_not_copied():
    ball = vtkSphereSource()
    ball.LatLongTessellationOn()  # flat quads
    for source in (ball, vtkSphereSource()):
        source.Update()
        assert drawable(source.GetOutput()) is source.GetOutput()
    flat = surface_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)], [[0, 1, 2, 3]])
    assert drawable(flat) is flat, "nothing can be touched"
    assert surface_actor(vtkPolyData()).GetMapper() is not None


def test_edges_are_known_of_cells_in_32_bits():
    points = [(0.0, 0.0, 0.0)] * 60000 + [(-1, -1, 0), (1, -1, 0), (0, -0.5, 0), (0, 1, 0)]
    flags = []
    for bits in (32, 64):
        arrow = surface_of(points, [[60000, 60002, 60001, 60003]])
        cells = arrow.GetPolys()
        assert cells.ConvertTo32BitStorage() if bits == 32 else cells.ConvertTo64BitStorage()
        flags.append(vtk_to_numpy(drawable(arrow).GetPointData().GetArray("vtkEdgeFlags")))
    assert (flags[0] == flags[1]).all() and flags[0][len(points):].sum() == 4, flags


def test_cells_of_points_that_are_not_there_are_named():
    """In memory, where no reader has looked at them: VTK would end the process."""
    for kind, count in (("Polys", 4), ("Strips", 4), ("Polys", 0), ("Polys", None)):
        for last in (4, -1, 2**40):
            cells = vtkCellArray()
            cells.InsertNextCell(4, [0, 1, 3, last])
            surface = vtkPolyData()
            if count is not None:
                surface.SetPoints(vtkPoints())
                surface.GetPoints().SetNumberOfPoints(count)
            getattr(surface, f"Set{kind}")(cells)
            grid = vtkUnstructuredGrid()
            grid.SetPoints(surface.GetPoints() or vtkPoints())
            grid.SetCells(VTK_QUAD, cells)
            words = f"a cell names point {last if count else 0}, but there are {count or 0} points"
            for call, data, begin in (
                (vtkhaptics.touch, surface, "" if not count else f"surface 0: {words}"),
                (drawable, surface, words), (surface_actor, surface, words), (vtkhaptics.polydata, grid, words),
            ):
                try:
                    call(data)
                except ValueError as error:
                    assert str(error).startswith(begin), (call, error)
                else:
                    raise AssertionError((call, kind, count, last))


def test_many_are_cut_in_parts_that_who_waits_sees_and_can_end():
    surface, shares = roof(), []
    whole = drawable(surface)
    before, polygons.AT_ONCE = polygons.AT_ONCE, 2

    def progress(share):
        shares.append(share)
        if len(shares) == 7:
            os.kill(os.getpid(), signal.SIGINT)

    try:
        parts = drawable(surface, progress)
        try:
            drawable(surface, progress)
        except KeyboardInterrupt:
            pass
    finally:
        polygons.AT_ONCE = before
    assert np.allclose(shares, [2 / 9, 4 / 9, 6 / 9, 8 / 9, 1.0, 2 / 9, 4 / 9]), shares
    for get in (lambda s: s.GetPoints().GetData(), lambda s: s.GetPolys().GetConnectivityArray(),
                lambda s: s.GetCellData().GetArray("Part"), lambda s: s.GetPointData().GetArray("vtkEdgeFlags")):
        assert (vtk_to_numpy(get(whole)) == vtk_to_numpy(get(parts))).all()


def test_large_ones_are_right_while_the_picture_moves(folder):
    path = write(prism(SLOT), folder, "large.vtp")
    before, detail.LARGE = detail.LARGE, 3
    slow, detail.FRAME_TIME = detail.FRAME_TIME, 0.0
    try:
        shown = open_viewer(path, "--scalars", "none")
        shown.window.Render()
        shown.detail.set_live(True)
        shown.window.Render()
        _, touched, drawn = places(shown)
    finally:
        detail.LARGE, detail.FRAME_TIME = before, slow
    coarse = shown.renderer.GetActors().GetLastActor().GetMapper().GetInput()
    assert not coarse.GetPointData().GetArray("vtkEdgeFlags"), "or it was drawn in full"
    there = np.isfinite(touched[:, 0])
    wrong = there != np.isfinite(drawn[:, 0])
    far = there & ~wrong & (np.linalg.norm(np.nan_to_num(touched - drawn), axis=1) > 0.3)
    print(f"coarse: {(wrong | far).sum()} of {len(wrong)} pixels are of another place")
    assert (wrong | far).mean() < 0.005, (wrong.mean(), far.mean())


with tempfile.TemporaryDirectory() as scratch:
    test_what_is_drawn_is_touched(scratch)
    test_values_are_those_of_the_cells(scratch)
    test_wireframes_have_the_edges_of_polygons_alone(scratch)
    test_large_ones_are_right_while_the_picture_moves(scratch)
test_what_vtk_draws_well_is_not_copied()
test_edges_are_known_of_cells_in_32_bits()
test_cells_of_points_that_are_not_there_are_named()
test_many_are_cut_in_parts_that_who_waits_sees_and_can_end()
sys.stdout.flush()
