"""Gather the scores of all devices as vibrations."""

from pathlib import Path

from fingerpad.errors import SceneError
from fingerpad.store import read_rows, write_rows


def main(scores: list[Path], table: Path) -> None:
    """Read every device's rows, write the table. Raises SceneError if no device names a frequency."""
    rows = [row for path in scores for row in read_rows(path)]
    if not rows:
        raise SceneError("no device names a stimulus.frequency_hz; give one in a file in config/devices")
    write_rows(table, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main([Path(path) for path in job.input.scores], Path(job.output.table))
