"""Check the paper's statements against the computed tables."""

from pathlib import Path

import pandas as pd

from fingerpad.jobs import run
from fingerpad.perception.claims import claims_table
from fingerpad.store import write_table


def main(scores: Path, correlations: Path, claims: Path) -> None:
    """Read both tables, check every claim, write the verdicts with their evidence."""
    table = claims_table(pd.read_csv(scores), pd.read_csv(correlations))
    write_table(claims, table)


if __name__ == "__main__":
    run(main, snakemake)
