"""Write the page of what depends on which assumption."""

import shutil
from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.filling import filled
from fingerpad.pages.robustness import robustness_values


def main(template: Path, claims: Path, correlations: Path, figure: Path, page: Path, shown: Path) -> None:
    """Read template and tables, write the page, and the figure beside it."""
    values = robustness_values(pd.read_csv(claims), pd.read_csv(correlations))
    write_text(page, filled(template.read_text(encoding="utf-8"), values))
    shutil.copyfile(figure, shown)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.template),
        Path(job.input.claims),
        Path(job.input.correlations),
        Path(job.input.figure),
        Path(job.output.page),
        Path(job.output.figure),
    )
