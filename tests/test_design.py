"""Designs on a finger that is condensed once: they are what the workflow computes with a mesh of their own."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from fingerpad.contact.symmetry import mirrors
from fingerpad.errors import ContactError, SceneError
from fingerpad.figures.design import DesignPicture
from fingerpad.figures.style import ALONG, GREEN, INTO_EDGE
from fingerpad.prediction.design import Pad, PressedRow, answer, condense_pad, press_row
from fingerpad.prediction.forecast import forecast
from fingerpad.readouts.accuracy import COARSENING
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.readout import Readout
from fingerpad.words import SCORE_SCALE
from scenes import scene

DEVICE = "device2"
PITCH, WIDTH, AMPLITUDE = 2.5, 1.0, 0.02  # mm, of Device 2


@cache
def pad() -> Pad:
    """The finger, up to the outermost edge of Device 2's pins."""
    return condense_pad(scene(DEVICE), 1.5 * PITCH + WIDTH / 2.0)


@cache
def pressed(friction: float) -> tuple[PressedRow, PressedRow | ContactError]:
    """Device 2, pressed."""
    return press_row(pad(), PITCH, WIDTH, friction)


def test_scene_is_that_of_the_device() -> None:
    """With Device 2's numbers a design is Device 2: same row, same path, same model."""
    base = scene(DEVICE)
    for condition in base.device.conditions:
        found = answer(pressed(base.model.contact.friction), AMPLITUDE, condition.phase_deg, True).scene
        assert found.model == base.model
        assert found.device.actuators == base.device.actuators
        (own,) = found.device.conditions
        assert own.tangential == pytest.approx(condition.tangential, abs=1e-15)
        assert not own.normal.any()


@cache
def expected() -> dict[tuple[str, str, str], dict[str, Any]]:
    """Rows of the workflow's table, with errors, by condition, interface and read-out."""
    base = scene(DEVICE)
    return {(row["condition"], row["interface"], row["readout"]): row for row in forecast(base)}


@pytest.mark.parametrize("interface", list(Interface))
@pytest.mark.parametrize("condition", [c.name for c in scene(DEVICE).device.conditions])
def test_scores_are_the_devices_within_the_errors_of_both(condition: str, interface: Interface) -> None:
    """Two meshes, two errors: scores are off each other by no more than both state together."""
    base = scene(DEVICE)
    own = base.device.condition(condition)
    found = answer(pressed(base.model.contact.coefficient(interface)), AMPLITUDE, own.phase_deg, True).rows
    assert [row["readout"] for row in found] == list(Readout)
    for row in found:
        reference = expected()[condition, interface, row["readout"]]
        allowed = row["score_error"] + reference["score_error"]
        assert abs(row["score"] - reference["score"]) < allowed


@pytest.mark.parametrize("pitch", [1.4, PITCH])
def test_rows_are_pressed_by_halves(pitch: float) -> None:
    """Also where the mid-line is within reach of the pins."""
    rows = press_row(pad(), pitch, WIDTH, 0.6)
    assert all(isinstance(row, PressedRow) and mirrors(row.indented.problem) for row in rows)


def test_up_and_down_is_another_stimulus() -> None:
    lateral, normal = (answer(pressed(0.6), AMPLITUDE, 180.0, sideways) for sideways in (True, False))
    (across,), (along,) = lateral.scene.device.conditions, normal.scene.device.conditions
    assert np.array_equal(across.tangential, along.normal)
    assert not along.tangential.any()
    assert [row["score"] for row in lateral.rows] != [row["score"] for row in normal.rows]


def test_errors_that_cannot_be_known_are_said_to_be_unknown() -> None:
    """Where the coarser mesh cannot be followed, a score has no error, and the reason stands beside it. Here all pins
    slide, and nothing but tissue holds the skin sideways: on the coarser mesh that is not enough."""
    found = answer(press_row(pad(), 1.8, 1.0, 0.8), 0.05, 180.0, True)
    assert (
        "the states of contact have no unique solution there; try less friction, rounder edges, less movement"
        in found.unknown
    )
    assert all(row["score"] > 0.0 and row["score_error"] is None for row in found.rows)
    picture = DesignPicture(4)
    picture.show(found, found)
    assert [text.get_text()[-2:] for axes in picture.figure.axes for text in axes.texts] == ["±?"] * 4
    known = answer(press_row(pad(), 1.8, 1.0, 0.8), 0.04, 180.0, True)
    assert not known.unknown
    assert all(row["score_error"] > 0.0 for row in known.rows)


def test_designs_have_the_caveats_of_their_solution() -> None:
    """Pins far apart are pressed deep before the outer ones are covered."""
    wide = press_row(condense_pad(scene(DEVICE), 1.5 * 3.5 + WIDTH / 2.0), 3.5, WIDTH, 0.6)
    notes = {row["note"] for row in answer(wide, AMPLITUDE, 180.0, True).rows}
    assert all("of the pad: small strain is invalid" in note for note in notes)
    assert {row["note"] for row in answer(pressed(0.6), AMPLITUDE, 180.0, True).rows} == {""}


def test_pins_that_overlap_are_refused() -> None:
    with pytest.raises(SceneError, match="overlap"):
        press_row(pad(), 1.0, 1.2, 0.6)


def test_picture_shows_both_designs() -> None:
    """Bars are as high as the scores, and the previous design stands at the left; without one there is none."""
    picture = DesignPicture(4)
    one, other = (answer(pressed(0.6), AMPLITUDE, phase, True) for phase in (90.0, 180.0))
    for now, before in ((one, None), (other, one)):
        picture.show(now, before)
        scores = [axes for axes in picture.figure.axes if "score" in axes.get_ylabel()]
        heights = [
            [bar.get_height() / SCORE_SCALE[each][0] for bar in axes.patches]
            for each, axes in zip(Readout, scores, strict=True)
        ]
        expected_heights = [
            [row["score"] if row else 0.0 for row in rows]
            for rows in zip(before.rows if before else (None, None), now.rows, strict=True)
        ]
        assert np.allclose(heights, expected_heights)


def test_picture_is_in_the_units_of_its_axes() -> None:
    """Tractions in kPa where skin is in contact, strain in per cent, its change's score and error in thousandths."""
    picture, found = DesignPicture(4), answer(pressed(0.6), AMPLITUDE, 180.0, True)
    picture.show(found)
    tractions, *strains = [axes for axes in picture.figure.axes if "score" not in axes.get_ylabel()]
    touching = found.solution.pressure > 0.0
    for colour, traction in ((INTO_EDGE, found.solution.pressure), (ALONG, found.solution.shear)):
        (drawn,) = [np.asarray(line.get_ydata()) for line in tractions.lines if line.get_color() == colour]
        assert drawn[np.isfinite(drawn)] == pytest.approx(1e3 * traction[touching])
    (area,) = [patch for patch in tractions.patches if patch.get_alpha() != 0.0 and len(patch.get_xy()) > 1]
    below = np.asarray(area.get_xy())
    assert below[below[:, 1] > 0.0, 1] == pytest.approx(1e3 * found.solution.pressure[touching])
    for axes, readout in zip(strains, Readout, strict=True):
        (drawn,) = [np.asarray(line.get_ydata()) for line in axes.lines if line.get_color() == GREEN]
        assert drawn == pytest.approx(100.0 * found.readouts.unfiltered(readout))
    scores = [axes for axes in picture.figure.axes if "score" in axes.get_ylabel()]
    for axes, row, factor in zip(scores, found.rows, (1.0, 1e3), strict=True):
        ends = [list(line.get_ydata()) for line in axes.lines if len(line.get_ydata())]
        assert ends == [pytest.approx([factor * (row["score"] + sign * row["score_error"]) for sign in (-1.0, 1.0)])]


def test_picture_is_the_same_from_a_kept_background() -> None:
    """Drawn on the background of an equal design as drawn anew."""
    found = answer(pressed(0.6), AMPLITUDE, 180.0, True)
    fresh, kept = DesignPicture(4), DesignPicture(4)
    fresh.show(found, found)
    for _ in range(2):
        kept.show(found, found)
    assert kept.png() == fresh.png()


def test_axes_hold_what_is_drawn() -> None:
    picture = DesignPicture(4)
    for amplitude in (0.005, 0.05):
        picture.show(answer(pressed(0.6), amplitude, 180.0, True))
        for axes in picture.figure.axes:
            (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
            for line in axes.lines:
                x, y = line.get_data()
                shown = np.asarray(y)[(np.asarray(x) >= left) & (np.asarray(x) <= right)]
                assert not np.any((shown < low) | (shown > high))


def test_the_coarser_row_takes_fewer_increments() -> None:
    fine, coarse = pressed(0.6)
    assert isinstance(coarse, PressedRow)
    assert coarse.scene.model.numerics == fine.scene.model.numerics.coarsened(COARSENING)
