"""Draw which statements hold in every member of the ensemble over assumptions."""

from pathlib import Path

from fingerpad.figures.ensemble import ensemble_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import run
from fingerpad.store import read_table


def main(kinematics: str, claims: Path, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(ensemble_figure(rows_with(read_table(claims), kinematics)), png)


if __name__ == "__main__":
    run(main, snakemake)
