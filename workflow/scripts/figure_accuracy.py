"""Draw the errors of all closed forms."""

from pathlib import Path

import pandas as pd

from fingerpad.figures.accuracy import accuracy_figure
from fingerpad.figures.style import save


def main(table: Path, stem: Path) -> None:
    """Read the table, draw, write PNG and PDF."""
    save(accuracy_figure(pd.read_csv(table)), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.table), Path(job.output.png).with_suffix(""))
