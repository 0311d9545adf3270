"""Draw the scores of all devices with and without shear."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.ablation import ablation_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import logged
from fingerpad.scene.tissue_law import Kinematics


def main(scores: Path, correlations: Path, titles: dict[str, str], kinematics: str, turning: bool, stem: Path) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name."""
    scored, correlated = (rows_with(pd.read_csv(table), kinematics) for table in (scores, correlations))
    save(ablation_figure(scored, correlated, titles, Kinematics(kinematics), turning), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.scores),
            Path(job.input.correlations),
            job.params.titles,
            job.params.kinematics,
            job.params.turning,
            Path(job.output.png).with_suffix(""),
        )
