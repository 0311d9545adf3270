"""Jobs of the workflow: what they are given, and how they end."""

from __future__ import annotations

import re
import runpy
from inspect import signature
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn, cast
from unittest.mock import MagicMock

import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from fingerpad.errors import CriterionError, SceneError
from fingerpad.jobs import Job, run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.unchanged import VARIABLE, begun, remember

SCRIPTS = Path(__file__).parents[1] / "workflow" / "scripts"
RULES = SCRIPTS.parent / "rules"
NAMED = ("input", "output", "params")
SOLVING = (
    *("benchmark_growth", "benchmark_ladder", "benchmark_steps", "calculix", "skipping"),  # take all cores
    *("closed_forms", "ensemble_member", "fields", "increments", "readouts", "reference"),
)


def job_of(folder: Path, **named: dict[str, Any]) -> Job:
    """A job that logs in a folder, and has what is named of each kind."""
    kinds = {kind: named.get(kind, {}) for kind in (*NAMED, "wildcards")}
    return cast(Job, SimpleNamespace(**kinds, threads=2, log=[str(folder / "job.log")]))


def test_an_expected_error_is_its_message_alone(tmp_path: Path) -> None:
    """In the log and as what Python prints at its end, with status 1; of any other the log has the traceback."""

    def refuse() -> None:
        raise CriterionError("too wide")

    def fail() -> None:
        raise ZeroDivisionError("by nothing")

    job = job_of(tmp_path)
    with pytest.raises(SystemExit, match=r"^fingerpad: too wide$"):
        run(refuse, job)
    log = tmp_path / "job.log"
    assert log.read_text(encoding="utf-8") == "too wide\n"
    with pytest.raises(ZeroDivisionError):
        run(fail, job)
    said = log.read_text(encoding="utf-8")
    assert said.startswith("too wide\nTraceback ")
    assert said.endswith("ZeroDivisionError: by nothing\n")


@pytest.mark.parametrize("when", ["before", "meanwhile"])
def test_a_job_ends_where_scene_files_have_changed_since_its_run_began(
    when: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In their values, that is, and not in comments."""
    device, table = tmp_path / "pins.yaml", tmp_path / "tap.csv"
    device.write_text("count: {value: 2}\n", encoding="utf-8")
    table.write_text("time\n", encoding="utf-8")
    monkeypatch.setenv(VARIABLE, "")
    remember(begun([device, table]))
    job = job_of(tmp_path, input={"device": str(device), "recordings": [str(table)], "mesh": "mesh.npz"})
    run(lambda: None, job)
    device.write_text("count: {value: 2}  # two\n", encoding="utf-8")
    run(lambda: None, job)

    def edit() -> None:
        table.write_text("time\n1\n", encoding="utf-8")

    if when == "before":
        edit()
    with pytest.raises(SystemExit, match=r"tap\.csv: has changed since this run began; run again"):
        run(edit, job)
    table.write_text("time\n", encoding="utf-8")
    device.write_text("count: {value: 3}\n", encoding="utf-8")
    with pytest.raises(SystemExit, match=r"pins\.yaml: has changed since this run began"):
        run(lambda: None, job)


def test_a_script_gets_what_its_rule_names(tmp_path: Path) -> None:
    """As its annotations say: paths, lists of them, none where there is no file, members of enumerations, also in
    tuples.
    """
    given: dict[str, object] = {}

    def main(
        device: Path,
        solutions: list[Path],
        body: Path | None,
        pressed: Path | None,
        kinematics: Kinematics,
        cases: list[tuple[str, Kinematics]],
        repeats: dict[str, int],
        threads: int,
        scores: Path,
    ) -> None:
        given.update(locals())

    files = {"device": "config/devices/pins.yaml", "solutions": ["a.npz"], "body": [], "pressed": "pressed.npz"}
    run(
        main,
        job_of(
            tmp_path,
            input=files,
            output={"scores": "scores.csv"},
            wildcards={"kinematics": "finite", "device": "pins"},  # a file goes before what its name has
            params={"cases": [("pins", "small")], "repeats": {"small": 3}, "code": "0123"},
        ),
    )
    assert {name: given[name] for name in main.__annotations__ if name != "return"} == {
        "device": Path("config/devices/pins.yaml"),
        "solutions": [Path("a.npz")],
        "body": None,
        "pressed": Path("pressed.npz"),
        "kinematics": Kinematics.FINITE,
        "cases": [("pins", Kinematics.SMALL)],
        "repeats": {"small": 3},
        "threads": 2,
        "scores": Path("scores.csv"),
    }


@pytest.mark.parametrize(
    ("names", "count"), [({}, 0), ({"input": {"scores": "a.csv"}, "output": {"scores": "b.csv"}}, 2)]
)
def test_a_name_that_a_rule_does_not_have_once_is_an_error(
    names: dict[str, dict[str, str]], count: int, tmp_path: Path
) -> None:
    def main(scores: Path) -> None:
        raise AssertionError(scores)

    with pytest.raises(TypeError, match=f"asks for scores; its rule has {count} of these"):
        run(main, job_of(tmp_path, **names))
    assert "asks for scores" in (tmp_path / "job.log").read_text(encoding="utf-8")


def test_every_script_is_run_as_a_job() -> None:
    for script in SCRIPTS.glob("*.py"):
        assert script.read_text(encoding="utf-8").endswith("    run(main, snakemake)\n"), script.name


def asked(script: str) -> dict[str, Any]:
    """Parameters of a script's main function, with their annotations."""
    main = runpy.run_path(str(SCRIPTS / f"{script}.py"))["main"]
    return {name: parameter.annotation for name, parameter in signature(main).parameters.items()}


def sections(rule: str) -> dict[str, str]:
    """Texts of a rule's sections, as it is written."""
    parts = re.split(r"^ +(\w+):(?:\n|(?= ))", rule, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


@pytest.mark.parametrize("rules", sorted(RULES.glob("*.smk")), ids=lambda path: path.stem)
def test_every_rule_names_once_what_its_script_asks_for(rules: Path) -> None:
    """So that no rule fails after hours."""
    shared = re.findall(r"^(\w+) = \{\n((?: +\".*\n)+)\}", (RULES / "common.smk").read_text("utf-8"), re.MULTILINE)
    text = rules.read_text(encoding="utf-8")
    for name, entries in shared:  # as they would be written in the rule
        text = text.replace(f"        **{name},\n", re.sub(r'"(\w+)": ', r"\1=", entries))
    for rule in re.split(r"^ *rule (?=\w+:)", text, flags=re.MULTILINE)[1:]:
        written = sections(rule)
        if script := re.search(r"scripts/(\w+)\.py", written.get("script", "")):
            names = [re.findall(r"^ +(\w+)=", written.get(kind, ""), re.MULTILINE) for kind in NAMED]
            wildcards = re.findall(r"\{(\w+)\}", written["output"])
            for name in asked(script[1]):
                has = sum(name in each for each in names)
                assert has == 1 or (has == 0 and name in {*wildcards, "threads"}), f"{rule.partition(':')[0]}: {name}"


def said(script: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """What the log of a script holds that finds a bad scene: the threads of the matrix libraries at that time."""

    def refuse(*given: object) -> NoReturn:
        raise SceneError(f"threads: {sorted({library['num_threads'] for library in threadpool_info()})}")

    monkeypatch.chdir(folder)
    monkeypatch.setattr("fingerpad.scene.scenefile.load_scene", refuse)
    monkeypatch.setattr("fingerpad.ensemble.alternatives.read_ensemble", refuse)
    monkeypatch.setattr("fingerpad.store.read_rows", lambda path: [])
    monkeypatch.setattr("fingerpad.calculix.run.installed", lambda: True)
    stand_ins = {
        Path: "one",
        list[Path]: ["one"],
        list[tuple[str, ...]]: [("one",)],
        Kinematics: "small",
        list[Kinematics]: ["small"],
    }
    given = {name: stand_ins.get(annotation, MagicMock()) for name, annotation in asked(script).items()}
    job = job_of(folder, input=given)
    with threadpool_limits(2), pytest.raises(SystemExit, match=r"^fingerpad: threads: "):
        runpy.run_path(str(SCRIPTS / f"{script}.py"), {"snakemake": job}, "__main__")
    return (folder / "job.log").read_text(encoding="utf-8").strip()


@pytest.mark.parametrize("script", SOLVING)
def test_jobs_that_solve_compute_on_one_thread_and_end_at_an_expected_error(
    script: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert said(script, tmp_path, monkeypatch) == "threads: [1]"
