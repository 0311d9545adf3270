"""The penalty law: where no normal turns it is `contact` on a softened face; where one does, its energy balances."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.calculix.crosscheck import sharpened
from fingerpad.calculix.penalty import PenaltyLaw, follow_penalties, untouched
from fingerpad.closedforms.blocks import block_contact, lift, refined_block
from fingerpad.contact.formulation import ContactProblem, rest, switch_friction, touching_height
from fingerpad.contact.path import follow
from fingerpad.contact.problem import contact_problem
from fingerpad.errors import ContactError
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow
from fingerpad.scene.finger import Material
from scenes import condensed, scene

FRICTION = 0.5
LAW = PenaltyLaw(500.0, 100.0, FRICTION)
DEPTH = 0.01  # mm


@cache
def pressed_block(radius: float, width: float) -> tuple[ContactProblem, FloatArray]:
    """A block of 8 mm by 4 mm under one actuator, fine where it is touched; modulus 1 MPa."""

    def size(x: FloatArray, y: FloatArray) -> FloatArray:
        return np.asarray(0.02 + 0.25 * np.hypot(np.maximum(x - 0.6, 0.0), y))

    mesh = refined_block(np.array([0.0, 4.0]), np.array([0.0, 4.0]), size)
    block = block_contact(mesh, Material(1.0, 0.3), ActuatorRow((0.0,), width, radius), FRICTION, reach=0.6)
    return block.problem, block.weight


@pytest.mark.parametrize(("indenting", "increments"), [(0.0, 40), (FRICTION, 160)])
def test_on_a_nearly_flat_face_it_is_contact_with_softer_nodes(indenting: float, increments: int) -> None:
    """On a cylinder of 50 mm the outermost candidate's normal turns by 0.6 / 50, and so may its force, no further.
    With friction from touch on, that takes more increments: the next test says why."""
    radius, reach = 50.0, 0.6
    problem, weight = pressed_block(radius, 2.0 * radius)
    law = replace(LAW, friction=indenting)
    before = follow_penalties(problem, weight, law, untouched(problem), lift(problem, 0.0, DEPTH), increments)
    after = follow_penalties(problem, weight, LAW, before, lift(problem, 0.001, DEPTH), 20)

    soft = np.stack([1.0 / (LAW.stick_slope * weight), 1.0 / (LAW.pressure_slope * weight)], axis=1).ravel()
    softened = replace(problem, compliance=problem.compliance + np.diag(soft))
    first = replace(softened, friction=indenting)
    state = follow(first, rest(first, touching_height(first)), lift(problem, 0.0, DEPTH), increments)
    assert np.abs(before.force - state.force).max() < reach / radius * np.abs(state.force).max()
    state = follow(softened, state if indenting else switch_friction(state), lift(problem, 0.001, DEPTH), 20)
    assert np.abs(after.force - state.force).max() < reach / radius * np.abs(state.force).max()
    assert abs(state.force[:, 0].sum()) > 0.1 * FRICTION * state.force[:, 1].sum()  # the face does pull


def test_what_slides_before_it_touches_leaves_a_trace_that_fades() -> None:
    """A cylinder of 50 mm that moves aside in the air and then comes straight down. By symmetry it would not pull; but
    as the way in the air is slip, nodes bear friction in full when they touch. With more increments there is less
    pressure by then."""
    problem, weight = pressed_block(50.0, 100.0)
    aside = follow_penalties(problem, weight, LAW, untouched(problem), lift(problem, 0.002, -DEPTH), 1)
    assert not aside.force.any()
    pulls = []
    for increments in (16, 64):
        force = follow_penalties(problem, weight, LAW, aside, lift(problem, 0.002, DEPTH), increments).force
        pulls.append(abs(force[:, 0].sum()) / (FRICTION * force[:, 1].sum()))
    assert pulls[0] > 0.05
    assert pulls[1] < 0.5 * pulls[0]  # the root of a quarter: pressure rises as the root at a front


def test_friction_holds_its_cone_on_turning_normals() -> None:
    """Forces of magnitude N sqrt(1 + mu^2) at most: no node bears more shear than mu N, whichever way its normal."""
    problem, weight = pressed_block(0.1, 0.6)
    state = follow_penalties(problem, weight, LAW, untouched(problem), lift(problem, 0.0, 0.1), 40)
    state = follow_penalties(problem, weight, LAW, state, lift(problem, 0.05, 0.1), 20)
    x, y = state.position.T
    beyond = np.maximum(np.abs(x) - 0.2, 0.0)
    angle = np.sign(x) * np.arctan2(beyond, y + 0.1)
    normal = np.stack([np.sin(angle), np.cos(angle)], axis=1)
    pressing = np.sum(state.force * normal, axis=1)
    shearing = state.force[:, 0] * normal[:, 1] - state.force[:, 1] * normal[:, 0]
    assert np.all(pressing >= -1e-12)
    assert np.all(np.abs(shearing) <= FRICTION * pressing + 1e-12)
    assert np.any(beyond[pressing > 0.0] > 0.0)  # the edges do press


def test_a_flat_face_may_be_overlapped_by_the_radius_of_its_edges() -> None:
    """Nodes there are as high as the centres of the edges, and have a normal all the same."""
    problem, weight = pressed_block(0.1, 0.6)
    with np.errstate(divide="raise", invalid="raise"):
        state = follow_penalties(problem, weight, LAW, untouched(problem), lift(problem, 0.0, 0.1), 1)
    assert state.force[:, 1].sum() > 0.0


def test_without_friction_the_work_done_is_stored() -> None:
    """Work of the actuators along the path = energy of tissue and penalties: f C f / 2 + sum N^2 / (2 k w)."""
    problem, weight = pressed_block(0.1, 0.6)
    law = replace(LAW, friction=0.0)
    state, work, steps = untouched(problem), 0.0, 200
    for height in np.linspace(0.0, 0.1, steps + 1)[1:]:
        following = follow_penalties(problem, weight, law, state, lift(problem, 0.0, float(height)), 1)
        work += (state.force + following.force)[:, 1].sum() / 2.0 * 0.1 / steps
        state = following
    force = state.force.ravel()
    tissue = force @ problem.compliance @ force / 2.0
    penalties = np.sum(np.sum(state.force**2, axis=1) / (2.0 * LAW.pressure_slope * weight))
    assert work == pytest.approx(tissue + penalties, rel=1 / steps**2)  # trapezoids


def test_it_is_for_rigid_actuators_with_rounded_edges() -> None:
    finger, body = condensed("device3")
    with pytest.raises(ContactError, match="rigid actuators with rounded edges"):
        untouched(contact_problem(scene("device3"), finger, body, Interface.SHEAR))
    with pytest.raises(ContactError, match="rigid actuators with rounded edges"):
        untouched(contact_problem(sharpened(scene("device2")), condensed("device2")[0], None, Interface.SHEAR))
