"""A case of `crosscheck` on tissue that deforms much, solved by fingerpad."""

from __future__ import annotations

from dataclasses import replace

from .compliance import CondensedBody
from .contact import switch_friction
from .crosscheck import (
    INDENTATION_INCREMENTS,
    STIMULUS_INCREMENTS,
    Outcome,
    actuator_forces,
    outcome_of,
)
from .deformed_solution import deformed_moves, pressed_finger, receptor_logarithmic_strain
from .export import DeckSettings
from .mesh import SectionMesh
from .pressing import press
from .scene import Condition, Interface, Scene


def deformed_outcome(
    scene: Scene, section: SectionMesh, body: CondensedBody | None, condition: Condition, settings: DeckSettings
) -> Outcome:
    """Outcome of the path that a deck of the settings takes. Raises ContactError if it cannot be followed."""
    indenting, acting = (_rubbing(scene, each) for each in (settings.friction_indenting, settings.friction_acting))
    pressed = press(indenting, section, body, Interface.SHEAR, settings.indentation)
    if settings.friction_acting > settings.friction_indenting:
        pressed = replace(pressed, state=switch_friction(pressed.state))
    finger = pressed_finger(acting, section, body, pressed, Interface.SHEAR)
    moves = deformed_moves(acting, finger, condition)
    ends = moves[0], moves[-1]
    strains = [receptor_logarithmic_strain(finger.gradient, move.displacement) for move in ends]
    forces = actuator_forces(finger.problem, [move.state.force for move in ends])
    return outcome_of(scene, pressed.section.arc, strains, forces)


def _rubbing(scene: Scene, friction: float) -> Scene:
    """The scene with that friction [1], and as many increments as the cross-check wants."""
    contact, numerics = scene.model.contact, scene.model.numerics
    finely = replace(numerics, indentation_increments=INDENTATION_INCREMENTS, stimulus_increments=STIMULUS_INCREMENTS)
    return replace(scene, model=replace(scene.model, contact=replace(contact, friction=friction), numerics=finely))
