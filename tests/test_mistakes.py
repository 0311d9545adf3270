"""Mistakes of users, each made on a copy of the shipped files (`mistakes.yaml`): exit code and message."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import fingerpad.csvrows
import fingerpad.scene.yamlfile
from conftest import Project
from fingerpad.cli import FAILED, main
from fingerpad.contact.solution import Solution
from fingerpad.csvrows import checked_rows
from fingerpad.errors import FingerpadError, RatingError, ResultError, SceneError
from fingerpad.perception.ratings import read_published, read_ratings, read_stated_order
from fingerpad.scene.recording import COLUMNS, MOST_TIMES, read_recording
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.store import load, save_arrays
from fingerpad.tissue.mesh import load_section
from literature import CONDITIONS

ROOT = Path(__file__).parents[1]
TABLE: dict[str, Any] = yaml.safe_load((ROOT / "tests" / "mistakes.yaml").read_text(encoding="utf-8"))
MISTAKES: list[dict[str, Any]] = TABLE["mistakes"]
IN_PROCESS = [mistake for mistake in MISTAKES if not mistake["run"].startswith("snakemake")]
IN_WORKFLOW = [mistake for mistake in MISTAKES if mistake["run"].startswith("snakemake")]
LEFT_OUT = ("results", ".snakemake", "__pycache__")  # of a copy
READERS: Mapping[str, Callable[[Path], object]] = {  # what every run of the workflow reads first
    "read_ratings": lambda path: read_ratings(path, CONDITIONS),
    "read_stated_order": lambda path: read_stated_order(path, CONDITIONS),
    "read_published": read_published,
}


def name_of(mistake: Mapping[str, Any]) -> str:
    return str(mistake["mistake"])


def make(mistake: Mapping[str, Any], folder: Path) -> None:
    """Make the mistake in a copy: write whole files, then replace a text in files."""
    for name, text in (TABLE["files"] | mistake.get("write", {})).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    for name, (found, put) in mistake.get("edit", {}).items():
        text = (folder / name).read_text(encoding="utf-8")
        assert found in text, f"{name} does not hold {found}"
        (folder / name).write_text(text.replace(found, put, 1), encoding="utf-8")


def exit_code(command: str) -> int:
    """Run a command of `fingerpad`, or read a table as the workflow does; its exit code."""
    program, *arguments = shlex.split(command)
    try:
        if program == "fingerpad":
            return main(arguments)
        READERS[program](Path(*arguments))
    except FingerpadError as error:
        print(error, file=sys.stderr)
        return 1  # that of Snakemake
    except SystemExit as end:  # of argparse
        assert isinstance(end.code, int)
        return end.code
    return 0


def test_mistakes_are_many_and_differ() -> None:
    assert len(MISTAKES) >= 60
    assert len({name_of(mistake) for mistake in MISTAKES}) == len(MISTAKES)


@pytest.mark.parametrize("mistake", IN_PROCESS, ids=name_of)
def test_mistake(
    mistake: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for part in ("config", "data", "workflow/schemas"):
        shutil.copytree(ROOT / part, tmp_path / part)
    make(mistake, tmp_path)
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    code = exit_code(mistake["run"])
    said = capsys.readouterr().err
    assert [part for part in mistake["says"] if part not in said] == [], said
    assert code == mistake["exit"]
    assert "Traceback" not in said
    assert sorted(tmp_path.rglob("*")) == before  # nothing is written, and nothing that is written there is run


@pytest.mark.workflow
@pytest.mark.parametrize("mistake", IN_WORKFLOW, ids=name_of)
def test_mistake_in_a_call_of_snakemake(mistake: dict[str, Any], project: Project, tmp_path: Path) -> None:
    copy = Project(tmp_path / "copy")
    shutil.copytree(project.folder, copy.folder, ignore=shutil.ignore_patterns(*LEFT_OUT))
    make(mistake, copy.folder)
    run = copy.snakemake(*shlex.split(mistake["run"])[1:])
    assert [part for part in mistake["says"] if part not in run.text] == [], run.text
    assert run.status == mistake["exit"]
    assert "Traceback (most recent call last)" not in run.text
    assert not run.jobs


# What a table cannot hold: sizes, and files that are no text


def test_sizes_are_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    device, table = tmp_path / "device.yaml", tmp_path / "tap.csv"
    rows = "".join(f"{time},1,0,0\n" for time in range(MOST_TIMES + 1))
    table.write_text(f"{','.join(COLUMNS)}\n{rows}", encoding="utf-8")
    with pytest.raises(SceneError, match=f"found more than {MOST_TIMES} times; allowed: at most {MOST_TIMES}"):
        read_recording(table, 1)
    monkeypatch.setattr(fingerpad.csvrows, "LARGEST_FILE", 1000)
    with pytest.raises(RatingError, match="bytes; allowed: at most 1000"):
        read_published(table)
    for text, part in (
        ("title: " + "[" * 2000, "nested too deeply"),
        ("title: " + "9" * 5000, "line 1, column 8: found a number of 5000 digits"),
    ):
        device.write_text(text, encoding="utf-8")
        with pytest.raises(SceneError, match=part):
            read_yaml(device)
    monkeypatch.setattr(fingerpad.scene.yamlfile, "LARGEST_FILE", 1000)
    with pytest.raises(SceneError, match="bytes; allowed: at most 1000"):
        read_yaml(device)


def test_the_line_is_named_whose_letters_are_not_utf8(tmp_path: Path) -> None:
    """As spreadsheets save them; far behind what a file is read in at once."""
    path = tmp_path / "tap.csv"
    rows = [",".join(COLUMNS), *(f"{time},1,0,0" for time in range(5000)), "5000,1,0,0 \N{MICRO SIGN}m"]
    path.write_bytes("\n".join(rows).encode("latin-1"))
    with pytest.raises(SceneError, match=r"tap\.csv, line 5002: found a byte 0xb5 .*; save it as CSV UTF-8"):
        read_recording(path, 1)


class Command:
    """What runs a command when it is unpickled."""

    def __reduce__(self) -> tuple[Callable[[str], object], tuple[str]]:
        return os.system, ("touch ran",)


def test_results_are_read_without_pickles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "solution.npz"
    np.savez(path, **{name: np.array([Command()]) for name in ("nodes", "triangles", *Solution.__annotations__)})  # type: ignore[arg-type]
    for read in (lambda: load(path, Solution), lambda: load_section(path)):
        with pytest.raises(ResultError, match=r"solution\.npz: is not what fingerpad writes there.*; remove it"):
            read()
    with pytest.raises(ValueError, match="allow_pickle"):
        save_arrays(path, {"time": np.array([Command()])})
    assert not (tmp_path / "ran").exists()


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"no archive", b"\x80\x04."])
def test_results_that_are_none_are_named(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mesh.npz"
    path.write_bytes(content)
    with pytest.raises(ResultError, match=r"mesh\.npz: is not what fingerpad writes there"):
        load_section(path)


def test_names_in_shells_are_refused_by_the_command_itself() -> None:
    """As a process: exit code and standard error are those that a shell sees."""
    command = [sys.executable, "-m", "fingerpad.cli", "new", "$(touch ran)", "--from", "device2"]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    done = subprocess.run(command, cwd=ROOT / "config", env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == FAILED
    assert done.stderr.startswith("fingerpad: NAME: found $(touch ran); allowed: small letters")
    assert done.stdout == ""


def test_the_line_of_a_row_counts_those_within_quotes(tmp_path: Path) -> None:
    """A cell may hold lines of its own; the line that is named is the one on which its row ends."""
    path = tmp_path / "own.csv"
    path.write_text('name,source\na,"one\ntwo\nthree"\n\nb,four\n', encoding="utf-8")
    assert [line for line, _ in checked_rows(path, ["name", "source"], RatingError)] == [4, 6]
