"""Draw the scores of all devices with and without shear."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.ablation import ablation_figure
from fingerpad.figures.style import device_titles, rows_with, save
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene
from fingerpad.scene.tissue_law import Kinematics


def main(
    config: Path, devices: list[Path], scores: Path, correlations: Path, kinematics: str, turning: bool, stem: Path
) -> None:
    """Read the tables, draw, write PNG and PDF."""
    titles = device_titles(load_scene(config, path).device for path in devices)
    scored, correlated = (rows_with(pd.read_csv(table), kinematics) for table in (scores, correlations))
    save(ablation_figure(scored, correlated, titles, Kinematics(kinematics), turning), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            Path(job.input.scores),
            Path(job.input.correlations),
            job.params.kinematics,
            job.params.turning,
            Path(job.output.png).with_suffix(""),
        )
