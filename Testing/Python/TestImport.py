"""The package imports flat, and says what to do where its modules are missing."""

import os
import shutil
import signal
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

# Ctrl-C while a module imports another: those of VTK would say that it is missing.
AT_AN_IMPORT = """
import os, runpy, signal, sys

class Sender:
    def find_spec(self, name, *_):
        if name == at:
            os.kill(os.getpid(), signal.SIGINT)
        elif at == "?":
            print(name)

module, at = sys.argv[1:3]
sys.argv[1:] = ["--help"]
sys.meta_path.insert(0, Sender())
runpy.run_module(module, run_name="__main__", alter_sys=True)
"""


def at_an_import(module, at):
    return subprocess.run(
        [sys.executable, "-c", AT_AN_IMPORT, module, at], capture_output=True, text=True, check=False,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))


for program in ("vtkhaptics.__main__", "vtkhaptics.demo"):
    imported = at_an_import(program, "?").stdout.split()
    imported = [name for name in imported if name.startswith(("vtkmodules.", "numpy.", "datetime"))]
    assert len(imported) > 100, imported
    for name in imported[::8]:
        interrupted = at_an_import(program, name)
        assert interrupted.returncode == -signal.SIGINT, (program, name, interrupted)
        assert interrupted.stderr.splitlines()[-1] == "KeyboardInterrupt", (program, name, interrupted)
print("imported", vtkhaptics.__file__)
