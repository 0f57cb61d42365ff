"""Measures what touching in patches costs over a pvserver, against whole delivery.

usage: pvpython --force-offscreen-rendering patches.py [--triangles 1e6] [--ranks 2] [--delays 0,0.02]
           [--speeds 0.1,0.3,1] [--seconds 5] [--radius 0.005] [--questions] [--whole] [--plugin FILE]

A ball 0.1 m across, spread over the ranks, is stroked in real time, 1 mm deep, at each speed and with
each delay (how long a message takes each way [s]; late_relay.py stands between client and server). One
line of CSV each: see COLUMNS. --questions asks for patches of --radius only, and nobody strokes. Further lines, of virtual time, compare the trace with that of whole
delivery where --whole is given. The load of the machine is part of each line: times count as much as it
is low.
"""

import argparse
import csv
import os
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
BALL = 0.05  # [m]
DEPTH = 0.001  # [m]
LOOK = 0.016  # [s]

COLUMNS = (
    "triangles", "ranks", "mode", "delay [s]", "speed [m/s]", "radius [m]",
    "touch [s]",  # from Touch until the surface can be touched
    "client before [MB]", "client peak [MB]", "server peak [MB]",
    "patches", "period [s]", "patch [triangles]", "bytes a second", "bytes a triangle",
    "answer [s]", "longest [s]",  # the GUI thread waits so long for a patch: median, most
    "GUI waiting [%]",  # of the time
    "ticks", "ticks touching", "looks waiting [%]", "largest step [N]", "difference [1]", "load",
)


def megabytes(pid, key):
    with open(f"/proc/{pid}/status") as status:
        for line in status:
            if line.startswith(key):
                return int(line.split()[1]) / 1024.0
    return 0.0


def descendants(pid):
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat") as stat:
                    parent = int(stat.read().rsplit(")", 1)[1].split()[1])
            except OSError:
                continue
            if parent == pid:
                found += [int(entry), *descendants(int(entry))]
    return found


def stroke(file, speed, seconds, np, write_points):
    """Down onto the ball in half a second, then to and fro along a quarter of its equator."""
    times = np.arange(0.0, seconds, 0.002)
    down = np.clip(times / 0.5, 0.0, 1.0)
    radius = BALL + 0.005 - (0.005 + DEPTH) * down * down * (3.0 - 2.0 * down)
    way = 0.25 * np.pi * BALL
    angle = 0.25 * np.pi * np.sin(speed / way * np.maximum(0.0, times - 0.5))
    write_points(file, np.array([radius * np.cos(angle), radius * np.sin(angle),
                                 0.01 * radius * np.sin(3.0 * times)]).T, times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--triangles", type=float, default=1e6)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--delays", default="0")
    parser.add_argument("--speeds", default="0.1,0.3,1")
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--radius", type=float, default=0.005)
    parser.add_argument("--questions", action="store_true")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--plugin", default=os.path.join(
        os.environ.get("PV_PLUGIN_PATH", "").split(os.pathsep)[0], "Haptics.so"))
    options = parser.parse_args()
    sys.path.insert(0, os.path.join(HERE, "..", "ParaView"))
    sys.argv = [sys.argv[0], options.plugin, os.path.join("/usr/bin", "pvpython")]
    import numpy as np
    from HapticSceneTesting import haptics, look_at, trace_arrays, write_points
    from HapticServerTesting import Server
    from paraview import simple

    resolution = int(round((0.5 * options.triangles) ** 0.5))
    folder = tempfile.mkdtemp()
    lines = csv.writer(sys.stdout)
    lines.writerow(COLUMNS)

    def touch(mode, path):
        view = simple.CreateView("RenderView")
        view.ViewSize = [200, 150]
        view.RemoteRenderThreshold = 0.0  # the picture stays on the server
        hand = haptics.scene()
        hand.set(Device=path, Stiffness=500.0, RecordTrace=0)
        display = simple.Show(ball, view)
        display.PatchThreshold = 0 if mode == "patches" else 2 * 10**9
        display.PatchRadius = options.radius
        look_at(view)
        start = time.monotonic()
        hand.touch(ball, view)
        hand.WorkspaceTransform = np.eye(4).ravel().tolist()
        hand.update()
        while hand.NumberOfTouchableSurfaces < 1:
            time.sleep(0.002)
            hand.update()
        return hand, view, time.monotonic() - start

    def patches_of(hand):
        scene = hand.vtk
        mapper = scene.GetSurfaceActor(scene.GetSurfaces().GetId(0)).GetMapper()
        algorithm = mapper.GetInputConnection(0, 0).GetProducer()
        return algorithm if algorithm.IsA("vtkPVHapticPatchSource") else None

    def measure(mode, delay, speed, server):
        path = os.path.join(folder, f"{speed}.vtp")
        stroke(path, speed, options.seconds + 60.0, np, write_points)
        before = megabytes(os.getpid(), "VmRSS")
        with open("/proc/self/clear_refs", "w") as clear:
            clear.write("5")  # the peak counts from here on
        hand, view, seconds = touch(mode, path)
        patches = patches_of(hand)
        first = (patches.GetNumberOfPatches(), patches.GetNumberOfBytes()) if patches else (0, 0)
        hand.RecordTrace = 1
        hand.engage()
        readings = hand.vtk.GetServo().GetReadings()
        end = time.monotonic() + options.seconds
        sizes, waits, answers = [], [], []
        while time.monotonic() < end:
            before_look, asked = time.monotonic(), patches.GetNumberOfPatches() if patches else 0
            hand.update()
            if patches and patches.GetNumberOfPatches() > asked:
                answers.append(time.monotonic() - before_look)
            sizes.append(patches.GetOutput().GetNumberOfPolys() if patches else 0)
            waits.append("waiting for data" in readings.DescribeForceLimits())
            time.sleep(LOOK)
        found = trace_arrays(hand)
        hand.release()
        force = np.linalg.norm(found["Force"], axis=1)
        count = patches.GetNumberOfPatches() - first[0] if patches else 0
        sent = patches.GetNumberOfBytes() - first[1] if patches else 0
        peak = sum(megabytes(pid, "VmHWM") for pid in descendants(server.process.pid))
        size = np.mean(sizes)
        lines.writerow([int(options.triangles), options.ranks, mode, delay, speed, options.radius,
                        f"{seconds:.2f}", f"{before:.0f}", f"{megabytes(os.getpid(), 'VmHWM'):.0f}",
                        f"{peak:.0f}", count, f"{options.seconds / max(count, 1):.3f}", f"{size:.0f}",
                        f"{sent / options.seconds:.0f}", f"{sent / max(1.0, count * size):.0f}",
                        f"{np.median(answers or [0.0]):.4f}", f"{max(answers or [0.0]):.4f}",
                        f"{100.0 * sum(answers) / options.seconds:.1f}", len(force),
                        int((found["ActiveConstraints"] > 0).sum()), f"{100.0 * np.mean(waits):.1f}",
                        f"{np.abs(np.diff(force)).max():.4f}", "", f"{os.getloadavg()[0]:.1f}"])
        sys.stdout.flush()
        simple.Delete(view)

    def ask(delay):
        """How long a caller waits for a patch, wherever on the ball that is."""
        path = os.path.join(folder, "asked.vtp")
        stroke(path, 0.1, 1.0, np, write_points)
        hand, view, seconds = touch("patches", path)
        patches = patches_of(hand)
        first = patches.GetNumberOfPatches(), patches.GetNumberOfBytes()
        answers, sizes = [], []
        for angle in np.linspace(0.3, 2.8, 20):
            place = [BALL * np.cos(angle), 0.0, BALL * np.sin(angle)]
            patches.SetRegion(place, place, options.radius)
            start = time.monotonic()
            patches.Update()
            answers.append(time.monotonic() - start)
            sizes.append(patches.GetOutput().GetNumberOfPolys())
        count = patches.GetNumberOfPatches() - first[0]
        sent = patches.GetNumberOfBytes() - first[1]
        lines.writerow([int(options.triangles), options.ranks, "questions", delay, "", options.radius,
                        f"{seconds:.2f}", "", f"{megabytes(os.getpid(), 'VmHWM'):.0f}", "", count, "",
                        f"{np.mean(sizes):.0f}", "", f"{sent / max(1, sum(sizes)):.0f}",
                        f"{np.median(answers):.4f}", f"{max(answers):.4f}", *[""] * 6,
                        f"{os.getloadavg()[0]:.1f}"])
        sys.stdout.flush()
        simple.Delete(view)

    def compare(server):
        path = os.path.join(folder, "compared.vtp")
        stroke(path, 0.1, 10.0, np, write_points)
        traces = []
        for mode in ("whole", "patches"):
            hand, view, _ = touch(mode, path)
            hand.RecordTrace = 1
            hand.step(4000)
            traces.append(trace_arrays(hand))
            simple.Delete(view)
        places = [trace["GodObject"] for trace in traces]
        difference = np.abs(places[1] - places[0]).max() / BALL
        lines.writerow([int(options.triangles), options.ranks, "compared", 0, 0.1, options.radius, *[""] * 12,
                        4000, int((traces[0]["ActiveConstraints"] > 0).sum()), "", "",
                        f"{difference:.3g}", f"{os.getloadavg()[0]:.1f}"])
        sys.stdout.flush()

    for delay in map(float, options.delays.split(",")):
        server = Server(options.ranks, delay)
        try:
            ball = simple.Sphere(Radius=BALL, ThetaResolution=resolution, PhiResolution=resolution)
            ball.UpdatePipeline()
            if options.questions:
                ask(delay)
                continue
            for speed in map(float, options.speeds.split(",")):
                measure("patches", delay, speed, server)
            if options.whole:
                measure("whole", delay, 0.1, server)
                compare(server)
        finally:
            simple.Disconnect()
            server.stop()


main()
