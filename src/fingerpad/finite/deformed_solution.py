"""One condition solved on tissue that deforms much: stimulus, certificate and receptor read-outs.

Receptors are read as maximum principal logarithmic strain, over their undeformed arc length.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_matrix

from ..arrays import FloatArray
from ..contact.advice import named_pressing, named_stimulus
from ..contact.certificate import Certificate, certify, worst
from ..contact.depth import require_tissue
from ..contact.formulation import ContactProblem
from ..contact.problem import contact_problem, stimulus_increments
from ..contact.solution import Solution, solution
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..tissue.compliance import CondensedBody
from ..tissue.elasticity import mesh_dofs
from ..tissue.mesh import SectionMesh
from ..tissue.receptors import receptor_gradient
from ..tissue.skin import Skin, require_uncrossed, skin_of
from .deformed_path import DeformedTissue, Equilibrium, deformed_tissue, move
from .finite_strain import logarithmic_strain
from .pressing import Pressed, press, whole_part


@dataclass(frozen=True)
class PressedFinger:
    """A pressed device and the tissue about that state: the same for all conditions.

    problem: contact on the condensed tangent. tissue: what corrects its solutions. start: of all stimuli. gradient:
    (4m, size) of displacement gradients at the receptors. dofs: (2, n_nodes) unknowns of the nodes. skin: which must
    not cross itself.
    """

    interface: Interface
    pressed: Pressed
    problem: ContactProblem
    tissue: DeformedTissue
    start: Equilibrium
    gradient: csr_matrix
    dofs: np.ndarray
    skin: Skin


def press_finger(scene: Scene, section: SectionMesh, body: CondensedBody | None, interface: Interface) -> PressedFinger:
    """`press` a device, and what all its conditions begin with then. Raises what `press` and `pressed_finger` raise."""
    return pressed_finger(scene, section, body, press(scene, section, body, interface), interface)


def pressed_finger(
    scene: Scene, section: SectionMesh, body: CondensedBody | None, pressed: Pressed, interface: Interface
) -> PressedFinger:
    """What all conditions of a device and interface begin with. Raises MeshError as `contact_problem`, and what
    `deformed_tissue` raises.
    """
    dofs = mesh_dofs(section.mesh)
    displacement = np.empty(dofs.size)
    displacement[dofs] = pressed.displacement
    skin = skin_of(section, dofs, halved=False)
    problem, state, free = contact_problem(scene, pressed.section, body, interface), pressed.state, pressed.free
    tissue = deformed_tissue(whole_part(scene, section), displacement, problem.compliance)
    start = Equilibrium(state=state, displacement=displacement, free=free, tangents=0, defect=0.0)
    gradient = receptor_gradient(section, scene)[1]
    return PressedFinger(
        interface=interface,
        pressed=pressed,
        problem=replace(problem, free=free),
        tissue=tissue,
        start=start,
        gradient=gradient,
        dofs=dofs,
        skin=skin,
    )


def stimulate_deformed(scene: Scene, finger: PressedFinger, condition: Condition) -> Solution:
    """Solve the stimulus of one condition on the pressed finger.

    Raises ContactError, naming device, condition and interface, if the path cannot be followed, if a state's
    certificate exceeds a limit, or if contact reaches beyond the candidate nodes.
    """
    found, certificate = certified_equilibria(scene, finger, condition)
    section = finger.pressed.section
    strains = np.array([receptor_logarithmic_strain(finger.gradient, each.displacement) for each in found])
    states = [each.state for each in found]
    return solution(finger.problem, section, states, strains, certificate, condition.settling)


def certified_equilibria(
    scene: Scene, finger: PressedFinger, condition: Condition
) -> tuple[list[Equilibrium], Certificate]:
    """`equilibria`, and their certificate. Raises ContactError as `stimulate_deformed`."""
    with named_pressing(scene, finger.interface):
        pressed = _certified(finger, finger.start)
    with named_stimulus(scene, condition, finger.interface):
        found = equilibria(scene, finger, condition)
        return found, worst([pressed, *(_certified(finger, each) for each in found[1:])])


def _certified(finger: PressedFinger, found: Equilibrium) -> Certificate:
    """The certificate of an equilibrium. Raises CertificateError, ReachError."""
    section = finger.pressed.section
    problem = replace(finger.problem, free=found.free)
    return certify(problem, replace(section, residual=max(section.residual, found.defect)), found.state)


def equilibria(scene: Scene, finger: PressedFinger, condition: Condition) -> list[Equilibrium]:
    """The pre-indented one, and those at the ends of all moves of a stimulus. Raises ContactError."""
    before, count = finger.pressed.state, stimulus_increments(scene, finger.problem)
    require_tissue(finger.problem, before.actuator + condition.moves, scene.model.finger.pad_thickness)
    found, tissue = [finger.start], finger.tissue
    for moved in condition.moves:
        reached, tissue = move(tissue, finger.problem, found[-1], before.actuator + moved, count)
        found.append(reached)
        require_uncrossed(finger.skin, found[-1].displacement, f"after move {len(found) - 1} of the stimulus")
    return found


def receptor_logarithmic_strain(gradient: csr_matrix, displacement: FloatArray) -> FloatArray:
    """Logarithmic strain (3m,) [1] at the receptors, whose displacement gradient (4m, size) of a displacement (size,)
    [mm] is given.
    """
    of_points = (gradient @ displacement).reshape(-1, 2, 2).transpose(1, 2, 0)
    return logarithmic_strain(of_points).T.ravel()
