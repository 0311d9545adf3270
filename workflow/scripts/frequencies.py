"""Gather the scores of all devices as vibrations, and those under other assumptions."""

from pathlib import Path

from fingerpad.errors import SceneError
from fingerpad.jobs import run
from fingerpad.store import read_rows, write_rows


def main(scores: list[Path], varied: list[Path], table: Path, variants: Path) -> None:
    """Read every device's rows, write the tables. Raises SceneError if no device names a frequency."""
    for gathered, parts in ((table, scores), (variants, varied)):
        rows = [row for path in parts for row in read_rows(path)]
        if not rows:
            raise SceneError("no device names a stimulus.frequency_hz; give one in a device file")
        write_rows(gathered, rows)


if __name__ == "__main__":
    run(main, snakemake)
