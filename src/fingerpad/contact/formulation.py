"""Unilateral frictional contact with finite sliding, on the condensed compliance: the problem and its states.

Unknowns are the nodal forces of the actuators on the skin, f (n, 2) [N per mm of thickness]. The skin's contact nodes
move by C f, and where a node then *is* relative to its actuator decides gap and slip (finite sliding):
    q = X + C f - (actuator position),    gap g = q_y + d(q_x),
    0 <= N  complementary to  g >= 0                                                     (unilateral contact)
    |T| <= mu N,  and the skin slides (q_x leaves its reference) only against T = -+ mu N              (Coulomb)
with d the actuator's profile and the reference of q_x its value at the end of the last increment, or where the node
touched (backward Euler in slip). Pressing force N and shearing force T are resolved
    along the face, N = f_y, T = f_x: the slope of rounded edges shapes the gap alone, as in Hertz's theory, which is
        consistent with small kinematics (docs/decisions/0002);
    along the profile's own tangent where the normal is `turning` (docs/decisions/0021).
A deformable actuator adds the compliance of its face, at the points where the skin touches it.

`increment` solves one increment of a path, `path` follows it, `indentation` knows where pre-indentation ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray
from ..scene.device import ActuatorRow
from ..tissue.compliance import CondensedBody
from .profile import profile, touching_heights


class Status(IntEnum):
    """State of a contact node. SLIP_FORWARD: the skin slides towards +x on the actuator."""

    OPEN = 0
    STICK = 1
    SLIP_FORWARD = 2
    SLIP_BACKWARD = 3


OPEN = int(Status.OPEN)  # which arrays are compared with faster
# Power [1] of the skin's height over a face that grows evenly from the front of contact on, since skin leaves the face
# as distance to the power 3/2; source: Hertz (Johnson 1985, Contact Mechanics, section 4.2)
FRONT_POWER = 2.0 / 3.0
# Gauss-Jacobi on half a hat, exact for cubics: distances from its top over its width [1], weights [1] with a sum of one
HAT_POINTS = np.array([0.4 - np.sqrt(0.06), 0.4 + np.sqrt(0.06)])
HAT_WEIGHTS = np.array([0.5 + 1.0 / np.sqrt(54.0), 0.5 - 1.0 / np.sqrt(54.0)])


@dataclass(frozen=True)
class ContactProblem:
    """What does not change along a path.

    position: (n, 2) undeformed contact nodes [mm]. compliance: (2n, 2n) [mm per N/mm], ordered x0, y0, ...
    row: the actuators. body: condensed body of a deformable actuator, or None. friction: coefficient [1].
    tolerance: relative, on forces and gaps. max_cuts: halvings of an increment. patches: whether an increment takes
    only nodes in contact or about to be, or all. free: (n, 2) displacement of the nodes without contact forces [mm],
    of tissue linearised about a deformed state; None is zero. turning: whether the normal turns on rounded edges.
    given: index (n,) of the actuator that each node is given to, and of no other; None is the one nearest to
    undeformed skin. It changes along a path, with `ContactState.given`.
    images: how many like it there are [1]: two where it is one half of a row that mirrors.
    """

    position: FloatArray
    compliance: FloatArray
    row: ActuatorRow
    body: CondensedBody | None
    friction: float
    tolerance: float
    max_cuts: int
    patches: bool = True
    free: FloatArray | None = None
    turning: bool = False
    given: np.ndarray | None = None
    images: int = 1

    @cached_property
    def actuator_of(self) -> np.ndarray:
        """Index (n,) of the actuator that each node is given to: the only one that it can touch."""
        return self.row.nearest(self.position[:, 0]) if self.given is None else self.given

    @cached_property
    def spans(self) -> tuple[slice, ...]:
        """The nodes of each actuator, which lie side by side where nodes come by ascending x."""
        count = len(self.row.positions)
        bounds = np.searchsorted(self.actuator_of, np.arange(count + 1))
        return tuple(slice(int(start), int(stop)) for start, stop in pairwise(bounds))

    @cached_property
    def spacing(self) -> float:
        """Smallest distance [mm] along x of two neighbouring nodes."""
        return float(np.abs(np.diff(self.position[:, 0])).min(initial=np.inf))

    @cached_property
    def hats(self) -> tuple[FloatArray, FloatArray]:
        """How far (2, n) [mm] the hat of each node reaches to its left (below zero) and right: to the next nodes of its
        actuator, on the undeformed skin; and the share (2, n) [1] of it there.
        """
        reach = np.zeros((2, self.position.shape[0]))
        for own in self.spans:
            width = np.diff(self.position[own, 0])
            if width.size:  # the outermost have a neighbour on one side alone
                reach[:, own] = np.append(width[:1], width), np.append(width, width[-1:])
        whole = reach.sum(axis=0)
        shares = np.divide(reach, whole, out=np.full_like(reach, 0.5), where=whole > 0.0)
        return reach * np.array([[-1.0], [1.0]]), shares


@dataclass(frozen=True)
class ContactState:
    """A converged state.

    actuator: (n_actuators, 2) displacement from the row's position [mm]. force: (n, 2) on the skin [N/mm].
    given: (n,) index of the actuator that each node may touch. status: (n,) Status. place: (n,) x of each node from
    that actuator's centre [mm]. gap: (n,) [mm].
    length: of the last increment, the largest movement of an actuator [mm]; zero at rest. heading: (n_actuators, 2)
    movement of the actuators over that length [1]. drift: (n, 2) change of place and gap over it [1]. trend: (n, 2)
    change of force over it [N/mm²].
    largest_force: largest component of a node's force so far [N/mm]. dissipation: frictional work so far [N mm per
    mm]. residual: of the contact equations, relative, the largest so far [1]. iterations, cuts, searches: Newton
    iterations, halved increments and increments whose states did not settle all at once, so far.
    """

    actuator: FloatArray
    force: FloatArray
    given: np.ndarray
    status: np.ndarray
    place: FloatArray
    gap: FloatArray
    length: float
    heading: FloatArray
    drift: FloatArray
    trend: FloatArray
    largest_force: float
    dissipation: float
    residual: float
    iterations: int
    cuts: int
    searches: int


def touching_height(problem: ContactProblem) -> float:
    """Height [mm] to which all actuators rise until the first touches undeformed skin."""
    return float(touching_heights(problem.row, problem.position).min())


def rest(problem: ContactProblem, height: float) -> ContactState:
    """The unloaded state with all actuators at `height` [mm] and nothing pressed yet."""
    count, actuators = problem.position.shape[0], len(problem.row.positions)
    actuator = np.zeros((actuators, 2))
    actuator[:, 1] = height
    x, y = unloaded(problem, actuator).T
    nothing = np.zeros((count, 2))
    status = np.full(count, int(Status.OPEN))
    gap = y + profile(problem.row, x)[0]
    return ContactState(
        actuator=actuator,
        force=nothing,
        given=problem.actuator_of,
        status=status,
        place=x,
        gap=gap,
        length=0.0,
        heading=np.zeros((actuators, 2)),
        drift=nothing,
        trend=nothing,
        largest_force=0.0,
        dissipation=0.0,
        residual=0.0,
        iterations=0,
        cuts=0,
        searches=0,
    )


def unloaded(problem: ContactProblem, actuator: FloatArray) -> FloatArray:
    """Undeformed nodes (n, 2) [mm] in the frame of their actuator, which stands at `actuator` (n_actuators, 2)."""
    centre = np.stack([problem.row.positions, np.zeros(len(problem.row.positions))], axis=1)
    position = problem.position if problem.free is None else problem.position + problem.free
    return np.asarray(position - (actuator + centre)[problem.actuator_of])


def given_as(problem: ContactProblem, state: ContactState) -> ContactProblem:
    """The problem with its nodes given to the actuators that they have in a state."""
    return problem if np.array_equal(problem.actuator_of, state.given) else replace(problem, given=state.given)


def given_anew(problem: ContactProblem, state: ContactState) -> tuple[ContactProblem, ContactState]:
    """Problem and state with open nodes given to the actuator that they are nearest to now, as skin goes sideways.
    Nodes beside contact stay, as hats there reach to them, and so does the order of actuators along the skin.
    """
    own, nearest = state.given, nearest_now(problem, state)
    if np.array_equal(nearest, own):  # as nearly always
        return given_as(problem, state), state
    touching = state.status != OPEN
    kept = touching.copy()
    kept[1:] |= touching[:-1]
    kept[:-1] |= touching[1:]
    if (kept | (nearest == own)).all():
        return given_as(problem, state), state
    wanted = np.where(kept, own, nearest)
    least = np.maximum.accumulate(np.where(touching, own, 0))
    most = np.minimum.accumulate(np.where(touching, own, own[-1])[::-1])[::-1]
    return given_to(problem, state, np.maximum.accumulate(np.clip(wanted, least, most)))


def given_to(problem: ContactProblem, state: ContactState, given: np.ndarray) -> tuple[ContactProblem, ContactState]:
    """Problem and state with nodes given to other actuators (n,), which they do not touch yet."""
    own, moved = state.given, state.given != given
    aside, above = (_centres(problem, state)[own] - _centres(problem, state)[given]).T
    place = state.place + aside
    height = state.gap - profile(problem.row, state.place)[0] + above
    anew = replace(
        state,
        given=given,
        status=np.where(moved, OPEN, state.status),
        place=place,
        gap=height + profile(problem.row, place)[0],
        drift=np.where(moved[:, None], 0.0, state.drift),  # over another actuator it promises nothing
        trend=np.where(moved[:, None], 0.0, state.trend),
    )
    return given_as(problem, anew), anew


def nearest_now(problem: ContactProblem, state: ContactState) -> np.ndarray:
    """Index (n,) of the actuator whose centre is nearest along x to where each node is now."""
    centre = state.actuator[:, 0] + problem.row.positions
    between = (centre[1:] + centre[:-1]) / 2.0
    return np.asarray(np.searchsorted(between, state.place + centre[state.given]))


def overlapped(problem: ContactProblem, state: ContactState, allowed: float) -> np.ndarray:
    """Nodes (n,) that overlap, by more than is allowed [mm], the actuator that they are nearest to but not given to."""
    nearest = nearest_now(problem, state)
    astray = np.asarray(nearest != state.given)
    if astray.any():
        astray &= given_to(problem, state, nearest)[1].gap < -allowed
    return astray


def handed_over(problem: ContactProblem, state: ContactState, allowed: float) -> np.ndarray:
    """Index (n,) of the actuators that nodes are to be given to where some have come over another one than their own:
    as in the state, but for these. Actuators stay in order along the skin.
    """
    own, astray = state.given, overlapped(problem, state, allowed)
    if not astray.any():
        return own
    wanted = np.where(astray, nearest_now(problem, state), own)
    rightwards = np.maximum.accumulate(np.maximum(wanted, own))
    return np.asarray(np.minimum.accumulate(np.where(wanted < own, wanted, rightwards)[::-1])[::-1])


def _centres(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Where the middles of the faces are (n_actuators, 2) [mm]."""
    resting = np.stack([problem.row.positions, np.zeros(len(problem.row.positions))], axis=1)
    return np.asarray(state.actuator + resting)


def resolved(problem: ContactProblem, force: FloatArray, slope: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pressing and shearing forces (n,) [N/mm] of forces (n, 2) on the skin: across and along the face or, where the
    normal turns, the profile's slope (n,) [1].
    """
    along, across = force.T
    if not problem.turning:
        return across, along
    shorter = 1.0 / np.sqrt(1.0 + slope**2)
    return shorter * (across + slope * along), shorter * (along - slope * across)


def shearing_and_pressing(problem: ContactProblem, states: Sequence[ContactState]) -> FloatArray:
    """Shearing and pressing forces (n_states, n, 2) [N/mm] of several states."""
    found = [resolved(problem, state.force, profile(problem.row, state.place)[1]) for state in states]
    return np.array([np.stack([shearing, pressing], axis=1) for pressing, shearing in found])


def switch_friction(state: ContactState) -> ContactState:
    """A frictionless state on which friction acts from now on: what touches sticks, and bears no shear yet."""
    return replace(state, status=np.where(state.status == Status.OPEN, Status.OPEN, Status.STICK))


def touch(problem: ContactProblem, place: FloatArray) -> FloatArray | None:
    """Where skin nodes at their places (n,) [mm] touch the deformable faces: shape functions (n, k) of the k nodes of
    their actuator's face there; None if the actuators are rigid.

    A node's force is spread over the skin under its hat, and its place is the mean there: so it feels the face's mean
    there too (docs/decisions/0024).
    """
    if problem.body is None:
        return None
    sides, shares = problem.hats
    at = place - sides.sum(axis=0) / 3.0 + HAT_POINTS[:, None, None] * sides
    weight = HAT_WEIGHTS[:, None, None] * shares
    return face_shape(problem.body, at.reshape(-1, place.size), weight.reshape(-1, place.size))


def displacement(problem: ContactProblem, force: FloatArray, there: FloatArray | None) -> FloatArray:
    """Displacement (n, 2) [mm] of the skin relative to the actuators' bases: C f and what their faces give way."""
    moved = np.asarray((problem.compliance @ force.ravel()).reshape(-1, 2))
    return moved if there is None else moved + given_way(problem, force, there)


def given_way(problem: ContactProblem, force: FloatArray, there: FloatArray | None) -> FloatArray:
    """By how much (n, 2) [mm] deformable faces give way under forces (n, 2) [N/mm] on skin that touches `there`."""
    given = np.zeros_like(force)
    if problem.body is not None and there is not None:
        for own in problem.spans:
            shape = there[own]
            given[own] = shape @ (problem.body.compliance @ (shape.T @ force[own]).ravel()).reshape(-1, 2)
    return given


def face_compliance(problem: ContactProblem, there: FloatArray, nodes: np.ndarray) -> FloatArray:
    """Compliance (2b, 2b) [mm per N/mm] of deformable faces under some nodes (b,), ascending, ordered x0, x1, ..., y0,
    y1, ...
    """
    found = np.zeros((2, nodes.size, 2, nodes.size))
    if problem.body is not None:
        size = problem.body.coordinate.size
        for span in problem.spans:
            own = slice(*np.searchsorted(nodes, [span.start, span.stop]))
            shape = there[nodes[own]]
            count = shape.shape[0]
            by_face = (shape @ problem.body.compliance.reshape(size, -1)).reshape(count, 2, size, 2)
            by_skin = by_face.transpose(1, 0, 3, 2).reshape(-1, size) @ shape.T
            found[:, own, :, own] = by_skin.reshape(2, count, 2, count)
    return found.reshape(2 * nodes.size, 2 * nodes.size)


def reevaluated_gap(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Gaps (n,) [mm] computed again from a state's forces, with the actuators' compliance where the skin now is."""
    problem = given_as(problem, state)
    there = touch(problem, state.place)
    x, y = (unloaded(problem, state.actuator) + displacement(problem, state.force, there)).T
    return np.asarray(y + profile(problem.row, x)[0])


def face_shape(body: CondensedBody, at: FloatArray, weight: FloatArray) -> FloatArray:
    """Second-order shape functions (n, k) of the face's k nodes: means of those at coordinates (p, n) [mm], held at the
    face's ends beyond, with weights (p, n) [1].
    """
    nodes, count = body.coordinate, at.shape[1]
    at = np.minimum(np.maximum(at, nodes[0]), nodes[-1])
    left = 2 * np.minimum(np.searchsorted(nodes[2::2], at, side="right"), nodes.size // 2 - 1)
    local = (at - nodes[left]) / (nodes[left + 2] - nodes[left])
    values = weight * np.array(
        [(1.0 - local) * (1.0 - 2.0 * local), 4.0 * local * (1.0 - local), local * (2.0 * local - 1.0)]
    )
    place = left + nodes.size * np.arange(count) + np.arange(3)[:, None, None]
    shape = np.bincount(place.ravel(), values.ravel(), minlength=count * nodes.size)
    return np.asarray(shape, dtype=float).reshape(count, nodes.size)
