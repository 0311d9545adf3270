"""Contact against closed forms on an elastic half-plane (a large block), and the laws that every solution obeys."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from blocks import block, block_problem, graded, lift
from fingerpad.contact import ContactProblem, ContactState, Status, follow, rest, switch_friction, touching_height
from fingerpad.errors import ContactError
from fingerpad.scene import ActuatorRow, FloatArray, Material

HALF_PLANE = 60.0  # mm; contact is 1 mm wide: its local field sees the far boundary by less than (1/60)^2


@cache
def half_plane(
    radius: float, width: float, poisson: float, friction: float, fine: float = 0.02
) -> tuple[ContactProblem, FloatArray]:
    """Large block, fine where it is touched; modulus 1 MPa."""
    side = graded(fine, 0.8, 1.25, HALF_PLANE)
    mesh = block(np.concatenate([-side[:0:-1], side]), graded(fine, 5 * fine, 1.25, HALF_PLANE))
    row = ActuatorRow((0.0,), width, radius)
    return block_problem(mesh, Material(1.0, poisson), row, friction, 0.8)


def pressed(problem: ContactProblem, depth: float, increments: int = 8) -> ContactState:
    """State after pressing by `depth` [mm] from first touch."""
    height = touching_height(problem)
    return follow(problem, rest(problem, height), lift(problem, 0.0, height + depth), increments)


def test_contact_patch_uniform_pressure_is_exact() -> None:
    """A flat face on a confined block: pressure (lambda + 2 mu) d / H everywhere, to rounding."""
    material = Material(0.08, 0.48)
    mesh = block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5))
    problem, weight = block_problem(
        mesh, material, ActuatorRow((0.0,), 6.0, 0.0), friction=0.0, reach=1.0, confined=True
    )
    state = pressed(problem, 0.01)
    nu = material.poisson
    oedometric = material.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    assert np.abs(state.force[:, 1] / weight / (oedometric * 0.01) - 1.0).max() < 1e-9
    assert np.all(state.status != Status.OPEN)


def test_hertz() -> None:
    """Cylinder on half-plane: p0 = 2 P / (pi a), a^2 = 4 P R / (pi E*), p = p0 sqrt(1 - x^2/a^2), each within 0.5 %."""
    radius, poisson = 100.0, 0.3  # a / R = 0.005: what Hertz neglects is of that order times 1 - 2 nu
    problem, weight = half_plane(radius, 2 * radius, poisson, 0.0)
    state = pressed(problem, 0.008)
    load = state.force[:, 1].sum()
    plane = 1.0 / (1 - poisson**2)
    a = np.sqrt(4 * load * radius / (np.pi * plane))
    assert 0.3 < a < 0.7  # well inside the fine zone
    x = problem.position[:, 0]
    exact = 2 * load / (np.pi * a) * np.sqrt(np.maximum(1 - (x / a) ** 2, 0.0))
    # forces, not pressures, are what the nodes carry; compare where the exact pressure is not vanishing
    inner = np.abs(x) < 0.9 * a
    assert np.linalg.norm((state.force[:, 1] / weight - exact)[inner]) < 5e-3 * np.linalg.norm(exact[inner])
    # the contact's edge lies between the last closed and the first open node
    closed = np.abs(x[state.status != Status.OPEN]).max()
    assert closed - 1e-9 <= a * 1.005
    assert closed + 0.021 >= a * 0.995


def test_flat_punch() -> None:
    """Sharp flat punch: p = P / (pi sqrt(b^2 - x^2)) over the inner four fifths.

    The singular edge is smeared over one node spacing h, so the punch seems wider or narrower by a share of h: the
    relative error is below h / b, whatever the place of the nodes.
    """
    half, errors = 0.5, []
    for fine in (0.016, 0.008):
        problem, weight = half_plane(0.0, 2 * half, 0.3, 0.0, fine)
        state = pressed(problem, 0.01)
        load = state.force[:, 1].sum()
        x = problem.position[:, 0]
        inner = np.abs(x) < 0.8 * half
        exact = load / (np.pi * np.sqrt(half**2 - x[inner] ** 2))
        errors.append(np.linalg.norm(state.force[inner, 1] / weight[inner] - exact) / np.linalg.norm(exact))
        assert errors[-1] < fine / 2 / half


def test_cattaneo_mindlin() -> None:
    """Partial slip: stick half-width c = a sqrt(1 - Q / (mu P)), within one node spacing; slip obeys Coulomb."""
    radius, poisson, friction = 100.0, 0.3, 0.5
    problem, weight = half_plane(radius, 2 * radius, poisson, friction, fine=0.01)
    # the theory lets pressure move nothing sideways (Goodman), presses without shear, and lets friction act from there
    uncoupled = problem.compliance.copy()
    uncoupled[0::2, 1::2] = uncoupled[1::2, 0::2] = 0.0
    problem = replace(problem, compliance=uncoupled)
    normal = switch_friction(pressed(replace(problem, friction=0.0), 0.008))
    state = follow(problem, normal, normal.actuator + np.array([[0.0025, 0.0]]), 20)
    load, shear = state.force[:, 1].sum(), state.force[:, 0].sum()
    ratio = abs(shear) / (friction * load)
    assert 0.3 < ratio < 0.9  # partial slip, neither stuck nor sliding
    a = np.sqrt(4 * load * radius * (1 - poisson**2) / np.pi)
    stick = np.abs(problem.position[state.status == Status.STICK, 0])
    assert stick.max() == pytest.approx(a * np.sqrt(1 - ratio), abs=0.006)  # one node spacing
    # traction: mu p outside the stick zone, less a smaller Hertzian inside
    x = problem.position[:, 0]
    c = a * np.sqrt(1 - ratio)
    p0 = 2 * load / (np.pi * a)
    exact = friction * p0 * np.sqrt(np.maximum(1 - (x / a) ** 2, 0))
    exact -= friction * p0 * c / a * np.sqrt(np.maximum(1 - (x / c) ** 2, 0))
    # behind the slip front's kink the forces of vertices and midpoints swing about the traction: take them together
    inner = np.flatnonzero(np.abs(x) < 0.9 * a)[: x[np.abs(x) < 0.9 * a].size // 2 * 2].reshape(-1, 2)
    found, wanted = np.abs(state.force[inner, 0]).sum(axis=1), (exact * weight)[inner].sum(axis=1)
    assert np.linalg.norm(found - wanted) < 0.005 * np.linalg.norm(wanted)


def test_large_friction_equals_tied() -> None:
    """With more friction than any shear needs, moving the punch sideways is a linear, tied problem."""
    problem, _ = half_plane(0.1, 1.0, 0.3, 1e6)
    before = pressed(problem, 0.01)
    after = follow(problem, before, before.actuator + np.array([[0.005, 0.0]]), 1)
    stuck = np.flatnonzero(before.status == Status.STICK)
    unknowns = (2 * stuck[:, None] + np.arange(2)).ravel()
    tied = np.linalg.solve(problem.compliance[np.ix_(unknowns, unknowns)], np.tile([0.005, 0.0], stuck.size))
    change = (after.force - before.force)[stuck].ravel()
    held = np.flatnonzero(after.status == Status.STICK)
    assert np.array_equal(held, stuck)  # the move is so small that no node opens or closes
    assert np.abs(change - tied).max() < 1e-6 * np.abs(tied).max()


def test_frictionless_limit() -> None:
    """As friction goes to zero the solution goes to the frictionless one, in proportion."""
    reference, _ = half_plane(0.1, 1.0, 0.3, 0.0)
    base = pressed(reference, 0.01)
    base = follow(reference, base, base.actuator + np.array([[0.01, 0.0]]), 4)
    distances = []
    for friction in (1e-2, 1e-4):
        problem = replace(reference, friction=friction)
        state = pressed(problem, 0.01)
        state = follow(problem, state, state.actuator + np.array([[0.01, 0.0]]), 4)
        distances.append(np.abs(state.force - base.force).max() / np.abs(base.force).max())
    assert distances[1] < 1.5e-2 * distances[0]
    assert np.all(base.force[:, 0] == 0.0)


def test_mirrored_motion_gives_mirrored_forces() -> None:
    """Moving the punch left is the mirror image of moving it right."""
    problem, _ = half_plane(0.1, 1.0, 0.3, 0.5)
    before = pressed(problem, 0.02)
    right, left = (follow(problem, before, before.actuator + np.array([[d, 0.0]]), 4) for d in (0.008, -0.008))
    mirrored = left.force[::-1] * np.array([-1.0, 1.0])
    assert np.abs(right.force - mirrored).max() < 1e-7 * np.abs(right.force).max()


def test_energy_balance_and_dissipation() -> None:
    """Work of the punch = elastic energy + frictional dissipation, the better the finer the increments; none < 0."""
    problem, _ = half_plane(100.0, 200.0, 0.3, 0.3)  # nearly flat: the force along the face is the force on the skin
    errors = []
    for increments in (5, 20):
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
    assert errors[1] < 0.5 * errors[0]
    assert errors[1] < 0.01


def _elastic(problem: ContactProblem, state: ContactState) -> float:
    """Elastic energy [N mm per mm]: f . C f / 2."""
    force = state.force.ravel()
    return float(force @ problem.compliance @ force) / 2


def test_sliding_punch_carries_contact_along() -> None:
    """Finite sliding: without friction the pressure pattern moves with the punch, node by node."""
    problem, _ = half_plane(0.1, 0.8, 0.3, 0.0)
    before = pressed(problem, 0.01)
    after = follow(problem, before, before.actuator + np.array([[0.1, 0.0]]), 10)
    x = problem.position[:, 0]
    centre = [float(x @ state.force[:, 1] / state.force[:, 1].sum()) for state in (before, after)]
    assert centre[0] == pytest.approx(0.0, abs=1e-6)
    assert centre[1] == pytest.approx(0.1, abs=0.004)  # less than half a node spacing
    assert after.force[:, 1].sum() == pytest.approx(before.force[:, 1].sum(), rel=0.01)


def test_separation_and_return() -> None:
    """A punch that lets go carries nothing, and comes back to the state it left (no friction)."""
    problem, _ = half_plane(0.1, 1.0, 0.3, 0.0)
    down = pressed(problem, 0.01)
    free = follow(problem, down, lift(problem, 0.0, -0.02), 5)
    assert not free.force.any()
    again = follow(problem, free, down.actuator, 5)
    assert np.abs(again.force - down.force).max() < 1e-8 * np.abs(down.force).max()


def test_a_path_that_cannot_be_followed_is_a_named_error() -> None:
    """No compliance, no solution: the error says where."""
    problem, _ = half_plane(0.1, 1.0, 0.3, 0.5)
    broken = replace(problem, compliance=np.zeros_like(problem.compliance), max_cuts=2)
    with pytest.raises(ContactError, match=r"increment 1/3 halved 2 times, residual .* > 1e-10"):
        follow(broken, rest(broken, 0.0), lift(broken, 0.0, 0.01), 3)
