"""What is said of a row of the table of correlations: its slope, whether that is open, and whether it has a p."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from .ratings import RatingKind

SLOPE_NAME = {-1: "falling", 0: "level", 1: "rising"}  # by its sign
SMALLEST_P = 0.001  # below it p is given as a bound
OPEN_SLOPE = "open: errors of scores leave the slope's sign open."  # behind `slope_name`, in captions


def has_p(p: object, kind: object) -> bool:
    """Whether a p is there and tests anything: the steps of ordinal surrogates, a `label`, are no measurement."""
    return bool(pd.notna(p)) and p != "" and kind != RatingKind.SURROGATE.label


def is_open(row: Mapping[str, Any]) -> bool:
    """Whether errors of scores leave open which way the slope is of a row of the correlation table, also as text."""
    return has_error(row) and bool(int(row["slope_open"]))


def has_error(row: Mapping[str, Any]) -> bool:
    """Whether it is known what errors of scores add up to in a row of the correlation table, also as text."""
    return bool(row["r_error"] != "" and pd.notna(row["r_error"]))


def slope_name(row: Mapping[str, Any]) -> str:
    """Which way the slope is of a row of the correlation table, also as text, and whether that is open.

    >>> rows = {"slope_sign": "-1", "r_error": "0.6", "slope_open": "1"}, {"slope_sign": 1, "r_error": ""}
    >>> tuple(slope_name(row) for row in rows)
    ('falling (open)', 'rising (error unknown)')
    """
    doubt = " (open)" if is_open(row) else "" if has_error(row) else " (error unknown)"
    return SLOPE_NAME[int(row["slope_sign"])] + doubt
