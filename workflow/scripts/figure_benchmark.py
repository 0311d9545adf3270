"""Draw run time against error, and how cost grows."""

from pathlib import Path

from fingerpad.figures.benchmark import benchmark_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.store import read_table


def main(case: str, ladder: Path, sizes: Path, fits: Path, png: Path) -> None:
    """Read the tables, draw what is about that condition, write PNG and PDF."""
    save(benchmark_figure(case, read_table(ladder), read_table(sizes), read_table(fits)), png)


if __name__ == "__main__":
    run(main, snakemake)
