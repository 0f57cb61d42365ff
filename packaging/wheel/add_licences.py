"""Adds to a wheel the licences of the libraries that auditwheel has taken into it, and of the headers in it.

Usage: python add_licences.py WHEEL

The texts are those of the Debian packages that the libraries are from. A library that is not in the
list below is an error: nothing under the GPL alone may be in a wheel of this project.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

COMMON = pathlib.Path("/usr/share/common-licenses")  # to which the packages' texts refer
# The files of those for each licence; the LGPL 3 is an addition to the GPL.
TEXTS = {
    "Apache-2.0": ["Apache-2.0"],
    "LGPL-2.1-or-later": ["LGPL-2.1"],
    "LGPL-3.0-or-later": ["LGPL-3", "GPL-3"],
    "BSD-3-Clause": [],
}
# What may be bundled, by how its file begins, and the licence under which it is.
LICENCES = {
    "libembree": "Apache-2.0",
    "libtbb": "Apache-2.0",
    "libgmp-": "LGPL-3.0-or-later",
    "libmpfr": "LGPL-3.0-or-later",
    "libusb-1": "LGPL-2.1-or-later",
    "libudev": "LGPL-2.1-or-later",
    "libcap-": "BSD-3-Clause",
}
# Packages of which only headers are used, whose code is compiled into the modules.
HEADERS = ("libboost-dev", "libcgal-dev", "libglm-dev", "nlohmann-json3-dev")
SYSTEM_FOLDERS = ("/usr/lib/x86_64-linux-gnu", "/lib/x86_64-linux-gnu", "/usr/lib", "/lib")


def package_of(library):
    """The Debian package that has installed a file of that name, less what auditwheel has added."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.)", "", library)  # libgmp-1ab2c3d4.so.10.4.1
    for folder in SYSTEM_FOLDERS:
        path = pathlib.Path(folder) / name
        answer = subprocess.run(
            ["dpkg-query", "-S", str(path)], capture_output=True, text=True, check=False
        )
        if answer.returncode == 0:
            return answer.stdout.split(":")[0]
    sys.exit(f"add_licences.py: no package of this system has {name}.")


def add_licences(folder):
    """Adds them to an unpacked wheel, and a list of what is bundled."""
    (info,) = folder.glob("*.dist-info")
    lines = ["The libraries in vtkhaptics.libs/ are copies of those of these Debian packages:", ""]
    for library in sorted(folder.glob("*.libs/*.so*")):
        licences = [text for start, text in LICENCES.items() if library.name.startswith(start)]
        if not licences:
            sys.exit(f"add_licences.py: may {library.name} be bundled? See the list in this file.")
        package = package_of(library.name)
        shutil.copy(f"/usr/share/doc/{package}/copyright", info / "licenses" / f"{package}.txt")
        for text in TEXTS[licences[0]]:
            shutil.copy(COMMON / text, info / "licenses" / f"{text}.txt")
        lines.append(f"{library.name}: {package}, {licences[0]}, see {package}.txt")
    lines += ["", "The modules hold code of the headers of these:", ""]
    for package in HEADERS:
        shutil.copy(f"/usr/share/doc/{package}/copyright", info / "licenses" / f"{package}.txt")
        lines.append(f"{package}, see {package}.txt")
    (info / "licenses" / "BUNDLED.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


wheel = pathlib.Path(sys.argv[1]).resolve()
with tempfile.TemporaryDirectory() as name:
    subprocess.run([sys.executable, "-m", "wheel", "unpack", "-d", name, wheel], check=True)
    (unpacked,) = pathlib.Path(name).iterdir()
    (unpacked / next(unpacked.glob("*.dist-info")).name / "licenses").mkdir(exist_ok=True)
    add_licences(unpacked)
    wheel.unlink()
    subprocess.run([sys.executable, "-m", "wheel", "pack", "-d", wheel.parent, unpacked], check=True)
