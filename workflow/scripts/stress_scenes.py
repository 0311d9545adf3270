"""Solve some random scenes and write what becomes of each."""

from dataclasses import asdict
from pathlib import Path

from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import write_rows
from fingerpad.stress.outcomes import deformed_outcomes, outcomes

SOLVE = {Kinematics.SMALL: outcomes, Kinematics.FINITE: deformed_outcomes}


def main(kinematics: Kinematics, first: int, stop: int, scenes: Path) -> None:
    """Solve the scenes from first to before stop, write one row per scene."""
    write_rows(scenes, [asdict(outcome) for outcome in SOLVE[kinematics](range(first, stop))])


if __name__ == "__main__":
    run(main, snakemake)
