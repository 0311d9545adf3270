"""Score devices with friction from none on."""

from collections.abc import Sequence
from pathlib import Path

from fingerpad.jobs import logged
from fingerpad.prediction.frictions import friction_rows
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, devices: Sequence[Path], table: Path) -> None:
    """Read the scenes, solve them with each coefficient, write a row per score; without devices an empty table."""
    write_rows(table, [row for path in devices for row in friction_rows(load_scene(config, path))])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(Path(job.input.config), [Path(path) for path in job.input.devices], Path(job.output.table))
