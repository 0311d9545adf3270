"""What an answer must not depend on: place, units, mirror image, order of nodes; and how far it hangs on increments."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.blocks import half_plane, lift, pressed
from fingerpad.contact.formulation import ContactProblem, ContactState
from fingerpad.contact.path import follow
from fingerpad.scene.device import ActuatorRow

SPACING = 1 / 32  # mm; contact is 0.4 to 1 mm wide
ROW = ActuatorRow((-0.35, 0.45), 0.5, 0.1)  # no mirror image of itself
MOVES = np.array([[[0.01, 0.0], [-0.004, 0.004]], [[-0.01, 0.003], [0.012, -0.003]]])  # two actuators, two moves [mm]
EXACT = 1e-7  # of the largest force [1]; a hundred times what gaps and forces are solved to, as compliance amplifies


@cache
def problem(friction: float = 0.5) -> ContactProblem:
    """Two rounded punches on a half-plane."""
    return half_plane(SPACING, SPACING, 0.3, ROW, friction).problem


def walked(of: ContactProblem, scale: float = 1.0, mirror: float = 1.0, increments: int = 2) -> ContactState:
    """State after pressing and the moves, all lengths times `scale`, x times `mirror`."""
    state = pressed(of, 0.02 * scale, 4 * increments)
    for move in MOVES[:, :: int(mirror)] * [mirror, 1.0]:
        state = follow(of, state, state.actuator + move * scale, increments)
    return state


def assert_same(found: FloatArray, expected: FloatArray) -> None:
    """Forces (n, 2) [N/mm] agree."""
    assert np.abs(found - expected).max() < EXACT * np.abs(expected).max()


@pytest.mark.parametrize("shift", [1.0, -37.3])
def test_place_does_not_matter(shift: float) -> None:
    """The whole scene moved along x."""
    row = replace(ROW, positions=tuple(x + shift for x in ROW.positions))
    moved = replace(problem(), position=problem().position + np.array([shift, 0.0]), row=row)
    assert_same(walked(moved).force, walked(problem()).force)


@pytest.mark.parametrize("length", [0.1, 1e3])
@pytest.mark.parametrize("force", [1e-3, 1e6])
def test_units_do_not_matter(length: float, force: float) -> None:
    """Another unit of length and of force: the same answer in other numbers.

    Edges stay rounder than the radius that replaces sharp ones, which is a length in mm.
    """
    row = ActuatorRow(tuple(x * length for x in ROW.positions), ROW.width * length, ROW.edge_radius * length)
    compliance = problem().compliance * length / force
    scaled = replace(problem(), position=problem().position * length, compliance=compliance, row=row)
    assert_same(walked(scaled, scale=length).force / force, walked(problem()).force)


def test_mirror_image_gives_the_mirror_image() -> None:
    """Nodes, actuators and moves mirrored."""
    row = replace(ROW, positions=tuple(-x for x in reversed(ROW.positions)))
    signs = np.array([-1.0, 1.0])
    count = problem().position.shape[0]
    order = (2 * np.arange(count)[::-1, None] + np.arange(2)).ravel()
    compliance = problem().compliance[np.ix_(order, order)] * np.outer(np.tile(signs, count), np.tile(signs, count))
    mirrored = replace(problem(), position=problem().position[::-1] * signs, compliance=compliance, row=row)
    assert_same(walked(mirrored, mirror=-1.0).force[::-1] * signs, walked(problem()).force)


def test_order_of_nodes_does_not_matter() -> None:
    """Nodes in any order. (Pre-indentation asks for ascending ones, to see fronts; a path does not.)"""
    order = np.random.default_rng(0).permutation(problem().position.shape[0])
    unknowns = (2 * order[:, None] + np.arange(2)).ravel()
    compliance = problem().compliance[np.ix_(unknowns, unknowns)]
    shuffled = replace(problem(), position=problem().position[order], compliance=compliance)
    assert_same(walked(shuffled).force, walked(problem()).force[order])


def test_increments_matter_the_less_the_smaller_they_are() -> None:
    """Friction makes the path count. With 16 increments a move the actuators' forces are within the error that scores
    aim at (0.5 %), with 64 nothing moves any more.
    """
    totals = []
    for count in (4, 16, 64, 128):
        force = walked(problem(), increments=count).force
        totals.append(np.array([force[problem().actuator_of == actuator].sum(axis=0) for actuator in (0, 1)]))
    coarse, fine, finer = (np.abs(total - totals[-1]).max() / np.abs(totals[-1]).max() for total in totals[:-1])
    assert fine < 0.25 * coarse
    assert fine < 0.005
    assert finer < 1e-6


def test_without_friction_increments_do_not_matter_at_all() -> None:
    """One increment a move or sixteen."""
    assert_same(walked(problem(0.0), increments=1).force, walked(problem(0.0), increments=16).force)


def test_order_of_moves_matters_with_friction_alone() -> None:
    """To the side and then down is not down and then to the side; without friction it is."""
    ends = {}
    for friction in (0.0, 0.5):
        state = pressed(problem(friction), 0.01, 8)
        down, aside = lift(problem(friction), 0.0, 0.01), lift(problem(friction), 0.01, 0.0)
        for first, second in ((down, aside), (aside, down)):
            between = follow(problem(friction), state, state.actuator + first, 8)
            end = follow(problem(friction), between, between.actuator + second, 8)
            ends.setdefault(friction, []).append(end.force)
    assert_same(*ends[0.0])
    one, other = ends[0.5]
    assert np.abs(one - other).max() > 0.01 * np.abs(one).max()


@pytest.mark.parametrize("friction", [0.0, 0.5])
def test_a_stimulus_that_never_touches_leaves_nothing(friction: float) -> None:
    """Off the skin and sideways there: no force, no slip, no work."""
    free = problem(friction)
    state = follow(free, pressed(free, 0.01, 4), lift(free, 0.0, -0.5), 3)
    away = follow(free, state, state.actuator + lift(free, 0.3, 0.0), 3)
    assert not away.force.any()
    assert away.dissipation == state.dissipation >= 0.0


def test_the_smallest_move_is_linear() -> None:
    """A move of 1 nm and one of 2 nm: twice the force, solved to 1e-10 of what bears 2e4 times the move."""
    before = pressed(problem(), 0.02, 8)
    ends = [follow(problem(), before, before.actuator + lift(problem(), step, 0.0), 1) for step in (1e-6, 2e-6)]
    once, twice = ((state.force - before.force)[:, 0].sum() for state in ends)
    assert twice == pytest.approx(2.0 * once, rel=1e-5)
