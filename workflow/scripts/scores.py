"""Gather all scores in one tidy table, with their errors."""

from pathlib import Path

import pandas as pd

from fingerpad.accuracy import with_errors
from fingerpad.roughness import unpredicted_rows
from fingerpad.scenefile import load_scene


def main(config: Path, devices: list[Path], scores: list[Path], checks: list[Path], table: Path) -> None:
    """Read every score, add the rows for which there is no prediction, and errors from the checks; write the table."""
    missing = [row for device in devices for row in unpredicted_rows(load_scene(config, device))]
    found = [pd.read_csv(path, keep_default_na=False) for path in scores]
    whole = pd.concat([*found, pd.DataFrame(missing)] if missing else found, ignore_index=True)
    coarser = pd.concat([pd.read_csv(path, keep_default_na=False) for path in checks], ignore_index=True)
    with_errors(whole, coarser).to_csv(table, index=False, lineterminator="\n")


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        [Path(path) for path in job.input.devices],
        [Path(path) for path in job.input.scores],
        [Path(path) for path in job.input.checks],
        Path(job.output.scores),
    )
