"""The command `fingerpad`: what it writes and prints, where it finds things, and its exit codes."""

from __future__ import annotations

import argparse
import csv
import errno
import io
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace
from decimal import Decimal
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import yaml
from matplotlib.figure import Figure

import fingerpad.commands.robustness as varying
from conftest import Project, coarsened
from fingerpad.api import forces, predict, vibrate
from fingerpad.arrays import FloatArray
from fingerpad.checkout import find_checkout, model_for
from fingerpad.cli import COMMANDS, FAILED, INTERRUPTED, UNSOLVED, main
from fingerpad.commands.check import described as told_of
from fingerpad.commands.options import variations
from fingerpad.commands.predict import ONE_TABLE
from fingerpad.commands.score_table import _contact, as_table, named
from fingerpad.commands.vibrate import add as add_vibrate
from fingerpad.commands.vibrate import as_table as vibrations
from fingerpad.contact.linear_solution import Indented
from fingerpad.contact.solution import Solution
from fingerpad.errors import ContactError, MeshError, ProcessError, SceneError, UsageError
from fingerpad.prediction import scoring, side_by_side
from fingerpad.prediction.caveats import (
    MANY_CUTS,
    MANY_SEARCHES,
    NO_SUCH_DEPTH,
    TOO_FAR,
    TOO_FAR_OUT,
    TOO_WIDE,
    note_of,
    rival_caveats,
    scene_caveats,
    score_caveats,
    solution_caveats,
    stimulus_caveats,
)
from fingerpad.prediction.forecast import LEFT_OUT, SILENT, forecast, steps
from fingerpad.prediction.orders import orders
from fingerpad.prediction.ranking import RANKS, ranks
from fingerpad.prediction.scoring import Condensed, Meshed, read_solution
from fingerpad.readouts.gabor import filtered_readouts
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import SERIES, roughness_scores
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.device import ActuatorRow, Condition, Control, Device, evenly
from fingerpad.scene.readout import Readout
from fingerpad.scene.recording import read_recording
from fingerpad.scene.scene import Scene
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.sources import Origin, quantities
from fingerpad.scene.template import DRIVES, device_text
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.validation import check_device, checked_document
from fingerpad.scene.variation import shared_out, variants
from fingerpad.tissue.compliance import CondensedBody, CondensedSection
from fingerpad.vibration.forecast import at_frequencies
from scenes import condensed, scene, solve, solved

ROOT = Path(__file__).parents[1]
DEVICES = ROOT / "config" / "devices"
SCHEMAS = ROOT / "workflow" / "schemas"
CONFIG = ROOT / "config" / "config.yaml"
MEASURED = re.sub("^#", "", DRIVES[DRIVES.index("#stimulus") : DRIVES.rindex("# -")], flags=re.MULTILINE)
SHIPPED = ("device1", "device2", "device3")

TOO_DEEP = """
contact:
  criterion: {value: depth, unit: "1", source: "assumption: as deep as is asked"}
  depth: {value: 6.0, unit: mm, source: "assumption: the pad is 5 mm thick"}
"""

# columns of predictions behind those of scores.csv
BEHIND = (*RANKS, "indentation_mm", "force_N_per_mm", "sliding_share", "time", "time_unit", "caveats")


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with what commands look for, in which the test works."""
    for part in ("config", "workflow/schemas"):
        shutil.copytree(ROOT / part, tmp_path / part)
    monkeypatch.chdir(tmp_path)
    # one core alone: what a test puts in place of a function holds in this process
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0})
    return tmp_path


@pytest.fixture
def coarse(checkout: Path) -> Path:
    """The same with a coarse mesh."""
    Project(checkout).edit("config/config.yaml", coarsened)
    return checkout


def on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> io.StringIO:
    """What goes to a terminal as standard error from now on."""
    terminal = io.StringIO()
    terminal.isatty = lambda: True  # type: ignore[method-assign]
    monkeypatch.setattr(sys, "stderr", terminal)
    return terminal


# fingerpad new


@pytest.mark.parametrize("source", SHIPPED)
def test_new_device_has_the_values_of_its_source(checkout: Path, source: str) -> None:
    assert main(["new", "mine", "--from", source]) == 0
    text = (checkout / "config/devices/mine.yaml").read_text(encoding="utf-8")
    found, wanted = yaml.safe_load(text), yaml.safe_load((DEVICES / f"{source}.yaml").read_text(encoding="utf-8"))
    assert found.pop("title")["value"] == "mine"
    wanted.pop("title")
    assert without_sources(found) == without_sources(wanted)
    assert max(map(len, text.splitlines())) < 200
    said, original = (list(quantities(document)) for document in (found, wanted))
    assert [each.origin for each in said] == [Origin.ASSUMPTION] * len(original)
    assert [each.source for each in said] == [
        f"as {source} ({'paper: ' if each.origin is Origin.PAPER else ''}{each.source})" for each in original
    ]
    device = check_device(checkout / "config/devices/mine.yaml", SCHEMAS, CONFIG).device
    assert [c.name for c in device.conditions] == [c.name for c in scene(source).device.conditions]


def without_sources(node: Any) -> Any:
    """A document but for what its values come from."""
    if isinstance(node, dict):
        return {key: without_sources(child) for key, child in node.items() if key != "source"}
    return [without_sources(child) for child in node] if isinstance(node, list) else node


def described(node: Any, schema: dict[str, Any]) -> set[str]:
    """Descriptions in a resolved schema of all keys that a document has."""
    found = set()
    for key, child in node.items() if isinstance(node, dict) else ():
        inner = schema["properties"].get(key)
        inner = inner if isinstance(inner, dict) else schema.get("additionalProperties")
        if isinstance(inner, dict):
            found |= {inner["description"]} if key not in ("value", "unit", "source") else set()
            found |= described(child, inner)
    for child in node if isinstance(node, list) else ():
        found |= described(child, schema["items"]) if isinstance(child, dict) else set()
    return found


@pytest.mark.parametrize("source", SHIPPED)
def test_every_key_is_explained_as_the_schema_does(source: str) -> None:
    document, schema = checked_document(DEVICES / f"{source}.yaml", SCHEMAS / "device.schema.yaml")
    text = device_text("mine", source, document, schema)
    comments = " ".join(re.findall(r"^ *# (.*)$", text, re.MULTILINE))
    wanted = described(document, schema)
    assert len(wanted) > 12
    assert [each for each in wanted if each[1:] not in comments] == []
    assert "unit: mm" in comments


def test_the_drive_in_the_comments_is_valid(checkout: Path) -> None:
    main(["new", "mine", "--from", "device2"])
    path = checkout / "config/devices/mine.yaml"
    kept = path.read_text(encoding="utf-8").partition("# How to change the drive")[0]
    path.write_text(kept + MEASURED, encoding="utf-8")
    rows = "".join(f"1,{k},0.01,0\n" for k in range(1, 5))
    (path.parent / "tap.csv").write_text(f"time,actuator,normal,tangential\n{rows}", encoding="utf-8")
    assert main(["check", str(path)]) == 0
    assert main(["new", "other", "--from", "mine"]) == 0  # beside it, so it has the same recording


def test_lines_in_the_comments_do_what_they_say(checkout: Path) -> None:
    main(["new", "mine", "--from", "device2"])
    path, config = checkout / "config/devices/mine.yaml", checkout / "config/config.yaml"
    assert Kinematics.FINITE in load_scene(config, path).computed
    for key in ("kinematics", "interfaces", "contact"):
        text = path.read_text(encoding="utf-8")
        assert f"#   {key}:" in text
        path.write_text(text.replace(f"#   {key}:", f"{key}:"), encoding="utf-8")
    assert main(["check", str(path)]) == 0
    scene = load_scene(config, path)
    assert scene.computed == (Kinematics.SMALL,)
    assert scene.device.interfaces() == (Interface.SHEAR,)
    assert scene.model.contact.friction == 0.4


def test_new_takes_recordings_along(
    checkout: Path, tmp_path_factory: pytest.TempPathFactory, capsys: pytest.CaptureFixture[str]
) -> None:
    theirs = tmp_path_factory.mktemp("theirs")
    main(["new", "mine", "--from", "device2"])
    document = yaml.safe_load((checkout / "config/devices/mine.yaml").read_text(encoding="utf-8"))
    (theirs / "theirs.yaml").write_text(yaml.safe_dump(document | yaml.safe_load(MEASURED)), encoding="utf-8")
    rows = "".join(f"1,{k},0.01,0\n" for k in range(1, 5))
    (theirs / "tap.csv").write_text(f"time,actuator,normal,tangential\n{rows}", encoding="utf-8")
    assert main(["new", "copied", "--from", str(theirs / "theirs.yaml")]) == 0
    assert (checkout / "config/devices/tap.csv").read_bytes() == (theirs / "tap.csv").read_bytes()
    assert main(["check", "config/devices/copied.yaml"]) == 0
    assert main(["new", "again", "--from", str(theirs / "theirs.yaml")]) == FAILED  # would overwrite tap.csv
    way = f"rename the recording and its `file:` key in {theirs / 'theirs.yaml'}, or remove it"
    assert f"tap.csv: exists already, and is not overwritten; {way}" in capsys.readouterr().err
    assert not (checkout / "config/devices/again.yaml").exists()


def test_new_device_goes_to_a_folder_of_scenes_with_the_model(
    checkout: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The model is copied once, and not over one that is there."""
    assert main(["new", "mine", "--from", "device2", "--scenes", "own"]) == 0
    told = f"  snakemake all --config scenes={(checkout / 'own').resolve()} --directory own_results\n"
    assert told in capsys.readouterr().out
    assert not (checkout / "config/devices/mine.yaml").exists()
    model = checkout / "own/config.yaml"
    assert model.read_bytes() == (checkout / "config/config.yaml").read_bytes()
    model.write_text(model.read_text(encoding="utf-8") + "# own\n", encoding="utf-8")
    assert main(["new", "other", "--from", "own/devices/mine.yaml", "--scenes", "own"]) == 0
    assert model.read_text(encoding="utf-8").endswith("# own\n")
    assert main(["check", "own/devices/other.yaml"]) == 0


def test_new_device_goes_with_the_model_of_the_one_it_comes_from(checkout: Path) -> None:
    """Which may have another finger than the checkout's."""
    main(["new", "mine", "--from", "device2", "--scenes", "own folder"])
    model = checkout / "own folder/config.yaml"
    model.write_text(model.read_text(encoding="utf-8") + "# own\n", encoding="utf-8")
    assert main(["new", "other", "--from", "own folder/devices/mine.yaml", "--scenes", "another"]) == 0
    assert (checkout / "another/config.yaml").read_bytes() == model.read_bytes()


def test_new_says_where_the_workflow_is_if_it_is_elsewhere(
    checkout: Path,
    tmp_path_factory: pytest.TempPathFactory,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """In a folder of the checkout, from which Snakemake would not find it."""
    monkeypatch.chdir(checkout / "config")
    root = checkout.resolve()
    assert main(["new", "mine", "--from", "device2"]) == 0
    told = f"  snakemake all --snakefile {root / 'Snakefile'} --directory {root}\n"
    assert capsys.readouterr().out.endswith(told)
    assert main(["new", "mine", "--from", "device2", "--scenes", "own"]) == 0
    scenes = root / "config" / "own"
    told = f"  snakemake all --snakefile {root / 'Snakefile'} --config scenes={scenes} --directory own_results\n"
    assert capsys.readouterr().out.endswith(told)


def test_titles_that_figures_have_no_letters_for_are_told(
    checkout: Path, capsys: pytest.CaptureFixture[str], recwarn: pytest.WarningsRecorder
) -> None:
    path = checkout / "config/devices/device2.yaml"
    text = path.read_text(encoding="utf-8").replace("Device 2: lateral pins", "Größe 触覚 µm")
    path.write_text(text, encoding="utf-8")
    assert main(["check", str(path), "-o", "drawn.png"]) == 0
    assert capsys.readouterr().out.endswith("figures have no letters for 触覚 in the title: they show boxes\n")
    assert not recwarn.list


def test_times_of_cycles_are_periods(coarse: Path) -> None:
    table = predict("config/devices/device2.yaml", error=False, vary={"stimulus.playback": ["snapshot", "cycle"]})
    is_cycle = table["stimulus.playback"] == "cycle"
    assert table.loc[~is_cycle, "time_unit"].isna().all()
    assert set(table.loc[is_cycle, "time_unit"]) == {"periods"}
    assert table["time"].dropna().between(2.0, 3.0).all()


def test_tables_can_be_grouped_by_what_is_varied_and_by_caveats(coarse: Path) -> None:
    """Lists in them are tuples; ranges are as good as lists; two processes compute what one does."""
    device, vary = "config/devices/device2.yaml", {"stimulus.phases": [[0, 90], [0, 180]]}
    table = predict(device, error=False, vary=vary)
    assert [*table.groupby("stimulus.phases").size().index] == [(0, 90), (0, 180)]
    assert table.groupby("caveats").size().index.map(type).unique().tolist() == [tuple]
    assert predict(device, error=False, vary=vary, cores=2).equals(table)
    assert variants({"stimulus.amplitude": range(1, 3)}) == [{"stimulus.amplitude": 1}, {"stimulus.amplitude": 2}]


def test_forces_and_vibrations_in_python_are_those_that_commands_print(
    coarse: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    device, name = "config/devices/device2.yaml", "alternate_000"
    pressed = forces(device, error=False, conditions=[name])
    assert main(["forces", device, "--condition", name, "--no-error", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert pressed["normal_N_per_mm"].tolist() == [row["normal_N_per_mm"] for row in rows]
    assert pressed["error_N_per_mm"].isna().all()
    swung = vibrate(device, np.array([20]), conditions=[name])
    assert main(["vibrate", device, "--condition", name, "--frequency", "20", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert swung["score"].tolist() == [row["score"] for row in rows]
    assert set(swung["frequency_hz"]) == {0.0, 20.0}
    for wrong, told in (
        ([0.01], r"frequency: found 0\.01; allowed: 0\.1 to 1000 \[Hz\]"),
        (["fast"], "frequency: found 'fast'; allowed: "),
        ([10**5000], "frequency: found .*; allowed: "),
        (20.0, r"frequencies: found 20\.0; allowed: a list of numbers \[Hz\]"),
        (b"AB", r"frequencies: found b'AB'; allowed: a list of numbers \[Hz\]"),
        (np.array(20.0), r"frequencies: found array\(20\.\); allowed: a list of numbers \[Hz\]"),
    ):
        with pytest.raises(UsageError, match=told):
            vibrate(device, wrong)  # type: ignore[arg-type]
    with pytest.raises(UsageError, match="conditions: found 'alternate_000'; allowed: a list of names"):
        forces(device, conditions=name)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"error": "no"}, "error: found 'no'; allowed: True or False"),
        ({"cores": 0}, "cores: found 0; allowed: a whole number, at least 1"),
        ({"cores": "2"}, "cores: found '2'; allowed: a whole number, at least 1"),
        ({"config": 3}, "config: found 3; allowed: a path, or None"),
        ({"schemas": {"a": 1}}, r"schemas: found \{'a': 1\}; allowed: a path, or None"),
        ({"kinematics": ["small"]}, r"kinematics: found \['small'\]; allowed: 'small', 'finite'"),
        ({"kinematics": np.array(["small", "finite"])}, "kinematics: found array"),
        ({"conditions": None}, "conditions: found None; allowed: a list of names"),
        ({"conditions": [5]}, r"conditions: found \[5\]; allowed: a list of names"),
    ],
)
def test_parameters_of_another_kind_are_refused(given: dict[str, Any], told: str) -> None:
    with pytest.raises(UsageError, match=told):
        predict(DEVICES / "device2.yaml", **given)


def test_conditions_that_can_be_read_once_are_those_of_all_variants() -> None:
    names = (name for name in ["alternate_090"])
    table = predict(
        DEVICES / "device2.yaml",
        error=False,
        conditions=names,
        vary={"actuators.pitch": [2.4, 2.5]},
        kinematics="small",
    )
    assert set(table["condition"]) == {"alternate_090"}
    assert len(table) == 2 * len(table.query("`actuators.pitch` == 2.4"))


def test_a_link_to_nothing_is_said_and_not_guessed(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    devices = checkout / "config" / "devices"
    (devices / "link.yaml").symlink_to("nowhere.yaml")
    assert main(["check", "config/devices/link.yaml"]) == FAILED
    said = capsys.readouterr().err
    assert "config/devices/link.yaml: found a link to nothing; allowed: a device file" in said
    assert "did you mean" not in said
    (devices / "tap.csv").symlink_to("nowhere.csv")
    with pytest.raises(SceneError, match=r"tap\.csv: cannot be read: it is a link to nothing$"):
        read_recording(devices / "tap.csv", 4)


def test_a_working_folder_that_is_gone_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert main(["check", str(DEVICES / "device2.yaml")]) == FAILED
    assert capsys.readouterr().err == "fingerpad: the working folder is gone; go to one that is there\n"


def test_schemas_are_those_of_the_code_that_runs(checkout: Path) -> None:
    """And not those of an older checkout in which somebody works: what they let pass, this code could not read."""
    Project(checkout).edit("workflow/schemas/config.schema.yaml", lambda text: text.replace(", skips]", "]", 1))
    Project(checkout).edit("config/config.yaml", lambda text: text.partition("\nskips:")[0])
    device = "config/devices/device2.yaml"
    for command in (["check", device], ["new", "mine", "--from", device]):
        assert main(command) == FAILED
    with pytest.raises(SceneError, match="skips: found nothing"):
        predict(device)


def test_one_device_is_predicted_at_a_time() -> None:
    with pytest.raises(UsageError, match=r"device: found \['a\.yaml'\]; allowed: the path of one device file"):
        predict(["a.yaml"])  # type: ignore[arg-type]


def test_a_disk_that_fills_up_leaves_no_half_of_a_model(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Which the next call would take for a model of the user's own."""

    def half(source: Path, target: Path) -> None:
        target.write_bytes(source.read_bytes()[:100])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(shutil, "copyfile", half)
    assert main(["new", "mine", "--from", "device2", "--scenes", "own"]) == FAILED
    assert list((checkout / "own").rglob("*.*")) == []


def test_what_new_says_next_can_be_pasted(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "mine", "--from", "device2", "--scenes", "own folder"]) == 0
    check, predict, everything = map(shlex.split, capsys.readouterr().out.splitlines()[1:])
    assert main(check[1:]) == 0
    assert (check[0], predict) == ("fingerpad", ["fingerpad", "predict", "own folder/devices/mine.yaml"])
    scenes = (checkout / "own folder").resolve()
    assert everything == ["snakemake", "all", "--config", f"scenes={scenes}", "--directory", "own folder_results"]


def test_new_never_overwrites(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = checkout / "config/devices/device1.yaml"
    before = path.read_bytes()
    assert main(["new", "device1", "--from", "device2"]) == FAILED
    assert "exists already" in capsys.readouterr().err
    assert path.read_bytes() == before


def test_new_knows_the_devices(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "mine", "--from", "devise2"]) == FAILED
    assert "did you mean device2?" in capsys.readouterr().err
    assert main(["new", "mine", "--from", "absent.yaml"]) == FAILED
    assert "absent.yaml: found no such file" in capsys.readouterr().err


# fingerpad check


def test_check_says_what_there_is_and_draws(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "config/devices/device3.yaml", "-o", "third.png"]) == 0
    said = capsys.readouterr().out
    for part in (
        "valid",
        "Device 3: lateral pucks",
        "4 deformable actuators",
        "alternate_090",
        "third.png",
        "actuators move 0.028 to 0.228 mm lateral (positive: into the skin, to the right)",
        "friction 0.6; pressed until skin covers all faces, and held",
    ):
        assert part in said
    assert (checkout / "third.png").read_bytes().startswith(b"\x89PNG")


def test_check_says_until_where_round_actuators_are_pressed(
    checkout: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """They have no face to cover."""
    known = (checkout / "config/devices/device2.yaml").read_text()
    (tmp_path / "round.yaml").write_text(re.sub(r"edge_radius: \{value: [\d.]+", "edge_radius: {value: 0.5", known))
    assert main(["check", str(tmp_path / "round.yaml"), "--config", "config/config.yaml"]) == 0
    assert "pressed until contact reaches the middle of each, and held" in capsys.readouterr().out


def test_check_shows_its_progress_on_a_terminal(coarse: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = on_a_terminal(monkeypatch)
    assert main(["check", "config/devices/device2.yaml", "-o", "second.png"]) == 0
    assert "0/3" in terminal.getvalue()


def test_check_refuses(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "config/devices/device3.yaml", "-o", "third.doc"]) == FAILED
    assert "allowed: .png, .pdf, .svg" in capsys.readouterr().err
    path = checkout / "config/devices/device3.yaml"
    path.write_text(path.read_text(encoding="utf-8").replace("pitch:", "ptich:"), encoding="utf-8")
    assert main(["check", str(path)]) == FAILED
    assert "did you mean pitch?" in capsys.readouterr().err


# fingerpad fields


@pytest.mark.parametrize("output", ["end.vtu", "path.pvd"])
def test_fields_are_those_of_the_condition(coarse: Path, output: str, capsys: pytest.CaptureFixture[str]) -> None:
    """At the end of the stimulus, or pre-indented as well; the skin comes down to the pins."""
    case = ["--condition", "alternate_180", "--interface", "shear", "-o", output]
    assert main(["fields", "config/devices/device2.yaml", *case]) == 0
    on_the_way = " with all times on the way" if output == "path.pvd" else ""
    assert capsys.readouterr().out == f"written: {output}, the end of the stimulus{on_the_way}\n"
    written = {"end.vtu": ["end.vtu"], "path.pvd": ["path.vtu", "path/0000.vtu"]}[output]
    assert sorted(path.relative_to(coarse).as_posix() for path in coarse.rglob("*.vtu")) == written
    for name in written:
        fields = meshio.read(coarse / name).point_data
        assert fields["contact_pressure_MPa"].max() > 0.0
        assert fields["displacement_mm"][:, 1].max() > 1.0


def test_fields_whose_folder_is_a_file_are_refused_before_anything_is_solved(
    checkout: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (checkout / "path").touch()
    case = ["--condition", "alternate_180", "--interface", "shear", "-o", "path.pvd"]
    assert main(["fields", "config/devices/device2.yaml", *case]) == FAILED
    assert "path: found a file; allowed: a folder" in capsys.readouterr().err


# fingerpad predict


def test_forecast_calls_its_step_as_often_as_it_says() -> None:
    for error in (True, False):
        calls: list[None] = []
        rows = forecast(scene("device3"), error, lambda counter=calls: counter.append(None))
        assert len(calls) == steps(scene("device3"), error)
        assert all((row["score_error"] is not None) == (error and row["score"] is not None) for row in rows)


def test_a_score_whose_error_cannot_be_had_is_given_without_it() -> None:
    """Much friction on narrow gaps: on the coarser mesh contact loses its way. A caveat says so, in the table too."""
    base = scene("device2")
    moved = base.device.condition("alternate_180")
    moved = replace(moved, tangential=moved.tangential * 0.06 / np.abs(moved.tangential).max())
    row = replace(base.device.actuators, positions=(-1.95, -0.65, 0.65, 1.95))
    contact = replace(base.model.contact, friction=1.5)
    device = replace(base.device, actuators=row, conditions=(moved,))
    given = replace(base, device=device, model=replace(base.model, contact=contact))
    shear = [row for row in forecast(given) if row["interface"] == "shear"]
    assert all(row["score"] > 0.0 and row["score_error"] is None for row in shear)
    ((*_, caveat),) = {tuple(row["caveats"]) for row in shear}  # one sentence each, that of the error last
    assert caveat.startswith("error unknown: on a mesh of 2 times the sizes, device=device2, condition=alternate_180")
    said = f"caveat: alternate_180 (shear, strain and change_of_strain): {caveat}"
    assert said in as_table(given, shear)


def test_a_scene_without_a_mesh_leaves_the_others(
    coarse: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whole variants that have no answer are said so, with the reason, and the rest is printed."""

    def prepare(given: Scene, edges: FloatArray) -> Condensed | Meshed:
        if given.model.contact.friction == 0.9:
            raise MeshError("too many elements")
        return prepared(given, edges)

    prepared = scoring.prepared
    monkeypatch.setattr(scoring, "prepared", prepare)
    assert main(["predict", "--vary", "contact.friction=0.6,0.9", "config/devices/device2.yaml"]) == 0
    said = capsys.readouterr().out
    every = ", ".join(f"all conditions ({each}, strain and change_of_strain)" for each in ("shear", "frictionless"))
    assert f"caveat: {every.replace('), ', '); ')}: no prediction: too many elements\n" in said
    assert "change_of_strain, in 1 of 1: alternate_000 < alternate_090" in said
    assert "change_of_strain, no prediction (contact.friction 0.9)" in said


def test_a_coarser_mesh_without_a_node_for_an_actuator_leaves_errors_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    given = scene("device2").coarsened(4.0)

    def press(one: Scene, *rest: Any) -> Any:
        if one.model.numerics.face_size > given.model.numerics.face_size:
            raise MeshError("no skin node is near the actuator")
        return pressed(one, *rest)

    pressed = scoring.pressed_device
    monkeypatch.setattr(scoring, "pressed_device", press)
    rows = forecast(given)
    assert all(row["score"] > 0.0 and row["score_error"] is None for row in rows)
    assert {row["note"].partition(", ")[2] for row in rows} == {"no skin node is near the actuator"}


def test_what_cannot_be_solved_leaves_the_rest(
    coarse: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """One interface that cannot be pressed, one condition that cannot be followed: the table says so, below it why."""
    begin, follow = scoring.indent_device, scoring.stimulate

    def pressed(scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface) -> Indented:
        if interface is Interface.FRICTIONLESS:
            raise ContactError("too wide")
        return begin(scene, section, body, interface)

    def moved(scene: Scene, indented: Indented, condition: Condition) -> Solution:
        if condition.name == "alternate_090":
            raise ContactError("too far")
        return follow(scene, indented, condition)

    monkeypatch.setattr(scoring, "indent_device", pressed)
    monkeypatch.setattr(scoring, "stimulate", moved)
    assert main(["predict", "config/devices/device2.yaml"]) == 0
    said = capsys.readouterr().out
    lines = [line.split() for line in said.splitlines()]
    assert {(*line[:2], "prediction" in line) for line in lines if line[0].startswith("alternate")} == {
        (f"alternate_{phase}", interface, interface == "frictionless" or phase == "090")
        for phase in ("000", "090", "180")
        for interface in Interface
    }
    assert "alternate_090 (shear, strain and change_of_strain): no prediction: too far\n" in said
    assert "no prediction: too wide" in said


@pytest.mark.workflow
@pytest.mark.parametrize("device", SHIPPED)
def test_prediction_is_what_the_workflow_computes(device: str, finished: Any) -> None:
    with (finished.folder / "results" / "scores.csv").open(encoding="utf-8") as file:
        wanted = {
            (row["condition"], row["interface"], row["readout"]): row
            for row in csv.DictReader(file)
            if row["device"] == device and row["kinematics"] == "small"
        }
    rows = forecast(scene(device))
    assert len(rows) == len(wanted)
    for row in rows:
        other = wanted[row["condition"], row["interface"], row["readout"]]
        assert list(other) == [name for name in row if name not in BEHIND]
        for column in ("score", "score_error"):
            # the same arithmetic; what another order of a sum moves is a millionth of this
            found, stored = row[column], other[column]
            assert (found is None and stored == "") or found == pytest.approx(float(stored), rel=1e-9)


ROW = {
    "kinematics": "small",
    "device": "d",
    "interface": "shear",
    "readout": "strain",
    "unit": "mm2",
    "note": "",
    "indentation_mm": None,
    "force_N_per_mm": None,
    "sliding_share": None,
    "time": None,
    "time_unit": None,
    "dispersion": "a",
}


def test_caveats_of_a_solution() -> None:
    solution = solved("device2", "alternate_090", Interface.SHEAR)
    assert solution_caveats(scene("device2"), solution, Interface.SHEAR) == []
    worse = replace(
        solution,
        cuts=MANY_CUTS + 1,
        searches=MANY_SEARCHES + 1,
        certificate=replace(
            solution.certificate, penetration_share=0.5, gap_share=0.3, tension_share=0.4, cone_share=0.6
        ),
    )
    halved, searched, *near = solution_caveats(scene("device2"), worse, Interface.SHEAR)
    assert f"halved {MANY_CUTS + 1} times" in halved
    assert str(MANY_SEARCHES + 1) in searched
    shares = {"penetration": 50, "gap in contact": 30, "tension": 40, "excess over the friction cone": 60}
    assert near == [f"certificate: {name} is {share}% of its limit" for name, share in shares.items()]


def test_strokes_as_of_metres_are_doubted_and_none_at_all_is_told() -> None:
    """Each condition for itself: a recording in metres among others in mm."""
    given = scene("device2").device.conditions[0]
    still = np.zeros_like(given.normal)
    assert stimulus_caveats(given) == []
    assert stimulus_caveats(replace(given, normal=still, tangential=still)) == ["no actuator moves"]
    doubts = stimulus_caveats(replace(given, normal=still, tangential=1e-3 * given.tangential))
    assert doubts == ["actuators move by 2e-05 mm at most: are displacements in mm?"]
    for share, is_doubted in ((1.0 / 190.0, False), (1.0 / 210.0, True)):  # of the pins' stroke
        assert bool(stimulus_caveats(replace(given, tangential=share * given.tangential))) is is_doubted


def test_recordings_that_begin_elsewhere_are_doubted() -> None:
    """A sensor that reads 0.01 mm where actuators have been pressed to; a first row after time 0 is a step to it,
    unless that is much longer than all that follow. Cycles may begin anywhere."""
    given = scene("device2").device.conditions[0]
    moves = given.tangential * np.array([[0.0], [0.5], [1.0]])
    recorded = replace(given, time=np.array([0.0, 0.1, 0.2]), normal=0.0 * moves, tangential=moves)
    assert stimulus_caveats(recorded) == []
    moved = replace(recorded, tangential=moves + 0.01)
    (doubt,) = stimulus_caveats(moved)
    assert doubt == "actuators begin 0.01 mm away from where they were pressed to, from where displacements count"
    assert stimulus_caveats(replace(moved, time=np.array([0.1, 0.2, 0.3]))) == []
    far = replace(moved, time=np.array([0.1, 0.2, 0.3]), tangential=moves + 0.03)
    assert stimulus_caveats(far) == [doubt.replace("0.01", "0.03")]  # three times as far as in any later step
    assert stimulus_caveats(replace(far, settling=1)) == []
    held = replace(far, tangential=0.0 * moves + 0.03)
    assert stimulus_caveats(held) == []
    for noise, is_doubted in ((0.001, False), (0.004, True)):  # 5 % of the stroke, and 17 %
        assert bool(stimulus_caveats(replace(recorded, tangential=moves + noise))) is is_doubted


@pytest.mark.parametrize(
    ("phase", "doubted"), [(1.5708, True), (6.2, True), (6.3, False), (3.0, False), (22.5, False), (0.0, False)]
)
def test_phases_as_of_radians_are_doubted(phase: float, doubted: bool) -> None:
    told = stimulus_caveats(replace(scene("device2").device.conditions[0], phase_deg=phase))
    assert told == ([f"the phase is {phase} degrees: are phases in degrees?"] if doubted else [])


def test_actuators_that_press_nothing_are_told_by_their_number() -> None:
    """From the beginning, or from some time on."""
    given, solution = scene("device2"), solved("device2", "alternate_090", Interface.SHEAR)
    bears = np.array([0.0, 1.0, 1.0, 1.0])[:, None]
    idle = replace(solution, actuator_force=solution.actuator_force * bears)
    assert solution_caveats(given, idle, Interface.SHEAR) == [
        "actuators without force after pre-indentation, counted from the left: 1",
    ]
    left = solution.actuator_force.copy()
    left[-1, [1, 3]] = 0.0
    (caveat,) = solution_caveats(given, replace(solution, actuator_force=left), Interface.SHEAR)
    assert caveat.startswith("actuators that leave the skin, counted from the left: 2, 4 (")


def test_small_strain_is_doubted_where_indentation_is_deep() -> None:
    """Finite strain is not."""
    given = scene("device2")
    deep = replace(solved("device2", "alternate_090", Interface.SHEAR), depth=4.34)
    assert solution_caveats(given, deep, Interface.SHEAR) == [
        "actuators indent 87% of the pad: small strain is invalid"
    ]
    assert solution_caveats(given.with_kinematics(Kinematics.FINITE), deep, Interface.SHEAR) == []
    # of the pad; with a half mean strain is 0.5, and beyond the shipped devices' share nobody has compared
    for share, doubt in ((0.36, ""), (0.38, "predict --kinematics finite"), (0.49, "finite"), (0.51, "is invalid")):
        depth = share * given.model.finger.pad_thickness
        found = solution_caveats(given, replace(deep, depth=depth), Interface.SHEAR)
        assert len(found) == bool(doubt)
        assert all(each.endswith(doubt) for each in found)


def test_a_face_of_few_elements_is_doubted() -> None:
    given = scene("device2")
    narrow = given.with_device(actuators=replace(given.device.actuators, width=0.03, edge_radius=0.0))
    solution = solved("device2", "alternate_090", Interface.SHEAR)
    assert solution_caveats(narrow, solution, Interface.SHEAR) == [
        "actuators are 2.0 elements wide: try a smaller numerics.edge_size"
    ]
    for elements, is_doubted in ((4.9, True), (5.1, False)):
        row = replace(narrow.device.actuators, width=elements * given.model.numerics.edge_size)
        wider = replace(narrow, device=replace(narrow.device, actuators=row))
        assert bool(scene_caveats(wider, Interface.SHEAR)) is is_doubted


def test_round_actuators_say_where_they_end() -> None:
    """`full` asks for flat faces to be covered; a depth or a force is what it says, whatever the faces."""
    given, solution = scene("device2"), solved("device2", "alternate_090", Interface.SHEAR)
    row = replace(given.device.actuators, edge_radius=given.device.actuators.width / 2.0)
    domes = given.with_device(actuators=row)
    (caveat,) = solution_caveats(domes, solution, Interface.SHEAR)
    assert caveat.startswith("round actuators have no flat face to cover: pre-indentation ends where contact reaches")
    law = replace(domes.model.contact, criterion=Criterion.FORCE)
    assert solution_caveats(domes.with_model(contact=law), solution, Interface.SHEAR) == []


def test_a_row_that_touches_one_by_one_is_no_caveat() -> None:
    """As the outer pins of a row on a round finger touch later, `touch` presses some tenths of a millimetre."""
    given = scene("device2")
    touch = given.with_model(contact=replace(given.model.contact, criterion=Criterion.TOUCH))
    solution = solved("device2", "alternate_090", Interface.SHEAR)
    assert not [each for each in solution_caveats(touch, solution, Interface.SHEAR) if "at first touch" in each]
    # where all touch at once it goes 2e-4 mm farther; ten times as far is a pre-indentation
    for indentation, is_told in ((0.0, True), (2e-4, True), (2e-3, False)):
        pressed = replace(solution, indentation=indentation)
        assert any("at first touch" in each for each in solution_caveats(touch, pressed, Interface.SHEAR)) is is_told


def test_no_friction_is_told_where_shear_is_asked_for() -> None:
    given = scene("device2").model.contact
    slippery = scene("device2").with_model(contact=replace(given, friction=0.0))
    (told,) = scene_caveats(slippery, Interface.SHEAR)
    assert told.startswith("contact.friction is 0: ")
    assert scene_caveats(slippery, Interface.FRICTIONLESS) == []


def test_a_filter_finer_than_the_receptors_elements_is_doubted() -> None:
    given = scene("device2")
    gabor = replace(given.model.gabor, wavelength_change=0.1)
    fine = given.with_model(gabor=gabor)
    (found,) = solution_caveats(fine, solved("device2", "alternate_090", Interface.SHEAR), Interface.SHEAR)
    assert found == "the filter's wavelength is 1.7 receptor elements: try a smaller numerics.receptor_size"
    for elements, is_doubted in ((1.9, True), (2.1, False)):
        gabor = replace(gabor, wavelength_change=elements * given.model.numerics.receptor_size)
        assert bool(scene_caveats(given.with_model(gabor=gabor), Interface.SHEAR)) is is_doubted


def test_caveats_are_notes_of_scores() -> None:
    """So the workflow's table has them, too."""
    given = scene("device2")
    solution = replace(solved("device2", "alternate_090", Interface.SHEAR), cuts=4, searches=11)
    section, body = condensed("device2")
    reading = Condensed(section, body, resampling_to_grid(section.arc, given.model.gabor.spacing))
    read = read_solution(given, reading, given.device.condition("alternate_090"), Interface.SHEAR, solution)
    assert note_of(read.caveats) == "increments were halved 4 times; 11 increments did not settle at once"


def test_check_says_how_high_the_outermost_faces_lie(capsys: pytest.CaptureFixture[str]) -> None:
    """As high as skin nodes of the mesh over their ends."""
    assert main(["check", str(ROOT / "config" / "devices" / "device2.yaml")]) == 0
    (rise,) = re.findall(r"outermost faces lies (\S+) mm above first touch", capsys.readouterr().out)
    x, y = condensed("device2")[0].position.T
    row = scene("device2").device.actuators
    ends = row.positions[2] - row.half_face, row.positions[3] + row.half_face
    low, high = np.interp(ends, x, y)
    assert float(rise) == pytest.approx(high - low, abs=0.005 + 1e-3)  # two digits, and hats between nodes


@pytest.mark.parametrize(
    ("key", "changed", "said"),
    [
        ("pitch: {value: 2.5", "pitch: {value: 4.2", "The row is wide for this finger"),
        ("pitch: {value: 2.5", "pitch: {value: 3.5", "The row is wide for this finger"),
        ("direction: {value: lateral", "direction: {value: normal", None),
        (
            "tude: {value: 0.020",
            "tude: {value: 0.00002",
            "all conditions: actuators move by 2e-05 mm at most: are displacements in mm?",
        ),
        (
            "\nstimulus:",
            "\ncontact:\n  criterion: {value: depth, unit: '1', source: 'our rig'}\n"
            "  depth: {value: 2.6, unit: mm, source: 'our rig'}\nstimulus:",
            "Pre-indentation to contact.depth goes deeper than half of the pad: small strain is invalid there.",
        ),
        (
            "\nstimulus:",
            "\ncontact:\n  criterion: {value: depth, unit: '1', source: 'our rig'}\n"
            "  depth: {value: 0.9, unit: mm, source: 'our rig'}\nstimulus:",
            "over some actuators, which may bear nothing; counted from the left: 1, 4",
        ),
        ("absolute: {value: 0.188", "absolute: {value: 4.0", "A lateral stroke takes an actuator beside the finger"),
        ("absolute: {value: 0.188", "absolute: {value: 3.0", None),  # of pucks that end 4.5 mm from the middle
        (
            "amplitude: {value: 0.020",
            "amplitude: {value: 9.0",
            "deeper than the pad is thick: are displacements in mm?",
        ),
    ],
)
def test_check_says_what_will_hardly_go_well(
    checkout: Path, capsys: pytest.CaptureFixture[str], key: str, changed: str, said: str | None
) -> None:
    device = "device1" if "amplitude" in key else "device3" if "absolute" in key else "device2"
    path = checkout / "config" / "devices" / f"{device}.yaml"
    text = path.read_text(encoding="utf-8")
    assert key in text
    path.write_text(text.replace(key, changed), encoding="utf-8")
    assert main(["check", str(path)]) == 0
    warned = capsys.readouterr().out.splitlines()[7:]
    assert said in warned[0] if said else not warned


def test_an_interrupted_command_ends_in_a_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("fingerpad.commands.check.checked_scene", interrupt)
    assert main(["check", "config/devices/device2.yaml"]) == INTERRUPTED
    assert capsys.readouterr().err == "fingerpad: interrupted\n"


def test_a_closed_pipe_is_no_mistake() -> None:
    """`fingerpad check FILE | head -0`: whoever reads has read enough."""
    command = [sys.executable, "-m", "fingerpad.cli", "check", str(ROOT / "config" / "devices" / "device2.yaml")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT / "src") as job:
        assert job.stdout is not None
        assert job.stderr is not None
        job.stdout.close()
        said = job.stderr.read()
    assert (job.returncode, said) == (0, "")


def test_letters_that_a_terminal_lacks_end_no_command(checkout: Path) -> None:
    Project(checkout).edit("config/devices/device2.yaml", lambda text: text.replace("lateral pins", "手"))
    command = [sys.executable, "-m", "fingerpad.cli", "check", "config/devices/device2.yaml"]
    environment = {**os.environ, "PYTHONIOENCODING": "cp1252", "PYTHONPATH": str(ROOT / "src")}
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    assert "\nDevice 2: \\u624b (device2)\n" in done.stdout


def test_variants_are_told_apart_however_long_their_values_are() -> None:
    """By their last digit alone."""
    one, other = ({"stimulus.phases": [*range(40), last]} for last in (40, 41))
    assert named(one) != named(other)


def test_a_device_that_lifts_off_is_near_no_limit() -> None:
    """Nothing presses any more: of nothing that is allowed, nothing is used."""
    lifted = np.full((1, 4), -3.0)
    away = Condition("away", "test", 0.0, np.array([1.0]), lifted, np.zeros_like(lifted))
    for interface in Interface:
        solution = solve("device2", away, interface)
        assert not solution.pressure.any()
        caveats = solution_caveats(scene("device2"), solution, Interface.SHEAR)
        assert not [caveat for caveat in caveats if "certificate" in caveat]
        left = "actuators that leave the skin, counted from the left: 1, 2, 3, 4 (of a normal drive"
        assert f"{left} positive points into it)" in caveats


def test_one_actuator_that_leaves_the_skin_on_the_way_is_named() -> None:
    normal = np.array([[0.0, -3.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    back = Condition("back", "test", 0.0, np.array([1.0, 2.0]), normal, np.zeros_like(normal))
    strained, caveat = solution_caveats(
        scene("device2"), solve("device2", back, Interface.FRICTIONLESS), Interface.FRICTIONLESS
    )
    assert strained.endswith("too much for small strain: compare predict --kinematics finite")
    assert caveat.startswith("actuators that leave the skin, counted from the left: 2 (")


def test_a_time_that_might_as_well_be_read_is_told_where_it_scores_otherwise() -> None:
    """Slippery pins that slide to and almost as far fro; 6 % more change scores otherwise, 4 % more does not."""
    given = scene("device2")
    section, _ = condensed("device2")
    resampling = resampling_to_grid(section.arc, given.model.gabor.spacing)
    tangential = np.outer([0.02, -0.0197], [1.0, -1.0, 1.0, -1.0])
    strokes = Condition("strokes", "test", 0.0, np.array([0.1, 0.3]), np.zeros_like(tangential), tangential)
    found = solve("device2", strokes, Interface.FRICTIONLESS)
    reading = found.reading
    assert reading.rivalled
    (caveat,) = score_caveats(given, strokes, Interface.FRICTIONLESS, found, resampling)
    changes = [dict.fromkeys(Readout, each) for each in (reading.change_of_strain, reading.rival_change)]
    filtered = [filtered_readouts(resampling, each, given.model.gabor) for each in changes]
    read, other = (roughness_scores(given, each)[Readout.CHANGE_OF_STRAIN] for each in filtered)
    assert abs(other / read - 1.0) > 0.05
    now, then = strokes.time[[reading.time, reading.rival]]
    assert caveat.startswith(f"read at {now:g} s; at {then:g} s strain changes by ")
    assert f"{other:.3g} in place of {read:.3g} mm2" in caveat
    for factor, told in ((1.04, False), (1.06, True)):
        alike = replace(reading, rival_change=factor * reading.change_of_strain)
        assert bool(rival_caveats(given, strokes, alike, resampling)) is told
    there = replace(strokes, time=strokes.time[:1], normal=strokes.normal[:1], tangential=tangential[:1])
    assert rival_caveats(given, there, solve("device2", there, Interface.FRICTIONLESS).reading, resampling) == []


def test_a_peak_that_mirrors_the_one_that_is_read_is_no_rival() -> None:
    """Two slippery pins to the right, and the other two almost as far to the left, which scores alike."""
    tangential = np.array([[0.02, 0.0, 0.02, 0.0], [0.0, -0.0199, 0.0, -0.0199]])
    strokes = Condition("strokes", "test", 0.0, np.array([1.0, 2.0]), np.zeros_like(tangential), tangential)
    assert not solve("device2", strokes, Interface.FRICTIONLESS).reading.rivalled


def test_a_single_pin_that_touches_alone_presses_on_next_to_nothing() -> None:
    """It goes no deeper than its first node needs, and what it drags along is as small; that is said."""
    base = scene("device2")
    still = np.zeros((1, 1))
    beside = Condition("beside", "test", 0.0, np.array([1.0]), still, still + 0.02)
    row = replace(base.device.actuators, positions=(0.0,))
    model = replace(base.model, contact=replace(base.model.contact, criterion=Criterion.TOUCH))
    given = Scene(model, replace(base.device, actuators=row, conditions=(beside,), cycles=())).coarsened(4.0)
    rows = forecast(given, error=False)
    assert all(0.0 < row["force_N_per_mm"] < 2e-4 and row["indentation_mm"] < 3e-3 for row in rows)
    assert all(0.0 <= row["score"] < 1e-3 for row in rows)
    assert [len(row["caveats"]) for row in rows] == [1] * 4
    assert all("ends at first touch" in row["caveats"][0] for row in rows)


def test_all_stimuli_of_a_device_set_out_from_one_force() -> None:
    """That of pre-indentation, which knows nothing of what follows; pins that rise and sink end with others."""
    base = scene("device1")
    given = base.with_device(conditions=base.device.conditions[-2:], cycles=())
    rows = forecast(given.coarsened(4.0), error=False)
    assert len({row["condition"] for row in rows}) == 2
    for interface in Interface:
        (force,) = {row["force_N_per_mm"] for row in rows if row["interface"] == interface}
        assert force > 0.0


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """Rows that `predict` prints, without solving for them."""
    rows = [
        ROW | {"condition": "a", "score": 0.12345678, "score_error": 1e-4, "caveats": ["doubtful", "odd"]},
        ROW | {"condition": "bb", "score": None, "score_error": None, "note": "no prediction", "caveats": []},
    ]
    rows = [row | rank for row, rank in zip(rows, ranks(rows), strict=True)]
    monkeypatch.setattr(side_by_side, "forecast", lambda *given: rows)
    return rows


def test_predict_prints_an_aligned_table(
    checkout: Path, quick: list[dict[str, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["predict", "config/devices/device2.yaml"]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""  # no progress where there is no terminal
    title, header, *rows = printed.out.splitlines()
    assert title == "Device 2: lateral pins (device2), small strain"
    for name in ("interface", "unit", "note"):
        column = header.index(name)
        assert all(row[column - 1 : column] in ("", " ") for row in rows[:2])
    assert rows[0].split() == ["a", "shear", "strain", "0.12346", "0.00010", "mm2", "1"]
    assert rows[1].split() == ["bb", "shear", "strain", "mm2", "no", "prediction"]
    assert rows[2:] == ["caveat: a (shear, strain): doubtful", "caveat: a (shear, strain): odd"]


def test_caveats_name_each_condition_once() -> None:
    every = [condition.name for condition in scene("device3").device.conditions]
    rows = [
        ROW
        | {"condition": name, "interface": interface, "readout": readout, "caveats": [said]}
        | {"score": None, "score_error": None, "rank": None}
        for interface, names, said in (("shear", every[:2], "odd"), ("frictionless", every, "none is known"))
        for readout in ("strain", "change_of_strain")
        for name in names
    ]
    assert as_table(scene("device3"), rows).splitlines()[-2:] == [
        "caveat: alternate_000, alternate_090 (shear, strain and change_of_strain): odd",
        "caveat: all conditions (frictionless, strain and change_of_strain): none is known",
    ]


def test_ranks_that_errors_leave_open_are_ranges() -> None:
    """Three scores, of which two are closer than their errors; equal ones share a rank. One whose error is not known
    may lie on either side of all others."""
    scores = {"a": (1.0, 0.1), "b": (1.1, 0.1), "c": (2.0, 0.1), "same": (2.0, 0.1), "unknown": (1.05, None)}
    rows = [
        ROW | {"condition": name, "score": score, "score_error": error, "caveats": []}
        for name, (score, error) in scores.items()
    ]
    found = ranks(rows)
    assert [each["rank"] for each in found] == [5, 3, 1, 1, 4]
    printed = as_table(scene("device2"), [row | rank for row, rank in zip(rows, found, strict=True)]).splitlines()[-5:]
    assert [line.split()[-1] for line in printed] == ["3-5", "3-5", "1-2", "1-2", "4?"]
    assert all(each["first_rank"] <= each["rank"] <= each["last_rank"] for each in found if each["first_rank"])


def test_caveats_that_differ_in_a_share_are_told_as_one() -> None:
    said = {"a": ["pressed 44% deep", "odd"], "b": ["pressed 9% deep"], "c": ["pressed 9% of 20% deep"]}
    said |= {"d": ["pressed 44% deep"]}
    rows = [
        ROW | {"condition": name, "score": 1.0, "score_error": None, "caveats": own} | dict.fromkeys(RANKS, 1)
        for name, own in said.items()
    ]
    assert as_table(scene("device2"), rows).splitlines()[-3:] == [
        "caveat: a, b, d (shear, strain): pressed 9% to 44% deep",
        "caveat: a (shear, strain): odd",
        "caveat: c (shear, strain): pressed 9% of 20% deep",
    ]


def test_predict_names_the_kinematics(
    checkout: Path, quick: list[dict[str, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["predict", "--kinematics", "finite", "config/devices/device2.yaml"]) == 0
    assert capsys.readouterr().out.startswith("Device 2: lateral pins (device2), finite strain\n")


def test_predict_ends_with_3_if_nothing_has_a_score(
    checkout: Path, quick: list[dict[str, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    quick[0] |= {"score": None, "score_error": None, "note": "no prediction: too far", "caveats": []}
    assert main(["predict", "--json", "config/devices/device2.yaml"]) == UNSOLVED == 3
    said = capsys.readouterr()
    assert said.err == "fingerpad: nothing could be scored: no prediction: too far\n"
    assert json.loads(said.out) == quick


def test_predict_shows_its_progress_on_a_terminal(
    checkout: Path, quick: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal = on_a_terminal(monkeypatch)
    assert main(["predict", "config/devices/device2.yaml"]) == 0
    assert f"0/{steps(scene('device2'))}" in terminal.getvalue()
    assert "0/" not in capsys.readouterr().out


def test_predict_prints_json_and_csv(
    checkout: Path, quick: list[dict[str, Any]], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["predict", "--json", "config/devices/device2.yaml"]) == 0
    assert json.loads(capsys.readouterr().out) == quick
    assert main(["predict", "--csv", "config/devices/device2.yaml", "config/devices/device3.yaml"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert len(rows) == 4
    assert rows[0]["score"] == "0.12345678"
    assert rows[0]["caveats"] == "doubtful; odd"
    assert rows[1]["score"] == rows[1]["rank"] == ""


@pytest.mark.parametrize("form", ["--json", "--csv"])
def test_interrupted_predictions_keep_what_is_there(
    form: str,
    checkout: Path,
    quick: list[dict[str, Any]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def forecast_one(scene: Scene, *given: Any) -> list[dict[str, Any]]:
        if scene.device.name == "device3":
            raise KeyboardInterrupt
        return quick

    monkeypatch.setattr(side_by_side, "forecast", forecast_one)
    assert main(["predict", form, "config/devices/device2.yaml", "config/devices/device3.yaml"]) == INTERRUPTED
    said = capsys.readouterr().out
    rows = json.loads(said) if form == "--json" else list(csv.DictReader(io.StringIO(said)))
    assert [row["readout"] for row in rows] == [row["readout"] for row in quick]


def test_predict_computes_the_conditions_asked_for(
    checkout: Path, quick: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In the file's order, each once, as vibrations, too; one that a device has not is refused before any is solved."""
    taken: list[Scene] = []
    monkeypatch.setattr(side_by_side, "forecast", lambda scene, *given: taken.append(scene) or quick)
    wanted = ["--condition", "alternate_180", "--condition", "alternate_000", "--condition", "alternate_180"]
    assert main(["predict", *wanted, "config/devices/device2.yaml"]) == 0
    assert main(["predict", "config/devices/device2.yaml"]) == 0
    some, every = (scene.device for scene in taken)
    assert [each.name for each in some.conditions] == ["alternate_000", "alternate_180"]
    assert [each.name for each in some.cycles] == ["alternate_000", "alternate_180"]
    assert len(every.conditions) == len(every.cycles) == 3
    taken.clear()
    wrong = ["--condition", "alternate_18", "config/devices/device2.yaml", "config/devices/device3.yaml"]
    assert main(["predict", *wrong]) == 2
    assert "no condition 'alternate_18'" in capsys.readouterr().err
    assert not taken


def test_predict_takes_values_in_turn(
    checkout: Path, quick: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    taken: list[Scene] = []
    monkeypatch.setattr(side_by_side, "forecast", lambda scene, *given: taken.append(scene) or quick)
    vary = ["--vary", "contact.friction=0.3, 0.9", "--vary", "stimulus.dispersions.alternate=[0, 1, 1, 0]"]
    assert main(["predict", "--csv", *vary, "config/devices/device2.yaml"]) == 0
    assert [scene.model.contact.friction for scene in taken] == [0.3, 0.9]
    assert all((scene.device.conditions[-1].tangential[0, :2] * [1.0, -1.0] > 0.0).all() for scene in taken)
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [row["contact.friction"] for row in rows] == ["0.3", "0.3", "0.9", "0.9"]
    assert {row["stimulus.dispersions.alternate"] for row in rows} == {"[0, 1, 1, 0]"}

    assert main(["predict", *vary[:2], "config/devices/device2.yaml"]) == 0
    said = capsys.readouterr().out
    assert "(device2), small strain, contact.friction 0.9\n" in said
    assert said.endswith(
        "\n\ndevice2, small strain: 2 variants\nthese values change no score\n"
        f"shear, strain: no two scores differ by more than their errors\n\n{ONE_TABLE}\n"
    )


WIDE_ON_NARROW = {"actuators.pitch": [1.2, 2.0], "actuators.width": [1.0, 1.5]}  # 1.5 mm do not fit on 1.2 mm


def test_combinations_that_cannot_be_are_left_out_and_said(
    checkout: Path, quick: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    taken: list[Scene] = []
    monkeypatch.setattr(side_by_side, "forecast", lambda scene, *given: taken.append(scene) or quick)
    vary = [f"--vary={key}={','.join(map(str, values))}" for key, values in WIDE_ON_NARROW.items()]
    assert main(["predict", *vary, "config/devices/device2.yaml"]) == 0
    said = capsys.readouterr().out
    assert [scene.device.actuators.width for scene in taken] == [1.0, 1.0, 1.5]
    assert "device2, small strain: 3 variants" in said
    assert "left out: config/devices/device2.yaml with actuators.pitch 1.2, actuators.width 1.5: actuators:" in said

    assert main(["predict", "--csv", *vary, "config/devices/device2.yaml"]) == 0  # where programs read no such lines
    told = capsys.readouterr()
    assert "left out" not in told.out
    assert "left out: config/devices/device2.yaml with actuators.pitch 1.2, actuators.width 1.5" in told.err

    with pytest.warns(UserWarning, match=r"left out: .*with actuators\.pitch 1\.2, actuators\.width 1\.5: actuators:"):
        table = predict("config/devices/device2.yaml", vary=WIDE_ON_NARROW)
    assert len(table) == 3 * len(quick)


def test_a_value_that_is_in_no_possible_combination_is_an_error(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(side_by_side, "forecast", lambda *given: pytest.fail("nothing is computed"))
    vary = ["--vary", "actuators.pitch=0.5,2.0", "--vary", "actuators.width=1.0,1.5"]
    assert main(["predict", *vary, "config/devices/device2.yaml"]) == FAILED
    assert "device2.yaml with actuators.pitch 0.5, actuators.width 1.0: actuators: neigh" in capsys.readouterr().err


def test_predict_draws_scores_against_what_is_varied(
    checkout: Path, quick: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr("fingerpad.figures.variation.variation_figure", lambda *given: drawn.append(given) or Figure())
    vary = ["--vary", "actuators.pitch=2.0,2.5", "--vary", "contact.friction=0.3", "-o", "pitch.png"]
    assert main(["predict", *vary, "config/devices/device2.yaml"]) == 0
    ((key, unit, values, scenes, tables),) = drawn
    assert (key, unit, values, len(tables)) == ("actuators.pitch", "mm", [2.0, 2.5], 2)
    assert [each.device.actuators.positions[-1] for each in scenes] == [3.0, 3.75]
    assert capsys.readouterr().out.endswith("\ndrawn: pitch.png\n")
    assert (checkout / "pitch.png").read_bytes().startswith(b"\x89PNG")

    for wrong, found in {
        ("-o", "pitch.png", "config/devices/device2.yaml"): "no key with several values",
        (*vary, "config/devices/device2.yaml", "config/devices/device1.yaml"): "2 devices",
        (
            *vary,
            "--vary",
            "actuators.width=1.0,1.2",
            "config/devices/device2.yaml",
        ): "'actuators.pitch', 'actuators.width'",
    }.items():
        assert main(["predict", *wrong]) == FAILED
        assert f"-o: found {found}; allowed: one device, and one key with several" in capsys.readouterr().err
    assert main(["predict", "-o", "pitch.doc", "config/devices/device2.yaml"]) == FAILED
    assert "allowed: .png, .pdf, .svg" in capsys.readouterr().err


def test_robustness_says_which_assumptions_orders_hang_on(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Device 2 with scores of its own: friction turns the order of strain, the other half-cycle has no prediction."""

    def forecast_one(scene: Scene, error: bool, *given: Any) -> list[dict[str, Any]]:
        friction, first = scene.model.contact.friction, scene.device.conditions[-1].tangential[0, 0] >= 0.0
        scores = [1.0, 2.0, 3.0] if friction > 0.5 else [3.0, 2.0, 1.0]
        return [ROW | {"condition": condition.name, "kinematics": str(scene.kinematics),
                       "score": score if first else None, "score_error": 0.1 if error else None,
                       "note": "deep; odd" if first else "no prediction: too far", "caveats": ["deep", "odd"]}
                for condition, score in zip(scene.device.conditions, scores, strict=True)]  # fmt: skip

    monkeypatch.setattr(side_by_side, "forecast", forecast_one)
    assumptions = checkout / "assumptions.yaml"
    assumptions.write_text(
        "model:\n- {key: contact.friction, values: [0.3, 0.9], source: 'assumption: dry and moist'}\n"
        "devices:\n- {key: actuators.pitch, times: [0.1, 1.1], source: 'assumption: no, and wider'}\n"
        "- {key: actuators.ptich, times: [0.9], source: 'assumption: misspelt'}\n",
        encoding="utf-8",
    )
    command = ["robustness", "config/devices/device2.yaml", "--assumptions", str(assumptions)]
    assert main(command) == 0
    said = capsys.readouterr().out
    assert said.startswith(
        "Device 2: lateral pins (device2), small strain: 2 assumptions varied, one at a time\n"
        "orders that hold wherever there is a prediction: 0 of 3\n\nshear, strain\n"
        "  alternate_000 < alternate_090 holds in 0 of 1; reversed with contact.friction 0.3;"
        " no prediction with stimulus.half_cycle second\n"
    )
    assert "\ncaveat: all conditions (shear, strain): deep\ncaveat: all conditions (shear, strain): odd\n" in said
    assert "\nvaried: contact.friction 0.3; stimulus.half_cycle second\n" in said
    assert "\nwithout effect: contact.friction 0.9, actuators.pitch times 1.1, kinematics finite\n" in said
    assert "kept, as" not in said
    assert "\nnot in the file: actuators.ptich\n" in said
    assert "\nstimulus.half_cycle second: no prediction: too far\n" in said
    assert "\nleft out: actuators.pitch times 0.1: config/devices/device2.yaml" in said

    assert main([*command, "--csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert list(dict.fromkeys(row["varied"] for row in rows)) == [
        "as configured", "contact.friction 0.3", "contact.friction 0.9", "actuators.pitch times 1.1",
        "stimulus.half_cycle second", "kinematics finite",
    ]  # fmt: skip
    assert {row["score_error"] for row in rows if row["varied"] == "as configured"} == {"0.1"}


def test_robustness_leaves_out_what_has_no_condition_in_common(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def forecast_one(scene: Scene, error: bool, *given: Any) -> list[dict[str, Any]]:
        return [ROW | {"condition": condition.name, "score": float(place), "score_error": 0.1, "caveats": []}
                for place, condition in enumerate(scene.device.conditions)]  # fmt: skip

    monkeypatch.setattr(side_by_side, "forecast", forecast_one)
    assumptions = checkout / "assumptions.yaml"
    assumptions.write_text(
        "devices:\n- {key: stimulus.phases, values: [[30, 60]], source: 'assumption: others'}\n"
        "- {key: actuators.edge_radius, times: [2.0], source: 'assumption: rounder'}\n",
        encoding="utf-8",
    )
    path = checkout / "config/devices/device2.yaml"
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    document["stimulus"]["phases"]["source"] = "assumption: some"
    document["actuators"]["edge_radius"]["source"] = "our drawing"
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    assert main(["robustness", str(path), "--assumptions", str(assumptions)]) == 0
    said, early = capsys.readouterr()
    assert "\nleft out: stimulus.phases [30, 60]: " in said
    assert early.startswith("left out: stimulus.phases [30, 60]: ")
    assert "\nkept, as the file does not call them assumptions: actuators.edge_radius (" in said


def test_robustness_of_one_stimulus_is_refused_at_once(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = checkout / "config/devices/device2.yaml"
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    document["stimulus"]["phases"]["value"] = [90, 270]  # one stimulus
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    assert main(["robustness", str(path)]) == FAILED
    assert "device2: found one stimulus; allowed: two or more" in capsys.readouterr().err


def test_robustness_of_a_device_that_cannot_be_solved_is_an_error(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    unsolved = [ROW | {"score": None, "score_error": None, "note": "no prediction: too far"}]
    monkeypatch.setattr(side_by_side, "forecast", lambda *given: unsolved)
    assert main(["robustness", "config/devices/device2.yaml"]) == UNSOLVED
    assert "nothing could be scored: no prediction: too far" in capsys.readouterr().err


def test_orders_count_scores_that_differ_by_more_than_their_errors() -> None:
    """Of 0°, 90° and 180° neighbours may be as good as equal where the outermost are not."""

    def table(*scores: tuple[float | None, float | None]) -> list[dict[str, Any]]:
        return [ROW | {"condition": name, "score": score, "score_error": error}
                for name, (score, error) in zip("abc", scores, strict=True)]  # fmt: skip

    near = table((1.0, 0.1), (1.15, 0.1), (1.3, 0.1))
    far = table((1.0, 0.1), (2.0, 0.1), (3.0, 0.1))
    unknown = table((1.0, None), (2.0, 0.1), (None, None))
    assert list(orders({"1": near, "2": far, "3": far})) == [
        "shear, strain, in 3 of 3: a < c",
        "shear, strain, in 2 of 3 (2; 3): a < b, b < c",
    ]
    assert list(orders({"1": far, "2": far, "3": far})) == [
        "these values change no score",
        "shear, strain, in 3 of 3: a < b, b < c",
    ]
    falling = table((3.0, 0.1), (2.0, 0.1), (1.0, 0.1))
    assert list(orders({"1": far, "2": far[::-1], "3": falling})) == [
        "shear, strain, in 2 of 3 (1; 2): a < b, a < c, b < c",
        "shear, strain, in 1 of 3 (3): b < a, c < a, c < b",
    ]
    assert list(orders({"1": unknown, "2": near[:2]})) == [
        "shear, strain: no two scores with known errors differ by more than their errors",
        "shear, strain, not ordered, as errors are unknown (1): a",
    ]
    lost = table((None, None), (None, None), (None, None))
    assert list(orders({"1": far, "2": lost, "3": near})) == [
        "shear, strain, in 2 of 2: a < c",
        "shear, strain, in 1 of 2 (1): a < b, b < c",
        "shear, strain, no prediction (2)",
    ]


def test_values_of_numpy_are_those_of_files_and_no_list_is_refused() -> None:
    vary = {"contact.friction": np.linspace(0.3, 0.6, 2), "stimulus.phases": (np.array([0, 45]),)}
    found = variants(vary)
    assert found == [{"contact.friction": each, "stimulus.phases": [0, 45]} for each in (0.3, 0.6)]
    assert [type(each["contact.friction"]) for each in found] == [float, float]
    assert [scene.model.contact.friction for scene in (check_device(DEVICES / "device2.yaml", SCHEMAS, CONFIG, each)
                                                       for each in found)] == [0.3, 0.6]  # fmt: skip
    for wrong in ([], 0.3, "touch", None, [Decimal("0.3")], [{1: 2}]):
        with pytest.raises(UsageError, match=r"vary: contact\.criterion: found .*; allowed: a list of numbers, texts"):
            variants({"contact.criterion": wrong})  # type: ignore[dict-item]


def test_words_of_the_library_are_those_of_files_and_keys_are_texts() -> None:
    (found,) = variants({"contact.criterion": [Criterion.TOUCH]})
    assert found == {"contact.criterion": "touch"}
    varied = check_device(DEVICES / "device2.yaml", SCHEMAS, CONFIG, found)
    assert varied.model.contact.criterion is Criterion.TOUCH
    with pytest.raises(UsageError, match=r"vary: found \{'': \[1\]\}; allowed: keys as text"):
        variants({"": [1]})
    with pytest.raises(UsageError, match=r"vary: found \{3: \[1\]\}; allowed: keys as text"):
        variants({3: [1]})  # type: ignore[dict-item]


def test_values_in_turn_are_those_of_edited_files(coarse: Path) -> None:
    table = predict("config/devices/device2.yaml", error=False, vary={"actuators.pitch": [2.2, 2.4]})
    Project(coarse).edit("config/devices/device2.yaml", lambda text: text.replace("value: 2.5", "value: 2.4"))
    edited = predict("config/devices/device2.yaml", error=False)
    assert table["actuators.pitch"].tolist() == [2.2] * len(edited) + [2.4] * len(edited)
    assert table["score"][len(edited) :].tolist() == edited["score"].tolist()


def test_a_force_without_effect_is_refused_in_python_too() -> None:
    with pytest.raises(UsageError, match=r"contact\.force, which has no effect where contact\.criterion is 'full'"):
        predict(DEVICES / "device2.yaml", vary={"contact.force": [0.1, 0.2]})


def test_prediction_with_unknown_kinematics_is_refused() -> None:
    with pytest.raises(UsageError, match="kinematics: found 'large'; allowed: 'small', 'finite'"):
        predict("config/devices/device2.yaml", kinematics="large")


def test_python_gives_the_same_table(checkout: Path) -> None:
    table = predict("config/devices/device3.yaml", error=False)
    rows = forecast(scene("device3"), error=False)
    assert list(table.columns) == list(rows[0])
    assert table["score"].dropna().tolist() == [row["score"] for row in rows if row["score"] is not None]
    # numbers are numbers also where none is known: without errors, or without a second time to read
    assert table["score_error"].isna().all()
    assert table["rank"].max() == 3
    assert (table.dtypes[["score", "score_error", "time"]] == "float64").all()
    assert (table.dtypes[["rank", "first_rank", "last_rank"]] == "Int64").all()


def test_a_device_with_shear_alone_says_why_the_rest_is_left_out() -> None:
    base = scene("device2").coarsened(4.0)
    both, alone = (forecast(base.with_device(frictionless=each), error=False) for each in (True, False))
    assert [row["score"] for row in both if row["interface"] == "shear"] == pytest.approx(
        [row["score"] for row in alone if row["interface"] == "shear"], rel=0.05
    )  # edges, and so meshes, are those of the interfaces that are solved
    without = [row for row in alone if row["interface"] == "frictionless"]
    assert len(without) == len(both) / 2
    assert all(row["score"] is None and row["caveats"] == (LEFT_OUT,) for row in without)


# Where things are, what is loaded, and exit codes


def test_commands_work_from_any_folder(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of the checkout; elsewhere with the one that the package is used from, or, without any, with the options."""
    device = str(checkout / "config/devices/device1.yaml")
    monkeypatch.chdir(checkout / "config" / "devices")
    assert find_checkout(Path.cwd()).root == checkout
    assert main(["check", "device1.yaml"]) == 0
    assert main(["new", "mine", "--from", "device1"]) == 0
    assert "fingerpad check mine.yaml" in capsys.readouterr().out
    monkeypatch.chdir("/")
    assert main(["check", device]) == 0
    assert find_checkout(Path("/")).root == ROOT
    monkeypatch.setattr("fingerpad.checkout.OWN", Path("/"))
    assert main(["check", device]) == FAILED
    assert "schemas/; go there, or give --config and --schemas" in capsys.readouterr().err
    given = ["--config", str(CONFIG), "--schemas", str(SCHEMAS)]
    assert main(["check", device, *given]) == 0
    with pytest.raises(UsageError):
        find_checkout(Path("/"))


def test_a_device_goes_with_the_model_beside_its_folder(
    checkout: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in a folder of scenes; a file anywhere else goes with the model of the checkout."""
    theirs, anywhere = tmp_path_factory.mktemp("theirs"), tmp_path_factory.mktemp("anywhere")
    (theirs / "devices").mkdir()
    for folder in (theirs / "devices", anywhere):
        shutil.copy(DEVICES / "device2.yaml", folder)
    shutil.copy(CONFIG, theirs)
    assert model_for(theirs / "devices" / "device2.yaml") == theirs / "config.yaml"
    assert model_for(anywhere / "device2.yaml") == checkout / "config" / "config.yaml"
    monkeypatch.chdir(theirs / "devices")
    assert model_for(Path("device2.yaml")) == theirs / "config.yaml"


@pytest.mark.parametrize("module", ["fingerpad", "fingerpad.cli"])
def test_import_is_light(module: str) -> None:
    code = f"import {module}, sys; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT / "src")
    assert not {"numpy", "yaml", "pandas", "matplotlib"} & set(done.stdout.split())


@pytest.mark.parametrize("command", COMMANDS)
def test_help_shows_examples(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main([command, "--help"])
    assert end.value.code == 0
    said = capsys.readouterr().out
    assert "example" in said
    assert f"  fingerpad {command} " in said


@pytest.mark.parametrize("arguments", [[], ["predct"], ["predict"], ["new", "mine"], ["check", "a.yaml", "--colour"]])
def test_wrong_use_is_2(arguments: list[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == FAILED == 2


def test_a_file_behind_frequencies_is_no_number(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["vibrate", "--frequency", "10", "20", "mine.yaml"])
    assert "found 'mine.yaml'; allowed: numbers [Hz], as in fingerpad vibrate FILE --freq" in capsys.readouterr().err


def test_frequencies_may_be_given_one_by_one() -> None:
    parser = argparse.ArgumentParser()
    add_vibrate(parser)
    given = parser.parse_args(["a.yaml", "--frequency", "10", "--frequency", "20", "30"])
    assert given.frequency == [10.0, 20.0, 30.0]


def test_what_cannot_be_solved_is_3(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*given: object) -> None:
        raise ContactError("no")

    monkeypatch.setattr(side_by_side, "forecast", refuse)
    assert main(["predict", "config/devices/device2.yaml"]) == UNSOLVED == 3


def test_a_scene_without_solution_is_refused_with_3(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = checkout / "config/devices/device2.yaml"
    far = path.read_text(encoding="utf-8").replace("pitch: {value: 2.5", "pitch: {value: 4.0")  # the pad curves away
    path.write_text(far, encoding="utf-8")
    assert main(["predict", "--no-error", str(path)]) == UNSOLVED
    assert "device=device2" in capsys.readouterr().err


def test_what_is_unexpected_is_1() -> None:
    code = """
import fingerpad.checkout
fingerpad.checkout.find_checkout = None
from fingerpad.cli import main
main(["new", "mine", "--from", "device1"])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=ROOT / "src")
    assert done.returncode == 1
    assert "Traceback" in done.stderr


def test_depth_and_force_of_pre_indentation_stand_with_their_units() -> None:
    row = {"interface": "shear", "indentation_mm": 1.25, "force_N_per_mm": 0.5, "sliding_share": 0.25, "condition": "a"}
    row |= {"time": None, "time_unit": None}
    assert _contact([row, row, row | {"condition": "b", "sliding_share": None}]) == [
        "pre-indentation: 1.25 mm and 0.5 N/mm (shear)",
        "sliding, share of the pressing force (shear): 25% (a)",
    ]


def test_what_a_decimal_comma_leaves_is_refused() -> None:
    for text in ("0,05", "0.3, 05", "[0,05]"):
        with pytest.raises(UsageError, match=r"found '05' in .*; allowed: numbers with a point, as 0\.05"):
            variations(Namespace(vary=[f"contact.friction={text}"]))
    assert variations(Namespace(vary=["contact.friction=0.05,1.005"])) == [
        {"contact.friction": 0.05},
        {"contact.friction": 1.005},
    ]


def test_values_of_a_key_that_is_given_twice_are_all_taken() -> None:
    asked = Namespace(vary=["contact.friction=0.3", "contact.friction=0.6"])
    assert variations(asked) == [{"contact.friction": 0.3}, {"contact.friction": 0.6}]


def test_scores_of_other_cases_have_ranks_of_their_own() -> None:
    one = ROW | {"condition": "a", "score": 1.0, "score_error": 0.01}
    near = one | {"condition": "b", "score": 1.005}
    others = [near | {key: "other"} for key in SERIES]
    assert ranks([one, *others]) == [dict.fromkeys(RANKS, 1)] * 5


def test_what_shipped_devices_do_is_no_caveat() -> None:
    """As many cuts and searches as they take, and a fifth of what certificates allow."""
    solution = solved("device2", "alternate_090", Interface.SHEAR)
    certificate = replace(solution.certificate, penetration_share=0.2, tension_share=0.19)
    usual = replace(solution, cuts=MANY_CUTS, searches=MANY_SEARCHES, certificate=certificate)
    assert solution_caveats(scene("device2"), usual, Interface.SHEAR) == []


def test_strained_receptors_are_doubted_with_small_strain_alone() -> None:
    given, solution = scene("device2"), solved("device2", "alternate_090", Interface.SHEAR)
    strain = solution.reading.strain
    large = replace(solution, reading=replace(solution.reading, strain=strain * 0.25 / strain.max()))
    (told,) = solution_caveats(given, large, Interface.SHEAR)
    assert told.startswith("receptors are strained by up to 25%")
    assert solution_caveats(given.with_kinematics(Kinematics.FINITE), large, Interface.SHEAR) == []


def test_orders_without_a_prediction_in_some_or_all_variants() -> None:
    def table(**scores: float | None) -> list[dict[str, Any]]:
        return [ROW | {"condition": name, "score": score, "score_error": 0.01} for name, score in scores.items()]

    tables = {
        "one": table(a=1.0, b=2.0, c=3.0),
        "two": table(a=1.0, b=2.0, c=4.0),
        "three": table(a=None, b=None, c=None),
    }
    assert list(orders(tables)) == [
        "shear, strain, in 2 of 2: a < b, b < c",
        "shear, strain, no prediction (three)",
    ]
    lost = [ROW | {"condition": "a", "score": None, "score_error": None}]
    assert list(orders({"one": lost, "two": lost})) == ["one condition: there is nothing to order"]


def test_why_there_is_nothing_without_friction_depends_on_control(monkeypatch: pytest.MonkeyPatch) -> None:
    base = scene("device2")
    monkeypatch.setattr("fingerpad.prediction.forecast.edge_intervals", lambda scene: None)
    monkeypatch.setattr("fingerpad.prediction.forecast.solved_rows", lambda *given: ([], {}))
    for control, why in ((Control.FORCE, SILENT), (Control.DISPLACEMENT, LEFT_OUT)):
        rows = forecast(base.with_device(control=control, frictionless=False), error=False)
        assert rows
        assert all(row["caveats"] == (why,) for row in rows)


def test_errors_are_solved_up_to_the_time_that_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first of two: where the row has moved farthest."""
    base = scene("device2").coarsened(8.0)
    there = np.full((1, 4), 0.02)
    path = np.concatenate([there, 0.5 * there])
    both = Condition("both", "a", 0.0, np.array([1.0, 2.0]), 0.0 * path, path)
    solve, sizes = scoring.solve_scene, []

    def solving(own: Scene, *rest: Any) -> Any:
        sizes.append([each.time.size for each in own.device.conditions])
        return solve(own, *rest)

    monkeypatch.setattr(scoring, "solve_scene", solving)
    rows = forecast(base.with_device(conditions=(both,)))
    assert sizes == [[2], [1], [1]]
    assert {(row["time"], row["time_unit"]) for row in rows} == {(1.0, "s")}


def test_deformable_actuators_are_so_with_finite_kinematics(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def press(*own: Any) -> None:
        asked.append(own)
        raise ContactError("enough")

    monkeypatch.setattr(scoring, "press_finger", press)
    given = scene("device3").with_kinematics(Kinematics.FINITE)
    meshed = Meshed(object(), object(), object())  # type: ignore[arg-type]
    with pytest.raises(ContactError, match="enough"):
        scoring.pressed_device(given, meshed, Interface.SHEAR)
    assert asked == [(given, meshed.section, meshed.body, Interface.SHEAR)]


def test_new_shares_recordings_that_are_there(checkout: Path) -> None:
    devices = checkout / "config" / "devices"
    main(["new", "mine", "--from", "device2"])
    document = yaml.safe_load((devices / "mine.yaml").read_text(encoding="utf-8"))
    (devices / "mine.yaml").write_text(yaml.safe_dump(document | yaml.safe_load(MEASURED)), encoding="utf-8")
    rows = "".join(f"1,{k},0.01,0\n" for k in range(1, 5))
    (devices / "tap.csv").write_text(f"time,actuator,normal,tangential\n{rows}", encoding="utf-8")
    assert main(["new", "copied", "--from", "mine"]) == 0
    assert main(["check", "config/devices/copied.yaml"]) == 0


@pytest.mark.parametrize("name", ["my-device", "../mine"])
def test_new_refuses_what_is_no_name(name: str, checkout: Path) -> None:
    assert main(["new", name, "--from", "device2"]) == FAILED


def test_robustness_varies_distinct_stimuli_with_the_kinematics_asked_for(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """90 and 270 degrees are one stimulus; kinematics alone is compared last."""
    path = checkout / "config/devices/device2.yaml"
    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    document["stimulus"]["phases"]["value"] = [0, 90, 270]
    path.write_text(yaml.safe_dump(document), encoding="utf-8")
    asked = []

    def forecast_none(own: Scene, error: bool, *given: Any) -> list[dict[str, Any]]:
        asked.append((own.kinematics, [each.name for each in own.device.conditions]))
        return [ROW | {"condition": "a", "score": 1.0, "score_error": 0.1, "caveats": []}]

    monkeypatch.setattr(side_by_side, "forecast", forecast_none)
    assert main(["robustness", "--kinematics", "finite", str(path)]) == 0
    configured, *varied, last = asked
    assert configured == (Kinematics.FINITE, ["alternate_000", "alternate_090"])
    assert len(varied) > 1
    assert all(each == configured for each in varied)
    assert last == (Kinematics.SMALL, configured[1])


def test_a_lift_is_no_stroke_into_the_skin() -> None:
    """However far it goes."""
    given = scene("device2")
    pad = given.model.finger.pad_thickness
    for height, doubted in ((-2.0 * pad, False), (2.0 * pad, True)):
        conditions = tuple(replace(each, normal=np.full_like(each.normal, height)) for each in given.device.conditions)
        lifted = given.with_device(conditions=conditions)
        assert (TOO_FAR in told_of(lifted)) is doubted


def test_edges_that_finite_strain_cannot_tell_from_sharp_ones_are_a_caveat() -> None:
    """With friction alone, and not with small strain."""
    given = scene("device2")

    def sharpness(radius: float, kinematics: Kinematics, friction: float) -> list[str]:
        row = replace(given.device.actuators, edge_radius=radius)
        model = replace(given.model, contact=replace(given.model.contact, friction=friction))
        own = Scene(model, replace(given.device, actuators=row)).with_kinematics(kinematics)
        return [caveat for caveat in scene_caveats(own, Interface.SHEAR) if "edges are sharper" in caveat]

    size = given.model.numerics.edge_size
    assert sharpness(0.0, Kinematics.FINITE, 0.6) == sharpness(0.9 * size, Kinematics.FINITE, 0.6)
    assert f"--vary actuators.edge_radius={size:g}" in sharpness(0.0, Kinematics.FINITE, 0.6)[0]
    for other in ((size, Kinematics.FINITE, 0.6), (0.0, Kinematics.SMALL, 0.6), (0.0, Kinematics.FINITE, 0.0)):
        assert sharpness(*other) == []


def test_a_closed_output_is_no_error(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `>&-` leaves it."""
    monkeypatch.setattr("sys.stdout", None)
    assert main(["check", "config/devices/device2.yaml"]) == 0


def test_orders_of_scores_with_unknown_errors_are_told_to_be_open() -> None:
    unknown = [ROW | {"condition": name, "score": score, "score_error": None, "caveats": []}
               for name, score in (("a", 1.0), ("b", 9.0))]  # fmt: skip
    told = list(varying._told(scene("device2"), unknown, {}, {}, [], []))
    assert "no two scores with known errors differ by more than their errors" in told
    assert "\nshear, strain, not ordered, as errors are unknown: a, b" in told


def test_check_knows_depths_and_criteria() -> None:
    given = scene("device2")
    deep = replace(given.model.contact, criterion=Criterion.DEPTH, depth=1.01 * given.model.finger.pad_thickness)
    assert NO_SUCH_DEPTH in told_of(given.with_model(contact=deep))
    assert TOO_FAR not in told_of(given.with_model(contact=deep))
    touch = replace(given.model.contact, criterion=Criterion.TOUCH)
    told = told_of(given.with_model(contact=touch))
    assert "; pressed until all actuators carry some skin, and held\n" in told


def test_a_row_to_one_side_is_not_called_wide() -> None:
    given = scene("device2")
    still = np.zeros((1, 3))
    condition = Condition("a", "a", 0.0, np.array([1.0]), still, still)
    aside, wide = (4.0, 5.2, 6.5), (-6.5, 0.0, 6.5)
    for positions, said, unsaid in ((aside, TOO_FAR_OUT, TOO_WIDE), (wide, TOO_WIDE, TOO_FAR_OUT)):
        row = ActuatorRow(positions, 1.0, 0.1)
        told = told_of(Scene(given.model, Device("row", "Row", Control.DISPLACEMENT, row, (condition,))))
        assert said in told
        assert unsaid not in told


@pytest.mark.parametrize(("pitch", "is_wide"), [(1.8, False), (1.9, True)])
def test_a_row_is_wide_where_the_next_narrower_one_can_be_covered(pitch: float, is_wide: bool) -> None:
    """Six pins of 1.2 mm, 1.8 mm apart, are covered; 1.9 mm apart they have no solution without friction."""
    given, still = scene("device2"), np.zeros((1, 6))
    condition = Condition("a", "a", 0.0, np.array([1.0]), still, still)
    row = ActuatorRow(evenly(6, pitch), 1.2, 0.1)
    told = told_of(Scene(given.model, Device("row", "Row", Control.DISPLACEMENT, row, (condition,))))
    assert (TOO_WIDE in told) is is_wide


def test_check_measures_a_middle_pin_from_the_mid_line() -> None:
    given, still = scene("device2"), np.zeros((1, 1))
    condition = Condition("a", "a", 0.0, np.array([1.0]), still, still)
    pin = Device("pin", "Pin", Control.DISPLACEMENT, ActuatorRow((0.0,), 4.0, 0.0), (condition,))
    low, high = given.model.finger.skin_height(np.array([0.0, 2.0]))
    assert f"outermost faces lies {high - low:.2g} mm above" in told_of(Scene(given.model, pin))


def test_frequencies_that_are_asked_for_take_the_place_of_the_files() -> None:
    """Each once, from the lowest; a file without any needs them."""
    given = scene("device2")
    assert at_frequencies(given, []).device.frequencies == given.device.frequencies
    assert at_frequencies(given, [60.0, 25.0, 60.0]).device.frequencies == (25.0, 60.0)
    silent = given.with_device(frequencies=())
    assert at_frequencies(silent, [25.0]).device.frequencies == (25.0,)
    with pytest.raises(UsageError, match=r"found no frequency; give one, or stimulus\.frequency_hz in the device file"):
        at_frequencies(silent, [])


def test_a_vibration_without_a_prediction_is_a_dash_and_why_is_told_once() -> None:
    given = at_frequencies(scene("device2"), [25.0])
    row = {"interface": "shear", "condition": "a", "unit": "mm2"}
    rows = [
        row | {"readout": readout, "frequency_hz": hertz, "score": score, "caveats": caveats}
        for hertz, score, caveats in ((0.0, 0.0123, []), (25.0, None, ["no prediction: why"]))
        for readout in ("strain", "change_of_strain")
    ]
    cells = ["condition    slow  25 Hz", "a          0.0123      -", ""]
    assert vibrations(given, rows).splitlines()[2:] == [
        "shear, strain [mm2]",
        *cells,
        "shear, change_of_strain [mm2]",
        *cells,
        "a (shear, 25 Hz): no prediction: why",
    ]


def test_caveats_of_vibrations_say_which_frequencies_they_are_about() -> None:
    """Each once, those that differ in a share as one."""
    given = at_frequencies(scene("device2"), [25.0])
    row = {"interface": "shear", "condition": "a", "unit": "mm2", "readout": "strain", "score": 0.1}
    rows = [
        row | {"frequency_hz": hertz, "caveats": caveats}
        for hertz, caveats in ((0.0, ["idle: 1", "up to 31%"]), (25.0, ["idle: 1", "left: 3", "up to 28%"]))
    ]
    assert vibrations(given, rows).splitlines()[-3:] == [
        "a (shear, slow and 25 Hz): idle: 1",
        "a (shear, slow and 25 Hz): up to 28% to 31%",
        "a (shear, 25 Hz): left: 3",
    ]


def test_vibrations_without_any_score_are_told_once_and_are_an_error(
    coarse: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No empty table, and one line for all conditions and frequencies of an interface."""
    Project(coarse).edit("config/devices/device2.yaml", lambda text: text + TOO_DEEP)
    assert main(["vibrate", "config/devices/device2.yaml", "--frequency", "10", "20"]) == UNSOLVED
    captured = capsys.readouterr()
    title, empty, *told = captured.out.splitlines()
    assert (title, empty) == ("Device 2: lateral pins (device2), small strain", "")
    assert [line.partition(":")[0] for line in told] == [
        f"all conditions ({interface}, slow, 10 Hz and 20 Hz)" for interface in ("shear", "frictionless")
    ]
    assert "nothing could be scored: no prediction: " in captured.err


def test_forces_are_a_table_for_programs(coarse: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["forces", "--no-error", "--csv", "config/devices/device3.yaml"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert len(rows) == 3 * 2 * 4  # conditions, times, actuators
    assert all(float(row["normal_N_per_mm"]) > 0.0 and row["error_N_per_mm"] == "" for row in rows)
    assert main(["forces", "--no-error", "--json", "config/devices/device3.yaml"]) == 0
    assert [row["actuator"] for row in json.loads(capsys.readouterr().out)] == [int(row["actuator"]) for row in rows]


def test_forces_of_what_cannot_be_pressed_are_an_error(coarse: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Project(coarse).edit("config/devices/device3.yaml", lambda text: text + TOO_DEEP)
    assert main(["forces", "config/devices/device3.yaml"]) == UNSOLVED
    captured = capsys.readouterr()
    assert re.match("Device 3: .*\ncaveat: all conditions .*: no prediction: .*\n$", captured.out)
    assert "nothing could be solved: no prediction: " in captured.err
    assert "did not reach a depth of 6 mm" in captured.err


def test_fields_are_not_written_among_other_files(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """But in place of states, also those of a killed writer."""
    (checkout / "own").mkdir()
    for name in ("0000.vtu", "0001.vtu.0123456789abcdef.part", "notes.txt"):
        (checkout / "own" / name).touch()
    case = ["--condition", "alternate_180", "--interface", "shear", "-o", "own.pvd"]
    assert main(["fields", "config/devices/device2.yaml", *case]) == FAILED
    assert "own: found notes.txt in it; allowed: states alone" in capsys.readouterr().err


def test_a_device_that_is_given_twice_is_predicted_once(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(
        side_by_side, "forecast", lambda *given: [ROW | {"score": 1.0, "score_error": None, "caveats": []}]
    )
    path = "config/devices/device2.yaml"
    assert main(["predict", "--csv", "--no-error", path, "config/devices/device3.yaml", f"./{path}"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 1 + 2


def test_phases_that_do_not_ascend_are_doubted(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As with a decimal comma in the middle of a list."""
    Project(checkout).edit("config/devices/device2.yaml", lambda text: text.replace("[0, 90, 180]", "[0, 22,5]"))
    assert main(["check", "config/devices/device2.yaml"]) == 0
    assert "\nphases do not ascend: 0, 22, 5; numbers have a decimal point, and no comma" in capsys.readouterr().out
    assert main(["check", "config/devices/device1.yaml"]) == 0
    assert "ascend" not in capsys.readouterr().out


def test_a_single_file_holds_the_end_of_the_stimulus(coarse: Path) -> None:
    """As the last state of the path does; the first differs."""
    case = ["fields", "config/devices/device2.yaml", "--condition", "alternate_180", "--interface", "shear", "-o"]
    for output in ("end.vtu", "path.pvd"):
        assert main([*case, output]) == 0
    end, last, first = (meshio.read(coarse / name).point_data for name in ("end.vtu", "path.vtu", "path/0000.vtu"))
    assert (end["displacement_mm"] == last["displacement_mm"]).all()
    assert (end["displacement_mm"] != first["displacement_mm"]).any()


def test_a_path_whose_last_file_is_a_folder_is_refused(checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (checkout / "path.vtu").mkdir()
    case = ["--condition", "alternate_180", "--interface", "shear", "-o", "path.pvd"]
    assert main(["fields", "config/devices/device2.yaml", *case]) == FAILED
    assert "path.vtu: is a folder" in capsys.readouterr().err
    assert not (checkout / "path").exists()


def test_a_key_without_its_section_is_told_with_it() -> None:
    """Rather than one that is spelt alike."""
    documents = {Path("a.yaml"): {"pitch_": {"value": 1.0}, "actuators": {"pitch": {"value": 2.0}}}}
    with pytest.raises(SceneError, match=r"pitch: found no such value in a\.yaml; .*; did you mean actuators\.pitch\?"):
        shared_out({"pitch": 2.5}, documents)


def bare(name: str) -> Scene:
    """A device's last condition on a coarse mesh."""
    return scene(name).with_conditions(scene(name).device.conditions[-1:]).coarsened(4.0)


def test_scenes_side_by_side_are_those_one_after_the_other() -> None:
    """In their order, to the last bit, and with as many steps."""
    tasks = [(bare("device1"), True), (bare("device3"), False), (bare("device2"), False)]
    counts = list[int](), list[int]()
    found = [
        list(side_by_side.forecasts(tasks, cores, lambda own=own: own.append(1)))
        for cores, own in zip((1, 2), counts, strict=True)
    ]
    assert found[0] == found[1]
    assert [rows[0]["device"] for rows in found[1]] == ["device1", "device3", "device2"]
    assert len(counts[0]) == len(counts[1]) == sum(steps(*task) for task in tasks)


def test_what_solves_side_by_side_ends_with_what_asked_for_it() -> None:
    """And nothing else does."""
    with get_context("spawn").Pool(1) as another:
        solved = side_by_side.forecasts([(bare("device2"), False)] * 3, 2)
        before = active_children()
        next(solved)
        children = [child for child in active_children() if child not in before]
        assert len(children) == 2
        solved.close()
        for child in children:
            child.join(60.0)
            assert child.exitcode is not None
        assert another.apply(len, ("abc",)) == 3


@pytest.fixture
def heeded() -> Iterator[None]:
    """Children heed an interruption, also of tests that a shell has put into the background, where it is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("heeded")
@pytest.mark.parametrize("later", [0.3, 1.0, 3.0])
def test_interrupted_side_by_side_says_one_line(checkout: Path, later: float) -> None:
    """Processes that have just begun say nothing, nor do those that load or solve."""
    command = [sys.executable, "-m", "fingerpad.cli", "robustness", "--cores", "2", "config/devices/device2.yaml"]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    told = subprocess.PIPE
    with subprocess.Popen(command, cwd=checkout, env=environment, stderr=told, start_new_session=True) as run:
        begun = Path(f"/proc/{run.pid}/task/{run.pid}/children")
        while len(begun.read_text().split()) < 3:  # two, and the process that keeps their books
            time.sleep(0.01)
        time.sleep(later)
        os.killpg(run.pid, signal.SIGINT)
        assert run.communicate(timeout=60.0)[1] == b"fingerpad: interrupted\n"
        assert run.returncode == INTERRUPTED


def test_a_process_that_is_ended_from_outside_is_a_named_error() -> None:
    solved = side_by_side.forecasts([(bare("device2"), False)] * 9, 2)
    next(solved)
    for child in active_children():
        child.kill()
    with pytest.raises(ProcessError, match=r"ended early, .*--cores 1"):
        list(solved)


def test_what_solves_side_by_side_does_not_outlive_what_is_killed(checkout: Path) -> None:
    """Nor does the process that keeps its books."""
    vary = ["--vary", "contact.friction=0.2,0.3,0.4,0.5,0.6,0.7", "--cores", "2", "--csv"]
    command = [sys.executable, "-m", "fingerpad.cli", "predict", *vary, "config/devices/device2.yaml"]
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    with subprocess.Popen(command, cwd=checkout, env=environment, stdout=subprocess.PIPE) as parent:
        assert parent.stdout is not None
        assert parent.stdout.readline().startswith(b"contact.friction,")  # so that all have begun
        parent.kill()
        parent.communicate(timeout=60.0)  # the pipe ends when the last process that has inherited it does


@pytest.mark.parametrize("cores", ["0", "-1", "two", "1.5"])
def test_cores_are_a_whole_number(cores: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["predict", "--cores", cores, "config/devices/device2.yaml"])
    assert ended.value.code == 2
    assert f"found '{cores}'; allowed: a whole number, at least 1" in capsys.readouterr().err
