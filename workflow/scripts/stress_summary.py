"""Sum up what became of random scenes."""

from pathlib import Path

from fingerpad.store import read_rows, write_rows
from fingerpad.stress import summary


def main(scenes: list[Path], table: Path) -> None:
    """Read the outcomes, write shares of solutions and of each named error."""
    write_rows(table, summary([row for path in scenes for row in read_rows(path)]))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main([Path(path) for path in job.input.scenes], Path(job.output.summary))
