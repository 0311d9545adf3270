"""Contact of tissue that deforms much: Newton's method around contact on a linearised tissue.

About a displacement u, with tangent K and internal force R(u), the tissue answers contact forces f (nodal forces L f) by
    u' = u + K^-1 (L f - R(u)),        and its contact nodes by  L^T u' = free + C f,   C = L^T K^-1 L,
which is the condensed problem of `contact` with free = L^T (u - K^-1 R(u)): a path's increment is solved on it, u' is
where the tissue is linearised next, and the increment is solved anew from where it began, until u' = u. An older K
serves as long as it brings u' - u down fast enough: only R(u) is then new.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix
from scipy.sparse.linalg import SuperLU

from .condensation import condense_ordered, factorise
from .contact import ContactProblem, ContactState
from .deformation import Elements, internal_force, internal_force_and_tangent
from .errors import CondensationError, InvertedError
from .increment import NotConvergedError, Patch, solve_increment
from .path import SolveIncrement
from .scene import FloatArray

MAX_ITERATIONS = 25  # of linearisations within one increment before it is halved [1]; source: usual count is 4-8
CONTRACTION = 0.2  # of a change [1] to the one before it, above which a new tangent is made; source: fewest seconds


@dataclass(frozen=True)
class Span:
    """The tissue that is solved: a section, or its right half under loads that mirror.

    elements. loads: (n_free, 2m) nodal forces of unit contact forces, in the order of the tangent.
    """

    elements: Elements
    loads: csc_matrix


@dataclass(frozen=True)
class Tangent:
    """Tissue linearised about a displacement: factors of its stiffness, compliance (2m, 2m) of its contact nodes [mm
    per N/mm], and the patch that contact was solved on last.
    """

    factors: SuperLU
    compliance: FloatArray
    residual: float
    patch: Patch | None = None


@dataclass(frozen=True)
class DeformedState(ContactState):
    """A converged state of contact and tissue. displacement: (size,) of all unknowns [mm]. tangents: made so far."""

    displacement: FloatArray
    rate: FloatArray
    tangents: int
    changes: tuple[float, ...] = ()


def at_rest(span: Span, state: ContactState) -> DeformedState:
    """A state of contact without forces, on undeformed tissue."""
    own = {field.name: getattr(state, field.name) for field in fields(ContactState)}
    return DeformedState(**own, displacement=np.zeros(span.elements.size), rate=np.zeros(span.elements.size), tangents=0)


def tangent_at(span: Span, displacement: FloatArray) -> Tangent:
    """Linearise about a displacement (size,) [mm]. Raises InvertedError, CondensationError."""
    _, matrix = internal_force_and_tangent(span.elements, displacement)
    factors = factorise(matrix)
    compliance, _, residual = condense_ordered(matrix, factors, span.loads, csr_matrix((0, matrix.shape[0])))
    return Tangent(factors, compliance, residual)


def solver_on(span: Span) -> SolveIncrement[DeformedState, Tangent]:
    """What solves an increment on that tissue, for a path."""
    return partial(solve_deformed_increment, span)


def solve_deformed_increment(
    span: Span, problem: ContactProblem, start: DeformedState, actuator: FloatArray, tangent: Tangent | None
) -> tuple[DeformedState, Tangent]:
    """The state with the actuators at `actuator` (n_actuators, 2) [mm], and the tangent it was found with.

    tangent: one from earlier on this path. Raises NotConvergedError.
    """
    length = float(np.abs(actuator - start.actuator).max())
    free, displacement = span.elements.free, start.displacement + length * start.rate
    scale = float(np.abs(actuator).max() + np.abs(actuator - start.actuator).max())
    made, iterations, changes = 0, 0, []
    try:
        while len(changes) < MAX_ITERATIONS:
            if tangent is None:
                tangent, made = tangent_at(span, displacement), made + 1
            back = -tangent.factors.solve(internal_force(span.elements, displacement)[free])
            rest = span.loads.T @ (displacement[free] + back)
            here = replace(problem, compliance=tangent.compliance, free=rest.reshape(-1, 2))
            found, patch = solve_increment(here, start, actuator, tangent.patch)
            tangent = replace(tangent, patch=patch)
            iterations += found.iterations - start.iterations
            step = back + tangent.factors.solve(span.loads @ found.force.ravel())
            displacement[free] += step
            changes.append(float(np.abs(step).max()) / scale)
            if changes[-1] <= problem.tolerance:
                own = {field.name: getattr(found, field.name) for field in fields(ContactState)}
                own["iterations"] = start.iterations + iterations
                return DeformedState(**own, displacement=displacement, rate=(displacement - start.displacement) / length, tangents=start.tangents + made, changes=tuple(changes)), tangent
            if not np.isfinite(changes[-1]) or changes[-1] > 1.0:
                break
            if len(changes) > 1 and changes[-1] > CONTRACTION * changes[-2]:
                tangent = None
    except (InvertedError, CondensationError) as error:
        raise NotConvergedError(float("inf")) from error
    raise NotConvergedError(changes[-1] if changes else float("inf"))
