"""Other scorings: what can be worked out by hand, the configured one among them, and scores between the phases."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml

from fingerpad.pages.scorings import scorings_values
from fingerpad.perception.correlation import correlation_table
from fingerpad.perception.scorings import scoring_tables
from fingerpad.prediction.frictions import FRICTIONS, friction_rows
from fingerpad.prediction.phases import PHASES, phase_rows
from fingerpad.readouts.accuracy import relative_errors
from fingerpad.readouts.gabor import FilteredReadouts, filtered_readouts, gabor_filtered
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import roughness_score, roughness_scores, scene_span
from fingerpad.readouts.scorings import (
    DRIVES,
    Scoring,
    common_motion,
    other_scores,
    relative_motion,
    response,
    response_rows,
    scoring_rows,
)
from fingerpad.readouts.strain import Resampling
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow, Condition, Control, Device
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from literature import LITERATURE
from scenes import condensed, scene, solve

ROOT = Path(__file__).parents[1]
SCHEMAS = ROOT / "workflow" / "schemas"
RECORDED = pd.read_csv(ROOT / "tests" / "expected" / "scores.csv")
DEVICES = ("device1", "device2", "device3")
GRID = np.linspace(-9.0, 9.0, 901)
STRAIN, CHANGE = Readout.STRAIN, Readout.CHANGE_OF_STRAIN


def moved(normal: list[list[float]], tangential: list[list[float]]) -> Condition:
    """Displacements [mm], a row for each time."""
    time = 1.0 + np.arange(len(normal))
    return Condition("own", "own", 0.0, time, np.array(normal), np.array(tangential))


def read_as(strain: np.ndarray, change: np.ndarray) -> FilteredReadouts:
    """Those read-outs (k,) on GRID, filtered as configured."""
    same = Resampling(GRID, np.eye(GRID.size))
    return filtered_readouts(same, {STRAIN: strain, CHANGE: change}, scene("device2").model.gabor)


@pytest.mark.parametrize(
    ("condition", "relative", "common"),
    [
        (moved([[0.02, 0.02, 0.02]], [[0.0, 0.0, 0.0]]), 0.0, 0.02),
        (moved([[0.0, 0.0, 0.0]], [[0.02, -0.02, 0.02]]), 0.08, 0.02 / 3.0),
        (moved([[0.03, 0.0]], [[0.04, 0.0]]), 0.05, 0.025),  # 3, 4, 5
        (moved([[0.0, 0.0], [0.02, 0.0], [0.01, 0.01]], [[0.0, 0.0]] * 3), 0.02, 0.01),  # the largest of all times
        (moved([[0.02, 0.02], [0.0, 0.0]], [[0.0, 0.0]] * 2), 0.0, 0.02),  # also where all come back together
    ],
)
def test_motions_of_the_drive_in_closed_form(condition: Condition, relative: float, common: float) -> None:
    assert relative_motion(condition) == pytest.approx(relative, abs=1e-15)
    assert common_motion(condition) == pytest.approx(common, abs=1e-15)


def test_scores_without_a_filter_and_of_the_drive_in_closed_form() -> None:
    """An even strain has the length of the span as its area; half of it is there before the stimulus."""
    own = scene("device2")
    start, stop = scene_span(own)
    even = np.full(GRID.size, 0.3)
    condition = moved([[0.0] * 4], [[0.02, -0.02, 0.02, -0.02]])
    scores = other_scores(own, condition, read_as(even, -0.5 * even))
    assert scores[Scoring.UNFILTERED, STRAIN] == pytest.approx(0.3 * (stop - start))
    assert scores[Scoring.UNFILTERED, CHANGE] == pytest.approx(0.15 * (stop - start))
    assert scores[Scoring.RELATIVE, CHANGE] == pytest.approx(0.12)
    assert scores[Scoring.COMMON, CHANGE] == 0.0
    assert scores[Scoring.MOTION, CHANGE] == pytest.approx(0.12)


def test_motion_between_neighbours_is_that_of_one_time() -> None:
    """The one at which it is largest, summed over pairs."""
    normal = np.array([[0.0, 0.01, 0.0], [0.0, 0.03, 0.01]])
    path = Condition("a", "a", 0.0, np.array([1.0, 2.0]), normal, np.zeros_like(normal))
    assert relative_motion(path) == pytest.approx(0.05)


def test_a_sign_is_lost_where_it_is_said_to_be() -> None:
    """A change that is odd in x: the signed area vanishes, and of its magnitude each half does as much."""
    own = scene("device2")
    wave = 1e-3 * np.sin(2.0 * np.pi * GRID / 1.15)
    scores = other_scores(own, own.device.conditions[0], read_as(np.abs(GRID), wave))
    configured = roughness_score(GRID, gabor_filtered(GRID, wave, 1.15, 1.12), scene_span(own))
    assert abs(scores[Scoring.SIGNED, CHANGE]) < 1e-9 * configured
    magnitude = gabor_filtered(GRID, np.abs(wave), 1.15, 1.12)
    assert scores[Scoring.MAGNITUDE, CHANGE] == pytest.approx(roughness_score(GRID, magnitude, scene_span(own)))
    assert scores[Scoring.MAGNITUDE, CHANGE] < 0.2 * configured  # its period is half of what passes


def test_exchanged_filters_have_each_others_wavelength_and_the_indented_state_its_own() -> None:
    own = scene("device2")
    swapped = replace(
        own.model.gabor,
        wavelength_strain=own.model.gabor.wavelength_change,
        wavelength_change=own.model.gabor.wavelength_strain,
    )
    strain, change = np.exp(-(GRID**2)), 1e-3 * np.exp(-((GRID - 1.0) ** 2))
    scores = other_scores(own, own.device.conditions[0], read_as(strain, change))
    same = Resampling(GRID, np.eye(GRID.size))
    exchanged = filtered_readouts(same, {STRAIN: strain, CHANGE: change}, swapped)
    for readout in Readout:
        expected = roughness_score(GRID, exchanged.filtered(readout), scene_span(own))
        assert scores[Scoring.EXCHANGED, readout] == pytest.approx(expected, rel=1e-12)
    before = roughness_score(GRID, read_as(strain - change, change).filtered_strain, scene_span(own))
    assert scores[Scoring.INDENTED, STRAIN] == pytest.approx(before, rel=1e-12)


def test_errors_follow_those_of_the_configured_score() -> None:
    """A twentieth of it here. A drive has none; a signed area has that of the rectified one; unknown ones stay so."""
    own = scene("device2")
    condition = own.device.conditions[1]
    read = read_as(np.exp(-(GRID**2)), 1e-3 * np.exp(-((GRID - 1.0) ** 2)))
    case = ("small", "device2", condition.name, "shear")
    rows = list(scoring_rows(own, condition, Interface.SHEAR, read, {(*case, "change_of_strain"): 0.05}))
    assert {(row["scoring"], row["readout"]) for row in rows} == {*other_scores(own, condition, read)}
    for row in rows:
        if row["scoring"] in DRIVES:
            assert row["score_error"] == 0.0
            assert row["unit"] == "mm"
        elif row["readout"] == "strain":
            assert row["score_error"] is None
        elif row["scoring"] == Scoring.SIGNED:
            whole = roughness_score(GRID, read.filtered_change_of_strain, scene_span(own))
            assert row["score_error"] == pytest.approx(0.05 * whole)
            assert row["score_error"] > 0.05 * abs(row["score"])
        else:
            assert row["score_error"] == pytest.approx(0.05 * row["score"])


@pytest.mark.parametrize("period", [0.8, 1.15, 1.5, 2.5, 5.0, 12.0, 20.0])
@pytest.mark.parametrize("wavelength", [1.15, 2.8])
def test_response_is_what_the_filter_leaves_of_a_wave(period: float, wavelength: float) -> None:
    """Far from the ends of the grid; the sum over the grid is the integral to rounding, as the kernel is smooth and
    ends at 1.5e-8 of its peak."""
    grid = np.arange(-20.0, 20.0, 0.02)
    inside = np.abs(grid) < 8.0

    def left(wave: float) -> float:
        filtered = gabor_filtered(grid, np.cos(2.0 * np.pi * grid / wave), wavelength, 1.12)
        return float(np.abs(filtered[inside]).max())

    assert response(period, wavelength, 1.12) == pytest.approx(left(period) / left(wavelength), rel=2e-3, abs=1e-7)


def test_response_is_asked_of_faces_and_pitches() -> None:
    rows = response_rows(scene("device3"))
    assert [(row["length"], row["period"]) for row in rows[:4]] == [
        ("uniform", math.inf),
        ("face width", 1.5),
        ("pitch", 2.5),
        ("two pitches", 5.0),
    ]
    assert {row["readout"] for row in rows} == {"strain", "change_of_strain"}


def of_drives() -> pd.DataFrame:
    """Rows of the drive alone, for all shipped conditions; the read-outs do not matter to them."""
    nothing = read_as(np.ones(GRID.size), np.ones(GRID.size))
    rows = [
        row
        for name in DEVICES
        for condition in scene(name).device.conditions
        for row in scoring_rows(scene(name), condition, Interface.SHEAR, nothing, {})
        if row["scoring"] in DRIVES
    ]
    return pd.DataFrame(rows)


def test_the_drive_alone_has_the_stated_orders() -> None:
    """Relative motion those of Devices 1 and 2, common motion that of Device 3, both together all: what README and
    docs/scorings.md warn of."""
    found = scoring_tables(of_drives(), RECORDED[RECORDED["kinematics"] == "small"], LITERATURE)
    rises = found.claims[found.claims["claim"].str.contains("the change of strain rises")]
    held = rises.pivot(index="scoring", columns="claim", values="holds").eq("yes")
    held.columns = [claim[:8] for claim in held.columns]
    assert held.loc[Scoring.RELATIVE, ["Device 1", "Device 2"]].to_numpy().all()
    assert not held.loc[Scoring.RELATIVE, "Device 3"]
    assert held.loc[Scoring.COMMON, "Device 3"]
    assert not held.loc[Scoring.COMMON, ["Device 1", "Device 2"]].to_numpy().any()
    assert held.loc[Scoring.MOTION].to_numpy().all()
    # Device 1's surrogates are made of places of relative motion and phase
    of_device1 = found.correlations[found.correlations["device"] == "device1"].set_index("scoring")
    assert of_device1.loc[Scoring.RELATIVE, "r2"] == pytest.approx(1.0)


def test_the_configured_scoring_is_among_the_tables() -> None:
    small = RECORDED[RECORDED["kinematics"] == "small"]
    found = scoring_tables(of_drives(), small, LITERATURE)
    own = found.correlations[found.correlations["scoring"] == Scoring.CONFIGURED].drop(columns="scoring")
    pd.testing.assert_frame_equal(own, correlation_table(small, LITERATURE))
    for table in (found.correlations, found.claims):
        assert table["scoring"].unique().tolist() == [Scoring.CONFIGURED, *DRIVES]


def test_scores_at_phases_that_are_tried_are_the_shipped_ones(tmp_path: Path) -> None:
    """But for their errors, as contact is refined where any stimulus leads."""
    document = yaml.safe_load((ROOT / "config/devices/device2.yaml").read_text(encoding="utf-8"))
    document["kinematics"] = {"value": "small", "unit": "1", "source": "assumption: test"}
    device = tmp_path / "device2.yaml"
    device.write_text(yaml.safe_dump(document), encoding="utf-8")
    table = pd.DataFrame(phase_rows(device, SCHEMAS, ROOT / "config" / "config.yaml"))
    assert set(table["kinematics"]) == {"small"}
    change = table[table["readout"] == "change_of_strain"]
    assert change["phase_deg"].tolist() == PHASES
    assert 0.0 in PHASES and 90.0 in PHASES and 180.0 in PHASES
    shipped = RECORDED.query("kinematics == 'small' and device == 'device2' and interface == 'shear'")
    both = table.merge(shipped, on=["readout", "dispersion", "phase_deg"], suffixes=("", "_shipped"))
    assert len(both) == 6
    assert change.set_index("phase_deg")["motion_mm"].loc[[0.0, 90.0, 180.0]].tolist() == pytest.approx(
        [0.02, 0.07, 0.12]
    )
    assert ((both["score"] - both["score_shipped"]).abs() <= both["score_error_shipped"]).all()


def test_friction_leads_from_the_frictionless_scores_to_those_with_shear() -> None:
    """At its ends are those that are recorded, within their errors: here on twice the sizes."""
    table = pd.DataFrame(friction_rows(scene("device2").coarsened(2.0)))
    assert sorted(set(table["friction"])) == list(FRICTIONS)
    case = ["device", "condition", "readout"]
    for friction, interface in ((0.0, "frictionless"), (0.6, "shear")):
        recorded = RECORDED[(RECORDED["kinematics"] == "small") & (RECORDED["interface"] == interface)]
        both = table[table["friction"] == friction].merge(recorded, on=case, suffixes=("", "_recorded"))
        assert len(both) == 6
        # the error of a score is that of a mesh of twice the sizes, or a bound on it
        assert ((both["score"] - both["score_recorded"]).abs() <= 2.0 * both["score_error"]).all()


def test_a_larger_stroke_changes_strain_more_and_scores_less() -> None:
    """As docs/adding-a-device.md warns: of pins that move far into the skin the pattern widens, and the filter passes
    less of it. At a tenth of the strokes, twice as much of them scores nearly twice as high."""
    given = scene("device2")
    resampling = resampling_to_grid(condensed("device2")[0].arc, given.model.gabor.spacing)
    changes, scores = list[float](), list[float]()
    for stroke in (0.0125, 0.025, 0.125, 0.25):
        solution = solve("device2", moved([[stroke, -stroke, stroke, -stroke]], [[0.0] * 4]), Interface.SHEAR)
        changes.append(float(np.abs(solution.reading.change_of_strain).max()))
        read = filtered_readouts(resampling, solution.reading.readouts, given.model.gabor)
        scores.append(roughness_scores(given, read)[CHANGE])
    assert np.array(changes[1::2]) / changes[::2] == pytest.approx(2.0, rel=0.1)
    assert scores[1] / scores[0] == pytest.approx(2.0, rel=0.1)
    assert scores[3] < 0.6 * scores[2]


def test_page_says_where_scores_fall_before_they_rise() -> None:
    """One falls by more than its errors and then rises, one rises and falls again, one falls within its errors."""
    shapes = {"low": [2.0, 1.5, 3.0], "high": [1.0, 3.0, 2.0], "level": [1.1, 1.0, 3.0], "unknown": [2.0, 1.5, 3.0]}
    phases = pd.DataFrame(
        {
            "kinematics": "small",
            "device": "device1",
            "dispersion": name,
            "phase_deg": phase,
            "readout": "change_of_strain",
            "score": 1e-3 * score,
            "score_error": math.nan if name == "unknown" else 1e-4,
            "motion_mm": 0.02 + phase * 1e-4,
        }
        for name, scores in shapes.items()
        for phase, score in zip((0.0, 90.0, 180.0), scores, strict=True)
    )
    small = RECORDED[RECORDED["kinematics"] == "small"]
    indented = small[small["readout"] == "strain"].assign(
        scoring=str(Scoring.INDENTED), score=lambda t: t["score"] / 1.01
    )
    others = pd.concat([of_drives(), indented])
    tables = {"scores": small, "others": others, "phases": phases} | vars(scoring_tables(others, small, LITERATURE))
    slippery = {"device": "device2", "condition": "alternate_000", "readout": "change_of_strain"}
    frictions = pd.DataFrame(
        [slippery | {"friction": mu, "score": score} for mu, score in ((0.0, 4.2e-3), (0.01, 6e-4))]
    )
    response = pd.DataFrame(response_rows(scene("device1")))
    values = scorings_values(tables | {"response": response, "frictions": frictions})
    assert str(values["frictions"]).splitlines()[0] == "| device | condition | 0 | 0.01 |"
    assert str(values["frictions"]).splitlines()[-1] == "| device2 | alternate_000 | 4.20 | 0.60 |"
    alone = scorings_values(tables | {"response": response, "frictions": pd.DataFrame()})
    assert alone["frictions"] == "(No device is predicted without friction.)"
    assert "| small | device1 | low | 2.000 | 1.500 at 90° | yes | 20.0 to 29.0 | yes |" in str(values["phases"])
    assert "| small | device1 | high | 1.000 | 1.000 at 0° | no | 20.0 | no |" in str(values["phases"])
    assert "| unknown | 2.000 | 1.500 at 90° | within errors |" in str(values["phases"])
    assert "| level | 1.100 | 1.000 at 90° | within errors | 20.0 to 29.0 | yes |" in str(values["phases"])
    assert "| no finger: relative motion | yes | yes | yes | no |" in str(values["drives"])
    assert "| scoring | device 1 by phase | device 1 by dispersion | device 2 | device 3 |" in str(values["drives"])
    assert "| device | length | mm | SA-1 filter | RA-1 filter |" in str(values["response"])
    assert "| as configured | small | 0.565, falling |" in str(values["strain"])
    assert "no finger" not in str(values["strain"])
    assert values["indented"] == "+1.0 to +1.0 % with small kinematics"
    assert "| no finger: both motions | yes | yes | yes | yes | 0.981, rising | 1.000, rising |" in str(
        values["drives"]
    )
    assert str(values["drives"]).count("no finger") == len(DRIVES)
    assert "no finger" not in str(values["change"])
    assert "| device1 | face width | 1 | 0.0036 % | 66 % |" in str(values["response"])
    assert "| device1 | uniform | ∞ | 8.5 % |" in str(values["response"])
    assert values["published"] == "device1 0.0004; device2 0.989, rising; device3 negative correlation"


def test_relative_errors_are_those_that_are_known() -> None:
    rows = RECORDED.astype(object).where(RECORDED.notna(), None).to_dict("records")
    errors = relative_errors(rows)
    assert len(errors) == RECORDED["score_error"].notna().sum()
    assert not any(math.isnan(error) for error in errors.values())


def test_a_signed_area_ends_with_the_span() -> None:
    """Of a change at its end, most of which the filter carries beyond it."""
    own = scene("device2")
    start, stop = scene_span(own)
    read = read_as(np.abs(GRID), 1e-3 * np.exp(-((GRID - stop + 0.3) ** 2) / 0.1))
    points = np.linspace(start, stop, 20001)
    within = np.trapezoid(np.interp(points, GRID, read.filtered_change_of_strain), points)
    found = other_scores(own, own.device.conditions[0], read)[Scoring.SIGNED, CHANGE]
    assert found == pytest.approx(within, rel=1e-4)


def test_a_single_pin_has_no_pitch() -> None:
    pin = Device("single", "One pin", Control.DISPLACEMENT, ActuatorRow((0.0,), 1.0, 0.1), (moved([[0.02]], [[0.0]]),))
    rows = response_rows(Scene(scene("device2").model, pin))
    assert [(row["length"], row["period"]) for row in rows] == [("uniform", math.inf), ("face width", 1.0)] * 2


def test_what_is_no_area_of_a_filtered_curve_is_in_mm() -> None:
    own = scene("device2")
    read = read_as(np.exp(-(GRID**2)), 1e-3 * np.exp(-((GRID - 1.0) ** 2)))
    rows = scoring_rows(own, own.device.conditions[1], Interface.SHEAR, read, {})
    units = {row["scoring"]: row["unit"] for row in rows}
    assert {name for name, unit in units.items() if unit == "mm"} == {Scoring.UNFILTERED, *DRIVES}


def test_phases_are_predicted_with_each_kinematics_and_with_shear(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def forecast(own: Scene) -> list[dict[str, object]]:
        asked.append((own.kinematics, own.device.interfaces()))
        return []

    monkeypatch.setattr("fingerpad.prediction.phases.forecast", forecast)
    assert not list(phase_rows(ROOT / "config/devices/device2.yaml", SCHEMAS, ROOT / "config" / "config.yaml"))
    assert asked == [(each, (Interface.SHEAR,)) for each in Kinematics]
