"""The examples of the README, as they stand there."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PVPYTHON = sys.argv.pop() if len(sys.argv) > 1 else None
ROOT = pathlib.Path(os.environ["HAPTICS_SOURCE_DIR"])


def examples(language):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


class Readme(unittest.TestCase):
    def run_example(self, interpreter, source):
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder, "example.py")
            script.write_text(source, encoding="utf-8")
            done = subprocess.run(
                [*interpreter, str(script)], cwd=folder, capture_output=True, text=True
            )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_python_example_runs(self):
        (source,) = [example for example in examples("python") if "paraview" not in example]
        force = re.search(r"largest force (\S+) N", self.run_example([sys.executable], source))
        # 500 N/m and 2 mm, from which the facets' sagitta goes.
        self.assertAlmostEqual(float(force[1]), 1.0, delta=0.05)

    @unittest.skipUnless(PVPYTHON, "this build has no ParaView")
    def test_paraview_example_runs(self):
        (source,) = [example for example in examples("python") if "paraview" in example]
        interpreter = [PVPYTHON, "--force-offscreen-rendering"]
        force = re.search(r"(\S+) N at", self.run_example(interpreter, source))
        self.assertGreater(float(force[1]), 0.1)

    def test_cpp_example_is_the_program_that_is_built(self):
        # Consumer.BuildAndRun builds and runs that one against an installation.
        program = (ROOT / "Testing/Consumer/consumer.cxx").read_text(encoding="utf-8")
        self.assertEqual(examples("cpp"), [program])


if __name__ == "__main__":
    unittest.main()
