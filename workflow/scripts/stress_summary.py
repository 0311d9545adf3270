"""Sum up what became of random scenes."""

from pathlib import Path

from fingerpad.jobs import run
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.store import read_rows, write_rows
from fingerpad.stress.outcomes import summary


def main(small: list[Path], finite: list[Path], table: Path) -> None:
    """Read the outcomes by kinematics, write shares of solutions and of each named error."""
    rows = []
    for kinematics, paths in ((Kinematics.SMALL, small), (Kinematics.FINITE, finite)):
        found = summary([row for path in paths for row in read_rows(path)])
        rows += [{"kinematics": kinematics, **row} for row in found]
    write_rows(table, rows)


if __name__ == "__main__":
    run(main, snakemake)
