"""Rows of a CSV file that a user wrote, each with its line; and the one form in which a mistake in it is told."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path

from .errors import FingerpadError


def checked_rows(path: Path, columns: Sequence[str], error: type[FingerpadError]) -> list[tuple[int, dict[str, str]]]:
    """The rows of a CSV with exactly these columns, in any order; each with its line number.

    Empty lines are left out, and blanks around cells. Raises `error` if the file cannot be read, is no CSV, has other
    columns or no rows.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, strict=True)
            lines = [(reader.line_num, [cell.strip() for cell in row]) for row in reader if any(map(str.strip, row))]
    except OSError as failure:
        raise error(f"{path}: cannot be read: {failure.strerror}") from failure
    except (csv.Error, UnicodeDecodeError) as failure:
        raise error(f"{path}: is not a CSV file in UTF-8: {failure}") from failure
    if len(lines) < 2:
        found = "a header without rows" if lines else "an empty file"
        raise error(f"{path}: found {found}; allowed: rows with the columns {listed(columns)}")
    line, header = lines[0]
    for name in header:
        if name not in columns:
            raise error(told(path, line, "header", name, columns))
        if header.count(name) > 1:
            raise error(told(path, line, "header", name, f"each column once: {listed(columns)}"))
    if missing := [name for name in columns if name not in header]:
        raise error(f"{path}, line {line}: column {listed(missing)} is missing; allowed: {listed(columns)}")
    for line, cells in lines[1:]:
        if len(cells) != len(header):
            raise error(f"{path}, line {line}: found {len(cells)} values; allowed: {len(header)}, for {listed(header)}")
    return [(line, dict(zip(header, cells, strict=True))) for line, cells in lines[1:]]


def told(path: Path, line: int, column: str, found: str, allowed: Sequence[str], meant: str = "") -> str:
    """What is wrong with a cell. allowed: a phrase, or the names among which the one that was meant is guessed."""
    guess = [] if isinstance(allowed, str) else get_close_matches(found, allowed, n=1)
    names = allowed if isinstance(allowed, str) else listed(allowed)
    meant = next(iter(guess), meant)
    hint = f"; did you mean '{meant}'?" if meant else ""
    return f"{path}, line {line}, column {column}: found '{found}'; allowed: {names}{hint}"


def listed(names: Iterable[str]) -> str:
    """Names in a message."""
    return ", ".join(f"'{name}'" for name in names)


def number(text: str) -> float:
    """The number in a cell; NaN if there is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan
