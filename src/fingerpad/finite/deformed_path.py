"""Stimuli on tissue that deforms much: paths on the condensed tangent, corrected by what the tissue really bears.

About the pre-indented state u_0 with tangent K, a path on the condensed maps ends with forces f and the displacement
    u' = u + K^-1 (W f - R(u))
of the tissue. Where R(u') is not W f, the contact nodes' displacement without forces, free = W^T (u - K^-1 R(u)), is
another at the end of the path than at its start, and the path is followed again while it moves there, with the square
of the way from u_0, where K is exact, and evenly from elsewhere; without friction the way leaves no trace, and only its
end is found again. So the tissue is in equilibrium wherever a move ends.

Any K leads there, the slower the farther u is from u_0. Where a move that begins elsewhere does not settle soon, the
tissue is linearised anew where it begins, and the moves that follow run on that. One in which a correction overshoots,
into tissue turned inside out or contact that does not converge, is made in two halves. Corrections are accelerated in
the norm of the energy that K gives them: without friction a pressed finger can all but sway freely, and in the norm of
displacements what sways would hide the rest.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..arrays import FloatArray
from ..contact.acceleration import accelerated
from ..contact.formulation import ContactProblem, ContactState
from ..contact.increment import solve_increment
from ..contact.patch import Patch
from ..contact.path import advance, drifting_to, stands
from ..errors import CondensationError, ContactError, ConvergenceError, InvertedError
from ..tissue.compliance import displaced
from ..tissue.factors import Factors, factorise
from .deformation import internal_force, tangent_stiffness
from .deformed import (
    Tangent,
    TissuePart,
    contact_state,
    deformed_state,
    increments_of,
    is_far,
    solver_on,
    tangent_at,
)

MAX_CORRECTIONS = 100  # of one move [1] before new tangents are made on the way; source: these take longer (measured)
# The same [1] of a move that begins elsewhere than where tissue was linearised, before it is linearised there; source:
# fewest seconds of 5, 10, 20 (measured displacements that press and slip)
FEW_CORRECTIONS = 10
# Halvings [1] of a move with a correction that overshoots; source: one suffices on meshes of 0.18 times the sizes
HALVINGS = 2
STEPS_BACK = 6  # halvings [1] of a correction that turns tissue inside out; source: two suffice on 4 times finer mesh
SETTLED = 1e-3  # change of displacement in a correction over that of the move [1]; source: scores hold to 8e-4


@dataclass(frozen=True)
class DeformedTissue:
    """The whole section about the pre-indented state, or where a later move begins.

    part: that section, which is moved as a whole. factors: of its tangent K. compliance: (2m, 2m) of its contact nodes
    [mm per N/mm]. displacement: (size,) [mm].
    """

    part: TissuePart
    factors: Factors
    compliance: FloatArray
    displacement: FloatArray

    @cached_property
    def held(self) -> FloatArray:
        """R(u_0) (n_free,) [N/mm], with which all moves from there begin. Raises InvertedError."""
        return internal_force(self.part.elements, self.displacement)[self.part.elements.free]

    @cached_property
    def back(self) -> FloatArray:
        """-K^-1 R(u_0) (n_free,) [mm]: how far tissue that nothing holds there goes back."""
        return -self.factors.solve(self.held)


@dataclass(frozen=True)
class Equilibrium:
    """Contact and tissue where a move ends, or begins.

    state: of contact. displacement: (size,) of the tissue [mm]. free: (m, 2) displacement of contact nodes without
    contact forces, had the pre-indented tangent held all the way [mm]. tangents: made so far. defect: largest change of
    displacement in the last correction of a move, over the largest displacement in it, or in the last iteration of one
    with new tangents, over the load [1], so far.
    """

    state: ContactState
    displacement: FloatArray
    free: FloatArray
    tangents: int
    defect: float


def deformed_tissue(part: TissuePart, displacement: FloatArray, compliance: FloatArray) -> DeformedTissue:
    """Linearise about a displacement (size,) [mm], where contact nodes have that compliance (2m, 2m) [mm per N/mm].

    Raises CondensationError if the tangent is singular, InvertedError if elements are turned inside out.
    """
    factors = factorise(tangent_stiffness(part.elements, displacement))
    return DeformedTissue(part, factors, compliance, displacement)


def _linearised_there(tissue: DeformedTissue, displacement: FloatArray) -> tuple[DeformedTissue, Tangent]:
    """The tissue about another displacement (size,) [mm], and its tangent there. Raises as `deformed_tissue`."""
    tangent = tangent_at(tissue.part, displacement)
    return DeformedTissue(tissue.part, tangent.factors, tangent.compliance, displacement), tangent


def move(
    tissue: DeformedTissue,
    problem: ContactProblem,
    start: Equilibrium,
    target: FloatArray,
    increments: int,
    patience: int = FEW_CORRECTIONS,
    halvings: int = HALVINGS,
) -> tuple[Equilibrium, DeformedTissue]:
    """Move the actuators in a straight line to `target` (n_actuators, 2) [mm]. Where that leads, and the tissue that
    the next move should begin with.

    problem: condensed about the pre-indented state. Where corrections do not settle, or not within `patience` of them
    if tissue was linearised elsewhere, the move is made again on tissue linearised where it begins; then, where a
    correction overshot, in two halves, `halvings` times over at most; and then with new tangents on the way. Raises
    what `path.advance` raises.
    """
    if stands(start.state.actuator, target):
        return start, tissue
    begins_there = np.array_equal(start.displacement, tissue.displacement)
    failure: Exception
    try:
        most = MAX_CORRECTIONS if begins_there else patience
        reached = _corrected(tissue, problem, start, target, increments, most)
        return _resting(tissue, problem, reached), tissue
    except (_UnsettledError, ContactError) as error:
        failure = error
    tangent = None
    if not begins_there:
        try:
            tissue, tangent = _linearised_there(tissue, start.displacement)
            start = replace(start, tangents=start.tangents + 1)
            reached = _corrected(tissue, problem, start, target, increments, MAX_CORRECTIONS)
            return _resting(tissue, problem, reached), tissue
        except (_UnsettledError, ContactError, CondensationError) as error:
            failure = error
    if isinstance(failure, (ConvergenceError, InvertedError)) and halvings > 0:
        half, fewer = (start.state.actuator + target) / 2.0, -(-increments // 2)
        middle, tissue = move(tissue, problem, start, half, fewer, patience, halvings - 1)
        return move(tissue, problem, middle, target, fewer, patience, halvings - 1)
    return _followed_newly(tissue, problem, start, target, increments, tangent), tissue


def _resting(tissue: DeformedTissue, problem: ContactProblem, reached: Equilibrium) -> Equilibrium:
    """An equilibrium on some tissue, with `free` on the pre-indented tangent."""
    free = on_compliance(problem.compliance, tissue.compliance, reached.free, reached.state.force)
    return replace(reached, free=free)


def on_compliance(new: FloatArray, old: FloatArray, free: FloatArray, force: FloatArray) -> FloatArray:
    """Displacement (m, 2) [mm] of contact nodes without contact forces on a new compliance (2m, 2m) [mm per N/mm], from
    that on the old one: with the forces (m, 2) [N/mm] that act they lie in one place.
    """
    return free if new is old else free + displaced(old - new, force)


class _UnsettledError(Exception):
    """Corrections of a move do not settle."""


def _corrected(
    tissue: DeformedTissue, problem: ContactProblem, start: Equilibrium, target: FloatArray, increments: int, most: int
) -> Equilibrium:
    """`move` on the tissue's tangent alone, with so many corrections at most. Raises _UnsettledError, InvertedError or
    ConvergenceError where a correction overshoots, or another ContactError.
    """
    part, free = tissue.part, tissue.part.elements.free
    problem = replace(problem, compliance=tissue.compliance)
    begins_there = np.array_equal(start.displacement, tissue.displacement)
    power = 2 if begins_there else 1
    steps: list[FloatArray] = []
    ends: list[FloatArray] = []
    loads: list[FloatArray] = []
    before = displacement = start.displacement
    first, state = None, None
    patch: Patch | None = None
    patches: dict[float, Patch] = {}
    for correction in range(most):
        if begins_there and correction == 0:
            held, back = tissue.held, tissue.back
        else:
            displacement, held = _not_inverted(part, before, displacement)
            back = -tissue.factors.solve(held)
        before = displacement
        last = (part.loads.T @ (displacement[free] + back)).reshape(-1, 2)
        first = last if first is None else first
        if state is None or problem.friction > 0.0:
            drifting = drifting_to(last, start.state.actuator, target, power, patches)
            state, patch = advance(replace(problem, free=first), start.state, target, increments, patch, drifting)
        else:
            there = replace(problem, free=last)
            state, patch = advance(there, state, target, 1, patch, solve_increment, drifting=True)
        pushed = part.loads @ state.force.ravel()
        step = back + tissue.factors.solve(pushed)
        reached = displacement[free] + step
        moved = float(np.abs(reached - start.displacement[free]).max())
        # a stimulus that never touches moves nothing
        defect = float(np.abs(step).max()) / moved if moved > 0.0 else 0.0
        if correction > 0:  # the first is no correction, but the move itself
            steps.append(step)
            ends.append(reached)
            loads.append(pushed - held)
        displacement = displacement.copy()
        displacement[free] = accelerated(steps, ends, loads) if steps else reached
        if defect <= SETTLED:
            if is_far(moved, float(np.abs(target - start.state.actuator).max()), float(np.abs(target).max())):
                raise _UnsettledError
            return Equilibrium(
                state=state,
                displacement=displacement,
                free=last,
                tangents=start.tangents,
                defect=max(start.defect, defect),
            )
    raise _UnsettledError


def _not_inverted(
    part: TissuePart, before: FloatArray, displacement: FloatArray, halvings: int = STEPS_BACK
) -> tuple[FloatArray, FloatArray]:
    """A displacement (size,) [mm] and the internal forces (n_free,) [N/mm] there; where a correction overshot into
    tissue turned inside out, half as far from the one before. Raises InvertedError after so many halvings.
    """
    try:
        return displacement, internal_force(part.elements, displacement)[part.elements.free]
    except InvertedError:
        if halvings == 0:
            raise
        return _not_inverted(part, before, (before + displacement) / 2.0, halvings - 1)


def _followed_newly(
    tissue: DeformedTissue,
    problem: ContactProblem,
    start: Equilibrium,
    target: FloatArray,
    increments: int,
    tangent: Tangent | None,
) -> Equilibrium:
    """`move` with a new tangent wherever an increment asks for one; the first may be there."""
    part = tissue.part
    begin, (count, within) = deformed_state(start.state, start.displacement), increments_of(increments)
    reached, _ = advance(problem, begin, target, count, tangent, solver_on(part, within))
    moved = (part.loads.T @ reached.displacement[part.elements.free]).reshape(-1, 2)
    rest = moved - displaced(problem.compliance, reached.force)
    return Equilibrium(
        state=contact_state(reached),
        displacement=reached.displacement,
        free=rest,
        tangents=start.tangents + reached.tangents,
        defect=max(start.defect, reached.change),
    )
