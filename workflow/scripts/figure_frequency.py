"""Draw scores against frequency."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.frequency import frequency_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene


def main(config: Path, devices: list[Path], table: Path, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    shown = [load_scene(config, path).device for path in devices]
    save(frequency_figure(shown, pd.read_csv(table)), png)


if __name__ == "__main__":
    run(main, snakemake)
