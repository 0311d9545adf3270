"""Stimuli on tissue that deforms much: paths on the condensed tangent, corrected by what the tissue really bears.

About the pre-indented state u_0 with tangent K, a path on the condensed maps ends with forces f and the displacement
    u' = u + K^-1 (L f - R(u))
of the tissue. Where R(u') is not L f, the contact nodes' displacement without forces, free = L^T (u - K^-1 R(u)), is
another at the end of the path than at its start, and the path is followed anew while it moves there, with the square of
the way from u_0, where K is exact, and evenly from elsewhere. So the tissue is in equilibrium wherever a move ends.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse.linalg import SuperLU

from .condensation import factorise
from .contact import ContactProblem, ContactState
from .deformation import internal_force, internal_force_and_tangent
from .deformed import Span, Tangent, deformed, is_far, solver_on, undeformed
from .errors import ContactError
from .increment import Patch, solve_increment
from .path import advance
from .scene import FloatArray

MAX_CORRECTIONS = 20  # of one move [1] before new tangents are made on the way; source: usual count is 2-12 (measured)
MEMORY = 12  # iterates [1] that are combined; source: fewest corrections of 6, 8, 12
EQUILIBRIUM = (
    1e-3  # change of displacement in a correction over that of the move [1]; source: scores then hold to 0.2 %
)


@dataclass(frozen=True)
class DeformedTissue:
    """The whole section about the pre-indented state: factors of its tangent, and displacement (size,) [mm]."""

    span: Span
    factors: SuperLU
    displacement: FloatArray


@dataclass(frozen=True)
class Move:
    """Where a move ends.

    state: of contact. displacement: (size,) of the tissue [mm]. free: (m, 2) displacement of contact nodes without
    contact forces, had the tangent held all the way [mm]. corrections: so far. tangents: made so far. defect: largest
    change of displacement in the last correction of a move, over the largest displacement in it [1], so far.
    """

    state: ContactState
    displacement: FloatArray
    free: FloatArray
    corrections: int
    tangents: int
    defect: float


def deformed_tissue(span: Span, displacement: FloatArray) -> DeformedTissue:
    """Linearise about a displacement (size,) [mm]. Raises CondensationError."""
    _, matrix = internal_force_and_tangent(span.elements, displacement)
    return DeformedTissue(span, factorise(matrix), displacement)


def move(tissue: DeformedTissue, problem: ContactProblem, start: Move, target: FloatArray, increments: int) -> Move:
    """Move the actuators in a straight line to `target` (n_actuators, 2) [mm].

    problem: condensed about the tissue's displacement. Where corrections do not settle the move is made anew, with new
    tangents. Raises what `path.advance` raises.
    """
    if np.array_equal(target, start.state.actuator):
        return start
    try:
        return _corrected(tissue, problem, start, target, increments)
    except _UnsettledError:
        return _followed_newly(tissue, problem, start, target, increments)


class _UnsettledError(Exception):
    """Corrections of a move do not settle."""


def _corrected(
    tissue: DeformedTissue, problem: ContactProblem, start: Move, target: FloatArray, increments: int
) -> Move:
    """`move` on the tissue's tangent alone. Raises _UnsettledError."""
    span, free = tissue.span, tissue.span.elements.free
    power = 2 if start.displacement is tissue.displacement else 1
    steps: list[FloatArray] = []
    ends: list[FloatArray] = []
    displacement, first = start.displacement, None
    for correction in range(MAX_CORRECTIONS):
        try:
            back = -tissue.factors.solve(internal_force(span.elements, displacement)[free])
            last = (span.loads.T @ (displacement[free] + back)).reshape(-1, 2)
            first = last if first is None else first
            state = _followed(problem, start.state, target, increments, first, last - first, power)
        except ContactError as error:  # an overshoot: tissue turned inside out, or contact without a solution
            raise _UnsettledError from error
        step = back + tissue.factors.solve(span.loads @ state.force.ravel())
        reached = displacement[free] + step
        moved = float(np.abs(reached - start.displacement[free]).max())
        # a stimulus that never touches moves nothing
        defect = float(np.abs(step).max()) / moved if moved > 0.0 else 0.0
        if correction > 0:  # the first is no correction, but the move itself
            steps.append(step)
            ends.append(reached)
        displacement = displacement.copy()
        displacement[free] = reached
        if defect <= EQUILIBRIUM:
            if is_far(moved, float(np.abs(target - start.state.actuator).max()), float(np.abs(target).max())):
                raise _UnsettledError
            defect = max(start.defect, defect)
            return Move(state, displacement, last, start.corrections + correction, start.tangents, defect)
        if len(steps) > 1:
            displacement[free] = accelerated(steps[-MEMORY:], ends[-MEMORY:])
    raise _UnsettledError


def _followed_newly(
    tissue: DeformedTissue, problem: ContactProblem, start: Move, target: FloatArray, increments: int
) -> Move:
    """`move` with a new tangent wherever an increment asks for one."""
    span, free = tissue.span, tissue.span.elements.free
    begin = deformed(start.state, start.displacement)
    tangent = Tangent(tissue.factors, problem.compliance, 0.0)
    reached, _ = advance(problem, begin, target, increments, tangent, solver_on(span))
    moved = (span.loads.T @ reached.displacement[free]).reshape(-1, 2)
    rest = moved - (problem.compliance @ reached.force.ravel()).reshape(-1, 2)
    return Move(
        undeformed(reached),
        reached.displacement,
        rest,
        start.corrections + MAX_CORRECTIONS,
        start.tangents + reached.tangents,
        start.defect,
    )


def accelerated(steps: list[FloatArray], ends: list[FloatArray]) -> FloatArray:
    """Anderson's next iterate of a fixed point, from steps G(u) - u and ends G(u) of the last iterations, oldest first
    (Walker and Ni 2011): the combination of ends whose steps nearly cancel.
    """
    differences = np.stack(steps[1:], axis=1) - np.stack(steps[:-1], axis=1)
    weights = np.linalg.lstsq(differences, steps[-1], rcond=None)[0]
    return np.asarray(ends[-1] - (np.stack(ends[1:], axis=1) - np.stack(ends[:-1], axis=1)) @ weights)


def _followed(
    problem: ContactProblem,
    start: ContactState,
    target: FloatArray,
    increments: int,
    first: FloatArray,
    drift: FloatArray,
    power: int,
) -> ContactState:
    """State at the end of a move along which contact nodes without forces drift from `first` by `drift` (m, 2) [mm]."""
    length = float(np.abs(target - start.actuator).max())

    def solve(
        problem: ContactProblem, state: ContactState, actuator: FloatArray, patch: Patch | None
    ) -> tuple[ContactState, Patch]:
        way = float(np.abs(actuator - start.actuator).max()) / length
        return solve_increment(replace(problem, free=first + way**power * drift), state, actuator, patch)

    return advance(problem, start, target, increments, None, solve)[0]
