"""Writes type stubs of the compiled modules of vtkhaptics, for editors and type checkers.

usage: python_stubs.py OUTPUT_FOLDER MODULE...

VTK's own generator does the work. It names classes of other modules without their module, which no
checker can resolve: those names are completed here, and their modules imported. What the package adds
to its classes (vtkhaptics.classes) is added too, and arrays are taken for vectors.

Where VTK has come without stubs of its own, as Debian's has, those of the modules that are needed are
written to vtkmodules-stubs next to OUTPUT_FOLDER, where checkers look for them (PEP 561).
"""

import os
import re
import sys

import vtkhaptics  # noqa: F401, loads the modules of VTK that the classes come from
import vtkmodules
from vtkhaptics.classes import CLASSES, OUTPUTS
from vtkmodules import generate_pyi

# Classes of VTK override methods with other parameters, and overload what checkers take for the same.
QUIRKS = '# mypy: disable-error-code="override, overload-cannot-match"\n'
VECTOR = """
Vector = Union[Sequence[float], numpy.typing.NDArray[Any]]
"""
PACKAGE = """from typing import List

from .device import HapticDevice as HapticDevice, share as share
from .errors import HapticsError as HapticsError, HapticsWarning as HapticsWarning
from .inline import picture_of as picture_of
from .meshes import polydata as polydata
from .plotting import enable as enable
from .sharing import SharedHand as SharedHand
from .touching import touch as touch
from .tracing import Trace as Trace, trace as trace

__all__: List[str]
__version__: str
"""
OBSERVER = """
    def AddObserver(self, event: Union[int, str], observer: Callable[..., Any], priority: float = 0.0) -> int: ..."""
SCENE = """    def engaged(self, camera: Any = None) -> ContextManager['vtkHapticScene']: ...
"""


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
    imports = "".join(f"\nimport {m}" for m in ["numpy.typing", *missing])
    text = text.replace("\nclass ", imports + "\nfrom typing import ContextManager\n" + VECTOR + "\nclass ", 1)
    return "".join(extend(part) for part in re.split(r"(?m)^(?=class )", text))


def extend(text):
    """The text of a class with what the package adds to it."""
    name = re.match(r"class (\w+)", text)
    if not name:
        return text
    text = text.replace(":Sequence[float]", ":'Vector'")
    text = re.sub(r"(?m)^(class .*:)$", lambda match: match[1] + OBSERVER, text, count=1)
    for method, outputs in OUTPUTS.get(name[1], {}).items():
        text = re.sub(
            rf"    def {method}\(self(.*)\) -> (\w+): \.\.\.\n",
            lambda match: both(method, match[1], match[2], outputs),
            text,
        )
    if name[1] == "vtkHapticScene":
        text = text.rstrip("\n") + "\n" + SCENE + "\n"
    return text


def both(method, parameters, result, outputs):
    """A getter that fills lists, and the one that returns them."""
    inputs = parameters.split(",")[: -len(outputs)] if parameters else []
    returned = [
        "float" if size is None else f"Tuple[{', '.join(['float'] * size)}]" for size in outputs
    ]
    returned = returned[0] if len(returned) == 1 else f"Tuple[{', '.join(returned)}]"
    if result == "bool":
        returned = f"Union[{returned}, None]"
    return (
        f"    @overload\n    def {method}(self{','.join(inputs)}) -> {returned}: ...\n"
        f"    @overload\n    def {method}(self{parameters}) -> {result}: ...\n"
    )


def write_vtk_stubs(folder):
    """Stubs of the modules of VTK that have been loaded, where VTK has none."""
    if os.path.isfile(os.path.join(os.path.dirname(vtkmodules.__file__), "vtkCommonCore.pyi")):
        return
    os.makedirs(folder, exist_ok=True)
    modules = sorted(name.split(".")[1] for name in sys.modules if re.match(r"vtkmodules\.vtk\w+$", name))
    generate_pyi.main(["generate_pyi", "-p", "vtkmodules", "-o", folder, *modules])
    open(os.path.join(folder, "__init__.pyi"), "w", encoding="utf-8").close()
    with open(os.path.join(folder, "py.typed"), "w", encoding="utf-8") as file:
        file.write("partial\n")  # what is not here is looked for in VTK itself


def main(folder, *modules):
    generate_pyi.main(["generate_pyi", "-p", "vtkhaptics", "-o", folder, *modules])
    homes = modules_of_classes()
    package = [PACKAGE]
    for module in modules:
        path = os.path.join(folder, module + ".pyi")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(QUIRKS + complete(text, f"vtkhaptics.{module}", homes))
        names = sorted(name for name in CLASSES if homes[name] == f"vtkhaptics.{module}")
        package.append(f"from .{module} import " + ", ".join(f"{name} as {name}" for name in names))
    with open(os.path.join(folder, "__init__.pyi"), "w", encoding="utf-8") as file:
        file.write("\n".join(package) + "\n")
    write_vtk_stubs(os.path.join(os.path.dirname(os.path.abspath(folder)), "vtkmodules-stubs"))


main(*sys.argv[1:])
