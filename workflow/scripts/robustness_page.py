"""Write the page of what depends on which assumption."""

from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.filling import filled
from fingerpad.pages.robustness import robustness_values


def main(template: Path, claims: Path, correlations: Path, page: Path) -> None:
    """Read template and tables, write the page."""
    values = robustness_values(pd.read_csv(claims), pd.read_csv(correlations))
    write_text(page, filled(template.read_text(encoding="utf-8"), values))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.template),
        Path(job.input.claims),
        Path(job.input.correlations),
        Path(job.output.page),
    )
