"""How Sphinx makes the pages of the Python package: see HapticsDocumentation.cmake."""

import vtkhaptics

project = "VTK Haptics"
copyright = "the VTK Haptics authors"
release = vtkhaptics.__version__
extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # shapes and units are in the text
html_theme = "alabaster"
html_theme_options = {"description": "Touch any vtkPolyData with a haptic device", "page_width": "1000px"}
exclude_patterns = ["_build"]
