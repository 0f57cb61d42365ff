"""Every class and method has its place in the type stubs, and everything public its docstring."""

import ast
import importlib.util
import inspect
import os
import pkgutil
import sys

import vtkhaptics

FOLDER = os.path.dirname(vtkhaptics.vtkHapticsScene.__file__)
MODULES = ("vtkHapticsFilters", "vtkHapticsDevices", "vtkHapticsScene", "vtkHapticsView")


def test_stubs_are_whole():
    all_stubs = {}
    for name in MODULES:
        with open(os.path.join(FOLDER, name + ".pyi"), encoding="utf-8") as file:
            tree = ast.parse(file.read())
        imported = {a.name for n in tree.body if isinstance(n, ast.Import) for a in n.names}
        stubs = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        all_stubs.update(stubs)
        module = importlib.import_module("vtkhaptics." + name)
        for class_name, class_ in inspect.getmembers(module, inspect.isclass):
            if class_.__module__ != module.__name__:
                continue
            has = {getattr(node, "name", None) for node in stubs[class_name].body}
            for method, value in vars(class_).items():
                if callable(value) and not method.startswith("_") and not inspect.isclass(value):
                    assert method in has, f"{name}.pyi: {class_name}.{method} is missing"
        for node in ast.walk(tree):
            text = node.value if isinstance(node, ast.Constant) else None
            if isinstance(text, str) and "." in text:
                home, _, class_name = text.rpartition(".")
                assert home in imported, f"{name}.pyi: {home} is not imported"
                assert hasattr(importlib.import_module(home), class_name), text
    scene = ast.unparse(all_stubs["vtkHapticScene"])
    assert "def EngageInView(self, camera:'vtkmodules.vtkRenderingCore.vtkCamera') -> bool" in (
        scene.replace("camera: ", "camera:")
    ), "a class of another module is named in full"


def test_docstrings():
    for name in MODULES:
        module = importlib.import_module("vtkhaptics." + name)
        for class_name, class_ in inspect.getmembers(module, inspect.isclass):
            if class_.__module__ == module.__name__ and class_name.startswith("vtk"):
                assert class_.__doc__ and " - " in class_.__doc__.splitlines()[0], class_name
    for info in pkgutil.iter_modules([os.path.dirname(vtkhaptics.__file__)]):
        if info.name.startswith("vtk") or info.name == "__main__":
            continue
        if info.name == "paraview" and not importlib.util.find_spec("paraview"):
            continue
        module = importlib.import_module("vtkhaptics." + info.name)
        assert module.__doc__, info.name
        for name, value in vars(module).items():
            ours = getattr(value, "__module__", None) == module.__name__
            if ours and not name.startswith("_") and (inspect.isfunction(value) or inspect.isclass(value)):
                assert value.__doc__, f"{info.name}.{name}"


test_docstrings()
if not os.path.isfile(os.path.join(FOLDER, "vtkHapticsScene.pyi")):
    print("skipped: there are no stubs, as this VTK has no generator (Debian's VTK 9.1)")
    sys.exit(77)
test_stubs_are_whole()
