"""One increment of a path: states foreseen from the last one, settled on a patch, and what they mean for all nodes.

`active_set` settles the states of a `patch`. If skin then overlaps a face elsewhere, or deformable faces give way
elsewhere than foreseen, the patch is made again.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray
from ..errors import ReachError
from .acceleration import accelerated
from .active_set import (
    SLIP_SIGN,
    SMALLEST,
    STICK,
    PatchProblem,
    Trial,
    dragged,
    largest_of,
    newly_touching,
    settle,
    touched_on_the_way,
    touched_status,
)
from .faces import displacement, face_displacement, touch
from .formulation import FRONT_POWER, OPEN, ContactProblem, ContactState, resolved, unloaded
from .not_converged import NotConvergedError
from .ownership import given_anew, given_to, handed_over, touches_both
from .patch import Patch, holds, nodes_of, patch_of
from .profile import profile

AMISS = 1e-5  # of the actuators' displacement [1] by which deformable faces may be amiss; source: a tenth of what a
# certificate allows of a gap or an overlap, which it measures in the same way
FORESIGHT = 1.5  # increments [1] for which a patch looks ahead; source: fewest seconds of 1, 1.5, 2, 3, 5 (measured)
TURNING = 0.5  # of the way [1] by which gaps may close where a path turns, as skin beside a face moves with it; source:
# fewest seconds of 0.25, 0.5, 1, 1.5 (measured)
# Times [1] that an increment is solved until skin is the right actuator's; source: two suffice where pins abut
# (measured)
HANDED_OVER = 5
STRAIGHT = 1e-9  # change of heading [1] below which a path goes on as before; source: rounding


@dataclass(frozen=True)
class _Outset:
    """What an increment sets out with: the last state, without drift where the path turns; states (n,) foreseen, slip
    references (n,) and places (n,) [mm]; nodes (k,) that a patch needs, and those (n,) that it should look ahead to.
    """

    start: ContactState
    status: np.ndarray
    reference: FloatArray
    guess: FloatArray
    needed: np.ndarray
    ahead: np.ndarray


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

    patch: one from earlier on this path, which serves if contact can still lie within it. Where skin slides from one
    actuator to the next, the increment is solved again with skin that the next one has. Raises NotConvergedError, also
    where skin belongs to both: given to either it overlaps the other.
    """
    problem, start = given_anew(problem, start)
    for _ in range(HANDED_OVER):
        reached, patch = _solved_as_given(problem, start, actuator, patch)
        given = handed_over(problem, reached, problem.tolerance * largest_of(actuator))
        if np.array_equal(given, reached.given):
            return reached, patch
        problem, start = given_to(problem, start, given)
    node, positions = np.flatnonzero(reached.given != given)[0], problem.row.positions
    between = touches_both(positions[reached.given[node]], positions[given[node]])
    raise NotConvergedError(float("inf"), ReachError(between))


def _solved_as_given(
    problem: ContactProblem, start: ContactState, actuator: FloatArray, patch: Patch | None
) -> tuple[ContactState, Patch]:
    """The same with every node given to the actuator that it has. Raises NotConvergedError."""
    gap_scale = largest_of(actuator - start.actuator) + largest_of(actuator)
    origin = unloaded(problem, actuator)
    outset = _outset(problem, start, actuator, origin, gap_scale)
    start, status, reference, guess = outset.start, outset.status, outset.reference, outset.guess
    needed, ahead = outset.needed, outset.ahead
    patch = _serving(problem, actuator, patch)
    expected = guess if patch is None or problem.body is None else patch.place
    there = touch(problem, expected)
    iterations, searched, residual, bias = 0, False, float("inf"), None
    steps: list[FloatArray] = []
    ends: list[FloatArray] = []
    while iterations < problem.most_iterations:
        if patch is None or not holds(patch, needed):
            patch, bias = _remade(problem, actuator, needed, ahead, expected, there), None
        nodes = patch.nodes
        bias = np.zeros(2 * nodes.size) if bias is None else bias
        increment = PatchProblem(problem, patch, origin[nodes].T, bias, gap_scale)
        settled = settle(increment, start, guess[nodes], status[nodes], reference, iterations)
        iterations, searched = iterations + settled.iterations, searched or settled.searched
        found = _everywhere(increment, origin, there, settled.trial, settled.status)
        status, guess, reference = found.status, found.place, settled.reference
        missed = (status == OPEN) & (found.gap < -problem.tolerance * gap_scale)
        missed[nodes] = False
        if missed.any():
            reference = touched_on_the_way(reference, start, found.place, found.gap, missed)
            status[missed] = touched_status(problem)
            needed, ahead = np.flatnonzero(status != OPEN), ahead | missed
            continue
        slip = found.place - reference
        residual = _residual(problem, gap_scale, found, slip)
        if residual > problem.tolerance:
            bias = bias + found.moved[nodes].T.ravel() - settled.trial.moved  # what rounding in the stiffness has left
        elif _amiss(problem, found, there) > max(AMISS * largest_of(actuator), problem.tolerance * gap_scale):
            steps.append(np.where(status != OPEN, found.place - expected, 0.0))
            ends.append(found.place)
            expected = accelerated(steps, ends)
            there, patch, needed = touch(problem, expected), None, np.flatnonzero(status != OPEN)
        else:
            reached = _accepted(problem, start, actuator, found, slip, residual)
            iterations, searches = start.iterations + iterations, start.searches + int(searched)
            return replace(reached, iterations=iterations, searches=searches), patch
    raise NotConvergedError(residual)


def _serving(problem: ContactProblem, actuator: FloatArray, patch: Patch | None) -> Patch | None:
    """A patch from earlier on the path if it may serve: with deformable faces where skin touches them as it did."""
    if patch is None or problem.body is None:
        return patch
    again = np.array_equal(patch.actuator, actuator) and np.array_equal(patch.given, problem.actuator_of)
    return patch if again else None


def _remade(
    problem: ContactProblem,
    actuator: FloatArray,
    needed: np.ndarray,
    ahead: np.ndarray,
    expected: FloatArray,
    there: FloatArray | None,
) -> Patch:
    """A patch with the nodes that it needs (k,), and those to look ahead to (n,). expected: places (n,) [mm] where skin
    will touch, `there` on deformable faces. Raises NotConvergedError if it has no stiffness.
    """
    try:
        return patch_of(problem, nodes_of(problem, needed, ahead), expected, there, actuator)
    except np.linalg.LinAlgError:
        raise NotConvergedError(float("inf")) from None


def _outset(
    problem: ContactProblem, start: ContactState, actuator: FloatArray, origin: FloatArray, gap_scale: float
) -> _Outset:
    """What the last increment promises for the one to `actuator` (n_actuators, 2) [mm], where nodes lie at `origin`
    (n, 2) [mm] unloaded.
    """
    length = largest_of(actuator - start.actuator)
    straight = bool(np.abs(_over(actuator - start.actuator, length) - start.heading).max() < STRAIGHT)
    status, ahead = _foreseen(problem, start, length, straight)
    # of a way that turns the last increment tells nothing
    start = start if straight else replace(start, drift=np.zeros_like(start.drift))
    reference = start.place + _drifted(start, length)
    needed = np.flatnonzero(status != OPEN)
    if needed.size == 0:
        needed, status, reference = _first_touching(problem, start, origin, gap_scale, status, reference)
    guess = start.place + start.drift[:, 0] * length  # where the skin will touch the faces
    return _Outset(start=start, status=status, reference=reference, guess=guess, needed=needed, ahead=ahead)


def _everywhere(
    increment: PatchProblem, origin: FloatArray, there: FloatArray | None, trial: Trial, status: np.ndarray
) -> _Everywhere:
    """What a patch's trial means for all nodes, whose unloaded places are `origin` (n, 2) [mm]."""
    nodes = increment.patch.nodes
    force, shearing, states = np.zeros(origin.shape), np.zeros(origin.shape[0]), np.full(origin.shape[0], OPEN)
    force[nodes], shearing[nodes], states[nodes] = trial.force.reshape(2, -1).T, trial.shearing, status
    moved = displacement(increment.problem, force, there)
    place, height = (origin + moved).T
    drop, slope = profile(increment.problem.row, place)
    return _Everywhere(
        force=force, shearing=shearing, status=states, moved=moved, place=place, gap=height + drop, slope=slope
    )


def _amiss(problem: ContactProblem, found: _Everywhere, there: FloatArray | None) -> float:
    """Largest displacement, gap or overlap [mm] by which contact is amiss as deformable faces give way where the skin
    touches them now, not `there`.
    """
    now = touch(problem, found.place)
    if there is None or now is None:
        return 0.0
    astray = face_displacement(problem, found.force, now) - face_displacement(problem, found.force, there)
    place = found.place + astray[:, 0]
    height = found.gap - profile(problem.row, found.place)[0] + astray[:, 1]
    gap = height + profile(problem.row, place)[0]
    closed = found.status != OPEN
    return max(largest_of(astray[closed]), largest_of(np.where(closed, gap, np.minimum(gap, 0.0))))


def _accepted(
    problem: ContactProblem,
    start: ContactState,
    actuator: FloatArray,
    found: _Everywhere,
    slip: FloatArray,
    residual: float,
) -> ContactState:
    """The converged state at the end of an increment, of which nodes slipped by `slip` (n,) [mm]."""
    length = largest_of(actuator - start.actuator)
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
        length=length,
        heading=_over(actuator - start.actuator, length),
        drift=_over(np.array([found.place - start.place, found.gap - start.gap]).T, length),
        trend=_over(found.force - start.force, length),
        largest_force=max(start.largest_force, largest_of(found.force)),
        dissipation=start.dissipation + work,
        residual=max(start.residual, residual),
    )


def _over(change: FloatArray, length: float) -> FloatArray:
    """A change over the length [mm] of an increment; zero where the actuators stand, as that promises nothing."""
    return change / length if length > 0.0 else np.zeros_like(change)


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
        return status, (status != OPEN) | (start.gap < TURNING * length)
    arrival = _arrival(start)
    closing = newly_touching(arrival < length, arrival, status, problem.actuator_of)
    slope = profile(problem.row, start.place + start.drift[:, 0] * length)[1]
    pressing, shearing = resolved(problem, start.force + start.trend * length, slope)
    opening = (status != OPEN) & (pressing < 0.0)
    sliding = (status == STICK) & (np.abs(shearing) > problem.friction * pressing)
    np.putmask(status, sliding, dragged(shearing))
    status[closing] = touched_status(problem)
    status[opening] = OPEN
    return status, (status != OPEN) | (arrival < FORESIGHT * length)


def _arrival(start: ContactState) -> FloatArray:
    """Way (n,) [mm] of the actuators after which open nodes touch if they go on as in the last increment; infinite for
    nodes that touch or do not come nearer.

    Beside a front of contact that advances evenly, gap to the power FRONT_POWER falls evenly.
    """
    gaps = np.array([start.gap - start.drift[:, 1] * start.length, start.gap])
    before, now = np.maximum(gaps, 0.0) ** FRONT_POWER
    nearer = (start.status == OPEN) & (now < before)
    arrival = np.full(start.gap.size, np.inf)
    arrival[nearer] = start.length * now[nearer] / (before - now)[nearer]
    return arrival


def _first_touching(
    problem: ContactProblem,
    start: ContactState,
    origin: FloatArray,
    gap_scale: float,
    status: np.ndarray,
    reference: FloatArray,
) -> tuple[np.ndarray, np.ndarray, FloatArray]:
    """Nodes (k,) with which contact begins, or the nearest if it does not, where nothing bears a force yet: all nodes
    lie where the actuators left them, at `origin` (n, 2) [mm]; then states (n,) and slip references (n,) [mm].
    """
    place, height = origin.T
    gap = height + profile(problem.row, place)[0]
    first = newly_touching(gap < -problem.tolerance * gap_scale, gap, status, problem.actuator_of)
    needed = np.flatnonzero(first) if first.any() else np.array([int(np.argmin(gap))])
    reference = touched_on_the_way(reference, start, place, gap, first)
    return needed, np.where(first, touched_status(problem), status), reference


def _drifted(start: ContactState, length: float) -> FloatArray:
    """Way (n,) [mm] along x that a node goes before it touches, which is no slip: zero for nodes in contact.

    An open node touches at the fraction of the increment at which its gap, extrapolated from the last increment,
    vanishes. Beside a front x falls behind as the gap does, so that one is as good a clock as the other.
    """
    closing = -start.drift[:, 1] * length
    with np.errstate(divide="ignore", invalid="ignore"):
        fraction = np.where(closing > 0.0, np.clip(start.gap / closing, 0.0, 1.0), 0.0)
    return np.where(start.status == OPEN, fraction * start.drift[:, 0] * length, 0.0)


def _residual(problem: ContactProblem, gap_scale: float, found: _Everywhere, slip: FloatArray) -> float:
    """Largest residual of equations and limits [1]: gaps and slips (n,) [mm] over the load, forces over the largest."""
    status = found.status
    pressing, shearing = resolved(problem, found.force, found.slope)
    excess = np.abs(shearing + problem.friction * SLIP_SIGN[status] * pressing)[status > STICK]
    # what rounding leaves of a force on a soft patch may be worth a large gap
    overlap = np.minimum(found.gap[status == OPEN], 0.0)
    displaced = np.concatenate([found.gap[status != OPEN], slip[status == STICK], overlap])
    return max(largest_of(displaced) / gap_scale, largest_of(excess) / max(largest_of(found.force), SMALLEST))
