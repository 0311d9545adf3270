"""Compute every closed form with the library and write how far it is off."""

from dataclasses import asdict
from pathlib import Path

from fingerpad.closedforms.table import CASES
from fingerpad.jobs import run
from fingerpad.scene.scenefile import load_scene
from fingerpad.store import write_rows


def main(config: Path, device: Path, table: Path) -> None:
    """Read the scene (its finger has the layers), compute all cases, write one row per quantity and mesh."""
    scene = load_scene(config, device)
    write_rows(table, [asdict(row) for case in CASES.values() for row in case(scene)])


if __name__ == "__main__":
    run(main, snakemake)
