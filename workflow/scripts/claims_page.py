"""Write the page of the paper's statements."""

from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.claims import claims_values
from fingerpad.pages.filling import filled


def main(template: Path, claims: Path, page: Path) -> None:
    """Read template and table, write the page."""
    write_text(page, filled(template.read_text(encoding="utf-8"), claims_values(pd.read_csv(claims))))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.template), Path(job.input.claims), Path(job.output.page))
