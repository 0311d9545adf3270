"""A solved condition: what is kept of it, whatever tissue it was solved on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..readouts.strain import read_receptors
from ..scene.readout import Readout
from ..tissue.compliance import CondensedSection
from .certificate import Certificate
from .depth import depth
from .formulation import ContactProblem, ContactState, shearing_and_pressing


@dataclass(frozen=True)
class Solution:
    """A solved condition.

    indentation: height of the faces above the lowest point of the undeformed pad [mm]. depth: largest height of an
    actuator above that at which it first touches undeformed skin [mm], at any time. position: (n, 2) of the contact
    nodes on undeformed skin [mm]. indented_force: (n, 2) [N/mm] after pre-indentation. force: (n_times, n, 2) [N/mm] at
    the stimulus's times. contact: (1 + n_times, n, 2) shearing and pressing forces [N/mm] then and before, which are
    `forces` but where the normal turns. read: index of the time at which receptors are read (`strain.Reading`). What
    follows is at that time. pressure, shear: (n,) [MPa]. place: (n,) x of the skin nodes from their actuator's centre
    [mm]. status: (n,). arc: (m,) receptors [mm]. strain, change_of_strain: (m,) [1]. rival_peak: change at the time
    that comes next to being read over that which is read [1] (`strain.Reading`). iterations, cuts, searches: of the
    whole path. certificate.
    """

    indentation: float
    depth: float
    position: FloatArray
    indented_force: FloatArray
    force: FloatArray
    contact: FloatArray
    read: int
    pressure: FloatArray
    shear: FloatArray
    place: FloatArray
    status: np.ndarray
    arc: FloatArray
    strain: FloatArray
    change_of_strain: FloatArray
    rival_peak: float
    iterations: int
    cuts: int
    searches: int
    certificate: Certificate

    @property
    def readouts(self) -> dict[Readout, FloatArray]:
        """Both read-outs (m,) [1] at the receptors."""
        return {Readout.STRAIN: self.strain, Readout.CHANGE_OF_STRAIN: self.change_of_strain}

    @property
    def forces(self) -> FloatArray:
        """Forces (1 + n_times, n, 2) [N/mm] after pre-indentation and at the stimulus's times."""
        return np.concatenate([self.indented_force[None], self.force])


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
    read = read_receptors(strains, section.arc, settling=settling)
    before, last, shown = states[0], states[-1], states[1 + read.time]
    contact = shearing_and_pressing(problem, states)
    return Solution(
        indentation=float(before.actuator[0, 1]),
        depth=depth(problem, np.array([state.actuator for state in states])),
        position=section.position,
        indented_force=before.force,
        force=np.array([state.force for state in states[1:]]),
        contact=contact,
        read=read.time,
        pressure=contact[1 + read.time, :, 1] / section.weight,
        shear=contact[1 + read.time, :, 0] / section.weight,
        place=shown.place,
        status=shown.status,
        arc=section.arc,
        strain=read.strain,
        change_of_strain=read.change_of_strain,
        rival_peak=read.rival_peak,
        iterations=last.iterations,
        cuts=last.cuts,
        searches=last.searches,
        certificate=certificate,
    )
