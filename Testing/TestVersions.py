"""All files that name the project's version name the same one. Usage: python3 TestVersions.py SOURCE"""

import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
PLACES = {
    "CMakeLists.txt": r"^project\(VTKHaptics VERSION ([\d.]+)",
    "CHANGELOG.md": r"^## ([\d.]+)",
    "CITATION.cff": r"^version: ([\d.]+)",
    "packaging/debian/changelog": r"^vtkhaptics \(([\d.]+)-",
    "packaging/conda/recipe.yaml": r'^  version: "([\d.]+)"',
    "packaging/spack/packages/vtk_haptics/package.py": r'^    version\("([\d.]+)"',
    "packaging/linux/org.vtkhaptics.Viewer.metainfo.xml": r'<release version="([\d.]+)"',
    "packaging/linux/org.vtkhaptics.ParaView.metainfo.xml": r'<release version="([\d.]+)"',
}
found = {}
for name, pattern in PLACES.items():
    match = re.search(pattern, (source / name).read_text(encoding="utf-8"), re.MULTILINE)
    found[name] = match.group(1) if match else None
version = found["CMakeLists.txt"]
assert version, found
for name, named in found.items():
    assert named == version, f"{name} names version {named}, CMakeLists.txt {version}"
# Who builds on the package asks for the interface of this one.
interface = ".".join(version.split(".")[:2])
for name in ("Testing/Consumer", "Testing/Consumer/Neighbours", "Devices/Template"):
    text = (source / name / "CMakeLists.txt").read_text(encoding="utf-8")
    asked = re.search(r"find_package\(VTKHaptics ([\d.]+) REQUIRED\)", text)
    assert asked and asked.group(1) == interface, f"{name} asks for {asked}, not {interface}"
# What that version writes is kept for the tests of later ones.
formats = source / "Testing/Formats" / version
assert sorted(file.name for file in formats.iterdir()) == ["stroke.haptic", "touched.pvsm"], formats
print(f"version {version} in {len(found)} files")
