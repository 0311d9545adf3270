"""Solve cases with CalculiX and with fingerpad, and write how far they are apart, or that CalculiX is not installed."""

from pathlib import Path
from typing import Any

from fingerpad.calculix import installed, read_printed, run
from fingerpad.compliance import CondensedBody
from fingerpad.condensation import condense_body, condense_section
from fingerpad.crosscheck import Law, Outcome, calculix_outcome, coarsened, differences, fingerpad_outcome, sharpened
from fingerpad.edges import mesh_device
from fingerpad.errors import CalculixError, ContactError
from fingerpad.export import DeckSettings, input_deck
from fingerpad.scene import Interface, Scene
from fingerpad.scenefile import load_scene
from fingerpad.solution import contact_problem, indented_state
from fingerpad.store import write_rows

SHARED = ("edges", "friction")  # what two cases must share for CalculiX to be compared with itself


def body_of(scene: Scene) -> CondensedBody | None:
    """The condensed body of deformable actuators."""
    return condense_body(scene) if scene.device.actuators.body else None


def prepared(scene: Scene, case: dict[str, Any]) -> tuple[Scene, DeckSettings]:
    """The case's scene with the shipped mesh, and the settings of its deck: it indents as deep as fingerpad does."""
    scene = sharpened(scene) if case["edges"] == "sharp" else scene
    friction = scene.model.contact.friction
    acting = 0.0 if case["friction"] == "never" else friction
    indenting = friction if case["friction"] == "always" else 0.0
    interface = Interface.SHEAR if indenting else Interface.FRICTIONLESS
    problem = contact_problem(scene, condense_section(mesh_device(scene), scene), body_of(scene), interface)
    depth = float(indented_state(scene, problem).actuator[0, 1])
    keys = ("pressure_slope", "stick_slope", "indentation_increments", "stimulus_increments", "rest_increments")
    return scene, DeckSettings(depth, indenting, acting, **{key: case[key] for key in keys})


def row(name: str, case: dict[str, Any], against: str, apart: dict[str, float]) -> dict[str, Any]:
    """One row of the table: a case, what it is compared with, and the relative differences."""
    rounded = {key: f"{value:.5f}" for key, value in apart.items()}
    return {"case": name, **case, "unknowns": "", "calculix_s": "", "against": against, **rounded, "note": ""}


def compared(
    scene: Scene, condition: str, name: str, case: dict[str, Any], folder: Path, limit: float
) -> tuple[list[dict[str, Any]], Outcome]:
    """Rows of one case beside fingerpad's laws on the same mesh, and CalculiX's outcome. Raises CalculixError."""
    fine, settings = prepared(scene, case)
    scene = coarsened(fine, case["coarsening"])
    section = mesh_device(scene)
    stimulus = scene.device.condition(condition)
    printed, seconds = run(input_deck(scene, section, stimulus, settings), folder, limit)
    moves = 1 + stimulus.time.size
    reference = calculix_outcome(
        scene, section, read_printed(printed, len(scene.device.actuators.positions), moves, settings)
    )
    condensed, body = condense_section(section, scene), body_of(scene)
    cost = {"unknowns": 2 * section.mesh.doflocs.shape[1], "calculix_s": round(seconds, 1)}
    rows = []
    for law in Law:
        try:
            apart = differences(fingerpad_outcome(scene, condensed, body, stimulus, settings, law), reference)
            rows.append(row(name, case, law, apart) | cost)
        except ContactError as error:
            rows.append(row(name, case, law, {}) | cost | {"note": str(error)})
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
        # the first case with the same edges and friction: what differs beside it moves CalculiX by so much
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
