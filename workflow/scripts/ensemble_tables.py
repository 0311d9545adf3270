"""Scores of all members of the ensemble over assumptions, and which statements hold in them."""

from pathlib import Path

import pandas as pd

from fingerpad.ensemble.members import ensemble_tables
from fingerpad.jobs import run
from fingerpad.perception.ratings import read_literature
from fingerpad.store import write_table


def main(
    members: list[Path],
    scores: Path,
    ratings: Path,
    order: Path,
    published: Path,
    conditions: dict[str, list[str]],
    claims: Path,
    correlations: Path,
    table: Path,
) -> None:
    """Read all members' scores and literature data, check the statements, write the tables. A member that varies no
    device with its kinematics has an empty file.
    """
    found = ensemble_tables(
        pd.concat([pd.read_csv(path) for path in members if path.stat().st_size], ignore_index=True),
        pd.read_csv(scores),
        read_literature(ratings, order, published, conditions),
    )
    write_table(claims, found.claims)
    write_table(correlations, found.correlations)
    write_table(table, found.scores)


if __name__ == "__main__":
    run(main, snakemake)
