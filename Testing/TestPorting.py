"""What the sources use of the system, packaging/PORTING.md names by file, and it names no file that is gone.

Usage: python3 TestPorting.py SOURCE
"""

import pathlib
import re
import sys

SYSTEM = re.compile(
    r"^#include <(?:(?:sys|linux|asm|net|netinet|arpa)/\w+"
    r"|unistd|fcntl|pthread|sched|poll|semaphore|dlfcn|termios|dirent|libusb)\.h>",
    re.MULTILINE,
)
source = pathlib.Path(sys.argv[1])
page = (source / "packaging/PORTING.md").read_text(encoding="utf-8")
named = set(re.findall(r"`([A-Z]\w*/[\w./*]*)`", page))
gone = [name for name in named if not any(source.glob(name.rstrip("/")))]
assert named and not gone, f"PORTING.md names what is gone: {gone}"

uses = [
    path.relative_to(source)
    for room in ("Filters", "Devices", "Interactors", "Plugin")
    for path in (source / room).rglob("*")
    if path.suffix in (".cxx", ".h") and SYSTEM.search(path.read_text(encoding="utf-8"))
]
missing = [
    str(path)
    for path in uses
    if not any(path.match(name) or name.endswith("/") and str(path).startswith(name) for name in named)
]
assert uses and not missing, f"PORTING.md lacks what uses the system: {missing}"
print(f"{len(uses)} files that use the system, all named")
