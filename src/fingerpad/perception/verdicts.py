"""Verdicts on comparisons of scores and of correlations: yes, no, or undecided.

A comparison is undecided if the numbers differ by less than their errors, or if errors are not known; and, where only
the order of ratings is known, if some ratings in that order would support it and others not.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import Any

import pandas as pd

from ..readouts.comparison import Relation, Score, relation
from .ratings import RatingKind


class Holds(StrEnum):
    """Whether a statement holds; undecided where errors of scores or the choice of ratings leave it open."""

    YES = "yes"
    NO = "no"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Correlation:
    """Pearson's r [1] over all ratings that may be meant: its lowest and highest value, and those of |r|. error: what
    errors of scores can change in it at most, infinite if they are not known. is_open: whether they leave the sign of
    some of them open.
    """

    ends: tuple[float, float]
    strengths: tuple[float, float]
    error: float
    is_open: bool


IS_LESS = {
    Relation.LESS: Holds.YES, Relation.NEAR: Holds.UNDECIDED, Relation.SAME: Holds.NO, Relation.MORE: Holds.NO,
}  # fmt: skip
Chain = Sequence[tuple[str, Score]]  # (label, score), in the order in which the scores should rise


def relations(chain: Chain) -> list[Relation]:
    """The `relation` of every score in a chain to the one after it."""
    return [relation(low, high) for (_, low), (_, high) in pairwise(chain)]


def rises(steps: Sequence[Relation]) -> Holds:
    """Whether each of the steps rises."""
    return all_hold([IS_LESS[step] for step in steps])


def misses(steps: Sequence[Relation]) -> Holds:
    """Whether one of the steps does not rise."""
    return {Holds.YES: Holds.NO, Holds.NO: Holds.YES, Holds.UNDECIDED: Holds.UNDECIDED}[rises(steps)]


def chain_text(chain: Chain) -> str:
    """The chain as it is, right or wrong: `0°: 1.2 < 90°: 1.5 > 180°: 1.3`."""
    texts = [f"{label}: {score.value:.4g}" for label, score in chain]
    return " ".join([texts[0], *(f"{step} {text}" for step, text in zip(relations(chain), texts[1:], strict=True))])


def held(holds: bool) -> Holds:
    """The verdict on what is certain."""
    return Holds.YES if holds else Holds.NO


def all_hold(parts: Sequence[Holds]) -> Holds:
    """Whether every part of a statement holds."""
    if Holds.NO in parts:
        return Holds.NO
    return Holds.UNDECIDED if Holds.UNDECIDED in parts else Holds.YES


def throughout(ends: Sequence[Holds]) -> Holds:
    """Whether a statement holds over a range, from whether it does at its ends."""
    return ends[0] if len(set(ends)) == 1 else Holds.UNDECIDED


def is_lower(low: Score, high: Score) -> Holds:
    """Whether a score is lower than another."""
    return IS_LESS[relation(low, high)]


def is_less(low: float, high: float, error: float) -> Holds:
    """Whether a number is less than another, by more than an error."""
    return Holds.UNDECIDED if abs(high - low) < error else held(low < high)


def slope_of(row: Mapping[str, Any]) -> int:
    """Sign of the slope; 0 also where there is none, as for a constant score."""
    return 0 if pd.isna(row["slope_sign"]) else int(row["slope_sign"])


def is_surrogate(row: Mapping[str, Any]) -> bool:
    """Whether a correlation is one with ordinal surrogates."""
    return bool(row["rating_kind"] == RatingKind.SURROGATE.label)


def r_of(row: Mapping[str, Any]) -> Correlation:
    """Pearson's r [1]. With surrogates it is over all ratings in the stated order, or over all there are if no order is
    stated. A constant score has r = 0.
    """
    if pd.isna(row["r2"]):
        return Correlation((0.0, 0.0), (0.0, 0.0), error=0.0, is_open=False)
    if not is_surrogate(row):
        r = slope_of(row) * math.sqrt(row["r2"])
        return Correlation((r, r), (abs(r), abs(r)), *_errors(row["r_error"], row["slope_open"]))
    if pd.isna(row["r2_lowest"]):
        return Correlation((-1.0, 1.0), (0.0, 1.0), error=math.inf, is_open=True)
    strengths = math.sqrt(row["r2_lowest"]), math.sqrt(row["r2_highest"])
    return Correlation((row["r_lowest"], row["r_highest"]), strengths, *_errors(row["range_error"], row["range_open"]))


def _errors(error: float, is_open: float) -> tuple[float, bool]:
    """What errors of scores leave open of a correlation: all where they are not known."""
    return (math.inf, True) if pd.isna(error) else (float(error), bool(is_open))
