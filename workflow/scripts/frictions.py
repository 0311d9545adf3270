"""Score devices with friction from none on."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.prediction.frictions import friction_rows
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, devices: list[Path], table: Path) -> None:
    """Read the scenes, solve them with each coefficient, write a row per score; without devices an empty table."""
    write_rows(table, [row for path in devices for row in friction_rows(load_scene(config, path))])


if __name__ == "__main__":
    run(main, snakemake)
