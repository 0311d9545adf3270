"""Score devices at the phases between those at which they are tried."""

from collections.abc import Sequence
from pathlib import Path

from fingerpad.errors import SceneError
from fingerpad.jobs import logged
from fingerpad.prediction.phases import phase_rows
from fingerpad.store import write_rows


def main(devices: Sequence[Path], schemas: Path, config: Path, table: Path) -> None:
    """Read the scenes, solve them at all phases, write a row per score. Raises SceneError if no device has phases."""
    if not devices:
        raise SceneError("no device names stimulus.phases; give some in a device file")
    write_rows(table, [row for path in devices for row in phase_rows(path, schemas, config)])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            [Path(path) for path in job.input.devices],
            Path(job.input.schemas[0]).parent,
            Path(job.input.config),
            Path(job.output.table),
        )
