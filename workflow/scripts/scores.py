"""Gather all scores in one tidy table."""

from pathlib import Path

import pandas as pd

from fingerpad.roughness import unpredicted_rows
from fingerpad.scenefile import load_scene


def main(config: Path, devices: list[Path], scores: list[Path], table: Path) -> None:
    """Read every score, add the rows for which there is no prediction, write the table."""
    missing = [row for device in devices for row in unpredicted_rows(load_scene(config, device))]
    found = [pd.read_csv(path, keep_default_na=False) for path in scores]
    pd.concat([*found, pd.DataFrame(missing)] if missing else found).to_csv(table, index=False, lineterminator="\n")


if __name__ == "__main__":
    job = snakemake  # noqa: F821
    main(
        Path(job.input.config),
        [Path(path) for path in job.input.devices],
        [Path(path) for path in job.input.scores],
        Path(job.output.scores),
    )
