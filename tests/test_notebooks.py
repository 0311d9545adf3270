"""Notebooks: stored without outputs, named by a rule, and (in the workflow tests) executed on real results."""

from __future__ import annotations

import html
import os
import re
import runpy
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import NoReturn

import nbformat
import pytest
from mypy import api as mypy
from nbclient import NotebookClient

from conftest import Project, Run, into

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
    files = {"notebook": "one.ipynb", "config": "config/config.yaml", "page": "one.html"}
    job = SimpleNamespace(input=files, output={}, params={}, wildcards={}, threads=1, log=[])
    for _ in range(2):
        with pytest.raises(InterruptedError):
            runpy.run_path("workflow/scripts/notebook.py", {"snakemake": job}, "__main__")
    assert len(set(folders)) == 2
    assert not any(folder.exists() for folder in folders)


def test_calls_in_notebooks_fit_the_library(tmp_path: Path) -> None:
    """Also those for which there are no results when notebooks are executed."""
    for path in NOTEBOOKS:
        cells = (cell.source for cell in nbformat.read(path, as_version=4).cells if cell.cell_type == "code")
        (tmp_path / f"{path.stem}.py").write_text("\n".join(cells), encoding="utf-8")
    found, _, failed = mypy.run(["--allow-untyped-calls", "--allow-untyped-defs", str(tmp_path)])
    assert not failed, found


def said(page: str) -> str:
    """The words of a page, without its markup."""
    return html.unescape(re.sub(r"<[^>]+>", "", page))


def rendered(run: Run) -> set[str]:
    """The pages that a run renders, or in a dry run would render."""
    return {Path(output).stem for job in run.jobs if job.rule == "notebook" for output in job.outputs}


@pytest.mark.workflow
def test_every_notebook_is_executed_and_rendered(changeable: Project) -> None:
    """A failing cell fails its job. Tables that nobody has made are named with their target. A page loads nothing. Once
    there is another table, what shows it is rendered again; and the table itself, which takes hours, not made anew.
    """
    run = changeable.snakemake("notebooks")
    assert run.status == 0, run.text
    assert "eavesdropping" not in run.text  # of kernels that speak in plain text
    pages = {path.stem: path.read_text(encoding="utf-8") for path in changeable.folder.glob("results/notebooks/*.html")}
    assert set(pages) == {path.stem for path in NOTEBOOKS}
    for target in ("honesty", "accuracy", "benchmark"):
        assert f"snakemake {target}" in pages["accuracy_and_run_time"]
    assert "Device 2: lateral pins: alternate_180, shear" in said(pages["walkthrough"])
    assert "<title>From a finger's section to a roughness score</title>" in pages["walkthrough"]
    assert not [name for name, page in pages.items() if re.search(r"<script[^>]*\bsrc=|unpkg", page)]
    table = changeable.folder / "results/benchmark/graph.csv"
    table.parent.mkdir()
    for text in ("repeat,ratio\n1,1.5371\n", "repeat,ratio\n1,1.6382\n"):
        table.write_text(text, encoding="utf-8")
        run = changeable.snakemake("notebooks")
        assert run.status == 0, run.text
        assert rendered(run) == {"accuracy_and_run_time"}
        assert {job.rule for job in run.jobs} == {"notebook", "notebooks"}
        page = (changeable.folder / "results/notebooks/accuracy_and_run_time.html").read_text(encoding="utf-8")
        assert text.split(",")[-1].strip() in said(page)
    assert not changeable.snakemake("notebooks").jobs


@pytest.fixture
def other_scenes(coarse_scenes: Path, tmp_path: Path) -> Path:
    """One device, which is not Device 2, of other phases, slippery, and read on the other side."""
    scenes = Project(shutil.copytree(coarse_scenes, tmp_path / "scenes"))
    device = "devices/device2.yaml"
    scenes.edit(device, lambda text: text.replace("value: [0, 90, 180]", "value: [0, 150, 120]"))
    scenes.edit(device, lambda text: text.replace("Device 2: lateral pins", r"Pins of $\\phi$ and 1 $"))
    (scenes.folder / device).rename(scenes.folder / "devices/own.yaml")
    scenes.edit("config.yaml", lambda text: text.replace("side: {value: dermis", "side: {value: epidermis"))
    scenes.edit("config.yaml", lambda text: text.replace("friction: {value: 0.6", "friction: {value: 0.9"))
    return scenes.folder


@pytest.mark.workflow
def test_notebooks_follow_the_scenes(
    project: Project, other_scenes: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those that show them claim nothing that holds for the shipped scenes alone; the cone of friction is in view."""
    asked = "walkthrough", "fields", "ablations"
    run = project.snakemake(*(f"results/notebooks/{name}.html" for name in asked), *into(tmp_path, other_scenes))
    assert run.status == 0, run.text
    assert rendered(run) == set(asked)
    pages = {name: said((tmp_path / f"results/notebooks/{name}.html").read_text("utf-8")) for name in rendered(run)}
    for name in ("walkthrough", "fields"):
        assert r"Pins of $\phi$ and 1 $: alternate_120, shear" in pages[name]
        assert "lateral pins:" not in pages[name]
    assert "as configured: maximum principal strain, epidermis side" in pages["ablations"]
    walkthrough = nbformat.read(project.folder / "notebooks/walkthrough.ipynb", as_version=4)
    (cone,) = (cell for cell in walkthrough.cells if "Coulomb's cone" in cell.source)
    cone.source += "\nprint(axis.get_ylim()[1])"
    monkeypatch.setenv("SCENES", str(other_scenes))
    NotebookClient(walkthrough, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert 0.9 < float(cone.outputs[0].text) < 1.5
