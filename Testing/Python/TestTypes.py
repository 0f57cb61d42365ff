"""mypy and pyright take a right program and refuse a wrong one, with VTK's stubs and without."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import vtkhaptics

ALONE = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
PACKAGE = pathlib.Path(vtkhaptics.__file__).parent
RIGHT = """
import numpy as np
import vtkhaptics

t = vtkhaptics.trace((np.zeros((3, 3)), [[0, 1, 2]]), np.zeros((4, 3)))
t.force.max()
device = vtkhaptics.vtkSimulatedHapticDevice()
device.SetPosition(np.zeros(3))
x, y, z = device.GetPosition()
filled = [0.0, 0.0, 0.0]
device.GetPosition(filled)
scene = vtkhaptics.vtkHapticScene()
scene.SetDevice(device)
with scene.engaged() as same:
    same.Update()
scene.AddObserver("ContactBeginEvent", lambda caller, event, probe: None)
scene.GetServo().GetReadings().GetForce()[2]


class Pen(vtkhaptics.HapticDevice):
    def exchange(self, force: np.ndarray) -> np.ndarray:
        return np.zeros(3)


scene.SetDevice(Pen())
"""
WRONG = {
    'vtkhaptics.vtkHapticScene().SetStiffness("hard")': True,
    "vtkhaptics.no_such_name": True,
    "vtkhaptics.trace()": True,
    "vtkhaptics.vtkHapticScene().NoSuchMethod()": False,  # known only from what VTK's classes have
}


@unittest.skipUnless((PACKAGE / "vtkHapticsDevices.pyi").is_file(),
                     "there are no stubs, as this VTK has no generator (Debian's VTK 9.1)")
class Types(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.site = self.folder / "site"
        shutil.copytree(PACKAGE, self.site / "vtkhaptics", ignore=shutil.ignore_patterns("*.so"))

    def with_stubs_of_vtk(self):
        stubs = PACKAGE.parent / "vtkmodules-stubs"
        self.assertTrue(stubs.is_dir(), "they are made where VTK has none")
        shutil.copytree(stubs, self.site / "vtkmodules")

    def check(self, run):
        wrong = list(WRONG)
        self.assertEqual(run(RIGHT), set(), "a right program")
        found = run("import vtkhaptics\n" + "\n".join(wrong) + "\n")
        self.assertEqual(found, {i + 2 for i, line in enumerate(wrong) if WRONG[line]})
        self.with_stubs_of_vtk()
        self.assertEqual(run(RIGHT), set(), "a right program, with VTK's stubs")
        found = run("import vtkhaptics\n" + "\n".join(wrong) + "\n")
        self.assertEqual(found, {i + 2 for i in range(len(wrong))})

    def write(self, program):
        (self.folder / "program.py").write_text(program, encoding="utf-8")

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_mypy(self):
        def run(program):
            self.write(program)
            done = subprocess.run(
                ["mypy", "--follow-imports=silent", "--python-version=3.11", "program.py"],
                cwd=self.folder, env={**ALONE, "MYPYPATH": str(self.site)},
                capture_output=True, text=True,
            )
            errors = [line for line in done.stdout.splitlines() if ": error: " in line]
            # Of an installed package mypy would not say that VTK has no stubs.
            errors = [line for line in errors if "[import-not-found]" not in line]
            elsewhere = [line for line in errors if line.startswith("site/vtkhaptics/")]
            self.assertEqual(elsewhere, [])
            return {int(line.split(":")[1]) for line in errors if line.startswith("program.py:")}

        self.check(run)

    @unittest.skipUnless(shutil.which("pyright"), "pyright is not installed")
    def test_pyright(self):
        def run(program):
            self.write(program)
            settings = {"include": ["program.py"], "extraPaths": [str(self.site)]}
            (self.folder / "pyrightconfig.json").write_text(json.dumps(settings))
            done = subprocess.run(
                ["pyright", "--outputjson", "--pythonpath", sys.executable], cwd=self.folder, capture_output=True, text=True,
                env=ALONE,
            )
            found = json.loads(done.stdout)["generalDiagnostics"]
            return {
                diagnostic["range"]["start"]["line"] + 1
                for diagnostic in found
                if diagnostic["severity"] == "error"
            }

        self.check(run)


if __name__ == "__main__":
    unittest.main()
