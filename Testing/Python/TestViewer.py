"""The viewer draws, records, replays and says what is wrong, each with its exit status."""

import gzip
import io
import os
import struct
import subprocess
import sys
import tempfile
import time
from contextlib import redirect_stderr, redirect_stdout

import file_kinds
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer, vtkRenderWindow

import vtkhaptics
from vtkhaptics import detail, surfaces
from vtkhaptics import viewer as viewer_module
from vtkhaptics.arguments import EPILOG, parse
from vtkhaptics.coloring import scalar_bar, value_colors
from vtkhaptics.picture import fill_view, save_window
from vtkhaptics.progress import ProgressBar
from vtkhaptics.recording import read_recording
from vtkhaptics.surfaces import unit_note
from vtkhaptics.units import file_unit
from vtkhaptics.viewer import Viewer, main


def viewer(*arguments):
    """Runs it in this process: most of the time goes into starting one."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            status = main([str(a) for a in arguments])
        except SystemExit as exit_:  # argparse's
            status = exit_.code
    return subprocess.CompletedProcess(arguments, status, out.getvalue(), err.getvalue())


def process(*arguments, **environment):
    """Runs it as people do."""
    return subprocess.run(
        [sys.executable, "-m", "vtkhaptics", *arguments],
        env={k: v for k, v in {**os.environ, **environment}.items() if v is not None},
        capture_output=True,
        text=True,
        check=False,
    )


def write(data, path):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.SetDataModeToBinary()
    assert writer.Write() == 1
    return path


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def ball(x, folder, resolution=40):
    source = vtkSphereSource()
    source.SetCenter(x, 0.0, 0.0)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    surface = source.GetOutput()
    height = vtkDoubleArray()
    height.SetName("Height")
    for i in range(surface.GetNumberOfPoints()):
        height.InsertNextValue(surface.GetPoint(i)[2])
    surface.GetPointData().AddArray(height)
    return write(surface, os.path.join(folder, f"ball{x:g}.vtp"))


def colors(path):
    """How many pixels of a picture have a strong colour."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    return int((pixels.max(axis=1) - pixels.min(axis=1) > 90).sum())


def test_touches_with_the_mouse_and_replays_it(folder):
    surface = ball(0.0, folder)
    picture, trace = (os.path.join(folder, name) for name in ("a.png", "a.vtp"))
    common = ("--offscreen", "--size", "300", "200", "--seconds", "2")
    done = viewer(
        surface, *common, "--scalars", "none", "--screenshot", picture, "--trace", trace
    )
    assert done.returncode == 0, done.stderr
    assert "length unit" in done.stdout, "a file without a unit is said to be one"
    touched = vtk_to_numpy(read(trace).GetPointData().GetArray("ActiveConstraints")) > 0
    assert touched.mean() > 0.5, touched.mean()
    plain = colors(picture)

    again = os.path.join(folder, "again.vtp")
    done = viewer(surface, *common, "--device", trace, "--trace", again)
    assert done.returncode == 0, done.stderr
    places, forces = (
        [vtk_to_numpy(read(path).GetPointData().GetArray(name)) for path in (trace, again)]
        for name in ("HapticInterfacePoint", "Force")
    )
    count = min(map(len, places)) - 2
    assert abs(places[0][:count] - places[1][:count]).max() < 1e-3, "the recording is followed"
    # The hand's space is not fitted anew: as deep as before is as strong as before, but while a press begins.
    lengths = [np.linalg.norm(force[:count], axis=1) for force in forces]
    same = abs(lengths[0] - lengths[1]) < 1e-3 * lengths[0].max()
    assert lengths[0].max() > 0.5 and same[lengths[0] > 0.5].mean() > 0.95, (lengths, same.mean())

    done = viewer(
        surface, ball(1.1, folder), *common, "--scalars", "Height", "--side", "both",
        "--screenshot", picture,
    )
    assert done.returncode == 0, done.stderr
    assert colors(picture) > 2 * plain, "the values are not coloured"


def test_colours_by_the_first_values_where_none_are_active(folder):
    surface = ball(0.0, folder)
    pictures = [os.path.join(folder, name) for name in ("first.png", "none.png")]
    for picture, more in zip(pictures, ((), ("--scalars", "none"))):
        done = viewer(
            surface, "--offscreen", "--size", "200", "200", "--seconds", "2",
            "--screenshot", picture, *more,
        )
        assert done.returncode == 0, done.stderr
    assert "3,040 triangles, 0.9992 x" in done.stdout, done.stdout
    assert colors(pictures[0]) > 4 * colors(pictures[1]) > 0, [colors(p) for p in pictures]


def test_options_of_the_material_and_landmarks(folder):
    surface, marks = ball(0.0, folder), os.path.join(folder, "marks.csv")
    done = viewer(
        surface, "--offscreen", "--seconds", "2", "--size", "200", "150", "--friction", "0.5",
        "--unit", "mm", "--landmarks", marks,
    )
    assert done.returncode == 0, done.stderr
    assert "x 1 mm" in done.stdout, done.stdout
    assert os.path.exists(marks)
    shown = Viewer(parse([surface, "--friction", "0.5", "--stiffness-array", "Height", "--substeps", "8", "--tip-radius", "0.002"]))
    assert shown.scene.GetServo().GetSubstepLimit() == 8
    assert shown.scene.GetTipRadius() == 0.002
    assert Viewer(parse([surface])).scene.GetServo().GetSubstepLimit() == 1
    with redirect_stdout(io.StringIO()):
        shown.add_surfaces()
    id_ = shown.scene.GetSurfaces().GetId(0)
    assert shown.scene.GetSurfaceProperties(id_).GetStaticFriction() == 0.5


def test_units_that_files_name(folder):
    nifti1, nifti2 = bytearray(352), bytearray(544)
    for header, size in ((nifti1, 348), (nifti2, 540)):
        struct.pack_into("<i", header, 0, size)
    for code, unit in ((0, None), (1, "m"), (2, "mm"), (3 + 8, "um")):  # 8: of time, seconds
        nifti1[123] = code
        struct.pack_into("<i", nifti2, 500, code)
        for number, header in enumerate((nifti1, nifti2)):
            path = os.path.join(folder, f"image{number}.nii")
            with open(path, "wb") as file, gzip.open(path + ".gz", "wb") as packed:
                file.write(header)
                packed.write(header)
            assert file_unit(path) == file_unit(path + ".gz") == unit, (code, number)
    assert file_unit("part.glb") == "m" and file_unit("pial.gii.gz") == "mm"
    assert file_unit(folder) == "mm" and file_unit("part.stl") is None
    text = unit_note("part.glb", vtkhaptics.polydata(vtkSphereSource()))
    assert text.endswith("x 1 m"), text
    assert unit_note("part.glb", vtkhaptics.polydata(vtkSphereSource()), "in").endswith("x 1 in")


def test_large_surfaces_are_coarse_while_the_picture_moves(folder):
    before, detail.LARGE = detail.LARGE, 1000
    try:
        shown = Viewer(parse([ball(0.0, folder, 100), "--offscreen", "--size", "200", "150"]))
        with redirect_stdout(io.StringIO()):
            shown.add_surfaces()
    finally:
        detail.LARGE = before
    shown.open()
    actor = shown.renderer.GetActors().GetLastActor()

    def triangles():
        shown.window.Render()
        return actor.GetMapper().GetInput().GetNumberOfPolys()

    full = triangles()
    assert triangles() == full, "off screen nobody waits for a picture"
    shown.detail.set_live(True)
    slow, detail.FRAME_TIME = detail.FRAME_TIME, 3600.0
    try:
        assert triangles() == full, "fast enough"
        detail.FRAME_TIME = 0.0
        assert 100 < triangles() < full
        assert not shown.detail.rest(), "it still moves"
        assert triangles() < full
        time.sleep(detail.REST + 0.1)
        assert shown.detail.rest()
        assert triangles() == full and not shown.detail.rest()
        assert triangles() < full, "the first one that moves again"
        shown.detail.set_live(False)
        assert triangles() == full
    finally:
        detail.FRAME_TIME = slow


def pixels(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)


def test_the_picture_is_the_same_at_every_scale(folder):
    """While a surface is prepared, and with the hand on it: clipped nowhere, marks in proportion."""
    pictures = {}
    for scale in (1.0, 1e-9, 1e-3, 1e4, 1e12):
        surface = read(ball(0.0, folder))
        points = vtk_to_numpy(surface.GetPoints().GetData())
        points *= scale
        path = write(surface, os.path.join(folder, f"scale{scale:g}.vtp"))
        prepared, touched = (os.path.join(folder, f"{kind}{scale:g}.png") for kind in "pt")
        common = (path, "--offscreen", "--size", "300", "200", "--seconds", "2", "--scalars", "none")
        shown = Viewer(parse(common))
        with redirect_stdout(io.StringIO()):
            shown.add_surfaces()
        shown.open()
        save_window(shown.window, prepared, scale=1)
        done = viewer(*common, "--screenshot", touched)
        assert done.returncode == 0, (scale, done.stderr)
        pictures[scale] = pixels(prepared), pixels(touched)
    background = pictures[1.0][0][[0, -1]].mean()
    for scale, found in pictures.items():
        for picture, right in zip(found, pictures[1.0]):
            # The upper half: below are the coordinates in words.
            picture, right = picture[len(picture) // 2 :], right[len(right) // 2 :]
            assert np.abs(picture - background).max() > 60.0, f"{scale}: there is nothing"
            # But for pixels at the silhouette, which rounding moves.
            wrong = (np.abs(picture - right).max(axis=1) > 40.0).mean()
            assert wrong < 0.002, f"{scale}: {100 * wrong:.2f} % of the picture is another"


def test_the_examples_of_the_help(folder):
    examples = [line.split()[3:] for line in EPILOG.splitlines() if "python3 -m vtkhaptics" in line]
    assert len(examples) == 6, examples
    for name in ("gearbox.stl", "vessel.stl", "t13.stl"):
        file_kinds.write(vtkSTLWriter(), file_kinds.ball(), os.path.join(folder, name))
    for name in ("pial.vtp", "skull.vtp"):
        surface = read(ball(0.0, folder))
        surface.GetPointData().GetArray("Height").SetName("Sulc")
        write(surface, os.path.join(folder, name))
    bright = file_kinds.image()
    bright.SetScale(4.0)
    file_kinds.write(file_kinds.vtkNIFTIImageWriter(), bright, os.path.join(folder, "head.nii.gz"))
    before = os.getcwd()
    os.chdir(folder)
    try:
        for example in examples:
            more = [] if "--offscreen" in example else ["--offscreen"]
            done = viewer(*example, *more, "--seconds", "2", "--size", "200", "150")
            assert done.returncode == 0, (example, done.stderr)
            for option in ("--screenshot", "--trace", "--landmarks"):
                if option in example:
                    written = example[example.index(option) + 1]
                    assert os.path.getsize(written) > 0, (example, written)
    finally:
        os.chdir(before)


def test_outputs_that_cannot_be_written_are_found_before_a_surface_is_read(folder):
    for option, name in (("--screenshot", "a.png"), ("--trace", "a.vtp"), ("--landmarks", "a.csv")):
        path = os.path.join(folder, "missing", name)
        done = viewer(os.path.join(folder, "no.stl"), "--offscreen", option, path)
        assert done.returncode == 1 and path in done.stderr, (option, done.stderr)
        assert "no.stl" not in done.stderr, "before the surface"


def test_a_device_that_is_homed_is_waited_for_and_says_so(folder):
    class Homing(vtkhaptics.vtkSimulatedHapticDevice):
        looks, ends = 0, None

        def GetState(self):
            return super().GetState() if self.looks > 2 else vtkhaptics.vtkHapticDevice.Homing

        def GetStatusMessage(self):
            return "push the grip in and pull it out" if self.looks < 3 else ""

        def IsOpen(self):
            return self.looks > 2 and self.ends is None

        def GetErrorMessage(self):
            return self.ends or ""

        def Open(self):
            return False

        def Update(self):
            self.looks += 1
            shown_meanwhile.append(shown.style.GetView().GetOverlay().GetStatus())

    shown_meanwhile = []
    shown = Viewer(parse([ball(0.0, folder), "--offscreen", "--size", "200", "150"]))
    with redirect_stdout(io.StringIO()) as said:
        shown.add_surfaces()
        shown.open()
        shown.device = Homing()
        shown._wait_for_device()
    assert said.getvalue().count("push the grip in") == 1, said.getvalue()
    assert set(shown_meanwhile) == {"push the grip in and pull it out"}, shown_meanwhile
    assert shown.style.GetView().GetOverlay().GetStatus() == ""
    shown.device = Homing()
    shown.device.ends = "the Falcon was unplugged"
    try:
        with redirect_stdout(io.StringIO()):
            shown._wait_for_device()
    except viewer_module.ViewerError as error:
        assert str(error) == "the Falcon was unplugged", error
    else:
        raise AssertionError("a device that does not open is an error")


def test_simulated(folder):
    trace = os.path.join(folder, "s.vtp")
    done = viewer(
        ball(0.0, folder), "--device", "simulated", "--offscreen", "--seconds", "2", "--trace", trace
    )
    assert done.returncode == 0, done.stderr
    touched = vtk_to_numpy(read(trace).GetPointData().GetArray("ActiveConstraints")) > 0
    assert touched.mean() > 0.3, touched.mean()


def test_a_hand_that_meets_nothing_ends_with_the_stroke_and_says_so(folder):
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, -1), (1e-3, 0, -1), (0, 1e-3, -1)]
    plate = vtkhaptics.polydata((np.array(corners, float), [[0, 1, 2], [2, 3, 0], [4, 5, 6]]))
    ghosts = numpy_to_vtk(np.array([1, 1, 0], np.uint8), deep=True)  # another process has these cells
    ghosts.SetName("vtkGhostType")
    plate.GetCellData().AddArray(ghosts)
    trace = os.path.join(folder, "missed.vtp")
    done = viewer(write(plate, os.path.join(folder, "plate.vtp")), "--device", "simulated",
                  "--offscreen", "--seconds", "2", "--trace", trace)
    assert done.returncode == 1 and "met nothing on its way" in done.stderr, done
    assert "MaximumTicks" not in done.stderr and 1900 <= read(trace).GetNumberOfPoints() <= 2000, done


def test_a_trace_that_is_full_says_so(folder):
    trace = os.path.join(folder, "full.vtp")
    shown = Viewer(parse([ball(0.0, folder), "--offscreen", "--seconds", "2", "--trace", trace]))
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        shown.add_surfaces()
        shown.open()
        assert shown.build()
        shown.connect()
        shown.scene.GetTraceRecorder().SetMaximumTicks(500)
        shown.run()
    assert out.getvalue().count("the trace is full, with 500 ticks") == 1 and not err.getvalue(), (out, err)
    assert read(trace).GetNumberOfPoints() == 500


def test_the_window_is_there_while_surfaces_are_built(folder):
    viewer_module.PATIENCE, viewer_module.BUILD_FRAME = 0.0, 0.001

    def opened():
        shown = Viewer(parse([ball(3.0, folder, 200), "--size", "200", "200", "--scalars", "none"]))
        with redirect_stdout(io.StringIO()):
            shown.add_surfaces()
        shown.open()
        return shown

    def words(shown):
        return [text for text in [shown.style.GetView().GetOverlay().GetStatus()] if text]

    shown, seen = opened(), []
    shown.window.AddObserver("EndEvent", lambda *_: seen.extend(words(shown)))
    assert shown.build()
    assert any("preparing" in text for text in seen), seen
    assert not words(shown), "it goes away"
    assert shown.scene.GetSurfaces().IsTouchable(shown.scene.GetSurfaces().GetId(0))

    shown = opened()
    shown.scene.AddObserver(
        shown.scene.BuildEvent, lambda *_: shown.interactor.InvokeEvent("ExitEvent"))
    assert not shown.build(), "who closes the window does not wait"
    assert not shown.scene.GetSurfaces().IsTouchable(shown.scene.GetSurfaces().GetId(0))


def test_what_is_gripped_moves_in_the_picture(folder):
    path = ball(0.0, folder)
    shown = Viewer(parse([path, "--offscreen", "--size", "200", "200", "--scalars", "none"]))
    with redirect_stdout(io.StringIO()):
        shown.add_surfaces()
    shown.open()
    assert shown.build()
    shown.connect()
    scene, device = shown.scene, shown.device
    scene.Step(1)
    device.MoveTo(100, 100)
    scene.Step(300)
    device.SetPressed(True)
    scene.Step(200)
    assert scene.GetTouching()
    assert scene.GetSurfaces().GetName(scene.GetTouchedSurface()) == os.path.basename(path)
    drawn = shown.renderer.GetActors().GetLastActor()
    before, hand = np.array(drawn.GetCenter()), np.array(scene.GetGodObject())
    assert scene.GetGrip().Take(), scene.GetErrorMessage()
    device.MoveTo(140, 100)
    for _ in range(10):
        scene.Step(30)
    moved, led = np.array(drawn.GetCenter()) - before, np.array(scene.GetGodObject()) - hand
    assert np.linalg.norm(led) > 0.1, led
    assert np.linalg.norm(moved - led) < 0.1 * np.linalg.norm(led), (moved, led)


def test_bar_and_colours_end_at_the_largest_force(folder):
    path = ball(0.0, folder)
    for more, strongest in (((), 5.0), (("--force-limit", "2"), 2.0), (("--device", "simulated"), 3.3)):
        shown = Viewer(parse([path, "--offscreen", "--size", "200", "200", "--scalars", "none", *more]))
        with redirect_stdout(io.StringIO()):
            shown.add_surfaces()
        shown.open()
        assert shown.build()
        shown.connect()
        shown.scene.Step(16)
        overlay, hand = shown.style.GetView().GetOverlay(), shown.hand
        assert overlay.GetMaximumForce() == hand.GetReferenceForce() == strongest, (more, strongest)
        assert hand.GetForceColors().GetRange() == (0.0, strongest), (more, strongest)


def test_a_scale_has_zero_where_rounding_has_left_something():
    for low, high, right in (
        (-0.5, 1.0, ["-0.5", "0", "0.5", "1"]), (-0.2, 0.1, ["-0.2", "-0.1", "0", "0.1"]),
        (-0.0, 3.0, ["0", "1", "2", "3"]), (0.0, 5.0, ["0", "1.67", "3.33", "5"]),
        (-3e-12, 6e-12, ["-3e-12", "0", "3e-12", "6e-12"]),
    ):
        bar = scalar_bar(value_colors(low, high), "values")
        labels = vtk_to_numpy(bar.GetCustomLabels())
        assert bar.GetUseCustomLabels(), "else VTK makes its own"
        assert [bar.GetLabelFormat() % label for label in labels] == right, (low, high, labels)


def test_the_title_of_a_scale_has_room(folder):
    """Above the label of the largest value, in windows of all sizes: empty rows between the two."""
    for size in ((400, 300), (800, 600), (1200, 800)):
        bar = scalar_bar(value_colors(-1.0, 1.0), "gyri", size)  # letters that go below the line
        renderer, window = vtkRenderer(), vtkRenderWindow()
        renderer.SetBackground(1.0, 1.0, 1.0)
        renderer.AddViewProp(bar)
        window.SetOffScreenRendering(True)
        window.SetMultiSamples(0)
        window.SetSize(*size)
        window.AddRenderer(renderer)
        path = os.path.join(folder, "scale.png")
        save_window(window, path, scale=1)
        colors = pixels(path).reshape(size[1], size[0], 3)
        is_text = (np.ptp(colors, axis=2) < 40) & (colors.max(axis=2) < 200)  # and no colour of the scale
        rows = np.flatnonzero(is_text.any(axis=1))
        gaps = np.diff(rows)
        assert (gaps > 6).sum() == 4, (size, rows)  # of four labels and a title


def test_bad_input(folder):
    surface = ball(0.0, folder)
    line = vtkLineSource()
    line.Update()
    lines = write(line.GetOutput(), os.path.join(folder, "lines.vtp"))
    empty = os.path.join(folder, "empty.stl")
    with open(empty, "w", encoding="ascii"):
        pass
    fifo = os.path.join(folder, "fifo.stl")
    os.mkfifo(fifo)  # which nobody will ever write to
    nothing = os.path.join(folder, "nothing.stl")
    os.mkdir(nothing)
    for status, text, arguments in (
        (2, "no regular file", (fifo,)),
        (2, "no polygons", (lines,)),
        (2, "could not be read", (empty,)),
        (2, "no such file", (os.path.join(folder, "missing.stl"),)),
        *((2, "is empty; give a name", arguments) for arguments in (
            ("",), *((surface, option, "") for option in (
                "--device", "--scalars", "--stiffness-array", "--friction-array", "--firmware", "--unit", "--side",
                "--screenshot", "--trace", "--landmarks")))),
        (2, "is a folder, and what is in it", (nothing,)),
        (2, "not known", (__file__,)),
        (2, "It has: ", (surface, "--scalars", "Hieght")),
        (2, "neither a device", (surface, "--device", "joystick")),
        (2, "no id of a device", (surface, "--device", "mouse:3")),
        (2, "holds no recorded hand", (surface, "--device", lines)),
        (2, "neither a device", (os.path.join(folder, "missing.stl"), "--device", "joystick")),  # before a surface
        (1, "could not be written", (surface, "--trace", os.path.join(folder, "no", "t.vtp"))),
        (2, "out of range", (surface, "--stiffness", "-1")),
        (2, "must end in .png", (surface, "--screenshot", "a.jpg")),
        (1, "no folder", (surface, "--landmarks", os.path.join(folder, "no", "l.csv"))),
        (2, "It has: ", (surface, "--stiffness-array", "Hieght")),
        (2, "out of range", (surface, "--friction", "-1")),
        (2, "give 1 to 16", (surface, "--substeps", "0")),
        (2, "give 0 to 1 m", (surface, "--tip-radius", "-0.001")),
        (2, "give 0 to 1 m", (surface, "--tip-radius", "nan")),
        (2, "invalid int", (surface, "--substeps", "2.5")),
        (2, "--device falcon", (surface, "--firmware", "a.bin")),
        (2, "required", ()),
    ):
        failed = viewer(*arguments, "--offscreen", "--seconds", "2")
        assert failed.returncode == status, (arguments, failed.returncode, failed.stderr)
        assert text in failed.stderr, (text, failed.stderr)
        assert "Traceback" not in failed.stderr, failed.stderr


def test_stl_files_hold_at_least_as_many_triangles_as_they_say(folder):
    path = os.path.join(folder, "ball.stl")
    writer = vtkSTLWriter()
    writer.SetInputData(read(ball(0.0, folder)))
    writer.SetFileName(path)
    writer.SetFileTypeToBinary()
    assert writer.Write() == 1
    with open(path, "rb") as file:
        count, triangles = (whole := file.read())[80:84], whole[84:]
    for header in (b"made by a test", b"solid ball"):
        for head, rest, refused in (
            (count, triangles, False),
            (bytes(4), triangles, False),  # not known when the header was written
            (count, triangles + b"end", False),
            (b"\xff\xff\xff\x7f", triangles, True),  # VTK would end the process
            (b"\x05\x00\x00\x00", triangles, False),  # says fewer than there are
            (count, triangles + bytes(60), False),
            (count, triangles[:-60], True),
        ):
            with open(path, "wb") as file:
                file.write(header.ljust(80, b"\0") + head + rest)
            if refused:
                failed = viewer(path, "--offscreen")
                assert failed.returncode == 2 and path in failed.stderr, failed.stderr
                assert "triangles, but its" in failed.stderr, failed.stderr
            else:
                assert surfaces.read_surface(path).GetNumberOfPolys() == 3040, (header, head)

    with gzip.open(path + ".gz", "wb", compresslevel=1) as file:
        file.write(whole)
    assert surfaces.read_surface(path + ".gz").GetNumberOfPolys() == 3040
    with open(path + ".gz", "r+b") as file:
        file.truncate(len(whole) // 20)
    failed = viewer(path + ".gz", "--offscreen")
    assert failed.returncode == 2 and "could not be unpacked" in failed.stderr, failed.stderr


def write_stl_text(path, name, folder):
    writer = vtkSTLWriter()
    writer.SetInputData(read(ball(0.0, folder)))
    writer.SetFileName(path)
    writer.SetFileTypeToASCII()
    assert writer.Write() == 1
    with open(path, "rb") as file:
        rest = file.read().split(b"\n", 1)[1]
    with open(path, "wb") as file:
        file.write(f"solid {name}\n".encode() + rest)


def test_an_stl_text_may_have_a_name_in_any_letters(folder):
    path = os.path.join(folder, "named.stl")
    for name in ("ball", "\u51cf\u901f\u5668\u5916\u58f3\u96f6\u4ef6\u56fe", "Kugelst\u00fcck"):
        write_stl_text(path, name, folder)
        assert surfaces.read_surface(path).GetNumberOfPolys() == 3040, name


def test_a_text_takes_no_more_memory_than_its_triangles(folder):
    path = os.path.join(folder, "text.stl")
    write_stl_text(path, "ball", folder)
    sysconf = os.sysconf
    pages = int(0.3 * os.path.getsize(path) * surfaces.MEMORY_FACTOR / surfaces.LARGEST_SHARE)
    pages //= sysconf("SC_PAGE_SIZE")
    os.sysconf = lambda name: pages if name == "SC_PHYS_PAGES" else sysconf(name)
    try:
        assert surfaces.read_surface(path).GetNumberOfPolys() == 3040
    finally:
        os.sysconf = sysconf


def test_vectors_that_are_not_finite_do_not_hide_a_surface(folder):
    for value in (np.inf, np.nan):
        surface = read(ball(0.0, folder))
        vectors = np.zeros((surface.GetNumberOfPoints(), 3))
        vectors[: 1 if value == np.inf else None] = value
        for name in ("Velocity", "HapticInterfacePoint"):
            array = numpy_to_vtk(vectors, deep=True)
            array.SetName(name)
            array.GetRange(-1)  # which VTK keeps, writes and cannot read again
            surface.GetPointData().AddArray(array)
        time = numpy_to_vtk(np.arange(float(len(vectors))), deep=True)
        time.SetName("Time")
        surface.GetPointData().AddArray(time)
        path = write(surface, os.path.join(folder, "vectors.vtp"))
        with open(path, encoding="ascii") as file:
            text = file.read()
        assert "L2_NORM_RANGE" in text, "or this tests nothing"
        found = surfaces.read_surface(path).GetPointData().GetArray("Velocity")
        assert np.array_equal(vtk_to_numpy(found), vectors, equal_nan=True)
        assert read_recording(path).GetNumberOfPoints() == len(vectors)

        with open(path, "w", encoding="ascii") as file:
            file.write(text[: len(text) // 2])
        failed = viewer(path, "--offscreen")
        assert failed.returncode == 2 and "could not be read" in failed.stderr, failed.stderr


def test_the_view_passes_over_points_that_are_not_finite(folder):
    surface = read(ball(0.0, folder))
    points = vtk_to_numpy(surface.GetPoints().GetData())
    cameras = [vtkCamera(), vtkCamera()]
    for camera, seen in zip(cameras, (points, np.vstack([points, [[np.nan, 0.0, np.inf]]]))):
        fill_view(camera, seen, out=(0.0, -1.0, 0.0), up=(0.0, 0.0, 1.0), aspect=1.5)
    assert cameras[0].GetPosition() == cameras[1].GetPosition()
    points[:] = np.nan
    path = write(surface, os.path.join(folder, "nowhere.vtp"))
    failed = viewer(path, "--offscreen", "--scalars", "none")
    assert failed.returncode == 2 and path in failed.stderr, failed.stderr
    assert "finite coordinates" in failed.stderr, failed.stderr


def test_enormous_files_are_refused(folder):
    surface, factor = ball(0.0, folder), surfaces.MEMORY_FACTOR
    surfaces.MEMORY_FACTOR = 1e12  # as if the file were so much larger
    try:
        failed = viewer(surface, "--offscreen")
    finally:
        surfaces.MEMORY_FACTOR = factor
    assert failed.returncode == 2 and "more than half of the memory" in failed.stderr, failed.stderr


def test_surfaces_that_cannot_be_touched(folder):
    flat = vtkSphereSource()
    flat.Update()
    surface = flat.GetOutput()
    for i in range(surface.GetNumberOfPoints()):
        surface.GetPoints().SetPoint(i, surface.GetPoint(i)[0], 0.0, 0.0)
    path = write(surface, os.path.join(folder, "flat.vtp"))
    failed = viewer(path, "--offscreen")
    assert failed.returncode == 2 and path in failed.stderr, failed.stderr
    assert "cannot be touched" in failed.stderr, failed.stderr


def test_progress():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    terminal = Terminal()
    with ProgressBar("reading a.stl", terminal) as bar:
        bar.show(0.1)
        assert terminal.getvalue() == "", "nothing for what is quick"
        bar.began -= 10.0
        bar.show(0.5)
        assert "reading a.stl" in terminal.getvalue() and "50 %" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r"), "it goes away"
    pipe = io.StringIO()
    with ProgressBar("reading a.stl", pipe) as bar:
        bar.began -= 10.0
        bar.show(0.5)
    assert pipe.getvalue() == "", "no bar in a file"


def test_as_a_process(folder):
    done = process("--help")
    assert done.returncode == 0
    for named in ("examples:", "exit status:", "--device", ".gii", "length unit"):
        assert named in done.stdout, named
    done = process(ball(0.0, folder), DISPLAY=None)
    assert done.returncode == 3 and "--offscreen" in done.stderr, done.stderr


with tempfile.TemporaryDirectory() as scratch:
    for test in (
        # First: VTK's X11 interactor crashes in ProcessEvents() after another one has lost its window.
        test_the_window_is_there_while_surfaces_are_built,
        test_touches_with_the_mouse_and_replays_it,
        test_colours_by_the_first_values_where_none_are_active,
        test_options_of_the_material_and_landmarks,
        test_units_that_files_name,
        test_large_surfaces_are_coarse_while_the_picture_moves,
        test_the_picture_is_the_same_at_every_scale,
        test_the_examples_of_the_help,
        test_outputs_that_cannot_be_written_are_found_before_a_surface_is_read,
        test_a_device_that_is_homed_is_waited_for_and_says_so,
        test_simulated,
        test_a_hand_that_meets_nothing_ends_with_the_stroke_and_says_so,
        test_a_trace_that_is_full_says_so,
        test_what_is_gripped_moves_in_the_picture,
        test_bar_and_colours_end_at_the_largest_force,
        test_the_title_of_a_scale_has_room,
        test_bad_input,
        test_stl_files_hold_at_least_as_many_triangles_as_they_say,
        test_an_stl_text_may_have_a_name_in_any_letters,
        test_a_text_takes_no_more_memory_than_its_triangles,
        test_vectors_that_are_not_finite_do_not_hide_a_surface,
        test_the_view_passes_over_points_that_are_not_finite,
        test_enormous_files_are_refused,
        test_surfaces_that_cannot_be_touched,
        test_as_a_process,
    ):
        test(scratch)
test_progress()
test_a_scale_has_zero_where_rounding_has_left_something()
