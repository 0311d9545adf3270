"""Draw which statements hold in every member of the ensemble over assumptions."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.ensemble import ensemble_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import run


def main(kinematics: str, claims: Path, png: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(ensemble_figure(rows_with(pd.read_csv(claims), kinematics)), png)


if __name__ == "__main__":
    run(main, snakemake)
