"""Designs on a finger that is condensed once: they are what the workflow computes with a mesh of their own."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from fingerpad.accuracy import COARSENING, with_errors
from fingerpad.design import Pad, Pressed, answer, condense_pad, press
from fingerpad.edges import edge_intervals
from fingerpad.errors import SceneError
from fingerpad.figures.design import design_figure
from fingerpad.prediction import condense_scene, predicted_rows, rows_at
from fingerpad.scene import Interface, Readout
from fingerpad.solution import indent_device
from scenes import scene

DEVICE = "device2"
PITCH, WIDTH, AMPLITUDE = 2.5, 1.0, 0.02  # mm, of Device 2


@cache
def pad() -> Pad:
    """The finger, up to the outermost edge of Device 2's pins."""
    return condense_pad(scene(DEVICE), 1.5 * PITCH + WIDTH / 2.0)


@cache
def pressed(friction: float) -> tuple[Pressed, Pressed]:
    """Device 2, pressed."""
    return press(pad(), PITCH, WIDTH, friction)


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
    scored = predicted_rows(base, condense_scene(base, edge_intervals(base)))
    rows = with_errors(scored, rows_at(base, COARSENING))
    return {(row["condition"], row["interface"], row["readout"]): row for row in rows}


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


def test_other_skin_bears_nothing() -> None:
    """Taking the skin under the row alone changes nothing: on all of the pad's skin, receptors are strained the same,
    but for where pre-indentation ends, 1e-4 mm in 1.6."""
    fine, _ = pressed(0.6)
    own, all_skin = fine.skin.section, pad().fine.section
    assert own.position.shape[0] < all_skin.position.shape[0]
    everywhere = indent_device(fine.scene, all_skin, None, Interface.SHEAR)
    strain = own.strain @ fine.indented.state.force.ravel()
    expected_strain = all_skin.strain @ everywhere.state.force.ravel()
    assert np.abs(strain - expected_strain).max() < 1e-4 * np.abs(expected_strain).max()


def test_up_and_down_is_another_stimulus() -> None:
    lateral, normal = (answer(pressed(0.6), AMPLITUDE, 180.0, sideways) for sideways in (True, False))
    (across,), (along,) = lateral.scene.device.conditions, normal.scene.device.conditions
    assert np.array_equal(across.tangential, along.normal)
    assert not along.tangential.any()
    assert [row["score"] for row in lateral.rows] != [row["score"] for row in normal.rows]


def test_pins_that_overlap_are_refused() -> None:
    with pytest.raises(SceneError, match="overlap"):
        press(pad(), 1.0, 1.2, 0.6)


def test_figure_shows_both_designs() -> None:
    """Three panels of curves, two of scores, with a bar for the design and one for that before."""
    one, other = (answer(pressed(0.6), AMPLITUDE, phase, True) for phase in (90.0, 180.0))
    for before, bars in ((None, 1), (other, 2)):
        figure = design_figure(one, before)
        drawn = [axes for axes in figure.axes if axes.patches and "score" in axes.get_ylabel()]
        assert [len(axes.patches) for axes in drawn] == [bars, bars]
