"""Draw small and finite kinematics side by side."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.kinematics import kinematics_figure
from fingerpad.figures.style import device_titles, save
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene


def main(config: Path, devices: list[Path], scores: Path, curves: Path, stem: Path) -> None:
    """Read the tables, draw, write PNG and PDF."""
    titles = device_titles(load_scene(config, path).device for path in devices)
    save(kinematics_figure(pd.read_csv(scores), pd.read_csv(curves), titles), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.config),
            [Path(path) for path in job.input.devices],
            Path(job.input.scores),
            Path(job.input.curves),
            Path(job.output.png).with_suffix(""),
        )
