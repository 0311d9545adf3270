"""Check the paper's statements against the computed tables."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.perception.claims import claims_table
from fingerpad.store import read_table, write_table


def main(scores: Path, correlations: Path, claims: Path) -> None:
    """Read both tables, check every claim, write the verdicts with their evidence."""
    table = claims_table(read_table(scores), read_table(correlations))
    write_table(claims, table)


if __name__ == "__main__":
    run(main, snakemake)
