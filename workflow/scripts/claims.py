"""Check the paper's statements against the computed tables."""

from pathlib import Path

import pandas as pd

from fingerpad.perception.claims import claims_table


def main(scores: Path, correlations: Path, claims: Path) -> None:
    """Read both tables, check every claim, write the verdicts with their evidence."""
    claims_table(pd.read_csv(scores), pd.read_csv(correlations)).to_csv(claims, index=False, lineterminator="\n")


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(Path(job.input.scores), Path(job.input.correlations), Path(job.output.claims))
