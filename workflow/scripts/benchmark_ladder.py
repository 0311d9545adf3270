"""Time one condition on ladders of meshes, by fingerpad, a plain solver and CalculiX, with the errors of its scores."""

from pathlib import Path
from typing import Any

from fingerpad.benchmark.calculix_ladder import calculix_ladder
from fingerpad.benchmark.ladder import first_order_ladder, own_ladder, plain_ladder
from fingerpad.calculix import installed
from fingerpad.scenefile import load_scene
from fingerpad.store import read_rows, write_rows
from fingerpad.tissue_law import Kinematics


def main(
    config: Path,
    device: Path,
    references: dict[Kinematics, Path],
    condition: str,
    factors: dict[str, dict[str, list[float]]],
    cases: dict[str, dict[str, Any]],
    limit: float,
    repeats: dict[str, int],
    folder: Path,
    table: Path,
) -> None:
    """Read scene and references by kinematics, climb every ladder, write a row a mesh. Without ccx its ladders are left
    out.
    """
    rows: list[dict[str, Any]] = []
    for kinematics, reference in references.items():
        scene, climbed = load_scene(config, device, kinematics), factors[kinematics]
        asked, wanted = scene.device.condition(condition), read_rows(reference)
        rows += own_ladder(scene, asked, climbed["fingerpad"], wanted, repeats[kinematics])
        if climbed["first_order"]:
            rows += first_order_ladder(scene, asked, climbed["first_order"], wanted, repeats[kinematics])
        if climbed["plain"]:
            rows += plain_ladder(scene, asked, climbed["plain"], wanted)
        decks = folder / kinematics
        decks.mkdir(parents=True, exist_ok=True)
        if installed():
            rows += calculix_ladder(scene, asked, climbed["calculix"], cases[kinematics], decks, limit)
        else:
            print("CalculiX skipped: ccx not installed")
    columns = dict.fromkeys(key for row in rows for key in row)
    write_rows(table, [{key: row.get(key, "") for key in columns} for row in rows])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        {Kinematics(each): Path(path) for each, path in zip(job.params.kinematics, job.input.references, strict=True)},
        job.params.condition,
        job.params.factors,
        job.params.cases,
        job.params.limit,
        job.params.repeats,
        Path(job.output.decks),
        Path(job.output.table),
    )
