"""Anderson's acceleration finds the fixed point of a linear map in as many steps as it has dimensions, and one."""

from __future__ import annotations

import numpy as np
import pytest

from fingerpad.contact.acceleration import MEMORY, accelerated

ROUNDING = 1e-10  # of a system of four equations whose condition is some hundreds


@pytest.mark.parametrize("largest", [0.5, -3.0], ids=["contraction", "expansion"])
def test_linear_map(largest: float) -> None:
    rng = np.random.default_rng(0)
    basis = np.linalg.qr(rng.standard_normal((4, 4)))[0]
    matrix, shift = basis @ np.diag([largest, 0.4, -0.2, 0.1]) @ basis.T, rng.standard_normal(4)
    fixed = np.linalg.solve(np.eye(4) - matrix, shift)
    point, steps, ends = np.zeros(4), [], []
    for _ in range(5):
        ends.append(matrix @ point + shift)
        steps.append(ends[-1] - point)
        point = accelerated(steps, ends)
    assert point == pytest.approx(fixed, rel=ROUNDING)


def test_only_the_last_iterates_are_combined() -> None:
    steps, ends = np.random.default_rng(1).normal(size=(2, MEMORY + 3, 40))
    expected = accelerated([*steps[-MEMORY:]], [*ends[-MEMORY:]])
    assert accelerated([*steps], [*ends]) == pytest.approx(expected, rel=1e-12)


def test_what_is_left_of_steps_is_least_in_energy() -> None:
    """On a structure with one mode that is all but free: its large steps, which cost nothing, hide no other."""
    stiffness = np.diag([1e-6, 1.0, 2.0])
    steps = [np.array([3.0, 0.2, -0.1]), np.array([-2.0, 0.1, 0.05])]
    change = steps[1] - steps[0]
    weight = change @ stiffness @ steps[1] / (change @ stiffness @ change)  # where the energy's derivative vanishes
    ends = [np.zeros(3), np.ones(3)]
    found = accelerated(steps, ends, [stiffness @ step for step in steps])
    np.testing.assert_allclose(found, 1.0 - weight, rtol=1e-12)
    assert np.abs(accelerated(steps, ends) - found).min() > 0.1  # the size of steps would have another
