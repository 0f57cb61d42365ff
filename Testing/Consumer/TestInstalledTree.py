"""What an installation holds, by name: all that belongs, nothing loose, nothing of the build's place.

Usage: python TestInstalledTree.py PREFIX SOURCE BUILD PARAVIEW(0 or 1)
"""

import pathlib
import re
import subprocess
import sys

prefix, source, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
with_plugin = sys.argv[4] == "1"
files = sorted(
    str(path.relative_to(prefix))
    for path in prefix.rglob("*")
    if path.is_symlink() or not path.is_dir()
)
files = [name for name in files if "__pycache__" not in name]
print("\n".join(files))

# Where each file may lie; LIB is lib or lib/ARCHITECTURE, and another where a package says so.
LIB = r"lib(?:/[^/]+)?"
PLACES = [
    r"include/vtkhaptics/[^/]+\.h",
    r"include/vtkhaptics/haptics/[A-Z]\w+/(?:\w+/)?\w+\.h",
    rf"{LIB}/libvtkHaptics\w+\.so[\d.]*",
    rf"{LIB}/cmake/VTKHaptics/[\w.-]+\.cmake",
    rf"{LIB}/vtk/hierarchy/VTKHaptics/.+",
    rf"{LIB}/python3[\d.]*/(?:site|dist)-packages/vtkhaptics/[\w.-]+",
    rf"{LIB}/python3[\d.]*/(?:site|dist)-packages/vtkmodules-stubs/.+",
    r"lib/udev/rules\.d/60-novint-falcon\.rules",
    r"libexec/vtkhaptics/falcon-guardian",
    r"share/vtkhaptics/env\.sh",
    r"share/vtkhaptics/device/.+",
    r"share/doc/vtkhaptics/.+",
]
if with_plugin:
    PLACES += [
        rf"{LIB}/paraview-[\d.]+/plugins/.+",
        rf"{LIB}/libvtkHaptics\w+CS\.a",  # ParaView's wrapping, for those that build on the plugin
    ]
loose = [name for name in files if not any(re.fullmatch(place, name) for place in PLACES)]
assert not loose, f"where nobody looks for it: {loose}"

# Documents, examples, tutorial, template: all that the sources have.
documents = ["LICENSE", "README.md", "CHANGELOG.md", "CITATION.cff", "packaging/PORTING.md"]
for pattern in (
    "*/README.md",
    "Interactors/Python/examples/*.py",
    "Plugin/examples/*.py",
    "Plugin/docs/*",
    "Testing/Consumer/*.cxx",
):
    documents += [str(path.relative_to(source)) for path in source.glob(pattern)]
wanted = [f"share/doc/vtkhaptics/{name}" for name in documents if not name.startswith("build")]
wanted += [
    f"share/vtkhaptics/device/{path.relative_to(source / 'Devices/Template')}"
    for path in (source / "Devices/Template").rglob("*")
    if path.is_file()
]
missing = [name for name in wanted if name not in files]
assert not missing, f"not installed: {missing}"
modules = [name.rpartition("/")[2] for name in files if "-packages/vtkhaptics/" in name]
if modules:
    package = source / "Interactors/Python/vtkhaptics"
    names = [path.name for path in package.glob("*.py")] + ["py.typed", "_version.py", "__init__.pyi"]
    missing = [name for name in names if name not in modules]
    assert not missing, f"not in the Python package: {missing}"
if with_plugin:
    plugin = [prefix / name for name in files if name.endswith("plugins/Haptics/Haptics.so")]
    assert plugin, "no plugin"
    # It links all that it uses, so that it loads where symbols are bound at once, and not only into a
    # program that happens to have them.
    links = subprocess.run(["ldd", "-r", plugin[0]], capture_output=True, text=True, check=True).stdout
    undefined = [line for line in links.splitlines() if re.search(r"undefined .*Haptics\.so\)", line)]
    assert not undefined, undefined

# Links of the documents lead to what is installed, or to the world.
for name in files:
    if name.endswith(".md"):
        text = (prefix / name).read_text(encoding="utf-8")
        for link in re.findall(r"\]\(([^)#\s]+)", text):
            if "://" not in link:
                target = (prefix / name).parent / link
                assert target.exists(), f"{name} links to {link}, which is not installed"

# It may be moved: no text and no library's search path names where it was made.
places = (str(source), str(build))
sonames = []
for name in files:
    path = prefix / name
    if path.is_symlink():
        continue
    if path.suffix in (".cmake", ".py", ".pyi", ".sh", ".h", ".json", ".xml", ".txt"):
        # env.sh names the first prefix, for shells that do not say where they read it from.
        text = path.read_text(encoding="utf-8").replace(str(prefix), "")
        named = [place for place in places if place in text]
        assert not named, f"{name} names {named}"
    elif ".so" in path.name:
        dynamic = subprocess.run(
            ["readelf", "-d", path], capture_output=True, text=True, check=True
        ).stdout
        # What is linked to one release runs with the later ones of its major version.
        released = re.fullmatch(r"(libvtkHaptics\w+\.so\.\d+)\.[\d.]+", path.name)
        if released:
            assert f"soname: [{released.group(1)}]" in dynamic, f"{name}: {dynamic}"
            sonames.append(released.group(1))
        for line in dynamic.splitlines():
            if "RUNPATH" in line or "RPATH" in line:
                named = [place for place in places if place in line]
                assert not named, f"{name} is searched for in {line}"
assert sonames, "no library with a version"
print(f"{len(files)} files, each in its place")
