"""Pre-indentation by halves against the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.contact.linear_solution import indented_state
from fingerpad.contact.problem import contact_problem
from fingerpad.contact.symmetry import mirrors
from fingerpad.scene.contact_law import Interface
from fingerpad.tissue.compliance import MIRROR
from scenes import condensed, scene

# Gaps are solved to 1e-9 of the indentation of some 2 mm
LENGTH = 1e-7  # mm; the height at which the last edge touches follows gaps tenfold (measured: up to 3e-8)
SHARE = 1e-5  # of the largest [1]; forces at edges, pressed by some 0.01 mm, follow heights (measured: up to 1.3e-6)


@pytest.mark.parametrize(
    ("device", "interface"),
    [("device2", Interface.SHEAR), ("device2", Interface.FRICTIONLESS), ("device3", Interface.SHEAR)],
)
def test_halves_give_the_same_state_as_the_whole(device: str, interface: Interface) -> None:
    """Heights, places, forces, states and dissipation agree as far as the solver's tolerance lets them."""
    base = scene(device)
    problem = contact_problem(base, *condensed(device), interface)
    assert mirrors(problem)
    halves = indented_state(base, problem)
    whole = indented_state(
        replace(base, model=replace(base.model, skips=replace(base.model.skips, mirrored_half=False))), problem
    )
    assert np.abs(halves.actuator - whole.actuator).max() < LENGTH
    assert np.abs(halves.force - whole.force).max() < SHARE * whole.force.max()
    assert np.abs(halves.place - whole.place).max() < LENGTH
    assert np.array_equal(halves.status > 0, whole.status > 0)
    assert halves.dissipation == pytest.approx(whole.dissipation, rel=SHARE)


def test_a_lopsided_row_presses_as_its_mirror_image_does() -> None:
    """Neither is folded, and one bears the mirrored forces of the other."""
    base = scene("device2")
    problem = contact_problem(base, *condensed("device2"), Interface.SHEAR)
    rows = (-3.7, -1.25, 1.25, 3.75), (-3.75, -1.25, 1.25, 3.7)
    problems = [replace(problem, row=replace(problem.row, positions=row)) for row in rows]
    assert not any(mirrors(each) for each in problems)
    left, right = (indented_state(base, each) for each in problems)
    assert np.abs(left.actuator - right.actuator[::-1] * MIRROR).max() < LENGTH
    assert np.abs(left.force - right.force[::-1] * MIRROR).max() < SHARE * left.force.max()
    assert np.abs(left.force - right.force).max() > 0.01 * left.force.max()
