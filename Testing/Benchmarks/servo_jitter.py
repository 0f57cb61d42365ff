"""How regular the servo is: idle, while a picture is drawn, and on a busy machine; with and without
real-time priority.

    . build/env.sh
    python3 Testing/Benchmarks/servo_jitter.py [--seconds 10] [--csv FILE]

Prints one line a case. "busy": two more processes than there are processors compute meanwhile. Where so
many deadlines are missed that the safety ends the run, `stopped` is after how many seconds, and the
figures are of the time until then. Not a test: the figures are this machine's, and other programs' too. All
times in microseconds: PeriodRatio is E[T^2]/E[T], the T to design a stable stiffness with. Without a
display run it under xvfb-run; rendering then takes the processors that the servo wants as well,
which is the harder case.
"""

import argparse
import contextlib
import csv
import os
import subprocess
import sys
import time

from vtkhaptics import HapticsError, vtkHapticScene, vtkHapticView, vtkSimulatedHapticDevice
from vtkhaptics.output import whole_file
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
)

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  the back end that draws

COLUMNS = (
    "load", "real_time", "ticks", "missed", "halts", "mean", "period_ratio", "p99", "p99.9",
    "maximum", "tick_p50", "tick_p99.9", "frames", "stopped",
)


def make_scene(triangles):
    """A sphere of 30 mm under a hand that strokes it, and the window that shows it."""
    sphere = vtkSphereSource()
    sphere.SetRadius(0.03)
    sphere.SetThetaResolution(triangles // 1000)
    sphere.SetPhiResolution(501)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(sphere.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)

    device = vtkSimulatedHapticDevice()
    device.SetPreset(device.Touch)
    device.SetMotionToStroke()
    device.SetStrokeBounds(-0.02, 0.02, -0.02, 0.02, 0.02, 0.03)
    device.SetPressDepth(0.008)
    device.LoopOn()

    scene = vtkHapticScene()
    scene.SetDevice(device)
    scene.AddSurface(actor)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    view = vtkHapticView()
    view.SetScene(scene)
    renderer.AddActor(view.GetGodObjectActor())
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(1280, 960)
    window.AddRenderer(renderer)
    window.Render()
    return scene, window, renderer


@contextlib.contextmanager
def busy_processes(count):
    """So many processes that do nothing but compute."""
    processes = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()


@contextlib.contextmanager
def overruns_allowed(servo):
    """Where the servo has stopped for missed deadlines, that is a result, and no error."""
    try:
        yield
    except HapticsError:
        if servo.GetState() != servo.Overrun:
            raise


def measure(scene, window, renderer, seconds, load, real_time):
    """Runs the servo for a while and returns a row of the table."""
    servo = scene.GetServo()
    servo.SetRealTimePriority(real_time)
    if not scene.Engage():
        sys.exit(f"The servo did not start: {scene.GetErrorMessage()}")
    note = servo.GetPriorityNote()
    frames = 0
    stopped = ""
    start = time.monotonic()
    with busy_processes(os.cpu_count() + 2 if load == "busy" else 0), overruns_allowed(servo):
        while time.monotonic() < start + seconds and scene.IsEngaged():
            scene.Update()
            if load == "rendering":
                renderer.GetActiveCamera().Azimuth(1.0)
                window.Render()
                frames += 1
            else:
                time.sleep(0.02)
    if not scene.IsEngaged():
        stopped = f"{time.monotonic() - start:.1f}"
    with overruns_allowed(servo):
        scene.Release()
    granted = real_time and "no real-time" not in note
    if real_time and not granted:
        print(note, file=sys.stderr)

    def micro(value):
        return f"{1e6 * value:.1f}"

    return (
        load,
        "yes" if granted else ("refused" if real_time else "no"),
        servo.GetNumberOfTicks(),
        servo.GetReadings().GetNumberOfMissedTicks(),
        servo.GetReadings().GetNumberOfHalts(),
        micro(servo.GetReadings().GetMeanPeriod()),
        micro(servo.GetReadings().GetPeriodRatio()),
        micro(servo.GetReadings().GetPeriodQuantile(0.99)),
        micro(servo.GetReadings().GetPeriodQuantile(0.999)),
        micro(servo.GetReadings().GetMaximumPeriod()),
        micro(servo.GetReadings().GetTickTimeQuantile(0.5)),
        micro(servo.GetReadings().GetTickTimeQuantile(0.999)),
        frames,
        stopped,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="of each of the six cases")
    parser.add_argument("--triangles", type=int, default=100000, help="of the sphere, about")
    parser.add_argument("--csv", help="a file to write the table to as well")
    options = parser.parse_args()
    if options.seconds <= 0 or options.triangles < 4000:
        parser.error("--seconds must be above 0 and --triangles at least 4000")

    scene, window, renderer = make_scene(options.triangles)
    rows = [
        measure(scene, window, renderer, options.seconds, load, real_time)
        for load in ("idle", "rendering", "busy")
        for real_time in (True, False)
    ]
    widths = [max(len(str(row[i])) for row in [COLUMNS, *rows]) for i in range(len(COLUMNS))]
    for row in [COLUMNS, *rows]:
        print("  ".join(str(value).rjust(width) for value, width in zip(row, widths)))
    if options.csv:
        with whole_file(options.csv, text=True) as file:
            csv.writer(file).writerows([COLUMNS, *rows])


if __name__ == "__main__":
    main()
