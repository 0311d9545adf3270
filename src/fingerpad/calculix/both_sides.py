"""Both sides of a case: what CalculiX finds for a condition, and what solves it by fingerpad's laws of contact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ..prediction.edges import mesh_device
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..tissue.actuator_body import body_of
from ..tissue.condensation import condense_section
from .case import Case, ContactModel
from .crosscheck import Outcome, calculix_outcome, deck_inputs, fingerpad_outcome, on_deck
from .deformed_crosscheck import deformed_outcome


@dataclass(frozen=True)
class BothSides:
    """calculix: its outcome. fingerpad: solves the same condition by the law of contact that it is given, or raises
    ContactError. unknowns: of the deck [1]. seconds: that CalculiX took [s].
    """

    calculix: Outcome
    fingerpad: Callable[[ContactModel], Outcome]
    unknowns: int
    seconds: float


def both_sides(scene: Scene, condition: str, case: Case, folder: Path, limit: float) -> BothSides:
    """Solve a condition with CalculiX in a folder, each side on a mesh of its own.

    limit: seconds the deck may take. Raises what `deck_inputs` raises, CalculixError if CalculiX does not solve it, and
    SceneError, MeshError or CondensationError if either side cannot be set up.
    """
    fine, settings = deck_inputs(scene, case)
    deck, own = on_deck(fine, case.coarsening), on_deck(fine, case.fingerpad_coarsening)
    deck_section, section, body = mesh_device(deck), mesh_device(own), body_of(own)
    stimulus = scene.device.condition(condition)
    found, seconds = calculix_outcome(deck, deck_section, stimulus, settings, folder, limit)
    solve: Callable[[ContactModel], Outcome]
    if own.kinematics is Kinematics.FINITE:
        solve = partial(deformed_outcome, own, section, body, stimulus, settings)
    else:
        solve = partial(fingerpad_outcome, own, condense_section(section, own), body, stimulus, settings)
    return BothSides(found, solve, deck_section.unknowns, round(seconds, 1))
