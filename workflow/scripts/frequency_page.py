"""Write the page of scores against frequency."""

from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.filling import filled
from fingerpad.pages.frequency import frequency_values


def main(template: Path, table: Path, variants: Path, scores: Path, page: Path) -> None:
    """Read template and tables, write the page."""
    values = frequency_values(pd.read_csv(table), pd.read_csv(variants), pd.read_csv(scores))
    write_text(page, filled(template.read_text(encoding="utf-8"), values))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.template),
        Path(job.input.table),
        Path(job.input.variants),
        Path(job.input.scores),
        Path(job.output.page),
    )
