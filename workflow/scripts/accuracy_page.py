"""Write the page on accuracy, stability and run time from what was measured."""

from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.accuracy import accuracy_values
from fingerpad.pages.filling import filled


def main(template: Path, tables: dict[str, Path], page: Path) -> None:
    """Read template and tables, write the page."""
    values = accuracy_values({name: pd.read_csv(path) for name, path in tables.items()})
    write_text(page, filled(template.read_text(encoding="utf-8"), values))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    names = ("scores", "increments", "closed_forms", "calculix", "stress", "timings", "ladder", "exponents", "graph")
    main(
        Path(job.input.template),
        {name: Path(job.input[name]) for name in names},
        Path(job.output.page),
    )
