"""How the scores of a device rank, and what their errors leave open."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..readouts.accuracy import has_error
from ..readouts.comparison import Relation, Score, relation
from ..readouts.roughness import SERIES

RANKS = ("rank", "first_rank", "last_rank")  # columns [1]


def ranks(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, int | None]]:
    """Of each row of the score table its `rank` among those of its device, interface and read-out, 1 the largest, equal
    scores sharing one; and `first_rank` to `last_rank`, which errors leave it. None without a score, or an error.

    A score whose error is not known may lie on either side of any other.

    >>> key = {"kinematics": "small", "device": "d", "interface": "shear", "readout": "strain", "score_error": 0.1}
    >>> [list(each.values()) for each in ranks([key | {"score": score} for score in (0.1, 0.9, 0.1, 1.0, None)])]
    [[3, 3, 3], [2, 1, 2], [3, 3, 3], [1, 1, 2], [None, None, None]]
    """
    return [dict.fromkeys(RANKS) if row["score"] is None else _rank(row, _rivals(row, rows)) for row in rows]


def is_resolved(row: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether two scores are there and differ by more than the sum of both errors, which are known."""
    has_errors = has_error(row) and has_error(other)
    return has_errors and relation(_score(row), _score(other)) in (Relation.LESS, Relation.MORE)


def _rivals(row: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Rows with scores of a row's device, interface and read-out, itself among them."""
    return [each for each in rows if each["score"] is not None and all(row[name] == each[name] for name in SERIES)]


def _rank(row: Mapping[str, Any], rivals: Sequence[Mapping[str, Any]]) -> dict[str, int | None]:
    """The ranks of a row that has a score."""
    exact = Score(row["score"], 0.0)
    rank = 1 + sum(relation(exact, Score(each["score"], 0.0)) is Relation.LESS for each in rivals)
    if not has_error(row):
        return {"rank": rank, "first_rank": None, "last_rank": None}
    relations = [relation(_score(row), _score(each)) for each in rivals if has_error(each)]
    first = 1 + relations.count(Relation.LESS)
    either = relations.count(Relation.NEAR) + len(rivals) - len(relations)
    return {"rank": rank, "first_rank": first, "last_rank": first + either}


def _score(row: Mapping[str, Any]) -> Score:
    """The score of a row that has one with an error."""
    return Score(row["score"], row["score_error"])
