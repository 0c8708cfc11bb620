"""The notebooks run from top to bottom, and their verdicts are what they say."""

import os
import pathlib

import nbformat
import pytest
from nbconvert.preprocessors import ExecutePreprocessor

TUTORIALS = pathlib.Path(os.environ["GAMUT_SOURCE_DIR"]) / "docs/tutorials"


@pytest.mark.parametrize("path", sorted(TUTORIALS.glob("*.ipynb")), ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.outputs for cell in notebook.cells if cell.cell_type == "code"), "kept without its outputs"
    ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(tmp_path)}})
    said = "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", ()))
    assert "stay inside the guaranteed enclosure" in said
    assert list(tmp_path.glob("*.h5")) and list(tmp_path.glob("*.html"))

