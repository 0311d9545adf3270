"""The workflow's numbers against those recorded when they were last looked at."""

from __future__ import annotations

import csv
import hashlib
import re
from pathlib import Path

import meshio
import numpy as np
import pandas as pd
import pytest

from conftest import ROOT, SMALL_ONLY, Project
from fingerpad.contact.solution import Solution
from fingerpad.store import load
from recorded import KEY, TOLERANCE, not_as_recorded

NOT_BORNE_OUT = {  # with small strain, in the first half-cycle
    "Device 1: the change of strain correlates very well.": "undecided",
    "Device 2: the change of strain correlates very well.": "undecided",
    "Device 3: the change of strain correlates very well.": "undecided",
    "Device 1 without shear: the change of strain still correlates very well.": "undecided",
    "Device 1 without shear: the strain still correlates very poorly.": "undecided",
    "Device 2: the strain correlates well.": "undecided",
    "Device 1: the strain correlates very poorly.": "undecided",
    "Device 3: the strain correlates negatively.": "undecided",
    "Device 2 without shear: the strain correlates negatively.": "undecided",
    "Device 2 without shear: the change of strain correlates weakly.": "no",
    "Device 2 without shear: the change of strain is smaller at every phase.": "no",
    "Device 2 without shear: the change of strain correlates more weakly than with it.": "undecided",
}
BOTH = {"figure_4_receptors", "figure_5_correlation", "figure_6_shear", "ablation_shear"}  # drawn for both kinematics


@pytest.mark.workflow
def test_both_kinematics_stand_side_by_side(finite_run: Project) -> None:
    """On a coarse mesh: every case has a score with both, figures come twice, the order with shear is the same, and
    tissue that deforms much is stiffer, as its stiff skin is stretched. A device that leaves finite kinematics out has
    the scores of small ones, nothing else, and stops nothing."""
    scores = pd.read_csv(finite_run.folder / "results" / "scores.csv")
    alone = scores[scores["device"] == SMALL_ONLY]
    scores = scores[scores["device"] == "device2"]
    same = scores[scores["kinematics"] == "small"]
    assert set(alone["kinematics"]) == {"small"}
    assert alone["score"].tolist() == same["score"].tolist()
    assert not list((finite_run.folder / "results" / "finite").glob(f"{SMALL_ONLY}*"))
    small, finite = (scores[scores["kinematics"] == each].set_index(KEY[1:]) for each in ("small", "finite"))
    assert list(small.index) == list(finite.index)
    assert finite["score"].notna().all()
    assert (finite["score_error"] > 0.0).all()
    for table in (small, finite):
        change = table.xs(("shear", "change_of_strain"), level=("interface", "readout"))["score"]
        assert list(change.sort_values().index.get_level_values("condition")) == [
            "alternate_000",
            "alternate_090",
            "alternate_180",
        ]
    stems = {path.stem for path in (finite_run.folder / "results" / "figures").iterdir()}
    assert BOTH | {f"{stem}_finite" for stem in BOTH} | {"kinematics"} <= stems
    curves = pd.read_csv(finite_run.folder / "results" / "indentation.csv")
    assert set(curves.loc[curves["device"] == SMALL_ONLY, "kinematics"]) == {"small"}
    curves = curves[curves["device"] == "device2"].groupby(["kinematics", "interface"])
    ends = curves.last()["force_N_per_mm"].unstack("kinematics")
    assert (ends["finite"] > 1.3 * ends["small"]).all()


@pytest.mark.workflow
def test_fields_and_maps_of_finite_kinematics(finite_run: Project, project: Project, both_scenes: Path) -> None:
    """On demand: what a force alone does not give is solved anew, and is drawn and written as with small ones."""
    folder = "results/finite/device2/alternate_180/shear"
    targets = (f"{folder}/fields.vtu", "results/figures/map_finite_device2-alternate.png")
    run = project.snakemake(*targets, "--directory", finite_run.folder, "--config", f"scenes={both_scenes}")
    assert run.status == 0, run.text
    fields = meshio.read(finite_run.folder / folder / "fields.vtu").point_data
    assert {"displacement_mm", "logarithmic_strain", "cauchy_stress_MPa", "contact_pressure_MPa"} <= fields.keys()
    solved = load(finite_run.folder / folder / "solution.npz", Solution)
    assert fields["contact_pressure_MPa"].max() == pytest.approx(solved.pressure.max(), rel=1e-9)
    assert (finite_run.folder / targets[1]).read_bytes().startswith(b"\x89PNG")


@pytest.mark.workflow
def test_scores_are_those_recorded(finished: Project) -> None:
    """With small strain; those with finite strain are computed by `make reproduce`, and compared after it (.ci/run)."""
    assert not not_as_recorded(finished.folder / "results" / "scores.csv", ["small"])


@pytest.mark.workflow
def test_curves_of_force_end_where_solutions_begin(changeable: Project) -> None:
    """Of every device and interface: as deep, and as hard, as its conditions are pre-indented."""
    run = changeable.snakemake("results/indentation.csv")
    assert run.status == 0, run.text
    results = changeable.folder / "results"
    curves = pd.read_csv(results / "indentation.csv").groupby(["device", "interface"])
    assert len(curves) == 5
    for (device, interface), end in curves.last().iterrows():
        path = next((results / "small" / device).glob(f"*/{interface}/solution.npz"))
        solution = load(path, Solution)
        assert end["indentation_mm"] == pytest.approx(solution.indentation, rel=TOLERANCE)
        assert end["force_N_per_mm"] == pytest.approx(solution.pressing[0].sum(), rel=TOLERANCE)


@pytest.mark.workflow
def test_what_the_model_should_show(finished: Project) -> None:
    """The paper's orders of the change of strain come out; some of what it says of strain and of missing shear does
    not, and this list changes when the model does."""
    claims = pd.read_csv(finished.folder / "results" / "claims.csv")
    found = {claim: holds for claim, holds in zip(claims["claim"], claims["holds"], strict=True) if holds != "yes"}
    assert len(claims) == 21
    assert found == NOT_BORNE_OUT, claims["evidence"].tolist()


@pytest.mark.workflow
def test_figures_are_complete_and_byte_stable(changeable: Project) -> None:
    """All figures exist as PNG and PDF, and drawing one anew gives the same bytes."""
    figures = changeable.folder / "results" / "figures"
    stems = {path.stem for path in figures.iterdir()}
    wanted = {"figure_3_workflow", *BOTH}
    maps = {f"map_small_device1-{dispersion}" for dispersion in ("low", "medium", "high")}
    assert wanted | maps | {"section", "stimuli", "map_small_device2-alternate", "map_small_device3-alternate"} == stems
    assert {path.suffix for path in figures.iterdir()} == {".png", ".pdf"}
    before = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in figures.iterdir()}
    run = changeable.snakemake("--force", "results/figures/figure_5_correlation.png")
    assert run.status == 0, run.text
    assert before == {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in figures.iterdir()}


@pytest.mark.workflow
def test_a_run_writes_what_the_page_of_outputs_names(finite_run: Project) -> None:
    """Every column of its tables, and every array of what is solved and filtered."""
    named = set(re.findall(r"`([\w/]+)`", (ROOT / "docs" / "outputs.md").read_text(encoding="utf-8")))
    written = set[str]()
    for path in (finite_run.folder / "results").glob("*.csv"):
        with path.open(encoding="utf-8", newline="") as file:
            written |= set(next(csv.reader(file)))
    for name in ("solution", "filtered"):
        with np.load(finite_run.folder / f"results/small/device2/alternate_180/shear/{name}.npz") as archive:
            written |= set(archive.files)
    assert "certificate/cone_share" in written
    assert written <= named
