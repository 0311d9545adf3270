"""Scores of all members of the ensemble over assumptions, and which statements hold in them."""

from pathlib import Path

import pandas as pd

from fingerpad.ensemble.members import ensemble_tables
from fingerpad.jobs import run
from fingerpad.perception.ratings import read_literature
from fingerpad.store import read_table, write_table


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
    device with its kinematics has no rows.
    """
    found = ensemble_tables(
        pd.concat([table for table in map(read_table, members) if len(table)], ignore_index=True),
        read_table(scores),
        read_literature(ratings, order, published, conditions),
    )
    write_table(claims, found.claims)
    write_table(correlations, found.correlations)
    write_table(table, found.scores)


if __name__ == "__main__":
    run(main, snakemake)
