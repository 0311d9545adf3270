"""Gather the scores of all devices as vibrations, and those under other assumptions."""

from pathlib import Path

from fingerpad.errors import SceneError
from fingerpad.jobs import logged
from fingerpad.store import read_rows, write_rows


def main(tables: dict[Path, list[Path]]) -> None:
    """Read every device's rows, write the tables. Raises SceneError if no device names a frequency."""
    for table, parts in tables.items():
        rows = [row for path in parts for row in read_rows(path)]
        if not rows:
            raise SceneError("no device names a stimulus.frequency_hz; give one in a device file")
        write_rows(table, rows)


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    with logged(job.log):
        main(
            {
                Path(job.output.table): [Path(path) for path in job.input.scores],
                Path(job.output.variants): [Path(path) for path in job.input.variants],
            }
        )
