"""Pre-indentation by halves against the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.contact_law import Interface
from fingerpad.indentation import indent
from fingerpad.solution import contact_problem, indented_state
from fingerpad.symmetry import indent_by_halves, mirrors
from scenes import condensed, scene


@pytest.mark.parametrize(
    ("device", "interface"),
    [("device2", Interface.SHEAR), ("device2", Interface.FRICTIONLESS), ("device3", Interface.SHEAR)],
)
def test_halves_give_the_same_state_as_the_whole(device: str, interface: Interface) -> None:
    """Forces, places and heights agree to the solver's tolerance, states and dissipation too."""
    base = scene(device)
    problem = contact_problem(base, *condensed(device), interface)
    assert mirrors(problem)
    halves = indented_state(base, problem)
    whole = indented_state(
        replace(base, model=replace(base.model, skips=replace(base.model.skips, mirrored_half=False))), problem
    )
    assert np.abs(halves.actuator - whole.actuator).max() < 1e-7
    assert np.abs(halves.force - whole.force).max() < 1e-6 * whole.force.max()
    assert np.abs(halves.place - whole.place).max() < 1e-6
    assert np.array_equal(halves.status > 0, whole.status > 0)
    assert halves.dissipation == pytest.approx(whole.dissipation, rel=1e-5, abs=1e-12)


def test_a_lopsided_row_is_solved_whole() -> None:
    """Nothing is folded where nothing mirrors."""
    base = scene("device2")
    problem = contact_problem(base, *condensed("device2"), Interface.FRICTIONLESS)
    lopsided = replace(problem, row=replace(problem.row, positions=(-3.7, -1.25, 1.25, 3.75)))
    assert not mirrors(lopsided)
    numerics, limit = base.model.numerics, base.model.finger.pad_thickness
    arguments = (base.model.contact.criterion, numerics.indentation_increments, limit)
    assert np.array_equal(indent_by_halves(lopsided, *arguments).force, indent(lopsided, *arguments).force)
