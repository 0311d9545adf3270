"""CalculiX's contact law on the condensed compliance: penalties, and a normal that turns with the rounded edge.

It tells apart why another program's answer differs from `contact`: which part comes of its penalties, which of the
turning normal (docs/decisions/0002), and what is left. It is no second way to solve a condition.

With the skin point q = X + C f - (actuator position), its gap g along the profile's own normal n, its arc length s
along the profile, and the weight w of the node:
    N = k_n w max(-g, 0)                                         pressing force
    T = -k_t w (s - s_0), held within |T| <= mu N                shearing force; s_0 follows when it slips
    f = N n + T t,    q - (X - actuator position) - C f(q) = 0   solved by Newton's method for q.
CalculiX takes for s_0 of a node that comes to touch where it lay unloaded. All that has slid until then is slip, so the
node bears friction in full from its first increment in contact on. That leaves a trace as large as the pressure at the
end of it, which fades with more increments.
Source: G. Dhondt, CalculiX manual, face-to-face penalty contact, and its source (springforc_f2f); here node by node.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import ContactProblem
from ..contact.not_converged import NotConvergedError
from ..contact.path import SolveIncrement, advance
from ..errors import ContactError
from ..scene.device import ActuatorRow

MAX_HALVINGS = 8  # of a Newton step [1]; source: chosen, as what needs more is halved as an increment
TOLERANCE = 1e-10  # mm of residual displacement; source: 1e-6 of the smallest penetration that matters


@dataclass(frozen=True)
class PenaltyLaw:
    """Slopes [MPa/mm] of pressure over penetration and of shear over elastic slip, and friction coefficient [1]."""

    pressure_slope: float
    stick_slope: float
    friction: float


@dataclass(frozen=True)
class PenaltyState:
    """A solved state: actuator (n_actuators, 2) [mm], force on the skin (n, 2) [N/mm], position (n, 2) of the skin in
    its actuator's frame [mm], and arc length (n,) of the profile at which its shear vanishes, or would [mm]. cuts:
    increments halved so far.
    """

    actuator: FloatArray
    force: FloatArray
    position: FloatArray
    origin: FloatArray
    cuts: int = 0


@dataclass(frozen=True)
class _Surface:
    """What nodes (n,) see of the profile: gap [mm], arc length [mm], normal and tangent (n, 2), curvature of the
    normal [1/mm] and arc length per tangential motion [1]."""

    gap: FloatArray
    arc: FloatArray
    normal: FloatArray
    tangent: FloatArray
    turning: FloatArray
    rate: FloatArray


def untouched(problem: ContactProblem) -> PenaltyState:
    """The unloaded state with all faces at the height of the pad's lowest point.

    Raises ContactError for deformable actuators, and for sharp edges: a node that slips off one would lose its force at
    a stroke, and there is no normal that turns.
    """
    if problem.body is not None or problem.row.edge_radius == 0.0:
        raise ContactError("the penalty law with a turning normal is for rigid actuators with rounded edges")
    centre = np.asarray(problem.row.positions)[problem.actuator_of]
    position = problem.position - np.stack([centre, np.zeros_like(centre)], axis=1)
    arc = _surface(problem.row, position).arc
    return PenaltyState(np.zeros((len(problem.row.positions), 2)), np.zeros_like(position), position, arc)


def follow_penalties(
    problem: ContactProblem,
    weight: FloatArray,
    law: PenaltyLaw,
    state: PenaltyState,
    target: FloatArray,
    increments: int,
) -> PenaltyState:
    """`path.follow` by the penalty law.

    weight: (n,) length of skin of each node [mm]. Raises ConvergenceError.
    """
    solve: SolveIncrement[PenaltyState, None] = partial(_increment, weight, law)
    return advance(problem, state, target, increments, None, solve)[0]


def _increment(
    weight: FloatArray,
    law: PenaltyLaw,
    problem: ContactProblem,
    start: PenaltyState,
    actuator: FloatArray,
    carried: None,
) -> tuple[PenaltyState, None]:
    """The state after one increment, which leaves nothing to use again. Raises NotConvergedError."""
    first = untouched(problem)
    unloaded = first.position - actuator[problem.actuator_of]
    count = weight.size
    by_node = problem.compliance.reshape(2 * count, count, 2)
    position = start.position
    force, tangent, origin = _forces(problem.row, weight, law, position, start.origin)
    residual = (position - unloaded).ravel() - problem.compliance @ force.ravel()
    for _ in range(problem.most_iterations):
        moved = np.einsum("anc,ncd->and", by_node, tangent).reshape(2 * count, 2 * count)
        try:
            step = np.linalg.solve(np.eye(2 * count) - moved, -residual).reshape(count, 2)
        except np.linalg.LinAlgError:
            break
        before, size = position, np.linalg.norm(residual)
        for halvings in range(MAX_HALVINGS + 1):
            position = before + step / 2.0**halvings
            force, tangent, origin = _forces(problem.row, weight, law, position, start.origin)
            residual = (position - unloaded).ravel() - problem.compliance @ force.ravel()
            if np.linalg.norm(residual) < size:
                break
        if np.abs(residual).max() < TOLERANCE:
            origin = np.where(_surface(problem.row, position).gap < 0.0, origin, first.origin)
            return PenaltyState(actuator, force, position, origin, start.cuts), None
    raise NotConvergedError(float(np.abs(residual).max()))


def _surface(row: ActuatorRow, position: FloatArray) -> _Surface:
    """The profile seen from positions (n, 2) [mm] in the actuator's frame: flat face, then the edges' circles."""
    radius = row.edge_radius
    flat = row.width / 2.0 - radius
    x, y = position.T
    side = np.sign(x)
    beyond = np.maximum(np.abs(x) - flat, 0.0)
    on_edge = beyond > 0.0
    distance = np.where(on_edge, np.hypot(beyond, y + radius), 1.0)  # from an edge's centre, where there is one
    normal = np.stack([side * beyond / distance, np.where(on_edge, (y + radius) / distance, 1.0)], axis=1)
    return _Surface(
        gap=np.where(on_edge, distance - radius, y),
        arc=np.where(on_edge, side * (flat + radius * np.arctan2(beyond, y + radius)), x),
        normal=normal,
        tangent=np.stack([normal[:, 1], -normal[:, 0]], axis=1),
        turning=np.where(on_edge, 1.0 / distance, 0.0),
        rate=np.where(on_edge, radius / distance, 1.0),
    )


def _forces(
    row: ActuatorRow, weight: FloatArray, law: PenaltyLaw, position: FloatArray, origin: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Forces (n, 2) [N/mm], their derivative by position (n, 2, 2), and the new origins of shear (n,)."""
    seen = _surface(row, position)
    n, t = seen.normal, seen.tangent
    touching = seen.gap < 0.0
    stiff, shear = law.pressure_slope * weight * touching, law.stick_slope * weight * touching
    if law.friction == 0.0:
        shear = np.zeros_like(shear)
    pressing = -stiff * seen.gap
    trial = -shear * (seen.arc - origin)
    limit = law.friction * pressing
    slipping = np.abs(trial) > limit
    shearing = np.clip(trial, -limit, limit)
    pressing_rate = -stiff[:, None] * n
    shearing_rate = np.where(
        slipping[:, None],
        (np.sign(trial) * law.friction)[:, None] * pressing_rate,
        (-shear * seen.rate)[:, None] * t,
    )
    # the normal turns by dn = t (t dq) / distance, and the tangent by dt = -n (t dq) / distance
    turned = pressing[:, None] * t - shearing[:, None] * n
    turning = seen.turning[:, None, None] * turned[:, :, None] * t[:, None, :]
    derivative = n[:, :, None] * pressing_rate[:, None, :] + t[:, :, None] * shearing_rate[:, None, :] + turning
    stuck = touching & (law.friction > 0.0)
    elastic = np.divide(shearing, shear, out=np.zeros_like(shear), where=shear > 0.0)
    following = np.where(stuck, np.where(slipping, seen.arc + elastic, origin), seen.arc)
    return pressing[:, None] * n + shearing[:, None] * t, derivative, following
