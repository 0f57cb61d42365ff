"""Each room of the sources includes only rooms before it, and no header includes itself in the end.

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
}


def room_of(folder):
    """The room that a folder is or lies in."""
    while folder not in KNOWS and folder:
        folder = os.path.dirname(folder)
    return folder


def includes(path):
    """The names of the project's headers that a file includes."""
    with open(path, encoding="utf-8") as file:
        return [os.path.basename(name) for name in re.findall(r'#include "([^"]+)"', file.read())]


def main(root):
    """Prints what is wrong; returns the exit status."""
    files = {}
    for top in ("Filters", "Devices", "Interactors"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            room = room_of(os.path.relpath(folder, root))
            for name in names:
                if name.endswith((".h", ".cxx")) and "Template" not in folder and room:
                    files[name] = (room, os.path.join(folder, name))
    problems = []
    graph = {}
    for name, (room, path) in files.items():
        graph[name] = [other for other in includes(path) if other in files]
        for other in graph[name]:
            there = files[other][0]
            known = any((there + "/").startswith(room_ + "/") for room_ in (room, *KNOWS[room]))
            if not known:
                problems.append(f"{room}/{name} includes {there}/{other}, which lies above it")
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
