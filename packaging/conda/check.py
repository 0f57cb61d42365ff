"""Reads and renders recipe.yaml as rattler-build does: `pip install py-rattler-build` first.

The build itself needs conda-forge's packages.
"""

import pathlib
import sys

import rattler_build

path = pathlib.Path(__file__).with_name("recipe.yaml")
recipe = rattler_build.Stage0Recipe.from_yaml(path.read_text(encoding="utf-8"))
variants = rattler_build.VariantConfig(
    {"python": ["3.12"], "c_compiler": ["gcc"], "cxx_compiler": ["gxx"], "c_stdlib": ["sysroot"]}
)
rendered = recipe.render(variants)
for variant in rendered:
    package = variant.recipe.package
    print(f"recipe.yaml: {package.name} {package.version} renders")
sys.exit(not rendered)
