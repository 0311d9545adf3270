"""Discretisation error of scores, estimated from a second, coarser solution.

Elements and load increments of the second solution are COARSENING times as large. The score of what its filtered
read-outs are off by, S(e_2 - e), is at least |S_2 - S|; unlike that it cannot vanish by chance, as whatever differs
anywhere adds to it. With an order p of convergence the error of the first solution is S(e_2 - e) / (COARSENING^p - 1).
Contact fronts converge with the first order, strains with the second, increments with the second: ORDER lies between
(docs/decisions/0032). None is below LEAST: curves may agree better than either is known.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..scene.readout import Readout
from ..scene.scene import Scene
from ..store import foreign, read_rows
from .gabor import FilteredReadouts
from .roughness import SCORE_KEY, roughness_score, scene_span

COARSENING = 2.0  # [1]; source: sizes go by halves, and 1.5 understated five scores of 54 by more than 2 (decision 23)
ORDER = 1.5  # of convergence [1]; source: 2 understates more than one in twenty scores of unlike devices (decision 32)
DIFFERENCE = COARSENING**ORDER - 1.0  # to the coarser solution, over the error [1]
LEAST = 1e-3  # of a score [1]; source: median of 66 errors against references (decision 25)
# of a reference [1]: at least 20 times the unknowns, errors a thirtieth at second order; source: 4 times hid bands of
# strain (decision 22)
REFINEMENT = 5.5
REFERENCED = ("kinematics", "device", "interface")


def score_errors(scene: Scene, read: FilteredReadouts, coarser: FilteredReadouts) -> dict[Readout, float]:
    """Errors [mm2] of both scores, from filtered read-outs and those of the coarser solution."""
    span = scene_span(scene)
    errors = {}
    for each in Readout:
        filtered = read.filtered(each)
        off = np.interp(read.arc, coarser.arc, coarser.filtered(each)) - filtered
        estimated = roughness_score(read.arc, off, span) / DIFFERENCE
        errors[each] = max(estimated, LEAST * roughness_score(read.arc, filtered, span))
    return errors


def read_cases(path: Path, scene: Scene, cases: Iterable[tuple[str, str]]) -> list[dict[str, str]]:
    """Rows of a table that has one of both read-outs of some conditions and interfaces, by name, of a scene. Raises
    ResultError as `read_rows`, and if it has others.
    """
    rows = read_rows(path, *SCORE_KEY)
    wanted = [(scene.kinematics, scene.device.name, *case, each) for case in cases for each in Readout]
    if sorted(map(score_key, rows)) != sorted(wanted):
        raise foreign(path, "cases are missing, or are others")
    return rows


def with_errors(scores: Sequence[Mapping[str, Any]], checks: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of the score table with `score_error` behind `score`, in the same unit; None where there is no score, or
    no coarser solution, whose note then says why.

    checks: rows with `score_error` and `note` of every case with a score. Raises KeyError if one is missing.
    """
    found = {score_key(row): row for row in checks}
    table = []
    for row in scores:
        if not _is_scored(row):
            table.append(with_error(row, None))
            continue
        check = found[score_key(row)]
        known = check["score_error"] not in {None, ""}
        error = float(check["score_error"]) if known else None
        table.append(with_error(row, error) | ({} if known else {"note": _joined(row, check)}))
    return table


def with_error(row: Mapping[str, Any], error: float | None) -> dict[str, Any]:
    """A row of the score table with its error behind its score."""
    found: dict[str, Any] = {}
    for column, value in row.items():
        found[column] = value
        if column == "score":
            found["score_error"] = error
    return found


def true_errors(scores: Sequence[Mapping[str, Any]], reference: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of all scores above zero with an error, of the kinematics, devices and interfaces that a reference has: the
    error they state and that against the reference, both over the score [1], the ratio of the second to the first, and
    how many times the unknowns the reference has [1]. Raises KeyError if the reference lacks a score.
    """
    known = {_of(row, REFERENCED): float(row["times_unknowns"]) for row in reference}
    finer = scores_by_case(reference)
    table = []
    for row in scores:
        if has_error(row) and float(row["score"]) > 0.0 and _of(row, REFERENCED) in known:
            score, stated = float(row["score"]), float(row["score_error"])
            error = score - finer[score_key(row)]
            case = dict(zip(SCORE_KEY, score_key(row), strict=True))
            ratio = abs(error) / stated
            errors = {"stated": stated / score, "error": error / score, "error_over_stated": ratio}
            table.append(case | errors | {"times_unknowns": known[_of(row, REFERENCED)]})
    return table


def relative_error(row: Mapping[str, Any]) -> float:
    """A score's stated error over the score [1], of a row of the score table, also as text; not a number if there is
    none, or the score is zero, as at rest.

    >>> relative_error({"score": "0.5", "score_error": "0.01"}), relative_error({"score": 0.0, "score_error": 0.0})
    (0.02, nan)
    """
    known = has_error(row) and float(row["score"]) > 0.0
    return float(row["score_error"]) / float(row["score"]) if known else float("nan")


def relative_errors(rows: Iterable[Mapping[str, Any]]) -> dict[tuple[str, ...], float]:
    """`relative_error` [1] of each case (`score_key`) in rows of the score table that has one."""
    return {score_key(row): error for row in rows if not math.isnan(error := relative_error(row))}


def scores_by_case(rows: Iterable[Mapping[str, Any]]) -> dict[tuple[str, ...], float]:
    """Score of each case (`score_key`) in rows of the score table, also as text, that has one."""
    return {score_key(row): float(row["score"]) for row in rows if _is_scored(row)}


def relative_changes(
    scores: Mapping[tuple[str, ...], float], reference: Mapping[tuple[str, ...], float]
) -> dict[tuple[str, ...], float]:
    """|score / reference - 1| [1] of each case; of none whose reference is zero, as at rest. Raises KeyError if the
    reference lacks a case.

    >>> relative_changes({("a",): 1.5, ("rest",): 0.0}, {("a",): 1.0, ("rest",): 0.0})
    {('a',): 0.5}
    """
    return {case: abs(score / reference[case] - 1.0) for case, score in scores.items() if reference[case]}


def error_in_proportion(score: float, usual: float, error: float) -> float:
    """The error of a score in proportion to that of the usual score, all in one unit; not a number where none is in
    proportion, as that usual score is zero and this one is not.

    >>> error_in_proportion(0.2, 0.1, 0.01), error_in_proportion(0.0, 0.0, 0.0), error_in_proportion(0.2, 0.0, 0.0)
    (0.02, 0.0, nan)
    """
    if score == usual:
        return error
    return error * score / usual if usual else math.nan


def has_error(row: Mapping[str, Any]) -> bool:
    """Whether a row of the score table, also as text, has a score whose error is known."""
    return _is_scored(row) and row["score_error"] not in {None, ""}


def score_key(row: Mapping[str, Any]) -> tuple[str, ...]:
    """What tells a row of the score table from all others: its columns SCORE_KEY."""
    return _of(row, SCORE_KEY)


def _of(row: Mapping[str, Any], columns: Sequence[str]) -> tuple[str, ...]:
    return tuple(row[column] for column in columns)


def _joined(*rows: Mapping[str, Any]) -> str:
    """The notes of several rows."""
    return "; ".join(row["note"] for row in rows if row["note"])


def _is_scored(row: Mapping[str, Any]) -> bool:
    return row["score"] not in {None, ""}
