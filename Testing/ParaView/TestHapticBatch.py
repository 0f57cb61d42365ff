"""pvbatch alone, and as two processes with a script for one or for each, touch the same without a display.

Run by Python with the files of the plugin and of pvbatch, and mpiexec.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

PLUGIN, PVBATCH, MPIEXEC = sys.argv[1:]

SCRIPT = f"""
import os

import vtkhaptics.paraview as haptics

haptics.load_plugin({PLUGIN!r})
from paraview.simple import *

contour = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[157.0])
hand = haptics.touch(contour, Device="simulated", Stiffness=400.0)
for value in (157.0, 160.0):
    contour.Isosurfaces = [value]
    hand.RecordTrace = 1
    hand.step(1500)
    hand.RecordTrace = 0
    trace = hand.trace()
    force = trace.GetPointData().GetArray("Force")
    largest = max(sum(c * c for c in force.GetTuple3(i)) ** 0.5 for i in range(force.GetNumberOfTuples()))
    filter = hand.vtk.GetSurfaceFilter(hand.vtk.GetSurfaces().GetId(0))
    filter.Update()
    bounds = ["%.9g" % number for number in trace.GetBounds()]
    with open(f"{{os.getpid()}}.forces", "a") as file:
        print(value, filter.GetOutput().GetNumberOfCells(), trace.GetNumberOfPoints(), "%.6f" % largest, bounds,
              file=file)
"""


def forces(command, folder):
    """What the script has written: a line for each contour and for each process that runs it.

    Each process has its own file: what two of them print at once comes out of mpiexec in pieces of both.
    """
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    environment["OMPI_MCA_mpi_yield_when_idle"] = "1"  # more ranks than cores
    environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"  # in a container
    ended = subprocess.run(
        [*command, os.path.join(folder, "touch.py")], env=environment, timeout=200, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=folder,
    )
    assert ended.returncode == 0, (command, ended.stdout)
    lines = []
    for path in pathlib.Path(folder).glob("*.forces"):
        lines += path.read_text().splitlines()
        path.unlink()
    return lines


def main():
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "touch.py"), "w") as file:
            file.write(SCRIPT)
        two = [MPIEXEC, "--oversubscribe", "-n", "2", PVBATCH]
        alone = forces([PVBATCH], folder)
        print("\n".join(alone))
        assert len(alone) == 2, alone
        for line in alone:
            assert float(line.split()[3]) > 1.0, line  # N
        for command in (two, [*two, "--symmetric"]):
            together = forces(command, folder)
            assert len(together) == len(alone) * (2 if "--symmetric" in command else 1), together
            assert set(together) == set(alone), (command, together, alone)


main()
