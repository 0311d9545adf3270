"""Draw scores against perceived roughness for all devices."""

from pathlib import Path

from fingerpad.figures.correlation import correlation_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import run
from fingerpad.perception.ratings import read_ratings
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_table


def main(
    scores: Path,
    ratings: Path,
    correlations: Path,
    titles: dict[str, str],
    conditions: dict[str, list[str]],
    kinematics: Kinematics,
    png: Path,
) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name. conditions: of every known device."""
    rated = read_ratings(ratings, conditions)
    scored, correlated = (rows_with(read_table(table), kinematics) for table in (scores, correlations))
    save(correlation_figure(scored, rated, correlated, titles, kinematics), png)


if __name__ == "__main__":
    run(main, snakemake)
