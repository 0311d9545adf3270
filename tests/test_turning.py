"""Contact whose normal turns on rounded edges: its cone, its energy, and a penalty law written apart from it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.calculix.penalty import PenaltyLaw, follow_penalties, untouched
from fingerpad.closedforms.blocks import block_contact, lift, refined_block
from fingerpad.contact.active_set import PatchProblem, _at, _newton_equations, _states
from fingerpad.contact.formulation import (
    ContactProblem,
    ContactState,
    Status,
    rest,
    shearing_and_pressing,
    touching_height,
)
from fingerpad.contact.patch import patch_of
from fingerpad.contact.path import follow
from fingerpad.contact.profile import bend, profile
from fingerpad.scene.contact_law import ContactLaw, Criterion, FrictionFrom, Interface, TurningNormal
from fingerpad.scene.device import ActuatorRow
from fingerpad.scene.finger import Material
from fingerpad.scene.tissue_law import Kinematics

DEPTH, WAY = 0.1, 0.05  # mm
FRICTION = 0.5


@cache
def rounded_block(friction: float) -> tuple[ContactProblem, FloatArray]:
    """A block of 8 mm by 4 mm, modulus 1 MPa, under an actuator of 0.6 mm with edges of 0.1 mm."""

    def size(x: FloatArray, y: FloatArray) -> FloatArray:
        return np.asarray(0.02 + 0.25 * np.hypot(np.maximum(x - 0.6, 0.0), y))

    mesh = refined_block(np.array([0.0, 4.0]), np.array([0.0, 4.0]), size)
    block = block_contact(mesh, Material(1.0, 0.3), ActuatorRow((0.0,), 0.6, 0.1), friction, reach=0.6)
    return replace(block.problem, turning=True), block.weight


def pressed(problem: ContactProblem, increments: int) -> ContactState:
    """Pressed by DEPTH from first touch."""
    return follow(problem, rest(problem, touching_height(problem)), lift(problem, 0.0, DEPTH), increments)


def work_of(problem: ContactProblem, state: ContactState, target: FloatArray, steps: int) -> tuple[ContactState, float]:
    """State at the end of a line, and the work of the actuator on the way [N mm/mm], by trapezoids."""
    begin, work = state.actuator, 0.0
    for step in range(1, steps + 1):
        following = follow(problem, state, begin + step / steps * (target - begin), 1)
        mean = (state.force + following.force).sum(axis=0) / 2.0
        work += float(mean @ (following.actuator - state.actuator)[0])
        state = following
    return state, work


def stored(problem: ContactProblem, state: ContactState) -> float:
    """Elastic energy [N mm/mm], f . C f / 2."""
    force = state.force.ravel()
    return float(force @ problem.compliance @ force) / 2.0


def test_without_friction_the_work_done_is_stored() -> None:
    """Also that of sliding over the edges' slopes, which forces along the face leave out by more than a tenth."""
    problem, _ = rounded_block(0.0)
    missing = []
    for each in (problem, replace(problem, turning=False)):
        state, work = work_of(each, rest(each, touching_height(each)), lift(each, 0.0, DEPTH), 100)
        assert np.abs(profile(each.row, state.place)[1][state.status != Status.OPEN]).max() > 0.1  # the edges do press
        missing.append(abs(work - stored(each, state)) / work)
    assert missing[0] < 0.05 / 100**2  # trapezoids of 1/100 of the way: 0.02 of its square for 25 to 200 (measured)
    assert missing[1] > 10.0 * missing[0]


def test_with_friction_it_is_stored_or_dissipated() -> None:
    """The better the finer the increments, as slip is backward Euler; dissipation never falls."""
    problem, _ = rounded_block(0.3)
    missing = []
    for steps in (10, 40):
        state = pressed(problem, 10)
        before, lost = stored(problem, state), state.dissipation
        moved, work = work_of(problem, state, state.actuator + np.array([[4.0 * WAY, 0.0]]), steps)
        assert moved.dissipation - lost > 0.1 * work  # it slides
        missing.append(abs(work - (stored(problem, moved) - before) - (moved.dissipation - lost)) / work)
    assert missing[1] < 0.5 * missing[0]
    assert missing[1] < 0.01


def test_friction_holds_its_cone_across_the_turned_normal() -> None:
    """No node pulls, none bears more shear than mu N, what slips bears that; and some lie on the edges."""
    problem, _ = rounded_block(FRICTION)
    state = pressed(problem, 10)
    state = follow(problem, state, state.actuator + np.array([[WAY, 0.0]]), 10)
    slope = profile(problem.row, state.place)[1]
    length = np.sqrt(1.0 + slope**2)
    normal, tangent = np.stack([slope, np.ones_like(slope)]) / length, np.stack([np.ones_like(slope), -slope]) / length
    across, along = np.sum(state.force.T * normal, axis=0), np.sum(state.force.T * tangent, axis=0)
    assert np.allclose(shearing_and_pressing(problem, [state])[0].T, (along, across), rtol=0.0, atol=1e-15)
    touching = state.status != Status.OPEN
    assert np.abs(slope[touching]).max() > 0.2
    assert np.all(across[touching] >= 0.0)
    assert np.all(np.abs(along) <= FRICTION * across * (1.0 + 1e-9))
    slipping = state.status > Status.STICK
    assert slipping.any()
    assert np.allclose(np.abs(along[slipping]), FRICTION * across[slipping], rtol=1e-9, atol=0.0)


def test_penalties_that_stiffen_go_to_it() -> None:
    """The penalty law solves the same contact in another way: what is between them is 1 over its slopes, and what slid
    before it touched, of which little is left after so many increments (test_penalty).
    """
    problem, weight = rounded_block(FRICTION)
    state = pressed(problem, 160)
    state = follow(problem, state, state.actuator + np.array([[WAY, 0.0]]), 160)
    apart = []
    for stiffer in (4.0, 16.0):
        law = PenaltyLaw(500.0 * stiffer, 500.0 * stiffer, FRICTION)
        other = follow_penalties(problem, weight, law, untouched(problem), lift(problem, 0.0, DEPTH), 160)
        other = follow_penalties(problem, weight, law, other, lift(problem, WAY, DEPTH), 160)
        apart.append(np.linalg.norm(other.force - state.force) / np.linalg.norm(state.force))
    assert apart[1] < 0.4 * apart[0]
    assert apart[1] < 0.01


def test_the_bend_is_the_change_of_the_slope() -> None:
    row = ActuatorRow((0.0,), 0.6, 0.1)
    x = np.array([-0.29, -0.25, -0.1, 0.0, 0.22, 0.27, 0.2995, 0.35])
    step = 1e-6
    change = (profile(row, x + step)[1] - profile(row, x - step)[1]) / (2.0 * step)
    assert np.allclose(bend(row, x), change, rtol=1e-8, atol=0.0)


@pytest.mark.parametrize("friction", [0.0, FRICTION])
@pytest.mark.parametrize("turning", [False, True])
def test_newtons_matrix_is_the_change_of_its_equations(turning: bool, friction: float) -> None:
    """By central differences, whose error is the square of a step of 1e-5 of the edges' radius, or rounding over it.
    Without what turning adds increments converge too, but not as Newton's method does.
    """
    x, count = np.linspace(-0.44, 0.44, 7), 7
    problem = ContactProblem(
        position=np.stack([x, np.zeros(count)], axis=1),
        compliance=np.kron(np.exp(-np.abs(x[:, None] - x) / 0.3), np.array([[2.0, 0.3], [0.3, 1.0]])),
        row=ActuatorRow((0.0,), 1.0, 0.2),
        body=None,
        friction=friction,
        tolerance=1e-10,
        max_cuts=10,
        turning=turning,
    )
    patch = patch_of(problem, np.arange(count), x, None, np.zeros((1, 2)))
    increment = PatchProblem(problem, patch, problem.position.T, np.zeros(2 * count), 1.0)
    open_, stick, forward, backward = map(int, Status)
    states = _states(problem, np.array([forward, open_, stick, backward, stick, open_, backward]))
    moved, step = 0.01 * np.random.default_rng(0).standard_normal(2 * count), 2e-6

    def equations(moved: FloatArray) -> tuple[FloatArray, FloatArray]:
        return _newton_equations(increment, _at(increment, moved, states, x), states)

    matrix, _ = equations(moved)
    for column, unknown in enumerate(states.unknown):
        change = np.where(np.arange(2 * count) == unknown, step, 0.0)
        found = (equations(moved - change)[1] - equations(moved + change)[1]) / (2.0 * step)
        assert found == pytest.approx(matrix[:, column], abs=1e-8 * np.abs(matrix).max())


@pytest.mark.parametrize(
    ("turning", "kinematics"),
    [
        (TurningNormal.NEVER, set()),
        (TurningNormal.FINITE, {Kinematics.FINITE}),
        (TurningNormal.ALWAYS, set(Kinematics)),
    ],
)
def test_it_turns_where_asked_and_where_friction_acts(turning: TurningNormal, kinematics: set[Kinematics]) -> None:
    law = ContactLaw(FRICTION, FrictionFrom.TOUCH, turning, Criterion.FULL, depth=1.0, force=1.0)
    assert {each for each in Kinematics if law.turns(each, Interface.SHEAR)} == kinematics
    assert not any(law.turns(each, Interface.FRICTIONLESS) for each in Kinematics)
    pressed_without = [replace(law, friction=0.0), replace(law, friction_from=FrictionFrom.STIMULUS)]
    assert not any(each.turns(kind, Interface.SHEAR) for each in pressed_without for kind in Kinematics)
