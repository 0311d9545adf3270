"""Unilateral frictional contact with finite sliding, on the condensed compliance.

Unknowns are the nodal forces of the actuators on the skin, f (n, 2) [N per mm of thickness]. The skin's contact nodes
move by C f, and where a node then *is* relative to its actuator decides gap and slip (finite sliding):
    q = X + C f - (actuator position),    gap g = q_y + d(q_x),    pressing force f_y,    shearing force f_x,
    0 <= f_y  complementary to  g >= 0                                                   (unilateral contact)
    |f_x| <= mu f_y,  and the skin slides (q_x leaves its reference) only against f_x = -+ mu f_y      (Coulomb)
with d the actuator's profile and the reference of q_x its value at the end of the last increment, or where the node
touched (backward Euler in slip). The force is resolved along the face, also on the rounded edges: their slope shapes
the gap, as in Hertz's theory (docs/decisions/0002).

Each increment is solved by a semismooth Newton method in the form of a primal-dual active set: every node is open,
sticks or slips; the linearised equations of that state are solved; forces and gaps then decide the next state
(Alart and Curnier 1991; Christensen et al. 1998; Hueeber and Wohlmuth 2005). If that does not settle, steps are
damped by a line search and one node at a time changes state. An increment that does not converge is halved.
A deformable actuator adds the compliance of its face, at the points where the skin now touches it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property

import numpy as np

from .compliance import CondensedBody
from .errors import ContactError
from .profile import profile
from .scene import ActuatorRow, Criterion, FloatArray

MAX_ITERATIONS = 60  # of Newton within one increment before it is halved [1]; source: usual count is 2-6 (measured)
SIMULTANEOUS = 12  # iterations in which all nodes may change state at once [1]; after that, the worst one alone
MAX_HALVINGS = 5  # of a Newton step in the line search [1]; source: 1/32 is below any step that was ever needed
SETTLED = 1e-6  # relative residual [1] below which forces are good enough to judge a single node's state
END_TOLERANCE = 1e-4  # mm of face or gap that may be missing when pre-indentation ends; source: 1e-4 of the indentation
END_STEP = 1e-4  # mm to which the height is located at which it ends; source: 1e-4 of the indentation
CAUTION = 0.2  # share [1] of an increment below which its promise is trusted; source: overshoot is then below 1e-4 mm


Blocks = tuple[FloatArray, FloatArray, FloatArray, FloatArray]  # compliance by components xx, xy, yx, yy


class Status(IntEnum):
    """State of a contact node. SLIP_FORWARD: the skin slides towards +x on the actuator."""

    OPEN = 0
    STICK = 1
    SLIP_FORWARD = 2
    SLIP_BACKWARD = 3


class _NotConvergedError(Exception):
    """An increment did not converge: it is to be halved."""

    def __init__(self, residual: float) -> None:
        super().__init__(residual)
        self.residual = residual


SLIP_SIGN = np.array([0.0, 0.0, 1.0, -1.0])  # direction of slip by Status


@dataclass(frozen=True)
class ContactProblem:
    """What does not change along a path.

    position: (n, 2) undeformed contact nodes [mm]. compliance: (2n, 2n) [mm per N/mm], ordered x0, y0, ...
    row: the actuators. body: condensed body of a deformable actuator, or None. friction: coefficient [1].
    tolerance: relative, on forces and gaps. max_cuts: halvings of an increment.
    """

    position: FloatArray
    compliance: FloatArray
    row: ActuatorRow
    body: CondensedBody | None
    friction: float
    tolerance: float
    max_cuts: int

    @cached_property
    def blocks(self) -> Blocks:
        """The compliance by components xx, xy, yx, yy, each (n, n) [mm per N/mm] and contiguous."""
        x, y = slice(0, None, 2), slice(1, None, 2)
        xx, xy, yx, yy = (np.ascontiguousarray(self.compliance[rows, columns]) for rows in (x, y) for columns in (x, y))
        return xx, xy, yx, yy

    def actuator_of(self) -> np.ndarray:
        """Index (n,) of the actuator nearest to each undeformed node: the only one that it can touch."""
        return np.asarray(np.argmin(np.abs(self.position[:, [0]] - np.asarray(self.row.positions)), axis=1))


@dataclass(frozen=True)
class ContactState:
    """A converged state.

    actuator: (n_actuators, 2) displacement from the row's position [mm]. force: (n, 2) on the skin [N/mm].
    status: (n,) Status. place: (n,) x of each node from its actuator's centre [mm]. gap: (n,) [mm].
    drift: (n, 2) change of place and gap in the last increment per length of its load [1]. dissipation: frictional
    work so far [N mm per mm]. residual: of the contact equations, relative, the largest so far [1]. iterations, cuts:
    Newton iterations and halved increments so far.
    """

    actuator: FloatArray
    force: FloatArray
    status: np.ndarray
    place: FloatArray
    gap: FloatArray
    drift: FloatArray
    dissipation: float
    residual: float
    iterations: int
    cuts: int


@dataclass(frozen=True)
class _Increment:
    """One increment to be solved: load, compliance at its start, slip references and scales."""

    problem: ContactProblem
    xx: FloatArray
    xy: FloatArray
    yx: FloatArray
    yy: FloatArray
    origin: FloatArray
    reference: FloatArray
    gap_scale: float


@dataclass(frozen=True)
class _Trial:
    """Forces (n, 2), the places (n,), heights above the face (n,), gaps (n,) and profile slopes (n,) they lead to."""

    force: FloatArray
    place: FloatArray
    height: FloatArray
    gap: FloatArray
    slope: FloatArray


def touching_height(problem: ContactProblem) -> float:
    """Height [mm] to which the actuators rise until the first skin node touches."""
    x = problem.position[:, 0] - np.asarray(problem.row.positions)[problem.actuator_of()]
    return float(np.min(problem.position[:, 1] + profile(problem.row, x)[0]))


def rest(problem: ContactProblem, height: float) -> ContactState:
    """The unloaded state with all actuators at `height` [mm] and nothing pressed yet."""
    count = problem.position.shape[0]
    actuator = np.zeros((len(problem.row.positions), 2))
    actuator[:, 1] = height
    x = problem.position[:, 0] - np.asarray(problem.row.positions)[problem.actuator_of()]
    gap = problem.position[:, 1] + profile(problem.row, x)[0] - height
    status = np.full(count, Status.OPEN)
    return ContactState(actuator, np.zeros((count, 2)), status, x, gap, np.zeros((count, 2)), 0.0, 0.0, 0, 0)


def follow(problem: ContactProblem, state: ContactState, target: FloatArray, increments: int) -> ContactState:
    """Move the actuators in a straight line to `target` (n_actuators, 2) [mm] in equal increments, cut where needed.

    Raises ContactError if an increment does not converge after problem.max_cuts halvings.
    """
    start = state.actuator
    if np.array_equal(start, target):
        return state
    done, step = 0.0, 1.0 / increments
    smallest = step / 2.0**problem.max_cuts
    while done < 1.0:
        goal = 1.0 if done + step > 1.0 - smallest / 2.0 else done + step
        try:
            state, done = _solve_increment(problem, state, start + goal * (target - start)), goal
            step = min(2.0 * step, 1.0 / increments)
        except _NotConvergedError as failure:
            step /= 2.0
            state = replace(state, cuts=state.cuts + 1)
            if step < smallest:
                raise ContactError(
                    f"contact did not converge: {done:.1%} of the way from {_located(start)} to {_located(target)} mm,"
                    f" increment {int(done * increments) + 1}/{increments} halved {problem.max_cuts} times, residual"
                    f" {failure.residual:.1e} > {problem.tolerance:.0e}; try more increments or a finer mesh at the"
                    " actuators' edges"
                ) from failure
    return state


def switch_friction(state: ContactState) -> ContactState:
    """A frictionless state on which friction acts from now on: what touches sticks, and bears no shear yet."""
    return replace(state, status=np.where(state.status == Status.OPEN, Status.OPEN, Status.STICK))


def indent(problem: ContactProblem, criterion: Criterion, increments: int, limit: float) -> ContactState:
    """Raise all actuators together until the criterion holds.

    FULL: contact reaches both ends of every flat face. TOUCH: every actuator carries some skin. increments: number for
    the way from first touch to where the undeformed skin over the outermost face would lie. limit: largest
    indentation [mm].

    Raises ContactError if the criterion is not met within the limit.
    """
    touch = touching_height(problem)
    state = rest(problem, touch)
    over_face = np.abs(state.place) <= problem.row.half_face
    stride = (float(problem.position[over_face, 1].max()) - touch) / increments
    missing, rate = _missing(problem, state, criterion), 0.0
    while missing > END_TOLERANCE:
        # near the end go only as far as the last increment promises, and a little less while that is far
        promised = missing / rate if rate > 0.0 else stride
        step = min(stride, promised if promised < CAUTION * stride else (1.0 - CAUTION) * promised)
        height = float(state.actuator[0, 1]) + step
        if height - touch > limit:
            raise ContactError(
                f"pre-indentation did not reach '{criterion}' contact within {limit:g} mm:"
                f" {missing:.3g} mm are missing at {height - step - touch:.3g} mm"
            )
        target = state.actuator.copy()
        target[:, 1] = height
        advanced = follow(problem, state, target, 1)
        left = _missing(problem, advanced, criterion)
        if left <= END_TOLERANCE and step > END_STEP:
            stride = step / 2.0  # somewhere on the way it was met: go back and look closer
            continue
        rate = (missing - left) / step if np.isfinite(missing) else 0.0
        state, missing = advanced, left
    return state


def _missing(problem: ContactProblem, state: ContactState, criterion: Criterion) -> float:
    """What the criterion still waits for [mm]: face that is not covered, or gap that is not closed."""
    index = problem.actuator_of()
    actuators = [np.flatnonzero(index == number) for number in range(len(problem.row.positions))]
    if criterion is Criterion.TOUCH:
        return max(
            0.0 if np.any(state.status[nodes] != Status.OPEN) else float(state.gap[nodes].min()) for nodes in actuators
        )
    height = state.gap - profile(problem.row, state.place)[0]
    covered = min(
        _front(direction * state.place[nodes], height[nodes], state.status[nodes] != Status.OPEN)
        for nodes in actuators
        for direction in (1.0, -1.0)
    )
    return max(problem.row.half_face - covered, 0.0)


def _front(place: FloatArray, height: FloatArray, active: np.ndarray) -> float:
    """Place [mm] up to which one actuator's skin is in contact in the direction of ascending place.

    Where skin leaves a flat face its height grows with distance to the power 3/2 (Hertz), so the front is where
    height^(2/3) of the first two open nodes extrapolates to zero: smooth in the load, though nodes close one by one.
    """
    order = np.argsort(place)
    place, height, active = place[order], np.maximum(height[order], 0.0) ** (2.0 / 3.0), active[order]
    if not active.any():
        return float("-inf")  # not even touched
    last = int(np.flatnonzero(active)[-1])
    if last + 2 >= place.size or height[last + 2] <= height[last + 1]:
        return float(place[min(last + 1, place.size - 1)])
    beyond = (place[last + 2] - place[last + 1]) * height[last + 1] / (height[last + 2] - height[last + 1])
    return float(max(place[last + 1] - beyond, place[last]))


def face_shape(body: CondensedBody, at: FloatArray) -> FloatArray:
    """Second-order shape functions (n, k) of a face's k nodes at coordinates (n,) [mm], held at its ends beyond."""
    nodes = body.coordinate
    at = np.clip(at, nodes[0], nodes[-1])
    cell = np.clip(np.searchsorted(nodes[::2], at, side="right") - 1, 0, nodes.size // 2 - 1)
    left, right = nodes[2 * cell], nodes[2 * cell + 2]
    local = (at - left) / (right - left)
    shape = np.zeros((at.size, nodes.size))
    every = np.arange(at.size)
    shape[every, 2 * cell] = (1.0 - local) * (1.0 - 2.0 * local)
    shape[every, 2 * cell + 1] = 4.0 * local * (1.0 - local)
    shape[every, 2 * cell + 2] = local * (2.0 * local - 1.0)
    return shape


def _located(actuator: FloatArray) -> str:
    """Where the actuators stand, in few words: (x, y) of the first."""
    return f"({actuator[0, 0]:.4g}, {actuator[0, 1]:.4g})"


def _solve_increment(problem: ContactProblem, start: ContactState, actuator: FloatArray) -> ContactState:
    """One increment of the path by semismooth Newton. Raises _NotConvergedError."""
    increment = _set_up(problem, start, actuator)
    trial = _at(increment, start.force)
    length = float(np.abs(actuator - start.actuator).max())
    # the last increment tells better than the load which nodes will touch; at the very first, the load must
    foreseen = start.gap + start.drift[:, 1] * length if start.drift.any() else trial.gap
    status = np.where((start.status == Status.OPEN) & (foreseen < 0.0), _touched(problem), start.status)
    released = np.zeros(status.shape, dtype=bool)
    residual = float("inf")
    for iteration in range(MAX_ITERATIONS):
        step = _newton_step(increment, trial, status)
        if step is None:
            break
        settling = iteration >= SIMULTANEOUS
        trial = _searched(increment, trial, step, status) if settling else _at(increment, step)
        following = _next_status(increment, trial, status, released)
        changed = np.flatnonzero(following != status)
        residual = float(np.abs(_residuals(increment, trial, status)).max(initial=0.0))
        if changed.size == 0:
            if residual <= problem.tolerance:
                return _accept(increment, start, trial, status, actuator, residual, iteration + 1)
        elif settling:
            if residual > SETTLED:
                continue
            changed = changed[[int(np.argmax(_violation(increment, trial, status)[changed]))]]
        status = status.copy()
        status[changed] = following[changed]
        released[changed] |= status[changed] == Status.OPEN
    raise _NotConvergedError(residual)


def _set_up(problem: ContactProblem, start: ContactState, actuator: FloatArray) -> _Increment:
    """What an increment needs: compliance blocks at its start, unloaded places, slip references."""
    length = float(np.abs(actuator - start.actuator).max())
    return _Increment(
        problem,
        *_blocks_at(problem, start.place),
        _unloaded(problem, actuator),
        _slip_reference(start, length),
        length + float(np.abs(actuator).max()),
    )


def _unloaded(problem: ContactProblem, actuator: FloatArray) -> FloatArray:
    """Undeformed nodes (n, 2) [mm] in the frame of their actuator, which stands at `actuator` (n_actuators, 2)."""
    centre = np.stack([np.asarray(problem.row.positions), np.zeros(len(problem.row.positions))], axis=1)
    return np.asarray(problem.position - (actuator + centre)[problem.actuator_of()])


def _blocks_at(problem: ContactProblem, place: FloatArray) -> Blocks:
    """Compliance of the skin plus that of the actuators' faces at the places (n,) where the skin is, by components."""
    if problem.body is None:
        return problem.blocks
    xx, xy, yx, yy = (block.copy() for block in problem.blocks)
    index = problem.actuator_of()
    for number in range(len(problem.row.positions)):
        nodes = np.flatnonzero(index == number)
        shape = face_shape(problem.body, place[nodes])
        for block, i, j in ((xx, 0, 0), (xy, 0, 1), (yx, 1, 0), (yy, 1, 1)):
            block[np.ix_(nodes, nodes)] += shape @ problem.body.compliance[i::2, j::2] @ shape.T
    return xx, xy, yx, yy


def reevaluated_gap(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Gaps (n,) [mm] computed anew from a state's forces, with the actuators' compliance where the skin now is."""
    xx, xy, yx, yy = _blocks_at(problem, state.place)
    fx, fy = state.force.T
    x, y = _unloaded(problem, state.actuator).T
    return np.asarray(y + yx @ fx + yy @ fy + profile(problem.row, x + xx @ fx + xy @ fy)[0])


def _slip_reference(start: ContactState, length: float) -> FloatArray:
    """Place (n,) [mm] from which slip counts: the last state's, or for an open node where it will touch.

    An open node touches at the fraction of the increment at which its gap, extrapolated from the last increment,
    vanishes; until then it drifts freely, and that is no slip.
    """
    closing = -start.drift[:, 1] * length
    with np.errstate(divide="ignore", invalid="ignore"):
        fraction = np.where(closing > 0.0, np.clip(start.gap / closing, 0.0, 1.0), 0.0)
    drifting = np.where(start.status == Status.OPEN, fraction * start.drift[:, 0] * length, 0.0)
    return start.place + drifting


def _touched(problem: ContactProblem) -> Status:
    """State in which a node begins its contact; without friction all slip is alike."""
    return Status.STICK if problem.friction > 0.0 else Status.SLIP_FORWARD


def _at(increment: _Increment, force: FloatArray) -> _Trial:
    """Where the nodes are under given forces, and what they see of the profile."""
    fx, fy = np.ascontiguousarray(force.T)
    x, y = increment.origin[:, 0] + increment.xy @ fy, increment.origin[:, 1] + increment.yy @ fy
    if increment.problem.friction > 0.0:
        x, y = x + increment.xx @ fx, y + increment.yx @ fx
    drop, slope = profile(increment.problem.row, x)
    return _Trial(force, x, y, y + drop, slope)


def _newton_step(increment: _Increment, trial: _Trial, status: np.ndarray) -> FloatArray | None:
    """Forces (n, 2) after one Newton step within the given states; None if the equations are singular.

    With dq = C df and slip sign z:
        active:  dq_y + d'(q_x) dq_x = -g
        stick:   dq_x = -(q_x - reference)
        slip:    f_x = -z mu f_y             (eliminated: a slipping node has one unknown)
        open:    f = 0
    """
    active = np.flatnonzero(status != Status.OPEN)
    stick = np.flatnonzero(status == Status.STICK)
    drag = -SLIP_SIGN[status] * increment.problem.friction
    # what the states prescribe comes first: open nodes let go, slipping nodes follow Coulomb's law
    base = np.where((status != Status.OPEN)[:, None], trial.force, 0.0)
    slipping = status > Status.STICK
    base[slipping, 0] = drag[slipping] * base[slipping, 1]
    if active.size == 0:
        return base
    moved = _at(increment, base) if not np.array_equal(base, trial.force) else trial
    # the profile is linearised about the trial: a half-taken step may lie far off the face
    gap = trial.gap + (moved.height - trial.height) + trial.slope * (moved.place - trial.place)
    slope = trial.slope[active, None]
    rows = np.ix_(active, active)
    to_y, to_x = increment.yy[rows], increment.xy[rows]
    if increment.problem.friction > 0.0:
        to_y = to_y + increment.yx[rows] * drag[active]
        to_x = to_x + increment.xx[rows] * drag[active]
    matrix = np.empty((active.size + stick.size,) * 2)
    matrix[: active.size, : active.size] = to_y + slope * to_x
    right = np.concatenate([-gap[active], -(moved.place - increment.reference)[stick]])
    if stick.size:
        across = np.ix_(active, stick)
        matrix[: active.size, active.size :] = increment.yx[across] + slope * increment.xx[across]
        along = np.ix_(stick, active)
        matrix[active.size :, : active.size] = increment.xy[along] + increment.xx[along] * drag[active]
        matrix[active.size :, active.size :] = increment.xx[np.ix_(stick, stick)]
    try:
        change = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        return None
    if not np.all(np.isfinite(change)):
        return None
    base[active, 1] += change[: active.size]
    base[stick, 0] += change[active.size :]
    base[active, 0] += drag[active] * change[: active.size]
    return base


def _searched(increment: _Increment, trial: _Trial, step: FloatArray, status: np.ndarray) -> _Trial:
    """The first point on the way back from `step` to `trial` where the residuals have become smaller."""
    before = np.linalg.norm(_residuals(increment, trial, status))
    for halvings in range(MAX_HALVINGS + 1):
        there = _at(increment, trial.force + (step - trial.force) / 2.0**halvings)
        if np.linalg.norm(_residuals(increment, there, status)) < before:
            break
    return there


def _residuals(increment: _Increment, trial: _Trial, status: np.ndarray) -> FloatArray:
    """Residuals of all active nodes' equations [1]: gaps and slips over the load, forces over the largest."""
    active, stick, sign = status != Status.OPEN, status == Status.STICK, SLIP_SIGN[status]
    slip = (trial.place - increment.reference)[stick]
    cone = (trial.force[:, 0] + sign * increment.problem.friction * trial.force[:, 1])[sign != 0.0]
    return np.concatenate(
        [trial.gap[active] / increment.gap_scale, slip / increment.gap_scale, cone / _largest(trial.force)]
    )


def _largest(force: FloatArray) -> float:
    """Largest nodal force component [N/mm], never zero."""
    return max(float(np.abs(force).max(initial=0.0)), np.finfo(float).tiny)


def _next_status(increment: _Increment, trial: _Trial, status: np.ndarray, released: np.ndarray) -> np.ndarray:
    """State (n,) that forces, gaps and slips ask for; what lies within the tolerance asks for nothing.

    A node that touches sticks, unless it was released before in this increment (n,): then it was pulled along the
    face, and slips the way it went.
    """
    problem = increment.problem
    shearing, pressing = trial.force.T
    small_force = problem.tolerance * _largest(trial.force)
    small_gap = problem.tolerance * increment.gap_scale
    following = status.copy()
    following[(status != Status.OPEN) & (pressing < -small_force)] = Status.OPEN
    touching = (status == Status.OPEN) & (trial.gap < -small_gap)
    following[touching] = _touched(problem)
    if problem.friction > 0.0:
        forward = trial.place > increment.reference
        following[touching & released] = np.where(forward, Status.SLIP_FORWARD, Status.SLIP_BACKWARD)[
            touching & released
        ]
        limit = problem.friction * pressing + small_force
        stick = (status == Status.STICK) & (following == Status.STICK)
        # the skin is dragged towards +x where the actuator's shear on it would point to -x beyond the limit
        following[stick & (shearing < -limit)] = Status.SLIP_FORWARD
        following[stick & (shearing > limit)] = Status.SLIP_BACKWARD
        back = SLIP_SIGN[status] * (trial.place - increment.reference) < -small_gap
        following[back & (following == status)] = Status.STICK
    return following


def _violation(increment: _Increment, trial: _Trial, status: np.ndarray) -> FloatArray:
    """How far (n,) [mm] each node is beyond its state: gaps and slips as such, forces as the motion they cause."""
    friction = increment.problem.friction
    shearing, pressing = trial.force.T
    tension = np.maximum(-pressing, 0.0) * np.diag(increment.yy)
    excess = np.maximum(np.abs(shearing) - friction * np.maximum(pressing, 0.0), 0.0) * np.diag(increment.xx)
    reverse = np.maximum(-SLIP_SIGN[status] * (trial.place - increment.reference), 0.0) * (friction > 0.0)
    in_contact = np.maximum(tension, np.where(status == Status.STICK, excess, reverse))
    return np.where(status == Status.OPEN, np.maximum(-trial.gap, 0.0), in_contact)


def _accept(
    increment: _Increment,
    start: ContactState,
    trial: _Trial,
    status: np.ndarray,
    actuator: FloatArray,
    residual: float,
    iterations: int,
) -> ContactState:
    """The converged state at the end of an increment."""
    slipping = SLIP_SIGN[status] != 0.0
    work = -float(np.sum((trial.force[:, 0] * (trial.place - increment.reference))[slipping]))
    length = float(np.abs(actuator - start.actuator).max())
    drift = np.stack([trial.place - start.place, trial.gap - start.gap], axis=1) / length
    return ContactState(
        actuator,
        trial.force,
        status,
        trial.place,
        trial.gap,
        drift,
        start.dissipation + work,
        max(start.residual, residual),
        start.iterations + iterations,
        start.cuts,
    )
