"""Scores of a device's conditions by CalculiX beside fingerpad's own, to see whether both order them alike."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import CalculixError, ContactError
from ..readouts.roughness import SCORE_UNIT
from ..scene.readout import Readout
from ..scene.scene import Scene
from .both_sides import both_sides
from .case import Case, ContactModel

DIGITS = 5  # significant digits of a score [1]


def order_rows(scene: Scene, condition: str, case: Case, folder: Path, limit: float) -> list[dict[str, Any]]:
    """Rows of one condition, a row a read-out: its scores [mm2] by both programs, on the same path with friction.

    folder, limit: as `both_sides` takes them. Where CalculiX finds no solution there is a note in place of both
    scores, and where fingerpad does not in place of its own. Raises what `both_sides` raises but for CalculixError and
    ContactError.
    """
    own, calculix = dict[Readout, float](), dict[Readout, float]()
    sides, note = None, ""
    try:
        sides = both_sides(scene, condition, case, folder, limit)
        calculix = sides.calculix.score
        own = sides.fingerpad(ContactModel.OWN).score
    except (CalculixError, ContactError) as error:
        note = str(error)
    cost = {"unknowns": sides.unknowns if sides else "", "calculix_s": sides.seconds if sides else ""}
    where = {"kinematics": str(case.kinematics), "device": scene.device.name, "condition": condition}
    return [
        where
        | {"readout": str(each), "fingerpad": _shown(own.get(each)), "calculix": _shown(calculix.get(each))}
        | {"unit": SCORE_UNIT, **cost, "note": note}
        for each in Readout
    ]


def _shown(score: float | None) -> str:
    return "" if score is None else f"{score:.{DIGITS}g}"
