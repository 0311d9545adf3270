"""Draw small and finite kinematics side by side."""

from pathlib import Path

from fingerpad.figures.kinematics import kinematics_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.store import read_table


def main(scores: Path, curves: Path, titles: dict[str, str], png: Path) -> None:
    """Read the tables, draw, write PNG and PDF. titles: of the devices by name."""
    save(kinematics_figure(read_table(scores), read_table(curves), titles), png)


if __name__ == "__main__":
    run(main, snakemake)
