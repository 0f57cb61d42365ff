"""Every example runs; each checks its own outcome."""

import glob
import os
import subprocess
import sys

folder = os.path.join(os.environ["HAPTICS_SOURCE_DIR"], "Interactors", "Python", "examples")
examples = sorted(glob.glob(os.path.join(folder, "*.py")))
assert len(examples) >= 3, folder
for example in examples:
    done = subprocess.run([sys.executable, example], capture_output=True, text=True, check=False)
    assert done.returncode == 0, (example, done.stdout, done.stderr)
    assert done.stdout.strip(), example + " says nothing"
    print(os.path.basename(example) + ": " + done.stdout.strip().splitlines()[0])
