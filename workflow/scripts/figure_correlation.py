"""Draw scores against perceived roughness for all devices."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.correlation import correlation_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import logged
from fingerpad.perception.ratings import read_ratings
from fingerpad.scene.tissue_law import Kinematics


def main(
    scores: Path,
    ratings: Path,
    correlations: Path,
    titles: dict[str, str],
    conditions: dict[str, list[str]],
    kinematics: str,
    stem: Path,
) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name. conditions: of every known device."""
    rated = read_ratings(ratings, conditions)
    scored, correlated = (rows_with(pd.read_csv(table), kinematics) for table in (scores, correlations))
    save(correlation_figure(scored, rated, correlated, titles, Kinematics(kinematics)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.scores),
            Path(job.input.ratings),
            Path(job.input.correlations),
            job.params.titles,
            job.params.conditions,
            job.params.kinematics,
            Path(job.output.png).with_suffix(""),
        )
