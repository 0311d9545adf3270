"""Draw small and finite kinematics side by side."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.kinematics import kinematics_figure
from fingerpad.figures.style import save
from fingerpad.jobs import logged


def main(scores: Path, curves: Path, titles: dict[str, str], stem: Path) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name."""
    save(kinematics_figure(pd.read_csv(scores), pd.read_csv(curves), titles), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            Path(job.input.scores),
            Path(job.input.curves),
            job.params.titles,
            Path(job.output.png).with_suffix(""),
        )
