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
A deformable actuator adds the compliance of its face, at the points where the skin touches it (`faces`).

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
    """State of a contact node. SLIP_FORWARD: the skin slides towards +x on the actuator. Both slips come after all
    others: what slips is `> STICK`.
    """

    OPEN = 0
    STICK = 1
    SLIP_FORWARD = 2
    SLIP_BACKWARD = 3


MAX_ITERATIONS = 60  # of Newton within one increment before it is halved [1]; source: usual count is 2-6 (measured)
OPEN = int(Status.OPEN)  # which arrays are compared with faster
# Power [1] of the skin's height over a face that grows evenly from the front of contact on, since skin leaves the face
# as distance to the power 3/2; source: Hertz (Johnson 1985, Contact Mechanics, section 4.2)
FRONT_POWER = 2.0 / 3.0


@dataclass(frozen=True)
class ContactProblem:
    """Skin, actuators and the laws of their contact: what a path of states is followed on. Along the path it
    differs in `given`, which follows the states (`ownership.given_as`), in `most_iterations` on the last try
    (`path.advance`), and in `free` and `compliance` where tissue creeps or deforms (`path.drifting_to`, `deformed`).

    position: (n, 2) undeformed contact nodes [mm]. compliance: (2n, 2n) [mm per N/mm], ordered x0, y0, ...
    row: the actuators. body: condensed body of a deformable actuator, or None. friction: coefficient [1].
    tolerance: relative, on forces and gaps. max_cuts: halvings of an increment. patches: whether an increment takes
    only nodes in contact or about to be, or all. free: (n, 2) displacement of the nodes without contact forces [mm],
    of tissue linearised about a deformed state; None is zero. turning: whether the normal turns on rounded edges.
    given: index (n,) of the actuator that each node is given to, and of no other; None is the one nearest to
    undeformed skin. images: how many like it there are [1]: two where it is one half of a row that mirrors.
    most_iterations: of Newton within one increment before it is halved [1].
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
    most_iterations: int = MAX_ITERATIONS

    @property
    def halved(self) -> bool:
        """Whether it is one half of a row that mirrors, the right one."""
        return self.images > 1

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
    iterations, halved increments and increments whose states did not settle all at once, so far, of what was kept.
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
    status = np.full(count, OPEN)
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
    position = problem.position if problem.free is None else problem.position + problem.free
    return position - centres(problem, actuator)[problem.actuator_of]


def centres(problem: ContactProblem, actuator: FloatArray) -> FloatArray:
    """Middles of the faces (n_actuators, 2) [mm] of actuators at `actuator` (n_actuators, 2)."""
    resting = np.stack([problem.row.positions, np.zeros(len(problem.row.positions))], axis=1)
    return resting + actuator


def resolved(problem: ContactProblem, force: FloatArray, slope: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Pressing and shearing forces (n,) [N/mm] of forces (n, 2) on the skin: across and along the face or, where the
    normal turns, the profile's slope (n,) [1].
    """
    along, across = force.T
    if not problem.turning:
        return across, along
    shorter = 1.0 / np.sqrt(1.0 + slope**2)
    return shorter * (across + slope * along), shorter * (along - slope * across)


def actuator_force(problem: ContactProblem, force: FloatArray, given: np.ndarray) -> FloatArray:
    """Forces (n_actuators, 2) [N/mm] with which the actuators act on the skin, from those on its nodes (n, 2) and which
    actuator each node (n,) is given to.
    """
    found = np.zeros((len(problem.row.positions), 2))
    np.add.at(found, given, force)
    return found


def actuator_forces(problem: ContactProblem, states: Sequence[ContactState]) -> FloatArray:
    """`actuator_force` (n_states, n_actuators, 2) [N/mm] in several states."""
    return np.array([actuator_force(problem, state.force, state.given) for state in states])


def shearing_and_pressing(problem: ContactProblem, states: Sequence[ContactState]) -> FloatArray:
    """Shearing and pressing forces (n_states, n, 2) [N/mm] of several states."""
    found = [resolved(problem, state.force, profile(problem.row, state.place)[1]) for state in states]
    return np.array([np.stack([shearing, pressing], axis=1) for pressing, shearing in found])


def switch_friction(state: ContactState) -> ContactState:
    """A frictionless state on which friction acts from now on: what touches sticks, and bears no shear yet."""
    return replace(state, status=np.where(state.status == OPEN, OPEN, int(Status.STICK)))
