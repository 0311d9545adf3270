"""One condition solved: pre-indentation, stimulus, certificate and receptor read-outs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .certificate import Certificate, certify, worst
from .compliance import CondensedBody, CondensedSection
from .contact import ContactProblem, ContactState, shearing_and_pressing
from .contact_law import Criterion, Interface
from .depth import depth, require_tissue
from .device import Condition
from .errors import ContactError, MeshError
from .increment import solve_increment
from .indentation import indent
from .path import advance
from .readout import Readout
from .scene import Scene
from .strain import receptor_readouts, rival_peak, time_read
from .symmetry import indent_by_halves
from .tissue_law import Kinematics

FRICTIONLESS_SHARE = 2  # of the increments, one is enough without friction [1]; source: fewest seconds (measured)

TOUCH = ", and so does contact.criterion: touch (in config/config.yaml, where it changes every device)"
SMALL_ALONE = "; `kinematics: small` in the device's file leaves finite strain out (docs/troubleshooting.md)"
SHEAR_ALONE = "; `interfaces: shear` in the device's file leaves out what is without friction"


@dataclass(frozen=True)
class Solution:
    """A solved condition.

    indentation: height of the faces above the lowest point of the undeformed pad [mm]. depth: largest height of an
    actuator above that at which it first touches undeformed skin [mm], at any time. position: (n, 2) of the contact
    nodes on undeformed skin [mm]. indented_force: (n, 2) [N/mm] after pre-indentation. force: (n_times, n, 2) [N/mm] at
    the stimulus's times. contact: (1 + n_times, n, 2) shearing and pressing forces [N/mm] then and before, which are
    `forces` but where the normal turns. read: index of the time at which receptors are read (`strain.time_read`). What
    follows is at that time. pressure, shear: (n,) [MPa]. place: (n,) x of the skin nodes from their actuator's centre
    [mm]. status: (n,). arc: (m,) receptors [mm]. strain, change_of_strain: (m,) [1]. rival_peak: change at the time
    that comes next to being read over that which is read [1] (`strain.rival_peak`). iterations, cuts, searches: of the
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


@dataclass(frozen=True)
class Indented:
    """A device pressed onto the finger, with the state's certificate: the same for all conditions."""

    interface: Interface
    problem: ContactProblem
    state: ContactState
    certificate: Certificate


def contact_problem(
    scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface
) -> ContactProblem:
    """The contact problem of a scene and an interface. Raises MeshError if an actuator is nearest to no skin node."""
    numerics, law = scene.model.numerics, scene.model.contact
    problem = ContactProblem(
        position=section.position,
        compliance=section.compliance,
        row=scene.device.actuators,
        body=body,
        friction=law.coefficient(interface),
        tolerance=numerics.newton_tolerance,
        max_cuts=numerics.max_cuts,
        patches=scene.model.skips.inactive_nodes,
        turning=law.turns(scene.kinematics, interface),
    )
    centres = problem.row.positions
    missed = np.setdiff1d(np.arange(len(centres)), problem.actuator_of)
    if missed.size:
        raise MeshError(
            f"{scene.device.name}: no skin node is near the actuator at x = {centres[missed[0]]:g} mm, nor near"
            f" {missed.size - 1} others of {len(centres)}; try a smaller numerics.face_size"
        )
    return problem


def increments(scene: Scene, problem: ContactProblem) -> tuple[int, int]:
    """Load increments of pre-indentation and of each segment of a stimulus."""
    numerics, share = scene.model.numerics, 1
    linear = scene.kinematics is Kinematics.SMALL  # much less than all at once is too far for Newton's method
    if scene.model.skips.frictionless_path and problem.friction == 0.0 and linear:
        share = FRICTIONLESS_SHARE
    return -(-numerics.indentation_increments // share), -(-numerics.stimulus_increments // share)


def indented_state(scene: Scene, problem: ContactProblem) -> ContactState:
    """State after pre-indentation: the same for all conditions of a device and interface. Raises ContactError."""
    solve = indent_by_halves if scene.model.skips.mirrored_half else indent
    count, _ = increments(scene, problem)
    return solve(problem, scene.model.contact.criterion, count, scene.model.finger.pad_thickness)


def follow_condition(
    scene: Scene, problem: ContactProblem, before: ContactState, condition: Condition
) -> list[ContactState]:
    """States at the times of a condition's stimulus, from the pre-indented one. Raises ContactError."""
    require_tissue(problem, before.actuator + condition.moves, scene.model.finger.pad_thickness)
    states, patch, (_, count) = [before], None, increments(scene, problem)
    for moved in condition.moves:
        state, patch = advance(problem, states[-1], before.actuator + moved, count, patch, solve_increment)
        states.append(state)
    return states[1:]


def indent_device(
    scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface
) -> Indented:
    """Press the device onto the finger: where the stimuli of all conditions begin.

    Raises MeshError if an actuator is nearest to no skin node, ContactError, naming device and interface, if the path
    cannot be followed, or its end has no certificate.
    """
    problem = contact_problem(scene, section, body, interface)
    with named_pressing(scene, interface):
        state = indented_state(scene, problem)
        return Indented(interface, problem, state, certify(problem, section, state))


def stimulate(scene: Scene, section: CondensedSection, indented: Indented, condition: Condition) -> Solution:
    """Solve the stimulus of one condition on the pressed finger.

    Raises ContactError, naming device, condition and interface, if the path cannot be followed, if a state's
    certificate exceeds a limit, or if contact reaches beyond the candidate nodes.
    """
    problem, before = indented.problem, indented.state
    case = f"device={scene.device.name}, condition={condition.name}, interface={indented.interface}"
    with named(case, left_out(scene, indented.interface)):
        states = [before, *follow_condition(scene, problem, before, condition)]
        certificate = worst([indented.certificate, *(certify(problem, section, state) for state in states[1:])])
    strains = section.receptor_strain(np.array([state.force for state in states]))
    return solution(problem, section, states, strains, certificate)


def solution(
    problem: ContactProblem,
    section: CondensedSection,
    states: Sequence[ContactState],
    strains: FloatArray,
    certificate: Certificate,
) -> Solution:
    """Gather a solution from the pre-indented state and those at the stimulus's times, and the receptors' strains
    (1 + n_times, 3m) [1] in them.
    """
    read, readouts = time_read(strains, section.arc), receptor_readouts(strains, section.arc)
    before, last, shown = states[0], states[-1], states[1 + read]
    contact = shearing_and_pressing(problem, states)
    return Solution(
        indentation=float(before.actuator[0, 1]),
        depth=depth(problem, np.array([state.actuator for state in states])),
        position=section.position,
        indented_force=before.force,
        force=np.array([state.force for state in states[1:]]),
        contact=contact,
        read=read,
        pressure=contact[1 + read, :, 1] / section.weight,
        shear=contact[1 + read, :, 0] / section.weight,
        place=shown.place,
        status=shown.status,
        arc=section.arc,
        strain=readouts[Readout.STRAIN],
        change_of_strain=readouts[Readout.CHANGE_OF_STRAIN],
        rival_peak=rival_peak(strains, section.arc),
        iterations=last.iterations,
        cuts=last.cuts,
        searches=last.searches,
        certificate=certificate,
    )


def solve_condition(
    scene: Scene,
    section: CondensedSection,
    body: CondensedBody | None,
    condition: Condition,
    interface: Interface,
) -> Solution:
    """The whole path of one condition: `indent_device`, then `stimulate`. Raises what they raise."""
    return stimulate(scene, section, indent_device(scene, section, body, interface), condition)


@contextmanager
def named(what: str, advice: str = "") -> Iterator[None]:
    """Name in every ContactError what was being solved, and say what else may help."""
    try:
        yield
    except ContactError as error:
        raise type(error)(f"{what}: {error}{advice}") from error


def left_out(scene: Scene, interface: Interface) -> str:
    """What a device's file may leave out where it cannot be solved."""
    finite, frictionless = scene.kinematics is Kinematics.FINITE, interface is Interface.FRICTIONLESS
    return (SMALL_ALONE if finite else "") + (SHEAR_ALONE if frictionless else "")


def named_pressing(scene: Scene, interface: Interface) -> AbstractContextManager[None]:
    """`named`, for pre-indentation, which goes the deeper the wider the row is."""
    full = scene.model.contact.criterion is Criterion.FULL
    advice = "; a narrower row needs less indentation" + (TOUCH if full else "")
    advice += left_out(scene, interface)
    return named(f"device={scene.device.name}, interface={interface}, pre-indentation", advice)
