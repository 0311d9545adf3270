"""A case of `crosscheck` on tissue that deforms much, solved by fingerpad."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..contact.formulation import actuator_forces, switch_friction
from ..errors import ContactError
from ..finite.deformed_path import MAX_CORRECTIONS, move
from ..finite.deformed_solution import pressed_finger, receptor_logarithmic_strain
from ..finite.pressing import press_to
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..tissue.compliance import CondensedBody
from ..tissue.mesh import SectionMesh
from .case import ContactModel
from .crosscheck import (
    OWN_INDENTATION_INCREMENTS,
    OWN_STIMULUS_INCREMENTS,
    Outcome,
    outcome_of,
    softness,
    targets,
)
from .deck import DeckSettings


def deformed_outcome(
    scene: Scene,
    section: SectionMesh,
    body: CondensedBody | None,
    condition: Condition,
    settings: DeckSettings,
    contact: ContactModel,
) -> Outcome:
    """Outcome of the path that a deck of the settings takes.

    With penalties the last increment of pre-indentation and the stimulus are followed on springs: without friction no
    earlier one leaves a trace. Raises ContactError if the path cannot be followed, or a contact model is not for it,
    MeshError, CondensationError.
    """
    if contact is ContactModel.TURNING:
        raise ContactError("the penalty law with a turning normal is for small kinematics")
    if contact is ContactModel.PENALTIES and settings.friction_indenting > 0.0:
        raise ContactError("with finite kinematics penalties follow a frictionless pre-indentation")
    indenting = _rubbing(scene, settings.friction_indenting)
    indented, *stimulus = targets(condition, settings)
    last = settings.height / OWN_INDENTATION_INCREMENTS
    pressed = press_to(settings.height - last, indenting, section, body, Interface.SHEAR)
    finger = pressed_finger(_rubbing(scene, settings.friction_acting), section, body, pressed, Interface.SHEAR)
    # a normal that turned from the stimulus on would move what was pressed without
    turning = finger.problem.turning and settings.friction_indenting > 0.0
    problem = replace(finger.problem, friction=settings.friction_indenting, turning=turning)
    if contact is ContactModel.PENALTIES:
        problem = replace(problem, compliance=problem.compliance + np.diag(softness(pressed.section, settings)))
    tissue = replace(finger.tissue, compliance=problem.compliance)
    before, tissue = move(tissue, problem, finger.start, indented, 1)
    reached = before
    if settings.friction_acting > settings.friction_indenting:
        reached = replace(before, state=switch_friction(before.state))
    problem = replace(problem, friction=settings.friction_acting)
    for target in stimulus:
        # tissue linearised anew would be without the penalties' springs
        reached, tissue = move(tissue, problem, reached, target, OWN_STIMULUS_INCREMENTS, patience=MAX_CORRECTIONS)
    if contact is ContactModel.PENALTIES and reached.tangents > 0:
        raise ContactError("corrections do not settle, and new tangents would be without the penalties' springs")
    ends = before, reached
    strains = [receptor_logarithmic_strain(finger.gradient, each.displacement) for each in ends]
    forces = actuator_forces(problem, [each.state for each in ends])
    return outcome_of(scene, pressed.section.arc, strains, forces)


def _rubbing(scene: Scene, friction: float) -> Scene:
    """The scene with that friction [1], and as many increments of pre-indentation as the cross-check needs."""
    contact = replace(scene.model.contact, friction=friction)
    numerics = replace(scene.model.numerics, indentation_increments=OWN_INDENTATION_INCREMENTS)
    return scene.with_model(contact=contact, numerics=numerics)
