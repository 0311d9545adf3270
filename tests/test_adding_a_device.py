"""`docs/adding-a-device.md` and `docs/extending.md`, followed to the letter: every command is run, every edit made."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from conftest import LONGEST_RUN, ROOT, Job, Project

PAGES = [ROOT / "docs" / name for name in ("adding-a-device.md", "extending.md")]
CASE = ["condition", "interface", "readout"]
# Last digits that pages show: of five in scores, of two in errors. Other kernels move either by far less
ERROR_DIGIT = 0.1  # relative, of a number with an exponent
# `predict` and the workflow's jobs do the same arithmetic; a sum in another order moves a score by far less than this
ROUNDING = 1e-9


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, the file that it is for, if any, and its text."""

    language: str
    file: str
    text: str


def blocks() -> list[Block]:
    """All fenced blocks of the pages, in order."""
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    found = re.findall(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [Block(*each) for each in found]


def assert_printed(shown: str, printed: str) -> None:
    """That a command printed what a page shows, up to the last digits of numbers."""
    number = r"\d+\.\d+(?:e-?\d+)?"
    assert re.sub(rf" *{number}", " #", printed) == re.sub(rf" *{number}", " #", shown)
    for found, said in zip(*(re.findall(number, text) for text in (printed, shown)), strict=True):
        last = {"rel": ERROR_DIGIT} if "e" in said else {"abs": 1.01 * 10.0 ** -len(said.partition(".")[2])}
        assert float(found) == pytest.approx(float(said), **last)


def replaced(text: str, block: str) -> str:
    """A YAML file with its top-level keys replaced by those of a block; what it has not comes behind."""
    for key, section in re.findall(r"^((\w+):.*\n(?:[ #].*\n)*)", block, re.MULTILINE):
        text, count = re.subn(rf"^{section}:.*\n(?:[ #].*\n)*", lambda _, own=key: own, text, flags=re.MULTILINE)
        text += "" if count else key
    return text


class Reader:
    """Somebody who follows the page in a copy of the project, with its environment activated."""

    def __init__(self, project: Project, tools: Path) -> None:
        self.folder = project.folder
        for name, module in (("fingerpad", "fingerpad.cli"), ("snakemake", "snakemake")):
            program = tools / name
            program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m {module} "$@"\n', encoding="utf-8")
            program.chmod(0o755)
        path = os.pathsep.join([str(tools), str(Path(sys.executable).parent), os.environ["PATH"]])
        self.environment = project.environment() | {"PATH": path, "PYTHONPATH": str(self.folder / "src")}

    def follow(self, block: Block) -> str:
        """Do what a block shows; what it printed."""
        path = self.folder / block.file
        if block.language == "yaml":
            path.write_text(replaced(path.read_text(encoding="utf-8"), block.text), encoding="utf-8")
        elif block.language == "csv":
            path.write_text(block.text, encoding="utf-8")
        else:
            commands = {"sh": ["bash", "-e"], "python": [sys.executable, "-"], "diff": ["git", "apply", "-"]}
            return self.run(commands[block.language], block.text)
        return ""

    def run(self, command: list[str], given: str = "") -> str:
        """Run a command in the project's folder; what it printed."""
        done = subprocess.run(
            command,
            input=given,
            cwd=self.folder,
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=LONGEST_RUN,
            check=False,
        )
        assert done.returncode == 0, f"{given or command}\n{done.stdout}{done.stderr}"
        return done.stdout

    def table(self, name: str) -> pd.DataFrame:
        """Rows of `mydevice` in a table of results."""
        table = pd.read_csv(self.folder / "results" / f"{name}.csv")
        return table[table["device"] == "mydevice"]


def assert_recording_matters(project: Project) -> None:
    """What an edit of a recording would compute again: its own device alone, and its own condition's solution."""
    name = "config/devices/swipe.csv"
    before = (project.folder / name).read_text(encoding="utf-8")
    project.edit(name, lambda text: text.replace("-0.021", "-0.022"))
    stale = project.snakemake("-n", "all").jobs
    assert {job.device for job in stale} == {None, "measured"}
    solved = {output for job in stale if job.rule == "solve" for output in job.outputs}
    assert "results/small/measured/swipe/shear/solution.npz" in solved
    assert all(name in inputs(job, project) for job in stale if job.rule == "solve")
    project.edit(name, lambda text: before)


def inputs(job: Job, project: Project) -> set[str]:
    """Names of a job's inputs, relative to the project."""
    return {each.removeprefix(f"{project.folder}/") for each in job.inputs}


@pytest.mark.workflow
def test_the_page_does_what_it_says(changeable: Project, tmp_path: Path) -> None:
    reader = Reader(changeable, tmp_path)
    shipped = changeable.files("results/small/device2")
    printed: dict[str, str] = {}
    said = ""
    for block in blocks():
        if block.language == "text":
            assert_printed(block.text, said)
            continue
        said = reader.follow(block)
        printed[block.text] = said
        if block.text == "snakemake all\n":  # ratings follow later on the page
            correlations = reader.table("correlations")
            assert (correlations["n"] == 0).all()
            assert set(correlations["note"]) == {"no ratings"}
        if "ratings.csv" in block.text:
            assert_recording_matters(changeable)

    predicted = printed["fingerpad predict config/devices/mydevice.yaml\n"]
    scores = reader.table("scores")
    assert len(scores) == 3 * 2 * 2
    for name in scores["condition"]:
        assert f"\n{name} " in predicted
    assert (scores["score_error"] > 0.0).all()
    pressed = np.load(reader.folder / "results/small/mydevice/alternate_000/shear/solution.npz")["indentation"]
    assert f"{pressed:.2f} mm here" in PAGES[0].read_text(encoding="utf-8")
    given = printed[next(block.text for block in blocks() if block.language == "python")]
    assert "alternate_090" in given

    rows = reader.run(["fingerpad", "predict", "--csv", "config/devices/mydevice.yaml"])
    (tmp_path / "predicted.csv").write_text(rows, encoding="utf-8")
    both = scores.merge(pd.read_csv(tmp_path / "predicted.csv"), on=CASE, validate="1:1")
    for column in ("score", "score_error"):
        assert both[f"{column}_x"].to_numpy() == pytest.approx(both[f"{column}_y"].to_numpy(), rel=ROUNDING)

    correlations = reader.table("correlations")
    assert (correlations["n"] == 3).all()
    assert set(correlations["rating_kind"]) == {"measured"}
    figures = {path.name for path in (reader.folder / "results" / "figures").iterdir()}
    assert {"map_small_mydevice-alternate.png", "map_small_measured-measured.pdf"} <= figures
    assert (reader.folder / "mydevice.png").stat().st_size > 0
    assert "swipe" in printed["fingerpad predict config/devices/measured.yaml\n"]
    (sprung,) = (said for text, said in printed.items() if "sprung.yaml" in text and "predict" in text)
    assert "alternate_180" in sprung
    assert (reader.folder / "results" / "decks" / "single_actuator_1.inp").stat().st_size > 0
    now = changeable.files("results/small/device2")
    assert {name: now[name] for name in shipped} == shipped  # nothing of another device was computed again
