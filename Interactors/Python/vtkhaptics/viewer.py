"""Touches surfaces from files: with the mouse, a simulated hand, a device or a recording.

See ``python3 -m vtkhaptics --help``.
"""

import argparse
import os
import sys

import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers the interactors)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers the text renderer)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor

import vtkhaptics
from . import (
    vtkHapticScene,
    vtkInteractorStyleHaptic,
    vtkMouseHapticDevice,
    vtkSimulatedHapticDevice,
)
from .display import DisplayError, ensure_display
from .picture import BACKGROUND, OutputError, add_lights, fill_view, save_window, surface_actor, write_atomically
from .progress import ProgressBar
from .stroke import StrokeError, in_device_frame, plan_stroke
from .surfaces import (
    FORMATS,
    SurfaceError,
    default_array,
    read_surface,
    unit_note,
    value_arrays,
)

EXIT_DONE, EXIT_FAILED, EXIT_INPUT, EXIT_DISPLAY = 0, 1, 2, 3
SIDES = {"auto": "SetSideToAutomatic", "front": "SetSideToFront", "both": "SetSideToBoth"}
COLORS = ((0.74, 0.80, 0.86), (0.86, 0.78, 0.66), (0.70, 0.82, 0.72), (0.84, 0.72, 0.78))
TEXT = (0.18, 0.21, 0.27)
# Dark blue over green to yellow: even steps for the eye, readable without colours.
VALUE_COLORS = (
    (0.27, 0.00, 0.33),
    (0.25, 0.27, 0.53),
    (0.16, 0.47, 0.56),
    (0.13, 0.66, 0.52),
    (0.48, 0.82, 0.32),
    (0.99, 0.91, 0.14),
)

EPILOG = """examples:
  python3 -m vtkhaptics gearbox.stl
      touch it with the mouse: the wheel presses, space strokes, ? lists the keys
  python3 -m vtkhaptics pial.vtp --scalars sulc --device simulated
      a simulated hand strokes it; values are coloured
  python3 -m vtkhaptics skull.vtp vessel.stl --stiffness 800 --side both
      two surfaces at once, harder, touched from inside too; x carries the one that is touched
  python3 -m vtkhaptics t13.stl --offscreen --screenshot t13.png --trace t13.vtp
      no window: a picture and what was felt, one point a tick
  python3 -m vtkhaptics t13.stl --device t13.vtp
      feel a recorded path again

without a window (--offscreen) time is virtual, so that every run gives the same picture; nobody
moves the mouse there, so it strokes across the middle of the view by itself.

files name no length unit: sizes are shown in the file's own, and the hand's space is fitted to them.

exit status:
  0 done; 1 the device or the servo failed, or a file could not be written; 2 wrong arguments or a
  surface that cannot be read; 3 no display to draw with
"""


class ViewerError(Exception):
    """What went wrong and what to do, for people."""


def parse(arguments):
    """The options of a command line; exits with 2 where they are wrong."""
    parser = argparse.ArgumentParser(
        prog="python3 -m vtkhaptics",
        description="Touch surfaces from files, at 1000 forces a second.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "surfaces", nargs="+", metavar="SURFACE", help="what to touch: " + ", ".join(FORMATS)
    )
    parser.add_argument(
        "--device",
        default="mouse",
        metavar="NAME",
        help="mouse (default), simulated, falcon, or a recording: a .vtp as --trace writes it",
    )
    parser.add_argument(
        "--stiffness",
        type=float,
        default=500.0,
        metavar="K",
        help="of the surfaces in the hand [N/m], above 0 (default 500)",
    )
    parser.add_argument(
        "--side",
        choices=SIDES,
        default="auto",
        help="which side can be touched: auto (default; the front of closed surfaces, both of open "
        "ones), front or both",
    )
    parser.add_argument(
        "--scalars",
        metavar="ARRAY",
        help="point or cell array to colour by (default: the active one, or else the first that "
        "holds values; 'none' for no colours)",
    )
    parser.add_argument(
        "--screenshot", metavar="FILE", help="write a PNG of the end, or when the window is closed"
    )
    parser.add_argument("--trace", metavar="FILE", help="write what was felt as .vtp")
    parser.add_argument("--offscreen", action="store_true", help="open no window")
    parser.add_argument(
        "--seconds",
        type=float,
        default=8.0,
        metavar="S",
        help="how long a simulated hand strokes, or an off-screen run takes, 2 to 600 (default 8)",
    )
    parser.add_argument(
        "--size",
        type=int,
        nargs=2,
        default=(1200, 800),
        metavar=("W", "H"),
        help="of the picture [pixel], 100 to 8000 (default 1200 800)",
    )
    options = parser.parse_args(arguments)
    if not 0.0 < options.stiffness < 1e6:
        parser.error(f"--stiffness {options.stiffness:g} is out of range; give 0 to 1e6 N/m")
    if not 2.0 <= options.seconds <= 600.0:
        parser.error(f"--seconds {options.seconds:g} is out of range; give 2 to 600")
    if not all(100 <= pixels <= 8000 for pixels in options.size):
        parser.error(f"--size {options.size[0]} {options.size[1]} is out of range; give 100 to 8000")
    for name, extension in (("screenshot", ".png"), ("trace", ".vtp")):
        path = getattr(options, name)
        if path and not path.lower().endswith(extension):
            parser.error(f"--{name} {path}: its name must end in {extension}")
    return options


class Viewer:
    """A window over a haptic scene with the surfaces of some files."""

    def __init__(self, options):
        self.options = options
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND[0])
        self.renderer.SetBackground2(*BACKGROUND[1])
        self.renderer.GradientBackgroundOn()
        add_lights(self.renderer)
        self.scene = vtkHapticScene()
        self.scene.SetStiffness(options.stiffness)
        self.surfaces = []

    def add_surfaces(self):
        """Reads, builds and shows the files. Raises SurfaceError."""
        for number, path in enumerate(self.options.surfaces):
            name = os.path.basename(path)
            with ProgressBar(f"reading {name}") as bar:
                surface = read_surface(path, bar.show)
            actor = surface_actor(surface, COLORS[number % len(COLORS)])
            self._color(actor, surface, path)
            self.renderer.AddActor(actor)
            id_ = self.scene.AddSurface(surface)
            prepared = self.scene.GetSurfaceFilter(id_)
            getattr(prepared, SIDES[self.options.side])()
            with ProgressBar(f"building {name}") as bar:
                prepared.AddObserver(
                    "ProgressEvent", lambda caller, _event, bar=bar: bar.show(caller.GetProgress())
                )
                failures = []
                watch = self.scene.AddObserver("ErrorEvent", lambda *_: failures.append(True))
                self.scene.Update()
                self.scene.RemoveObserver(watch)
            if not self.scene.IsSurfaceTouchable(id_):
                raise SurfaceError(f"{path}: {self.scene.GetErrorMessage()}")
            print(unit_note(path, surface), flush=True)
            self.surfaces.append(surface)

    def _color(self, actor, surface, path):
        """Colours an actor by the array that the options ask for."""
        wanted = self.options.scalars
        if wanted == "none":
            return
        points, cells = surface.GetPointData(), surface.GetCellData()
        name = wanted or default_array(surface)
        array = points.GetArray(name) or cells.GetArray(name) if name else None
        if not array:
            if wanted and not any(
                s.GetPointData().HasArray(wanted) or s.GetCellData().HasArray(wanted)
                for s in self.surfaces
            ):
                known = ", ".join(value_arrays(surface)) or "none"
                raise SurfaceError(
                    f"{path}: has no array '{wanted}' to colour by. It has: {known}."
                )
            return
        mapper = actor.GetMapper()
        mapper.ScalarVisibilityOn()
        if points.HasArray(name):
            mapper.SetScalarModeToUsePointFieldData()
        else:
            mapper.SetScalarModeToUseCellFieldData()
        mapper.SelectColorArray(name)
        if array.GetDataTypeAsString() == "unsigned char" and array.GetNumberOfComponents() > 2:
            return  # colours already
        table = _value_colors(*array.GetRange(0))
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        if not wanted or len(self.surfaces) == 0:
            self._add_scalar_bar(table, name)
        others = [n for n in value_arrays(surface) if n != name]
        if others and not wanted:
            print(f"coloured by {name}; --scalars for {', '.join(others)}", flush=True)

    def _add_scalar_bar(self, table, name):
        bar = vtkScalarBarActor()
        bar.SetLookupTable(table)
        bar.SetTitle(name)
        bar.SetNumberOfLabels(4)
        bar.SetLabelFormat("%.3g")
        bar.UnconstrainedFontSizeOn()
        bar.SetBarRatio(0.2)
        bar.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        width, height = (min(1.0, p / size) for p, size in zip((100, 280), self.options.size))
        bar.SetWidth(width)
        bar.SetHeight(min(height, 0.6))
        bar.SetPosition(1.0 - width, 0.05)
        for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
            text.SetColor(*TEXT)
            text.SetFontSize(15)
            text.ItalicOff()
            text.BoldOff()
            text.ShadowOff()
        self.renderer.AddActor2D(bar)

    def open(self):
        """Makes window, camera and interaction."""
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(self.options.offscreen)
        self.window.SetSize(*self.options.size)
        self.window.SetMultiSamples(8)
        names = ", ".join(os.path.basename(path) for path in self.options.surfaces)
        self.window.SetWindowName(f"{names} - VTK Haptics - ? lists the keys")
        self.window.AddRenderer(self.renderer)
        points = np.concatenate([vtk_to_numpy(s.GetPoints().GetData()) for s in self.surfaces])
        width, height = self.options.size
        fill_view(
            self.renderer.GetActiveCamera(),
            points[np.isfinite(points).all(axis=1)].astype(float),
            out=(0.45, -0.75, 0.5),
            up=(0.0, 0.0, 1.0),
            aspect=width / height,
            margin=1.3,
        )
        self.hand = self.scene.GetGodObjectActor()
        self.hand.ShowTrailOn()
        self.renderer.AddViewProp(self.hand)
        self.renderer.AddViewProp(self.scene.GetOverlay())
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.style = vtkInteractorStyleHaptic()
        self.style.SetScene(self.scene)
        self.interactor.SetInteractorStyle(self.style)
        self.interactor.Initialize()
        self.window.Render()

    def connect(self):
        """Gives the scene its device. Raises ViewerError, StrokeError."""
        name = self.options.device
        camera = self.renderer.GetActiveCamera()
        if name == "mouse":
            self.device = vtkMouseHapticDevice()
            self.device.SetInteractor(self.interactor)
            self.device.SetScene(self.scene)
        elif name == "falcon":
            if not hasattr(vtkhaptics, "vtkFalconHapticDevice"):
                raise ViewerError("this build has no driver for the Falcon. Build it with libusb.")
            self.device = vtkhaptics.vtkFalconHapticDevice()
        else:
            self.device = vtkSimulatedHapticDevice()
        self.scene.SetDevice(self.device)
        if name == "simulated":
            plan = plan_stroke(self.surfaces[0], self.options.seconds)
            self._follow(plan.at_depth(0.011)[0])
            self.device.LoopOn()
        elif name in ("mouse", "falcon"):
            if not self.scene.FitWorkspace(camera):
                raise ViewerError(self.scene.GetErrorMessage())
        else:
            self._follow(_read_recording(name))

    def _follow(self, path):
        if not self.scene.FitWorkspace(path.GetBounds(), self.renderer.GetActiveCamera()):
            raise ViewerError(self.scene.GetErrorMessage())
        self.device.SetPath(in_device_frame(path, self.scene.GetWorkspaceTransform()))
        self.device.SetMotionToPolyline()

    def run(self):
        """Touches until the window is closed, or off screen for a while in virtual time."""
        self.scene.StartRecording()
        if self.options.offscreen:
            self._step()
            self._finish()
            return
        if not self.scene.Engage():
            raise ViewerError(self.scene.GetErrorMessage())
        self.error = None
        self.interactor.AddObserver("ExitEvent", self._on_exit, 10.0)  # before the style lets go
        self.interactor.Start()
        self.scene.Release()  # where a script has ended the loop, nobody has asked for it
        if self.error:
            raise self.error

    def _on_exit(self, _caller, _event):
        try:
            self._finish()
        except OutputError as error:  # raised after the event loop: VTK would only print it here
            self.error = error

    def _step(self):
        frames = int(60 * self.options.seconds)
        if self.options.device == "mouse":
            width, height = self.window.GetSize()
            self.scene.Step(1)
            self.device.MoveTo(width // 2, height // 2)
            self.scene.Step(300)
            self.device.SetPressed(True)
        for frame in range(frames):
            if self.options.device == "mouse":
                share = frame / frames
                self.device.MoveTo(int(width * (0.5 + 0.08 * share)), int(height * (0.5 + 0.05 * share)))
            if self.scene.Step(16) < 16:
                raise ViewerError(self.scene.GetErrorMessage())
        if self.options.device == "simulated":
            # The loop's end is in the open: show the hand at work.
            while not self.scene.GetTouching() and self.scene.Step(16) == 16 and frames < 120 * 600:
                frames += 1

    def _finish(self):
        self.scene.StopRecording()
        if self.options.screenshot:
            self.renderer.ResetCameraClippingRange()
            self.hand.IncludeInClippingRange(self.renderer)
            save_window(self.window, self.options.screenshot, scale=1)
            print(f"picture: {self.options.screenshot}")
        if self.options.trace:
            writer = vtkXMLPolyDataWriter()
            writer.SetDataModeToBinary()  # see surfaces.py: not every VTK reads appended data
            write_atomically(self.options.trace, self.scene.GetTrace(), writer)
            print(f"trace:   {self.options.trace}")


def _value_colors(low, high):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetTableRange(low, high if high > low else low + 1.0)
    table.SetNanColor(0.6, 0.6, 0.6, 1.0)
    table.Build()
    for i in range(256):
        x = i / 255.0 * (len(VALUE_COLORS) - 1)
        k = min(int(x), len(VALUE_COLORS) - 2)
        below, above = VALUE_COLORS[k], VALUE_COLORS[k + 1]
        table.SetTableValue(i, *(a + (x - k) * (b - a) for a, b in zip(below, above)), 1.0)
    return table


def _read_recording(path):
    """The path of the hand in a trace, world frame, with its array Time [s]. Raises ViewerError."""
    what = f"{path}: neither a device (mouse, simulated, falcon) nor a recording"
    if not os.path.isfile(path):
        raise ViewerError(f"{what}: there is no such file.")
    if not path.lower().endswith(".vtp"):
        raise ViewerError(f"{what}: it does not end in .vtp. Give a file that --trace wrote.")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    messages = []
    reader.AddObserver("ErrorEvent", lambda *_: messages.append(True))
    reader.Update()
    trace = reader.GetOutput()
    hip, time = (trace.GetPointData().GetArray(name) for name in ("HapticInterfacePoint", "Time"))
    if messages or not hip or not time or hip.GetNumberOfTuples() < 2:
        raise ViewerError(
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


def run(options):
    """Shows and touches the surfaces as the options say."""
    viewer = Viewer(options)
    viewer.add_surfaces()
    viewer.open()
    viewer.connect()
    viewer.run()


def main(arguments=None):
    """What the command line does; returns the exit status."""
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    options = parse(arguments)
    if not options.offscreen and not os.environ.get("DISPLAY") and sys.platform.startswith("linux"):
        print(
            "vtkhaptics: there is no display (DISPLAY is not set). Run it from a desktop, or with "
            "--offscreen --screenshot FILE for a picture.",
            file=sys.stderr,
        )
        return EXIT_DISPLAY
    try:
        ensure_display("vtkhaptics", arguments)
        run(options)
    except DisplayError as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_DISPLAY
    except SurfaceError as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (OutputError, StrokeError, ViewerError) as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_FAILED
    return EXIT_DONE
