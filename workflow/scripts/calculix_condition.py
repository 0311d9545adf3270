"""Solve one condition with CalculiX and with fingerpad, and write both scores, or nothing without CalculiX."""

from pathlib import Path
from typing import Any

from fingerpad.calculix.case import case_of
from fingerpad.calculix.order_check import order_rows
from fingerpad.calculix.program import SKIPPED, installed
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(
    config: Path, device: Path, condition: str, case: dict[str, Any], limit: float, deck: Path, scores: Path
) -> None:
    """Read the scene, run the deck, write both scores and keep the deck in a folder."""
    deck.mkdir(parents=True, exist_ok=True)
    if not installed():
        print(SKIPPED)
        write_rows(scores, [])
        return
    write_rows(scores, order_rows(load_scene(config, device), condition, case_of(case), deck, limit))


if __name__ == "__main__":
    run(main, snakemake)
