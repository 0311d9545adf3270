"""How scores compare: which are one, which are closer than their errors, and which is larger."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..arrays import FloatArray

SAME = 1e-6  # relative difference [1] up to which scores count as one; source: those of mirrored stimuli differ by 1e-8
CONSTANT = 1e-9  # spread relative to the largest value below which values count as equal [1]; the solver's tolerance


class Relation(StrEnum):
    """How a score compares to another. SAME: but for the solver's tolerance. NEAR: within the sum of both errors."""

    LESS = "<"
    SAME = "="
    NEAR = "\N{ALMOST EQUAL TO}"
    MORE = ">"


@dataclass(frozen=True)
class Score:
    """A score and its error, in one unit; an infinite error where it is not known."""

    value: float
    error: float


def relation(one: Score, other: Score) -> Relation:
    """How one score compares to another.

    >>> [str(relation(Score(1.0, 0.1), Score(other, 0.1))) for other in (1.0, 1.1, 1.3, 0.7)]
    ['=', '≈', '<', '>']
    """
    difference = abs(other.value - one.value)
    if difference <= SAME * max(abs(one.value), abs(other.value)):
        return Relation.SAME
    if difference <= one.error + other.error:
        return Relation.NEAR
    return Relation.LESS if one.value < other.value else Relation.MORE


def classes(scores: FloatArray) -> np.ndarray:
    """Place (n,) of each score among those that differ, from 0: scores (n,) that only rounding tells apart from the
    next one share its place, as `relation` has it.

    >>> classes(np.array([2.0, 1.0, 2.0 + 1e-9, 1.5])).tolist()
    [2, 0, 2, 1]
    """
    order = np.argsort(scores, kind="stable")
    sizes = np.abs(scores[order])
    steps = np.diff(scores[order]) > SAME * np.maximum(sizes[1:], sizes[:-1])
    places = np.zeros(scores.size, dtype=np.int64)
    places[order[1:]] = np.cumsum(steps)
    return places


def is_constant(values: FloatArray) -> bool:
    """Whether all values (n,) count as equal."""
    return bool(np.ptp(values) <= CONSTANT * np.abs(values).max())
