"""Notebooks: stored without outputs, named by a rule, and (in the workflow tests) executed on real results."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_valid_and_stored_without_outputs(path: Path) -> None:
    """No output, no execution count, no time stamp: a diff shows what was written, not what was run."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert cells
    assert all(not cell.outputs and cell.execution_count is None and not cell.metadata for cell in cells)


def test_there_is_a_walkthrough() -> None:
    """The notebook that `all` renders exists."""
    assert "walkthrough" in [path.stem for path in NOTEBOOKS]
