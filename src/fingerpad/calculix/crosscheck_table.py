"""The table of all cases that CalculiX and fingerpad solve beside each other, and how far they are apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..errors import CalculixError, ContactError
from ..scene.scene import Scene
from ..store import alike
from .both_sides import both_sides
from .case import Case, ContactModel
from .crosscheck import Outcome, differences


def crosscheck_rows(
    scene: Scene, condition: str, cases: Mapping[str, Case], folder: Path, limit: float
) -> list[dict[str, Any]]:
    """Rows of all cases, which lie in folders of their names: CalculiX beside fingerpad's laws of contact, and beside
    itself in the first case with the same kinematics, law, edges and friction.

    cases: by name. limit: seconds a deck may take. A case that CalculiX cannot solve has a note in place of
    numbers. Raises what `both_sides` raises but for CalculixError.
    """
    rows: list[dict[str, Any]] = []
    outcomes: dict[str, Outcome] = {}
    for name, case in cases.items():
        try:
            found, outcome = _compared(scene, condition, name, case, folder / name, limit)
        except CalculixError as error:
            rows.append(_row(name, case, "", {}) | {"note": str(error)})
            continue
        rows += found
        first = next((other for other in outcomes if _shared(cases[other]) == _shared(case)), None)
        if first is not None:
            rows.append(_row(name, case, f"CalculiX in {first}", differences(outcome, outcomes[first])))
        outcomes[name] = outcome
    return alike(rows)


def _shared(case: Case) -> tuple[object, ...]:
    """What two cases must share for CalculiX to be compared with itself."""
    return case.kinematics, case.law, case.edges, case.friction_from


def _compared(
    scene: Scene, condition: str, name: str, case: Case, folder: Path, limit: float
) -> tuple[list[dict[str, Any]], Outcome]:
    """Rows of one case beside fingerpad's laws on a mesh of its own, and CalculiX's outcome. Raises CalculixError."""
    sides = both_sides(scene, condition, case, folder, limit)
    cost = {"unknowns": sides.unknowns, "calculix_s": sides.seconds}
    rows = []
    for model in ContactModel:
        try:
            rows.append(_row(name, case, model, differences(sides.fingerpad(model), sides.calculix)) | cost)
        except ContactError as error:
            rows.append(_row(name, case, model, {}) | cost | {"note": str(error)})
    return rows, sides.calculix


def _row(name: str, case: Case, against: str, apart: Mapping[str, float]) -> dict[str, Any]:
    """One row of the table: a case, what it is compared with, and the relative differences [1]."""
    rounded = {key: f"{value:.5f}" for key, value in apart.items()}
    return {"case": name, **asdict(case), "unknowns": "", "calculix_s": "", "against": against, **rounded, "note": ""}
