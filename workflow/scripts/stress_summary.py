"""Sum up what became of random scenes."""

import csv
from pathlib import Path

from fingerpad.store import write_rows
from fingerpad.stress import summary


def main(scenes: list[Path], table: Path) -> None:
    """Read the outcomes, write shares of solutions and of each named error."""
    rows: list[dict[str, str]] = []
    for path in scenes:
        with path.open(newline="", encoding="utf-8") as file:
            rows.extend(csv.DictReader(file))
    write_rows(table, summary(rows))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main([Path(path) for path in job.input.scenes], Path(job.output.summary))
