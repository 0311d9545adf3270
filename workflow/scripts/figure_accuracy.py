"""Draw the errors of all closed forms with small or with finite kinematics."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.accuracy import accuracy_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics


def main(table: Path, kinematics: Kinematics, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(accuracy_figure(pd.read_csv(table), kinematics), png)


if __name__ == "__main__":
    run(main, snakemake)
