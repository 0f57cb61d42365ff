"""Measures what tracing over a scan in a file takes that is not in memory.

usage: python3 scan_on_disk.py FOLDER [--triangles 1e8] [--in-a-piece 1e5] [--ticks 4000] [--live 0.1,0.3]

Writes a height field in square pieces, FOLDER/scan.pvtp and a .vtp for each (51 bytes a triangle: see
that there is room; what is there is used again), and strokes over it in another process, 1 mm deep at
0.1 m/s. One line of CSV: see COLUMNS. The survey is the two passes over all pieces before the first
tick. --live strokes in real time instead, at these speeds [m/s], with pieces read by who updates the
scene and in the background, in turn: see LIVE_COLUMNS.
"""

import argparse
import csv
import os
import subprocess
import sys
import time

COLUMNS = ("triangles", "pieces", "file [MB]", "written [s]", "survey [s]", "trace [s]", "ticks",
           "touching", "reads of a piece", "libraries [MB]", "peak [MB]", "load")
LIVE_COLUMNS = ("triangles", "pieces", "speed [m/s]", "read in the background", "ticks", "ticks left behind [%]",
                "looks", "median look [ms]", "99 % [ms]", "longest look [ms]", "reads of a piece", "load")
SIZE = 1.0  # of the scan [m]
LOOK = 0.016  # between two looks [s]
SECONDS = 6.0  # of a stroke
LEFT_BEHIND = 0.003  # [m] from the HIP: thrice as far as where all is known


def height(x, y, np):
    return 0.01 * np.sin(9.0 * x) * np.cos(7.0 * y) + 0.0005 * np.sin(400.0 * x + 300.0 * y)


def write(folder, across, cells):
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    right, up = corner + 1, corner + cells + 1
    triangles = np.stack([corner, right, up + 1, corner, up + 1, up], axis=1).reshape(-1)
    offsets = np.arange(0, len(triangles) + 1, 3)
    for piece in range(across * across):
        row, column = divmod(piece, across)
        index = np.arange(cells + 1)
        x, y = np.meshgrid(SIZE * (column * cells + index) / (across * cells),
                           SIZE * (row * cells + index) / (across * cells))
        places = np.stack([x, y, height(x, y, np)], axis=-1).reshape(-1, 3).astype(np.float32)
        points, polygons, data = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(places, deep=True))
        polygons.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                         numpy_to_vtkIdTypeArray(triangles, deep=True))
        data.SetPoints(points)
        data.SetPolys(polygons)
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(data)
        writer.SetFileName(os.path.join(folder, f"scan_{piece}.vtp"))
        writer.SetCompressorTypeToNone()
        writer.SetDataModeToBinary()
        writer.SetIdTypeToInt32()
        writer.Write()
    with open(os.path.join(folder, "scan.pvtp"), "w") as file:
        file.write('<VTKFile type="PPolyData" version="1.0" byte_order="LittleEndian">\n<PPolyData '
                   'GhostLevel="0">\n<PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>\n')
        file.writelines(f'<Piece Source="scan_{piece}.vtp"/>\n' for piece in range(across * across))
        file.write("</PPolyData>\n</VTKFile>\n")


def status(key):
    with open("/proc/self/status") as lines:
        return next(int(line.split()[1]) / 1024.0 for line in lines if line.startswith(key))


def open_scan(folder, pieces):
    import vtkhaptics
    from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader

    reader = vtkXMLPPolyDataReader()
    reader.SetFileName(os.path.join(folder, "scan.pvtp"))
    scan = vtkhaptics.vtkHapticPatchSource()
    scan.SetSurfaceConnection(reader.GetOutputPort())
    scan.SetNumberOfPieces(pieces)
    scan.SetPatchRadius(0.01)
    return scan


def trace(folder, pieces, ticks):
    import numpy as np
    import vtkhaptics
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    along = 0.1 * 0.001 * np.arange(ticks)
    x, y = 0.3 + along, 0.4 + 0.2 * along
    down = np.clip(np.arange(ticks) / 300.0, 0.0, 1.0)
    path, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(np.stack([x, y, height(x, y, np) + 0.002 - 0.003 * down], axis=1), deep=True))
    path.SetPoints(points)
    scan = open_scan(folder, pieces)
    found = vtkhaptics.vtkGodObjectTrace()
    found.SetInputData(path)
    found.SetSurfaceConnection(scan.GetOutputPort())
    libraries, start = status("VmHWM"), time.monotonic()
    if not scan.Survey():
        sys.exit(1)
    surveyed, reads = time.monotonic(), scan.GetNumberOfReads()
    found.Update()
    touching = vtk_to_numpy(found.GetOutput().GetPointData().GetArray("ActiveConstraints")) > 0
    print(scan.GetNumberOfTriangles(), f"{surveyed - start:.1f}", f"{time.monotonic() - surveyed:.1f}",
          touching.sum(), scan.GetNumberOfReads() - reads, f"{libraries:.0f}", f"{status('VmHWM'):.0f}")


def stroke(folder, pieces, speed, in_background):
    """To and fro over half of the scan in real time, 1 mm deep."""
    import numpy as np
    import vtkhaptics
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scan = open_scan(folder, pieces)
    scan.SetReadInBackground(in_background)
    scene = vtkhaptics.vtkHapticScene()
    scene.GetSurfaces().BackgroundBuildingOn()
    scene.AddSurface(scan.GetOutputPort())
    device = vtkhaptics.vtkSimulatedHapticDevice()
    scene.SetDevice(device)

    def place(time):
        x = 0.5 - 0.25 * np.cos(speed / 0.25 * time)
        y = 0.45 + 0.1 * x
        return x, y, height(x, y, np) + 0.004 - 0.005 * min(time, 1.0)

    device.SetPosition(*place(0.0))
    scene.Update()
    while scene.GetSurfaces().IsBuilding():
        scene.Update()
    reads = scan.GetNumberOfReads()
    scene.StartRecording()
    scene.Engage()
    looks, start = [], time.monotonic()
    while (now := time.monotonic()) < start + SECONDS:
        device.SetPosition(*place(now - start))
        scene.Update()
        looks.append(time.monotonic() - now)
        time.sleep(max(0.0, LOOK - looks[-1]))
    scene.Release()
    scene.StopRecording()
    trace = scene.GetTrace()
    lag = np.linalg.norm(vtk_to_numpy(trace.GetPoints().GetData())
                         - vtk_to_numpy(trace.GetPointData().GetArray("HapticInterfacePoint")), axis=1)
    print(scan.GetNumberOfTriangles(), len(lag), f"{100.0 * np.mean(lag > LEFT_BEHIND):.1f}", len(looks),
          f"{1e3 * np.median(looks):.2f}", f"{1e3 * np.percentile(looks, 99):.1f}", f"{1e3 * max(looks):.1f}",
          scan.GetNumberOfReads() - reads)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--triangles", type=float, default=1e8)
    parser.add_argument("--in-a-piece", type=float, default=1e5)
    parser.add_argument("--ticks", type=int, default=4000)
    parser.add_argument("--live")
    parser.add_argument("--trace", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--stroke", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--background", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.stroke:
        stroke(options.folder, options.stroke, float(options.live), options.background)
        return
    if options.trace:
        trace(options.folder, options.trace, options.ticks)
        return
    across = max(1, round((options.triangles / options.in_a_piece) ** 0.5))
    cells = round((0.5 * options.triangles) ** 0.5 / across)
    pieces = across * across
    start = time.monotonic()
    if not os.path.exists(os.path.join(options.folder, "scan.pvtp")):
        os.makedirs(options.folder, exist_ok=True)
        write(options.folder, across, cells)
    written = time.monotonic() - start
    lines = csv.writer(sys.stdout)
    if options.live:
        lines.writerow(LIVE_COLUMNS)
        for speed in options.live.split(","):
            for background in ([], ["--background"]) * 3:
                found = subprocess.run([sys.executable, __file__, options.folder, "--stroke", str(pieces),
                                        "--live", speed, *background], capture_output=True, text=True)
                if found.returncode:
                    sys.exit(found.stderr)
                triangles, *figures = found.stdout.split()
                lines.writerow([triangles, pieces, speed, len(background), *figures, f"{os.getloadavg()[0]:.1f}"])
                sys.stdout.flush()
        return
    found = subprocess.run(
        [sys.executable, __file__, options.folder, "--trace", str(pieces), "--ticks", str(options.ticks)],
        capture_output=True, text=True)
    if found.returncode:
        sys.exit(found.stderr)
    triangles, surveyed, traced, touching, reads, libraries, peak = found.stdout.split()
    size = sum(os.path.getsize(entry) for entry in os.scandir(options.folder)) / 1e6
    lines.writerow(COLUMNS)
    lines.writerow([triangles, pieces, f"{size:.0f}", f"{written:.1f}", surveyed, traced, options.ticks,
                    touching, reads, libraries, peak, f"{os.getloadavg()[0]:.1f}"])


main()
