"""Orders of conditions over variants of a device: which of two scores is larger, beyond the errors of both."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from itertools import permutations
from typing import Any

from ..readouts.accuracy import has_error
from ..readouts.roughness import rows_of
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from .ranking import is_resolved

Row = Mapping[str, Any]
Pair = tuple[str, str]  # conditions with the lower and the higher score


def resolved_pairs(rows: Sequence[Row]) -> list[Pair]:
    """Pairs of conditions whose scores differ by more than the sum of both errors, of rows of one device, interface and
    read-out.

    >>> rows = [("a", 3.0, 0.1), ("b", 1.0, 0.2), ("c", 1.1, 0.2), ("d", 9.0, None)]
    >>> resolved_pairs([dict(zip(("condition", "score", "score_error"), row)) for row in rows])
    [('b', 'a'), ('c', 'a')]
    """
    return [
        (str(low["condition"]), str(high["condition"]))
        for low, high in permutations(rows, 2)
        if is_resolved(low, high) and low["score"] < high["score"]
    ]


def unordered(rows: Sequence[Row]) -> list[str]:
    """Conditions with a score whose error is not known, of rows of one device, interface and read-out: whether it is
    larger than another is open.
    """
    return [str(row["condition"]) for row in rows if row["score"] is not None and not has_error(row)]


def nothing_resolved(some_unknown: bool) -> str:
    """What is said where no two scores differ by more than their errors, of which some may not be known."""
    return f"no two scores{' with known errors' if some_unknown else ''} differ by more than their errors"


def orders(tables: Mapping[str, Sequence[Row]]) -> Iterator[str]:
    """In which variants which scores are larger, a line for each interface, read-out and set of variants.

    tables: rows of the score table of each variant, by its name. What others imply is left out where it holds in
    all that have a prediction.
    """
    scores = {tuple(row["score"] for row in rows) for rows in tables.values()}
    if len(scores) == 1 and any(score is not None for score in scores.pop()):
        yield "these values change no score"
    if len({row["condition"] for rows in tables.values() for row in rows}) == 1:
        yield "one condition: there is nothing to order"
        return
    for interface in Interface:
        for readout in Readout:
            own = {name: rows_of(rows, interface, readout) for name, rows in tables.items()}
            if any(row["score"] is not None for rows in own.values() for row in rows):
                yield from _orders_of(f"{interface}, {readout}", own)


def _orders_of(case: str, tables: Mapping[str, Sequence[Row]]) -> Iterator[str]:
    """`orders` of one interface and read-out, `case` in words, with a score in some variant."""
    scored = [name for name, rows in tables.items() if any(row["score"] is not None for row in rows)]
    holding: dict[Pair, list[str]] = {}
    unknown: dict[str, list[str]] = {}
    for name, rows in tables.items():
        for pair in resolved_pairs(rows):
            holding.setdefault(pair, []).append(name)
        for condition in unordered(rows):
            unknown.setdefault(condition, []).append(name)
    if not holding:
        yield f"{case}: {nothing_resolved(bool(unknown))}"
    for names in sorted(dict.fromkeys(map(tuple, holding.values())), key=len, reverse=True):
        pairs = [pair for pair, held in holding.items() if tuple(held) == names]
        pairs = without_implied({pair: {*names} for pair in pairs}) if len(names) == len(scored) else pairs
        said = ", ".join(f"{low} < {high}" for low, high in pairs)
        yield f"{case}, in {len(names)} of {len(scored)}{_in_some(names, scored)}: {said}"
    for names in dict.fromkeys(map(tuple, unknown.values())):
        said = ", ".join(condition for condition, own in unknown.items() if tuple(own) == names)
        yield f"{case}, not ordered, as errors are unknown{_in_some(names, scored)}: {said}"
    if lost := [name for name in tables if name not in scored]:
        yield f"{case}, no prediction ({'; '.join(lost)})"


def _in_some(names: Sequence[str], scored: Sequence[str]) -> str:
    """Names of variants in brackets, if they are not all that have scores."""
    return "" if len(names) == len(scored) else f" ({'; '.join(names)})"


def without_implied(certain: Mapping[Pair, Set[str]]) -> list[Pair]:
    """Pairs that do not follow from two others which hold wherever they do. certain: names of the variants in which
    each pair holds; it is turned in none.

    >>> without_implied({("a", "b"): {"1"}, ("a", "c"): {"1"}, ("b", "c"): {"1", "2"}})
    [('a', 'b'), ('b', 'c')]
    >>> len(without_implied({("a", "b"): {"1"}, ("a", "c"): {"1", "2"}, ("b", "c"): {"1", "2"}}))
    3
    """
    nowhere = set[str]()
    between = {name for pair in certain for name in pair}
    return [
        (low, high)
        for (low, high), held in certain.items()
        if not any(held <= certain.get((low, mid), nowhere) & certain.get((mid, high), nowhere) for mid in between)
    ]
