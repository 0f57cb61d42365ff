"""Each room of the sources includes only rooms before it, no header includes itself in the end, each
has a guard with the project's name, no class's members lie in several source files, nobody casts a
device down to ask what it is, and all that ARCHITECTURE.md names is there.

usage: TestRooms.py SOURCE_FOLDER
"""

import os
import re
import sys

# From a room to those that it may know besides itself; see ARCHITECTURE.md.
KNOWS = {
    "Filters/Core/Files": (),
    "Filters/Core/Math": (),
    "Filters/Core/Surface": ("Filters/Core/Math",),
    "Filters/Core/Material": ("Filters/Core/Math", "Filters/Core/Surface"),
    "Filters/Core/Contact": ("Filters/Core/Math", "Filters/Core/Surface", "Filters/Core/Material"),
    "Filters/Core/Tick": ("Filters/Core",),
    "Filters": ("Filters/Core",),
    "Devices": ("Filters/Core/Files",),
    "Interactors/Servo": ("Filters/Core", "Devices"),
    "Interactors/Scene": ("Filters", "Devices", "Interactors/Servo"),
    "Interactors/View": ("Filters", "Devices", "Interactors/Servo", "Interactors/Scene"),
    "Plugin/Representations": ("Filters", "Devices", "Interactors"),
    "Plugin/Qt": ("Filters", "Devices", "Interactors", "Plugin/Representations"),
}
# Classes whose members lie in several source files, and in how many: the actor's second one draws its marks.
SOURCES = {"vtkGodObjectActor": 2}
MEMBER = re.compile(r"^(?:\w[\w:<>,&* ]*[ *&])?((?:\w+::)*\w+)::~?\w+\(", re.MULTILINE)
CAST_DOWN = re.compile(r"\bvtk\w+(HapticDevice|HapticsDevice)::SafeDownCast")


def room_of(folder):
    """The room that a folder is or lies in."""
    while folder not in KNOWS and folder:
        folder = os.path.dirname(folder)
    return folder


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def includes(path):
    """The names of the project's headers that a file includes."""
    return [os.path.basename(name) for name in re.findall(r'#include "([^"]+)"', read(path))]


def unknown_names(root):
    """What ARCHITECTURE.md names that is no file or folder, nor a word of a header or of a build file."""
    words = set()
    for top in ("Filters", "Devices", "Interactors", "Plugin", "Testing"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in names:
                if name.endswith((".h", "CMakeLists.txt", "vtk.module")):
                    words.update(re.findall(r"\w+", read(os.path.join(folder, name))))
    for name in re.findall(r"`([\w./]+)`", read(os.path.join(root, "ARCHITECTURE.md"))):
        path = os.path.join(root, name)
        is_path = any(os.path.exists(path + end) for end in ("", ".h", ".cxx"))
        if not is_path and name not in words:
            yield name


def main(root):
    """Prints what is wrong; returns the exit status."""
    files = {}
    for top in ("Filters", "Devices", "Interactors", "Plugin"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            room = room_of(os.path.relpath(folder, root))
            for name in names:
                if name.endswith((".h", ".cxx")) and "Template" not in folder and room:
                    files[name] = (room, os.path.join(folder, name))
    problems = []
    graph = {}
    sources = {}
    for name, (room, path) in files.items():
        text = read(path)
        if name.endswith(".h") and f"\n#define Haptics_{name[:-2]}_h\n" not in text:
            problems.append(f"{room}/{name} is not guarded by Haptics_{name[:-2]}_h")
        if name.endswith(".cxx"):
            for class_ in set(MEMBER.findall(text)):
                sources.setdefault(class_, set()).add(name)
        if CAST_DOWN.search(text):
            problems.append(f"{room}/{name} casts a device down; ask it by a virtual method")
        graph[name] = [other for other in includes(path) if other in files]
        for other in graph[name]:
            there = files[other][0]
            known = any((there + "/").startswith(room_ + "/") for room_ in (room, *KNOWS[room]))
            if not known:
                problems.append(f"{room}/{name} includes {there}/{other}, which lies above it")
    problems += [f"ARCHITECTURE.md names {name}, which is not there" for name in unknown_names(root)]
    for class_, names in sources.items():
        if len(names) > SOURCES.get(class_, 1):
            problems.append(f"{class_} lies in {', '.join(sorted(names))}; several files are several classes")
    done = set()

    def visit(name, way):
        if name in way:
            problems.append("a cycle: " + " -> ".join((*way, name)))
        elif name not in done:
            for other in graph[name]:
                if other.endswith(".h"):
                    visit(other, (*way, name))
            done.add(name)

    for name in graph:
        visit(name, ())
    print("\n".join(problems) or f"{len(files)} files, each in its room")
    return 1 if problems or len(files) < 100 else 0


sys.exit(main(*sys.argv[1:]))
