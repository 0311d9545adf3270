"""Draw which rule feeds which."""

from pathlib import Path

from fingerpad.figures.rules import rules_figure
from fingerpad.figures.style import save
from fingerpad.jobs import logged
from fingerpad.store import read_rows


def main(graph: Path, stem: Path) -> None:
    """Read the edges, draw, write PNG and PDF."""
    save(rules_figure([(row["rule"], row["feeds"]) for row in read_rows(graph)]), stem)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(Path(job.input.graph), Path(job.output.png).with_suffix(""))
