"""Draw which rule feeds which."""

from pathlib import Path

from fingerpad.figures.rules import rules_figure
from fingerpad.figures.style import save
from fingerpad.jobs import run
from fingerpad.store import read_rows


def main(graph: Path, png: Path) -> None:
    """Read the edges, draw, write PNG and PDF."""
    save(rules_figure([(row["rule"], row["feeds"]) for row in read_rows(graph)]), png)


if __name__ == "__main__":
    run(main, snakemake)
