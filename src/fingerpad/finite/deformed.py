"""Contact of tissue that deforms much: Newton's method around contact on a linearised tissue.

About a displacement u, with tangent K and internal force R(u), the tissue answers contact forces f (nodal forces
W f) by
    u' = u + K^-1 (W f - R(u)),        and its contact nodes by  W^T u' = free + C f,   C = W^T K^-1 W,
which is the condensed problem of `contact` with free = W^T (u - K^-1 R(u)): a path is followed on it, u' is where the
tissue is linearised next, and the path is followed again from its start, until u' = u. An older K serves as long as
Anderson's acceleration brings u' - u down fast enough with it: only R(u) is then new.

Friction needs shorter increments than tissue does, so one increment of the tissue holds several of contact. On the way
free = W^T u - C f drifts from what it is at the start to what R(u) says at the end.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix

from ..arrays import FloatArray
from ..contact.acceleration import accelerated
from ..contact.formulation import ContactProblem, ContactState
from ..contact.increment import solve_increment
from ..contact.not_converged import NotConvergedError
from ..contact.ownership import given_as
from ..contact.patch import Patch
from ..contact.path import SolveIncrement
from ..contact.stability import unstable_directions
from ..errors import CondensationError, ContactError, InvertedError, SnapError
from ..tissue.compliance import displaced
from ..tissue.condensation import condense_ordered
from ..tissue.factors import Factors
from .deformation import Elements, internal_force, tangent_stiffness

MAX_ITERATIONS = 25  # of linearisations within one increment before it is halved [1]; source: usual count is 4-8
LARGEST_CHANGE = 1.0  # of displacement [1] over the load; source: none that came back from further was seen
FARTHEST = 4.0  # way of tissue [1] over that of the actuators in an increment; source: 1 in devices, 3.1 before a snap
# Way of tissue [1] over that of the actuators in the last increment that converged: where it is more, and the next one
# does not converge, tissue is said to snap; source: before a snap the way grows without bound
FAST = 2.0
SLIGHT = 1e-3  # of the load [1], by which tissue may move besides; source: equilibrium where corrected moves end
LOOSER = 1e3  # times [1] the tolerance of contact, to which tissue settles; source: scores then hold to 3e-6 (measured)
CONTRACTION = 0.4  # of a change [1] to the one before it, above which a new tangent is made; source: fewest seconds
CONTACT_INCREMENTS = 4  # in one of the tissue [1], at most; source: scores move by 0.15 of their errors at most
TANGENT_TOLERANCE = 1e-8  # of displacements [1]; source: a soft mode magnifies rounding; Newton corrects the rest
TISSUE_INCREMENTS = 5  # of the tissue [1], fewer only where contact has fewer; source: fewer are halved too often
LESS = "try less indentation, less movement"
WOULD_SNAP = f"the tissue has no stable state nearby and would snap; {LESS}"


@dataclass(frozen=True)
class TissuePart:
    """The tissue that is solved: a section, or its right half under loads that mirror.

    elements. loads: (n_free, 2m) nodal forces of unit contact forces, in the order of the tangent.
    """

    elements: Elements
    loads: csc_matrix


@dataclass(frozen=True)
class Tangent:
    """Tissue linearised about a displacement.

    factors: of its stiffness. compliance: (2m, 2m) of its contact nodes [mm per N/mm]. residual: of the factorisation,
    or how far displacements are off [1]. patch: that contact was solved on last.
    """

    factors: Factors
    compliance: FloatArray
    residual: float
    patch: Patch | None = None


@dataclass(frozen=True)
class Passed:
    """Contact on the way to a state: how far before it [mm], and displacement [mm] and forces [N/mm] of contact nodes,
    both (n, 2).
    """

    before: float
    moved: FloatArray
    force: FloatArray


@dataclass(frozen=True)
class DeformedState(ContactState):
    """A converged state of contact and tissue.

    displacement: (size,) of all unknowns [mm]. rate: its change over the way of the actuators in the last increment
    [1]. passed: contact one of its increments ago, if there was one. tangents: made so far. change: of displacement in
    the last iteration of the last increment, over the load [1].
    """

    displacement: FloatArray
    rate: FloatArray
    passed: Passed | None
    tangents: int
    change: float = 0.0


def deformed_state(state: ContactState, displacement: FloatArray) -> DeformedState:
    """A state of contact on tissue with a displacement (size,) [mm]."""
    own = {field.name: getattr(state, field.name) for field in fields(ContactState)}
    return DeformedState(**own, displacement=displacement, rate=np.zeros_like(displacement), passed=None, tangents=0)


def contact_state(state: DeformedState) -> ContactState:
    """The state of contact alone."""
    return ContactState(**{field.name: getattr(state, field.name) for field in fields(ContactState)})


def increments_of(count: int) -> tuple[int, int]:
    """Increments of the tissue on a way that contact takes in `count`, and those of contact in each.

    >>> increments_of(20), increments_of(14), increments_of(4)
    ((5, 4), (5, 3), (4, 1))
    """
    tissue = max(-(-count // CONTACT_INCREMENTS), min(count, TISSUE_INCREMENTS))
    return tissue, -(-count // tissue)


def solver_on(part: TissuePart, increments: int) -> SolveIncrement[DeformedState, Tangent | None]:
    """What solves an increment on that tissue, for a path, in so many of contact."""
    return partial(solve_deformed_increment, part, increments)


def solve_deformed_increment(
    part: TissuePart,
    increments: int,
    problem: ContactProblem,
    start: DeformedState,
    actuator: FloatArray,
    tangent: Tangent | None,
) -> tuple[DeformedState, Tangent]:
    """The state with the actuators at `actuator` (n_actuators, 2) [mm], and the tangent it was found with.

    increments: of contact. problem: of undeformed tissue, whatever its compliance. tangent: one from earlier on this
    path. Raises NotConvergedError.
    """
    length = float(np.abs(actuator - start.actuator).max())
    scale = float(np.abs(actuator).max()) + length
    free, displacement = part.elements.free, start.displacement + length * start.rate
    made, iterations = 0, start.iterations
    changes: list[float] = []
    steps: list[FloatArray] = []
    ends: list[FloatArray] = []
    unstable = float(np.abs(start.rate).max()) > FAST
    try:
        while len(changes) < MAX_ITERATIONS:
            if tangent is None:
                tangent, made = tangent_at(part, displacement), made + 1
                steps, ends = [], []
                unstable = unstable or _is_unstable(problem, start, tangent)
            step, found, passed, tangent = _linearised_step(
                part, increments, problem, tangent, start, actuator, displacement
            )
            iterations += found.iterations - start.iterations
            displacement[free] += step
            changes.append(float(np.abs(step).max()) / scale)
            if changes[-1] <= LOOSER * problem.tolerance:
                _require_near(problem, found, tangent, displacement - start.displacement, length, scale)
                reached = replace(
                    deformed_state(replace(found, iterations=iterations), displacement),
                    rate=(displacement - start.displacement) / length,
                    passed=passed,
                    tangents=start.tangents + made,
                    change=changes[-1],
                )
                return reached, tangent
            if not changes[-1] <= LARGEST_CHANGE:
                break
            if len(changes) > 1 and changes[-1] > CONTRACTION * changes[-2]:
                tangent = None
                continue
            steps.append(step)
            ends.append(displacement[free])
            displacement[free] = accelerated(steps, ends)
    except InvertedError as error:
        raise NotConvergedError(float("inf"), _why(unstable, InvertedError(f"{error}; {LESS}"))) from error
    except CondensationError as error:
        raise NotConvergedError(float("inf"), _why(unstable)) from error
    except NotConvergedError as failure:
        raise NotConvergedError(failure.residual, _why(unstable, failure.reason)) from failure
    raise NotConvergedError(changes[-1] / LOOSER, _why(unstable))  # as it compares with the tolerance of contact


def _why(unstable: bool, otherwise: ContactError | None = None) -> ContactError | None:
    """Why an increment failed: tissue that is unstable on the way overshoots, and may be turned inside out by that."""
    return SnapError(WOULD_SNAP) if unstable else otherwise


def _linearised_step(
    part: TissuePart,
    increments: int,
    problem: ContactProblem,
    tangent: Tangent,
    start: DeformedState,
    actuator: FloatArray,
    displacement: FloatArray,
) -> tuple[FloatArray, ContactState, Passed, Tangent]:
    """Step (n_free,) [mm] from a displacement (size,) [mm] to equilibrium on a tangent, contact there and what it
    passed before, and the tangent with its last patch. Raises NotConvergedError, InvertedError.
    """
    free = part.elements.free
    back = -tangent.factors.solve(internal_force(part.elements, displacement)[free])
    first, last = (
        (part.loads.T @ each).reshape(-1, 2) for each in (start.displacement[free], displacement[free] + back)
    )
    found, passed, tangent = _followed(increments, problem, tangent, start, actuator, first, last)
    return back + tangent.factors.solve(part.loads @ found.force.ravel()), found, passed, tangent


def _require_near(
    problem: ContactProblem, found: ContactState, tangent: Tangent, moved: FloatArray, length: float, scale: float
) -> None:
    """Raise NotConvergedError if a state is not one that the path leads to: tissue is unstable there, or has moved
    (size,) [mm] much farther than the actuators, by `length` [mm] under a load of `scale` [mm].
    """
    if is_far(float(np.abs(moved).max()), length, scale) or _is_unstable(problem, found, tangent):
        raise NotConvergedError(found.residual, _why(unstable=True))


def is_far(moved: float, length: float, load: float) -> bool:
    """Whether tissue jumped: it moved [mm] much farther than the actuators, by `length` under a load [mm]."""
    return moved > FARTHEST * length + SLIGHT * load


def _is_unstable(problem: ContactProblem, state: ContactState, tangent: Tangent) -> bool:
    """Whether tissue with that tangent is unstable while contact holds it as in that state."""
    condensed = given_as(replace(problem, compliance=tangent.compliance), state)
    return unstable_directions(condensed, state.status, state.place, tangent.factors) > 0


def require_stable(problem: ContactProblem, state: ContactState, tangent: Tangent) -> None:
    """Raise SnapError if tissue with that tangent is unstable while contact holds it as in that state: also against
    movements that a path on half of the section cannot make.
    """
    if _is_unstable(problem, state, tangent):
        raise SnapError("the tissue has no stable state here: another branches off; try less indentation")


def tangent_at(part: TissuePart, displacement: FloatArray) -> Tangent:
    """Linearise about a displacement (size,) [mm]. Raises InvertedError, CondensationError."""
    matrix = tangent_stiffness(part.elements, displacement)
    found = condense_ordered(matrix, part.loads, csr_matrix((0, matrix.shape[0])), TANGENT_TOLERANCE)
    return Tangent(found.factors, found.compliance, max(found.residual, found.off))


def _followed(
    increments: int,
    problem: ContactProblem,
    tangent: Tangent,
    start: DeformedState,
    actuator: FloatArray,
    first: FloatArray,
    last: FloatArray,
) -> tuple[ContactState, Passed, Tangent]:
    """Contact at the end of an increment of the tissue, what it passed before, and the tangent with its last patch.

    first: (n, 2) displacement of contact nodes at the start [mm]. last: (n, 2) that without contact forces at the end
    [mm]. On the way the latter lies on a parabola through what it was before, at the start, and is at the end. Raises
    NotConvergedError.
    """
    length = float(np.abs(actuator - start.actuator).max())
    here = Passed(0.0, first, start.force)
    known = [here] if start.passed is None else [start.passed, here]
    free = [each.moved - displaced(tangent.compliance, each.force) for each in known]
    drift = partial(_through, np.array([*(-each.before for each in known), length]), np.array([*free, last]))
    condensed = replace(problem, compliance=tangent.compliance)
    state: ContactState = start
    patch, passed = tangent.patch, here
    for way in np.linspace(0.0, length, increments + 1)[1:]:
        passed = replace(here, before=length / increments)
        target = start.actuator + way / length * (actuator - start.actuator)
        state, patch = solve_increment(replace(condensed, free=drift(way)), state, target, patch)
        here = Passed(0.0, drift(way) + displaced(tangent.compliance, state.force), state.force)
    return state, passed, replace(tangent, patch=patch)


def _through(places: FloatArray, values: FloatArray, place: float) -> FloatArray:
    """Lagrange's polynomial through values (k, n, 2) at some places (k,), at a place. Importing scipy.interpolate for
    it would take each job longer than all else that it does with it.
    """
    others = ~np.eye(places.size, dtype=bool)
    weights = [np.prod((place - places[each]) / (own - places[each])) for own, each in zip(places, others, strict=True)]
    return np.tensordot(weights, values, axes=1)
