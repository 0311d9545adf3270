"""One condition solved: pre-indentation, stimulus, certificate and receptor read-outs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from .arrays import FloatArray
from .compliance import CondensedBody, CondensedSection
from .contact import ContactProblem, ContactState, Status, pressing_and_shearing, reevaluated_gap
from .contact_law import Interface
from .device import Condition
from .errors import CertificateError, ContactError, MeshError, ReachError
from .indentation import indent
from .path import follow
from .profile import profile
from .readout import Readout
from .scene import Scene
from .strain import receptor_readouts
from .symmetry import indent_by_halves
from .tissue_law import Kinematics

FRICTIONLESS_SHARE = 4  # of the increments, one is enough without friction [1]; source: fewest seconds (measured)

# What a certificate may not exceed; source: each lies two orders below the score error that is aimed at (0.5 %)
PENETRATION_LIMIT = 1e-4  # of the indentation [1]
TENSION_LIMIT = 1e-6  # of the largest pressure [1]
CONE_LIMIT = 1e-6  # of the largest shear that friction allows [1]
ADJACENT = 0.75  # distance of two nodes over the skin that belongs to them [1]; at most 0.6 if none lies between
DISSIPATION_LIMIT = 1e-9  # of the work of friction's largest force along the indentation [1]


@dataclass(frozen=True)
class Certificate:
    """What a solution found when it checked itself.

    equilibrium: relative residual of the tissue's equilibrium [1]. contact: of the contact equations [1].
    penetration: largest [mm]. smallest_pressure: over the nodes in contact [MPa]. cone_excess: largest shear beyond
    Coulomb's limit, over the largest limit [1]. dissipation: frictional work [N mm per mm].
    """

    equilibrium: float
    contact: float
    penetration: float
    smallest_pressure: float
    cone_excess: float
    dissipation: float


@dataclass(frozen=True)
class Solution:
    """A solved condition.

    indentation: height of the faces above the lowest point of the undeformed pad [mm]. indented_force: (n, 2) [N/mm]
    after pre-indentation. force: (n_times, n, 2) [N/mm] at the stimulus's times. pressure, shear: (n,) [MPa] at the
    end. place: (n,) x of the skin nodes from their actuator's centre at the end [mm]. status: (n,) at the end. arc:
    (m,) receptors [mm]. strain, change_of_strain: (m,) [1]. iterations, cuts, searches: of the whole
    path. certificate.
    """

    indentation: float
    indented_force: FloatArray
    force: FloatArray
    pressure: FloatArray
    shear: FloatArray
    place: FloatArray
    status: np.ndarray
    arc: FloatArray
    strain: FloatArray
    change_of_strain: FloatArray
    iterations: int
    cuts: int
    searches: int
    certificate: Certificate


@dataclass(frozen=True)
class Indented:
    """A device pressed onto the finger: the same for all conditions."""

    interface: Interface
    problem: ContactProblem
    state: ContactState


def contact_problem(
    scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface
) -> ContactProblem:
    """The contact problem of a scene and an interface. Raises MeshError if an actuator is nearest to no skin node."""
    numerics, law = scene.model.numerics, scene.model.contact
    problem = ContactProblem(
        section.position,
        section.compliance,
        scene.device.actuators,
        body,
        law.coefficient(interface),
        numerics.newton_tolerance,
        numerics.max_cuts,
        scene.model.skips.inactive_nodes,
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
    states, (_, count) = [before], increments(scene, problem)
    for tangential, normal in zip(condition.tangential, condition.normal, strict=True):
        target = before.actuator + np.stack([tangential, normal], axis=1)
        states.append(follow(problem, states[-1], target, count))
    return states[1:]


def indent_device(
    scene: Scene, section: CondensedSection, body: CondensedBody | None, interface: Interface
) -> Indented:
    """Press the device onto the finger: where the stimuli of all conditions begin.

    Raises MeshError if an actuator is nearest to no skin node, ContactError, naming device and interface, if the path
    cannot be followed.
    """
    problem = contact_problem(scene, section, body, interface)
    with named(f"device={scene.device.name}, interface={interface}, pre-indentation"):
        return Indented(interface, problem, indented_state(scene, problem))


def stimulate(scene: Scene, section: CondensedSection, indented: Indented, condition: Condition) -> Solution:
    """Solve the stimulus of one condition on the pressed finger.

    Raises ContactError, naming device, condition and interface, if the path cannot be followed, if its certificate
    exceeds a limit, or if contact reaches beyond the candidate nodes.
    """
    problem, before = indented.problem, indented.state
    with named(f"device={scene.device.name}, condition={condition.name}, interface={indented.interface}"):
        states = [before, *follow_condition(scene, problem, before, condition)]
        certificate = certify(problem, section, states[-1])
    strains = section.receptor_strain(np.array([state.force for state in states]))
    return solution(problem, section, states, receptor_readouts(strains), certificate)


def solution(
    problem: ContactProblem,
    section: CondensedSection,
    states: Sequence[ContactState],
    readouts: Mapping[Readout, FloatArray],
    certificate: Certificate,
) -> Solution:
    """Gather a solution from the pre-indented state and those at the stimulus's times."""
    before, last = states[0], states[-1]
    pressing, shearing = pressing_and_shearing(problem, last)
    return Solution(
        float(before.actuator[0, 1]),
        before.force,
        np.array([state.force for state in states[1:]]),
        pressing / section.weight,
        shearing / section.weight,
        last.place,
        last.status,
        section.arc,
        readouts[Readout.STRAIN],
        readouts[Readout.CHANGE_OF_STRAIN],
        last.iterations,
        last.cuts,
        last.searches,
        certificate,
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
def named(what: str) -> Iterator[None]:
    """Name in every ContactError what was being solved."""
    try:
        yield
    except ContactError as error:
        raise type(error)(f"{what}: {error}") from error


def certify(problem: ContactProblem, section: CondensedSection, state: ContactState) -> Certificate:
    """Check a state against the laws it was solved for. Raises CertificateError, with the figures, beyond a limit, and
    ReachError if contact comes to the last node considered."""
    active = state.status != Status.OPEN
    pressing, shearing = pressing_and_shearing(problem, state)
    pressure = pressing / section.weight
    largest = float(pressure.max(initial=0.0))
    friction_limit = problem.friction * float(pressing.max(initial=0.0))
    excess = np.abs(shearing) - problem.friction * pressing
    certificate = Certificate(
        section.residual,
        state.residual,
        max(float(-reevaluated_gap(problem, state).min()), 0.0),
        float(pressure[active].min()) if active.any() else 0.0,
        max(float(excess.max()), 0.0) / friction_limit if friction_limit > 0.0 else 0.0,
        state.dissipation,
    )
    indentation = float(np.abs(state.actuator).max())
    work = friction_limit * indentation
    # what lies within the tolerance of gaps may just touch, and rounding may pull
    slight = problem.tolerance * indentation / float(np.diag(problem.compliance).max() * section.weight.max())
    checks = {
        "contact residual": (certificate.contact, problem.tolerance),
        "penetration [mm]": (certificate.penetration, PENETRATION_LIMIT * indentation),
        "tension [MPa]": (-certificate.smallest_pressure, max(TENSION_LIMIT * largest, slight)),
        "excess over the friction cone": (certificate.cone_excess, CONE_LIMIT),
        "negative dissipation [N mm/mm]": (-certificate.dissipation, DISSIPATION_LIMIT * work),
    }
    for name, (found, allowed) in checks.items():
        if not found <= allowed:
            raise CertificateError(f"certificate: {name} {found:.2e} > {allowed:.2e}")
    _require_within_reach(problem, section, state, PENETRATION_LIMIT * indentation)
    return certificate


def _require_within_reach(
    problem: ContactProblem, section: CondensedSection, state: ContactState, allowed: float
) -> None:
    """Raise ReachError if an actuator touches, or overlaps by more than `allowed` [mm], skin that was not considered
    to be its own.

    Contact may reach an actuator's last node where the next node of the skin is a neighbour's; but no node may press
    into another actuator than the one it was given to.
    """
    own, x = problem.actuator_of, problem.position[:, 0]
    active = state.status != Status.OPEN
    # nodes of second-order elements are half an element apart, and carry at least 1/6 and 4/6 of it
    adjacent = np.diff(x) <= ADJACENT * (section.weight[1:] + section.weight[:-1])
    first = np.append(True, ~adjacent)
    last = np.append(~adjacent, True)
    centre = np.asarray(problem.row.positions)[:, None] + state.actuator[:, :1]
    place = (state.place + centre[own, 0] - centre).T  # (n, n_actuators)
    nearest = np.argmin(np.abs(place), axis=1)
    there = place[np.arange(x.size), nearest]
    height = state.gap - profile(problem.row, state.place)[0] + (state.actuator[own] - state.actuator[nearest])[:, 1]
    overlapping = (nearest != own) & (height + profile(problem.row, there)[0] < -allowed)
    beyond = np.flatnonzero(active & (first | last) | overlapping)
    if beyond.size:
        raise ReachError(
            f"certificate: contact at the actuator at x = {problem.row.positions[own[beyond[0]]]:g} mm reaches the last"
            " skin node that was considered; the stimulus moves it too far sideways"
        )
