"""How a score correlates with perceived roughness.

Where only the order of the ratings is known (`ordinal surrogate`), one R² says little. So it stands beside the
range of R² over *all* ratings which agree with the stated order, which needs no numbers at all (`extremes`).
"""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import kendalltau, pearsonr

from ..arrays import FloatArray
from ..csvrows import listed
from ..errors import RatingError
from ..readouts.comparison import classes, is_constant
from ..readouts.roughness import NO_PREDICTION, SERIES
from .extremes import RatingRange, rating_range, unit
from .order import order_matrix
from .ratings import NO_RATINGS, Literature, RatingKind

COLUMNS = [
    *SERIES,
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
    "tau_lowest",
    "tau_highest",
    "p",
    "published_r2",
    "published_slope",
    "published_words",
    "rating_kind",
    "note",
]

PUBLISHED = [column for column in COLUMNS if column.startswith("published")]

CONSTANT_SCORE = "constant score"
MOST_CORNERS = 12  # scores [1] whose box of errors is gone through, corner by corner; source: milliseconds (measured)


def angle_of_errors(score: FloatArray, error: FloatArray) -> float:
    """Largest angle [rad] by which errors (n,) d of scores (n,) can turn these, centred to S; not a number if errors
    are not known. Where some S + e in their box is at a right angle to S, or beyond, pi stands for every angle.

    Else <S, S + e> > 0 in all of the box |e_i| <= d_i. Its ratio to the norm of S + e is then quasi-concave in e, so
    that the angle is largest at a corner. Of more than MOST_CORNERS scores, whose corners are too many, it is at most
    arcsin(|d| / |S|).

    >>> round(math.degrees(angle_of_errors(np.array([1.0, 3.0, 2.0]), np.array([0.0, 0.0, 0.75]))), 1)
    23.4
    """
    if is_turned(score, score, error):
        return math.pi
    if score.size > MOST_CORNERS:
        return math.asin(min(float(np.linalg.norm(error) / np.linalg.norm(score - score.mean())), 1.0))
    signs = np.array(list(product((-1.0, 1.0), repeat=score.size)))
    return float(np.arccos(np.clip(unit(score + error * signs) @ unit(score), -1.0, 1.0).min()))


def error_in_r(r: float, angle: float) -> float:
    """What scores that turn by an `angle` [rad] can change in Pearson's r [1], the cosine of theirs with the ratings:
    max(r - cos(theta + angle), cos(theta - angle) - r) with theta = arccos r. Not a number for such an angle.

    >>> round(error_in_r(0.5, math.pi / 3.0), 12), round(error_in_r(1.0, math.pi / 3.0), 12)
    (1.0, 0.5)
    """
    theta = math.acos(r)
    lowest, highest = np.cos(np.clip([theta + angle, theta - angle], 0.0, math.pi))
    return float(max(r - lowest, highest - r))


def tau_range(which: np.ndarray, score: FloatArray, error: FloatArray, rating: FloatArray) -> tuple[float, float]:
    """Lowest and highest that errors (n,) of scores (n,) can make of Kendall's tau-b with ratings (n,), at least and at
    most: as if each pair of scores within the sum of their errors could have either order by itself. which: (n,)
    `classes` of the scores; what is one stays one. Not a number if errors are not known.

    >>> score, error = np.array([1.0, 2.0, 2.5]), np.array([0.1, 0.3, 0.3])
    >>> [round(each, 12) for each in tau_range(np.arange(3), score, error, np.array([1.0, 2.0, 3.0]))]
    [0.333333333333, 1.0]
    """
    if not np.isfinite(error).all():
        return math.nan, math.nan
    first, second = np.triu_indices(score.size, 1)
    differ = which[first] != which[second]
    apart = np.sign(rating[second] - rating[first]) * differ
    is_open = np.abs(score[second] - score[first]) <= error[first] + error[second]
    sure = float((np.sign(score[second] - score[first]) * apart)[~is_open].sum())
    either = float(np.abs(apart[is_open]).sum())
    pairs = math.sqrt(differ.sum() * (rating[first] != rating[second]).sum())
    return (sure - either) / pairs, (sure + either) / pairs


def is_turned(score: FloatArray, rating: FloatArray, error: FloatArray) -> bool:
    """Whether errors (n,) d of scores (n,) can change the sign of the slope with ratings (n,). With y the ratings,
    centred and scaled to norm 1, and S the centred scores, they can exactly if sum |y_i| d_i > |<S, y>|. Not where they
    are not known.
    """
    y = unit(rating)
    return bool(np.abs(y) @ error > abs(y @ score))


def _is_any_turned(score: FloatArray, over: RatingRange, error: FloatArray) -> bool:
    """Whether errors (n,) of scores (n,) can change the sign of the slope with any rating in an order.

    No rating's slope turns if those of all generators have one sign and none of them turns: sum |y_i| d_i <= |<S, y>|
    then holds for their sums, too. With both signs some rating's slope is zero (r2 then reaches down to it), and any
    error turns that.
    """
    level = over.r[0] < 0.0 < over.r[1] and over.r2[0] == 0.0 and bool((error > 0.0).any())
    return level or any(is_turned(score, rating, error) for rating in over.generators)


def correlation_table(scores: pd.DataFrame, literature: Literature) -> pd.DataFrame:
    """How each score correlates with perceived roughness: a row for each kinematics, device, interface and
    read-out.

    scores: columns kinematics, device, condition, interface, readout, score [any unit, NaN without a prediction],
    score_error [the same unit, NaN if it is not known], note.

    Returns the columns COLUMNS:
    n: conditions correlated. spread: range of the scores over the mean of their sizes, empty if all are zero.
    slope_sign: of rating on score, -1, 0 or 1. r2: squared Pearson correlation. r_error: what errors of scores can
    change in r (`error_in_r`), at most, and slope_open: 1 where they leave the slope's sign open, else 0; empty if they
    are not known.
    r_lowest, r_highest: of r over all ratings that agree with the stated order (`rating_range`), and r2_lowest,
    r2_highest: of R², whichever way the slope then is; range_error and range_open: as r_error,
    the larger of those at both ends of r, and 1 if some rating's slope is open; empty without an order.
    kendall_tau: tau-b; scores that only rounding tells apart are tied. tau_lowest, tau_highest: what errors of scores
    can make of it, at least and at most (`tau_range`), empty if they are not known. p: two-sided p of the Pearson
    correlation over distinct conditions: those that share a stimulus, or have mirrored ones, have one score, and count
    once with the mean of their ratings (the note then says how many are distinct).
    published_slope: -1 or 1, empty if nothing is said of it. rating_kind: the `label` of RatingKind. note: why numbers
    are missing, or what to beware of.

    Raises RatingError if scores and ratings of a device are not of the same conditions, and as `order_matrix` and
    `rating_range`.
    """
    rows = [
        dict(zip(SERIES, key, strict=True))
        | _correlate(group, *(each[each["device"] == key[1]] for each in (literature.ratings, literature.order)))
        for key, group in scores.groupby(SERIES, sort=False)
    ]
    said = literature.published.rename(columns={name: f"published_{name}" for name in ("r2", "slope", "words")})
    computed = pd.DataFrame(rows, columns=[column for column in COLUMNS if column not in PUBLISHED])
    same = SERIES[1:]  # the paper does not say with which kinematics
    table = computed.merge(said[[*same, *PUBLISHED]], how="left", on=same, validate="m:1")
    ranges = ("r_lowest", "r_highest", "r2_lowest", "r2_highest", "range_error")
    tau = ("kendall_tau", "tau_lowest", "tau_highest")
    numbers = ("spread", "r2", "r_error", *ranges, *tau, "p", "published_r2")
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
        where = ", ".join(scores[SERIES].iloc[0])
        raise RatingError(f"{where}: scores and ratings are not of the same conditions; in one only: {listed(odd)}")
    y = rating.loc[score.index].to_numpy()
    found["n"] = x.size
    which = classes(x)
    for is_so, note in (
        (x.size < 3, "fewer than three conditions"),
        (not which.any(), CONSTANT_SCORE),
        (is_constant(y), "constant rating"),
    ):
        if is_so:
            return {**found, "note": note}
    distinct = np.bincount(which, x) / np.bincount(which)
    notes = [] if distinct.size == x.size else [f"{distinct.size} of {x.size} conditions are distinct"]
    error = scores["score_error"].to_numpy(float)
    known, angle = bool(np.isfinite(error).all()), angle_of_errors(x, error)
    if len(order):
        at_most = order_matrix(list(score.index), order)
        found |= _over_ratings(x, at_most, error, known, angle)
        notes += _contradictions(y, at_most)
    r = float(pearsonr(x, y).statistic)
    mean_rating = np.bincount(which, y) / np.bincount(which)
    return {
        **found,
        "slope_sign": int(np.sign(r)),
        "r2": r**2,
        "r_error": error_in_r(r, angle),
        "slope_open": int(is_turned(x, y, error)) if known else None,
        "kendall_tau": float(kendalltau(which, y).statistic),
        **dict(zip(("tau_lowest", "tau_highest"), tau_range(which, x, error, y), strict=True)),
        "p": float(pearsonr(distinct, mean_rating).pvalue)
        if distinct.size > 2 and not is_constant(mean_rating)
        else None,
        "note": "; ".join(notes),
    }


def _over_ratings(
    score: FloatArray, at_most: np.ndarray, error: FloatArray, known: bool, angle: float
) -> dict[str, Any]:
    """What all ratings that agree with an order (n, n) give, and how far errors (n,) of scores (n,), which turn these
    by an angle [rad], move it.
    """
    over = rating_range(score, at_most)
    return {
        **dict(zip(("r_lowest", "r_highest"), over.r, strict=True)),
        **dict(zip(("r2_lowest", "r2_highest"), over.r2, strict=True)),
        "range_error": max(error_in_r(each, angle) for each in over.r),
        "range_open": int(_is_any_turned(score, over, error)) if known else None,
    }


def _contradictions(rating: FloatArray, at_most: np.ndarray) -> list[str]:
    """In words what ratings (n,) have against an order (n, n)."""
    equal = at_most & at_most.T
    against = {
        "ratings contradict the stated order": at_most & ~equal & (rating[:, None] >= rating[None, :]),
        "ratings differ that are stated to be equal": equal & (rating[:, None] != rating[None, :]),
    }
    return [words for words, pairs in against.items() if pairs.any()]
