"""Contact of tissue that deforms much: Newton's method around contact on a linearised tissue.

About a displacement u, with tangent K and internal force R(u), the tissue answers contact forces f (nodal forces
L f) by
    u' = u + K^-1 (L f - R(u)),        and its contact nodes by  L^T u' = free + C f,   C = L^T K^-1 L,
which is the condensed problem of `contact` with free = L^T (u - K^-1 R(u)): a path's increment is solved on it, u' is
where the tissue is linearised next, and the increment is solved anew from where it began, until u' = u. An older K
serves as long as it brings u' - u down fast enough: only R(u) is then new.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import SuperLU

from .condensation import factorise, trailing_compliance
from .contact import ContactProblem, ContactState
from .deformation import Elements, internal_force, internal_force_and_tangent
from .errors import CondensationError, InvertedError, SnapError
from .increment import NotConvergedError, Patch, solve_increment
from .path import SolveIncrement
from .scene import FloatArray
from .stability import unstable_directions

MAX_ITERATIONS = 25  # of linearisations within one increment before it is halved [1]; source: usual count is 4-8
LARGEST_CHANGE = 1.0  # of displacement [1] over the load; source: none that came back from further was seen
FARTHEST = 4.0  # way of tissue [1] over that of the actuators in an increment; source: 1 in devices, 3.1 before a snap
FAST = 2.0  # the same [1], beyond which a path that ends is said to snap; source: the way grows there without bound
SLIGHT = 1e-3  # of the load [1], by which tissue may move besides; source: equilibrium where corrected moves end
CONTRACTION = 0.2  # of a change [1] to the one before it, above which a new tangent is made; source: fewest seconds


@dataclass(frozen=True)
class Span:
    """The tissue that is solved: a section, or its right half under loads that mirror.

    elements. loads: (n_free, 2m) nodal forces of unit contact forces, in the order of the tangent, which has the nodes
    that they act on last.
    """

    elements: Elements
    loads: csc_matrix


@dataclass(frozen=True)
class Tangent:
    """Tissue linearised about a displacement.

    factors: of its stiffness. compliance: (2m, 2m) of its contact nodes [mm per N/mm]. residual: of the factorisation
    [1]. patch: that contact was solved on last.
    """

    factors: SuperLU
    compliance: FloatArray
    residual: float
    patch: Patch | None = None


@dataclass(frozen=True)
class DeformedState(ContactState):
    """A converged state of contact and tissue.

    displacement: (size,) of all unknowns [mm]. rate: its change over the way of the actuators in the last increment
    [1]. tangents: made so far. changes: of displacement in the iterations of the last increment, over the load [1].
    """

    displacement: FloatArray
    rate: FloatArray
    tangents: int
    changes: tuple[float, ...] = ()


def deformed(state: ContactState, displacement: FloatArray) -> DeformedState:
    """A state of contact on tissue with a displacement (size,) [mm]."""
    own = {field.name: getattr(state, field.name) for field in fields(ContactState)}
    return DeformedState(**own, displacement=displacement, rate=np.zeros_like(displacement), tangents=0)


def undeformed(state: DeformedState) -> ContactState:
    """The state of contact alone."""
    return ContactState(**{field.name: getattr(state, field.name) for field in fields(ContactState)})


def solver_on(span: Span) -> SolveIncrement[DeformedState]:
    """What solves an increment on that tissue, for a path."""
    return partial(solve_deformed_increment, span)


def solve_deformed_increment(
    span: Span, problem: ContactProblem, start: DeformedState, actuator: FloatArray, tangent: Tangent | None
) -> tuple[DeformedState, Tangent]:
    """The state with the actuators at `actuator` (n_actuators, 2) [mm], and the tangent it was found with.

    problem: of undeformed tissue, whatever its compliance. tangent: one from earlier on this path. Raises
    NotConvergedError.
    """
    length = float(np.abs(actuator - start.actuator).max())
    scale = float(np.abs(actuator).max()) + length
    free, displacement = span.elements.free, start.displacement + length * start.rate
    made, iterations = 0, 0
    changes: list[float] = []
    unstable = float(np.abs(start.rate).max()) > FAST
    try:
        while len(changes) < MAX_ITERATIONS:
            if tangent is None:
                tangent, made = tangent_at(span, displacement), made + 1
                condensed = replace(problem, compliance=tangent.compliance)
                unstable = unstable or _is_unstable(condensed, start, tangent)
            back = -tangent.factors.solve(internal_force(span.elements, displacement)[free])
            rest = (span.loads.T @ (displacement[free] + back)).reshape(-1, 2)
            condensed = replace(problem, compliance=tangent.compliance, free=rest)
            found, patch = solve_increment(condensed, start, actuator, tangent.patch)
            iterations += found.iterations - start.iterations
            tangent = replace(tangent, patch=patch)
            step = back + tangent.factors.solve(span.loads @ found.force.ravel())
            displacement[free] += step
            changes.append(float(np.abs(step).max()) / scale)
            if changes[-1] <= problem.tolerance:
                _require_near(condensed, found, tangent, displacement - start.displacement, length, scale)
                reached = deformed(replace(found, iterations=start.iterations + iterations), displacement)
                rate = (displacement - start.displacement) / length
                return replace(reached, rate=rate, tangents=start.tangents + made, changes=tuple(changes)), tangent
            if not changes[-1] <= LARGEST_CHANGE:
                break
            if len(changes) > 1 and changes[-1] > CONTRACTION * changes[-2]:
                tangent = None
    except InvertedError as error:
        raise NotConvergedError(float("inf"), inverted=str(error)) from error
    except CondensationError as error:
        raise NotConvergedError(float("inf"), snaps=unstable) from error
    except NotConvergedError as failure:
        raise NotConvergedError(failure.residual, failure.turned, snaps=failure.snaps or unstable) from failure
    raise NotConvergedError(changes[-1], snaps=unstable)


def _require_near(
    problem: ContactProblem, found: ContactState, tangent: Tangent, moved: FloatArray, length: float, scale: float
) -> None:
    """Raise NotConvergedError if a state is not one that the path leads to: tissue is unstable there, or has moved
    (size,) [mm] much farther than the actuators, by `length` [mm] under a load of `scale` [mm].
    """
    if is_far(float(np.abs(moved).max()), length, scale) or _is_unstable(problem, found, tangent):
        raise NotConvergedError(found.residual, snaps=True)


def is_far(moved: float, length: float, load: float) -> bool:
    """Whether tissue jumped: it moved [mm] much farther than the actuators, by `length` under a load [mm]."""
    return moved > FARTHEST * length + SLIGHT * load


def _is_unstable(problem: ContactProblem, state: ContactState, tangent: Tangent) -> bool:
    """Whether tissue with that tangent is unstable while contact holds it as in that state."""
    return unstable_directions(problem, state.status, state.place, tangent.factors) > 0


def require_stable(problem: ContactProblem, state: ContactState, tangent: Tangent) -> None:
    """Raise SnapError if tissue with that tangent is unstable while contact holds it as in that state: also against
    movements that a path on half of the section cannot make.
    """
    if _is_unstable(replace(problem, compliance=tangent.compliance), state, tangent):
        raise SnapError("the tissue has no stable state here: another branches off; try less indentation")


def tangent_at(span: Span, displacement: FloatArray) -> Tangent:
    """Linearise about a displacement (size,) [mm]. Raises InvertedError, CondensationError."""
    _, matrix = internal_force_and_tangent(span.elements, displacement)
    factors = factorise(matrix)
    return Tangent(factors, *trailing_compliance(matrix, factors, span.loads))
