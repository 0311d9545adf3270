"""Solve one condition with CalculiX and with fingerpad, and write both scores, or nothing without CalculiX."""

from pathlib import Path
from typing import Any

from threadpoolctl import threadpool_limits

from fingerpad.calculix.order_check import order_rows
from fingerpad.calculix.program import SKIPPED, installed
from fingerpad.jobs import logged
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(
    config: Path, device: Path, condition: str, case: dict[str, Any], limit: float, folder: Path, table: Path
) -> None:
    """Read the scene, run the deck, write both scores and keep the deck in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    if not installed():
        print(SKIPPED)
        write_rows(table, [])
        return
    write_rows(table, order_rows(load_scene(config, device), condition, case, folder, limit))


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    # results are those of one thread, as the deck's
    with logged(job.log), threadpool_limits(1):
        main(
            Path(job.input.config),
            Path(job.input.device),
            job.wildcards.condition,
            job.params.case,
            job.params.limit,
            Path(job.output.deck),
            Path(job.output.scores),
        )
