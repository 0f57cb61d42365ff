"""The examples of the README, as they stand there."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(os.environ["HAPTICS_SOURCE_DIR"])


def examples(language):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


class Readme(unittest.TestCase):
    def test_python_examples_run(self):
        found = examples("python")
        self.assertGreaterEqual(len(found), 1)
        for source in found:
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(
                    [sys.executable, "-c", source], cwd=folder, capture_output=True, text=True
                )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"largest force 0\.9\d+ N|largest force 1\.0\d+ N")

    def test_cpp_example_is_the_program_that_is_built(self):
        # Consumer.BuildAndRun builds and runs that one against an installation.
        program = (ROOT / "Testing/Consumer/consumer.cxx").read_text(encoding="utf-8")
        self.assertEqual(examples("cpp"), [program])


if __name__ == "__main__":
    unittest.main()
