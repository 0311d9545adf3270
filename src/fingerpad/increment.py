"""One increment of a path: a semismooth Newton method in the form of a primal-dual active set.

Every node is open, sticks or slips; the equations of that state are solved; forces and gaps then decide the next
state (Alart and Curnier 1991; Christensen et al. 1998; Hueeber and Wohlmuth 2005). What the states prescribe are
displacements: both components of a node that sticks, the one along the profile of a node that slips. So the equations
are written with the stiffness K = C^-1 of a patch: the nodes in contact, and some that soon may be. Of the patch's
forces f = K u only few unknowns remain,
    slip:  T + z mu N = 0       for q_x, with u_y = -(y0 + d(q_x)) following the profile; z the sign of slip
    open:  f_x = f_y = 0        for u_x and u_y
and a change of state costs a small dense system, while K serves until contact leaves the patch.

If states do not settle, steps are damped by a line search and one node at a time changes.

The equations of every set of states have a determinant, and its sign tells more than whether they can be solved. Where
it is positive for all states the solution is unique, as without friction on a flat face, where K is positive definite.
A path from rest meets states of positive sign as long as it advances: sign and d(load)/d(path) change together. With
large friction, or skin on a steep wall, the sign of some states is negative (det k = k_xx + z mu k_yx for one node that
slips: Klarbring 1990). A solution there is one of three or more, and none that loading leads to: it is not accepted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .contact import (
    OPEN,
    ContactProblem,
    ContactState,
    Status,
    Touch,
    displacement,
    face_compliance,
    given_way,
    resolved,
    touch,
    unloaded,
)
from .profile import bend, profile
from .scene import FloatArray

MAX_ITERATIONS = 60  # of Newton within one increment before it is halved [1]; source: usual count is 2-6 (measured)
SIMULTANEOUS = 12  # iterations in which all nodes may change state at once [1]; after that, the worst one alone
MAX_HALVINGS = 5  # of a Newton step in the line search [1]; source: 1/32 is below any step that was ever needed
SETTLED = 1e-6  # relative residual [1] below which forces are good enough to judge a single node's state
EACH = 0.01  # share [1] of the tolerance for each force, as errors add up in a gap; source: some 100 nodes
GIVING = 5e-5  # of the load [1] by which a face may give way elsewhere than it touches; source: half of what a
# certificate allows, scores of Device 3 hold to 1e-5 (measured)
ELIMINATED = 30  # rows [1] of half a matrix below which it is not halved; source: fewest seconds of 16 to 50 (measured)
FORESIGHT = 1.5  # increments [1] for which a patch looks ahead; source: fewest seconds of 1, 1.5, 2, 3, 5 (measured)
STRAIGHT = 1e-9  # change of heading [1] below which a path goes on as before; source: rounding

SMALLEST = float(np.finfo(float).tiny)  # N/mm, in place of no force at all
ROUNDING = float(np.finfo(float).eps)  # of a number [1]
STICK, SLIP_FORWARD, SLIP_BACKWARD = map(int, (Status.STICK, Status.SLIP_FORWARD, Status.SLIP_BACKWARD))
SLIP_SIGN = np.array([0.0, 0.0, 1.0, -1.0])  # direction of slip by Status


class NotConvergedError(Exception):
    """An increment did not converge: it is to be halved. turned: whether states on the way had a negative sign.
    inverted: where tissue was turned inside out, if it was. snaps: whether tissue was unstable on the way.
    """

    def __init__(self, residual: float, turned: bool = False, inverted: str = "", snaps: bool = False) -> None:
        super().__init__(residual, turned, inverted, snaps)
        self.residual = residual
        self.turned = turned
        self.inverted = inverted
        self.snaps = snaps


@dataclass(frozen=True)
class Patch:
    """Contact nodes (b,) by ascending index, and the forces (2b, 2b) [N/mm per mm] that unit displacements of skin and
    faces between them take: one displacement a row, ordered x0, x1, ..., y0, y1, ... stiffest: largest on the diagonal.
    """

    nodes: np.ndarray
    response: FloatArray
    stiffest: float


@dataclass(frozen=True)
class _Increment:
    """What does not change while one increment is solved, of the patch's nodes.

    origin: (2, b) unloaded nodes from their actuator [mm]. bias: (2b,) displacements [mm] that take no force.
    gap_scale: [mm]. force_floor: [N/mm], the rounding of forces over the tolerance.
    """

    problem: ContactProblem
    patch: Patch
    origin: FloatArray
    bias: FloatArray
    gap_scale: float
    force_floor: float


@dataclass(frozen=True)
class _States:
    """What the patch's nodes do: states (b,), the nodes that are open (o,) and that slip (s,), their friction times the
    direction of slip (s,) [1], and the unknown displacements (m,) among the patch's.
    """

    status: np.ndarray
    open: np.ndarray
    slip: np.ndarray
    drag: FloatArray
    unknown: np.ndarray


@dataclass(frozen=True)
class _Trial:
    """Displacements (2b,) [mm] of the patch's nodes and the forces (2b,) [N/mm] they take, ordered x0, x1, ..., y0, y1,
    ...; places (b,), gaps (b,) [mm], slopes (b,) [1] of the profile there. largest: force component [N/mm], or the
    floor.
    """

    moved: FloatArray
    force: FloatArray
    place: FloatArray
    gap: FloatArray
    slope: FloatArray
    pressing: FloatArray
    shearing: FloatArray
    largest: float


@dataclass(frozen=True)
class _Everywhere:
    """Forces (n, 2) and shearing forces (n,) [N/mm], states (n,), displacements (n, 2), places (n,), gaps (n,) [mm] and
    slopes (n,) [1] of the direction of shear, of all contact nodes.
    """

    force: FloatArray
    shearing: FloatArray
    status: np.ndarray
    moved: FloatArray
    place: FloatArray
    gap: FloatArray
    slope: FloatArray


def solve_increment(
    problem: ContactProblem, start: ContactState, actuator: FloatArray, patch: Patch | None
) -> tuple[ContactState, Patch]:
    """The state with the actuators at `actuator` (n_actuators, 2) [mm], and the patch it was found with.

    patch: one from earlier on this path, which serves if contact can still lie within it. Raises NotConvergedError.
    """
    length = float(np.abs(actuator - start.actuator).max())
    heading = (actuator - start.actuator) / length
    straight = bool(np.abs(heading - start.heading).max() < STRAIGHT)
    status, ahead = _foreseen(problem, start, length, straight)
    reference = start.place + _drifted(start, length) if straight else start.place.copy()
    gap_scale = length + float(np.abs(actuator).max())
    origin = unloaded(problem, actuator)
    needed = np.flatnonzero(status != OPEN)
    if needed.size == 0:  # nothing bears a force, and nodes lie where the actuators left them
        place, height = origin.T
        gap = height + profile(problem.row, place)[0]
        first = _touching(gap < -problem.tolerance * gap_scale, gap, status, problem.actuator_of)
        _touch(reference, start, place, gap, first)
        status[first] = _touched(problem)
        needed = np.flatnonzero(first) if first.any() else np.array([int(np.argmin(gap))])
    # the last increment promises where the skin will touch the faces
    guess = start.place + start.drift[:, 0] * length if straight else start.place
    expected, there = guess, touch(problem, guess)
    patch = patch if there is None else None
    iterations, searched, residual, bias, share = 0, False, float("inf"), None, 1.0
    while iterations < MAX_ITERATIONS:
        if patch is None or not _holds(patch, needed, problem.position.shape[0]):
            patch, bias = _patch(problem, _taken(problem, needed, ahead), there), None
        nodes = patch.nodes
        bias = np.zeros(2 * nodes.size) if bias is None else bias
        floor = _rounding(problem, patch, origin[nodes], gap_scale)
        increment = _Increment(problem, patch, origin[nodes].T, bias, gap_scale, floor)
        trial, status_there, count = _settle(increment, start, guess[nodes], status[nodes], reference, iterations)
        iterations, searched = iterations + count, searched or count > SIMULTANEOUS
        found = _everywhere(increment, origin, there, trial, status_there)
        status, guess = found.status, found.place
        missed = (status == OPEN) & (found.gap < -problem.tolerance * gap_scale)
        missed[nodes] = False
        if missed.any():
            _touch(reference, start, found.place, found.gap, missed)
            status[missed] = _touched(problem)
            needed, ahead = np.flatnonzero(status != OPEN), ahead | missed
            continue
        slip = found.place - reference
        residual = _residual(problem, gap_scale, found, slip)
        if residual > problem.tolerance:
            bias = bias + found.moved[nodes].T.ravel() - trial.moved  # what rounding in the stiffness has left
        elif _gives_elsewhere(problem, found, there, gap_scale):
            # after a first correction only half-way: nodes may pass each other for ever
            expected, share = expected + share * (found.place - expected), 0.5
            there, patch, needed = touch(problem, expected), None, np.flatnonzero(status != OPEN)
        else:
            reached = _accepted(problem, start, actuator, found, slip, residual)
            iterations, searches = start.iterations + iterations, start.searches + int(searched)
            return replace(reached, iterations=iterations, searches=searches), patch
    raise NotConvergedError(residual)


def _everywhere(
    increment: _Increment, origin: FloatArray, there: Touch | None, trial: _Trial, status: np.ndarray
) -> _Everywhere:
    """What a patch's trial means for all nodes, whose unloaded places are `origin` (n, 2) [mm]."""
    nodes = increment.patch.nodes
    force, shearing, states = np.zeros(origin.shape), np.zeros(origin.shape[0]), np.full(origin.shape[0], OPEN)
    force[nodes], shearing[nodes], states[nodes] = trial.force.reshape(2, -1).T, trial.shearing, status
    moved = displacement(increment.problem, force, there)
    place, height = (origin + moved).T
    drop, slope = profile(increment.problem.row, place)
    return _Everywhere(force, shearing, states, moved, place, height + drop, slope)


def _gives_elsewhere(problem: ContactProblem, found: _Everywhere, there: Touch | None, gap_scale: float) -> bool:
    """Whether deformable faces give way noticeably elsewhere than the skin touches them now."""
    if there is None:
        return False
    astray = given_way(problem, found.force, touch(problem, found.place)) - given_way(problem, found.force, there)
    return bool(np.abs(astray[found.status != OPEN]).max(initial=0.0) > max(GIVING, problem.tolerance) * gap_scale)


def _accepted(
    problem: ContactProblem,
    start: ContactState,
    actuator: FloatArray,
    found: _Everywhere,
    slip: FloatArray,
    residual: float,
) -> ContactState:
    """The converged state at the end of an increment, of which nodes slipped by `slip` (n,) [mm]."""
    length = float(np.abs(actuator - start.actuator).max())
    # backward Euler: friction works along the whole slip with the force at its end
    way = slip * np.sqrt(1.0 + found.slope**2) if problem.turning else slip
    work = -float((found.shearing * (found.status > STICK)) @ way)
    return replace(
        start,
        actuator=actuator,
        force=found.force,
        status=found.status,
        place=found.place,
        gap=found.gap,
        heading=(actuator - start.actuator) / length,
        drift=np.array([found.place - start.place, found.gap - start.gap]).T / length,
        trend=(found.force - start.force) / length,
        dissipation=start.dissipation + work,
        residual=max(start.residual, residual),
    )


def _foreseen(
    problem: ContactProblem, start: ContactState, length: float, straight: bool
) -> tuple[np.ndarray, np.ndarray]:
    """States (n,) that the last increment promises for this one, and the nodes (n,) that a patch should hold.

    Where the path turns, all that was in contact sticks first: friction opposes the new direction from zero slip.
    """
    status = start.status.copy()
    if not straight:
        if problem.friction > 0.0:
            status[status > STICK] = STICK
        return status, (status != OPEN) | (start.gap < FORESIGHT * length)
    gap = start.gap + start.drift[:, 1] * length
    closing = _touching((status == OPEN) & (gap < 0.0), gap, status, problem.actuator_of)
    slope = profile(problem.row, start.place + start.drift[:, 0] * length)[1]
    pressing, shearing = resolved(problem, start.force + start.trend * length, slope)
    opening = (status != OPEN) & (pressing < 0.0)
    sliding = (status == STICK) & (np.abs(shearing) > problem.friction * pressing)
    np.putmask(status, sliding, _dragged(shearing))
    status[closing] = _touched(problem)
    status[opening] = OPEN
    ahead = (status != OPEN) | (start.gap + FORESIGHT * start.drift[:, 1] * length < 0.0)
    return status, ahead


def _touching(overlapping: np.ndarray, gap: FloatArray, status: np.ndarray, actuator_of: np.ndarray) -> np.ndarray:
    """Which open nodes (n,) touch, of those that overlap: on an actuator that touches none, the deepest alone. What it
    bears moves its neighbours away, and they would have to be released one by one.
    """
    if not overlapping.any():
        return overlapping
    touched = np.zeros(int(actuator_of.max()) + 1, dtype=bool)
    touched[actuator_of[status != OPEN]] = True
    alone = overlapping & ~touched[actuator_of]
    touching = np.asarray(overlapping & ~alone)
    for actuator in np.unique(actuator_of[alone]):
        depth = np.where(alone & (actuator_of == actuator), -gap, -np.inf)
        touching[np.argmax(depth)] = True
    return touching


def _touched(problem: ContactProblem) -> int:
    """State in which a node begins its contact; without friction all slip is alike."""
    return STICK if problem.friction > 0.0 else SLIP_FORWARD


def _drifted(start: ContactState, length: float) -> FloatArray:
    """Way (n,) [mm] along x that a node goes before it touches, which is no slip: zero for nodes in contact.

    An open node touches at the fraction of the increment at which its gap, extrapolated from the last increment,
    vanishes.
    """
    closing = -start.drift[:, 1] * length
    with np.errstate(divide="ignore", invalid="ignore"):
        fraction = np.where(closing > 0.0, np.clip(start.gap / closing, 0.0, 1.0), 0.0)
    return np.where(start.status == OPEN, fraction * start.drift[:, 0] * length, 0.0)


def _touch(reference: FloatArray, start: ContactState, place: FloatArray, gap: FloatArray, nodes: np.ndarray) -> None:
    """Set the slip reference of nodes (n,) not foreseen: they touch on their way to `place` and `gap` (n,) [mm]."""
    came = nodes & (start.status == OPEN)
    fraction = np.clip(start.gap[came] / (start.gap[came] - gap[came]), 0.0, 1.0)
    reference[came] = start.place[came] + fraction * (place[came] - start.place[came])


def _taken(problem: ContactProblem, needed: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """Nodes (b,) that a patch takes, of those `needed` (k,) and those that may be `ahead` (n,)."""
    return np.union1d(needed, np.flatnonzero(ahead)) if problem.patches else np.arange(ahead.size)


def _holds(patch: Patch, nodes: np.ndarray, count: int) -> bool:
    """Whether some nodes, of `count` in all, lie within a patch."""
    held = np.zeros(count, dtype=bool)
    held[patch.nodes] = True
    return bool(held[nodes].all())


def _patch(problem: ContactProblem, nodes: np.ndarray, there: Touch | None) -> Patch:
    """Stiffness of some nodes, all other nodes unloaded. Raises NotConvergedError if their compliance is singular."""
    unknowns = np.concatenate([2 * nodes, 2 * nodes + 1])
    compliance = problem.compliance.take(unknowns, 0).take(unknowns, 1)
    if there is not None:
        compliance += face_compliance(problem, there, nodes)
    held = np.flatnonzero(np.diag(compliance) == 0.0)
    compliance[held, held] = 1.0  # what does not move answers no load: any stiffness leaves it where it is
    try:
        response = _inverse(compliance)
    except np.linalg.LinAlgError:
        raise NotConvergedError(float("inf")) from None
    return Patch(nodes, response, _largest_of(np.diag(response)))


def _rounding(problem: ContactProblem, patch: Patch, origin: FloatArray, gap_scale: float) -> float:
    """Force [N/mm] whose tolerance is what the rounding of coordinates and displacements leaves of K u."""
    digit = ROUNDING * (_largest_of(origin) + gap_scale)
    return digit * patch.stiffest / problem.tolerance


def _inverse(matrix: FloatArray) -> FloatArray:
    """Inverse of a symmetric matrix (n, n) whose leading blocks are regular, by halves of halves: products of matrices
    take a quarter of the seconds that elimination does.
    """
    half = matrix.shape[0] // 2
    if half < ELIMINATED:
        return np.asarray(np.linalg.inv(matrix), dtype=float)
    right = matrix[:half, half:]
    first = _inverse(matrix[:half, :half])
    carried = first @ right
    inverse = np.empty_like(matrix)
    inverse[half:, half:] = _inverse(matrix[half:, half:] - right.T @ carried)
    inverse[:half, half:] = -carried @ inverse[half:, half:]
    inverse[half:, :half] = inverse[:half, half:].T
    inverse[:half, :half] = first - inverse[:half, half:] @ carried.T
    return inverse


def _settle(
    increment: _Increment,
    start: ContactState,
    guess: FloatArray,
    status: np.ndarray,
    reference: FloatArray,
    done: int,
) -> tuple[_Trial, np.ndarray, int]:
    """Trial and states (b,) that agree, and the iterations it took; sets references (n,) of nodes that touch.

    guess: places (b,) [mm] to begin with. Raises NotConvergedError after MAX_ITERATIONS, those `done` before included.
    """
    problem, nodes = increment.problem, increment.patch.nodes
    states = _states(problem, status)
    moved = np.concatenate([guess - increment.origin[0], np.zeros(nodes.size)])
    trial = _at(increment, moved, states, reference[nodes])
    released = np.zeros(nodes.size, dtype=bool)
    residual, turned = float("inf"), False
    for iteration in range(MAX_ITERATIONS - done):
        matrix, right = _newton_equations(increment, trial, states)
        step = _solved(matrix, right, states.unknown, 2 * nodes.size)
        if step is None:
            break
        settling = iteration >= SIMULTANEOUS
        turned = turned or (settling and _is_turned(matrix))
        trial = (_searched if settling else _stepped)(increment, trial, step, states, reference[nodes])
        slip = trial.place - reference[nodes]
        following = _next_status(increment, trial, slip, status, released)
        changed = (following != status).nonzero()[0]
        before, residual = residual, _largest_of(_cone(trial, states))
        if changed.size == 0:
            # a residual that one more step did not lower is rounding
            if residual <= EACH * problem.tolerance or before <= residual <= problem.tolerance:
                if _is_turned(matrix):
                    turned = True
                    break
                return _obeying(problem, trial, states), status, iteration + 1
            continue
        if settling:
            if residual > SETTLED:
                continue
            changed = changed[[int(np.argmax(_violation(increment, trial, slip, status)[changed]))]]
        was, now = status[changed], following[changed]
        touching = changed[(was == OPEN) & ~released[changed]]
        status = status.copy()
        status[changed] = now
        states = _states(problem, status)
        released[changed[now == OPEN]] = True
        if touching.size:
            _touch_there(reference, start, nodes, trial, touching)
        if ((was == OPEN) | (now == STICK)).any():  # nodes come to the profile or stop; others are where they were
            trial = _at(increment, trial.moved, states, reference[nodes])
    raise NotConvergedError(residual, turned)


def _states(problem: ContactProblem, status: np.ndarray) -> _States:
    """What nodes in those states (b,) do."""
    slip, open_ = (status > STICK).nonzero()[0], (status == OPEN).nonzero()[0]
    drag = problem.friction * SLIP_SIGN[status[slip]]
    return _States(status, open_, slip, drag, np.concatenate([slip, open_, status.size + open_]))


def _touch_there(
    reference: FloatArray, start: ContactState, nodes: np.ndarray, trial: _Trial, touching: np.ndarray
) -> None:
    """Set the slip reference (n,) of the patch's nodes that touch now."""
    place, gap = start.place.copy(), start.gap.copy()
    place[nodes], gap[nodes] = trial.place, trial.gap
    mask = np.zeros(start.place.size, dtype=bool)
    mask[nodes[touching]] = True
    _touch(reference, start, place, gap, mask)


def _at(increment: _Increment, moved: FloatArray, states: _States, reference: FloatArray) -> _Trial:
    """The trial in which nodes that stick lie at their reference (b,), nodes in contact on the profile."""
    x, y = increment.origin
    status, count = states.status, x.size
    along = np.where(status == STICK, reference - x, moved[:count])  # not from the place, which has lost digits
    place = x + along
    drop, slope = profile(increment.problem.row, place)
    touching = -(y + drop)
    height = np.where(status == OPEN, moved[count:], touching)
    moved = np.concatenate([along, height])
    force = (moved - increment.bias) @ increment.patch.response
    pressing, shearing = resolved(increment.problem, force.reshape(2, -1).T, slope)
    largest = max(_largest_of(force), increment.force_floor, SMALLEST)
    return _Trial(moved, force, place, height - touching, slope, pressing, shearing, largest)


def _newton_equations(increment: _Increment, trial: _Trial, states: _States) -> tuple[FloatArray, FloatArray]:
    """Matrix (m, m) and right side (m,) of one Newton step within the given states."""
    problem, response, force, slip, drag = (
        increment.problem,
        increment.patch.response,
        trial.force,
        states.slip,
        states.drag,
    )
    pressing = states.status.size + slip
    forces = response.take(states.unknown, 0)  # of unit changes of the unknowns, one a row
    forces[: slip.size] -= trial.slope[slip, None] * response.take(pressing, 0)
    transposed = forces.take(states.unknown, 1)
    right = -force[states.unknown]
    if problem.friction > 0.0 or problem.turning:  # T + z mu N in terms of f_x and f_y, times sqrt(1 + slope^2)
        tilted = trial.slope[slip] * problem.turning
        along, across = 1.0 + drag * tilted, drag - tilted
        transposed[:, : slip.size] *= along
        transposed[:, : slip.size] += across * forces.take(pressing, 1)
        right[: slip.size] = -along * force[slip] - across * force[pressing]
        if problem.turning:
            turned = bend(problem.row, trial.place[slip]) * (drag * force[slip] - force[pressing])
            transposed[np.arange(slip.size), np.arange(slip.size)] += turned
    return transposed.T, right


def _solved(matrix: FloatArray, right: FloatArray, unknown: np.ndarray, size: int) -> FloatArray | None:
    """Change (size,) [mm] of the displacements in a Newton step; None if its equations are singular."""
    step = np.zeros(size)
    try:
        step[unknown] = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        return None
    return step if np.isfinite(step).all() else None


def _is_turned(matrix: FloatArray) -> bool:
    """Whether the determinant of the states' equations is negative."""
    return bool(np.linalg.slogdet(matrix)[0] < 0.0)


def _stepped(increment: _Increment, trial: _Trial, step: FloatArray, states: _States, reference: FloatArray) -> _Trial:
    """The trial after a whole step."""
    return _at(increment, trial.moved + step, states, reference)


def _searched(increment: _Increment, trial: _Trial, step: FloatArray, states: _States, reference: FloatArray) -> _Trial:
    """The first point on the way back from `step` to `trial` where the residuals have become smaller."""
    before = np.linalg.norm(_cone(trial, states))
    for halvings in range(MAX_HALVINGS + 1):
        there = _at(increment, trial.moved + step / 2.0**halvings, states, reference)
        if np.linalg.norm(_cone(there, states)) < before:
            break
    return there


def _obeying(problem: ContactProblem, trial: _Trial, states: _States) -> _Trial:
    """The trial with the forces that the states prescribe, to the last bit."""
    pressing, shearing = trial.pressing.copy(), trial.shearing.copy()
    pressing[states.open] = shearing[states.open] = 0.0
    shearing[states.slip] = -states.drag * pressing[states.slip]
    across, along = resolved(problem, np.array([shearing, pressing]).T, -trial.slope)  # turned back
    return replace(trial, force=np.concatenate([along, across]), pressing=pressing, shearing=shearing)


def _cone(trial: _Trial, states: _States) -> FloatArray:
    """Residuals of slipping and open nodes' equations [1]: what slipping nodes' forces lack to the cone of friction,
    and open nodes' to zero, over the largest force.
    """
    shearing, pressing = trial.shearing, trial.pressing
    excess = shearing[states.slip] + states.drag * pressing[states.slip]
    return np.concatenate([excess, shearing[states.open], pressing[states.open]]) / trial.largest


def _residual(problem: ContactProblem, gap_scale: float, found: _Everywhere, slip: FloatArray) -> float:
    """Largest residual of all equations [1]: gaps and slips (n,) [mm] over the load, forces over the largest."""
    status = found.status
    pressing, shearing = resolved(problem, found.force, found.slope)
    excess = np.abs(shearing + problem.friction * SLIP_SIGN[status] * pressing)[status > STICK]
    displaced = np.concatenate([found.gap[status != OPEN], slip[status == STICK]])
    return max(_largest_of(displaced) / gap_scale, _largest_of(excess) / max(_largest_of(found.force), SMALLEST))


def _largest_of(values: FloatArray) -> float:
    """Largest magnitude, zero of none."""
    return float(np.abs(values).max(initial=0.0))


def _next_status(
    increment: _Increment, trial: _Trial, slip: FloatArray, status: np.ndarray, released: np.ndarray
) -> np.ndarray:
    """State (b,) that forces, gaps and slips ask for; what lies within the tolerance asks for nothing.

    A node that touches sticks, unless it was released before in this increment (b,): then it was pulled along the
    face, and slips the way it went.
    """
    problem, pressing, shearing = increment.problem, trial.pressing, trial.shearing
    small_force = problem.tolerance * trial.largest
    small_gap = problem.tolerance * increment.gap_scale
    following, open_ = status.copy(), status == OPEN
    np.putmask(following, pressing < np.where(open_, -np.inf, -small_force), OPEN)
    overlapping = open_ & (trial.gap < -small_gap)
    touching = _touching(overlapping, trial.gap, status, problem.actuator_of[increment.patch.nodes])
    np.putmask(following, touching, _touched(problem))
    if problem.friction > 0.0:
        np.putmask(following, touching & released, np.where(slip > 0.0, SLIP_FORWARD, SLIP_BACKWARD))
        kept = following == status
        beyond = np.abs(shearing) > problem.friction * pressing + small_force
        np.putmask(following, kept & (status == STICK) & beyond, _dragged(shearing))
        np.putmask(following, kept & (SLIP_SIGN[status] * slip < -small_gap), STICK)
    return following


def _dragged(shearing: FloatArray) -> np.ndarray:
    """Slip (n,) that goes with shearing forces (n,): the skin is dragged to +x where they point to -x."""
    return np.where(shearing < 0.0, SLIP_FORWARD, SLIP_BACKWARD)


def _violation(increment: _Increment, trial: _Trial, slip: FloatArray, status: np.ndarray) -> FloatArray:
    """How far (b,) [mm] each node is beyond its state: gaps and slips as such, forces as the motion they cause."""
    friction, pressing, shearing = increment.problem.friction, trial.pressing, trial.shearing
    along, across = 1.0 / np.diag(increment.patch.response).reshape(2, -1)
    tension = np.maximum(-pressing, 0.0) * across
    excess = np.maximum(np.abs(shearing) - friction * np.maximum(pressing, 0.0), 0.0) * along
    reverse = np.maximum(-SLIP_SIGN[status] * slip, 0.0) * (friction > 0.0)
    in_contact = np.maximum(tension, np.where(status == STICK, excess, reverse))
    return np.where(status == OPEN, np.maximum(-trial.gap, 0.0), in_contact)
