"""One case solved by CalculiX and by fingerpad, in the same terms, and how far they are apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import (
    ContactProblem,
    ContactState,
    actuator_force,
    rest,
    switch_friction,
    touching_height,
)
from ..contact.path import follow
from ..contact.problem import contact_problem
from ..errors import CalculixError
from ..finite.deformed_solution import receptor_logarithmic_strain
from ..prediction.edges import mesh_device
from ..readouts.gabor import filtered_readouts
from ..readouts.resampling import resampling_to_grid
from ..readouts.roughness import roughness_scores
from ..readouts.strain import maximum_principal
from ..scene.contact_law import FrictionFrom, Interface
from ..scene.device import Condition
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics, Law
from ..tissue.compliance import CondensedBody, CondensedSection
from ..tissue.elasticity import mesh_dofs, strain_of_gradient
from ..tissue.mesh import SectionMesh
from ..tissue.receptors import arc_length, receptor_gradient
from .case import Case, ContactModel, Edges
from .deck import DeckSettings, input_deck
from .height import indented_height
from .penalty import PenaltyLaw, PenaltyState, follow_penalties, untouched
from .run import Printed, read_printed, run

# source: the change of strain no longer moves in its fourth digit (measured)
OWN_INDENTATION_INCREMENTS = 80  # of fingerpad's side [1]
OWN_STIMULUS_INCREMENTS = 32  # of fingerpad's side, a segment [1]
# of a deck's mesh; source: chosen; CalculiX's own convergence, down to 1.4 times these sizes, is in docs/accuracy.md
DECK_EDGE_SIZE = 0.03  # mm
DECK_EDGE_ZONE = 0.015  # mm around an edge, half an element
DECK_FACE_SIZE = 0.08  # mm
DECK_RECEPTOR_SIZE = 0.09  # mm


@dataclass(frozen=True)
class Outcome:
    """What is compared. arc: (k,) uniform grid along the receptors [mm]. strain: (2, k) maximum principal strain [1]
    after pre-indentation and at the stimulus's end. force: (2, n_actuators, 2) on the skin [N/mm]. score: [mm2].
    """

    arc: FloatArray
    strain: FloatArray
    force: FloatArray
    score: dict[Readout, float]


def on_deck(scene: Scene, coarsening: float) -> Scene:
    """The scene on a deck's mesh, whose sizes on skin and receptor line are `coarsening` [1] times those given here."""
    numerics = replace(
        scene.model.numerics,
        edge_size=coarsening * DECK_EDGE_SIZE,
        edge_zone=DECK_EDGE_ZONE,
        face_size=coarsening * DECK_FACE_SIZE,
        receptor_size=coarsening * DECK_RECEPTOR_SIZE,
        nail_size=scene.model.numerics.largest_size,
    )
    return scene.with_model(numerics=numerics)


def sharpened(scene: Scene) -> Scene:
    """The scene with sharp edges: contact ends where the flat face does, and no normal can turn."""
    actuators = replace(scene.device.actuators, edge_radius=0.0)
    return scene.with_device(actuators=actuators)


def deck_inputs(scene: Scene, case: Case) -> tuple[Scene, DeckSettings]:
    """What a case's decks are made of: its scene, still with the shipped mesh, and their settings.

    Raises SceneError as `DeckSettings`; to indent fully, what `mesh_device` and `indented_height` raise.
    """
    scene = sharpened(scene) if case.edges is Edges.SHARP else scene
    scene = scene.with_kinematics(case.kinematics)
    law = replace(scene.model.contact, friction_from=FrictionFrom.TOUCH)  # here the case says from when on
    scene, friction = scene.with_model(contact=law), law.friction
    indenting = friction if case.friction_from is FrictionFrom.TOUCH else 0.0
    if case.law is not None:
        scene = scene.with_model(tissue=replace(scene.model.tissue, law=case.law))
    height = case.indentation
    if height == "full":
        height = indented_height(scene, mesh_device(scene), Interface.SHEAR if indenting else Interface.FRICTIONLESS)
    return scene, DeckSettings(
        height=height,
        friction_indenting=indenting,
        friction_acting=friction,
        pressure_slope=case.pressure_slope,
        stick_slope=case.stick_slope,
        indentation_increments=case.indentation_increments,
        stimulus_increments=case.stimulus_increments,
        rest_increments=case.rest_increments,
    )


def calculix_outcome(
    scene: Scene, section: SectionMesh, condition: Condition, settings: DeckSettings, folder: Path, limit: float
) -> tuple[Outcome, float]:
    """Outcome of a deck that CalculiX solves in a folder, and the seconds it took. Raises CalculixError if it fails,
    takes longer than the limit [s] or does not have the tissue's law, SceneError and MeshError as `input_deck`.
    """
    if scene.kinematics is Kinematics.FINITE and scene.model.tissue.law is Law.HENCKY:
        raise CalculixError("CalculiX has no law in logarithmic strain (hencky); try green, neo_hookean or ogden")
    table, seconds = run(input_deck(scene, section, condition, settings), folder, limit)
    printed = read_printed(table, len(scene.device.actuators.positions), 1 + condition.time.size, settings)
    return printed_outcome(scene, section, printed), seconds


def printed_outcome(scene: Scene, section: SectionMesh, printed: Printed) -> Outcome:
    """Outcome of what CalculiX printed: strain by the same map from displacement as fingerpad's."""
    points, gradient = receptor_gradient(section, scene)
    unknowns = mesh_dofs(section.mesh)[:, printed.node]
    field = np.zeros((printed.displacement.shape[0], gradient.shape[1]))
    field[:, unknowns] = printed.displacement.swapaxes(1, 2)
    if scene.kinematics is Kinematics.FINITE:
        strains = [receptor_logarithmic_strain(gradient, one) for one in field[[0, -1]]]
    else:
        strains = [strain_of_gradient(gradient) @ one for one in field[[0, -1]]]
    return outcome_of(scene, arc_length(points), strains, printed.force[[0, -1]])


def fingerpad_outcome(
    scene: Scene,
    section: CondensedSection,
    body: CondensedBody | None,
    condition: Condition,
    settings: DeckSettings,
    contact: ContactModel,
) -> Outcome:
    """Outcome of the deck's path by fingerpad, on the condensed undeformed finger. Raises ContactError if it cannot be
    followed, or the turning normal is asked of a deformable body or of sharp edges, MeshError as `contact_problem`.
    """
    problem = replace(contact_problem(scene, section, body, Interface.SHEAR), friction=settings.friction_acting)
    # a normal that turned from the stimulus on would move what was pressed without
    problem = replace(problem, turning=problem.turning and settings.friction_indenting > 0.0)
    if contact is ContactModel.PENALTIES:
        problem = replace(problem, compliance=problem.compliance + np.diag(softness(section, settings)))
    if contact is ContactModel.TURNING:
        turned = _turning_states(problem, section.weight, condition, settings)
        ends = [(state.force, problem.actuator_of) for state in turned]
    else:
        ends = [(state.force, state.given) for state in _own_states(problem, condition, settings)]
    strains = [section.strain @ force.ravel() for force, _ in ends]
    return outcome_of(scene, section.arc, strains, np.array([actuator_force(problem, *end) for end in ends]))


def differences(found: Outcome, reference: Outcome) -> dict[str, float]:
    """Relative differences [1] in the norm L2: of strains, pressing and all forces, change of strain, and of scores."""
    grid = reference.arc
    strain = np.array([np.interp(grid, found.arc, values) for values in found.strain])
    return {
        "strain_indented": _relative(strain[0], reference.strain[0]),
        "pressing_indented": _relative(found.force[0, :, 1], reference.force[0, :, 1]),
        "strain_actuated": _relative(strain[1], reference.strain[1]),
        "force_actuated": _relative(found.force[1], reference.force[1]),
        "change_of_strain": _relative(strain[1] - strain[0], reference.strain[1] - reference.strain[0]),
        **{f"score_{readout}": abs(found.score[readout] / reference.score[readout] - 1.0) for readout in Readout},
    }


def targets(condition: Condition, settings: DeckSettings) -> list[FloatArray]:
    """Displacements (n_actuators, 2) [mm] of the actuators: pre-indented, then at the stimulus's times."""
    indented = np.tile([0.0, settings.height], (condition.normal.shape[1], 1))
    return [indented, *(indented + condition.moves)]


def softness(section: CondensedSection, settings: DeckSettings) -> FloatArray:
    """Compliance (2n,) [mm per N/mm] that the penalties add to each node: 1 / (slope times its length of skin)."""
    slopes = np.array([settings.stick_slope, settings.pressure_slope])
    return 1.0 / (section.weight[:, None] * slopes).ravel()


def _own_states(
    problem: ContactProblem, condition: Condition, settings: DeckSettings
) -> tuple[ContactState, ContactState]:
    """States after pre-indentation and at the stimulus's end, by fingerpad's own law of contact."""
    indented, *stimulus = targets(condition, settings)
    first = replace(problem, friction=settings.friction_indenting)
    before = follow(first, rest(first, touching_height(first)), indented, OWN_INDENTATION_INCREMENTS)
    state = switch_friction(before) if settings.friction_acting > settings.friction_indenting else before
    for target in stimulus:
        state = follow(problem, state, target, OWN_STIMULUS_INCREMENTS)
    return before, state


def _turning_states(
    problem: ContactProblem, weight: FloatArray, condition: Condition, settings: DeckSettings
) -> tuple[PenaltyState, PenaltyState]:
    """States after pre-indentation and at the stimulus's end, by the penalty law, whose normal turns.

    weight: (n,) length of skin of each node [mm].
    """
    indented, *stimulus = targets(condition, settings)
    law = PenaltyLaw(settings.pressure_slope, settings.stick_slope, settings.friction_acting)
    first = replace(law, friction=settings.friction_indenting)
    # in the deck's increments, which decide how much of what slides before it touches bears friction
    state = before = follow_penalties(
        problem, weight, first, untouched(problem), indented, settings.indentation_increments
    )
    for target in stimulus:
        state = follow_penalties(problem, weight, law, state, target, settings.stimulus_increments)
    return before, state


def outcome_of(scene: Scene, arc: FloatArray, components: Sequence[FloatArray], force: FloatArray) -> Outcome:
    """Read-outs on the uniform grid, and scores, of strains (3m,) [1] before and after the stimulus."""
    strain = np.array([maximum_principal(each) for each in components])
    gabor = scene.model.gabor
    resampling = resampling_to_grid(arc, gabor.spacing)
    readouts = {Readout.STRAIN: strain[1], Readout.CHANGE_OF_STRAIN: strain[1] - strain[0]}
    scores = roughness_scores(scene, filtered_readouts(resampling, readouts, gabor))
    return Outcome(resampling.grid, strain @ resampling.weights.T, force, scores)


def _relative(found: FloatArray, reference: FloatArray) -> float:
    return float(np.linalg.norm(found - reference) / np.linalg.norm(reference))
