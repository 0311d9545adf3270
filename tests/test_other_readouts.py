"""Scores under other read-outs: the configured one among them, and how agreement is counted."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from fingerpad.prediction.other_readouts import (
    VARIANT,
    WAVELENGTH_FACTORS,
    agreement,
    on_both_sides,
    readout_rows,
)
from fingerpad.readouts.gabor import filtered_readouts
from fingerpad.readouts.measures import Measure
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import score_rows
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import Condition
from fingerpad.scene.readout import Side
from fingerpad.tissue.compliance import CondensedSection
from scenes import condensed, scene, section, solve, solved

DEVICE = "device2"


@cache
def rows() -> list[dict[str, Any]]:
    """All variants of Device 2 with shear, read on the dermis side."""
    solutions = {
        (c.name, Interface.SHEAR): solved(DEVICE, c.name, Interface.SHEAR) for c in scene(DEVICE).device.conditions
    }
    return list(readout_rows(scene(DEVICE), {Side.DERMIS: condensed(DEVICE)[0]}, solutions))


@cache
def both_sides() -> dict[Side, CondensedSection]:
    """Device 2's maps to strain on both sides."""
    return on_both_sides(scene(DEVICE), condensed(DEVICE)[0], section(DEVICE))


def test_every_variant_is_scored_once() -> None:
    conditions = len(scene(DEVICE).device.conditions)
    assert len(rows()) == conditions * 2 * len(Measure) * len(WAVELENGTH_FACTORS)
    assert len({tuple(row[key] for key in ("condition", "readout", *VARIANT)) for row in rows()}) == len(rows())


def test_configured_variant_has_the_configured_score() -> None:
    """Maximum principal strain at the configured wavelength is the workflow's read-out, with its unit."""
    usual = [row for row in rows() if row["measure"] == Measure.MAXIMUM_PRINCIPAL and row["wavelength_factor"] == 1.0]
    model = scene(DEVICE).model
    expected = []
    for condition in scene(DEVICE).device.conditions:
        solution = solved(DEVICE, condition.name, Interface.SHEAR)
        resampling = resampling_to_grid(solution.arc, model.gabor.spacing)
        read = filtered_readouts(resampling, solution.reading.readouts, model.gabor)
        expected += score_rows(scene(DEVICE), condition, Interface.SHEAR, read)
    assert [row["score"] for row in usual] == pytest.approx([row["score"] for row in expected], rel=1e-12)
    assert [row["unit"] for row in usual] == [row["unit"] for row in expected]


def test_wavelengths_of_both_readouts_are_varied() -> None:
    """Scores at twice the wavelength are those of a filter with twice both wavelengths, and others than at once."""
    name, gabor = scene(DEVICE).device.conditions[-1].name, scene(DEVICE).model.gabor
    own = [row for row in rows() if row["measure"] == Measure.MAXIMUM_PRINCIPAL and row["condition"] == name]
    once, twice = ([row["score"] for row in own if row["wavelength_factor"] == factor] for factor in (1.0, 2.0))
    wider = replace(
        gabor, wavelength_strain=2.0 * gabor.wavelength_strain, wavelength_change=2.0 * gabor.wavelength_change
    )
    solution = solved(DEVICE, name, Interface.SHEAR)
    read = filtered_readouts(resampling_to_grid(solution.arc, wider.spacing), solution.reading.readouts, wider)
    expected = score_rows(scene(DEVICE), scene(DEVICE).device.condition(name), Interface.SHEAR, read)
    assert twice == pytest.approx([row["score"] for row in expected], rel=1e-12)
    assert all(abs(one - other) > 0.01 * one for one, other in zip(once, twice, strict=True))


def test_variants_are_read_when_a_stimulus_has_settled() -> None:
    """Pins go to, and half as far fro; the stroke to, which changes more, is not read."""
    base = scene(DEVICE)
    tangential = np.outer([0.02, -0.01], [1.0, -1.0, 1.0, -1.0])
    strokes = Condition("strokes", "test", 0.0, np.array([1.0, 2.0]), np.zeros_like(tangential), tangential, 1)
    given = base.with_device(conditions=(strokes,), cycles=())
    solution = solve(DEVICE, strokes, Interface.FRICTIONLESS)
    found = readout_rows(given, {Side.DERMIS: condensed(DEVICE)[0]}, {("strokes", Interface.FRICTIONLESS): solution})
    usual = [row for row in found if row["measure"] == Measure.MAXIMUM_PRINCIPAL and row["wavelength_factor"] == 1.0]
    resampling = resampling_to_grid(solution.arc, given.model.gabor.spacing)
    read = filtered_readouts(resampling, solution.reading.readouts, given.model.gabor)
    expected = score_rows(given, strokes, Interface.FRICTIONLESS, read)
    assert solution.reading.time == 1
    assert [row["score"] for row in usual] == pytest.approx([row["score"] for row in expected], rel=1e-12)


def test_energy_and_stress_have_their_unit() -> None:
    units = {row["measure"]: row["unit"] for row in rows()}
    assert units[Measure.VON_MISES] == units[Measure.STRAIN_ENERGY] == "MPa mm2"
    assert units[Measure.MAXIMUM_SHEAR] == "mm2"


def test_other_side_is_condensed_anew() -> None:
    """Receptors are where they are and tissue gives way as it does, but strain across the interface jumps."""
    own, found = condensed(DEVICE)[0], both_sides()
    assert found[Side.DERMIS] is own
    other = found[Side.EPIDERMIS]
    assert other.receptor == pytest.approx(own.receptor, abs=1e-12)
    # sums of other blocks: rounding, 1e-16, times some 1e6 by which the stiffness magnifies it
    assert np.abs(other.compliance - own.compliance).max() < 1e-10 * np.abs(own.compliance).max()
    assert np.abs(other.strain - own.strain).max() > 0.1 * np.abs(own.strain).max()


def test_strain_is_that_of_the_side_on_which_it_is_read() -> None:
    """Everywhere another than across the interface."""
    name = scene(DEVICE).device.conditions[-1].name
    solutions = {(name, Interface.SHEAR): solved(DEVICE, name, Interface.SHEAR)}
    found = [
        row
        for row in readout_rows(scene(DEVICE), both_sides(), solutions)
        if row["measure"] == Measure.MAXIMUM_PRINCIPAL and row["wavelength_factor"] == 1.0
    ]
    own, other = ([row["score"] for row in found if row["side"] == side] for side in Side)
    assert len(own) == 2
    assert all(abs(far - near) > 0.01 * near for near, far in zip(own, other, strict=True))


def test_material_is_that_of_the_side() -> None:
    finger = scene(DEVICE).model.finger
    names = {side: finger.pad[scene(DEVICE).model.receptor_layer(side)].name for side in Side}
    assert names == {Side.DERMIS: "dermis", Side.EPIDERMIS: "viable_epidermis"}


def test_stress_is_that_of_the_side_on_which_strain_is_read() -> None:
    """One and the same strain on both sides, of which the layers differ in stiffness."""
    name = scene(DEVICE).device.conditions[-1].name
    solutions = {(name, Interface.SHEAR): solved(DEVICE, name, Interface.SHEAR)}
    found = list(readout_rows(scene(DEVICE), dict.fromkeys(Side, condensed(DEVICE)[0]), solutions))
    for measure, differs in ((Measure.MAXIMUM_PRINCIPAL, False), (Measure.VON_MISES, True)):
        one, other = (
            [row["score"] for row in found if (row["measure"], row["side"]) == (measure, side)] for side in Side
        )
        assert (one != other) is differs


def variant(condition: str, measure: Measure, score: float) -> dict[str, Any]:
    """A row of the table."""
    key = {"kinematics": "small", "device": "d", "condition": condition, "interface": "shear", "readout": "strain"}
    return key | {"measure": str(measure), "side": "dermis", "wavelength_factor": 1.0, "score": score}


def test_agreement_counts_orders_and_correlation() -> None:
    """Of three conditions: proportional scores agree, one exchanged pair of three gives tau 1/3, constants nothing."""
    usual = [1.0, 2.0, 4.0]
    others = {
        Measure.MAXIMUM_PRINCIPAL: usual,
        Measure.VON_MISES: [0.1, 0.2, 0.4],
        Measure.STRAIN_ENERGY: [1.0, 4.0, 2.0],
        Measure.MAXIMUM_SHEAR: [3.0, 3.0, 3.0],
    }
    table = [
        variant(name, key, score) for key, scores in others.items() for name, score in zip("abc", scores, strict=True)
    ]
    found = {row["measure"]: row for row in agreement(table, Side.DERMIS)}
    assert all(row["n"] == 3 for row in found.values())
    for same in (Measure.MAXIMUM_PRINCIPAL, Measure.VON_MISES):
        assert (found[same]["kendall_tau"], found[same]["r"]) == pytest.approx((1.0, 1.0))
    exchanged = found[Measure.STRAIN_ENERGY]
    assert exchanged["kendall_tau"] == pytest.approx(1.0 / 3.0)
    assert exchanged["r"] == pytest.approx(np.corrcoef(usual, others[Measure.STRAIN_ENERGY])[0, 1])
    assert found[Measure.MAXIMUM_SHEAR]["kendall_tau"] is None
    assert found[Measure.MAXIMUM_SHEAR]["r"] is None


def test_factors_of_wavelengths_have_three_digits() -> None:
    assert sorted({row["wavelength_factor"] for row in rows()}) == [0.5, 0.707, 1.0, 1.414, 2.0]
