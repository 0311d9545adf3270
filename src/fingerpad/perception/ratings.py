"""Perceived roughness: ratings, what is stated of their order, and published correlations, read and checked."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import pandas as pd

from ..csvrows import checked_rows, listed, number, told
from ..errors import RatingError
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from .order import StatedRelation, order_matrix, up_sets

RATING_COLUMNS = ("device", "condition", "rating", "kind", "source")
ORDER_COLUMNS = ("device", "lower", "relation", "higher", "source")
OF_DEVICES = " (a device with a file, in config/devices or among the scenes asked for)"
NO_RATINGS = "no ratings"  # note of a device that nobody has rated
PUBLISHED_COLUMNS = ("device", "interface", "readout", "r2", "slope", "words", "source")
SMALLEST, LARGEST = 1e-100, 1e100  # of a rating, in its unit; source: sums of squares of these are numbers, too
SLOPES = {"": None, "-1": -1, "1": 1}  # of rating on score, as published


class RatingKind(StrEnum):
    """Where a rating comes from: an ordinal surrogate, read off a published figure, or measured."""

    SURROGATE = "surrogate"
    DIGITISED = "digitised"
    MEASURED = "measured"

    @property
    def label(self) -> str:
        """How figures and tables call it; a surrogate is always called an ordinal surrogate."""
        return "ordinal surrogate" if self is RatingKind.SURROGATE else self.value


@dataclass(frozen=True)
class Literature:
    """What scores are held against: ratings (`read_ratings`), what is stated of their order (`read_stated_order`), and
    published correlations (`read_published`).
    """

    ratings: pd.DataFrame
    order: pd.DataFrame
    published: pd.DataFrame


def read_literature(
    ratings: Path, order: Path, published: Path, conditions_by_device: Mapping[str, Sequence[str]]
) -> Literature:
    """All three tables, checked against the devices. Raises RatingError as their readers do."""
    return Literature(
        read_ratings(ratings, conditions_by_device),
        read_stated_order(order, conditions_by_device),
        read_published(published),
    )


def read_ratings(path: Path, conditions_by_device: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """Ratings of perceived roughness, checked against the devices they rate.

    path: CSV with the columns device, condition, rating (a number, any unit: R² does not see it), kind
    (surrogate, digitised or measured; one kind a device) and source. conditions_by_device: the condition names of
    every known device; one without any has been left out, and so are its rows. A device may be without ratings, but not
    with some only.

    Returns those columns, `rating` as float. Raises RatingError, which names file, line, column, what was found
    and what is allowed.

    >>> table = Path("data/ratings.csv")
    >>> known = pd.read_csv(table).groupby("device")["condition"].agg(list).to_dict()
    >>> read_ratings(table, known)[["condition", "kind"]].iloc[0].tolist()
    ['low_000', 'surrogate']
    """
    rows: list[dict[str, Any]] = []
    kinds: dict[str, tuple[str, int]] = {}
    lines: dict[tuple[str, str], int] = {}
    for line, row in _read_rows(path, RATING_COLUMNS):
        device, condition, kind = row["device"], row["condition"], row["kind"]
        _check_name(path, line, "device", device, conditions_by_device, OF_DEVICES)
        if not conditions_by_device[device]:
            continue
        _check_name(path, line, "condition", condition, conditions_by_device[device], _conditions_of(device))
        _check_name(path, line, "kind", kind, [*RatingKind])
        rating = number(row["rating"])
        if rating != 0.0 and not SMALLEST <= abs(rating) <= LARGEST:
            allowed = f"0, or a number of size {SMALLEST:g} to {LARGEST:g}"
            raise _error(path, line, "rating", row["rating"], allowed)
        if (device, condition) in lines:
            first = lines[device, condition]
            raise _error(path, line, "condition", condition, f"one row per condition; {device} has it on line {first}")
        first_kind, first = kinds.setdefault(device, (kind, line))
        if kind != first_kind:
            raise _error(path, line, "kind", kind, f"one kind a device; {device} has '{first_kind}' on line {first}")
        lines[device, condition] = line
        rows.append({**row, "rating": rating})
    for device in kinds:
        missing = [name for name in conditions_by_device[device] if (device, name) not in lines]
        if missing:
            raise RatingError(
                f"{path}, column condition: {device} has no rating for {listed(missing)};"
                " allowed: ratings for all conditions of a device, or for none"
            )
    return pd.DataFrame(rows, columns=list(RATING_COLUMNS))


def read_stated_order(path: Path, conditions_by_device: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """What is stated about the order of ratings, checked against the devices.

    path: CSV with the columns device, lower, relation (`<` or `=`), higher and source, a row for each pair of
    conditions. Rows of devices without conditions are left out. Returns those columns. Raises RatingError as
    `read_ratings` does, and as `order_matrix` and `up_sets`.
    """
    rows: list[dict[str, Any]] = []
    for line, row in _read_rows(path, ORDER_COLUMNS):
        _check_name(path, line, "device", row["device"], conditions_by_device, OF_DEVICES)
        if not conditions_by_device[row["device"]]:
            continue
        known, about = conditions_by_device[row["device"]], _conditions_of(row["device"])
        for column in ("lower", "higher"):
            _check_name(path, line, column, row[column], known, about)
        _check_name(path, line, "relation", row["relation"], [*StatedRelation])
        rows.append(dict(row))
    table = pd.DataFrame(rows, columns=list(ORDER_COLUMNS))
    for device, part in table.groupby("device", sort=False):
        try:
            up_sets(order_matrix(conditions_by_device[device], part))
        except RatingError as error:
            raise RatingError(f"{path}: {device}: {error}") from error
    return table


def read_published(path: Path) -> pd.DataFrame:
    """The published correlations: device, interface, readout, r2 (NaN where there are only words), slope (-1, 1, or
    None where nothing is said of it), words, source.

    Raises RatingError as `read_ratings` does.
    """
    rows: list[dict[str, Any]] = []
    lines: dict[tuple[str, ...], int] = {}
    for line, row in _read_rows(path, PUBLISHED_COLUMNS):
        _check_name(path, line, "interface", row["interface"], [*Interface])
        _check_name(path, line, "readout", row["readout"], [*Readout])
        r2 = number(row["r2"])
        if row["r2"] and not 0.0 <= r2 <= 1.0:
            raise _error(path, line, "r2", row["r2"], "a number from 0 to 1, or nothing")
        if row["slope"] not in SLOPES:
            raise _error(path, line, "slope", row["slope"], "1, -1, or nothing")
        case = row["device"], row["interface"], row["readout"]
        if case in lines:
            allowed = f"one row per device, interface and readout; {' '.join(case)} is on line {lines[case]}"
            raise _error(path, line, "device", row["device"], allowed)
        lines[case] = line
        rows.append({**row, "r2": r2, "slope": SLOPES[row["slope"]]})
    return pd.DataFrame(rows, columns=list(PUBLISHED_COLUMNS))


def _read_rows(path: Path, columns: Sequence[str]) -> list[tuple[int, dict[str, str]]]:
    """The rows of a CSV with exactly these columns, none without a source; each with its line number."""
    rows = checked_rows(path, columns, RatingError, least=0)
    for line, row in rows:
        if not row["source"]:
            raise _error(path, line, "source", "", "where the row comes from")
    return rows


def _conditions_of(device: str) -> str:
    """What names of conditions are allowed, in words."""
    return f" (conditions of {device} as its file has them)"


def _check_name(path: Path, line: int, column: str, found: str, allowed: Collection[str], about: str = "") -> None:
    """Raise RatingError, with some words behind, if what is found is not one of the names allowed."""
    if found not in allowed:
        raise RatingError(f"{_error(path, line, column, found, list(allowed))}{about}")


def _error(path: Path, line: int, column: str, found: str, allowed: Sequence[str]) -> RatingError:
    return RatingError(told(path, line, column, found, allowed))
