"""Touches a surface from a file for some seconds and shows the trace.

The simulated device strokes the surface through the real servo thread, at 1000 ticks a second in
real time. See --help.
"""

import os
import sys
import time

from .interrupt import ENDS, Interrupts, held_back

with held_back():
    import numpy as np
    from vtkmodules.util.misc import calldata_type
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.util.vtkConstants import VTK_INT
    from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor

    from . import vtkGodObjectActor, vtkHapticScene, vtkInteractorStyleHaptic, vtkSimulatedHapticDevice
    from .arguments import add_seconds, check_seconds, make_parser
    from .display import DisplayError, ensure_display
    from .errors import HapticsError
    from .output import OutputError, check_outputs, write_polydata
    from .picture import Picture, add_hand, stroke_lines
    from .printing import printing
    from .stroke import StrokeError, in_device_frame, plan_stroke
    from .surfaces import READERS, SurfaceError, read_surface

DEPTH_SHARES = (0.022, 0.011, 0.005, 0.002)  # of half the diagonal of the surface's bounds
EXIT_DONE, EXIT_FAILED, EXIT_INPUT, EXIT_DISPLAY = 0, 1, 2, 3

EPILOG = """examples:
  python3 -m vtkhaptics.demo --surface gearbox.stl --output touched
  python3 -m vtkhaptics.demo --surface skull.vtp --output touched --offscreen --seconds 30

what it leaves in the output folder:
  touched.png   the surface, the stroke coloured by force, and the hand at one moment:
                god-object (coloured by the force), device (blue), force (red arrow)
  trace.vtp     the path of the god-object, one point a tick, with the arrays Time [s],
                HapticInterfacePoint, Force [N], ActiveConstraints, Surface, OriginalCellId,
                Penetration

exit status:
  0 done; 1 the device or servo failed, less than half of the ticks touched, or a file could not
  be written; 2 wrong arguments or a surface that cannot be read; 3 no display to draw with;
  130, 143, 129 ended by Ctrl-C (SIGINT), SIGTERM or SIGHUP, with the results until then, where the
  stroke had begun

where nobody reads what is printed (`| head -1`), the rest is dropped, and nothing else changes; a full disk
behind it gives 1, with all files written
"""


class DemoError(Exception):
    """The message says what went wrong and what to do."""


def parse(arguments):
    """The options of a command line; exits with 2 where they are wrong."""
    parser = make_parser(
        "vtkhaptics.demo",
        description="Strokes a surface with a simulated haptic device in real time, draws the trace and prints how "
        "regular the servo was.",
        epilog=EPILOG,
    )
    parser.add_argument(
        "--surface",
        required=True,
        metavar="FILE",
        help="what to touch: " + ", ".join(sorted(READERS)),
    )
    parser.add_argument(
        "--output", required=True, metavar="DIR", help="folder for the results, made if missing"
    )
    add_seconds(parser, 10.0, "how long to stroke")
    parser.add_argument(
        "--offscreen", action="store_true", help="open no window, even where there is a display"
    )
    parser.add_argument(
        "--stay", action="store_true", help="leave the window open at the end, until it is closed"
    )
    options = parser.parse_args(arguments)
    check_seconds(parser, options)
    return options


def make_scene(surface, picture, path, depth):
    """A scene over the surface with a device that follows the path, workspace fitted to it."""
    device = vtkSimulatedHapticDevice()
    scene = vtkHapticScene()
    scene.AddSurface(surface)
    scene.SetDevice(device)
    if not scene.FitWorkspace(path.GetBounds(), picture.renderer.GetActiveCamera()):
        raise DemoError(scene.GetErrorMessage())

    to_world = scene.GetWorkspaceTransform()
    device.SetPath(in_device_frame(path, to_world))
    device.SetMotionToPolyline()

    # About 1.2 N where the surface lies flat under the hand.
    scale = to_world.Determinant() ** (1.0 / 3.0)
    stiffness = 1.2 / (depth / scale)
    scene.SetStiffness(min(max(stiffness, 50.0), device.GetMaximumStiffness()))
    return scene


def rehearse(surface, picture, plan):
    """A scene whose hand presses as deep as the surface can be followed: tried in virtual time.

    On rugged ground a hand that presses deep drags the god-object from one valley to the next.
    """
    best, best_share = None, -1.0
    for depth_share in DEPTH_SHARES:
        path, depth = plan.at_depth(depth_share)
        scene = make_scene(surface, picture, path, depth)
        scene.StartRecording()
        scene.Step(int(1000 * plan.seconds))
        scene.StopRecording()
        data = scene.GetTrace().GetPointData()
        touching = vtk_to_numpy(data.GetArray("ActiveConstraints")) > 0
        followed = vtk_to_numpy(data.GetArray("Penetration")) < 4.0 * depth
        share = float((touching & followed).mean()) if len(touching) else 0.0
        if share > best_share:
            best, best_share = scene, share
        if share > 0.85:
            break
    return best


def touch(scene, picture, options, window, interrupts, write):
    """Engages the scene for some seconds; with a window, shows it live meanwhile.

    `write` is called when they are over, or the window is closed before; a window that is to stay
    does so after that. Raises what `write` does, and KeyboardInterrupt."""
    seconds = options.seconds
    scene.StartRecording()
    if window:
        style = vtkInteractorStyleHaptic()
        style.SetScene(scene)
        hand = style.GetView().GetGodObjectActor()
        picture.renderer.AddViewProp(hand)
        hand.ShowTrailOn()
        interactor = vtkRenderWindowInteractor()
        interactor.SetRenderWindow(picture.window)
        interactor.SetInteractorStyle(style)
        interactor.Initialize()
        picture.window.Render()
    if not scene.Engage():
        raise DemoError(scene.GetErrorMessage())
    print(f"touching for {seconds:g} s ...", flush=True)
    outcome = []

    def conclude(over):
        if not outcome:
            finish(scene)
            try:
                outcome.append(None)
                outcome[0] = write(over)
            except Exception as error:  # raised after the event loop: VTK would only print it here
                outcome[0] = error

    if window:
        end = interactor.CreateOneShotTimer(int(1000 * seconds))

        @calldata_type(VTK_INT)
        def on_timer(_caller, _event, timer):
            if timer != end:  # the style has timers as well
                return
            conclude(over=True)
            if not options.stay or outcome[0]:
                interactor.ExitCallback()

        interactor.AddObserver("TimerEvent", on_timer)
    try:
        if window:
            interrupts.run(interactor)
        else:
            end = time.monotonic() + seconds
            while time.monotonic() < end and scene.IsEngaged():
                scene.Update()
                time.sleep(1.0 / 60.0)
    finally:
        conclude(over=not window)
    if outcome[0]:
        raise outcome[0]


def finish(scene):
    """Lets go of the surface and ends the recording."""
    if scene.IsEngaged():
        scene.Release()
        scene.Update()
    scene.StopRecording()


def table(scene, trace):
    """Rows of what was measured, the share of ticks in contact, and the largest force [N]."""
    servo = scene.GetServo()
    readings = servo.GetReadings()
    data = trace.GetPointData()
    contact = float((vtk_to_numpy(data.GetArray("ActiveConstraints")) > 0).mean())
    force = np.linalg.norm(vtk_to_numpy(data.GetArray("Force")), axis=1)
    rows = [
        ("ticks", f"{servo.GetNumberOfTicks()}"),
        ("ticks in the trace", f"{trace.GetNumberOfPoints()}"),
        ("in contact", f"{100.0 * contact:.1f} %"),
        ("rate", f"{readings.GetMeasuredRate():.1f} Hz"),
        ("E[T^2]/E[T]", f"{1e3 * readings.GetPeriodRatio():.4f} ms"),
        ("T_max", f"{1e3 * readings.GetMaximumPeriod():.3f} ms"),
        ("missed ticks", f"{readings.GetNumberOfMissedTicks()}"),
        ("tick time, median", f"{1e6 * readings.GetTickTimeQuantile(0.5):.1f} us"),
        ("tick time, p99.9", f"{1e6 * readings.GetTickTimeQuantile(0.999):.1f} us"),
        ("largest force", f"{force.max():.2f} N"),
        ("stiffness", f"{scene.GetStiffness():.0f} N/m"),
    ]
    return rows, contact, force.max()


def run(options, interrupts):
    """Touches a surface as the options say."""
    surface = read_surface(options.surface)
    try:
        os.makedirs(options.output, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"{options.output}: cannot be made a folder ({error.strerror}). Choose another."
        ) from error
    check_outputs(output_files(options), [options.surface])
    name = os.path.basename(options.surface)
    print(f"surface: {name}, {surface.GetNumberOfCells()} cells", flush=True)

    plan = plan_stroke(surface, options.seconds)
    window = not options.offscreen and bool(os.environ.get("DISPLAY"))
    picture = Picture(surface, plan.view, name, offscreen=not window)
    scene = rehearse(surface, picture, plan)

    def write(over):
        # Not into the window, which may be closed by now.
        drawn = Picture(surface, plan.view, name, offscreen=True) if window else picture
        contact = report(options, scene, drawn, over)
        if over and contact <= 0.5:
            raise DemoError(
                f"only {100.0 * contact:.0f} % of the ticks touched the surface; "
                "it may be too rugged for the planned stroke."
            )

    touch(scene, picture, options, window, interrupts, write)


def output_files(options):
    """The files that trace and picture are written to."""
    return [os.path.join(options.output, name) for name in ("trace.vtp", "touched.png")]


def report(options, scene, picture, over):
    """Prints the table and writes trace and picture, in haste where the stroke is not over; the share
    of ticks in contact."""
    trace = scene.GetTrace()
    if trace.GetNumberOfPoints() == 0:
        raise DemoError("the servo did not tick: " + (scene.GetErrorMessage() or "no cause given"))
    rows, contact, strongest = table(scene, trace)
    width = max(len(label) for label, _ in rows)
    for label, value in rows:
        print(f"  {label:<{width}}  {value}")
    note = scene.GetServo().GetPriorityNote()
    if note:
        print("  note: " + note)

    trace_file, picture_file = output_files(options)
    write_polydata(trace_file, trace, [options.surface])
    stroke = stroke_lines(trace, picture.world_size(0.001))
    picture.add_stroke(stroke, picture.world_size(0.0035), strongest)
    add_hand(picture, vtkGodObjectActor(), trace)
    # Who closes the window does not wait for the finest edges.
    picture.save(picture_file, [options.surface], scale=2 if over else 1)
    print(f"picture: {picture_file}\ntrace:   {trace_file}", flush=True)
    return contact


@printing("demo")
def main(arguments=None):
    """What the command line does; returns the exit status."""
    options = parse(arguments)
    interrupts = Interrupts(ENDS)
    try:
        ensure_display("vtkhaptics.demo", ["--offscreen", *(arguments or sys.argv[1:])])
    except DisplayError as error:
        print(f"demo: {error}", file=sys.stderr)
        return EXIT_DISPLAY
    try:
        with interrupts:
            run(options, interrupts)
    except SurfaceError as error:
        print(f"demo: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (DemoError, HapticsError, OutputError, StrokeError) as error:
        print(f"demo: {error}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt:
        return interrupts.exit_status()
    return EXIT_DONE


if __name__ == "__main__":
    sys.exit(main())
