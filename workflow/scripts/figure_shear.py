"""Draw one device's scores against perceived roughness, without and with shear."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.shear import shear_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import logged
from fingerpad.perception.ratings import read_ratings
from fingerpad.scene.tissue_law import Kinematics


def main(
    scores: Path,
    ratings: Path,
    correlations: Path,
    device: str,
    title: str,
    conditions: dict[str, list[str]],
    kinematics: str,
    turning: bool,
    stem: Path,
) -> None:
    """Read the tables, draw the device's rows, write PNG and PDF. conditions: of every known device."""
    rated = read_ratings(ratings, conditions)
    scored, correlated = (rows_with(pd.read_csv(table), kinematics) for table in (scores, correlations))
    save(shear_figure(device, title, scored, rated, correlated, Kinematics(kinematics), turning), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.scores),
            Path(job.input.ratings),
            Path(job.input.correlations),
            job.params.device,
            job.params.title,
            job.params.conditions,
            job.params.kinematics,
            job.params.turning,
            Path(job.output.png).with_suffix(""),
        )
