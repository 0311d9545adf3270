"""Mirror symmetry of pre-indentation: one half is solved, the other is its mirror image.

Raising a row of actuators that mirrors about x = 0 against a section that does loads both halves alike, so the right
half answers with C_RR + C_RL M, where M mirrors the forces on the right to the left. Half the unknowns, an eighth of
the work, and the state that mirrors; with friction states that lean to one side may be solutions as well.

A node on x = 0 stays there, and the half bears half of its force.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import ReachError
from ..tissue.compliance import MIRROR, CondensedBody
from .formulation import ContactProblem, ContactState, Status
from .ownership import touches_both

ALIKE = 1e-10  # of the largest compliance [1]; source: rounding of a condensation leaves 1e-12
MIRRORED_STATUS = np.array([Status.OPEN, Status.STICK, Status.SLIP_BACKWARD, Status.SLIP_FORWARD])


def part_of(problem: ContactProblem, halved: bool) -> ContactProblem:
    """The part of a row that is solved: the right half where that is asked for (`halved`) and the problem mirrors, else
    all of it.
    """
    return fold(problem) if halved and mirrors(problem) else problem


def mirrors(problem: ContactProblem) -> bool:
    """Whether nodes and actuators mirror about x = 0, and bodies each in itself. Bodies need halves without a node in
    the middle, as hats there are one actuator's.
    """
    x, positions = problem.position[:, 0], np.asarray(problem.row.positions)
    return bool(
        np.array_equal(problem.position[::-1] * MIRROR, problem.position)
        and problem.row.mirrors
        and (problem.body is None or (_body_mirrors(problem.body) and np.all(positions != 0.0) and np.all(x != 0.0)))
    )


def _body_mirrors(body: CondensedBody) -> bool:
    """Whether a body answers mirrored forces with mirrored displacements."""
    count = body.coordinate.size
    answers = body.compliance.reshape(count, 2, count, 2)
    images = answers[::-1, :, ::-1] * MIRROR[:, None, None] * MIRROR
    return bool(np.abs(images - answers).max() <= ALIKE * np.abs(answers).max())


def fold(problem: ContactProblem) -> ContactProblem:
    """The right half's problem, its compliance under loads that mirror."""
    half, middle = divmod(problem.position.shape[0], 2)
    of_right = problem.compliance[2 * half :]
    # the left image of right node j is node count - 1 - j; its x and y unknowns keep their order
    of_images = (of_right[:, : 2 * half].reshape(-1, half, 2)[:, ::-1] * MIRROR).reshape(-1, 2 * half)
    compliance = of_right[:, 2 * half :].copy()
    compliance[:, 2 * middle :] += of_images
    if middle:
        compliance[0] = compliance[:, 0] = 0.0
        compliance[:, 1] *= 2.0
    return replace(half_of(problem), compliance=compliance)


def half_of(problem: ContactProblem) -> ContactProblem:
    """The problem with the nodes and actuators of the right half and the middle, whatever its compliance."""
    positions = tuple(x for x in problem.row.positions if x >= 0.0)
    half = problem.position.shape[0] // 2
    row = replace(problem.row, positions=positions)
    return replace(problem, position=problem.position[half:], row=row, images=2)


def unfolded(state: ContactState, problem: ContactProblem) -> ContactState:
    """The whole state of the half's, which `half_of` made a problem of. On the way a node in the middle counted with
    the half's force, so that `largest_force` may be smaller: dissipation is held to that.

    Raises ReachError if skin in the middle lies against the actuators on either side, which keep each other's force
    along x: the whole has no such state.
    """
    force, trend = state.force.copy(), state.trend.copy()
    node = int(problem.position[0, 0] == 0.0)  # how many there are in the middle, which both halves share
    actuator = int(problem.row.positions[0] == 0.0)
    if np.any(np.abs(force[:node, 0]) > problem.tolerance * state.largest_force):
        beside = problem.row.positions[state.given[0]]
        raise ReachError(f"{touches_both(-beside, beside)} or a finer mesh at the edges (numerics.edge_size)")
    right = state.given + len(problem.row.positions) - actuator
    last = 2 * len(problem.row.positions) - actuator - 1
    for halved in (force, trend):
        halved[:node] *= 2.0
    return replace(
        state,
        actuator=np.concatenate([state.actuator[::-1] * MIRROR, state.actuator[actuator:]]),
        force=np.concatenate([force[::-1] * MIRROR, force[node:]]),
        given=np.concatenate([(last - right)[::-1], right[node:]]),
        status=np.concatenate([MIRRORED_STATUS[state.status[::-1]], state.status[node:]]),
        place=np.concatenate([-state.place[::-1], state.place[node:]]),
        gap=np.concatenate([state.gap[::-1], state.gap[node:]]),
        heading=np.concatenate([state.heading[::-1] * MIRROR, state.heading[actuator:]]),
        drift=np.concatenate([state.drift[::-1] * MIRROR, state.drift[node:]]),
        trend=np.concatenate([trend[::-1] * MIRROR, trend[node:]]),
        largest_force=max(state.largest_force, float(np.abs(force).max())),
        dissipation=2.0 * state.dissipation,
    )
