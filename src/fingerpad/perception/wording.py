"""What is said of a row of the table of correlations, of pandas or of text: slope, range, p, what is published."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import pandas as pd

from ..words import MINUS
from .ratings import RatingKind

SLOPE_NAME = {-1: "falling", 0: "level", 1: "rising"}  # by its sign
TAU = ("kendall_tau", "tau_lowest", "tau_highest")
SMALLEST_P = 0.001  # below it p is given as a bound
SURROGATE = "surrogates' R²"  # that over ordinal surrogates, whose steps mean nothing
# behind `slope_name` and `range_text`, in captions
OPEN_SLOPE = "Open: errors of scores could reverse the slope; behind a range, only with some of the ratings in it."


def has_p(p: object, kind: object) -> bool:
    """Whether there is a p that means something: the steps between ordinal surrogates were not measured. kind: a
    `RatingKind.label`.
    """
    return _is_there(p) and kind != RatingKind.SURROGATE.label


def p_text(p: object) -> str:
    r"""A p as it is shown: two digits, or a bound.

    >>> p_text("1.9e-06"), p_text(0.0493), p_text("0.199")
    ('<\xa00.001', '0.049', '0.20')
    """
    value = float(str(p))
    return f"{value:#.2g}" if value >= SMALLEST_P else f"<\N{NO-BREAK SPACE}{SMALLEST_P:g}"


def is_surrogate(row: Mapping[str, Any]) -> bool:
    """Whether R² is over ordinal surrogates, whose steps were not measured: then its range says more than it does."""
    return bool(row["rating_kind"] == RatingKind.SURROGATE.label)


def r2_text(row: Mapping[str, Any]) -> str:
    """R² as it is shown: to three decimals, over ordinal surrogates to two.

    >>> [r2_text({"r2": "0.96604", "rating_kind": kind}) for kind in ("measured", "ordinal surrogate")]
    ['0.966', '0.97']
    """
    return f"{float(row['r2']):.{2 if is_surrogate(row) else 3}f}"


def tau_text(row: Mapping[str, Any]) -> str:
    r"""Kendall's tau as it is shown, and from where to where errors of scores leave it, if they do.

    >>> tau_text({"kendall_tau": "-0.6667", "tau_lowest": "", "tau_highest": ""}) == "\N{MINUS SIGN}0.67"
    True
    >>> tau_text({"kendall_tau": "1.0", "tau_lowest": "0.33333", "tau_highest": "1.0"})
    '1.00 (0.33 to 1.00)'
    """
    tau, *ends = (f"{float(str(row[each])):.2f}" for each in TAU if _is_there(row[each]))
    between = f" ({ends[0]} to {ends[1]})" if ends and ends[0] != ends[1] else ""
    return f"{tau}{between}".replace("-", MINUS)


def is_open(row: Mapping[str, Any]) -> bool:
    """Whether errors of scores leave open which way the slope is."""
    return has_r_error(row) and bool(int(row["slope_open"]))


def is_range_open(row: Mapping[str, Any]) -> bool:
    """Whether errors of scores leave open which way the slope is with some ratings that have the stated order."""
    return _is_there(row["range_open"]) and bool(int(row["range_open"]))


def has_open(rows: Iterable[Mapping[str, Any]]) -> bool:
    """Whether a slope of some rows is open, with their own ratings or with others."""
    return any(is_open(row) or is_range_open(row) for row in rows)


def has_r_error(row: Mapping[str, Any]) -> bool:
    """Whether it is known what errors of scores can change in r."""
    return _is_there(row["r_error"])


def slope_name(row: Mapping[str, Any]) -> str:
    """Which way the slope is, and whether that is open.

    >>> rows = {"slope_sign": "-1", "r_error": "0.6", "slope_open": "1"}, {"slope_sign": 1, "r_error": ""}
    >>> tuple(slope_name(row) for row in rows)
    ('falling (open)', 'rising (error unknown)')
    """
    doubt = " (open)" if is_open(row) else "" if has_r_error(row) else " (error unknown)"
    return SLOPE_NAME[int(row["slope_sign"])] + doubt


def range_text(row: Mapping[str, Any]) -> str:
    """Lowest and highest R² over all ratings with the stated order, and whether the slope of some of them is open where
    its own is not; nothing without an order.

    >>> row = {"r_error": "0.2", "slope_open": "0", "r2_lowest": "0.0", "r2_highest": "0.75"}
    >>> [range_text(row | {"range_open": is_open}) for is_open in "01"], range_text({"r2_lowest": ""})
    (['0.00 to 0.75', '0.00 to 0.75, open'], '')
    """
    if not _is_there(row["r2_lowest"]):
        return ""
    doubt = ", open" if is_range_open(row) and not is_open(row) else ""
    return f"{float(row['r2_lowest']):.2f} to {float(row['r2_highest']):.2f}{doubt}"


def published_text(row: Mapping[str, Any]) -> str:
    """The published R² and which way its slope is, if that is said, or what is said in words; nothing if nothing is.

    >>> words = {"published_r2": "", "published_words": "weakly"}
    >>> published_text(words), published_text(words | {"published_r2": 0.989, "published_slope": 1})
    ('weakly', '0.989, rising')
    """
    if not _is_there(row["published_r2"]):
        return str(row["published_words"]) if _is_there(row["published_words"]) else ""
    slope = f", {SLOPE_NAME[int(row['published_slope'])]}" if _is_there(row["published_slope"]) else ""
    return f"{float(row['published_r2']):g}{slope}"


def _is_there(value: object) -> bool:
    """Whether a cell is not empty."""
    return bool(pd.notna(value)) and value != ""
