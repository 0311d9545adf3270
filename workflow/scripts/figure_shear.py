"""Draw one device's scores against perceived roughness, without and with shear."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.shear import shear_figure
from fingerpad.figures.style import save
from fingerpad.ratings import read_ratings
from fingerpad.scenefile import load_scene


def main(config: Path, device: Path, scores: Path, ratings: Path, correlations: Path, stem: Path) -> None:
    """Read the tables, draw the device's rows, write PNG and PDF."""
    shown = load_scene(config, device).device
    table = pd.read_csv(scores)
    conditions = {name: list(dict.fromkeys(rows)) for name, rows in table.groupby("device")["condition"]}
    rated = read_ratings(ratings, conditions)
    save(shear_figure(shown.name, shown.title, table, rated, pd.read_csv(correlations)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.scores),
        Path(job.input.ratings),
        Path(job.input.correlations),
        Path(job.output.png).with_suffix(""),
    )
