"""Perceived roughness: ratings, and how a score correlates with them.

Where only the order of the ratings is known (`ordinal surrogate`), one R² says little. So it stands beside the
range of R² over *all* ratings which agree with the stated order, which needs no numbers at all (`r2_range`).
"""

from __future__ import annotations

import csv
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from difflib import get_close_matches
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import nnls
from scipy.stats import kendalltau, pearsonr

from .errors import RatingError
from .scene import Interface, Readout

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

KEY = ["device", "interface", "readout"]
COLUMNS = [
    *KEY,
    "n",
    "slope_sign",
    "r2",
    "r2_lowest",
    "r2_highest",
    "kendall_tau",
    "p",
    "published_r2",
    "published_words",
    "rating_kind",
    "note",
]
RATING_COLUMNS = ("device", "condition", "rating", "kind", "source")
ORDER_COLUMNS = ("device", "lower", "relation", "higher", "source")
PUBLISHED_COLUMNS = ("device", "interface", "readout", "r2", "words", "source")

CONSTANT = 1e-9  # spread relative to the largest value below which values count as equal [1]; the solver's tolerance
MAX_UP_SETS = 2**16  # up-sets of a stated order that are enumerated; 16 conditions without any order have as many
NO_PREDICTION = "no prediction"
NO_RATINGS = "no ratings"
CONSTANT_SCORE = "constant score"


class RatingKind(StrEnum):
    """Where a rating comes from: an ordinal surrogate, read off a published figure, or measured."""

    SURROGATE = "surrogate"
    DIGITISED = "digitised"
    MEASURED = "measured"

    @property
    def label(self) -> str:
        """How figures and tables call it; a surrogate is always called an ordinal surrogate."""
        return "ordinal surrogate" if self is RatingKind.SURROGATE else self.value


class Relation(StrEnum):
    """How the ratings of two conditions compare, as stated."""

    LESS = "<"
    EQUAL = "="


# --- reading -------------------------------------------------------------------------------------------------------


def read_ratings(path: Path, conditions_by_device: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """Ratings of perceived roughness, checked against the devices they rate.

    path: CSV with the columns device, condition, rating (a number >= 0, any unit: R² does not see it), kind
    (surrogate, digitised or measured; one kind a device) and source. conditions_by_device: the condition names of
    every known device. A device may be without ratings, but not with some only.

    Returns those columns, `rating` as float. Raises RatingError, which names file, line, column, what was found
    and what is allowed.

    >>> devices = {d.name: [c.name for c in d.conditions] for d in (device1, device2, device3)}
    >>> read_ratings(Path("data/ratings.csv"), devices)[["condition", "rating", "kind"]].iloc[0].tolist()
    ['low_000', 1.0, 'surrogate']
    """
    rows: list[dict[str, Any]] = []
    kinds: dict[str, tuple[str, int]] = {}
    lines: dict[tuple[str, str], int] = {}
    for line, row in _read_rows(path, RATING_COLUMNS):
        device, condition, kind = row["device"], row["condition"], row["kind"]
        _check_name(path, line, "device", device, conditions_by_device)
        _check_name(path, line, "condition", condition, conditions_by_device[device])
        _check_name(path, line, "kind", kind, [*RatingKind])
        rating = _number(row["rating"])
        if not (math.isfinite(rating) and rating >= 0.0):
            raise _error(path, line, "rating", row["rating"], "a finite number, 0 or more")
        if (device, condition) in lines:
            first = lines[device, condition]
            raise _error(path, line, "condition", condition, f"one row a condition; {device} has it on line {first}")
        first_kind, first = kinds.setdefault(device, (kind, line))
        if kind != first_kind:
            raise _error(path, line, "kind", kind, f"one kind a device; {device} has '{first_kind}' on line {first}")
        lines[device, condition] = line
        rows.append({**row, "rating": rating})
    for device in kinds:
        missing = [name for name in conditions_by_device[device] if (device, name) not in lines]
        if missing:
            raise RatingError(
                f"{path}, column condition: {device} has no rating for {_listed(missing)};"
                " allowed: ratings for all conditions of a device, or for none"
            )
    return pd.DataFrame(rows, columns=list(RATING_COLUMNS))


def read_stated_order(path: Path, conditions_by_device: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """What is stated about the order of ratings, checked against the devices.

    path: CSV with the columns device, lower, relation (`<` or `=`), higher and source, a row for each pair of
    conditions. Returns those columns. Raises RatingError as `read_ratings` does, and if the rows contradict
    each other.
    """
    rows: list[dict[str, Any]] = []
    for line, row in _read_rows(path, ORDER_COLUMNS):
        _check_name(path, line, "device", row["device"], conditions_by_device)
        for column in ("lower", "higher"):
            _check_name(path, line, column, row[column], conditions_by_device[row["device"]])
        _check_name(path, line, "relation", row["relation"], [*Relation])
        rows.append(dict(row))
    table = pd.DataFrame(rows, columns=list(ORDER_COLUMNS))
    for device, part in table.groupby("device", sort=False):
        try:
            order_matrix(conditions_by_device[device], part)
        except RatingError as error:
            raise RatingError(f"{path}: {device}: {error}") from error
    return table


def read_published(path: Path) -> pd.DataFrame:
    """The published correlations: device, interface, readout, r2 (NaN where there are only words), words, source.

    Raises RatingError as `read_ratings` does.
    """
    rows: list[dict[str, Any]] = []
    for line, row in _read_rows(path, PUBLISHED_COLUMNS):
        _check_name(path, line, "interface", row["interface"], [*Interface])
        _check_name(path, line, "readout", row["readout"], [*Readout])
        r2 = _number(row["r2"])
        if row["r2"] and not 0.0 <= r2 <= 1.0:
            raise _error(path, line, "r2", row["r2"], "a number from 0 to 1, or nothing")
        rows.append({**row, "r2": r2})
    return pd.DataFrame(rows, columns=list(PUBLISHED_COLUMNS))


def _read_rows(path: Path, columns: Sequence[str]) -> Iterable[tuple[int, dict[str, str]]]:
    """The rows of a CSV with exactly these columns, none without a source; each with its line number."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, strict=True)
            lines = [(reader.line_num, [cell.strip() for cell in row]) for row in reader if any(map(str.strip, row))]
    except OSError as error:
        raise RatingError(f"{path}: cannot be read: {error.strerror}") from error
    except (csv.Error, UnicodeDecodeError) as error:
        raise RatingError(f"{path}: is not a CSV file in UTF-8: {error}") from error
    if len(lines) < 2:
        found = "a header without rows" if lines else "an empty file"
        raise RatingError(f"{path}: found {found}; allowed: rows with the columns {_listed(columns)}")
    line, header = lines[0]
    for name in header:
        if name not in columns:
            raise _error(path, line, "header", name, columns)
        if header.count(name) > 1:
            raise _error(path, line, "header", name, f"each column once: {_listed(columns)}")
    if missing := [name for name in columns if name not in header]:
        raise RatingError(f"{path}, line {line}: column {_listed(missing)} is missing; allowed: {_listed(columns)}")
    rows = []
    for line, cells in lines[1:]:
        if len(cells) != len(header):
            raise RatingError(
                f"{path}, line {line}: found {len(cells)} values; allowed: {len(header)}, for {_listed(header)}"
            )
        row = dict(zip(header, cells, strict=True))
        if not row["source"]:
            raise _error(path, line, "source", "", "where the row comes from")
        rows.append((line, row))
    return rows


def _check_name(path: Path, line: int, column: str, found: str, allowed: Collection[str]) -> None:
    if found not in allowed:
        raise _error(path, line, column, found, list(allowed))


def _error(path: Path, line: int, column: str, found: str, allowed: Sequence[str]) -> RatingError:
    """The one form of message; `allowed` is a phrase, or the names among which a guess is made."""
    guess = [] if isinstance(allowed, str) else get_close_matches(found, allowed, n=1)
    names = allowed if isinstance(allowed, str) else _listed(allowed)
    hint = f"; did you mean '{guess[0]}'?" if guess else ""
    return RatingError(f"{path}, line {line}, column {column}: found '{found}'; allowed: {names}{hint}")


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


# --- the range of R² over all ratings with a stated order ----------------------------------------------------------


def order_matrix(conditions: Sequence[str], order: pd.DataFrame) -> BoolArray:
    """What a stated order implies for every pair of conditions (its reflexive and transitive closure).

    order: the rows of one device with columns lower, relation, higher. Returns an (n, n) matrix; [i, j] says
    whether rating i <= rating j. Raises RatingError for an unknown condition, and for a contradiction.

    >>> order_matrix(["a", "b"], pd.DataFrame([["a", "<", "b"]], columns=["lower", "relation", "higher"])).tolist()
    [[True, True], [False, True]]
    """
    index = {name: i for i, name in enumerate(conditions)}
    if unknown := [name for name in (*order["lower"], *order["higher"]) if name not in index]:
        raise RatingError(f"stated order: found {_listed(unknown[:1])}; allowed: {_listed(conditions)}")
    stated = [(index[a], r, index[b]) for a, r, b in order[["lower", "relation", "higher"]].itertuples(index=False)]
    at_most = np.eye(len(conditions), dtype=bool)
    for low, relation, high in stated:
        at_most[low, high] = True
        at_most[high, low] |= relation == Relation.EQUAL
    for via in range(len(conditions)):
        at_most |= at_most[:, [via]] & at_most[[via], :]
    for low, relation, high in stated:
        if relation == Relation.LESS and at_most[high, low]:
            raise RatingError(
                f"stated order contradicts itself: '{conditions[low]}' < '{conditions[high]}', and other rows"
                f" say that '{conditions[high]}' is not above '{conditions[low]}'"
            )
    return at_most


def up_sets(at_most: BoolArray) -> BoolArray:
    """Sets of conditions which hold, with any condition, all that are rated at least as high.

    at_most: (n, n) from `order_matrix`. Returns (k, n) indicators without the empty set and the whole.
    Raises RatingError if there are more than MAX_UP_SETS.

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
    return sets[sets.any(axis=1) & ~sets.all(axis=1)]


def extreme_ratings(score: FloatArray, at_most: BoolArray) -> tuple[FloatArray, FloatArray]:
    """Ratings that agree with a stated order and have the lowest and the highest R² with a score.

    score: (n,), not constant, any unit. at_most: (n, n) from `order_matrix`. Returns two ratings (n,), >= 0.

    With the score x centred and scaled to |x| = 1, and K the closed cone of centred ratings y that satisfy the
    order, R²(y) = <x, y>² / |y|². K is generated by the centred indicators g of the order's up-sets (a rating is
    a sum of its level sets). Hence

    - lowest: where <x, g> has one sign for all g, |corr| is quasi-concave on K and so is lowest at some g; where it
      has both signs, two generators combine to <x, y> = 0 (unless they cancel: two classes without order);
    - highest: corr is highest at the projection of x on K (isotonic regression for a partial order), and -corr at
      that of -x. By Moreau, P_K(x) = x - P_K°(x), and the polar cone K° is generated by e_low - e_high, which
      leaves a small non-negative least-squares problem.

    So the extremes are among finitely many candidates, which are all tried. Strict order is the interior of K; its
    R² comes as close to these as one likes. A bound on the ratio of ratings (`at most two-fold`) restricts nothing,
    as R² does not change when a constant is added to all ratings, and a large constant meets any such bound.

    Raises RatingError if the order makes all ratings equal, or has too many up-sets (see `up_sets`).
    Source: Robertson, Wright and Dykstra 1988, Order Restricted Statistical Inference.
    """
    if _is_constant(score):
        raise RatingError("the score is constant, so nothing can correlate with it")
    x = _unit(score)
    generators = _unit(up_sets(at_most).astype(float))
    if not len(generators):
        raise RatingError("the stated order makes all ratings equal, so nothing can correlate with them")
    low, high = np.nonzero(at_most & ~np.eye(len(x), dtype=bool))
    polar = np.eye(len(x))[:, low] - np.eye(len(x))[:, high]
    projections = [s * x - polar @ nnls(polar, s * x)[0] if low.size else x for s in (1.0, -1.0)]
    candidates = np.vstack([generators, _uncorrelated(generators, generators @ x), *projections])
    candidates = candidates[np.linalg.norm(candidates, axis=1) > CONSTANT]
    r2 = (_unit(candidates) @ x) ** 2
    lowest, highest = candidates[r2.argmin()], candidates[r2.argmax()]
    return lowest - lowest.min(), highest - highest.min()


def r2_range(score: FloatArray, at_most: BoolArray) -> tuple[float, float]:
    """Lowest and highest R² [1] of a score with any ratings that agree with a stated order; see `extreme_ratings`.

    Rounded to 12 decimals, which is where floating point ends.

    >>> r2_range(np.array([0.0, 1.0, 2.0]), np.triu(np.ones((3, 3), dtype=bool)))
    (0.75, 1.0)
    """
    lowest, highest = (round(float(_unit(y) @ _unit(score)) ** 2, 12) for y in extreme_ratings(score, at_most))
    return lowest, highest


def _unit(values: FloatArray) -> FloatArray:
    """Centred and scaled to norm 1 along the last axis."""
    centred = values - values.mean(axis=-1, keepdims=True)
    return np.asarray(centred / np.linalg.norm(centred, axis=-1, keepdims=True))


def _is_constant(values: FloatArray) -> bool:
    return bool(np.ptp(values) <= CONSTANT * np.abs(values).max())


def _uncorrelated(generators: FloatArray, covariance: FloatArray) -> FloatArray:
    """Convex combinations of two generators (k, n) whose covariances (k,) have opposite signs, with covariance 0.

    Each positive one is combined with the most negative one, and each negative one with the most positive one. Two
    generators may cancel; unless the order leaves no others, some of these combinations do not.
    """
    positive, negative = np.flatnonzero(covariance > 0.0), np.flatnonzero(covariance < 0.0)
    if not (positive.size and negative.size):
        return generators[:0]
    up = np.append(positive, np.full_like(negative, covariance.argmax()))
    down = np.append(np.full_like(positive, covariance.argmin()), negative)
    weight = covariance[up] / (covariance[up] - covariance[down])
    return np.asarray(weight[:, None] * generators[down] + (1.0 - weight[:, None]) * generators[up])


# --- the table -----------------------------------------------------------------------------------------------------


def correlation_table(
    scores: pd.DataFrame, ratings: pd.DataFrame, order: pd.DataFrame, published: pd.DataFrame
) -> pd.DataFrame:
    """How each score correlates with perceived roughness: a row for each device, interface and read-out.

    scores: columns device, condition, interface, readout, score [any unit, NaN without a prediction], note.
    ratings, order, published: see `read_ratings`, `read_stated_order`, `read_published`.

    Returns the columns COLUMNS:
    n: conditions correlated. slope_sign: of rating on score, -1, 0 or 1. r2: squared Pearson correlation.
    r2_lowest, r2_highest: over all ratings that agree with the stated order (`r2_range`), whichever way the slope
    then is; empty without an order.
    kendall_tau: tau-b. p: two-sided p of the Pearson correlation, every condition counted as independent, also
    where conditions share a stimulus (the note then says how many are distinct). rating_kind: the `label` of
    RatingKind. note: why numbers are missing, or what to beware of.

    Raises RatingError if scores and ratings of a device are not of the same conditions.
    """
    rows = [
        {**dict(zip(KEY, key, strict=True)), **_correlate(group, *(t[t["device"] == key[0]] for t in (ratings, order)))}
        for key, group in scores.groupby(KEY, sort=False)
    ]
    said = published.rename(columns={"r2": "published_r2", "words": "published_words"})
    computed = pd.DataFrame(rows, columns=[c for c in COLUMNS if not c.startswith("published")])
    table = computed.merge(said[[*KEY, "published_r2", "published_words"]], how="left", on=KEY, validate="m:1")
    floats = dict.fromkeys(("r2", "r2_lowest", "r2_highest", "kendall_tau", "p", "published_r2"), "float64")
    table = table.astype({"n": "int64", "slope_sign": "Int64", **floats})
    return table[COLUMNS].fillna({"published_words": ""})


def _correlate(scores: pd.DataFrame, ratings: pd.DataFrame, order: pd.DataFrame) -> dict[str, Any]:
    """The correlation of one device, interface and read-out; columns that are left out are empty."""
    score = scores.set_index("condition")["score"].astype(float)
    rating = ratings.set_index("condition")["rating"].astype(float)
    kind = RatingKind(ratings["kind"].iloc[0]).label if len(ratings) else ""
    if score.isna().any():
        reasons = [note for note in scores.loc[scores["score"].isna(), "note"].unique() if isinstance(note, str)]
        return {"n": 0, "rating_kind": kind, "note": "; ".join(filter(None, reasons)) or NO_PREDICTION}
    if rating.empty:
        return {"n": 0, "rating_kind": kind, "note": NO_RATINGS}
    if odd := sorted(set(score.index) ^ set(rating.index)):
        where = ", ".join(scores[KEY].iloc[0])
        raise RatingError(f"{where}: scores and ratings are not of the same conditions; in one only: {_listed(odd)}")
    x = score.to_numpy()
    y = rating.loc[score.index].to_numpy()
    found: dict[str, Any] = {"n": x.size, "rating_kind": kind}
    for values, note in ((x, CONSTANT_SCORE), (y, "constant rating")):
        if _is_constant(values):
            return {**found, "note": note}
    if x.size < 3:
        return {**found, "note": "fewer than three conditions"}
    notes = []
    if len(order):
        at_most = order_matrix(list(score.index), order)
        found["r2_lowest"], found["r2_highest"] = r2_range(x, at_most)
        distinct = len(np.unique(at_most & at_most.T, axis=0))
        if distinct < x.size:
            notes.append(f"{distinct} of {x.size} conditions are distinct")
        if np.any(at_most & (y[:, None] > y[None, :])):
            notes.append("ratings contradict the stated order")
    pearson = pearsonr(x, y)
    return {
        **found,
        "slope_sign": int(np.sign(pearson.statistic)),
        "r2": float(pearson.statistic) ** 2,
        "kendall_tau": float(kendalltau(x, y).statistic),
        "p": float(pearson.pvalue),
        "note": "; ".join(notes),
    }
