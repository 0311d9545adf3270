"""Score devices at the phases between those at which they are tried."""

from pathlib import Path

from fingerpad.errors import SceneError
from fingerpad.jobs import run
from fingerpad.prediction.phases import phase_rows
from fingerpad.store import write_rows


def main(devices: list[Path], schemas: list[Path], config: Path, table: Path) -> None:
    """Read the scenes, solve them at all phases, write a row per score. Raises SceneError if no device has phases."""
    if not devices:
        raise SceneError("no device names stimulus.phases; give some in a device file")
    write_rows(table, [row for path in devices for row in phase_rows(path, schemas[0].parent, config)])


if __name__ == "__main__":
    run(main, snakemake)
