"""One condition solved on linear tissue: pre-indentation, stimulus, certificate and receptor read-outs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..arrays import FloatArray
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..tissue.compliance import CondensedBody, CondensedSection
from .advice import named_pressing, named_stimulus
from .certificate import Certificate, certify, require_within_reach, worst
from .depth import require_tissue
from .formulation import ContactProblem, ContactState
from .increment import solve_increment
from .indentation import indent
from .patch import Patch
from .path import SolveIncrement, advance
from .problem import contact_problem, indentation_increments, once_pressed, pressing_problem, stimulus_increments
from .solution import Solution, solution
from .symmetry import part_of, unfolded


@dataclass(frozen=True)
class Indented:
    """A device pressed onto the finger, with the state's certificate: the same for all conditions."""

    section: CondensedSection
    interface: Interface
    problem: ContactProblem
    state: ContactState
    certificate: Certificate


def indented_state(scene: Scene, problem: ContactProblem) -> ContactState:
    """State after pre-indentation: the same for all conditions of a device and interface. Raises ContactError."""
    part = part_of(problem, scene.model.skips.mirrored_half)
    state = raised(scene, part)
    return unfolded(state, part) if part.halved else state


def raised(
    scene: Scene, part: ContactProblem, solve: SolveIncrement[ContactState, Patch | None] = solve_increment
) -> ContactState:
    """State of a row, or of the half of it that is solved (`part_of`), after pre-indentation, with friction acting.
    solve: what solves an increment. Raises ContactError.
    """
    pressing = pressing_problem(scene, part)
    count = indentation_increments(scene, pressing)
    state = indent(pressing, scene.model.contact, count, scene.model.finger.pad_thickness, solve)
    return once_pressed(state, pressing, part)


def follow_condition(
    scene: Scene,
    problem: ContactProblem,
    before: ContactState,
    condition: Condition,
    solve: SolveIncrement[ContactState, Patch | None] = solve_increment,
) -> list[ContactState]:
    """States at the times of a condition's stimulus, from the pre-indented one. Raises ContactError."""
    require_tissue(problem, before.actuator + condition.moves, scene.model.finger.pad_thickness)
    states, patch, count = [before], None, stimulus_increments(scene, problem)
    for moved in condition.moves:
        state, patch = advance(problem, states[-1], before.actuator + moved, count, patch, solve)
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
        certificate = certify(problem, section, state)
        return Indented(section, interface, problem, state, certificate)


def stimulate(scene: Scene, indented: Indented, condition: Condition) -> Solution:
    """Solve the stimulus of one condition on the pressed finger.

    Raises ContactError, naming device, condition and interface, if the path cannot be followed, if a state's
    certificate exceeds a limit, or if contact reaches beyond the candidate nodes.
    """
    section, problem, before = indented.section, indented.problem, indented.state
    with named_stimulus(scene, condition, indented.interface):
        solve = partial(_solve_within_reach, section)
        states = [before, *follow_condition(scene, problem, before, condition, solve)]
        certificate = worst([indented.certificate, *(certify(problem, section, state) for state in states[1:])])
    strains = section.receptor_strain(np.array([state.force for state in states]))
    return solution(problem, section, states, strains, certificate, condition.settling)


def _solve_within_reach(
    section: CondensedSection, problem: ContactProblem, start: ContactState, actuator: FloatArray, patch: Patch | None
) -> tuple[ContactState, Patch]:
    """`solve_increment`, which raises ReachError as soon as contact leaves the skin that was considered: what follows
    is no solution, and may take minutes.
    """
    reached, patch = solve_increment(problem, start, actuator, patch)
    require_within_reach(problem, section, reached)
    return reached, patch


def solve_condition(
    scene: Scene,
    section: CondensedSection,
    body: CondensedBody | None,
    condition: Condition,
    interface: Interface,
) -> Solution:
    """The whole path of one condition: `indent_device`, then `stimulate`. Raises what they raise."""
    return stimulate(scene, indent_device(scene, section, body, interface), condition)
