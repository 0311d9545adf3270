"""The folder of results, for those who look inside it: where it is, and which target makes what is missing."""

from __future__ import annotations

from pathlib import Path

from .errors import MissingResultError

FOLDER = "results"


def results_root(start: Path) -> Path:
    """The nearest folder, from `start` upwards, that holds results. Raises MissingResultError if there is none."""
    for folder in (start.resolve(), *start.resolve().parents):
        if (folder / FOLDER).is_dir():
            return folder
    raise MissingResultError(f"no folder {FOLDER!r} in {start} or above: make it with `snakemake all`")


def needed(root: Path, result: str, target: str | None = None) -> Path:
    """Path of a result, such as results/scores.csv. target: what makes it, if not its own name.

    Raises MissingResultError, with the command to type, if it is not there.
    """
    path = root / result
    if not path.exists():
        raise MissingResultError(f"{result} is not there yet: make it with `snakemake {target or result}`")
    return path
