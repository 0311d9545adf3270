"""Gather the scores of all conditions by CalculiX and by fingerpad, or say that CalculiX is not installed."""

from pathlib import Path

from fingerpad.calculix.program import SKIPPED
from fingerpad.jobs import run
from fingerpad.store import read_rows, write_rows


def main(scores: list[Path], table: Path) -> None:
    """Read every condition's rows, write the table."""
    rows = [row for path in scores for row in read_rows(path)]
    write_rows(table, rows or [{"note": SKIPPED}])


if __name__ == "__main__":
    run(main, snakemake)
