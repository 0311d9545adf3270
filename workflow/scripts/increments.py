"""Solve all conditions of the devices with more increments, and write how far scores move."""

from pathlib import Path

from fingerpad.benchmark.increments import increment_rows
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import read_rows, write_rows


def main(config: Path, devices: list[Path], scores: Path, multiples: list[int], table: Path) -> None:
    """Read scenes and scores, write one row per device, multiple and read-out."""
    stated, rows = read_rows(scores), []
    for path in devices:
        rows.extend(increment_rows(load_scene(config, path), multiples, stated))
    write_rows(table, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            Path(job.input.scores),
            job.params.multiples,
            Path(job.output.table),
        )
