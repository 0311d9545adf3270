"""Draw one device's scores against perceived roughness, without and with shear."""

import json
from pathlib import Path

import pandas as pd

from fingerpad.figures.shear import shear_figure
from fingerpad.figures.style import save
from fingerpad.ratings import read_ratings
from fingerpad.scenefile import load_scene


def main(
    config: Path,
    device: Path,
    scores: Path,
    ratings: Path,
    correlations: Path,
    conditions: dict[str, list[str]],
    stem: Path,
) -> None:
    """Read the tables, draw the device's rows, write PNG and PDF. conditions: of every known device."""
    shown = load_scene(config, device).device
    rated = read_ratings(ratings, conditions)
    save(shear_figure(shown.name, shown.title, pd.read_csv(scores), rated, pd.read_csv(correlations)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        Path(job.input.device),
        Path(job.input.scores),
        Path(job.input.ratings),
        Path(job.input.correlations),
        json.loads(job.params.conditions)[0],
        Path(job.output.png).with_suffix(""),
    )
