"""Writes type stubs of the compiled modules of vtkhaptics, for editors and type checkers.

usage: python_stubs.py OUTPUT_FOLDER MODULE...

VTK's own generator does the work. It names classes of other modules without their module, which no
checker can resolve: those names are completed here, and their modules imported.
"""

import os
import re
import sys

import vtkhaptics  # noqa: F401, loads the modules of VTK that the classes come from
from vtkmodules import generate_pyi


def modules_of_classes():
    """From the name of each class that is loaded to the module that it is of."""
    return {
        name: module.__name__
        for module in list(sys.modules.values())
        if re.match(r"(vtkmodules|vtkhaptics)\.vtk\w+$", getattr(module, "__name__", ""))
        for name, value in vars(module).items()
        if isinstance(value, type) and value.__module__ == module.__name__
    }


def complete(text, own_module, homes):
    """The text of a stub with every class named so that it can be found."""
    needed = set()

    def qualified(match):
        home = homes.get(match[1])
        if home is None:
            return "'Any'"  # a class that VTK does not wrap
        if home == own_module:
            return match[0]
        needed.add(home)
        return f"'{home}.{match[1]}'"

    text = re.sub(r"'(vtk\w+)'", qualified, text)
    missing = sorted(home for home in needed if f"import {home}\n" not in text)
    return text.replace("\nclass ", "".join(f"\nimport {m}" for m in missing) + "\n\nclass ", 1)


def main(folder, *modules):
    generate_pyi.main(["generate_pyi", "-p", "vtkhaptics", "-o", folder, *modules])
    homes = modules_of_classes()
    for module in modules:
        path = os.path.join(folder, module + ".pyi")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(complete(text, f"vtkhaptics.{module}", homes))


main(*sys.argv[1:])
