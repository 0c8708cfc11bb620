"""Sphinx's configuration of the site; build.py calls it with the folder of Doxygen's XML in the environment."""

import os

project = "Gamut"
author = "the authors of Gamut"
version = release = os.environ["GAMUT_VERSION"]
language = "en"

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page of many small entries goes from the first level to the third

breathe_projects = {"gamut": os.environ["GAMUT_DOXYGEN"]}
breathe_default_project = "gamut"

smartquotes = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"
add_module_names = False

html_theme = "furo"
html_title = "Gamut"
html_extra_path = [os.environ["GAMUT_REPORTS"]]
html_copy_source = False
html_show_sphinx = False


def code_of_docstrings(_app, _what, _name, _object, _options, lines):
    """What is indented in a docstring, behind an empty line, is code."""
    for i in range(len(lines) - 1, 0, -1):
        before = [line for line in lines[:i] if line.strip()]
        if lines[i].startswith("    ") and not lines[i - 1].strip() and before and not before[-1].startswith(" "):
            lines[i:i] = ["::", ""]


def setup(app):
    app.connect("autodoc-process-docstring", code_of_docstrings)
