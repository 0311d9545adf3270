"""The laws that every contact solution obeys, on an elastic half-plane (closed forms: test_closedforms.py)."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fingerpad.arrays import FloatArray
from fingerpad.closedforms.blocks import half_plane, lift, pressed
from fingerpad.contact.active_set import PatchProblem
from fingerpad.contact.criterion import front, missing_of
from fingerpad.contact.depth import require_tissue
from fingerpad.contact.formulation import (
    MAX_ITERATIONS,
    ContactProblem,
    ContactState,
    Status,
    actuator_forces,
    rest,
    touching_height,
)
from fingerpad.contact.increment import solve_increment
from fingerpad.contact.indentation import SHALLOW, raise_until
from fingerpad.contact.not_converged import NotConvergedError
from fingerpad.contact.ownership import given_anew, given_to
from fingerpad.contact.patch import Patch, patch_of
from fingerpad.contact.path import LAST_ITERATIONS, advance, drifting_to, follow
from fingerpad.contact.profile import profile
from fingerpad.contact.symmetry import half_of, unfolded
from fingerpad.errors import ContactError, ConvergenceError, DepthError
from fingerpad.scene.contact_law import ContactLaw, Criterion, FrictionFrom, TurningNormal
from fingerpad.scene.device import ActuatorRow

SPACING = 1 / 64  # mm; contact is 0.4 to 1 mm wide


@cache
def touched(radius: float, width: float, friction: float) -> ContactProblem:
    """Half-plane under an actuator."""
    return half_plane(SPACING, SPACING, 0.3, ActuatorRow((0.0,), width, radius), friction).problem


def test_large_friction_equals_tied() -> None:
    """With more friction than any shear needs, moving the punch sideways is a linear, tied problem, to the tolerance of
    contact.
    """
    problem = touched(0.1, 1.0, 1e6)
    before = pressed(problem, 0.01, 8)
    after = follow(problem, before, before.actuator + np.array([[0.005, 0.0]]), 1)
    stuck = np.flatnonzero(before.status == Status.STICK)
    unknowns = (2 * stuck[:, None] + np.arange(2)).ravel()
    tied = np.linalg.solve(problem.compliance[np.ix_(unknowns, unknowns)], np.tile([0.005, 0.0], stuck.size))
    change = (after.force - before.force)[stuck].ravel()
    held = np.flatnonzero(after.status == Status.STICK)
    assert np.array_equal(held, stuck)  # the move is so small that no node opens or closes
    assert np.abs(change - tied).max() < problem.tolerance * np.abs(tied).max()


def test_frictionless_limit() -> None:
    """As friction goes to zero the solution goes to the frictionless one, in proportion."""
    reference = touched(0.1, 1.0, 0.0)
    base = pressed(reference, 0.01, 8)
    base = follow(reference, base, base.actuator + np.array([[0.01, 0.0]]), 4)
    distances = []
    for friction in (1e-2, 1e-4):
        problem = replace(reference, friction=friction)
        state = pressed(problem, 0.01, 8)
        state = follow(problem, state, state.actuator + np.array([[0.01, 0.0]]), 4)
        distances.append(np.abs(state.force - base.force).max() / np.abs(base.force).max())
    assert distances[1] < 1.5e-2 * distances[0]
    assert np.all(base.force[:, 0] == 0.0)


def test_mirrored_motion_gives_mirrored_forces() -> None:
    """Moving the punch left is the mirror image of moving it right, to the tolerance of contact."""
    problem = touched(0.1, 1.0, 0.5)
    before = pressed(problem, 0.02, 8)
    right, left = (follow(problem, before, before.actuator + np.array([[d, 0.0]]), 4) for d in (0.008, -0.008))
    mirrored = left.force[::-1] * np.array([-1.0, 1.0])
    assert np.abs(right.force - mirrored).max() < problem.tolerance * np.abs(right.force).max()


def test_energy_balance_and_dissipation() -> None:
    """Work of the punch = elastic energy + frictional dissipation, the better the finer the increments: halves leave a
    third, as slip is backward Euler and work comes by trapezoids. What stays is the profile's slope, which forces along
    the face leave out: 1.1e-4, a quarter of that on four times the radius at a quarter of the depth. None < 0.
    """
    problem = touched(100.0, 200.0, 0.3)  # nearly flat: the force along the face is the force on the skin
    errors = []
    for increments in (5, 10, 80):
        state = pressed(problem, 0.008, 4)
        stored, lost, work = _elastic(problem, state), state.dissipation, 0.0
        origin = state.actuator
        for step in range(1, increments + 1):
            target = origin + np.array([[0.004 * step / increments, 0.0]])
            following = follow(problem, state, target, 1)
            mean = (following.force + state.force) / 2
            work += float(mean.sum(axis=0) @ (following.actuator - state.actuator)[0])
            assert following.dissipation >= state.dissipation - 1e-15
            state = following
        stored, lost = _elastic(problem, state) - stored, state.dissipation - lost
        assert lost > 0.1 * abs(work)  # it slides
        errors.append(abs(work - stored - lost) / abs(work))
    assert errors[1] < errors[0] / 2.5
    assert errors[2] < 2e-4


def _elastic(problem: ContactProblem, state: ContactState) -> float:
    """Elastic energy [N mm per mm]: f . C f / 2."""
    force = state.force.ravel()
    return float(force @ problem.compliance @ force) / 2


def test_sliding_punch_carries_contact_along() -> None:
    """Finite sliding: without friction the pressure pattern moves with the punch, node by node. Its force stays, but
    for the grid of nodes, whose error falls with the square of spacing over the contact's half width.
    """
    problem = touched(0.1, 0.8, 0.0)
    before = pressed(problem, 0.01, 8)
    after = follow(problem, before, before.actuator + np.array([[0.1, 0.0]]), 10)
    x = problem.position[:, 0]
    centre = [float(x @ state.force[:, 1] / state.force[:, 1].sum()) for state in (before, after)]
    assert centre[0] == pytest.approx(0.0, abs=problem.tolerance)
    assert centre[1] == pytest.approx(0.1, abs=0.004)  # less than half a node spacing
    assert after.force[:, 1].sum() == pytest.approx(before.force[:, 1].sum(), rel=(SPACING / 0.4) ** 2)


def test_separation_and_return() -> None:
    """A punch that lets go carries nothing, and comes back to the state it left (no friction), to the tolerance of
    contact.
    """
    problem = touched(0.1, 1.0, 0.0)
    down = pressed(problem, 0.01, 8)
    free = follow(problem, down, lift(problem, 0.0, -0.02), 5)
    assert not free.force.any()
    again = follow(problem, free, down.actuator, 5)
    assert np.abs(again.force - down.force).max() < problem.tolerance * np.abs(down.force).max()


def test_a_path_that_cannot_be_followed_is_a_named_error() -> None:
    """No compliance, no solution: the error says where."""
    problem = touched(0.1, 1.0, 0.5)
    broken = replace(problem, compliance=np.zeros_like(problem.compliance), max_cuts=2)
    with pytest.raises(ContactError, match=r"increment 1/3 halved 2 times, residual .*, tolerance 1e-10"):
        follow(broken, rest(broken, 0.0), lift(broken, 0.0, 0.01), 3)


def test_halvings_of_earlier_increments_are_not_counted() -> None:
    """Increments of a quarter of the way are too long, and beyond three quarters any is."""
    problem = ContactProblem(
        position=np.zeros((1, 2)),
        compliance=np.eye(2),
        row=ActuatorRow((0.0,), 1.0, 0.1),
        body=None,
        friction=0.0,
        tolerance=1e-9,
        max_cuts=8,
    )

    def solve(
        problem: ContactProblem, start: ContactState, actuator: FloatArray, carried: None
    ) -> tuple[ContactState, None]:
        place = float(actuator[0, 1])
        if place > 0.75 or place - float(start.actuator[0, 1]) > 0.2:
            raise NotConvergedError(1.0)
        return replace(start, actuator=actuator), None

    with pytest.raises(ConvergenceError, match=r"75.0% of the way .* increment 4/4 halved 8 times"):
        advance(problem, rest(problem, 0.0), np.array([[0.0, 1.0]]), 4, None, solve)


def test_an_increment_with_which_a_path_would_end_may_take_more_iterations() -> None:
    """Halves first, as they take fewer; the last of them, and those that follow as short, have as many as it takes."""
    problem, allowed = replace(touched(0.1, 1.0, 0.5), max_cuts=2), list[tuple[float, int]]()

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, carried: None
    ) -> tuple[ContactState, None]:
        allowed.append((float(actuator[0, 1]), problem.most_iterations))
        if problem.most_iterations == MAX_ITERATIONS:
            raise NotConvergedError(1.0)
        return replace(state, actuator=actuator), None

    reached, _ = advance(problem, rest(problem, 0.0), lift(problem, 0.0, 1.0), 1, None, solve)
    assert reached.actuator == pytest.approx(lift(problem, 0.0, 1.0))
    assert allowed[:3] == [(1.0, MAX_ITERATIONS), (0.5, MAX_ITERATIONS), (0.25, LAST_ITERATIONS)]
    assert reached.cuts == sum(most == MAX_ITERATIONS for _, most in allowed)


@pytest.mark.parametrize("count", range(1, 31))
def test_a_path_is_halved_as_often_as_it_may_be_however_many_increments_it_has(count: int) -> None:
    """Halves of a count that is no power of two are no fractions of the way that numbers hold. The error is about the
    increment that is lost, and the actuator that moves."""
    problem = replace(touched(0.1, 1.0, 0.5), max_cuts=8)
    start = rest(problem, 0.0)
    start = replace(start, actuator=np.zeros((2, 2)))

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, carried: None
    ) -> tuple[ContactState, None]:
        if actuator[1, 1] > count - 1 + 1e-9:
            raise NotConvergedError(1.0)
        return replace(state, actuator=actuator), None

    with pytest.raises(
        ConvergenceError, match=rf"from \(0, 0\) to \(0, {count}\) mm, increment {count}/{count} halved 8 "
    ):
        advance(problem, start, np.array([[0.0, 0.0], [0.0, float(count)]]), count, None, solve)


@pytest.mark.parametrize(
    ("length", "expected"),
    [
        (0.03, [0.01, 0.005, 0.015, 0.025, 0.03, 0.0275, 0.03]),  # an increment crosses no two distances of nodes
        (1.2, [0.4, 0.2, 0.4, 0.6, 0.8, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2]),  # many, so they stay as short as they got
    ],
)
def test_a_halved_increment_is_another(length: float, expected: list[float]) -> None:
    """Of three increments the first is halved. Made whole again, where it may be, the last would reach over the end:
    where that fails, half of what is left is tried, not the same again."""
    problem, tried = touched(0.1, 1.0, 0.5), list[float]()

    def solve(
        problem: ContactProblem, state: ContactState, actuator: np.ndarray, patch: None
    ) -> tuple[ContactState, None]:
        tried.append(float(actuator[0, 1]))
        if len(tried) in (1, 5):
            raise NotConvergedError(1.0)
        return replace(state, actuator=actuator), None

    reached, _ = advance(problem, rest(problem, 0.0), lift(problem, 0.0, length), 3, None, solve)
    assert tried == pytest.approx(expected)
    assert reached.actuator == pytest.approx(lift(problem, 0.0, length))


@pytest.mark.parametrize("power", [1, 2])
def test_skin_drifts_with_a_power_of_the_way(power: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Evenly, or with the square of it, but for the rounding of numbers below one."""
    problem, found = touched(0.1, 1.0, 0.5), list[float]()

    def solve(problem: ContactProblem, state: ContactState, actuator: FloatArray, patch: None) -> tuple[object, None]:
        assert problem.free is not None
        found.append(float(problem.free[0, 1]))
        return replace(state, actuator=actuator), None

    monkeypatch.setattr("fingerpad.contact.path.solve_increment", solve)
    begin, target = rest(problem, 0.0), lift(problem, 0.0, 0.01)
    drifting = drifting_to(np.full_like(problem.position, 0.8), begin.actuator, target, power)
    advance(problem, begin, target, 4, None, drifting)
    assert found == pytest.approx([0.8 * (step / 4.0) ** power for step in range(1, 5)], abs=1e-15)


@pytest.mark.parametrize(("lost", "reached"), [(0.22, True), (0.19, False)])
def test_a_path_that_is_lost_beyond_a_force_reaches_it(lost: float, reached: bool) -> None:
    """Pressed with a force that is borne 0.2 mm deep, in increments of 0.3 mm, on skin that is lost somewhat deeper."""
    problem, force = touched(0.1, 1.0, 0.5), 1.0
    touch = touching_height(problem)

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, patch: Patch | None
    ) -> tuple[ContactState, Patch | None]:
        depth = float(actuator[0, 1]) - touch
        if depth > lost:
            raise NotConvergedError(1.0)
        borne = np.full_like(state.force, 5.0 * depth / state.given.size)
        return replace(state, actuator=actuator, force=borne), patch

    law = ContactLaw(0.5, FrictionFrom.TOUCH, TurningNormal.NEVER, Criterion.FORCE, 1.0, force)
    if reached:
        state = raise_until(problem, law, 1, 3.0, rest(problem, touch), solve)
        assert state.force[:, 1].sum() == pytest.approx(force, rel=1e-4)
    else:
        with pytest.raises(ConvergenceError):
            raise_until(problem, law, 1, 3.0, rest(problem, touch), solve)


def test_a_way_that_goes_too_far_is_taken_back_no_farther_than_needed() -> None:
    """Pressed with a force that is borne 0.2 mm deep, where an increment of 0.3 mm is halved: its first half stays."""
    problem, begun = touched(0.1, 1.0, 0.5), list[float]()
    touch = touching_height(problem)

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, patch: Patch | None
    ) -> tuple[ContactState, Patch | None]:
        if actuator[0, 1] - state.actuator[0, 1] > 0.2:
            raise NotConvergedError(1.0)
        begun.append(float(state.actuator[0, 1]) - touch)
        borne = np.full_like(state.force, 5.0 * (float(actuator[0, 1]) - touch) / state.given.size)
        return replace(state, actuator=actuator, force=borne), patch

    law = ContactLaw(0.5, FrictionFrom.TOUCH, TurningNormal.NEVER, Criterion.FORCE, 0.3, 1.0)
    reached = raise_until(problem, law, 1, 0.3 / SHALLOW, rest(problem, touch), solve)
    assert reached.force[:, 1].sum() == pytest.approx(1.0, rel=1e-4)
    assert begun[:2] == pytest.approx([0.0, 0.15])
    assert min(begun[1:]) == pytest.approx(0.15)


@pytest.mark.parametrize("depth", [0.001, 0.0015, 0.002, 0.1])
def test_a_depth_is_gone_to_its_end(depth: float) -> None:
    """Also where it is as small as what may be missing of a face or of a gap at the end."""
    problem = touched(0.1, 1.0, 0.0)
    touch = touching_height(problem)
    law = ContactLaw(0.0, FrictionFrom.TOUCH, TurningNormal.NEVER, Criterion.DEPTH, depth, 1.0)
    state = raise_until(problem, law, 40, 3.0, rest(problem, touch), solve_increment)
    assert state.actuator[0, 1] - touch == pytest.approx(depth, rel=1e-6)  # the least step is a nanometre


def even_skin(compliance: FloatArray) -> ContactProblem:
    """A flat actuator of 1 mm under as many nodes, evenly apart, as a compliance (2n, 2n) has."""
    x = np.linspace(0.0, 1.0, compliance.shape[0] // 2)
    return ContactProblem(
        position=np.array([x, np.zeros(x.size)]).T,
        compliance=compliance,
        row=ActuatorRow((0.5,), 1.0, 0.0),
        body=None,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=10,
    )


def patch_of_all(problem: ContactProblem) -> Patch:
    """The patch of all nodes of a problem."""
    x = problem.position[:, 0]
    return patch_of(problem, np.arange(x.size), x, None, np.zeros((1, 2)))


def missed_by_a_patch(compliance: FloatArray) -> float:
    """By how much the stiffness of a patch of all nodes misses unit displacements under a compliance (2n, 2n)."""
    count = compliance.shape[0] // 2
    order = np.concatenate([2 * np.arange(count), 2 * np.arange(count) + 1])
    response = patch_of_all(even_skin(compliance)).response
    unit = compliance[np.ix_(order, order)] @ response.T  # which has one displacement a row
    return float(np.abs(unit - np.eye(2 * count)).max())


def test_what_rounding_leaves_of_forces_is_no_residual() -> None:
    """Displacements of all nodes that are off by their last digit, in the directions that count most for a force,
    change it by the tolerance of the smallest force that is asked for, and no more: were it less, scenes of stiff
    layers on soft ones would never settle.
    """
    x = np.linspace(0.0, 1.0, 40)
    problem = even_skin(np.kron(np.exp(-np.abs(x[:, None] - x) / 0.3), np.eye(2)))
    patch = patch_of_all(problem)
    scale = 1.0  # mm
    increment = PatchProblem(problem, patch, np.zeros((2, x.size)), np.zeros(2 * x.size), scale)
    changes = [
        np.abs(np.finfo(float).eps * scale * np.sign(patch.response[:, force]) @ patch.response).max()
        for force in range(2 * x.size)
    ]
    assert max(changes) == pytest.approx(increment.force_floor * problem.tolerance, rel=1e-9)


@pytest.mark.parametrize("reach", [0.05, 0.3])
def test_a_patch_whose_nodes_move_alike_is_inverted(reach: float) -> None:
    """Halves of halves alone miss unit loads by 0.1 to 10 here, as soft tissue under a stiff skin has it."""
    x = np.linspace(0.0, 1.0, 100)
    alike = np.exp(-(((x[:, None] - x) / reach) ** 2)) + 1e-6 * np.eye(x.size)  # condition 1e7 to 1e8
    # what elimination with pivots leaves: rounding times the condition
    assert missed_by_a_patch(np.kron(alike, np.eye(2))) < np.finfo(float).eps * np.linalg.cond(alike)


def test_a_patch_is_inverted_by_halves_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where they are well conditioned nothing falls back on elimination, which would hide that halves are wrong."""
    monkeypatch.setattr("fingerpad.contact.patch.LOST", np.inf)
    x = np.linspace(0.0, 1.0, 100)
    compliance = np.kron(np.exp(-np.abs(x[:, None] - x) / 0.1), np.array([[2.0, 0.3], [0.3, 1.0]]))
    assert missed_by_a_patch(compliance) < np.finfo(float).eps * np.linalg.cond(compliance)


def test_the_front_of_contact_is_where_hertz_has_it() -> None:
    """Skin that leaves the face as distance to the power 3/2, between two nodes."""
    x = np.linspace(-0.2, 0.3, 11)
    assert front(x, np.maximum(x - 0.07, 0.0) ** 1.5, x < 0.02) == pytest.approx(0.07, abs=1e-13)  # rounding


def test_the_front_of_contact_lies_no_nearer_than_what_touches() -> None:
    """Though skin beyond hardly rises from one node to the next, and extrapolates to zero before."""
    assert front(np.arange(4.0), np.array([0.0, 0.0, 1.0, 1.1]), np.arange(4) < 2) == 1.0


def test_faces_are_covered_on_half_of_a_row_as_on_all_of_it() -> None:
    """Skin leaves two faces 0.5 mm beside their middles, on the side where the other one is: to cover 0.9 mm of each
    0.4 mm are missing. What touches beyond the mid-line is the other face's.
    """
    x = np.linspace(-3.5, 3.5, 29)
    problem = replace(even_skin(np.eye(2 * x.size)), row=ActuatorRow((-2.0, 2.0), 2.0, 0.1))
    problem = replace(problem, position=np.stack([x, np.zeros(x.size)], axis=1))
    half = half_of(problem)
    state, right = rest(half, 0.0), half.position[:, 0]
    height = np.maximum(1.5 - right, 0.0) ** 1.5 + np.maximum(right - 3.0, 0.0) ** 1.5
    status = np.where(height == 0.0, Status.STICK, Status.OPEN)
    state = replace(state, status=status, gap=height + profile(half.row, state.place)[0])
    law = ContactLaw(0.5, FrictionFrom.TOUCH, TurningNormal.NEVER, Criterion.FULL, 1.0, 1.0)
    missing = [missing_of(half, state, law, 0.0), missing_of(problem, unfolded(state, half), law, 0.0)]
    assert missing == pytest.approx([0.4, 0.4], abs=1e-12)


def test_skin_that_is_given_to_another_actuator_has_the_gap_over_that_one() -> None:
    """Actuators stand at heights and places of their own. Exact, but for the rounding of lengths of some mm."""
    x = np.linspace(-0.5, 2.5, 13)
    problem = ContactProblem(
        position=np.stack([x, 0.1 * x**2], axis=1),
        compliance=np.eye(2 * x.size),
        row=ActuatorRow((0.0, 2.0), 1.0, 0.1),
        body=None,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=10,
    )
    actuator = np.array([[0.1, 0.01], [-0.2, 0.05]])
    there = []
    for number, (centre, height) in enumerate(zip((0.1, 1.8), (0.01, 0.05), strict=True)):
        own = replace(problem, given=np.full(x.size, number))
        gap = problem.position[:, 1] - height + profile(problem.row, x - centre)[0]
        there.append(replace(rest(own, 0.0), actuator=actuator, place=x - centre, gap=gap))
    for state, other in (there, there[::-1]):
        _, found = given_to(replace(problem, given=state.given), state, other.given)
        assert found.place == pytest.approx(other.place, abs=1e-14)
        assert found.gap == pytest.approx(other.gap, abs=1e-14)


def test_what_a_path_missed_stays_missed() -> None:
    """Of equations and of certificates the largest residual so far counts, whatever follows."""
    problem = touched(0.1, 1.0, 0.5)
    missed = replace(pressed(problem, 0.01, 2), residual=1e-3)
    assert follow(problem, missed, missed.actuator + lift(problem, 0.0, 0.001), 1).residual == 1e-3


@pytest.mark.parametrize("moves", [1, 2])
def test_skin_sticks_where_it_was_touched_on_the_way(moves: int) -> None:
    """A flat face that comes aslant touches a node on springs of 1 N/mm half-way, from rest as after it has come up
    straight, where the path turns. What it went before is no slip, and what it goes then takes as much force, to the
    tolerance of contact.
    """
    problem = ContactProblem(
        position=np.array([[0.0, 0.03]]),
        compliance=np.eye(2),
        row=ActuatorRow((0.0,), 10.0, 0.0),
        body=None,
        friction=1.0,
        tolerance=1e-9,
        max_cuts=10,
    )
    state = rest(problem, 0.02)
    if moves == 2:
        state = follow(problem, rest(problem, 0.0), lift(problem, 0.0, 0.02), 1)
    state = follow(problem, state, lift(problem, 0.01, 0.04), 1)
    assert state.status[0] == Status.STICK
    assert state.force[0] == pytest.approx([0.005, 0.01], rel=1e-8)


def two_pins(x: FloatArray) -> ContactProblem:
    """Nodes at x (n,) under two pins; each node moves alone."""
    return ContactProblem(
        position=np.stack([x, np.zeros_like(x)], axis=1),
        compliance=np.eye(2 * x.size),
        row=ActuatorRow((0.0, 2.0), 1.0, 0.1),
        body=None,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=10,
    )


def test_hats_reach_to_the_next_nodes_of_an_actuator() -> None:
    """Those of its outermost nodes, which have one neighbour, as far to the other side."""
    sides, shares = two_pins(np.array([-0.5, -0.2, 0.4, 1.6, 2.0])).hats
    assert sides == pytest.approx(np.array([[-0.3, -0.3, -0.6, -0.4, -0.4], [0.3, 0.6, 0.6, 0.4, 0.4]]))
    assert shares[0] == pytest.approx([0.5, 1.0 / 3.0, 0.5, 0.5, 0.5])
    assert shares.sum(axis=0) == pytest.approx(np.ones(5))


def test_skin_that_is_given_to_another_actuator_does_not_touch_it_yet() -> None:
    """And promises nothing over it; the other nodes stay as they are."""
    problem, ones = two_pins(np.linspace(-0.5, 2.5, 13)), np.ones((13, 2))
    state = replace(rest(problem, 0.0), status=np.full(13, Status.STICK), drift=ones, trend=ones)
    moved = np.arange(13) == np.flatnonzero(state.given == 0)[-1]
    _, found = given_to(problem, state, np.where(moved, 1, state.given))
    assert ((found.status == Status.OPEN) == moved).all()
    assert (found.drift == ~moved[:, None]).all()
    assert (found.trend == ~moved[:, None]).all()


def test_forces_are_borne_by_the_actuator_that_skin_is_given_to() -> None:
    """Not by the one that undeformed skin is nearest to."""
    problem = two_pins(np.linspace(-0.5, 2.5, 13))
    state = replace(rest(problem, 0.0), force=np.ones((13, 2)))
    _, other = given_to(problem, state, np.full(13, 1))
    assert actuator_forces(problem, [state, other])[:, :, 1].tolist() == [[7.0, 6.0], [0.0, 13.0]]


def test_of_skin_that_went_sideways_that_beside_contact_stays() -> None:
    """Two open nodes have come nearer to the right pin; the one next to a node that touches the left keeps its own."""
    problem = two_pins(np.linspace(-0.5, 2.5, 13))
    state = rest(problem, 0.0)
    last = int(np.flatnonzero(state.given == 0)[-1])
    place, status = state.place.copy(), np.full(13, Status.OPEN)
    place[last - 1 : last + 1], status[last - 2] = (1.6, 1.8), Status.STICK
    _, found = given_anew(problem, replace(state, place=place, status=status))
    assert found.given[last - 2 : last + 1].tolist() == [0, 0, 1]


@pytest.mark.parametrize("touches", [False, True])
def test_of_skin_that_went_sideways_actuators_stay_in_order(touches: bool) -> None:
    """An open node of the left pin has come to lie over the right one, and three to its right have not: all of them go,
    or, where the last of them touches the left pin, none.
    """
    problem = two_pins(np.linspace(-0.5, 2.5, 13))
    state = rest(problem, 0.0)
    last = int(np.flatnonzero(state.given == 0)[-1])
    place, status = state.place.copy(), np.full(13, Status.OPEN)
    place[last - 3] = 1.8
    status[last] = Status.STICK if touches else Status.OPEN
    _, found = given_anew(problem, replace(state, place=place, status=status))
    expected = state.given if touches else np.where(np.arange(13) < last - 3, 0, 1)
    assert found.given.tolist() == expected.tolist()


@pytest.mark.parametrize("lost", [0, 1])
def test_skin_comes_back_to_the_outermost_actuators(lost: int) -> None:
    """To the last as to the first, though nothing was left to it."""
    problem = two_pins(np.linspace(-0.5, 2.5, 13))
    state = rest(problem, 0.0)
    _, other = given_to(problem, state, np.full(13, 1 - lost))
    _, found = given_anew(problem, other)
    assert (found.given == state.given).all()


@pytest.mark.parametrize("time", [0, 1, 2])
def test_the_deepest_place_counts_whenever_it_is(time: int) -> None:
    places = np.zeros((3, 2, 2))
    places[time, 1, 1] = 5.1
    with pytest.raises(DepthError, match=r"5\.1 mm deep, into 5 mm of tissue"):
        require_tissue(two_pins(np.linspace(-0.5, 2.5, 13)), places, 5.0)
