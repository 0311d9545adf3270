"""Draw which statements hold in every member of the ensemble over assumptions."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.ensemble import ensemble_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import logged


def main(kinematics: str, claims: Path, stem: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(ensemble_figure(rows_with(pd.read_csv(claims), kinematics)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(job.params.kinematics, Path(job.input.claims), Path(job.output.png).with_suffix(""))
