#!/usr/bin/env python3
"""Gets real surfaces out of Debian and PyPI packages, for demonstrations, tests and benchmarks.

Needs no root: packages are downloaded and unpacked, not installed. What comes out is checked
against its SHA-256. Prints the path of each surface on standard output, all else on standard error.
"""

import argparse
import dataclasses
import fnmatch
import gzip
import hashlib
import importlib.util
import io
import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import zipfile

import surface_formats

# Needs no build.
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "Interactors/Python/vtkhaptics"))
from output import OutputError, write_bytes  # noqa: E402

SYSTEM_PYTHON = "/usr/bin/python3"  # the one that Debian's NumPy and VTK are made for
DEFAULT_FOLDER = pathlib.Path(__file__).resolve().parent.parent / "build" / "surfaces"


class Unavailable(Exception):
    """A surface that cannot be had here and now, and why."""


@dataclasses.dataclass(frozen=True)
class Surface:
    about: str
    licence: str
    package: str  # "apt:NAME", or "pip:NAME==VERSION"
    files: dict  # name of a file, wherever in the package, to the SHA-256 of its content, gunzipped
    suffix: str  # of the file that is made
    member: str = ""  # pattern of a file inside the file, which is then an archive
    convert: object = None  # from the list of contents to the bytes to write; None: as it is


SURFACES = {
    "gearbox": Surface(
        "CAD: 26,966 triangles, watertight, genus 22",
        "LGPL-2.1 with the Open CASCADE exception", "apt:occt-misc",
        {"TR12J_OCC.stl":
         "c7204731e8202f9f8f19192f95699429d7912e4dfc6a44802ebe30693c1895b7"}, ".stl"),
    "propeller": Surface(
        "CAD, bad: 7,374 triangles, 12 flipped edges, slivers",
        "LGPL-2.1 with the Open CASCADE exception", "apt:occt-misc",
        {"propeller.stl":
         "290e3da717cfcb0cc8130581863089104ab598b2cae5cd61912bbb309c1f14d2"}, ".stl"),
    "motor": Surface(
        "CAD, bad: 13,502 triangles, non-manifold, intersecting itself, duplicates",
        "LGPL-2.1 with the Open CASCADE exception", "apt:occt-misc",
        {"motor.stl":
         "4744ffc0230e3bf308660c840276b39b43a55e460e87e3fa81705f8de2e135d6"}, ".stl"),
    "aneurysm": Surface(
        "medical: vessel, 20,294 triangles, 3 openings [mm]",
        "GPL-2+", "apt:gmsh-doc",
        {"aneurysm_data.stl.gz":
         "1615f9774dd03c916283ebb38f3440de3042718281e87036ed73b650086eae3a"}, ".stl"),
    "t13": Surface(
        "CAD, small: thin sheet, 1,580 triangles, watertight, genus 2",
        "GPL-2+", "apt:gmsh-doc",
        {"t13_data.stl.gz":
         "4b9431c0dddde5b7e4f6b09506443c7ae1e3134646e2a9447e09a77379fdbd70"}, ".stl"),
    "wing": Surface(
        "CAD, thin: 842 triangles, watertight, slivers",
        "GPL-2", "apt:openscad-testing-data",
        {"bad-stl-wing.stl":
         "fe0a6209a41adfcb8c848c1aa3bc1bbdd4fc10f31db253dc52ab51007e2fe4a0"}, ".stl"),
    "cranium": Surface(
        "medical: CT of a head, 399,757 triangles in strips, 148 components [mm]",
        "GPL-2", "apt:invesalius-examples",
        {"Cranium.inv3":
         "4ce3f2a438b8b654c24ee247ce1d5f1040447bf56ec44b0e626e85aeed9b4052"}, ".vtp",
        member="*/surface_0.vtp"),
    "footbones": Surface(
        "medical: 4,204 triangles, 26 closed parts that touch",
        "see the copyright file of Debian's libcgal-demo", "apt:libcgal-demo",
        {"data.tar.gz":
         "004bd26f0029910eb2e2fd38b7ca11ea05dd4182e247c0fb778533b860dd7ab2"}, ".vtp",
        member="data/meshes/bones.off", convert=surface_formats.off_to_vtp),
    "pial": Surface(
        "medical: cortex, 20,480 triangles, watertight; arrays Sulc, Curv, Thickness, Area",
        "package BSD-3-Clause; that of the data is not stated", "pip:nilearn==0.14.1",
        {"pial_left.gii.gz":
         "b425b4914362af4aaf43bb5d022afd39a0c5f6ec4601e353631cdd737884c951",
         "sulc_left.gii.gz":
         "909eb125283cbd9e72ff30534d1ccfee8786355af00380747abd522ee87f1a92",
         "curv_left.gii.gz":
         "8f54412d57bf66559a2f73d71e1d83fe542b78db5d3446a55560ecf535fa8794",
         "thick_left.gii.gz":
         "d77530db4e8df27b9532d8bf0e947b78df89b9c1c2edceac2587541835b93321",
         "area_left.gii.gz":
         "fdc126f4ad8d0c30ead5b8c5ab4d8ae65c59d66f2c697c2221ecd248ecfcae68"}, ".vtp",
        convert=surface_formats.gifti_to_vtp),
    "fault": Surface(
        "terrain: 275,772 triangles, about 30 km x 32 km x 840 m, open; array Elevation [m]",
        "that of Matplotlib (PSF-like)", "pip:matplotlib",
        {"jacksboro_fault_dem.npz":
         "d493f50a33e82a4420494c54d1fca1539d177bdc27ab190bc5fe6e92f62fb637"}, ".vtp",
        convert=surface_formats.heights_to_vtp),
    "frog": Surface(
        "medical, large: tissues of a frog, 1,514,708 triangles, 617 components",
        "MIT (package)", "pip:pyvista==0.49.1",
        {"frog_tissues.vti":
         "844e3e324548fcebab4e14fa30be1400d34fafa7a0a14030b643b38db89da66c"}, ".vtp",
        convert=surface_formats.image_to_vtp),
}


def say(text):
    print(text, file=sys.stderr)


def run(command, folder):
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, timeout=600,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False)
    except FileNotFoundError:
        raise Unavailable(f"{command[0]} is not on this machine") from None
    except subprocess.TimeoutExpired:
        raise Unavailable(f"'{' '.join(command)}' took longer than ten minutes") from None
    if done.returncode != 0:
        last = (done.stdout.strip().splitlines() or ["no message"])[-1]
        raise Unavailable(f"'{' '.join(command)}' failed: {last}. Is the package registry in reach? "
                          "For a Debian package, 'apt-get update' as root may help")


def download(package, folder):
    """Leaves one package file in the folder and returns its path."""
    kind, name = package.split(":", 1)
    if kind == "pip" and not importlib.util.find_spec("pip"):
        raise Unavailable(f"it comes from PyPI, and {sys.executable} has no pip. Install it "
                          "(Debian: python3-pip)")
    say(f"Downloading the {'Debian' if kind == 'apt' else 'PyPI'} package {name}")
    if kind == "apt":
        run(["apt-get", "download", name], folder)
    else:
        run([sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary=:all:",
             "--disable-pip-version-check", name], folder)
    return next(pathlib.Path(folder).iterdir())


def unpack(package_file, folder):
    """Unpacks a .deb or a wheel, and returns where."""
    unpacked = pathlib.Path(folder, "unpacked")
    if package_file.suffix == ".deb":
        run(["dpkg-deb", "-x", str(package_file), str(unpacked)], folder)
    else:
        with zipfile.ZipFile(package_file) as wheel:
            wheel.extractall(unpacked)
    return unpacked


def read_member(content, pattern):
    with tarfile.open(fileobj=io.BytesIO(content)) as archive:
        for entry in archive:
            if entry.isfile() and fnmatch.fnmatch(entry.name, pattern):
                return archive.extractfile(entry).read()
    raise Unavailable(f"the archive in the package has no {pattern}")


def fetch(surface, folder):
    """Contents of the files of a surface, found by name and checked by their SHA-256.

    By name alone, as packages move their files from one release to the next.
    """
    package_file = download(surface.package, folder)
    unpacked = unpack(package_file, folder)
    contents = []
    for name, expected in surface.files.items():
        found = []
        for path in sorted(p for p in unpacked.rglob(name) if p.is_file()):
            content = path.read_bytes()
            if surface.member:
                content = read_member(content, surface.member)
            elif name.endswith(".gz"):
                content = gzip.decompress(content)
            found.append(hashlib.sha256(content).hexdigest())
            if found[-1] == expected:
                contents.append(content)
                break
        else:
            raise Unavailable(
                f"{package_file.name}, another version of the package, has {name} with the SHA-256 "
                f"{', '.join(found)} instead of {expected}" if found else
                f"{package_file.name}, another version of the package, has no {name}")
    return contents


def write(path, content):
    """Whole or not at all, so that a file that is there can be trusted."""
    try:
        write_bytes(path, content)
    except OutputError as error:
        raise Unavailable(f"{error} --output gives the folder.") from error


def get(name, folder):
    surface = SURFACES[name]
    path = folder / (name + surface.suffix)
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as scratch:
            contents = fetch(surface, scratch)
        write(path, surface.convert(contents) if surface.convert else contents[0])
        say(f"{name}: {surface.about}. Licence: {surface.licence}")
    return path


def get_fallback(folder):
    path = folder / "fallback_knot.vtp"
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        write(path, surface_formats.knot_to_vtp())
    return path


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples:\n  get_surfaces.py gearbox\n  get_surfaces.py --output /tmp/s cranium pial\n\n"
        "Needs NumPy and VTK's Python modules for all but plain STL files: a Python that lacks\n"
        f"them hands over to {SYSTEM_PYTHON}.\n\n"
        "Exit status: 0 done, 1 a module is missing or the folder cannot be written, 2 wrong\n"
        "arguments, 3 a surface could not be had; the others were got.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="surfaces; 'all' for every one")
    parser.add_argument("--list", action="store_true", help="name the surfaces and their licences")
    parser.add_argument("--output", type=pathlib.Path, default=DEFAULT_FOLDER, metavar="DIR",
                        help="where they go (default: build/surfaces of this project)")
    parser.add_argument("--fallback", action="store_true",
                        help="where a surface cannot be had, make one of this project's own instead")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in SURFACES and name != "all"]
    if unknown:
        parser.error(f"no surface '{unknown[0]}'; there are: {', '.join(SURFACES)}")
    if not arguments.names and not arguments.list:
        parser.error("name a surface, or ask for --list")
    return arguments


def hand_over():
    """Goes on in the system's Python where this one (pyenv's, say) lacks what is needed."""
    if all(importlib.util.find_spec(module) for module in ("numpy", "vtkmodules")):
        return
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])


def get_all(names, folder, fallback):
    """Prints the path of each; returns the exit status."""
    status = 0
    for name in names:
        try:
            print(get(name, folder), flush=True)
        except Unavailable as reason:
            say(f"get_surfaces.py: '{name}' could not be had: {reason}.")
            if not fallback:
                status = 3
                continue
            say("Instead, here is a surface of this project's own, a knot.")
            print(get_fallback(folder), flush=True)
    return status


def main():
    arguments = parse_arguments()
    if arguments.list:
        for name, surface in SURFACES.items():
            print(f"{name:10} {surface.about}\n{'':10} {surface.package}; {surface.licence}")
        return 0
    hand_over()
    names = SURFACES if "all" in arguments.names else arguments.names
    try:
        return get_all(names, arguments.output.resolve(), arguments.fallback)
    except ImportError as error:
        say(f"get_surfaces.py: {error}. It needs NumPy and VTK's Python modules (Debian: "
            "python3-numpy, and python3-vtk9 or python3-paraview): install them, and run it with "
            f"{SYSTEM_PYTHON}.")
    except OSError as error:
        say(f"get_surfaces.py: {error.filename or arguments.output}: {error.strerror or error}. "
            "Check the space on the disk, or choose another folder with --output.")
    return 1


if __name__ == "__main__":
    sys.exit(main())
