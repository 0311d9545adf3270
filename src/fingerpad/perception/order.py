"""The stated order of ratings: what it implies for every pair of conditions, and the ratings that it leaves."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from ..csvrows import listed
from ..errors import RatingError

BoolArray = NDArray[np.bool_]

MAX_UP_SETS = 2**16  # up-sets of a stated order that are enumerated; 16 conditions without any order have as many


class StatedRelation(StrEnum):
    """How the ratings of two conditions are stated to compare."""

    LESS = "<"
    EQUAL = "="


def order_matrix(conditions: Sequence[str], order: pd.DataFrame) -> BoolArray:
    """What a stated order implies for every pair of conditions (its reflexive and transitive closure).

    order: the rows of one device with columns lower, relation, higher. Returns an (n, n) matrix; [i, j] says
    whether rating i <= rating j. Raises RatingError for an unknown condition, and for a contradiction.

    >>> order_matrix(["a", "b"], pd.DataFrame([["a", "<", "b"]], columns=["lower", "relation", "higher"])).tolist()
    [[True, True], [False, True]]
    """
    index = {name: i for i, name in enumerate(conditions)}
    if unknown := [name for name in (*order["lower"], *order["higher"]) if name not in index]:
        raise RatingError(f"stated order: found {listed(unknown[:1])}; allowed: {listed(conditions)}")
    stated = [(index[a], r, index[b]) for a, r, b in order[["lower", "relation", "higher"]].itertuples(index=False)]
    at_most = np.eye(len(conditions), dtype=bool)
    for low, relation, high in stated:
        at_most[low, high] = True
        at_most[high, low] |= relation == StatedRelation.EQUAL
    for via in range(len(conditions)):
        at_most |= at_most[:, [via]] & at_most[[via], :]
    for low, relation, high in stated:
        if relation == StatedRelation.LESS and at_most[high, low]:
            raise RatingError(
                f"stated order contradicts itself: '{conditions[low]}' < '{conditions[high]}', and other rows"
                f" say that '{conditions[high]}' is not above '{conditions[low]}'"
            )
    return at_most


def up_sets(at_most: BoolArray) -> BoolArray:
    """Sets of conditions which hold, with any condition, all that are rated at least as high.

    at_most: (n, n) from `order_matrix`. Returns (k, n) indicators without the empty set and the whole.
    Raises RatingError if there are none, as all ratings are equal, or more than MAX_UP_SETS.

    >>> up_sets(np.array([[True, True], [False, True]])).tolist()
    [[False, True]]
    """
    sets = np.zeros((1, 0), dtype=bool)
    for i in range(len(at_most)):
        below, above = at_most[:i, i], at_most[i, :i]
        may_be_out = ~(sets & below).any(axis=1)
        may_be_in = (sets | ~above).all(axis=1)
        sets = np.vstack([np.insert(sets[may_be_out], i, False, axis=1), np.insert(sets[may_be_in], i, True, axis=1)])
        if len(sets) > MAX_UP_SETS + 2:
            raise RatingError(
                f"the stated order leaves more than {MAX_UP_SETS} up-sets among {len(at_most)} conditions,"
                " too many for the range of R²; state more of the order, or nothing for this device"
            )
    found = sets[sets.any(axis=1) & ~sets.all(axis=1)]
    if not len(found):
        raise RatingError("the stated order makes all ratings equal, so nothing can correlate with them")
    return found
