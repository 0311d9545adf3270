"""Gather the scores of all conditions by CalculiX and by fingerpad, or say that CalculiX is not installed."""

from pathlib import Path

from fingerpad.calculix.program import SKIPPED
from fingerpad.jobs import logged
from fingerpad.store import read_rows, write_rows


def main(scores: list[Path], table: Path) -> None:
    """Read every condition's rows, write the table."""
    rows = [row for path in scores for row in read_rows(path)]
    write_rows(table, rows or [{"note": SKIPPED}])


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main([Path(path) for path in job.input.scores], Path(job.output.table))
