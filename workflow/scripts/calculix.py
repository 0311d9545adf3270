"""Solve cases with CalculiX and with fingerpad, and write how far they are apart, or that CalculiX is not installed."""

from pathlib import Path
from typing import Any

from fingerpad.calculix.case import case_of
from fingerpad.calculix.crosscheck_table import crosscheck_rows
from fingerpad.calculix.program import SKIPPED, installed
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(
    config: Path, device: Path, condition: str, cases: dict[str, dict[str, Any]], limit: float, decks: Path, table: Path
) -> None:
    """Read the scene, run every case, write the table and keep the decks in a folder."""
    decks.mkdir(parents=True, exist_ok=True)
    if not installed():
        print(SKIPPED)
        write_rows(table, [{"note": SKIPPED}])
        return
    scene, found = load_scene(config, device), {name: case_of(each) for name, each in cases.items()}
    write_rows(table, crosscheck_rows(scene, condition, found, decks, limit))


if __name__ == "__main__":
    run(main, snakemake)
