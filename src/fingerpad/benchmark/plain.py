"""A plain solver to measure against: the whole section, factorised anew for every increment, by the same laws.

It shares mesh, elements and contact laws with the library, and nothing that makes the library fast: neither half of a
section that mirrors, nor a condensation kept over increments, nor a patch of the nodes near contact, nor a
pre-indentation shared by conditions.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..contact.formulation import ContactState, rest, touching_height
from ..contact.path import follow
from ..contact.problem import contact_problem, once_pressed, pressing_problem
from ..readouts.gabor import filtered_readouts
from ..readouts.resampling import resampling_to_grid
from ..readouts.roughness import score_rows
from ..readouts.strain import read_receptors
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..tissue.condensation import condense_section
from ..tissue.mesh import SectionMesh


def plain_scores(
    scene: Scene, section: SectionMesh, condition: Condition, height: float, increments: tuple[int, int]
) -> list[dict[str, Any]]:
    """Score rows of one condition with shear; actuators are rigid.

    height: of the faces above the pad's lowest point after pre-indentation [mm]. increments: of pre-indentation, and of
    each time of the stimulus [1]. Raises MeshError, CondensationError, ContactError.
    """
    skips = replace(scene.model.skips, halved_condensation=False, inactive_nodes=False)
    scene = scene.with_model(skips=skips)
    condensed = condense_section(section, scene)
    acting = contact_problem(scene, condensed, None, Interface.SHEAR)
    problem = pressing_problem(scene, acting)
    state = rest(problem, touching_height(problem))
    pressed = np.tile([0.0, height], (len(problem.row.positions), 1))
    targets = [pressed, *(pressed + condition.moves)]
    states: list[ContactState] = []
    for target, count in zip(targets, [increments[0], *[increments[1]] * condition.time.size], strict=True):
        start = state.actuator
        for step in range(1, count + 1):
            condensed = condense_section(section, scene)
            problem = replace(problem, compliance=condensed.compliance)
            state = follow(problem, state, start + step / count * (target - start), 1)
        state, problem = once_pressed(state, problem, acting), acting
        states.append(state)
    forces: FloatArray = np.array([each.force for each in states])
    readouts = read_receptors(condensed.receptor_strain(forces), condensed.arc, settling=condition.settling).readouts
    resampling = resampling_to_grid(condensed.arc, scene.model.gabor.spacing)
    read = filtered_readouts(resampling, readouts, scene.model.gabor)
    return score_rows(scene, condition, Interface.SHEAR, read)
