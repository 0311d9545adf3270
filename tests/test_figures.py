"""Figures say what they show: axes with units, n, what the ratings are; and they are saved byte for byte the same."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import fields, replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection, TriMesh
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.text import Annotation, Text

from fingerpad.arrays import FloatArray
from fingerpad.contact.certificate import Certificate
from fingerpad.contact.formulation import Status
from fingerpad.contact.solution import Solution
from fingerpad.fields.section_fields import Fields
from fingerpad.figures.ablation import ablation_figure
from fingerpad.figures.accuracy import accuracy_figure
from fingerpad.figures.correlation import correlation_figure
from fingerpad.figures.frequency import frequency_figure
from fingerpad.figures.kinematics import kinematics_figure
from fingerpad.figures.maps import RECEPTORS, strain_map_figure
from fingerpad.figures.phases import phases_figure
from fingerpad.figures.receptors import DeviceReadouts, face_arcs, receptor_figure
from fingerpad.figures.section import DRIVEN, HEAD, NU, section_figure
from fingerpad.figures.shear import shear_figure
from fingerpad.figures.stimuli import stimuli_figure
from fingerpad.figures.style import (
    ALONG,
    BLACK,
    BLUE,
    GREY,
    INTERFACE_LOOK,
    INTO,
    INTO_EDGE,
    KINEMATICS_LOOK,
    MIDDLE,
    NARROW,
    ORANGE,
    POINTS,
    TEXT,
    WIDE,
    condition_styles,
    conditions_of,
    save,
    save_as,
)
from fingerpad.figures.variation import variation_figure
from fingerpad.figures.workflow import workflow_figure
from fingerpad.perception.correlation import correlation_table
from fingerpad.perception.ratings import Literature
from fingerpad.readouts.gabor import FilteredReadouts
from fingerpad.readouts.strain import Reading
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow, Body, Condition, Control, Device
from fingerpad.scene.finger import Material
from fingerpad.scene.numerics import Numerics
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.scenefile import build_model
from fingerpad.scene.stimuli import condition_name
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.scene.yamlfile import read_yaml
from fingerpad.tissue.compliance import CondensedSection
from fingerpad.tissue.mesh import SectionMesh, mesh_section, nominal_edges
from fingerpad.words import MINUS

ROOT = Path(__file__).parents[1]
COARSE = Numerics(
    edge_size=0.4,
    edge_zone=0.1,
    face_size=0.4,
    growth=0.6,
    receptor_size=0.5,
    nail_size=1.5,
    largest_size=1.5,
    contact_margin=0.25,
    indentation_increments=2,
    stimulus_increments=1,
    newton_tolerance=1e-9,
    max_cuts=1,
)
MODEL = build_model(read_yaml(ROOT / "config/config.yaml"))
PINS = ActuatorRow((-2.0, 0.0, 2.0), 1.0, 0.1)
PUCKS = ActuatorRow((-1.5, 1.5), 1.5, 0.0, Body(Material(1.0, 0.48), 0.15))


def make_condition(name: str, dispersion: str, phase: float, count: int, size: float = 0.02) -> Condition:
    still = np.zeros((1, count))
    return Condition(name, dispersion, phase, np.array([1.0]), still, still + size * math.cos(math.radians(phase)))


PHASED = Device(
    "phased",
    "Phased pins",
    Control.DISPLACEMENT,
    PINS,
    tuple(make_condition(f"{d}_{p:03d}", d, float(p), 3) for d in ("low", "high") for p in (0, 60, 120, 180)),
)
FORCED = Device(
    "forced",
    "Forced pucks",
    Control.FORCE,
    PUCKS,
    tuple(make_condition(f"all_{p:03d}", "all", p, 2) for p in (0, 90, 180)),
)
# histories: two of one dispersion and phase, so that only their names tell them apart; nobody has rated them
UNRATED = Device(
    "unrated",
    "Histories without ratings",
    Control.DISPLACEMENT,
    PINS,
    (make_condition("push", "own", 37.5, 3), make_condition("shove", "own", 37.5, 3, 0.1)),
)
PIN = ActuatorRow((0.0,), 1.0, 0.1)
SINGLE = Device("single", "One pin", Control.DISPLACEMENT, PIN, (make_condition("lone_000", "lone", 0.0, 1),))
DEVICES = (PHASED, FORCED, UNRATED)
TITLES = {device.name: device.title for device in DEVICES}


def make_scores(devices: Sequence[Device] = DEVICES) -> pd.DataFrame:
    rows = []
    for device in devices:
        for number, condition in enumerate(device.conditions):
            for interface in Interface:
                for readout in Readout:
                    known = interface in device.interfaces()
                    score = 0.3 + 0.01 * number**2 if known else math.nan
                    kind = (condition.dispersion, condition.phase_deg, str(interface), str(readout))
                    note = "" if known else "no prediction"
                    rows.append(("small", device.name, condition.name, *kind, score, 0.01 * score, "mm2", note))
    columns = [
        "kinematics",
        "device",
        "condition",
        "dispersion",
        "phase_deg",
        "interface",
        "readout",
        "score",
        "score_error",
        "unit",
        "note",
    ]
    return pd.DataFrame(rows, columns=columns)


SCORES = make_scores()
RATINGS = pd.DataFrame(
    [(d.name, c.name, float(i), "surrogate", "made up") for d in (PHASED, FORCED) for i, c in enumerate(d.conditions)],
    columns=["device", "condition", "rating", "kind", "source"],
)
ORDER = pd.DataFrame(
    [("forced", "all_000", "<", "all_090", "made up"), ("forced", "all_090", "<", "all_180", "made up")],
    columns=["device", "lower", "relation", "higher", "source"],
)
PUBLISHED = pd.DataFrame(
    [
        ("phased", "shear", "strain", 0.876, 1, "good", "made up"),
        ("forced", "shear", "strain", math.nan, None, "poor", "made up"),
    ],
    columns=["device", "interface", "readout", "r2", "slope", "words", "source"],
)
LITERATURE = Literature(RATINGS, ORDER, PUBLISHED)


@pytest.fixture(scope="module")
def correlations(tmp_path_factory: pytest.TempPathFactory) -> pd.DataFrame:
    """The table as figures get it: through a CSV file."""
    path = tmp_path_factory.mktemp("tables") / "correlations.csv"
    correlation_table(SCORES, LITERATURE).to_csv(path, index=False)
    return pd.read_csv(path)


def make_readouts(device: Device) -> DeviceReadouts:
    arc = np.linspace(-8.0, 8.0, 401)
    waves = [FilteredReadouts(arc, *(np.sin(arc + i) for i in range(4))) for _ in device.conditions]
    faces = np.array([[x - 0.5, x + 0.5] for x in device.actuators.positions])
    return DeviceReadouts(device, dict(zip((c.name for c in device.conditions), waves, strict=True)), faces)


@pytest.fixture(scope="module")
def section() -> SectionMesh:
    return mesh_section(Scene(replace(MODEL, numerics=COARSE), PHASED), nominal_edges(PHASED.actuators))


def curves(axes: Axes) -> list[Line2D]:
    """Curves of conditions, which have marks."""
    return [line for line in axes.lines if len(line.get_xdata()) > 2 and line.get_marker() != "None"]


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(Text) if text.get_visible())


def axis_labels(figure: Figure) -> list[tuple[str, str]]:
    return [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]


def require_legible(figure: Figure) -> None:
    figure.draw_without_rendering()
    width, height = figure.get_size_inches()
    assert round(width * 25.4, 6) in {NARROW, MIDDLE, WIDE}
    drawn = figure.get_tightbbox()
    assert drawn.x0 >= 0.0 and drawn.y0 >= 0.0 and drawn.x1 <= width and drawn.y1 <= height, "something is cut off"
    sizes = [t.get_fontsize() for t in figure.findobj(Text) if t.get_text().strip()]
    assert min(float(size) for size in sizes) >= TEXT


def test_correlation_panels_state_their_statistics(correlations: pd.DataFrame) -> None:
    figure = correlation_figure(SCORES, RATINGS, correlations, TITLES, Kinematics.SMALL)
    require_legible(figure)
    text = words(figure)
    for said in (
        "ordinal surrogate",
        "n = 8",
        "n = 3",
        "surrogates' R² = ",
        "τ = ",
        "R² range ",
        "published R² 0.876,\nrising",
        *TITLES.values(),
    ):
        assert said in text, said
    assert text.count("no ratings") == 2
    for told in re.findall(r"τ = .*?surrogates' R² = \d\.\d\d\b", text, re.DOTALL):
        assert told.index("slope") < told.index("surrogates'")  # the order, its range and what is published come first
    assert not re.search(r"R² = \d\.\d{3}", text)
    assert ("Strain score (mm²)", "Perceived roughness\n(ordinal surrogate)") in axis_labels(figure)
    assert ("Change of strain score (10⁻³ mm²)", "Perceived roughness\n(ordinal surrogate)") in axis_labels(figure)
    assert "published: poor" in text
    assert "(open)" not in text
    open_ = words(correlation_figure(SCORES, RATINGS, correlations.assign(slope_open=1), TITLES, Kinematics.SMALL))
    assert open_.replace("\n", " ").count("ing (open)") == open_.count("R² = ") > 0
    other = correlation_figure(SCORES, RATINGS, correlations.assign(range_open=1), TITLES, Kinematics.SMALL)
    said = words(other).replace("\n", " ")
    assert "behind a range, only with some of the ratings in it" in said
    assert said.count(", open") == len(re.findall(r"R² range \d", said)) > 0


def test_captions_tell_unknown_errors_from_small_ones(correlations: pd.DataFrame) -> None:
    """Neither has a bar that is seen."""
    said = "Where an error is not known there is no bar either"
    lost = SCORES.assign(score_error=SCORES["score_error"].where(SCORES.index != SCORES.index[0]))
    for scores, is_said in ((SCORES, False), (lost, True)):
        figure = correlation_figure(scores, RATINGS, correlations, TITLES, Kinematics.SMALL)
        require_legible(figure)
        assert (said in words(figure).replace("\n", " ")) is is_said


def test_measured_ratings_are_not_called_surrogates(correlations: pd.DataFrame) -> None:
    measured = correlation_table(SCORES, replace(LITERATURE, ratings=RATINGS.assign(kind="measured")))
    text = words(correlation_figure(SCORES, RATINGS, measured, TITLES, Kinematics.SMALL))
    assert "surrogate" not in text
    assert "(measured)" in text
    assert re.search(r"n = 8.*\nR² = \d\.\d{3}, p ", text)  # of what was measured it comes first, to three decimals
    assert ", p " in text
    assert ", p " not in words(correlation_figure(SCORES, RATINGS, correlations, TITLES, Kinematics.SMALL))


def test_unrated_device_is_ranked_and_not_correlated(correlations: pd.DataFrame) -> None:
    figure = correlation_figure(SCORES, RATINGS, correlations, {"unrated": "Histories"}, Kinematics.SMALL)
    require_legible(figure)
    for axes in figure.axes:
        assert axes.get_ylabel() == "In order of score"
        assert [label.get_text() for label in axes.get_yticklabels()] == ["push", "shove"]
        markers = [line for line in axes.lines if line.get_marker() != "None"]
        assert len(axes.lines) == len(markers)  # no line is fitted
        assert [line.get_xdata()[0] for line in markers] == sorted(line.get_xdata()[0] for line in markers)
    assert "R² =" not in words(figure)
    none = correlations[correlations["device"] == "unrated"]
    alone = words(correlation_figure(SCORES, RATINGS, none, {"unrated": "Histories"}, Kinematics.SMALL))
    assert not [said for said in ("least squares", "Ratings:", "range:", "τ") if said in alone]
    assert "spread: range of scores" in " ".join(alone.split())
    assert "not compared with perception" in " ".join(words(figure).split())
    rated = correlations[correlations["device"] == "phased"]
    assert "not compared with perception" not in " ".join(
        words(correlation_figure(SCORES, RATINGS, rated, {"phased": "Phased pins"}, Kinematics.SMALL)).split()
    )


def test_unrated_conditions_with_one_score_share_a_place() -> None:
    scores = make_scores([UNRATED]).assign(score=0.3)
    correlations = correlation_table(scores, Literature(RATINGS[:0], ORDER[:0], PUBLISHED[:0]))
    figure = correlation_figure(scores, RATINGS[:0], correlations, {"unrated": "Histories"}, Kinematics.SMALL)
    for axes in figure.axes:
        assert [label.get_text() for label in axes.get_yticklabels()] == ["push +1"]
        assert {line.get_ydata()[0] for line in axes.lines} == {1.0}


def test_captions_explain_what_is_there_alone(correlations: pd.DataFrame) -> None:
    certain = correlations.assign(r_error=0.0, slope_open=0)
    for given, is_open in ((certain, False), (certain.assign(slope_open=1), True)):
        for figure in (
            correlation_figure(SCORES, RATINGS, given, TITLES, Kinematics.SMALL),
            ablation_figure(SCORES, given, TITLES, Kinematics.SMALL, False),
        ):
            assert ("Open:" in words(figure)) is is_open
    assert "range:" in words(correlation_figure(SCORES, RATINGS, correlations, TITLES, Kinematics.SMALL))
    unordered = correlation_table(SCORES, replace(LITERATURE, order=ORDER[:0]))
    assert "range:" not in words(correlation_figure(SCORES, RATINGS, unordered, TITLES, Kinematics.SMALL))


def test_points_lie_where_the_tables_say(correlations: pd.DataFrame) -> None:
    figure = correlation_figure(SCORES, RATINGS, correlations, {"forced": "Forced pucks"}, Kinematics.SMALL)
    strain, change = figure.axes
    dots = [line.get_xydata()[0] for line in strain.lines if line.get_linestyle() == "None"]
    np.testing.assert_allclose(dots, [[0.30, 0.0], [0.31, 1.0], [0.34, 2.0]])
    dots = [line.get_xydata()[0] for line in change.lines if line.get_linestyle() == "None"]
    np.testing.assert_allclose(np.array(dots)[:, 0], [300.0, 310.0, 340.0])


@pytest.mark.parametrize(("device", "said"), [(PHASED, "n = 8"), (FORCED, "no prediction"), (UNRATED, "no ratings")])
def test_shear_figure_of_any_device(device: Device, said: str, correlations: pd.DataFrame) -> None:
    figure = shear_figure(device.name, device.title, SCORES, RATINGS, correlations, Kinematics.SMALL, turning=True)
    require_legible(figure)
    text = words(figure)
    assert said in text
    assert f"{device.title}, without shear" in text
    assert f"{device.title}, with shear" in text


def test_ablation_says_where_there_is_no_prediction(correlations: pd.DataFrame) -> None:
    figure = ablation_figure(SCORES, correlations, TITLES, Kinematics.SMALL, turning=True)
    require_legible(figure)
    text = words(figure)
    assert "without shear: no prediction" in text
    assert "with shear the contact normal turns on rounded edges" in " ".join(text.lower().split())
    assert text.count("\nno prediction") == 2 * len(FORCED.conditions)
    assert "with shear: no ratings" in text
    assert "n = 8" in text
    assert "ordinal surrogate" in text
    assert {label for _, label in axis_labels(figure)} == {"Strain\nscore (mm²)", "Change of strain\nscore (10⁻³ mm²)"}
    for phased in figure.axes[:2]:
        assert len(phased.patches) == 2 * len(PHASED.conditions)
    for forced in figure.axes[2:4]:
        assert len(forced.patches) == len(FORCED.conditions)
    for unrated in figure.axes[4:]:
        assert [label.get_text() for label in unrated.get_xticklabels()] == ["push", "shove"]


def test_kinematics_shows_what_there_is_and_says_what_was_left_out() -> None:
    """Bars of both kinematics for the first device, of small ones for the other, whose title says so."""
    titles = {device.name: device.title for device in (FORCED, UNRATED)}
    twice = SCORES[SCORES["device"] == FORCED.name].assign(kinematics="finite")
    curves = pd.DataFrame(
        [
            (kinematics, device, "shear", height, height**2, False)
            for kinematics, device in (("small", FORCED.name), ("finite", FORCED.name), ("small", UNRATED.name))
            for height in (0.0, 1.0)
        ],
        columns=["kinematics", "device", "interface", "indentation_mm", "force_N_per_mm", "limit_point"],
    )
    figure = kinematics_figure(pd.concat([SCORES, twice]), curves, titles)
    require_legible(figure)
    assert [" ".join(axes.get_title(loc="left").split()) for axes in figure.axes[::3]] == [
        FORCED.title,
        f"{UNRATED.title} (small strain alone)",
    ]
    drawn = [sum(np.isfinite(bar.get_height()) for bar in axes.patches) for axes in figure.axes]
    assert drawn[1:3] == [2 * len(FORCED.conditions)] * 2
    assert drawn[4:] == [len(UNRATED.conditions)] * 2


def variation_tables(device: Device, missing: int) -> list[list[dict[str, object]]]:
    """Three tables of scores of a device; of one the first condition has none."""
    own = SCORES[SCORES["device"] == device.name].astype(object)
    tables = [own.where(own.notna(), None).to_dict("records") for _ in range(3)]
    tables[missing] = [row | ({"score": None} if row["condition"] == device.conditions[0].name else {})
                       for row in tables[missing]]  # fmt: skip
    return tables


@pytest.mark.parametrize("device", [PHASED, FORCED, UNRATED])
def test_variation_has_a_curve_a_condition_and_gaps_where_there_is_no_score(device: Device) -> None:
    values = [1.0, 1.5, 3.0]
    tables = variation_tables(device, 1)
    figure = variation_figure("actuators.edge_radius", "mm", values, [Scene(MODEL, device)] * 3, tables)
    require_legible(figure)
    assert "Small strain" in words(figure) or "small strain" in words(figure)
    assert len(figure.axes) == len(Readout) * len(device.interfaces())
    for axes in figure.axes:
        curves = [line for line in axes.lines if len(line.get_xdata()) == len(values)]
        assert len(curves) == len(device.conditions)
        assert [list(line.get_xdata()) for line in curves] == [values] * len(curves)
        assert [int(np.isnan(line.get_ydata()).sum()) for line in curves] == [1, *[0] * (len(curves) - 1)]
    assert axis_labels(figure)[-1][0] == "actuators.edge radius (mm)"


def test_variation_runs_from_left_to_right_and_shows_all_interfaces_that_there_are() -> None:
    """However values are given, and whichever scene comes first: the first of these has friction alone."""
    alone = replace(PHASED, frictionless=False)
    own = halved_without_shear()
    own = own[own["device"] == PHASED.name]
    values = [3.0, 1.0]
    tables = [own.assign(score=value * own["score"]).to_dict("records") for value in values]
    tables[0] = [row for row in tables[0] if row["interface"] == "shear"]
    scenes = [Scene(MODEL, alone), Scene(MODEL, PHASED)]
    figure = variation_figure("actuators.edge_radius", "mm", values, scenes, tables)
    assert len(figure.axes) == 4
    with_shear, without = (
        next(line for line in axes.lines if len(line.get_xdata()) == len(values)) for axes in figure.axes[:2]
    )
    assert list(with_shear.get_xdata()) == list(without.get_xdata()) == [1.0, 3.0]
    np.testing.assert_allclose(with_shear.get_ydata(), [0.3, 0.9])
    np.testing.assert_allclose(without.get_ydata(), [0.15, np.nan])


def test_phases_have_a_curve_per_dispersion_and_marks_where_the_device_is_tried() -> None:
    rows = [
        (kinematics, PHASED.name, dispersion, phase, readout, size * (1.0 + phase / 60.0), 1e-4, "mm2")
        for kinematics in Kinematics
        for readout, size in (("strain", 0.3), ("change_of_strain", 1e-3))
        for dispersion in ("low", "high")
        for phase in (0.0, 60.0, 120.0, 180.0)
    ]
    columns = ["kinematics", "device", "dispersion", "phase_deg", "readout", "score", "score_error", "unit"]
    figure = phases_figure([PHASED], pd.DataFrame(rows, columns=columns))
    require_legible(figure)
    assert len(figure.axes) == len(Kinematics)
    for axes in figure.axes:
        tried = sorted({float(line.get_xdata()[0]) for line in axes.lines if len(line.get_xdata()) == 2})
        assert tried == sorted({condition.phase_deg for condition in PHASED.conditions})
        curves = [line for line in axes.lines if len(line.get_xdata()) == 4]
        assert len({(line.get_linestyle(), line.get_fillstyle()) for line in curves}) == len(curves) == 2
        assert len({line.get_color() for line in curves}) == 1  # colours are phases in all other figures
        for curve in curves:
            np.testing.assert_allclose(curve.get_ydata(), [1.0, 2.0, 3.0, 4.0])
        np.testing.assert_allclose(error_bars(axes)[0][0], np.array([0.9, 1.9, 2.9, 3.9]))
        assert axes.get_ylim()[0] == 0.0
        np.testing.assert_array_equal(axes.get_xticks(), [0.0, 45.0, 90.0, 135.0, 180.0])
    assert PHASED.title in figure.axes[0].get_title(loc="left")
    assert PHASED.title not in figure.axes[1].get_title(loc="left")
    assert "10⁻³ mm²" in figure.axes[0].get_ylabel()


def test_phases_without_a_prediction_say_so() -> None:
    """Of a device that leaves finite kinematics out, beside one that does not."""
    rows = [(kinematics, device.name, device.conditions[0].dispersion, 0.0, "change_of_strain", 1e-3, 1e-4, "mm2")
            for kinematics, device in (("small", PHASED), ("small", FORCED), ("finite", PHASED))]  # fmt: skip
    columns = ["kinematics", "device", "dispersion", "phase_deg", "readout", "score", "score_error", "unit"]
    figure = phases_figure([PHASED, FORCED], pd.DataFrame(rows, columns=columns))
    require_legible(figure)
    assert [any("no prediction" in text.get_text() for text in axes.texts) for axes in figure.axes] == [False] * 3 + [
        True
    ]


def test_variation_sets_what_is_no_number_side_by_side() -> None:
    values = ["full", "touch", [0, 1, 1, 0]]
    figure = variation_figure("contact.criterion", "1", values, [Scene(MODEL, PHASED)] * 3, variation_tables(PHASED, 0))
    require_legible(figure)
    assert [label.get_text() for label in figure.axes[-1].get_xticklabels()] == ["full", "touch", "[0,1,1,0]"]


def test_variation_tells_long_values_apart() -> None:
    """Which are alike at both ends; numbers stand for them, and the caption says for which."""
    values = [[0, 1, 0, 1, 0, 1, 0, 1], [0, 1, 1, 0, 0, 1, 0, 1], [0, 0, 0, 0, 1, 1, 1, 1]]
    scenes = [Scene(MODEL, PHASED)] * 3
    figure = variation_figure("stimulus.dispersions.a", "1", values, scenes, variation_tables(PHASED, 0))
    require_legible(figure)
    assert [label.get_text() for label in figure.axes[-1].get_xticklabels()] == ["1", "2", "3"]
    assert "1: [0,1,0,1,0,1,0,1]; 2: [0,1,1,0,0,1,0,1]; 3:" in words(figure).replace("\n", " ")


def test_accuracy_has_a_panel_a_case_and_shows_what_is_held_to_a_tolerance() -> None:
    rows = [
        (f"Case {case}, nu = 0.3", quantity, h, 100, 1.0, 1.0, h**2, 0.005 if h == 0.1 else math.nan)
        for case in range(5)
        for h in (0.4, 0.2, 0.1)
        for quantity in ("displacement", "element pressure", "exx", "eyy")[: case + 1]
    ]
    rows.append(("Case 0, nu = 0.3", "order, displacement", 0.1, 100, 2.0, 2.0, 0.0, 0.05))
    names = ["case", "quantity", "spacing", "unknowns", "computed", "exact", "error", "tolerance"]
    figure = accuracy_figure(pd.DataFrame(rows, columns=names), Kinematics.SMALL)
    require_legible(figure)
    titles = [f"Case {number}, \N{GREEK SMALL LETTER NU} = 0.3" for number in range(5)]
    assert [axes.get_title(loc="left") for axes in figure.axes[:5]] == titles
    assert axis_labels(figure)[0] == ("Element length (mm)", "Relative error")
    assert "displacement: order 2.00" in words(figure)
    curve, held, tolerance = figure.axes[0].lines
    np.testing.assert_allclose(curve.get_xydata(), [[0.4, 0.16], [0.2, 0.04], [0.1, 0.01]])
    np.testing.assert_allclose(held.get_xydata(), [[0.1, 0.01]])
    assert set(tolerance.get_ydata()) == {0.005}


def test_accuracy_of_finite_kinematics_stands_apart_and_tolerances_have_their_quantitys_colour() -> None:
    names = ["case", "quantity", "spacing", "unknowns", "computed", "exact", "error", "tolerance"]
    table = pd.DataFrame(
        [
            ("Spence", "stick zone", 0.1, 100, 1.0, 1.0, 0.003, 0.011),
            ("Spence", "no lift", 0.1, 100, 1.0, 1.0, 0.002, 0.009),
            ("Finite shear", "hencky", 0.1, 100, 1.0, 1.0, 1e-15, 1e-10),
            ("Bent block", "gradient", 0.1, 100, 1.0, 1.0, 1e-5, 1e-3),
        ],
        columns=names,
    )
    small, finite = (accuracy_figure(table, each) for each in Kinematics)
    assert [axes.get_title(loc="left") for axes in small.axes if axes.axison] == ["Spence"]
    assert [axes.get_title(loc="left") for axes in finite.axes if axes.axison] == ["Finite shear", "Bent block"]
    drawn = {line.get_ydata()[0]: line.get_color() for line in small.axes[0].lines if line.get_linestyle() == "--"}
    marks = {line.get_ydata()[0]: line.get_color() for line in small.axes[0].lines if line.get_linestyle() != "--"}
    assert drawn == {0.011: marks[0.003], 0.009: marks[0.002]}
    assert "have the colours of their quantities" in words(small)
    assert "have the colours of their quantities" not in words(finite)
    loose = table[table["case"] == "Spence"].assign(tolerance=[0.011, None])  # as no quantity but one is held
    lines = accuracy_figure(loose, Kinematics.SMALL).axes[0].lines
    assert [line.get_color() for line in lines if line.get_linestyle() == "--"] == [marks[0.003]]


@pytest.mark.parametrize("devices", [DEVICES, [UNRATED], [SINGLE]], ids=len)
def test_stimuli_have_a_panel_a_condition(devices: list[Device]) -> None:
    figure = stimuli_figure(devices)
    require_legible(figure)
    conditions = [condition for device in devices for condition in device.conditions]
    assert len(figure.axes) == len(conditions)
    for axes, condition in zip(figure.axes, conditions, strict=True):
        heights = np.array([bar.get_height() for bar in axes.patches])
        moved = 1e3 * np.stack([condition.normal, condition.tangential])  # um
        assert np.abs(heights).max() == pytest.approx(np.abs(moved).max())
        assert heights.size % moved.shape[2] == 0
        bottom, top = axes.get_ylim()
        assert bottom <= heights.min() <= heights.max() <= top
        values = [text.get_text().replace(MINUS, "-") for text in axes.texts if text.get_text()[-1].isdigit()]
        assert [float(value) for value in values] == pytest.approx(heights, abs=0.05)  # um


def test_receptor_figure_has_a_row_a_device_and_dispersion() -> None:
    figure = receptor_figure([make_readouts(device) for device in DEVICES], Kinematics.SMALL)
    require_legible(figure)
    assert len(figure.axes) == 2 * sum(len({c.dispersion for c in device.conditions}) for device in DEVICES)
    assert {label for _, label in axis_labels(figure)} == {"Strain (%)", "Change of strain (%)"}
    assert len({axes.get_xlim() for axes in figure.axes}) == 1
    text = words(figure)
    assert "Phased pins, low dispersion" in text
    assert text.count("n = 4") == 2  # low and high
    assert "unrated: push" in text
    assert [len(curves(axes)) for axes in figure.axes[:2]] == [4, 4]


def test_receptor_figure_shows_the_whole_row_though_not_all_of_it_touches() -> None:
    """Scores are of the whole row; only what skin touches is shaded."""
    whole = make_readouts(PHASED)
    faces = whole.faces.copy()
    faces[0] = np.nan
    one, all_ = (receptor_figure([each], Kinematics.SMALL).axes[0] for each in (replace(whole, faces=faces), whole))
    assert one.get_xlim() == all_.get_xlim()
    assert len(one.patches) == len(all_.patches) - 1


def test_receptor_figure_explains_what_is_drawn_and_says_what_is_not() -> None:
    """Of a single pin all phases are one stimulus. Legends are read by rows, with dispersions below phases."""
    taps = [replace(make_condition(condition_name("lone", p), "lone", 0.0, 1), phase_deg=p) for p in (0.0, 45.0)]
    figure = receptor_figure([make_readouts(replace(SINGLE, conditions=tuple(taps)))], Kinematics.SMALL)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "0°",
        "pre-indented",
        "under a face before the stimulus",
    ]
    assert "n = 2: 45° as 0°" in words(figure)
    figure = receptor_figure([make_readouts(device) for device in DEVICES], Kinematics.SMALL)
    figure.draw_without_rendering()
    boxes = [(text.get_window_extent(), text.get_text()) for text in figure.legends[0].get_texts()]
    ordered = [said for box, said in sorted(boxes, key=lambda each: (-round(each[0].y0), each[0].x0)) if said.strip()]
    assert ordered[:5] == ["0°", "60°", "90°", "120°", "180°"]
    assert ordered[-3:] == ["low dispersion", "high dispersion", "under a face before the stimulus"]


@pytest.mark.parametrize("device", [PHASED, UNRATED])
def test_workflow_figure_goes_from_strain_to_score(device: Device) -> None:
    shear = SCORES[(SCORES["device"] == device.name) & (SCORES["interface"] == "shear")]
    figure = workflow_figure(Scene(MODEL, device), make_readouts(device), shear)
    require_legible(figure)
    assert [label for _, label in axis_labels(figure)] == [
        "Strain (%)",
        "Filtered strain\n(mm)",
        "Strain\nscore (mm²)",
        "Change of strain (%)",
        "Filtered change of strain\n(10⁻³ mm)",
        "Change of strain\nscore (10⁻³ mm²)",
    ]
    text = words(figure)
    assert f"n = {len(device.conditions)} conditions" in text
    few = len(device.conditions) < 6
    assert ("0.300\n±0.003" in text) is few  # more would overlap
    assert ("Above bars: scores" in text) is few
    assert "Small strain." in text
    assert "λ = 2.8 mm" in text
    assert "λ = 1.15 mm" in text
    assert [bar.get_height() for bar in figure.axes[2].patches] == list(
        shear.loc[shear["readout"] == "strain", "score"]
    )


def test_section_names_every_layer(section: SectionMesh) -> None:
    figure = section_figure(MODEL, section, DEVICES)
    require_legible(figure)
    text = words(figure)
    for layer in MODEL.finger.layers:
        modulus, poisson = layer.material.modulus, layer.material.poisson
        stiffness = f"{modulus:g} MPa" if modulus >= 1.0 else f"{1e3 * modulus:g} kPa"
        said = f"{layer.name.replace('_', ' ')}, {layer.thickness:g} mm, E {stiffness}, {NU} {poisson:g}"
        assert said in text
    rows = ("rigid, pitch 2, width 1 mm\nedge radius 0.1 mm", "pitch 3, width 1.5 mm\nedge radius 0, thickness 0.15 mm")
    for said in ("bone, rigid", "receptors, 0.6 mm deep", "16 mm", "13 mm", *rows, *TITLES.values()):
        assert said in text
    named = [label.get_text().partition(",")[0] for label in figure.axes[0].texts]
    assert named.index("viable epidermis") < named.index("receptors") < named.index("dermis")
    assert [axes.get_xlabel() for axes in figure.axes[1:]] == ["x (mm)"] * len(DEVICES)


def require_apart(labels: Sequence[Text]) -> None:
    boxes = [label.get_window_extent() for label in labels if label.get_text() and label.get_rotation() % 90.0 == 0.0]
    for one, other in pairwise(boxes):
        assert not one.overlaps(other)


@pytest.mark.parametrize("alike", [False, True], ids=["phases", "names"])
@pytest.mark.parametrize("count", [3, 10])
def test_names_of_many_conditions_are_legible(count: int, alike: bool) -> None:
    """Of two dispersions with long names, and of one phase, where conditions are called by name."""
    spreads = ("low", "every_second_actuator_against_its_neighbours_on_both_sides")
    conditions = [make_condition(f"{s}_{p:03d}", s, 0.0 if alike else p, 3) for s in spreads for p in range(count)]
    device = replace(PHASED, conditions=tuple(conditions))
    scores = make_scores([device])
    correlations = correlation_table(scores, Literature(RATINGS[:0], ORDER, PUBLISHED[:0]))
    ablation = ablation_figure(scores, correlations, {device.name: device.title}, Kinematics.SMALL, False)
    ranks = correlation_figure(scores, RATINGS[:0], correlations, {device.name: device.title}, Kinematics.SMALL)
    way = workflow_figure(Scene(MODEL, device), make_readouts(device), scores[scores["interface"] == "shear"])
    for figure in (ablation, way) if alike and count > 3 else (ablation, ranks, way):
        require_legible(figure)
        assert all(axes.get_position().height > 0.07 for axes in figure.axes)
    for axes in ablation.axes:
        require_apart(axes.get_xticklabels())
    numbers = [text for text in way.axes[2].texts if "±" in text.get_text()]
    assert len(numbers) in {0, len(conditions)}
    require_apart(numbers)


def titled(title: str, section: SectionMesh, correlations: pd.DataFrame) -> list[Figure]:
    """Every figure that shows panels of several devices or two of one, all of that title; figure 3, which shows none,
    is the last.
    """
    shear = SCORES[(SCORES["device"] == PHASED.name) & (SCORES["interface"] == "shear")]
    curves = pd.DataFrame(
        [("small", device.name, "shear", height, height, False) for device in DEVICES for height in (0.0, 1.0)],
        columns=["kinematics", "device", "interface", "indentation_mm", "force_N_per_mm", "limit_point"],
    )
    devices = [replace(device, title=title) for device in DEVICES]
    titles = {device.name: device.title for device in devices}
    entries = [make_readouts(device) for device in devices]
    return [
        correlation_figure(SCORES, RATINGS, correlations, titles, Kinematics.SMALL),
        shear_figure(PHASED.name, title, SCORES, RATINGS, correlations, Kinematics.SMALL, False),
        ablation_figure(SCORES, correlations, titles, Kinematics.SMALL, False),
        kinematics_figure(SCORES, curves, titles),
        receptor_figure(entries, Kinematics.SMALL),
        section_figure(MODEL, section, devices),
        workflow_figure(Scene(MODEL, entries[0].device), entries[0], shear),
    ]


def test_a_long_title_takes_no_room_from_panels(section: SectionMesh, correlations: pd.DataFrame) -> None:
    """The longest that the schema allows."""
    schema = read_yaml(ROOT / "workflow/schemas/device.schema.yaml")
    longest = ("Pin " * 100)[: schema["properties"]["title"]["properties"]["value"]["maxLength"] - 1] + "s"
    for short, long in zip(*(titled(title, section, correlations) for title in ("Pins", longest)), strict=True):
        require_legible(short)
        require_legible(long)
        for few, many in zip(short.axes, long.axes, strict=True):
            assert many.get_position().width > 0.9 * few.get_position().width
            assert many.get_position().height > 0.6 * few.get_position().height


@pytest.mark.parametrize("title", [r"bad $\foo$ x", r"5 \$ or $ 6"])
def test_a_title_is_text_and_no_mathematics(
    title: str, section: SectionMesh, correlations: pd.DataFrame, tmp_path: Path
) -> None:
    """An SVG file says of its letters, which are curves, what they spell."""
    path = tmp_path / "figure.svg"
    for figure in titled(title, section, correlations)[:-1]:
        save_as(figure, path)
        assert f"<!-- {title}" in path.read_text(encoding="utf-8")


THICK = replace(FORCED, actuators=replace(PUCKS, body=Body(Material(1.0, 0.48), 4.0)))
BROAD = replace(SINGLE, actuators=replace(PIN, width=15.0))


def arrows(axes: Axes) -> list[FloatArray]:
    """Ends (2, 2) of the arrows [mm] that show how actuators are driven."""
    found = [text for text in axes.texts if isinstance(text, Annotation) and text.arrowprops and text.xy[1] < 0.0]
    small = [arrow for arrow in found if (arrow.arrowprops or {}).get("linewidth") == DRIVEN]
    return [np.array([arrow.xyann, arrow.xy]) for arrow in small]


@pytest.mark.parametrize(
    "devices", [[THICK], [PHASED, THICK], [PHASED, FORCED, BROAD]], ids=["alone", "beside", "broad"]
)
def test_arrows_are_in_sight_and_longer_than_their_heads(section: SectionMesh, devices: list[Device]) -> None:
    figure = section_figure(MODEL, section, devices)
    require_legible(figure)
    for axes, device in zip(figure.axes[1:], devices, strict=True):
        drawn = arrows(axes)
        assert len(drawn) == len(device.actuators.positions)
        assert all(arrow[:, 1].min() > axes.get_ylim()[0] for arrow in drawn)
        lengths = [np.hypot(*np.diff(axes.transData.transform(arrow), axis=0)[0]) for arrow in drawn]
        assert min(lengths) * POINTS / figure.dpi > 2.0 * HEAD  # shorter ones are all head
        body = device.actuators.body
        assert body is None or all(arrow[:, 1].max() < -body.thickness for arrow in drawn)


def test_actuators_that_rest_have_no_arrow(section: SectionMesh) -> None:
    path = np.array([[0.02, 0.0, -0.02]])
    device = replace(PHASED, conditions=(Condition("rub", "own", 0.0, np.array([1.0]), 0.0 * path, path),))
    drawn = arrows(section_figure(MODEL, section, [device]).axes[1])
    assert [float(arrow[:, 0].mean()) for arrow in drawn] == pytest.approx([-2.0, 2.0])


@pytest.mark.parametrize(("along", "count"), [(1.0, 1), (-1.0, 2), (0.5, 2), (0.0, 1)])
def test_a_motion_on_one_diagonal_has_one_arrow(section: SectionMesh, along: float, count: int) -> None:
    moved = [replace(c, normal=c.tangential, tangential=along * c.tangential) for c in PHASED.conditions]
    axes = section_figure(MODEL, section, [replace(PHASED, conditions=tuple(moved))]).axes[1]
    drawn = arrows(axes)
    assert len(drawn) == count * len(PINS.positions)
    tilt = np.diff(drawn[0], axis=0)[0]
    assert bool(np.isclose(tilt[0], tilt[1])) is (along == 1.0)


@pytest.mark.parametrize(("moved", "heads"), [((1.0, 2.0), "<-"), ((-1.0, 0.0), "->"), ((1.0, -1.0), "<->")])
def test_an_arrow_has_a_head_where_actuators_go(section: SectionMesh, moved: tuple[float, float], heads: str) -> None:
    """Of a history, which goes no other way than it says; drawn from where positive displacements lead to."""
    still = np.zeros((2, len(PINS.positions)))
    history = np.repeat(np.array(moved)[:, None], len(PINS.positions), axis=1)
    condition = replace(PHASED.conditions[0], time=np.array([1.0, 2.0]), normal=0.02 * history, tangential=still)
    axes = section_figure(MODEL, section, [replace(PHASED, conditions=(condition,))]).axes[1]
    drawn = [t for t in axes.texts if isinstance(t, Annotation) and (t.arrowprops or {}).get("linewidth") == DRIVEN]
    assert {(arrow.arrowprops or {})["arrowstyle"] for arrow in drawn} == {heads}
    assert all(arrow.xyann[1] > arrow.xy[1] for arrow in drawn)


def make_contact(row: ActuatorRow) -> CondensedSection:
    """Skin of equal elements of 0.1 mm under every actuator; nothing else of the section is drawn."""
    x = np.concatenate([np.linspace(centre - 0.6, centre + 0.6, 25) for centre in row.positions])
    weight = np.tile(np.concatenate([[0.1 / 6.0], np.tile([0.4 / 6.0, 0.2 / 6.0], 12)]), len(row.positions))
    none = np.zeros((0, 0))
    return CondensedSection(
        position=np.stack([x, 0.0 * x], axis=1),
        weight=weight,
        compliance=none,
        receptor=none,
        arc=none,
        strain=none,
        residual=0.0,
    )


def make_solution(contact: CondensedSection, row: ActuatorRow, traction: FloatArray) -> Solution:
    place = (contact.position[:, 0].reshape(len(row.positions), -1) - np.array(row.positions)[:, None]).ravel()
    none = np.zeros(0)
    force = np.stack([0.0 * traction, traction], axis=1)
    return Solution(
        height=1.5,
        indentation=1.5,
        depth=1.5,
        position=contact.position,
        indented_actuator=row.nearest(contact.position[:, 0]),
        force=force[None],
        contact=none,
        actuator_force=none,
        arc=none,
        reading=Reading(time=0, strain=none, change_of_strain=none, rival=0, rival_change=none, rival_peak=1.0),
        pressure=traction,
        shear=0.5 * traction,
        actuator=row.nearest(contact.position[:, 0]),
        place=place,
        status=np.where(traction > 0.0, Status.STICK, Status.OPEN),
        iterations=1,
        cuts=0,
        searches=0,
        certificate=Certificate(*[0.0] * len(fields(Certificate))),
    )


@pytest.mark.parametrize("device", [PHASED, FORCED, UNRATED, SINGLE], ids=lambda device: str(device.name))
def test_maps_show_every_condition_of_a_dispersion(device: Device, section: SectionMesh) -> None:
    dispersion = device.conditions[-1].dispersion
    distinct = [c for c in device.conditions if device.first_with_stimulus_of(c.name) is c]
    corner = section.mesh.doflocs[:, section.mesh.t.T.ravel()]
    shape = (len(distinct), corner.shape[1])
    side = np.array([[0, 1]])
    contact = make_contact(device.actuators)
    still = np.zeros((len(distinct), *corner.shape))
    fields = Fields(corner, side, side[:0], side, still, np.full(shape, 0.2), np.full(shape, -0.003))
    pressed = np.where(np.abs(np.linspace(-1.0, 1.0, 25)) < 0.8, 0.03, 0.0)
    solution = make_solution(contact, device.actuators, np.tile(pressed, len(device.actuators.positions)))
    shown = [c.name for c in device.conditions if c.dispersion == dispersion]
    scene = Scene(MODEL, device)
    figure = strain_map_figure(scene, dispersion, fields, {c.name: solution for c in distinct})
    require_legible(figure)
    for above, beneath in zip(figure.axes[: len(shown)], figure.axes[2 * min(len(shown), 3) :], strict=False):
        if beneath.get_xlabel():
            assert above.get_position().intervalx == pytest.approx(beneath.get_position().intervalx, abs=1e-3)
    labels = axis_labels(figure)
    assert labels.count(("x (mm)", "Traction (kPa)")) >= 1
    assert len(figure.axes) == 3 * len(shown) + 2
    assert "Max. principal\nstrain" in labels[-2][1]
    assert "Change of\nstrain (%)" in labels[-1][1]
    bar = figure.axes[-1].get_ylim()
    assert bar[0] == -bar[1]
    assert bar[1] >= 0.3  # per cent: the change that is drawn
    text = words(figure)
    assert device.title in text
    assert f"n = {len(shown)} condition" in text
    tractions = next(axes for axes in figure.axes if axes.get_ylabel() == "Traction (kPa)")
    assert max(line.get_ydata().max() for line in tractions.lines if len(line.get_xdata()) > 2) == pytest.approx(30.0)


def test_maps_show_a_history_when_it_is_read(section: SectionMesh) -> None:
    """Pins that go 0.3 mm aside and come back are drawn, with their tractions, where they were when it was read."""
    aside = np.array([[0.3] * 3, [0.0] * 3])
    history = Condition("tap", "only", 0.0, np.array([1.0, 2.0]), np.zeros_like(aside), aside)
    device = replace(PHASED, conditions=(history,))
    corner = section.mesh.doflocs[:, section.mesh.t.T.ravel()]
    side, shape = np.array([[0, 1]]), (1, corner.shape[1])
    fields = Fields(
        corner, side, side[:0], side, np.zeros((1, *corner.shape)), np.full(shape, 0.2), np.full(shape, 0.001)
    )
    pressed = np.tile(np.where(np.abs(np.linspace(-1.0, 1.0, 25)) < 0.8, 0.03, 0.0), 3)
    found = make_solution(make_contact(device.actuators), device.actuators, pressed)
    middle = {}
    for read in (0, 1):
        solutions = {"tap": replace(found, reading=replace(found.reading, time=read))}
        figure = strain_map_figure(Scene(MODEL, device), "only", fields, solutions)
        tractions = next(axes for axes in figure.axes if axes.get_ylabel() == "Traction (kPa)")
        drawn = [line.get_xdata() for line in tractions.lines if len(line.get_xdata()) > 2]
        middle[read] = float(np.mean(np.concatenate(drawn)))
        assert "when strain at the receptors has changed most" in words(figure).replace("\n", " ")
    assert middle[0] - middle[1] == pytest.approx(0.3, abs=1e-9)  # but for rounding


def test_receptor_curves_are_in_per_cent() -> None:
    """Strain on the left and its change on the right, a hundred times the number without a unit."""
    own = make_readouts(SINGLE)
    (found,) = own.readouts.values()
    panels = receptor_figure([own], Kinematics.SMALL).axes
    for axes, values in zip(panels, (found.strain, found.change_of_strain), strict=True):
        (curve,) = curves(axes)
        np.testing.assert_array_equal(curve.get_xdata(), found.arc)
        np.testing.assert_allclose(curve.get_ydata(), 100.0 * values)


def test_strain_is_drawn_beside_that_before_the_stimulus_from_which_it_changes() -> None:
    """A thin line in figures 4 and 3, at strain less its change, with an entry in the legend; change has none."""
    own = make_readouts(PHASED)
    found = next(iter(own.readouts.values()))
    shear = SCORES[(SCORES["device"] == PHASED.name) & (SCORES["interface"] == "shear")]
    receptors = receptor_figure([own], Kinematics.SMALL)
    way = workflow_figure(Scene(MODEL, PHASED), own, shear)
    for figure, strain, change in ((receptors, 0, 1), (way, 0, 3)):
        drawn = [
            [line for line in figure.axes[each].lines if len(line.get_xdata()) > 2 and line.get_marker() == "None"]
            for each in (strain, change)
        ]
        assert [len(lines) for lines in drawn] == [1, 0]
        np.testing.assert_allclose(drawn[0][0].get_ydata(), 100.0 * (found.strain - found.change_of_strain))
        assert drawn[0][0].get_color() == GREY
        assert "pre-indented" in [text.get_text() for text in figure.legends[0].get_texts()]


def error_bars(axes: Axes) -> list[FloatArray]:
    """Lower and upper ends (2, n) of the vertical bars of errors, an array for each time that some were drawn."""
    drawn = [each for each in axes.collections if isinstance(each, LineCollection)]
    return [np.array([segment[:, 1] for segment in each.get_segments()]).T for each in drawn]


@pytest.mark.parametrize("device", [PHASED, UNRATED])
def test_workflow_curves_and_errors_are_in_the_units_of_their_axes(device: Device) -> None:
    """Strain in per cent; filtered it is in mm, its change in thousandths of that, and so are scores and errors."""
    own = make_readouts(device)
    shear = SCORES[(SCORES["device"] == device.name) & (SCORES["interface"] == "shear")]
    panels = workflow_figure(Scene(MODEL, device), own, shear).axes
    found = own.readouts[device.conditions[0].name]
    for row, readout, factor in zip((panels[:3], panels[3:]), Readout, (1.0, 1e3), strict=True):
        read = (100.0 * found.unfiltered(readout), factor * found.filtered(readout))
        for axes, values in zip(row[:2], read, strict=True):
            curve = next(line for line in axes.lines if len(line.get_xdata()) > 2)
            np.testing.assert_allclose(curve.get_xydata(), np.stack([found.arc, values], axis=1))
        scores = factor * shear.loc[shear["readout"] == readout, "score"].to_numpy()
        np.testing.assert_allclose([bar.get_height() for bar in row[2].patches], scores)
        if device is UNRATED:
            said = [text.get_text() for text in row[2].texts if "±" in text.get_text()]
            assert said[0] == ("0.300\n±0.003" if factor == 1.0 else "300\n±3")
        else:
            np.testing.assert_allclose(error_bars(row[2])[0], [0.99 * scores, 1.01 * scores])


def test_maps_draw_each_condition_under_its_own_stimulus(section: SectionMesh) -> None:
    """Two stimuli, which conditions of the second dispersion have in the opposite order: the first moves all tissue by
    0.1 mm, strains it by 2 % and changes that by -1 %, the second by 0.2 mm, 4 % and -2 %. Pins stand where they are
    moved to, at the height of indentation; pressure and shear are in kPa, and both are in sight.
    """
    low = PHASED.by_dispersion["low"][1:3]
    device = replace(PHASED, conditions=(*low, *(PHASED.by_dispersion["high"][number] for number in (2, 1))))
    corner = section.mesh.doflocs[:, section.mesh.t.T.ravel()]
    one = 3 * int(np.flatnonzero((section.mesh.t == section.skin[section.skin.size // 2]).any(axis=0))[0])
    side, times = np.array([[one, one + 1]]), np.array([1.0, 2.0])
    places = np.stack([0.1 * times, [1.5, 1.5]], axis=1)  # the skin comes up to the faces
    moved = np.repeat(places[:, :, None], corner.shape[1], axis=2)
    each = np.tile(times[:, None], corner.shape[1])
    fields = Fields(corner, side, side, side, moved, 0.02 * each, -0.01 * each)
    found = make_solution(make_contact(PINS), PINS, np.tile(np.linspace(0.01, 0.03, 25), 3))
    found = replace(found, shear=-0.5 * found.pressure)
    shown = device.by_dispersion["high"]
    figure = strain_map_figure(Scene(MODEL, device), "high", fields, dict.fromkeys([c.name for c in low], found))
    panels = figure.axes
    for axes, condition, time, percent in zip(
        panels[:4], [*shown, *shown], [2.0, 1.0, 2.0, 1.0], [4.0, 2.0, -2.0, -1.0], strict=True
    ):
        (drawn,) = [each for each in axes.collections if isinstance(each, TriMesh)]
        np.testing.assert_allclose(np.asarray(drawn.get_array()), percent)
        ends = corner[:, side[0]].T + np.array([0.1 * time, 1.5])
        assert all(np.allclose(line.get_xydata()[:2], ends) for line in axes.lines)
        pins = [patch.get_xy() for patch in axes.patches if isinstance(patch, Polygon)]
        assert [pin[:, 1].max() for pin in pins] == pytest.approx([found.height] * 3)
        middle = [(pin[:, 0].min() + pin[:, 0].max()) / 2.0 for pin in pins]
        assert middle == pytest.approx(list(PINS.positions + condition.tangential[0]))
    for axes in panels[4:6]:
        for colour, traction in ((INTO_EDGE, found.pressure), (ALONG, found.shear)):
            lines = [line.get_ydata() for line in axes.lines if line.get_color() == colour]
            np.testing.assert_allclose(np.concatenate(lines), 1e3 * traction)
        bottom, top = axes.get_ylim()
        assert bottom <= -15.0 and top >= 30.0
    strain, change = (axes.get_ylim() for axes in panels[6:])
    assert strain[0] == 0.0 and 4.0 <= strain[1] <= 5.0  # rounded up to 5 %
    assert -change[0] == change[1] and 2.0 <= change[1] <= 2.5  # rounded up to 0.5 %

    more = replace(found, reading=replace(found.reading, change_of_strain=np.array([0.01, -0.0333])))
    solutions = {low[0].name: found, low[1].name: more}
    far = strain_map_figure(Scene(MODEL, device), "high", fields, solutions).axes[-1].get_ylim()
    assert far == pytest.approx((-3.5, 3.5))  # all that receptors have, though less than a tenth of the area has it


def test_maps_mark_the_receptors_among_the_lines_between_layers(section: SectionMesh) -> None:
    """With the colour of the section's figure; pressure is an area, shear a dark line."""
    vertices = section.mesh.t.T.ravel()
    one_of = np.empty(section.mesh.nvertices, dtype=np.int64)
    one_of[vertices] = np.arange(vertices.size)
    layers = np.setdiff1d(section.interfaces(), section.receptor_facets)
    lines = (
        one_of[section.mesh.facets[:, facets].T]
        for facets in (layers, section.receptor_facets, section.mesh.boundary_facets())
    )
    corner = section.mesh.doflocs[:, vertices]
    shape = (1, corner.shape[1])
    fields = Fields(corner, *lines, np.zeros((1, *corner.shape)), np.full(shape, 0.1), np.full(shape, 0.01))
    found = make_solution(make_contact(PIN), PIN, np.full(25, 0.03))
    figure = strain_map_figure(Scene(MODEL, SINGLE), "lone", fields, {"lone_000": found})
    receptors = section.mesh.p[:, section.mesh.facets[:, section.receptor_facets].ravel()]
    for axes in figure.axes[:2]:
        (dashes,) = [line for line in axes.lines if line.get_color() == RECEPTORS["color"]]
        assert len(dashes.get_xdata()) > 2
        for point in dashes.get_xydata():
            assert np.hypot(*(receptors - point[:, None])).min() == pytest.approx(0.0, abs=1e-12)
        layers = np.concatenate([line.get_xydata() for line in axes.lines if line.get_path_effects()])
        apart = [np.hypot(*(receptors - point[:, None])).min() for point in layers if np.isfinite(point).all()]
        assert min(apart) > 0.1  # mm: the thinnest layer beside receptors is thicker
    assert "receptors" in [text.get_text() for text in figure.legends[0].get_texts()]
    tractions = figure.axes[2]
    (area,) = [each for each in tractions.collections if isinstance(each, PolyCollection)]
    assert max(path.vertices[:, 1].max() for path in area.get_paths()) == pytest.approx(30.0)  # kPa


def test_colours_of_maps_end_by_area_not_by_the_number_of_elements(section: SectionMesh) -> None:
    """The five smallest of 400 elements in view, 0.2 % of the area, are strained ten times as much as all others."""
    corner = section.mesh.doflocs[:, section.mesh.t]
    first, second = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    smallest = np.argsort(np.abs(first[0] * second[1] - first[1] * second[0]))[:5]
    strain = np.full(section.mesh.t.shape, 0.04)
    strain[:, smallest] = 0.4
    drawn, side = section.mesh.doflocs[:, section.mesh.t.T.ravel()], np.array([[0, 1]])
    still = np.zeros((1, *drawn.shape))
    fields = Fields(drawn, side, side[:0], side, still, strain.T.reshape(1, -1), np.full((1, drawn.shape[1]), 0.001))
    found = make_solution(make_contact(PIN), PIN, np.full(25, 0.03))
    figure = strain_map_figure(Scene(MODEL, SINGLE), "lone", fields, {"lone_000": found})
    assert figure.axes[-2].get_ylim() == pytest.approx((0.0, 5.0))  # per cent


def test_kinematics_draws_forces_scores_and_errors_of_both() -> None:
    """Small kinematics to the left of finite ones, whose scores and errors are twice as large here."""
    forced = SCORES[SCORES["device"] == FORCED.name]
    finite = forced.assign(kinematics="finite", score=2.0 * forced["score"], score_error=2.0 * forced["score_error"])
    names = ["kinematics", "device", "interface", "indentation_mm", "force_N_per_mm", "limit_point"]
    heights = np.linspace(0.0, 1.0, 4)
    curves = [("small", FORCED.name, "shear", height, 0.3 * height**2, False) for height in heights]
    scores = pd.concat([finite, forced])
    panels = kinematics_figure(scores, pd.DataFrame(curves, columns=names), {FORCED.name: FORCED.title}).axes
    drawn = next(line for line in panels[0].lines if len(line.get_xdata()) == heights.size)
    np.testing.assert_allclose(drawn.get_xydata(), np.stack([heights, 0.3 * heights**2], axis=1))
    for axes, readout, factor in zip(panels[1:], Readout, (1.0, 1e3), strict=True):
        shear = (forced["readout"] == readout) & (forced["interface"] == "shear")
        own = factor * forced.loc[shear, "score"].to_numpy()
        bars = sorted((bar.get_x(), bar.get_height()) for bar in axes.patches)
        assert [height for _, height in bars] == pytest.approx(list(np.stack([own, 2.0 * own], axis=1).ravel()))
        for times, ends in zip((1.0, 2.0), error_bars(axes), strict=True):
            np.testing.assert_allclose(ends, times * np.stack([0.99 * own, 1.01 * own]))


def test_stimuli_of_several_times_are_drawn_where_actuators_have_moved_farthest() -> None:
    """Into the skin by 20 and back to 5 µm, beside which they go aside by 10 µm: bars of both, in this order."""
    moved = np.outer([0.5, 1.0, 0.25], np.ones(3))
    time = np.array([1.0, 2.0, 3.0])
    history = replace(PHASED.conditions[0], time=time, normal=0.02 * moved, tangential=-0.01 * moved)
    (axes,) = stimuli_figure([replace(PHASED, conditions=(history,))]).axes
    assert [bar.get_height() for bar in axes.patches] == pytest.approx([20.0] * 3 + [-10.0] * 3)


def test_what_bars_do_not_show_stands_below_their_values() -> None:
    """A row that moves by 188 µm on average, neighbours 8 µm apart: all bars look the same. Of one whose neighbours
    move by 20 and 0 µm bars say it.
    """
    for moved, is_told in ((np.array([192.0, 184.0]), True), (np.array([20.0, 0.0]), False)):
        lateral = 1e-3 * moved[None]
        condition = Condition("all_000", "all", 0.0, np.array([1.0]), 0.0 * lateral, lateral)
        figure = stimuli_figure([replace(FORCED, conditions=(condition,))])
        require_legible(figure)
        (axes,) = figure.axes
        written = [text for text in axes.texts if text.get_text().startswith("(")]
        assert [text.get_text() for text in written] == (["(+4)", f"({MINUS}4)"] if is_told else [])
        title = axes.get_title(loc="left")
        assert ("mean 188, Δ 8 µm" in title) is is_told
        assert ("deviation from the mean" in words(figure).replace("\n", " ")) is is_told
        figure.draw_without_rendering()
        assert all(text.get_window_extent().y0 > axes.get_window_extent().y0 for text in written)


def test_of_peaks_that_noise_tells_apart_the_first_is_drawn_and_what_is_next_to_nothing_is_not() -> None:
    """A swing to 20 and -20.1 µm, beside which noise goes aside by half a micrometre: bars of the rise alone, with
    values."""
    moved = np.outer([0.5, 1.0, 0.0, -1.005, -0.5], np.ones(3))
    swing = replace(
        PHASED.conditions[0], time=np.arange(1.0, 6.0), normal=0.02 * moved, tangential=np.full(moved.shape, 0.0005)
    )
    figure = stimuli_figure([replace(PHASED, conditions=(swing,))])
    (axes,) = figure.axes
    assert [bar.get_height() for bar in axes.patches] == pytest.approx([20.0] * 3)
    assert [text.get_text() for text in axes.texts if text.get_text() == "20"] == ["20"] * 3
    assert "below 5 %" in words(figure)
    assert "Numbers: values" in words(figure)
    both = replace(swing, tangential=0.01 * moved)
    assert "Numbers: values" not in words(stimuli_figure([replace(PHASED, conditions=(both,))]))


def test_frequency_figure_shows_scores_at_each_interface_apart_from_slow_cycles() -> None:
    """Of the change of strain in thousandths, with shear at the left, twice as large as without; of slow cycles a point
    of its own, at half of the lowest frequency.
    """
    hertz = [0.0, 20.0, 80.0]
    rows = [
        (UNRATED.name, name, str(interface), str(readout), frequency, share * growth * of_readout * number, "mm2")
        for number, name in enumerate((condition.name for condition in UNRATED.conditions), start=1)
        for interface, share in zip(Interface, (2.0, 1.0), strict=True)
        for readout, of_readout in zip(Readout, (1.0, 1e-3), strict=True)
        for frequency, growth in zip(hertz, (1.0, 1.5, 2.0), strict=True)
    ]
    names = ["device", "condition", "interface", "readout", "frequency_hz", "score", "unit"]
    figure = frequency_figure([UNRATED], pd.DataFrame(rows, columns=names))
    require_legible(figure)
    assert [label for _, label in axis_labels(figure)] == ["Change of strain\nscore (10⁻³ mm²)", ""]
    for axes, share in zip(figure.axes, (2.0, 1.0), strict=True):
        curves = [line.get_xydata().tolist() for line in axes.lines if line.get_marker() not in ("", "None", None)]
        for number, (slow, others) in enumerate(zip(curves[::2], curves[1::2], strict=True), start=1):
            np.testing.assert_allclose(slow, [[10.0, share * number]])
            np.testing.assert_allclose(others, [[20.0, 1.5 * share * number], [80.0, 2.0 * share * number]])
        assert len(curves) == 2 * len(UNRATED.conditions)


def test_correlation_draws_errors_a_least_squares_line_and_the_spread(correlations: pd.DataFrame) -> None:
    """Scores of 0.30, 0.31 and 0.34 with errors of 1 %, rated 0, 1 and 2, have a line of slope 0.04 / 8.67e-4 through
    their means, and a spread of 0.04 / 0.317.
    """
    certain = correlations.assign(slope_open=0)
    figure = correlation_figure(SCORES, RATINGS, certain, {"forced": "Forced pucks"}, Kinematics.SMALL)
    own = np.array([0.30, 0.31, 0.34])
    for axes, factor in zip(figure.axes, (1.0, 1e3), strict=True):
        (bars,) = [each for each in axes.collections if isinstance(each, LineCollection)]
        ends = np.array([segment[:, 0] for segment in bars.get_segments()])
        np.testing.assert_allclose(ends, factor * np.stack([0.99 * own, 1.01 * own], axis=1))
        (line,) = [line for line in axes.lines if len(line.get_xdata()) == 2]
        np.testing.assert_allclose(line.get_xydata(), [[factor * 0.30, 0.2308], [factor * 0.34, 2.0769]], rtol=1e-3)
        assert "n = 3, spread 13 %" in [text for part in axes.texts for text in part.get_text().split("\n")]


def halved_without_shear() -> pd.DataFrame:
    """SCORES, and half of them and of their errors without shear."""
    share = np.where(SCORES["interface"] == "shear", 1.0, 0.5)
    return SCORES.assign(score=share * SCORES["score"], score_error=share * SCORES["score_error"])


def test_ablation_has_scores_with_shear_at_the_left_of_those_without(correlations: pd.DataFrame) -> None:
    """Bars and errors in the unit of their axis, and above them how either correlates."""
    scores = halved_without_shear()
    related = correlations.assign(r2=np.where(correlations["interface"] == "shear", 0.9, 0.4))
    panels = ablation_figure(scores, related, {PHASED.name: PHASED.title}, Kinematics.SMALL, False).axes
    for axes, readout, factor in zip(panels, Readout, (1.0, 1e3), strict=True):
        shear = (scores["device"] == PHASED.name) & (scores["readout"] == readout) & (scores["interface"] == "shear")
        own = factor * scores.loc[shear, "score"].to_numpy()
        bars = sorted((bar.get_x(), bar.get_height()) for bar in axes.patches)
        assert [height for _, height in bars] == pytest.approx(list(np.stack([own, 0.5 * own], axis=1).ravel()))
        for times, ends in zip((1.0, 0.5), error_bars(axes), strict=True):
            np.testing.assert_allclose(ends, times * np.stack([0.99 * own, 1.01 * own]))
        above = axes.get_title(loc="left").split("\n")
        assert "with shear: " in above[0] and "surrogates' R² = 0.90" in above[0]
        assert "without shear: " in above[1] and "surrogates' R² = 0.40" in above[1]
    measured = related.assign(rating_kind="measured")
    axes = ablation_figure(scores, measured, {PHASED.name: PHASED.title}, Kinematics.SMALL, False).axes[0]
    assert axes.get_title(loc="left").startswith("with shear: R² = 0.900")
    ranged = related.assign(r2_lowest=0.25, r2_highest=0.75)
    axes = ablation_figure(scores, ranged, {PHASED.name: PHASED.title}, Kinematics.SMALL, False).axes[0]
    assert "R² range 0.25 to 0.75" in axes.get_title(loc="left") and "surrogates'" not in axes.get_title(loc="left")


def test_variation_draws_each_interface_in_the_unit_of_its_axis() -> None:
    """Scores grow with the value that is varied, and are half as large without shear; the first condition's is 0.3."""
    own = halved_without_shear()
    own = own[own["device"] == PHASED.name]
    values = [1.0, 1.5]
    tables = [own.assign(score=value * own["score"]).to_dict("records") for value in values]
    figure = variation_figure("actuators.edge_radius", "mm", values, [Scene(MODEL, PHASED)] * 2, tables)
    for axes, share, factor in zip(figure.axes, (1.0, 0.5, 1.0, 0.5), (1.0, 1.0, 1e3, 1e3), strict=True):
        curve = next(line for line in axes.lines if len(line.get_xdata()) == len(values))
        np.testing.assert_allclose(curve.get_ydata(), factor * share * 0.3 * np.array(values))
        np.testing.assert_allclose(error_bars(axes)[0][0], factor * share * (0.3 * np.array(values) - 0.003))


def lightness(colour: str) -> float:
    """Of a colour in grey [1]."""
    return float(np.dot(to_rgb(colour), [0.299, 0.587, 0.114]))


def test_each_comparison_has_colours_of_its_own() -> None:
    """Those of the paper's three phases mean phases, another pair interfaces, another kinematics; in grey the sides of
    a pair are told apart by their filling, and tractions by an area and a dark line.
    """
    phases = {ORANGE, BLUE, BLACK}
    drawn = condition_styles(conditions_of([FORCED]))
    assert {series.colour for series in drawn.series.values()} == phases
    pairs = [{look["edgecolor"] for look in looks.values()} for looks in (INTERFACE_LOOK, KINEMATICS_LOOK)]
    assert all(len(pair) == 2 for pair in pairs)
    assert not phases & pairs[0] and not phases & pairs[1] and not pairs[0] & pairs[1]
    for looks in (INTERFACE_LOOK, KINEMATICS_LOOK):
        assert ["hatch" in look for look in looks.values()] == [False, True]
    assert lightness(INTO) - lightness(ALONG) > 0.5


def test_bars_have_the_looks_of_what_they_compare(correlations: pd.DataFrame) -> None:
    titles = {PHASED.name: PHASED.title}
    ablation = ablation_figure(SCORES, correlations, titles, Kinematics.SMALL, False)
    both = pd.concat([SCORES, SCORES.assign(kinematics="finite")])
    forces = [(each, PHASED.name, "shear", x, x, False) for each in ("small", "finite") for x in (0.0, 1.0)]
    names = ["kinematics", "device", "interface", "indentation_mm", "force_N_per_mm", "limit_point"]
    kinematics = kinematics_figure(both, pd.DataFrame(forces, columns=names), titles)
    for axes, looks in ((ablation.axes[0], INTERFACE_LOOK), (kinematics.axes[1], KINEMATICS_LOOK)):
        edges = {to_hex(bar.get_edgecolor()).upper() for bar in axes.patches}
        assert edges == {look["edgecolor"].upper() for look in looks.values()}
    lines = [line for line in kinematics.axes[0].lines if line.get_marker() == "None"]
    assert [line.get_color() for line in lines] == [look["edgecolor"] for look in KINEMATICS_LOOK.values()]


def test_styles_differ_wherever_conditions_do() -> None:
    styles = condition_styles(conditions_of(DEVICES))
    for device in DEVICES:
        looks = [styles.series[device.name, c.name] for c in device.conditions]
        assert len({(s.colour, s.marker, str(s.line), s.fill) for s in looks}) == len(looks)
        assert len({s.label for s in looks}) == len(looks)
    assert styles.series["phased", "low_000"].colour == styles.series["forced", "all_000"].colour


def test_faces_are_projected_on_the_receptor_line() -> None:
    """Receptors every 0.1 mm, at arc lengths 1.1 times their place, 0.6 mm above a skin that faces touch within 0.4 mm
    of their centres; the last one touches nothing.
    """
    x = np.linspace(-4.0, 4.0, 81)
    contact = make_contact(PINS)
    pressed = np.where(np.abs(np.linspace(-0.6, 0.6, 25)) < 0.41, 0.03, 0.0)
    traction = np.concatenate([pressed, pressed, 0.0 * pressed])
    none = np.zeros((0, 0))
    condensed = CondensedSection(
        position=none,
        weight=none,
        compliance=none,
        receptor=np.stack([x, 0.0 * x + 0.6], axis=1),
        arc=1.1 * x,
        strain=none,
        residual=0.0,
    )
    found = face_arcs(PHASED, condensed, make_solution(contact, PINS, traction))
    expected = 1.1 * np.array([[-2.4, -1.6], [-0.4, 0.4], [np.nan, np.nan]])
    np.testing.assert_allclose(found, expected, atol=1e-9)  # but for rounding


def test_saved_files_are_the_same_byte_for_byte(tmp_path: Path, correlations: pd.DataFrame) -> None:
    """They hold no date, whatever the clock says, and a stem with a point keeps it."""
    for name in ("first", "second"):
        save(correlation_figure(SCORES, RATINGS, correlations, TITLES, Kinematics.SMALL), tmp_path / f"{name}.v1.png")
        save_as(
            correlation_figure(SCORES, RATINGS, correlations, TITLES, Kinematics.SMALL), tmp_path / f"{name}.v1.svg"
        )
    for suffix in ("png", "pdf", "svg"):
        first, second = (tmp_path / f"{name}.v1.{suffix}" for name in ("first", "second"))
        assert first.read_bytes() == second.read_bytes()
        assert not re.search(rb"Date|date>|Matplotlib v\d", first.read_bytes())


def test_neither_figures_nor_solver_load_what_they_do_not_need() -> None:
    code = (
        "import sys, fingerpad.contact.solution, fingerpad.readouts.gabor, fingerpad.readouts.roughness;"
        "assert 'matplotlib' not in sys.modules;"
        "import fingerpad.figures.maps, fingerpad.figures.receptors, fingerpad.figures.stimuli;"
        "assert 'matplotlib' in sys.modules and 'pandas' not in sys.modules and 'scipy' not in sys.modules;"
        "import fingerpad.figures.workflow; assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True, env={"PYTHONPATH": str(ROOT / "src"), "PATH": ""})


def test_what_a_user_has_set_for_matplotlib_changes_no_figure(tmp_path: Path) -> None:
    """Neither a file matplotlibrc, which matplotlib finds where it is called, nor a window that there is not."""
    device = ROOT / "config" / "devices" / "device2.yaml"
    check = [sys.executable, "-m", "fingerpad.cli", "check", str(device), "-o", "drawn.svg"]
    drawn = []
    for name, settings, given in (
        ("plain", "", {}),
        ("set", "font.family: nothing\ntext.usetex: True\naxes.grid: True\n", {"MPLBACKEND": "nonsense"}),
    ):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "matplotlibrc").write_text(settings, encoding="utf-8")
        environment = os.environ | {"PYTHONPATH": str(ROOT / "src")} | given
        done = subprocess.run(check, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        drawn.append((folder / "drawn.svg").read_bytes())
    assert drawn[0] == drawn[1]
