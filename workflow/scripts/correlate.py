"""Correlate scores with perceived roughness."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.perception.correlation import correlation_table
from fingerpad.perception.ratings import read_literature
from fingerpad.store import read_table, write_table


def main(
    scores: Path, ratings: Path, order: Path, published: Path, conditions: dict[str, list[str]], correlations: Path
) -> None:
    """Read scores and literature data, correlate, write the table. conditions: of every known device."""
    literature = read_literature(ratings, order, published, conditions)
    write_table(correlations, correlation_table(read_table(scores), literature))


if __name__ == "__main__":
    run(main, snakemake)
