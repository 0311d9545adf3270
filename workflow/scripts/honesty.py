"""Compare scores and their stated errors with those of a much finer solution."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.readouts.accuracy import true_errors
from fingerpad.store import read_rows, write_rows


def main(scores: Path, references: list[Path], table: Path) -> None:
    """Read scores and references, write the error of every score beside the one it states."""
    write_rows(table, true_errors(read_rows(scores), [row for path in references for row in read_rows(path)]))


if __name__ == "__main__":
    run(main, snakemake)
