"""What one comparison with CalculiX computes: a path, contact and increments on either side, and both meshes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Literal

from ..scene.contact_law import FrictionFrom
from ..scene.tissue_law import Kinematics, Law

# MPa/mm of pressure over penetration, of shear over elastic slip; source: CalculiX did not settle on ones four times as
# stiff (measured)
PRESSURE_SLOPE, STICK_SLOPE = 500.0, 100.0
# Increments [1] of each time of the stimulus, and at rest after each move; source: chosen; the cases in
# workflow/rules/calculix.smk say what others do
STIMULUS_INCREMENTS, REST_INCREMENTS = 4, 3


class Edges(StrEnum):
    """Actuators' edges: as the device has them, or none, so that contact ends where the flat face does."""

    ROUNDED = "rounded"
    SHARP = "sharp"


class ContactModel(StrEnum):
    """Contact on fingerpad's side: its own; with CalculiX's penalties; with its turning normal too."""

    OWN = "fingerpad"
    PENALTIES = "fingerpad with penalties"
    TURNING = "fingerpad with penalties and turning normal"


@dataclass(frozen=True)
class Case:
    """One comparison.

    kinematics, law: of the tissue; with small strain every law is the linear one, and none is named. indentation:
    height of the faces [mm], or as deep as fingerpad indents. coarsening, fingerpad_coarsening: times the sizes of
    `crosscheck.on_deck` [1]. pressure_slope, stick_slope [MPa/mm], increments [1]: as of `DeckSettings`.
    """

    kinematics: Kinematics
    indentation: float | Literal["full"]
    indentation_increments: int
    coarsening: float
    fingerpad_coarsening: float
    law: Law | None = None
    edges: Edges = Edges.ROUNDED
    friction_from: FrictionFrom = FrictionFrom.STIMULUS
    pressure_slope: float = PRESSURE_SLOPE
    stick_slope: float = STICK_SLOPE
    stimulus_increments: int = STIMULUS_INCREMENTS
    rest_increments: int = REST_INCREMENTS


def case_of(settings: Mapping[str, Any]) -> Case:
    """The case of settings in plain words and numbers. Raises TypeError for one that there is not, and ValueError for a
    word that it does not take.

    >>> words = {"kinematics": "small", "indentation": "full", "indentation_increments": 8, "edges": "sharp"}
    >>> case_of(words | {"coarsening": 2.0, "fingerpad_coarsening": 2.0}).edges
    <Edges.SHARP: 'sharp'>
    """
    read: dict[str, Callable[[Any], Any]] = {
        "kinematics": Kinematics,
        "law": Law,
        "edges": Edges,
        "friction_from": FrictionFrom,
    }
    return Case(**{key: read[key](value) if key in read else value for key, value in settings.items()})
