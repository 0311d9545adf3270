"""Draw run time against error, and how cost grows."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.benchmark import benchmark_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run


def main(case: str, ladder: Path, sizes: Path, fits: Path, png: Path) -> None:
    """Read the tables, draw what is about that condition, write PNG and PDF."""
    save(benchmark_figure(case, pd.read_csv(ladder), pd.read_csv(sizes), pd.read_csv(fits)), png)


if __name__ == "__main__":
    run(main, snakemake)
