"""Draw scores against frequency."""

from pathlib import Path

from fingerpad.figures.frequency import frequency_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import read_table


def main(config: Path, devices: list[Path], table: Path, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    shown = [load_scene(config, path).device for path in devices]
    save(frequency_figure(shown, read_table(table)), png)


if __name__ == "__main__":
    run(main, snakemake)
