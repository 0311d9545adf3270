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

from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property

import numpy as np

from .compliance import CondensedBody
from .profile import profile
from .scene import ActuatorRow, FloatArray


class Status(IntEnum):
    """State of a contact node. SLIP_FORWARD: the skin slides towards +x on the actuator."""

    OPEN = 0
    STICK = 1
    SLIP_FORWARD = 2
    SLIP_BACKWARD = 3


@dataclass(frozen=True)
class ContactProblem:
    """What does not change along a path.

    position: (n, 2) undeformed contact nodes [mm]. compliance: (2n, 2n) [mm per N/mm], ordered x0, y0, ...
    row: the actuators. body: condensed body of a deformable actuator, or None. friction: coefficient [1].
    tolerance: relative, on forces and gaps. max_cuts: halvings of an increment. patches: whether an increment takes
    only nodes in contact or about to be, or all. free: (n, 2) displacement of the nodes without contact forces [mm],
    of tissue linearised about a deformed state; None is zero. turning: whether the normal turns on rounded edges.
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

    @cached_property
    def actuator_of(self) -> np.ndarray:
        """Index (n,) of the actuator nearest to each undeformed node: the only one that it can touch."""
        return np.asarray(np.argmin(np.abs(self.position[:, [0]] - np.asarray(self.row.positions)), axis=1))


@dataclass(frozen=True)
class ContactState:
    """A converged state.

    actuator: (n_actuators, 2) displacement from the row's position [mm]. force: (n, 2) on the skin [N/mm].
    status: (n,) Status. place: (n,) x of each node from its actuator's centre [mm]. gap: (n,) [mm].
    heading: (n_actuators, 2) movement of the actuators in the last increment over its length [1], zero at rest.
    drift: (n, 2) change of place and gap over that length [1]. trend: (n, 2) change of force over it [N/mm²].
    dissipation: frictional work so far [N mm per mm]. residual: of the contact equations, relative, the largest so
    far [1]. iterations, cuts, searches: Newton iterations, halved increments and increments whose states did not settle
    all at once, so far.
    """

    actuator: FloatArray
    force: FloatArray
    status: np.ndarray
    place: FloatArray
    gap: FloatArray
    heading: FloatArray
    drift: FloatArray
    trend: FloatArray
    dissipation: float
    residual: float
    iterations: int
    cuts: int
    searches: int


def touching_height(problem: ContactProblem) -> float:
    """Height [mm] to which the actuators rise until the first skin node touches."""
    x = problem.position[:, 0] - np.asarray(problem.row.positions)[problem.actuator_of]
    return float(np.min(problem.position[:, 1] + profile(problem.row, x)[0]))


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
        actuator, nothing, status, x, gap, np.zeros((actuators, 2)), nothing, nothing, 0.0, 0.0, 0, 0, 0
    )


def unloaded(problem: ContactProblem, actuator: FloatArray) -> FloatArray:
    """Undeformed nodes (n, 2) [mm] in the frame of their actuator, which stands at `actuator` (n_actuators, 2)."""
    centre = np.stack([np.asarray(problem.row.positions), np.zeros(len(problem.row.positions))], axis=1)
    position = problem.position if problem.free is None else problem.position + problem.free
    return np.asarray(position - (actuator + centre)[problem.actuator_of])


def tilt(problem: ContactProblem, slope: FloatArray) -> FloatArray:
    """Slope (n,) [1] of the direction along which shearing forces act, where the profile has a slope (n,) [1]."""
    return slope if problem.turning else np.zeros_like(slope)


def resolved(force: FloatArray, tilted: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pressing and shearing forces (n,) [N/mm] of forces (n, 2) on the skin, across and along directions of a slope
    (n,) [1].
    """
    along, across = force.T
    if not tilted.any():
        return across, along
    shorter = 1.0 / np.sqrt(1.0 + tilted**2)
    return shorter * (across + tilted * along), shorter * (along - tilted * across)


def pressing_and_shearing(problem: ContactProblem, state: ContactState) -> tuple[FloatArray, FloatArray]:
    """Pressing and shearing forces (n,) [N/mm] of a state."""
    return resolved(state.force, tilt(problem, profile(problem.row, state.place)[1]))


def switch_friction(state: ContactState) -> ContactState:
    """A frictionless state on which friction acts from now on: what touches sticks, and bears no shear yet."""
    return replace(state, status=np.where(state.status == Status.OPEN, Status.OPEN, Status.STICK))


@dataclass(frozen=True)
class Touch:
    """Where skin nodes (n,) touch the deformable faces: three nodes (n, 3) each, of all faces' nodes one actuator after
    the other, and their shape functions (n, 3) there.
    """

    node: np.ndarray
    shape: FloatArray


def touch(problem: ContactProblem, place: FloatArray) -> Touch | None:
    """Where on their actuator's face the nodes are, from their places (n,) [mm]; None if the actuators are rigid."""
    if problem.body is None:
        return None
    node, shape = face_shape(problem.body, place)
    return Touch(node + (problem.actuator_of * problem.body.coordinate.size)[:, None], shape)


def displacement(problem: ContactProblem, force: FloatArray, there: Touch | None) -> FloatArray:
    """Displacement (n, 2) [mm] of the skin relative to the actuators' bases: C f and what their faces give way."""
    moved = (problem.compliance @ force.ravel()).reshape(-1, 2)
    if problem.body is None or there is None:
        return np.asarray(moved)
    actuators, size = len(problem.row.positions), problem.body.coordinate.size
    on_face = [
        np.bincount(there.node.ravel(), (there.shape * component[:, None]).ravel(), minlength=actuators * size)
        for component in force.T
    ]
    given = (np.stack(on_face, axis=1).reshape(actuators, -1) @ problem.body.compliance).reshape(-1, 2)
    return np.asarray(moved + np.einsum("ij,ijk->ik", there.shape, given[there.node]))


def face_compliance(problem: ContactProblem, there: Touch, nodes: np.ndarray) -> FloatArray:
    """Compliance (2b, 2b) [mm per N/mm] of deformable faces under some nodes (b,), ordered x0, x1, ..., y0, y1, ..."""
    found = np.zeros((2 * nodes.size, 2 * nodes.size))
    if problem.body is None:
        return found
    size = problem.body.coordinate.size
    for number in range(len(problem.row.positions)):
        own = np.flatnonzero(problem.actuator_of[nodes] == number)
        shape = np.zeros((own.size, size))
        np.put_along_axis(shape, there.node[nodes[own]] - number * size, there.shape[nodes[own]], axis=1)
        for i in (0, 1):
            for j in (0, 1):
                block = shape @ problem.body.compliance[i::2, j::2] @ shape.T
                found[np.ix_(i * nodes.size + own, j * nodes.size + own)] = block
    return found


def reevaluated_gap(problem: ContactProblem, state: ContactState) -> FloatArray:
    """Gaps (n,) [mm] computed anew from a state's forces, with the actuators' compliance where the skin now is."""
    there = touch(problem, state.place)
    x, y = (unloaded(problem, state.actuator) + displacement(problem, state.force, there)).T
    return np.asarray(y + profile(problem.row, x)[0])


def face_shape(body: CondensedBody, at: FloatArray) -> tuple[np.ndarray, FloatArray]:
    """Nodes (n, 3) of the face around coordinates (n,) [mm], and their second-order shape functions (n, 3) there, held
    at the face's ends beyond.
    """
    nodes = body.coordinate
    at = np.clip(at, nodes[0], nodes[-1])
    left = 2 * np.clip(np.searchsorted(nodes[::2], at, side="right") - 1, 0, nodes.size // 2 - 1)
    local = (at - nodes[left]) / (nodes[left + 2] - nodes[left])
    shape = np.stack(
        [(1.0 - local) * (1.0 - 2.0 * local), 4.0 * local * (1.0 - local), local * (2.0 * local - 1.0)], axis=1
    )
    return left[:, None] + np.arange(3), shape
