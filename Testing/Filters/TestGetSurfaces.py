"""Data/get_surfaces.py where no package can be had, and its arguments. Uses no network."""

import dataclasses
import gzip
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile
from unittest import mock

from vtkhaptics import vtkGodObjectFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SYSTEM_PYTHON = "/usr/bin/python3"
SCRIPT = pathlib.Path(os.environ["HAPTICS_SOURCE_DIR"], "Data", "get_surfaces.py")
sys.path.insert(0, str(SCRIPT.parent))
import get_surfaces


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
        done = self.run_script("--fallback", "gearbox")
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
        self.run_script("--fallback", "gearbox")
        self.assertEqual(path.read_bytes(), first, "the same knot every time")

    def test_what_cannot_be_had_is_a_failure_with_a_status_of_its_own(self):
        done = self.run_script("gearbox")
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stdout, "")

    def test_a_surface_that_is_there_is_not_fetched_again(self):
        self.folder.mkdir()
        (self.folder / "gearbox.stl").write_bytes(b"kept")
        done = self.run_script("gearbox")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "gearbox.stl").read_bytes(), b"kept")

    def test_a_surface_that_cannot_be_had_does_not_stop_the_others(self):
        self.folder.mkdir()
        (self.folder / "t13.stl").write_bytes(b"kept")
        done = self.run_script("gearbox", "t13")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("'gearbox' could not be had", done.stderr)
        self.assertEqual(done.stdout.split(), [str((self.folder / "t13.stl").resolve())])

    def test_files_are_found_by_name_wherever_a_package_has_moved_them(self):
        content = b"solid"
        name = "t13_data.stl.gz"
        for place in ("tutorial", "doc/gmsh/tutorials"):
            with self.subTest(place), tempfile.TemporaryDirectory() as scratch:
                wheel = pathlib.Path(scratch, "a.whl")
                with zipfile.ZipFile(wheel, "w") as archive:
                    archive.writestr(f"other/{name}", gzip.compress(b"not this one"))
                    archive.writestr(f"{place}/{name}", gzip.compress(content))
                surface = dataclasses.replace(
                    get_surfaces.SURFACES["t13"],
                    files={name: hashlib.sha256(content).hexdigest()})
                with mock.patch.object(get_surfaces, "download", return_value=wheel):
                    self.assertEqual(get_surfaces.fetch(surface, scratch), [content])
                    strange = dataclasses.replace(surface, files={name: "0" * 64})
                    with self.assertRaisesRegex(get_surfaces.Unavailable, "SHA-256"):
                        get_surfaces.fetch(strange, scratch)

    def test_a_python_without_pip_is_named_with_the_package_that_has_it(self):
        with mock.patch.object(get_surfaces.importlib.util, "find_spec", return_value=None):
            with self.assertRaisesRegex(get_surfaces.Unavailable, "python3-pip"):
                get_surfaces.download("pip:nilearn==0.14.1", self.folder)

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
        done = self.run_script("--fallback", "gearbox", python=(SYSTEM_PYTHON, "-S"), PYTHONPATH="")
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
        done = self.run_script("--fallback", "gearbox", python=(str(other), "-S"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(pathlib.Path(done.stdout.strip()).is_file(), done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
