"""Touches surfaces from files: with the mouse, a simulated hand, a device or a recording.

See ``python3 -m vtkhaptics --help``.
"""

import contextlib
import os
import sys
import time

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers the text renderer)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import (
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
)

from . import (
    vtkHapticProperties,
    vtkHapticScene,
    vtkInteractorStyleHaptic,
)
from .arguments import parse
from .coloring import color_by, other_arrays, scalar_bar
from .detail import DetailSwitch
from .devices import create_device, known_devices, remember_device
from .display import DisplayError, ensure_display
from .errors import HapticsError
from .interrupt import ENDS, Interrupts, deferred
from .output import OutputError, check_outputs, write_polydata
from .picture import (
    BACKGROUND,
    add_lights,
    fill_view,
    save_window,
    smooth_edges,
    surface_actor,
    touched_actor,
)
from .printing import printing
from .progress import PATIENCE, ProgressBar
from .recording import RecordingError, read_recording
from .stroke import StrokeError, in_device_frame, plan_stroke
from .surfaces import SurfaceError, read_surface, unit_note, value_arrays
from .units import METRES, file_unit

EXIT_DONE, EXIT_FAILED, EXIT_INPUT, EXIT_DISPLAY = 0, 1, 2, 3
SET_SIDE = {"auto": "SetSideToAutomatic", "front": "SetSideToFront", "both": "SetSideToBoth"}
COLORS = ((0.74, 0.80, 0.86), (0.86, 0.78, 0.66), (0.70, 0.82, 0.72), (0.84, 0.72, 0.78))
STROKE_SPEED = 0.05  # [m/s], of a path without times
BUILD_FRAME = 0.05  # [s] between two looks at how far the surfaces are


class ViewerError(Exception):
    """The message says what went wrong and what to do."""


class Viewer:
    """A window over a haptic scene with the surfaces of some files."""

    def __init__(self, options, interrupts=None):
        """Reads the recording that is the device. Raises RecordingError."""
        self.options = options
        kind = options.device.partition(":")[0]
        is_device = any(kind == known for known, _ in known_devices())
        self.recording = None if is_device else read_recording(options.device)
        self.interrupts = interrupts or Interrupts()
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(*BACKGROUND[0])
        self.renderer.SetBackground2(*BACKGROUND[1])
        self.renderer.GradientBackgroundOn()
        add_lights(self.renderer)
        self.scene = vtkHapticScene()
        self.scene.SetStiffness(options.stiffness)
        self.scene.GetServo().SetSubstepLimit(options.substeps)
        self.scene.SetTipRadius(options.tip_radius)
        self.surfaces = []
        self.detail = DetailSwitch(self.renderer)

    def add_surfaces(self):
        """Reads the files and shows them. Raises SurfaceError."""
        for number, path in enumerate(self.options.surfaces):
            with ProgressBar(f"reading {os.path.basename(path)}") as bar:
                surface = read_surface(path, bar.show, self.options.contour)
            with ProgressBar(f"drawing {os.path.basename(path)}") as bar:
                actor = surface_actor(surface, COLORS[number % len(COLORS)], bar.show)
            self._color(actor, surface, path)
            self.detail.add(actor)
            self.renderer.AddActor(actor)
            self.surfaces.append(surface)
            self._touch(surface, actor, os.path.basename(path))
            print(unit_note(path, surface, self.options.unit), flush=True)
        units = {self.options.unit or file_unit(path) for path in self.options.surfaces}
        if units != {None} and len(units) == 1:  # files of several units are shown as they are
            self.scene.GetWorkspace().SetUnitLength(METRES[units.pop()])

    def _touch(self, surface, shown, name):
        """Adds a surface to the scene, with the ids of the file, under an actor that `shown` follows."""
        id_ = self.scene.AddSurface(touched_actor(surface, shown))
        self.scene.GetSurfaces().SetName(id_, name)
        getattr(self.scene.GetSurfaceFilter(id_), SET_SIDE[self.options.side])()
        material = self.scene.GetSurfaceProperties(id_)
        material.SetStaticFriction(self.options.friction)
        material.SetDynamicFriction(0.8 * self.options.friction)
        for property_, array in (
            (vtkHapticProperties.STIFFNESS, self.options.stiffness_array),
            (vtkHapticProperties.STATIC_FRICTION, self.options.friction_array),
            (vtkHapticProperties.DYNAMIC_FRICTION, self.options.friction_array),
        ):
            if array:
                self._take_array(id_, surface, name, property_, array)

    def _take_array(self, id_, surface, name, property_, array):
        for association, data in (
            (vtkDataObject.FIELD_ASSOCIATION_POINTS, surface.GetPointData()),
            (vtkDataObject.FIELD_ASSOCIATION_CELLS, surface.GetCellData()),
        ):
            if data.HasArray(array):
                self.scene.SetSurfacePropertyArray(id_, property_, association, array)
                return
        known = ", ".join(value_arrays(surface)) or "none"
        raise SurfaceError(f"{name}: has no array '{array}'. It has: {known}.")

    def _color(self, actor, surface, path):
        """Colours an actor by the array that the options ask for."""
        wanted = self.options.scalars
        if wanted == "none":
            return
        name, table = color_by(actor, surface, wanted)
        if not name:
            if wanted and not any(
                known.GetPointData().HasArray(wanted) or known.GetCellData().HasArray(wanted)
                for known in self.surfaces
            ):
                known = ", ".join(value_arrays(surface)) or "none"
                raise SurfaceError(
                    f"{path}: has no array '{wanted}' to colour by. It has: {known}."
                )
            return
        if not table:
            return  # colours already
        if not wanted or not self.surfaces:
            self.renderer.AddViewProp(scalar_bar(table, name, self.options.size))
        others = other_arrays(surface, name)
        if others and not wanted:
            print(f"coloured by {name}; --scalars for {', '.join(others)}", flush=True)

    def open(self):
        """Makes window, camera and interaction."""
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(self.options.offscreen)
        self.window.SetSize(*self.options.size)
        smooth_edges(self.renderer, self.window)
        names = ", ".join(os.path.basename(path) for path in self.options.surfaces)
        self.window.SetWindowName(f"{names} - VTK Haptics - ? lists the keys")
        self.window.AddRenderer(self.renderer)
        points = np.concatenate([vtk_to_numpy(s.GetPoints().GetData()) for s in self.surfaces])
        width, height = self.options.size
        try:
            fill_view(
                self.renderer.GetActiveCamera(),
                points,
                out=(0.45, -0.75, 0.5),
                up=(0.0, 0.0, 1.0),
                aspect=width / height,
                margin=1.3,
            )
        except SurfaceError as error:
            raise SurfaceError(f"{', '.join(self.options.surfaces)}: {error}") from error
        self.style = vtkInteractorStyleHaptic()
        self.style.SetScene(self.scene)
        self.hand = self.style.GetView().GetGodObjectActor()
        self.hand.ShowTrailOn()
        self.renderer.AddViewProp(self.hand)
        self.renderer.AddViewProp(self.style.GetView().GetOverlay())
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.Initialize()
        self.renderer.ResetCameraClippingRange()
        self.detail.watch(self.window)
        self._render()
        self.detail.set_live(not self.options.offscreen)

    def _render(self):
        with deferred():  # DetailSwitch observes the window
            self.window.Render()

    def _process_events(self):
        with deferred():
            self.interactor.ProcessEvents()

    def build(self):
        """Makes the surfaces touchable, in the background; the camera can be moved meanwhile.

        False where the window was closed before they were. Raises SurfaceError.
        """
        closed, errors = [], []
        observers = [
            (self.interactor, self.interactor.AddObserver("ExitEvent", lambda *_: closed.append(1))),
            (self.scene, self.scene.AddObserver(
                self.scene.SurfaceErrorEvent, lambda *_: errors.append(self.scene.GetErrorMessage()))),
            # Observed, so that VTK does not print it as well.
            (self.scene, self.scene.AddObserver("ErrorEvent", lambda *_: None)),
        ]
        self.scene.GetSurfaces().BackgroundBuildingOn()
        self._update()
        with ProgressBar("building") as bar, self._build_label() as label:
            while self.scene.GetSurfaces().IsBuilding() and not closed:
                bar.show(self.scene.GetSurfaces().GetBuildProgress())
                label(self.scene.GetSurfaces().GetBuildProgress())
                self._refine()
                if not self.options.offscreen:
                    self._process_events()
                time.sleep(BUILD_FRAME)
                self._update()
        for caller, observer in observers:
            caller.RemoveObserver(observer)
        if closed:
            self.scene.GetSurfaces().CancelBuild()
            return False
        for number, path in enumerate(self.options.surfaces):
            id_ = self.scene.GetSurfaces().GetId(number)
            if not self.scene.GetSurfaces().IsTouchable(id_):
                mine = [text for text in errors if text.startswith(f"Surface {id_} (")]
                raise SurfaceError(f"{path}: {(mine or errors or ['cannot be touched.'])[0]}")
        self.interactor.SetInteractorStyle(self.style)
        return True

    def _update(self):
        """Updates the scene; SurfaceErrorEvent says what is wrong with a surface."""
        with contextlib.suppress(HapticsError):
            self.scene.Update()

    @contextlib.contextmanager
    def _build_label(self):
        """Shows in the window the progress of the builds, where they take long enough to read it."""
        overlay = self.style.GetView().GetOverlay()
        began = time.monotonic()

        def show(share):
            filled = int(20 * share)
            words = f"preparing the surfaces  [{'#' * filled}{'.' * (20 - filled)}]  {100 * share:.0f} %"
            if time.monotonic() - began > PATIENCE and words != overlay.GetStatus():
                overlay.SetStatus(words)
                self.renderer.ResetCameraClippingRange()
                self._render()

        try:
            yield show
        finally:
            overlay.SetStatus("")

    def connect(self):
        """Gives the scene its device. Raises ViewerError, StrokeError."""
        name = self.options.device
        if self.recording:
            self._connect(create_device("simulated"))
            self._follow(self.recording)
            return
        self._connect(create_device(name))  # raises HapticsError
        if self.device.NeedsPath():
            plan = plan_stroke(self.surfaces[0], self.options.seconds)
            self._follow(plan.at_depth(0.011)[0], loops=True)
            return
        try:
            self._wait_for_device()
        except (HapticsError, ViewerError) as error:
            if not self.options.is_remembered or name == "mouse":
                raise
            why = getattr(error, "text", "") or error
            print(f"{name}, the device of the last time: {why} The mouse is the hand.", flush=True)
            self._connect(create_device("mouse"))
            self._wait_for_device()
        else:
            if not self.options.offscreen:
                remember_device(name)
            if not self.device.GivesForce() and not self.device.UsesView():
                print(f"{name} moves the hand and cannot push back; the force is shown.", flush=True)
        if not self.scene.FitWorkspace(self.renderer.GetActiveCamera()):
            raise ViewerError(self.scene.GetErrorMessage())

    def _connect(self, device):
        """Takes a device, with what of the options is for it."""
        self.device = device
        if device.UsesView():
            device.SetInteractor(self.interactor)
            device.SetScene(self.scene)
        if self.options.firmware and hasattr(device, "SetFirmwareFile"):
            device.SetFirmwareFile(self.options.firmware)
        if self.options.force_limit is not None:
            if hasattr(device, "SetForceLimit"):
                device.SetForceLimit(self.options.force_limit)
            self.scene.GetServo().SetMaximumForce(self.options.force_limit)
        self.scene.SetDevice(device)

    def _wait_for_device(self):
        """Opens the device and says what that waits for: a Falcon has to be homed by hand."""
        overlay, said = self.style.GetView().GetOverlay(), ""
        self.device.Open()
        while not self.device.IsOpen():
            if self.device.GetState() in (self.device.Faulted, self.device.Closed):
                raise ViewerError(self.device.GetErrorMessage() or "the device does not open.")
            if self.device.GetStatusMessage() != said:
                said = self.device.GetStatusMessage()
                print(said, flush=True)
                overlay.SetStatus(said)
                self._render()
            if not self.options.offscreen:
                self._process_events()
                if self.interactor.GetDone():
                    raise KeyboardInterrupt
            time.sleep(BUILD_FRAME)
            self.device.Update()
        overlay.SetStatus("")

    def _follow(self, path, loops=False):
        if not self.scene.FitWorkspace(path.GetBounds(), self.renderer.GetActiveCamera()):
            raise ViewerError(self.scene.GetErrorMessage())
        scale = path.GetFieldData().GetArray("Scale")
        if scale:  # of a recording: the same forces again
            workspace = self.scene.GetWorkspace()
            workspace.Scale(scale.GetValue(0) / workspace.GetScale())
        path = in_device_frame(path, self.scene.GetWorkspaceTransform())
        self.device.FollowPath(path, STROKE_SPEED, loops)

    def run(self):
        """Touches until the window is closed, or off screen for a while in virtual time."""
        if self.options.trace:
            self.scene.GetTraceRecorder().AddObserver("WarningEvent", lambda *_: print(
                f"the trace is full, with {self.scene.GetTraceRecorder().GetMaximumTicks():,} ticks, and what "
                "comes now is not in it", flush=True))
            self.scene.StartRecording()
        if self.options.offscreen:
            try:
                has_touched = self._step()
            finally:  # by Ctrl-C, too
                with deferred():
                    self._finish()
            if self.options.device == "simulated" and not has_touched:
                raise ViewerError(
                    "the simulated hand met nothing on its way. Choose another surface, or another --device.")
            return
        if not self.scene.Engage():
            raise ViewerError(self.scene.GetErrorMessage())
        self.error, self.finished = None, False
        # Before the style's own, which it keeps to itself.
        self.interactor.AddObserver("TimerEvent", self._on_timer, 5.0)
        # Before the style ends the event loop, and with it the window that is to be drawn.
        self.interactor.AddObserver("ExitEvent", self._on_exit, 10.0)
        try:
            self.interrupts.run(self.interactor)
        finally:
            self.scene.Release()  # where a script has ended the loop, nobody has asked for it
        if self.error:
            raise self.error

    def _refine(self):
        """Draws a picture that rests in full."""
        if self.detail.rest():
            self._render()

    def _on_timer(self, _caller, _event):
        self._refine()

    def _on_exit(self, _caller, _event):
        if self.finished:
            return
        self.finished = True
        try:
            self._finish()
        except OutputError as error:  # raised after the event loop: VTK would only print it here
            self.error = error

    def _step(self):
        """Moves the hand in virtual time; whether it has touched. Raises ViewerError."""
        has_touched = False
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
            has_touched |= self.scene.GetTouching()
        if self.options.device == "simulated" and has_touched:
            # The loop's end is in the open: show the hand at work.
            while frames and not self.scene.GetTouching() and self.scene.Step(16) == 16:
                frames -= 1
        return has_touched

    def _finish(self):
        self.scene.StopRecording()
        self.detail.set_live(False)
        inputs = input_files(self.options)
        check_outputs(output_files(self.options), inputs)  # others may have moved files meanwhile
        if self.options.screenshot:
            self.renderer.ResetCameraClippingRange()
            self.hand.IncludeInClippingRange(self.renderer)
            save_window(self.window, self.options.screenshot, scale=1, inputs=inputs)
            print(f"picture: {self.options.screenshot}")
        if self.options.trace:
            write_polydata(self.options.trace, self.scene.GetTrace(), inputs)
            print(f"trace:   {self.options.trace}")
        if self.options.landmarks:
            self.scene.GetLandmarks().WriteCSV(self.options.landmarks)  # raises HapticsError
            print(f"landmarks: {self.options.landmarks}")


def input_files(options):
    """The files that are read."""
    files = [*options.surfaces, options.device, options.firmware]
    return [file for file in files if file and os.path.exists(file)]


def output_files(options):
    """The files that are asked for."""
    return [file for file in (options.screenshot, options.trace, options.landmarks) if file]


def run(options, interrupts):
    """Shows and touches the surfaces as the options say."""
    check_outputs(output_files(options), input_files(options))  # before a session would be lost
    viewer = Viewer(options, interrupts)
    viewer.add_surfaces()
    viewer.open()
    if viewer.build():
        viewer.connect()
        viewer.run()
    elif options.screenshot or options.trace or options.landmarks:
        raise ViewerError(
            "the window was closed before the surfaces were ready: no picture and no trace were "
            "written. Leave it open until they are."
        )


@printing("vtkhaptics")
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
    interrupts = Interrupts(ENDS)
    try:
        ensure_display("vtkhaptics", arguments)
        with interrupts:
            run(options, interrupts)
    except DisplayError as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_DISPLAY
    except (RecordingError, SurfaceError) as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (HapticsError, OutputError, StrokeError, ViewerError) as error:
        print(f"vtkhaptics: {error}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt:
        return interrupts.exit_status()
    return EXIT_DONE
