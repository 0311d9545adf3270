"""Mirror symmetry of pre-indentation: one half is solved, the other is its mirror image.

Raising a row of actuators that mirrors about x = 0 against a section that does loads both halves alike, so the right
half answers with C_RR + C_RL M, where M mirrors the forces on the right to the left. Half the unknowns, an eighth of
the work, and the same state.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..scene.contact_law import ContactLaw
from ..tissue.compliance import MIRROR, CondensedBody
from .formulation import ContactProblem, ContactState, Status
from .indentation import indent

ALIKE = 1e-10  # of the largest compliance [1]; source: rounding of a condensation leaves 1e-12
MIRRORED_STATUS = np.array([Status.OPEN, Status.STICK, Status.SLIP_BACKWARD, Status.SLIP_FORWARD])


def indent_by_halves(problem: ContactProblem, law: ContactLaw, increments: int, limit: float) -> ContactState:
    """`indentation.indent`, on the right half alone where the problem mirrors. Raises ContactError."""
    if not mirrors(problem):
        return indent(problem, law, increments, limit)
    return unfolded(indent(fold(problem), law, increments, limit))


def mirrors(problem: ContactProblem) -> bool:
    """Whether nodes and actuators mirror about x = 0, with none of them on it, and bodies each in itself."""
    x = problem.position[:, 0]
    positions = np.asarray(problem.row.positions)
    return bool(
        np.array_equal(problem.position[::-1] * MIRROR, problem.position)
        and np.array_equal(-positions[::-1], positions)
        and np.all(x != 0.0)
        and np.all(positions != 0.0)
        and (problem.body is None or _body_mirrors(problem.body))
    )


def _body_mirrors(body: CondensedBody) -> bool:
    """Whether a body answers mirrored forces with mirrored displacements."""
    count = body.coordinate.size
    answers = body.compliance.reshape(count, 2, count, 2)
    images = answers[::-1, :, ::-1] * MIRROR[:, None, None] * MIRROR
    return bool(np.abs(images - answers).max() <= ALIKE * np.abs(answers).max())


def fold(problem: ContactProblem) -> ContactProblem:
    """The right half's problem, its compliance under loads that mirror."""
    half = problem.position.shape[0] // 2
    of_right = problem.compliance[2 * half :]
    # the left image of right node j is node count - 1 - j; its x and y unknowns keep their order
    of_images = (of_right[:, : 2 * half].reshape(-1, half, 2)[:, ::-1] * MIRROR).reshape(-1, 2 * half)
    return replace(half_of(problem), compliance=of_right[:, 2 * half :] + of_images)


def half_of(problem: ContactProblem) -> ContactProblem:
    """The problem with the right half's nodes and actuators, whatever its compliance."""
    positions = tuple(x for x in problem.row.positions if x > 0.0)
    half = problem.position.shape[0] // 2
    row = replace(problem.row, positions=positions)
    return replace(problem, position=problem.position[half:], row=row, images=2)


def unfolded(state: ContactState) -> ContactState:
    """The whole state of the right half's."""
    return replace(
        state,
        actuator=np.concatenate([state.actuator[::-1] * MIRROR, state.actuator]),
        force=np.concatenate([state.force[::-1] * MIRROR, state.force]),
        status=np.concatenate([MIRRORED_STATUS[state.status[::-1]], state.status]),
        place=np.concatenate([-state.place[::-1], state.place]),
        gap=np.concatenate([state.gap[::-1], state.gap]),
        heading=np.concatenate([state.heading[::-1] * MIRROR, state.heading]),
        drift=np.concatenate([state.drift[::-1] * MIRROR, state.drift]),
        trend=np.concatenate([state.trend[::-1] * MIRROR, state.trend]),
        dissipation=2.0 * state.dissipation,
    )
