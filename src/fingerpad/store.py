"""Results on disk: frozen dataclasses as npz archives without pickles, tables as CSV; byte-stable."""

from __future__ import annotations

import csv
import dataclasses
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import numpy as np

from .arrays import FloatArray
from .errors import ResultError
from .files import replacing

Record = TypeVar("Record")
SEPARATOR = "/"  # between the name of a nested dataclass and its field


def save(path: Path, record: Any) -> None:
    """Write a dataclass of arrays, numbers and such dataclasses. npz has fixed time stamps: same record, same bytes."""
    save_arrays(path, _flattened(record, ""))


def save_arrays(path: Path, arrays: Mapping[str, Any]) -> None:
    """Write named arrays as an npz archive without pickles."""
    with replacing(path) as part, part.open("wb") as file:
        np.savez(file, allow_pickle=False, **arrays)


def load(path: Path, kind: type[Record]) -> Record:
    """Read a dataclass that `save` wrote. Raises ResultError."""
    with reading(path) as archive:
        return _built(kind, archive, "")


@contextmanager
def reading(path: Path) -> Iterator[Mapping[str, Any]]:
    """The named arrays in an npz archive, read without pickles. Raises ResultError if it is none, or lacks an array."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            yield archive
    except (ValueError, KeyError, EOFError, TypeError, zipfile.BadZipFile) as error:
        raise ResultError(f"{path}: is not what fingerpad writes there ({error}); remove it, and run again") from error


def write_rows(path: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows that share their keys as a CSV table; no rows as an empty file."""
    with replacing(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        if rows:
            writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def read_rows(path: Path) -> list[dict[str, str]]:
    """Rows of a CSV table that `write_rows` wrote, as text."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _flattened(record: Any, prefix: str) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if dataclasses.is_dataclass(value):
            flat |= _flattened(value, prefix + field.name + SEPARATOR)
        else:
            flat[prefix + field.name] = value
    return flat


def _built(kind: type[Record], archive: Any, prefix: str) -> Record:
    values: dict[str, Any] = {}
    for name, hint in get_type_hints(kind).items():
        if dataclasses.is_dataclass(hint):
            values[name] = _built(hint, archive, prefix + name + SEPARATOR)  # type: ignore[arg-type]
        elif hint in {int, float}:
            values[name] = hint(archive[prefix + name])
        else:
            stored: FloatArray = archive[prefix + name]
            values[name] = stored
    return kind(**values)
