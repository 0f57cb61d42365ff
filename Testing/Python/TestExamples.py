"""Every example runs; each checks its own outcome."""

import glob
import os
import subprocess
import sys
import time

folder = os.path.join(os.environ["HAPTICS_SOURCE_DIR"], "Interactors", "Python", "examples")
examples = sorted(glob.glob(os.path.join(folder, "*.py")))
assert len(examples) == 12, folder
ARGUMENTS = {"mouse_viewer.py": ["3"]}  # else it would wait for somebody
for example in examples:
    if os.path.basename(example).startswith("study_"):
        with open(example, encoding="utf-8") as file:
            assert len(file.readlines()) < 60, example + " is no short example any more"
    command = [sys.executable, example, *ARGUMENTS.get(os.path.basename(example), [])]
    began = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    if example.endswith("mouse_viewer.py"):
        assert time.monotonic() - began > float(command[-1]), "it strokes for so many seconds"
    if done.returncode == 77:  # it needs what is not installed, and says so
        print(os.path.basename(example) + ": " + done.stdout.strip())
        continue
    assert done.returncode == 0, (example, done.stdout, done.stderr)
    assert done.stdout.strip(), example + " says nothing"
    print(os.path.basename(example) + ": " + done.stdout.strip().splitlines()[0])
