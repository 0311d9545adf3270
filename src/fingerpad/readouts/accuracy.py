"""Discretisation error of scores, estimated from a second, coarser solution, and a third.

Elements and load increments of the second solution are COARSENING times as large, those of the third COARSEST times.
With an order p of convergence the error of the first is |difference| / (times^p - 1). Contact fronts converge with the
first order, strains with the second, increments with the second; the first is assumed of all (ORDER). A single
difference may vanish by chance, so no relative estimate is below the lower median, for the same device and read-out, of
the larger of what both coarser solutions say: conditions share a mesh and a pre-indentation, and so may share the
chance. Those that share a stimulus, and so a score on either mesh, count once. Nor is a change of strain known better
than strain, of which it is a difference. And as a device may have a single condition, none is below LEAST.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median_low
from typing import Any

from ..scene.readout import Readout

COARSENING = 2.0  # [1]; source: sizes go by halves, and 1.5 understated five scores of 54 by more than 2 (decision 23)
COARSEST = 3.0  # [1]; source: shows where scores on twice the sizes agree by chance; 4 overstates (decision 25)
ORDER = 1.0  # of convergence [1]; source: that of contact fronts, the lowest
LEAST = 1e-3  # of a score [1]; source: median of 66 errors against references (decision 25)
# of a reference [1]: at least 20 times the unknowns, errors a thirtieth at second order; source: 4 times hid bands of
# strain (decision 22)
REFINEMENT = 5.6
CASE = ("kinematics", "device", "condition", "interface", "readout")
GROUP = ("kinematics", "device", "readout")
REFERENCED = ("kinematics", "device", "interface")


def with_errors(scores: Sequence[Mapping[str, Any]], coarser: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of the score table with `score_error` behind `score`, in the same unit; None where there is no score, or
    none of the coarser solution, whose note then says why.

    coarser: rows of the coarser solution, with the score of the coarsest as `coarsest`, None without one. Raises
    KeyError if it lacks one.
    """
    second = {case_of(row): row for row in coarser}
    estimate: dict[tuple[str, ...], float] = {}
    relative: dict[tuple[str, ...], dict[tuple[str, float, float], float]] = {}
    for row in filter(_is_scored, scores):
        case, score = case_of(row), float(row["score"])
        if not _is_scored(second[case]):
            continue
        coarse, coarsest = float(second[case]["score"]), second[case]["coarsest"]
        estimate[case] = larger = max(_estimated(score, coarse, COARSENING), LEAST * score)
        if coarsest not in {None, ""}:
            larger = max(larger, _estimated(score, float(coarsest), COARSEST))
        if score > 0.0:  # a stimulus that is none changes nothing, on any mesh
            relative.setdefault(_of(row, GROUP), {})[row["interface"], score, coarse] = larger / score
    least = {group: median_low(values.values()) for group, values in relative.items()}
    table = []
    for row in scores:
        case = case_of(row)
        if case in estimate:
            groups = _of(row, GROUP), _of({**row, "readout": Readout.STRAIN}, GROUP)
            share = max(least.get(group, 0.0) for group in groups)
            table.append(with_error(row, max(estimate[case], share * float(row["score"]))))
        else:
            table.append(with_error(row, None) | ({"note": _joined(row, second[case])} if _is_scored(row) else {}))
    return table


def _estimated(score: float, coarser: float, times: float) -> float:
    """Error of a score, from that of a solution whose elements are so many times as large [1]."""
    return abs(coarser - score) / (float(times**ORDER) - 1.0)


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
    finer = {case_of(row): float(row["score"]) for row in reference}
    table = []
    for row in scores:
        if has_error(row) and float(row["score"]) > 0.0 and _of(row, REFERENCED) in known:
            score, stated = float(row["score"]), float(row["score_error"])
            error = score - finer[case_of(row)]
            case = dict(zip(CASE, case_of(row), strict=True))
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


def has_error(row: Mapping[str, Any]) -> bool:
    """Whether a row of the score table, also as text, has a score whose error is known."""
    return _is_scored(row) and row["score_error"] not in {None, ""}


def case_of(row: Mapping[str, Any]) -> tuple[str, ...]:
    """What tells a row of the score table from all others: its columns CASE."""
    return _of(row, CASE)


def _of(row: Mapping[str, Any], columns: Sequence[str]) -> tuple[str, ...]:
    return tuple(row[column] for column in columns)


def _joined(*rows: Mapping[str, Any]) -> str:
    """The notes of several rows."""
    return "; ".join(row["note"] for row in rows if row["note"])


def _is_scored(row: Mapping[str, Any]) -> bool:
    return row["score"] not in {None, ""}
