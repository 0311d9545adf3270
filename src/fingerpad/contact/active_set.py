"""States of contact that agree with their forces and gaps: a semismooth Newton method, as a primal-dual active set.

Every node of a patch is open, sticks or slips; the equations of that state are solved; forces and gaps then decide the
next state (Alart and Curnier 1991; Christensen et al. 1998; Hueeber and Wohlmuth 2005). What the states prescribe are
displacements: both components of a node that sticks, the one along the profile of a node that slips. Of the patch's
forces f = K u only few unknowns remain,
    slip:  T + z mu N = 0       for q_x, with u_y = -(y0 + d(q_x)) following the profile; z the sign of slip
    open:  f_x = f_y = 0        for u_x and u_y
and a change of state costs a small dense system.

As long as ever fewer nodes ask for another state, all of them change at once. If not, steps are damped by a line search
and one node of each actuator changes, then one of all, until fewer ask (block pivoting: Judice and Pires 1994).

The equations of every set of states have a determinant, and its sign tells more than whether they can be solved. Where
it is positive for all states the solution is unique, as without friction on a flat face, where K is positive definite.
A path from rest meets states of positive sign as long as it advances: sign and d(load)/d(path) change together. With
large friction, or skin on a steep wall, the sign of some states is negative (det k = k_xx + z mu k_yx for one node that
slips: Klarbring 1990). A solution there is one of three or more, and none that loading leads to: it is not accepted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..arrays import FloatArray
from ..errors import UniquenessError
from .formulation import OPEN, ContactProblem, ContactState, Status, resolved
from .not_converged import NotConvergedError
from .patch import Patch
from .profile import bend, profile

# Iterations [1] in which all nodes change state at once though no fewer ask for it, and then the worst of each actuator
# alone; source: fewest seconds of 3, 6, 12 (strokes of 0.02 to 0.6 mm, measured)
PATIENCE = 12
MAX_HALVINGS = 5  # of a Newton step in the line search [1]; source: 1/32 is below any step that was ever needed
# Relative residual [1] below which forces are good enough to judge a single node's state; source: chosen, far above
# rounding and far below the forces that decide
SETTLED = 1e-6
EACH = 0.01  # share [1] of the tolerance for each force, as errors add up in a gap; source: some 100 nodes

SMALLEST = float(np.finfo(float).tiny)  # N/mm, in place of no force at all
ROUNDING = float(np.finfo(float).eps)  # of a number [1]
STICK, SLIP_FORWARD, SLIP_BACKWARD = map(int, (Status.STICK, Status.SLIP_FORWARD, Status.SLIP_BACKWARD))
SLIP_SIGN = np.array([0.0, 0.0, 1.0, -1.0])  # direction of slip by Status
NOT_UNIQUE = "the states of contact have no unique solution there; try less friction, rounder edges, less movement"


@dataclass(frozen=True)
class PatchProblem:
    """What does not change while one increment is solved, of the patch's nodes.

    origin: (2, b) unloaded nodes from their actuator [mm]. bias: (2b,) displacements [mm] that take no force.
    gap_scale: what gaps and slips are compared with, the actuators' largest displacement and movement [mm].
    """

    problem: ContactProblem
    patch: Patch
    origin: FloatArray
    bias: FloatArray
    gap_scale: float

    @cached_property
    def force_floor(self) -> float:
        """Force [N/mm] whose tolerance is what the rounding of coordinates and displacements may leave of K u."""
        digit = ROUNDING * (largest_of(self.origin) + self.gap_scale)
        return digit * self.patch.stiffness_norm / self.problem.tolerance


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
class Trial:
    """Displacements (2b,) [mm] of the patch's nodes and the forces (2b,) [N/mm] they take, ordered x0, x1, ..., y0, y1,
    ...; places (b,), gaps (b,) [mm], slopes (b,) [1] of the profile there; pressing and shearing forces (b,) [N/mm].
    largest: force component [N/mm], or the floor.
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
class _Step:
    """Change (2b,) [mm] of the displacements in a Newton step, and the matrix (m, m) of its equations."""

    moved: FloatArray
    matrix: FloatArray

    @cached_property
    def turned(self) -> bool:
        """Whether the equations' determinant is negative."""
        return bool(np.linalg.slogdet(self.matrix).sign < 0.0)


@dataclass(frozen=True)
class _Patience:
    """Fewest nodes that asked for another state so far, and iterations since then in which no fewer did."""

    fewest: int
    waited: int = 0

    def after(self, asking: int) -> _Patience:
        """Once as many nodes have asked."""
        return _Patience(min(self.fewest, asking), 0 if asking < self.fewest else self.waited + 1)

    @property
    def spent(self) -> bool:
        """Whether nodes are to change one by one."""
        return self.waited >= PATIENCE

    @property
    def all_spent(self) -> bool:
        """Whether one of all is to change, no longer one of each actuator."""
        return self.waited >= 2 * PATIENCE


@dataclass(frozen=True)
class Settled:
    """Trial and states (b,) of a patch that agree, slip references (n,) [mm] of all nodes, with those of the patch that
    touched on the way, the iterations it took, and whether states settled only one node of an actuator at a time.
    """

    trial: Trial
    status: np.ndarray
    reference: FloatArray
    iterations: int
    searched: bool


def settle(
    increment: PatchProblem,
    start: ContactState,
    guess: FloatArray,
    status: np.ndarray,
    reference: FloatArray,
    done: int,
) -> Settled:
    """Trial and states that agree.

    guess, status: places [mm] and states (b,) to begin with. reference: (n,) [mm]. Raises NotConvergedError after
    problem.most_iterations, those `done` before included.
    """
    problem, nodes = increment.problem, increment.patch.nodes
    states = _states(problem, status)
    moved = np.concatenate([guess - increment.origin[0], np.zeros(nodes.size)])
    trial = _at(increment, moved, states, reference[nodes])
    released = np.zeros(nodes.size, dtype=bool)
    residual, turned, searched = float("inf"), False, False
    patience = _Patience(nodes.size + 1)
    for iteration in range(problem.most_iterations - done):
        step = _newton_step(increment, trial, states)
        if step is None:
            break
        turned = turned or (iteration >= PATIENCE and step.turned)
        trial = (_searched if patience.spent else _stepped)(increment, trial, step.moved, states, reference[nodes])
        slip = trial.place - reference[nodes]
        following = _next_status(increment, trial, slip, states.status, released)
        changed = (following != states.status).nonzero()[0]
        before, residual = residual, largest_of(_cone(trial, states))
        if changed.size == 0:
            # a residual that one more step did not lower is rounding
            if residual <= EACH * problem.tolerance or before <= residual <= problem.tolerance:
                if step.turned:
                    turned = True
                    break
                return Settled(_obeying(problem, trial, states), states.status, reference, iteration + 1, searched)
            continue
        if patience.spent and residual > SETTLED:
            continue
        patience = patience.after(changed.size)
        if patience.spent:
            searched = True
            changed = _worst(increment, trial, slip, states.status, changed, patience.all_spent)
        was, now = states.status[changed], following[changed]
        touching = changed[(was == OPEN) & ~released[changed]]
        released[changed[now == OPEN]] = True
        states = _changed(problem, states, changed, now)
        if touching.size:
            reference = _touched_there(reference, start, nodes, trial, touching)
        if ((was == OPEN) | (now == STICK)).any():  # nodes come to the profile or stop; others are where they were
            trial = _at(increment, trial.moved, states, reference[nodes])
    raise NotConvergedError(residual, UniquenessError(NOT_UNIQUE) if turned else None)


def _states(problem: ContactProblem, status: np.ndarray) -> _States:
    """What nodes in those states (b,) do."""
    slip, open_ = (status > STICK).nonzero()[0], (status == OPEN).nonzero()[0]
    drag = problem.friction * SLIP_SIGN[status[slip]]
    return _States(status, open_, slip, drag, np.concatenate([slip, open_, status.size + open_]))


def _changed(problem: ContactProblem, states: _States, nodes: np.ndarray, now: np.ndarray) -> _States:
    """States once some nodes (k,) are in others (k,)."""
    status = states.status.copy()
    status[nodes] = now
    return _states(problem, status)


def _touched_there(
    reference: FloatArray, start: ContactState, nodes: np.ndarray, trial: Trial, touching: np.ndarray
) -> FloatArray:
    """Slip references (n,) [mm] once these of the patch's nodes touch."""
    place, gap = start.place.copy(), start.gap.copy()
    place[nodes], gap[nodes] = trial.place, trial.gap
    mask = np.zeros(start.place.size, dtype=bool)
    mask[nodes[touching]] = True
    return touched_on_the_way(reference, start, place, gap, mask)


def _at(increment: PatchProblem, moved: FloatArray, states: _States, reference: FloatArray) -> Trial:
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
    largest = max(largest_of(force), increment.force_floor, SMALLEST)
    return Trial(
        moved=moved,
        force=force,
        place=place,
        gap=height - touching,
        slope=slope,
        pressing=pressing,
        shearing=shearing,
        largest=largest,
    )


def _newton_equations(increment: PatchProblem, trial: Trial, states: _States) -> tuple[FloatArray, FloatArray]:
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


def _newton_step(increment: PatchProblem, trial: Trial, states: _States) -> _Step | None:
    """The Newton step within the given states; None if its equations are singular."""
    moved = np.zeros(2 * states.status.size)
    matrix, right = _newton_equations(increment, trial, states)
    try:
        moved[states.unknown] = np.linalg.solve(matrix, right)
    except np.linalg.LinAlgError:
        return None
    return _Step(moved, matrix) if np.isfinite(moved).all() else None


def _stepped(increment: PatchProblem, trial: Trial, step: FloatArray, states: _States, reference: FloatArray) -> Trial:
    """The trial after a whole step."""
    return _at(increment, trial.moved + step, states, reference)


def _searched(increment: PatchProblem, trial: Trial, step: FloatArray, states: _States, reference: FloatArray) -> Trial:
    """The first point on the way back from `step` to `trial` where the residuals have become smaller."""
    before = np.linalg.norm(_cone(trial, states))
    for halvings in range(MAX_HALVINGS + 1):
        there = _at(increment, trial.moved + step / 2.0**halvings, states, reference)
        if np.linalg.norm(_cone(there, states)) < before:
            break
    return there


def _obeying(problem: ContactProblem, trial: Trial, states: _States) -> Trial:
    """The trial with the forces that the states prescribe, to the last bit."""
    pressing, shearing = trial.pressing.copy(), trial.shearing.copy()
    pressing[states.open] = shearing[states.open] = 0.0
    shearing[states.slip] = -states.drag * pressing[states.slip]
    across, along = resolved(problem, np.array([shearing, pressing]).T, -trial.slope)  # turned back
    return replace(trial, force=np.concatenate([along, across]), pressing=pressing, shearing=shearing)


def _cone(trial: Trial, states: _States) -> FloatArray:
    """Residuals of slipping and open nodes' equations [1]: what slipping nodes' forces lack to the cone of friction,
    and open nodes' to zero, over the largest force.
    """
    shearing, pressing = trial.shearing, trial.pressing
    excess = shearing[states.slip] + states.drag * pressing[states.slip]
    return np.concatenate([excess, shearing[states.open], pressing[states.open]]) / trial.largest


def _next_status(
    increment: PatchProblem, trial: Trial, slip: FloatArray, status: np.ndarray, released: np.ndarray
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
    touching = newly_touching(overlapping, trial.gap, status, problem.actuator_of[increment.patch.nodes])
    np.putmask(following, touching, touched_status(problem))
    if problem.friction > 0.0:
        np.putmask(following, touching & released, np.where(slip > 0.0, SLIP_FORWARD, SLIP_BACKWARD))
        kept = following == status
        beyond = np.abs(shearing) > problem.friction * pressing + small_force
        np.putmask(following, kept & (status == STICK) & beyond, dragged(shearing))
        np.putmask(following, kept & (SLIP_SIGN[status] * slip < -small_gap), STICK)
    return following


def newly_touching(overlapping: np.ndarray, gap: FloatArray, status: np.ndarray, actuator_of: np.ndarray) -> np.ndarray:
    """Which open nodes (n,) touch, of those that overlap: on an actuator that touches none, the deepest alone. What it
    bears moves its neighbours away, and they would have to be released one by one.
    """
    if not overlapping.any():
        return overlapping
    touched = np.zeros(int(actuator_of.max()) + 1, dtype=bool)
    touched[actuator_of[status != OPEN]] = True
    alone = overlapping & ~touched[actuator_of]
    touching = overlapping & ~alone
    for actuator in np.unique(actuator_of[alone]):
        depth = np.where(alone & (actuator_of == actuator), -gap, -np.inf)
        touching[np.argmax(depth)] = True
    return touching


def touched_status(problem: ContactProblem) -> int:
    """State in which a node begins its contact; without friction all slip is alike."""
    return STICK if problem.friction > 0.0 else SLIP_FORWARD


def touched_on_the_way(
    reference: FloatArray, start: ContactState, place: FloatArray, gap: FloatArray, nodes: np.ndarray
) -> FloatArray:
    """Slip references (n,) [mm] once nodes (n,) touch. Those that were not coming nearer do so on their way to `place`
    and `gap` (n,) [mm], which is further than they go, as others bear them up once they touch.
    """
    came = nodes & (start.status == OPEN) & (start.drift[:, 1] >= 0.0)
    fraction = np.clip(start.gap[came] / (start.gap[came] - gap[came]), 0.0, 1.0)
    touched = reference.copy()
    touched[came] = start.place[came] + fraction * (place[came] - start.place[came])
    return touched


def dragged(shearing: FloatArray) -> np.ndarray:
    """Slip (n,) that goes with shearing forces (n,): the skin is dragged to +x where they point to -x."""
    return np.where(shearing < 0.0, SLIP_FORWARD, SLIP_BACKWARD)


def _worst(
    increment: PatchProblem, trial: Trial, slip: FloatArray, status: np.ndarray, changed: np.ndarray, alone: bool
) -> np.ndarray:
    """Of the patch's nodes (k,) that ask for another state the one of each actuator that is farthest beyond its own; or
    of all of them one alone, as two that mirror may go in circles together.
    """
    beyond = _violation(increment, trial, slip, status)[changed]
    if alone:
        return changed[[int(np.argmax(beyond))]]
    actuator = increment.problem.actuator_of[increment.patch.nodes[changed]]
    order = np.lexsort((beyond, actuator))
    last = np.append(np.diff(actuator[order]) != 0, True)
    return changed[order[last]]


def _violation(increment: PatchProblem, trial: Trial, slip: FloatArray, status: np.ndarray) -> FloatArray:
    """How far (b,) [mm] each node is beyond its state: gaps and slips as such, forces as the motion they cause."""
    friction, pressing, shearing = increment.problem.friction, trial.pressing, trial.shearing
    along, across = 1.0 / np.diag(increment.patch.response).reshape(2, -1)
    tension = np.maximum(-pressing, 0.0) * across
    excess = np.maximum(np.abs(shearing) - friction * np.maximum(pressing, 0.0), 0.0) * along
    reverse = np.maximum(-SLIP_SIGN[status] * slip, 0.0) * (friction > 0.0)
    in_contact = np.maximum(tension, np.where(status == STICK, excess, reverse))
    return np.where(status == OPEN, np.maximum(-trial.gap, 0.0), in_contact)


def largest_of(values: FloatArray) -> float:
    """Largest magnitude, zero of none."""
    return float(np.abs(values).max(initial=0.0))
