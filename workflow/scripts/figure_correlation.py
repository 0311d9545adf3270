"""Draw scores against perceived roughness for all devices."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.correlation import correlation_figure
from fingerpad.figures.style import device_titles, rows_with, save
from fingerpad.jobs import logged
from fingerpad.perception.ratings import read_ratings
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics


def main(
    config: Path,
    devices: list[Path],
    scores: Path,
    ratings: Path,
    correlations: Path,
    conditions: dict[str, list[str]],
    kinematics: str,
    stem: Path,
) -> None:
    """Read the tables, draw, write PNG and PDF. conditions: of every known device."""
    titles = device_titles(load_scene(config, path).device for path in devices)
    rated = read_ratings(ratings, conditions)
    scored, correlated = (rows_with(pd.read_csv(table), kinematics) for table in (scores, correlations))
    save(correlation_figure(scored, rated, correlated, titles, Kinematics(kinematics)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            Path(job.input.scores),
            Path(job.input.ratings),
            Path(job.input.correlations),
            job.params.conditions,
            job.params.kinematics,
            Path(job.output.png).with_suffix(""),
        )
