"""A solved condition: what is kept of it, whatever tissue it was solved on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..readouts.strain import Reading, read_receptors
from ..scene.device import ActuatorRow, Condition
from ..tissue.compliance import CondensedSection
from .certificate import Certificate
from .depth import depth
from .formulation import (
    ContactProblem,
    ContactState,
    Status,
    actuator_forces,
    shearing_and_pressing,
    touching_height,
)


@dataclass(frozen=True)
class Solution:
    """A solved condition.

    height: of the faces above the lowest point of the undeformed pad after pre-indentation [mm]. indentation: how far
    they rose from first touch on until then [mm]. depth: largest height of an actuator above that at which it first
    touches undeformed skin [mm], at any time. position: (n, 2) of the contact
    nodes on undeformed skin [mm]. After pre-indentation and at the stimulus's times: force: (1 + n_times, n, 2) [N/mm]
    on the nodes, x and y; contact: (1 + n_times, n, 2) shearing and pressing forces [N/mm], which are the same but
    where the normal turns; actuator_force: (1 + n_times, n_actuators, 2) with which actuators act on the skin [N/mm],
    x and y. indented_actuator: (n,) index of the actuator that each node may touch after pre-indentation. arc: (m,)
    receptors [mm]. reading: what they say [1], and when. At that time: pressure, shear: (n,) [MPa]; actuator: (n,)
    index of the one that a skin node may touch; place: (n,) x of the skin nodes from that actuator's centre [mm];
    status: (n,). iterations, cuts, searches: of the whole path, as far as it was kept. certificate.
    """

    height: float
    indentation: float
    depth: float
    position: FloatArray
    indented_actuator: np.ndarray
    force: FloatArray
    contact: FloatArray
    actuator_force: FloatArray
    arc: FloatArray
    reading: Reading
    pressure: FloatArray
    shear: FloatArray
    actuator: np.ndarray
    place: FloatArray
    status: np.ndarray
    iterations: int
    cuts: int
    searches: int
    certificate: Certificate

    @property
    def pressing(self) -> FloatArray:
        """Forces f_y (1 + n_times, n_actuators) [N/mm] after pre-indentation and at the stimulus's times."""
        return self.actuator_force[:, :, 1]

    @property
    def sliding_share(self) -> float:
        """Share [1] of the pressing force that sliding skin bears at the time that is read: all of it without
        friction; not a number where nothing touches.
        """
        pressing = self.contact[1 + self.reading.time, :, 1]
        slides = (self.status == Status.SLIP_FORWARD) | (self.status == Status.SLIP_BACKWARD)
        return float(pressing[slides].sum() / total) if (total := pressing.sum()) > 0.0 else math.nan

    def skin_x(self, row: ActuatorRow, condition: Condition) -> FloatArray:
        """Where the skin nodes are (n,) [mm] along the row at the time that is read, of a row and its condition."""
        centre = np.asarray(row.positions) + condition.tangential[self.reading.time]
        return centre[self.actuator] + self.place


def solution(
    problem: ContactProblem,
    section: CondensedSection,
    states: Sequence[ContactState],
    strains: FloatArray,
    certificate: Certificate,
    settling: int,
) -> Solution:
    """Gather a solution from the pre-indented state and those at the stimulus's times, and the receptors' strains
    (1 + n_times, 3m) [1] in them, which may be read after so many times of settling.
    """
    reading = read_receptors(strains, section.arc, settling=settling, mirrors=problem.row.mirrors)
    before, last, shown = states[0], states[-1], states[1 + reading.time]
    contact = shearing_and_pressing(problem, states)
    height = float(before.actuator[0, 1])
    return Solution(
        height=height,
        indentation=height - touching_height(problem),
        depth=depth(problem, np.array([state.actuator for state in states])),
        position=section.position,
        indented_actuator=before.given,
        force=np.array([state.force for state in states]),
        contact=contact,
        arc=section.arc,
        reading=reading,
        pressure=contact[1 + reading.time, :, 1] / section.weight,
        shear=contact[1 + reading.time, :, 0] / section.weight,
        actuator_force=actuator_forces(problem, states),
        actuator=shown.given,
        place=shown.place,
        status=shown.status,
        iterations=last.iterations,
        cuts=last.cuts,
        searches=last.searches,
        certificate=certificate,
    )
