"""The table of all cases that CalculiX and fingerpad solve beside each other, and how far they are apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from ..errors import CalculixError, ContactError
from ..prediction.edges import mesh_device
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..store import alike
from ..tissue.actuator_body import body_of
from ..tissue.condensation import condense_section
from .crosscheck import (
    ContactModel,
    Outcome,
    calculix_outcome,
    differences,
    fingerpad_outcome,
    on_deck,
    prepared,
)
from .deformed_crosscheck import deformed_outcome

SHARED = ("kinematics", "law", "edges", "friction")  # what two cases must share for CalculiX to be compared with itself


def crosscheck_rows(
    scene: Scene, condition: str, cases: Mapping[str, Mapping[str, Any]], folder: Path, limit: float
) -> list[dict[str, Any]]:
    """Rows of all cases, which lie in folders of their names: CalculiX beside fingerpad's laws of contact, and beside
    itself in the first case with the same law, edges and friction.

    cases: settings as in `crosscheck.prepared`, with `coarsening` of the deck's mesh and `fingerpad_coarsening` of
    fingerpad's. limit: seconds a deck may take. A case that CalculiX cannot solve has a note in place of numbers.
    Raises what `prepared` raises, and SceneError, MeshError or CondensationError if either side cannot be set up.
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
        first = next((other for other in outcomes if all(cases[other][key] == case[key] for key in SHARED)), None)
        if first is not None:
            rows.append(_row(name, case, f"CalculiX in {first}", differences(outcome, outcomes[first])))
        outcomes[name] = outcome
    return alike(rows)


def _compared(
    scene: Scene, condition: str, name: str, case: Mapping[str, Any], folder: Path, limit: float
) -> tuple[list[dict[str, Any]], Outcome]:
    """Rows of one case beside fingerpad's laws on a mesh of its own, and CalculiX's outcome. Raises CalculixError."""
    fine, settings = prepared(scene, case)
    deck, own = on_deck(fine, case["coarsening"]), on_deck(fine, case["fingerpad_coarsening"])
    deck_section, section, body = mesh_device(deck), mesh_device(own), body_of(own)
    stimulus = scene.device.condition(condition)
    reference, seconds = calculix_outcome(deck, deck_section, stimulus, settings, folder, limit)
    solve: Callable[[ContactModel], Outcome]
    if own.kinematics is Kinematics.FINITE:
        solve = partial(deformed_outcome, own, section, body, stimulus, settings)
    else:
        solve = partial(fingerpad_outcome, own, condense_section(section, own), body, stimulus, settings)
    cost = {"unknowns": deck_section.unknowns, "calculix_s": round(seconds, 1)}
    rows = []
    for model in ContactModel:
        try:
            rows.append(_row(name, case, model, differences(solve(model), reference)) | cost)
        except ContactError as error:
            rows.append(_row(name, case, model, {}) | cost | {"note": str(error)})
    return rows, reference


def _row(name: str, case: Mapping[str, Any], against: str, apart: Mapping[str, float]) -> dict[str, Any]:
    """One row of the table: a case, what it is compared with, and the relative differences [1]."""
    rounded = {key: f"{value:.5f}" for key, value in apart.items()}
    return {"case": name, **case, "unknowns": "", "calculix_s": "", "against": against, **rounded, "note": ""}
