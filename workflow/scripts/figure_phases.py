"""Draw scores between the phases at which devices are tried."""

from pathlib import Path

from fingerpad.figures.phases import phases_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import read_table


def main(config: Path, devices: list[Path], table: Path, png: Path) -> None:
    """Read the table and the devices, draw, write PNG and PDF."""
    shown = [load_scene(config, path).device for path in devices]
    save(phases_figure(shown, read_table(table)), png)


if __name__ == "__main__":
    run(main, snakemake)
