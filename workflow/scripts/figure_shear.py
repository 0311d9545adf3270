"""Draw one device's scores against perceived roughness, without and with shear."""

from pathlib import Path

from fingerpad.figures.shear import shear_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import run
from fingerpad.perception.ratings import read_ratings
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_table


def main(
    scores: Path,
    ratings: Path,
    correlations: Path,
    device: str,
    title: str,
    conditions: dict[str, list[str]],
    kinematics: Kinematics,
    turning: bool,
    png: Path,
) -> None:
    """Read the tables, draw the device's rows, write PNG and PDF. conditions: of every known device."""
    rated = read_ratings(ratings, conditions)
    scored, correlated = (rows_with(read_table(table), kinematics) for table in (scores, correlations))
    save(shear_figure(device, title, scored, rated, correlated, kinematics, turning), png)


if __name__ == "__main__":
    run(main, snakemake)
