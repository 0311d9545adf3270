"""Solve cases with CalculiX and with fingerpad, and write how far they are apart, or that CalculiX is not installed."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from fingerpad.actuator_body import body_of
from fingerpad.calculix import installed
from fingerpad.condensation import condense_section
from fingerpad.crosscheck import (
    ContactModel,
    Outcome,
    calculix_outcome,
    differences,
    fingerpad_outcome,
    on_deck,
    prepared,
)
from fingerpad.deformed_crosscheck import deformed_outcome
from fingerpad.edges import mesh_device
from fingerpad.errors import CalculixError, ContactError
from fingerpad.scene import Scene
from fingerpad.scenefile import load_scene
from fingerpad.store import write_rows
from fingerpad.tissue_law import Kinematics

SHARED = ("kinematics", "law", "edges", "friction")  # what two cases must share for CalculiX to be compared with itself


def row(name: str, case: dict[str, Any], against: str, apart: dict[str, float]) -> dict[str, Any]:
    """One row of the table: a case, what it is compared with, and the relative differences."""
    rounded = {key: f"{value:.5f}" for key, value in apart.items()}
    return {"case": name, **case, "unknowns": "", "calculix_s": "", "against": against, **rounded, "note": ""}


def compared(
    scene: Scene, condition: str, name: str, case: dict[str, Any], folder: Path, limit: float
) -> tuple[list[dict[str, Any]], Outcome]:
    """Rows of one case beside fingerpad's laws on a mesh of its own, and CalculiX's outcome. Raises CalculixError."""
    fine, settings = prepared(scene, case)
    deck = on_deck(fine, case["coarsening"])
    deck_section = mesh_device(deck)
    stimulus = scene.device.condition(condition)
    reference, seconds = calculix_outcome(deck, deck_section, stimulus, settings, folder, limit)
    scene = on_deck(fine, case["fingerpad_coarsening"])
    section = mesh_device(scene)
    body = body_of(scene)
    solve: Callable[[ContactModel], Outcome]
    if scene.kinematics is Kinematics.FINITE:
        solve = partial(deformed_outcome, scene, section, body, stimulus, settings)
    else:
        solve = partial(fingerpad_outcome, scene, condense_section(section, scene), body, stimulus, settings)
    cost = {"unknowns": deck_section.unknowns, "calculix_s": round(seconds, 1)}
    rows = []
    for model in ContactModel:
        try:
            rows.append(row(name, case, model, differences(solve(model), reference)) | cost)
        except ContactError as error:
            rows.append(row(name, case, model, {}) | cost | {"note": str(error)})
    return rows, reference


def main(
    config: Path,
    device: Path,
    condition: str,
    cases: dict[str, dict[str, Any]],
    limit: float,
    folder: Path,
    table: Path,
) -> None:
    """Read the scene, run every case, write the table and keep the decks in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    if not installed():
        print("skipped: ccx not installed")
        write_rows(table, [{"note": "skipped: ccx not installed"}])
        return
    scene = load_scene(config, device)
    rows: list[dict[str, Any]] = []
    outcomes: dict[str, Outcome] = {}
    for name, case in cases.items():
        try:
            found, outcome = compared(scene, condition, name, case, folder / name, limit)
        except CalculixError as error:
            rows.append(row(name, case, "", {}) | {"note": str(error)})
            continue
        rows += found
        # the first case with the same law, edges and friction: what differs beside it moves CalculiX by so much
        first = next((other for other in outcomes if all(cases[other][key] == case[key] for key in SHARED)), None)
        if first is not None:
            rows.append(row(name, case, f"CalculiX in {first}", differences(outcome, outcomes[first])))
        outcomes[name] = outcome
    columns = list(dict.fromkeys(key for one in rows for key in one))
    write_rows(table, [{key: one.get(key, "") for key in columns} for one in rows])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        job.params.condition,
        job.params.cases,
        job.params.limit,
        Path(job.output.decks),
        Path(job.output.table),
    )
