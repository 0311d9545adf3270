"""Draw the scores of all devices with and without shear."""

from pathlib import Path

from fingerpad.figures.ablation import ablation_figure
from fingerpad.figures.style import rows_with, save
from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_table


def main(
    scores: Path, correlations: Path, titles: dict[str, str], kinematics: Kinematics, turning: bool, png: Path
) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name."""
    scored, correlated = (rows_with(read_table(table), kinematics) for table in (scores, correlations))
    save(ablation_figure(scored, correlated, titles, kinematics, turning), png)


if __name__ == "__main__":
    run(main, snakemake)
