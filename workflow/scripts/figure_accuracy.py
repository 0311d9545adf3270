"""Draw the errors of all closed forms with small or with finite kinematics."""

from pathlib import Path

from fingerpad.figures.accuracy import accuracy_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_table


def main(table: Path, kinematics: Kinematics, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(accuracy_figure(read_table(table), kinematics), png)


if __name__ == "__main__":
    run(main, snakemake)
