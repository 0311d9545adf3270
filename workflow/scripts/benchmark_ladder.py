"""Time one condition on ladders of meshes, by fingerpad, a plain solver and CalculiX, with the errors of its scores."""

from pathlib import Path
from typing import Any

from fingerpad.benchmark.calculix_ladder import calculix_ladder
from fingerpad.benchmark.ladder import own_ladder, plain_ladder
from fingerpad.calculix import installed
from fingerpad.scenefile import load_scene
from fingerpad.store import read_rows, write_rows


def main(
    config: Path,
    device: Path,
    reference: Path,
    condition: str,
    factors: dict[str, list[float]],
    case: dict[str, Any],
    limit: float,
    repeats: int,
    folder: Path,
    table: Path,
) -> None:
    """Read scene and reference, climb every ladder, write a row a mesh. Without ccx its ladder is left out."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = load_scene(config, device)
    asked, wanted = scene.device.condition(condition), read_rows(reference)
    rows = [*own_ladder(scene, asked, factors["fingerpad"], wanted, repeats)]
    rows += plain_ladder(scene, asked, factors["plain"], wanted)
    if installed():
        rows += calculix_ladder(scene, asked, factors["calculix"], case, folder, limit)
    else:
        print("CalculiX skipped: ccx not installed")
    columns = dict.fromkeys(key for row in rows for key in row)
    write_rows(table, [{key: row.get(key, "") for key in columns} for row in rows])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.reference),
        job.params.condition,
        job.params.factors,
        job.params.case,
        job.params.limit,
        job.params.repeats,
        Path(job.output.decks),
        Path(job.output.table),
    )
