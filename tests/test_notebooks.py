"""Notebooks: stored without outputs, named by a rule, and (in the workflow tests) executed on real results."""

from __future__ import annotations

import os
import re
import runpy
from pathlib import Path
from typing import NoReturn
from unittest.mock import MagicMock

import nbformat
import pytest

from conftest import Project

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_valid_and_stored_without_outputs(path: Path) -> None:
    """No output, no execution count, no time stamp: a diff shows what was written, not what was run."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert cells
    assert all(not cell.outputs and cell.execution_count is None and not cell.metadata for cell in cells)


def test_every_job_has_a_folder_of_its_own_for_ipython(monkeypatch: pytest.MonkeyPatch) -> None:
    """Jobs run beside each other, and IPython keeps a database there. Afterwards it is gone."""
    folders = []

    def stop(*given: object, **named: object) -> NoReturn:
        folders.append(Path(os.environ["IPYTHONDIR"]))
        assert folders[-1].is_dir()
        raise InterruptedError

    monkeypatch.setenv("IPYTHONDIR", "")
    monkeypatch.setenv("SCENES", "")  # both are set for the rest of the process
    monkeypatch.setattr(nbformat, "read", stop)
    for _ in range(2):
        with pytest.raises(InterruptedError):
            runpy.run_path("workflow/scripts/notebook.py", {"snakemake": MagicMock()}, "__main__")
    assert len(set(folders)) == 2
    assert not any(folder.exists() for folder in folders)


@pytest.mark.workflow
def test_every_notebook_is_executed_and_rendered(changeable: Project) -> None:
    """A failing cell fails its job. Tables that nobody has made are named with their target. A page loads nothing."""
    run = changeable.snakemake("notebooks")
    assert run.status == 0, run.text
    pages = {path.stem: path.read_text(encoding="utf-8") for path in changeable.folder.glob("results/notebooks/*.html")}
    assert set(pages) == {path.stem for path in NOTEBOOKS}
    for target in ("honesty", "accuracy", "benchmark"):
        assert f"snakemake {target}" in pages["accuracy_and_run_time"]
    assert not [name for name, page in pages.items() if re.search(r"<script[^>]*\bsrc=|unpkg", page)]
