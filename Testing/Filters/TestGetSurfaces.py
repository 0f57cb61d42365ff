"""Data/get_surfaces.py where no package can be had, and its arguments. Uses no network."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from vtkhaptics import vtkGodObjectFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SYSTEM_PYTHON = "/usr/bin/python3"
SCRIPT = pathlib.Path(os.environ["HAPTICS_SOURCE_DIR"], "Data", "get_surfaces.py")


class TestGetSurfaces(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name, "surfaces")

    def run_script(self, *arguments, python=(sys.executable,), folder=None, **environment):
        # Without PATH neither apt-get nor dpkg-deb is found: no registry is in reach.
        environment = dict(os.environ, PATH="", PYTHONDONTWRITEBYTECODE="1", **environment)
        return subprocess.run(
            [*python, str(SCRIPT), "--output", str(folder or self.folder), *arguments],
            env=environment, capture_output=True, text=True, check=False)

    def test_the_list_names_surfaces_packages_and_licences(self):
        done = self.run_script("--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("gearbox", "apt:occt-misc", "LGPL-2.1", "pial", "pip:nilearn"):
            self.assertIn(word, done.stdout)

    def test_an_unknown_name_is_refused_and_the_known_ones_are_named(self):
        done = self.run_script("gearbx")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no surface 'gearbx'", done.stderr)
        self.assertIn("gearbox", done.stderr)

    def test_without_a_registry_a_closed_knot_is_made_and_said_so(self):
        done = self.run_script("gearbox")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'gearbox' could not be had: apt-get is not on this machine", done.stderr)
        path = pathlib.Path(done.stdout.strip())
        self.assertEqual(path.parent, self.folder.resolve())
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        surface = vtkGodObjectFilter()
        surface.SetInputConnection(reader.GetOutputPort())
        surface.Update()
        self.assertTrue(surface.GetClosed() and surface.GetOriented())
        self.assertEqual(surface.GetNumberOfComponents(), 1)
        self.assertEqual(surface.GetNumberOfInsideOutComponents(), 0)
        first = path.read_bytes()
        path.unlink()
        self.run_script("gearbox")
        self.assertEqual(path.read_bytes(), first, "the same knot every time")

    def test_no_fallback_fails_with_a_status_of_its_own(self):
        done = self.run_script("--no-fallback", "gearbox")
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stdout, "")

    def test_a_surface_that_is_there_is_not_fetched_again(self):
        self.folder.mkdir()
        (self.folder / "gearbox.stl").write_bytes(b"kept")
        done = self.run_script("--no-fallback", "gearbox")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "gearbox.stl").read_bytes(), b"kept")

    def test_a_surface_that_cannot_be_had_does_not_stop_the_others(self):
        self.folder.mkdir()
        (self.folder / "t13.stl").write_bytes(b"kept")
        done = self.run_script("--no-fallback", "gearbox", "t13")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("'gearbox' could not be had", done.stderr)
        self.assertEqual(done.stdout.split(), [str((self.folder / "t13.stl").resolve())])

    def test_a_folder_that_cannot_be_made_is_named(self):
        self.folder.write_bytes(b"a file")
        for inside in ("", "below"):
            done = self.run_script("gearbox", folder=self.folder / inside)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn(str(self.folder.resolve()), done.stderr)
            self.assertIn("--output", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    @unittest.skipUnless(os.access(SYSTEM_PYTHON, os.X_OK), "no Python of the system")
    def test_where_no_python_has_the_modules_they_are_named(self):
        done = self.run_script("gearbox", python=(SYSTEM_PYTHON, "-S"), PYTHONPATH="")
        self.assertEqual(done.returncode, 1, done.stderr)
        for word in ("numpy", "python3-numpy", "python3-vtk9", SYSTEM_PYTHON):
            self.assertIn(word, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    @unittest.skipUnless(
        os.path.realpath(sys.executable) == os.path.realpath(SYSTEM_PYTHON),
        "needs the modules in the system's Python")
    def test_a_python_without_the_modules_hands_over_to_the_systems(self):
        other = pathlib.Path(self.folder.parent, "python3")
        other.symlink_to(SYSTEM_PYTHON)
        done = self.run_script("gearbox", python=(str(other), "-S"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(pathlib.Path(done.stdout.strip()).is_file(), done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
