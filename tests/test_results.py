"""Where results are found, and what is said of those that are not."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from fingerpad.errors import FingerpadError, MissingResultError
from fingerpad.results import needed, results_root, scene_of_case, scenes
from scenes import scene

CONFIG = Path(__file__).parents[1] / "config"


def test_root_is_the_nearest_folder_with_results(tmp_path: Path) -> None:
    (tmp_path / "results").mkdir()
    deep = tmp_path / "notebooks" / "mine"
    deep.mkdir(parents=True)
    assert results_root(deep) == results_root(tmp_path) == tmp_path.resolve()


def test_no_results_at_all_is_said(tmp_path: Path) -> None:
    with pytest.raises(MissingResultError, match=r"no folder 'results' .*`snakemake all`"):
        results_root(tmp_path)


def test_missing_result_names_its_target(tmp_path: Path) -> None:
    with pytest.raises(MissingResultError, match=r"`snakemake results/scores\.csv`"):
        needed(tmp_path, "results/scores.csv")
    with pytest.raises(MissingResultError, match="`snakemake accuracy`"):
        needed(tmp_path, "results/accuracy/closed_forms.csv", "accuracy")


def test_result_that_is_there_is_found(tmp_path: Path) -> None:
    (tmp_path / "results").mkdir()
    (tmp_path / "results" / "scores.csv").touch()
    assert needed(tmp_path, "results/scores.csv").is_file()


def test_scenes_are_those_that_were_computed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The shipped ones, or those of the folder that a rule names."""
    monkeypatch.delenv("SCENES", raising=False)
    assert {"device1", "device2", "device3"} <= set(scenes())
    (tmp_path / "devices").mkdir()
    shutil.copy(CONFIG / "config.yaml", tmp_path)
    shutil.copy(CONFIG / "devices" / "device3.yaml", tmp_path / "devices" / "own.yaml")
    monkeypatch.setenv("SCENES", str(tmp_path))
    assert {name: scene.device.name for name, scene in scenes().items()} == {"own": "own"}


def test_of_nested_folders_with_results_the_nearest_is_taken(tmp_path: Path) -> None:
    """A checkout within another's folder; a file of that name holds none."""
    inner = tmp_path / "inner"
    (tmp_path / "results").mkdir()
    (inner / "results").mkdir(parents=True)
    (inner / "deep").mkdir()
    (inner / "deep" / "results").touch()
    assert results_root(inner / "deep") == inner.resolve()


def test_a_case_that_there_is_not_is_told_with_those_that_there_are() -> None:
    known = {name: scene(name) for name in ("device2", "device3")}
    assert scene_of_case(known, "device2", "alternate_090", "frictionless") is known["device2"]
    for case, told in (
        (("device9", "alternate_090", "shear"), r"device: found 'device9'; allowed: device2, device3; did you mean"),
        (("device2", "high_090", "shear"), "device2: no condition 'high_090'; allowed: alternate_000, "),
        (
            ("device3", "alternate_090", "frictionless"),
            r"device3: found the interface 'frictionless'; allowed: 'shear' \(",
        ),
    ):
        with pytest.raises(FingerpadError, match=told):
            scene_of_case(known, *case)
