"""Jobs of the workflow: how they end."""

from __future__ import annotations

import re
import runpy
from pathlib import Path
from typing import NoReturn
from unittest.mock import MagicMock

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from fingerpad.errors import CriterionError, SceneError
from fingerpad.jobs import logged

SCRIPTS = Path(__file__).parents[1] / "workflow" / "scripts"
SOLVING = ("closed_forms", "ensemble_member", "fields", "increments", "readouts", "reference")
ALONE = ("benchmark_growth", "benchmark_ladder", "benchmark_steps", "calculix", "skipping")  # take all cores


def test_an_expected_error_is_its_message_alone(tmp_path: Path) -> None:
    """In the log and as what Python prints at its end, with status 1; of any other the log has the traceback."""
    log = tmp_path / "solve.log"
    with pytest.raises(SystemExit, match=r"^fingerpad: too wide$"), logged([str(log)]):
        raise CriterionError("too wide")
    assert log.read_text(encoding="utf-8") == "too wide\n"
    with pytest.raises(ZeroDivisionError), logged([str(log)]):
        raise ZeroDivisionError("by nothing")
    said = log.read_text(encoding="utf-8")
    assert said.startswith("too wide\nTraceback ")
    assert said.endswith("ZeroDivisionError: by nothing\n")


def test_every_script_says_in_its_log_why_it_failed() -> None:
    for script in SCRIPTS.glob("*.py"):
        job = script.read_text(encoding="utf-8").partition('if __name__ == "__main__":')[2]
        assert re.search(r"with .*logged\(job\.log\).*:\n {8}", job), script.name
        assert not re.search(r"^ {4}main\(", job, re.MULTILINE), script.name


def said(script: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """What the log of a script holds that finds a bad scene: the threads of the matrix libraries at that time."""

    def refuse(*given: object) -> NoReturn:
        raise SceneError(f"threads: {sorted({library['num_threads'] for library in threadpool_info()})}")

    monkeypatch.chdir(folder)
    monkeypatch.setattr("fingerpad.scene.scenefile.load_scene", refuse)
    monkeypatch.setattr("fingerpad.ensemble.alternatives.read_ensemble", refuse)
    monkeypatch.setattr("fingerpad.store.read_rows", lambda path: [])
    monkeypatch.setattr("fingerpad.calculix.run.installed", lambda: True)
    job = MagicMock(log=[str(folder / "job.log")])
    job.input.devices = job.input.meshes = job.input.condensed = ["one"]
    job.params.kinematics, job.wildcards.kinematics = ["small"], "small"
    with threadpool_limits(2), pytest.raises(SystemExit, match=r"^fingerpad: threads: "):
        runpy.run_path(str(SCRIPTS / f"{script}.py"), {"snakemake": job}, "__main__")
    return (folder / "job.log").read_text(encoding="utf-8").strip()


@pytest.mark.parametrize("script", SOLVING)
def test_jobs_that_solve_end_at_an_expected_error(script: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert said(script, tmp_path, monkeypatch) == "threads: [2]"


@pytest.mark.parametrize("script", ALONE)
def test_jobs_that_take_all_cores_compute_on_one(script: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert said(script, tmp_path, monkeypatch) == "threads: [1]"
