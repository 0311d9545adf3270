"""Draw small and finite kinematics side by side."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.kinematics import kinematics_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run


def main(scores: Path, curves: Path, titles: dict[str, str], png: Path) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name."""
    save(kinematics_figure(pd.read_csv(scores), pd.read_csv(curves), titles), png)


if __name__ == "__main__":
    run(main, snakemake)
