"""Write the ledger of what is skipped from what was measured."""

from pathlib import Path

import pandas as pd

from fingerpad.files import write_text
from fingerpad.pages.filling import filled
from fingerpad.pages.skipping import skipping_values


def main(template: Path, switches: Path, always: Path, page: Path) -> None:
    """Read template and tables, write the page."""
    values = skipping_values(pd.read_csv(switches), pd.read_csv(always))
    write_text(page, filled(template.read_text(encoding="utf-8"), values))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.template), Path(job.input.switches), Path(job.input.always), Path(job.output.page))
