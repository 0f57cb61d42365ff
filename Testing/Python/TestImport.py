"""The package imports flat, and says what to do where its modules are missing."""

import os
import shutil
import subprocess
import sys
import tempfile

import vtkhaptics
from vtkhaptics import (
    vtkGodObjectActor,
    vtkGodObjectFilter,
    vtkGodObjectTrace,
    vtkHapticScene,
    vtkHapticServo,
    vtkInteractorStyleHaptic,
    vtkSimulatedHapticDevice,
)

for made in (
    vtkGodObjectActor,
    vtkGodObjectFilter,
    vtkGodObjectTrace,
    vtkHapticScene,
    vtkHapticServo,
    vtkInteractorStyleHaptic,
    vtkSimulatedHapticDevice,
):
    instance = made()
    assert instance.GetClassName() == made.__name__, made
    assert made.__name__ in str(instance), "PrintSelf of " + made.__name__

# A copy of the Python files alone must explain itself.
with tempfile.TemporaryDirectory() as folder:
    alone = os.path.join(folder, "vtkhaptics")
    os.mkdir(alone)
    shutil.copy(os.path.join(os.path.dirname(vtkhaptics.__file__), "__init__.py"), alone)
    environment = dict(os.environ, PYTHONPATH=folder)
    failed = subprocess.run(
        [sys.executable, "-c", "import vtkhaptics"],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert failed.returncode != 0
    assert "env.sh" in failed.stderr, failed.stderr
print("imported", vtkhaptics.__file__)
