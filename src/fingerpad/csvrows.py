"""Rows of a CSV file that a user wrote, each with its line; and the one form in which a mistake in it is told."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from io import StringIO
from pathlib import Path

from .errors import FingerpadError
from .files import require_readable
from .guess import TYPED, closest, hint

LARGEST_FILE = 50_000_000  # bytes; source: assumption: the longest recording, ten thousand times of 64 actuators

COMMA = "a decimal comma? a number has a point; or text with a comma, which needs quotes"


def checked_rows(
    path: Path, columns: Sequence[str], error: type[FingerpadError], least: int = 1
) -> list[tuple[int, dict[str, str]]]:
    """The rows of a CSV with exactly these columns, in any order; each with its line number.

    Empty lines are left out, and blanks around cells. Raises `error` if the file cannot be read, is no CSV, has other
    columns or fewer than `least` rows.
    """
    lines = _cells(path, error)
    if len(lines) < 1 + least:
        found = "a header without rows" if lines else "an empty file"
        raise error(f"{path}: found {found}; allowed: rows with the columns {listed(columns)}")
    line, header = lines[0]
    if len(header) == 1 and (other := re.search("[;\t|]", header[0])):
        raise error(f"{path}, line {line}: found columns that are separated by {other[0]!r}; allowed: by ','")
    for name in header:
        if name not in columns:
            raise error(told(path, line, "header", name, columns))
        if header.count(name) > 1:
            raise error(told(path, line, "header", name, f"each column once: {listed(columns)}"))
    if missing := [name for name in columns if name not in header]:
        raise error(f"{path}, line {line}: column {listed(missing)} is missing; allowed: {listed(columns)}")
    for line, cells in lines[1:]:
        if len(cells) == 1 and (other := re.search("[;\t|]", cells[0])):
            raise error(f"{path}, line {line}: found values that are separated by {other[0]!r}; allowed: by ','")
        if len(cells) != len(header):
            comma = f"; {COMMA}" if len(cells) > len(header) else ""
            allowed = f"{len(header)}, for {listed(header)}{comma}"
            raise error(
                f"{path}, line {line}: found {len(cells)} value{'' if len(cells) == 1 else 's'}; allowed: {allowed}"
            )
    return [(line, dict(zip(header, cells, strict=True))) for line, cells in lines[1:]]


def _cells(path: Path, error: type[FingerpadError]) -> list[tuple[int, list[str]]]:
    """Lines that are not empty, with their numbers. Raises `error` if the file cannot be read or is no CSV."""
    line, lines = 0, []
    try:
        require_readable(path, LARGEST_FILE, "CSV", error)
        text = path.read_bytes().decode("utf-8-sig")
        reader = csv.reader(StringIO(text, newline=""), strict=True)
        for row in reader:
            line = reader.line_num
            if any(map(str.strip, row)):
                lines.append((line, [cell.strip() for cell in row]))
    except OSError as failure:
        others = [] if path.exists() else sorted(path.parent.glob("*.csv"))
        meant = hint(closest(path.name, [other.name for other in others if other.is_file()]))
        why = "it is a link to nothing" if path.is_symlink() and not path.exists() else failure.strerror
        raise error(f"{path}: cannot be read: {why}{meant}") from failure
    except UnicodeDecodeError as failure:
        line = 1 + failure.object.count(b"\n", 0, failure.start)
        found = f"a byte {failure.object[failure.start]:#x} that is not UTF-8"
        raise error(f"{path}, line {line}: found {found}; allowed: UTF-8; save it as CSV UTF-8") from failure
    except csv.Error as failure:
        raise error(f"{path}: is not a CSV file: after line {line}: {failure}") from failure
    return lines


def told(path: Path, line: int, column: str, found: str, allowed: Sequence[str], meant: str = "") -> str:
    """What is wrong with a cell. allowed: a phrase, or the names among which the one that was meant is guessed; of a
    number with a decimal comma or a typeset minus it is that as programs write it.
    """
    close = [] if isinstance(allowed, str) else get_close_matches(found, allowed, n=len(allowed) or 1)
    guess = sorted(close, key=lambda name: not name.startswith(found))  # of equally close ones that which goes on
    names = allowed if isinstance(allowed, str) else listed(allowed)
    typed = found.translate(TYPED)
    is_typeset = isinstance(allowed, str) and typed != found and math.isfinite(number(typed))
    guessed = hint(typed if is_typeset else next(iter(guess), meant), "'")
    said = f"'{found}'" if found.isprintable() else ascii(found)
    return f"{path}, line {line}, column {column}: found {said}; allowed: {names}{guessed}"


def listed(names: Iterable[str]) -> str:
    """Names in a message."""
    return ", ".join(f"'{name}'" for name in names)


def number(text: str) -> float:
    """The number in a cell; NaN if there is none. Python alone would also take 1_000 and digits of any script.

    >>> number("1e-3"), number("0.0_2")
    (0.001, nan)
    """
    try:
        return float(text) if text.isascii() and "_" not in text else math.nan
    except ValueError:
        return math.nan
