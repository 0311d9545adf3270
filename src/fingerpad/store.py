"""Results on disk: frozen dataclasses as npz archives without pickles, tables as CSV; byte-stable."""

from __future__ import annotations

import csv
import dataclasses
import io
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, get_type_hints

import numpy as np

from .arrays import FloatArray
from .errors import ResultError
from .files import replacing, write_text

if TYPE_CHECKING:
    import pandas as pd

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
    archive = load_arrays(path)
    try:
        return _built(kind, archive, "")
    except (KeyError, TypeError) as error:
        raise foreign(path, error) from error


def load_arrays(path: Path, *names: str) -> dict[str, Any]:
    """The arrays in an npz archive, of these names or all, read without pickles. Raises ResultError if it is none, or
    lacks one.
    """
    try:
        # opened here, as numpy leaves a file open that is no archive
        with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
            return {name: archive[name] for name in names or archive.files}
    except (ValueError, KeyError, TypeError, AttributeError, EOFError, zipfile.BadZipFile) as error:
        raise foreign(path, error) from error


def foreign(path: Path, error: object) -> ResultError:
    """The error of a file that is not what it should be, and why."""
    return ResultError(f"{path}: is not what fingerpad writes there ({error}); remove it, and run again")


def csv_text(rows: Sequence[Mapping[str, Any]], header: bool = True) -> str:
    """Rows that share their keys, as lines of CSV, the first with their names if asked for; nothing of no rows.

    >>> csv_text([{"a": 1, "b": "x"}, {"a": None, "b": "y, z"}])
    'a,b\\n1,x\\n,"y, z"\\n'
    """
    text = io.StringIO()
    if rows:
        writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
        if header:
            writer.writeheader()
        writer.writerows(rows)
    return text.getvalue()


def write_rows(path: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows that share their keys as a CSV table; no rows as an empty line, as an empty file is one cut short."""
    write_text(path, csv_text(rows) or "\n")


def write_table(path: Path, table: pd.DataFrame) -> None:
    """Write a table as CSV."""
    write_text(path, table.to_csv(index=False, lineterminator="\n"))


def alike(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows with the keys of all, empty where they have none of their own.

    >>> alike([{"a": 1}, {"b": 2}])
    [{'a': 1, 'b': ''}, {'a': '', 'b': 2}]
    """
    keys = dict.fromkeys(key for row in rows for key in row)
    return [{key: row.get(key, "") for key in keys} for row in rows]


def read_rows(path: Path, *columns: str) -> list[dict[str, str]]:
    """Rows of a CSV table that `write_rows` or `write_table` wrote, as text. Raises ResultError if it is none, as after
    a power cut, or has rows and lacks a column.
    """
    try:
        text = path.read_bytes().decode()
        header, *lines = csv.reader(io.StringIO(text, newline=""), strict=True)
        rows = [dict(zip(header, cells, strict=True)) for cells in lines]
    except (ValueError, csv.Error) as error:
        raise foreign(path, error) from error
    if not text.endswith("\n"):
        raise foreign(path, "its last line does not end")
    if missing := [name for name in columns if rows and name not in header]:
        raise foreign(path, f"no column {', '.join(missing)}")
    return rows


def read_table(path: Path) -> pd.DataFrame:
    """The same as a table, with numbers as such; of an empty line, one without columns. Raises ResultError."""
    import pandas as pd  # noqa: PLC0415 - jobs that read no tables do without

    read_rows(path)
    try:
        return pd.read_csv(path)
    except pd.errors.EmptyDataError:
        return pd.DataFrame()


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
