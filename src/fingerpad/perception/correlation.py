"""How a score correlates with perceived roughness.

Where only the order of the ratings is known (`ordinal surrogate`), one R² says little. So it stands beside the
range of R² over *all* ratings which agree with the stated order, which needs no numbers at all (`extremes`).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import kendalltau, pearsonr

from ..arrays import FloatArray
from ..csvrows import listed
from ..errors import RatingError
from ..readouts.comparison import classes
from ..readouts.roughness import KEY, NO_PREDICTION
from ..scene.readout import is_constant
from .extremes import RatingRange, rating_range, unit
from .ratings import NO_RATINGS, RatingKind, order_matrix

COLUMNS = [
    *KEY,
    "n",
    "spread",
    "slope_sign",
    "r2",
    "r_error",
    "slope_open",
    "r_lowest",
    "r_highest",
    "r2_lowest",
    "r2_highest",
    "range_error",
    "range_open",
    "kendall_tau",
    "p",
    "published_r2",
    "published_slope",
    "published_words",
    "rating_kind",
    "note",
]

PUBLISHED = [column for column in COLUMNS if column.startswith("published")]

CONSTANT_SCORE = "constant score"


def error_in_r(score: FloatArray, rating: FloatArray, error: FloatArray) -> float:
    """What errors (n,) of scores (n,) can add up to in r with ratings (n,) [1]; not a number if they are not known.

    With x, y centred and scaled to norm 1, |S| the norm of the centred scores and errors d_i, that is to first order
        sum |y_i - r x_i| d_i / |S|,
    and no less than what turns the slope, sum |y_i| d_i / |S|, where that is more than |r|.

    >>> round(error_in_r(np.array([1.0, 3.0, 2.0]), np.array([1.0, 2.0, 3.0]), np.full(3, 0.25)), 12)
    0.25
    """
    first, turning, r = _moved(score, rating, error)
    return max(first, turning) if turning > abs(r) else first


def is_turned(score: FloatArray, rating: FloatArray, error: FloatArray) -> bool:
    """Whether errors (n,) of scores (n,) can change the sign of the slope with ratings (n,): exactly if
    sum |y_i| d_i / |S| > |r| (see `error_in_r`). Not where they are not known.
    """
    _, turning, r = _moved(score, rating, error)
    return turning > abs(r)


def _moved(score: FloatArray, rating: FloatArray, error: FloatArray) -> tuple[float, float, float]:
    """Both sums of `error_in_r` [1], and r [1]."""
    x, y, share = unit(score), unit(rating), error / np.linalg.norm(score - score.mean())
    r = float(x @ y)
    return float(np.abs(y - r * x) @ share), float(np.abs(y) @ share), r


def _range_errors(score: FloatArray, over: RatingRange, error: FloatArray) -> tuple[float, bool]:
    """What errors (n,) of scores (n,) can add up to in the ends of the range of r, and with generators that they turn;
    and whether they turn any rating's slope.

    No rating's slope turns if those of all generators have one sign and none of them turns: sum |y_i| d_i <= |<S, y>|
    then holds for their sums, too. With both signs some rating's slope is zero (r2 then reaches down to it), and any
    error turns that.
    """
    turned = [rating for rating in over.generators if is_turned(score, rating, error)]
    level = over.r[0] < 0.0 < over.r[1] and over.r2[0] == 0.0 and bool((error > 0.0).any())
    return max(error_in_r(score, rating, error) for rating in (*over.ratings, *turned)), bool(turned) or level


def correlation_table(
    scores: pd.DataFrame, ratings: pd.DataFrame, order: pd.DataFrame, published: pd.DataFrame
) -> pd.DataFrame:
    """How each score correlates with perceived roughness: a row for each kinematics, device, interface and
    read-out.

    scores: columns kinematics, device, condition, interface, readout, score [any unit, NaN without a prediction],
    score_error [the same unit, NaN if it is not known], note. ratings, order, published: see `read_ratings`,
    `read_stated_order`, `read_published`.

    Returns the columns COLUMNS:
    n: conditions correlated. spread: range of the scores over the mean of their sizes, empty if all are zero.
    slope_sign: of rating on score, -1, 0 or 1. r2: squared Pearson correlation. r_error: what errors of scores can add
    up to in r (`error_in_r`), and slope_open: 1 where they leave the slope's sign open, else 0; empty if they are not
    known.
    r_lowest, r_highest: of r over all ratings that agree with the stated order (`rating_range`), and r2_lowest,
    r2_highest: of R², whichever way the slope then is; range_error and range_open: as r_error,
    the larger of those at both ends of r, and 1 if some rating's slope is open; empty without an order.
    kendall_tau: tau-b; scores that only rounding tells apart are tied. p: two-sided p of the Pearson correlation over
    distinct conditions: those that share a stimulus, or have mirrored ones, have one score, and count once with the
    mean of their ratings (the note then says how many are distinct).
    published_slope: -1 or 1, empty if nothing is said of it. rating_kind: the `label` of RatingKind. note: why numbers
    are missing, or what to beware of.

    Raises RatingError if scores and ratings of a device are not of the same conditions, and as `order_matrix` and
    `rating_range`.
    """
    rows = [
        {**dict(zip(KEY, key, strict=True)), **_correlate(group, *(t[t["device"] == key[1]] for t in (ratings, order)))}
        for key, group in scores.groupby(KEY, sort=False)
    ]
    said = published.rename(columns={name: f"published_{name}" for name in ("r2", "slope", "words")})
    computed = pd.DataFrame(rows, columns=[column for column in COLUMNS if column not in PUBLISHED])
    same = KEY[1:]  # the paper does not say with which kinematics
    table = computed.merge(said[[*same, *PUBLISHED]], how="left", on=same, validate="m:1")
    ranges = ("r_lowest", "r_highest", "r2_lowest", "r2_highest", "range_error")
    numbers = ("spread", "r2", "r_error", *ranges, "kendall_tau", "p", "published_r2")
    signs = dict.fromkeys(("slope_sign", "slope_open", "range_open", "published_slope"), "Int64")
    table = table.astype({"n": "int64", **signs, **dict.fromkeys(numbers, "float64")})
    return table[COLUMNS].fillna({"published_words": ""})


def _correlate(scores: pd.DataFrame, ratings: pd.DataFrame, order: pd.DataFrame) -> dict[str, Any]:
    """The correlation of one device, interface and read-out; columns that are left out are empty."""
    score = scores.set_index("condition")["score"].astype(float)
    rating = ratings.set_index("condition")["rating"].astype(float)
    kind = RatingKind(ratings["kind"].iloc[0]).label if len(ratings) else ""
    if score.isna().any():
        reasons = [note for note in scores.loc[scores["score"].isna(), "note"].unique() if isinstance(note, str)]
        return {"n": 0, "rating_kind": kind, "note": "; ".join(filter(None, reasons)) or NO_PREDICTION}
    x = score.to_numpy()
    size = float(np.abs(x).mean())
    found: dict[str, Any] = {"spread": float(np.ptp(x)) / size if size > 0.0 else None, "rating_kind": kind}
    if rating.empty:
        return {**found, "n": 0, "note": NO_RATINGS}
    if odd := sorted(set(score.index) ^ set(rating.index)):
        where = ", ".join(scores[KEY].iloc[0])
        raise RatingError(f"{where}: scores and ratings are not of the same conditions; in one only: {listed(odd)}")
    y = rating.loc[score.index].to_numpy()
    found["n"] = x.size
    which = classes(x)
    for is_one, note in ((not which.any(), CONSTANT_SCORE), (is_constant(y), "constant rating")):
        if is_one:
            return {**found, "note": note}
    if x.size < 3:
        return {**found, "note": "fewer than three conditions"}
    distinct = np.bincount(which, x) / np.bincount(which)
    notes = [] if distinct.size == x.size else [f"{distinct.size} of {x.size} conditions are distinct"]
    error = scores["score_error"].to_numpy(float)
    known = bool(np.isfinite(error).all())
    if len(order):
        at_most = order_matrix(list(score.index), order)
        found |= _over_ratings(x, at_most, error, known)
        notes += _contradictions(y, at_most)
    r = float(pearsonr(x, y).statistic)
    mean_rating = np.bincount(which, y) / np.bincount(which)
    return {
        **found,
        "slope_sign": int(np.sign(r)),
        "r2": r**2,
        "r_error": error_in_r(x, y, error),
        "slope_open": int(is_turned(x, y, error)) if known else None,
        "kendall_tau": float(kendalltau(which, y).statistic),
        "p": float(pearsonr(distinct, mean_rating).pvalue)
        if distinct.size > 2 and not is_constant(mean_rating)
        else None,
        "note": "; ".join(notes),
    }


def _over_ratings(score: FloatArray, at_most: np.ndarray, error: FloatArray, known: bool) -> dict[str, Any]:
    """What all ratings that agree with an order (n, n) give, and how far errors (n,) of scores (n,) move it."""
    over = rating_range(score, at_most)
    range_error, is_open = _range_errors(score, over, error)
    return {
        **dict(zip(("r_lowest", "r_highest"), over.r, strict=True)),
        **dict(zip(("r2_lowest", "r2_highest"), over.r2, strict=True)),
        "range_error": range_error,
        "range_open": int(is_open) if known else None,
    }


def _contradictions(rating: FloatArray, at_most: np.ndarray) -> list[str]:
    """In words what ratings (n,) have against an order (n, n)."""
    equal = at_most & at_most.T
    against = {
        "ratings contradict the stated order": at_most & ~equal & (rating[:, None] >= rating[None, :]),
        "ratings differ that are stated to be equal": equal & (rating[:, None] != rating[None, :]),
    }
    return [words for words, pairs in against.items() if pairs.any()]
