"""What the orders of a device's scores depend on: its scene with one assumption varied at a time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..prediction.orders import Pair, Row, resolved_pairs, without_implied
from ..readouts.accuracy import error_in_proportion, has_error
from ..readouts.comparison import SAME
from ..readouts.roughness import rows_of
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.variation import Document, by_number, quantities_of
from .alternatives import HALF_CYCLE, HALF_CYCLES, Alternative, is_assumed, require_written

OTHER_HALF = "assumption: the other half of the stimulus' cycle"


@dataclass(frozen=True)
class Order:
    """Two conditions whose scores differ by more than their errors as configured, and what becomes of that where
    assumptions are varied.

    holds: names of the members in which the higher score is higher still, by more than both errors. open: in which
    errors are larger than the difference. reversed: in which the lower one is higher. lost: in which one has no score.
    """

    interface: Interface
    readout: Readout
    low: str
    high: str
    holds: tuple[str, ...]
    open: tuple[str, ...]
    reversed: tuple[str, ...]
    lost: tuple[str, ...]

    @property
    def scored(self) -> int:
        """Number of members in which both have a score."""
        return len(self.holds) + len(self.open) + len(self.reversed)

    @property
    def is_certain(self) -> bool:
        """Whether it holds in every member in which both have a score, and there is one."""
        return 0 < len(self.holds) == self.scored


def varied_values(config: Document, device: Document, alternatives: Sequence[Alternative]) -> dict[str, dict[str, Any]]:
    """Values in place of those in the scene files of a device, by the names of the alternatives: those of the model,
    those of what the device file assumes, and the other half-cycle if that is assumed.

    Raises SceneError if the model has no such value, or a number's factor is to multiply what is none.
    """
    of_model, own = dict(quantities_of(config)), dict(quantities_of(device))
    halves = [Alternative("devices", HALF_CYCLE, each, None, OTHER_HALF) for each in HALF_CYCLES]
    found = {}
    for each in (*alternatives, *halves):
        key = by_number(each.key, [config])
        if each.part == "model":
            require_written(key, of_model)
        quantity = (own if each.part == "devices" else of_model | own).get(key)
        if quantity is None or (key in own and not is_assumed(quantity)):
            continue
        value = each.instead_of(quantity["value"])
        if value != quantity["value"]:
            found[each.name] = {each.key: value}
    return found


def kept_keys(device: Document, alternatives: Sequence[Alternative]) -> list[str]:
    """Keys of alternatives that are not varied, as the device file gives them from elsewhere than an assumption."""
    own = dict(quantities_of(device))
    keys = dict.fromkeys([*(each.key for each in alternatives), HALF_CYCLE])
    return [key for key in keys if key in own and not is_assumed(own[key])]


def absent_keys(device: Document, alternatives: Sequence[Alternative]) -> list[str]:
    """Keys of alternatives of device files that this one does not have: of other kinds of devices, or misspelt."""
    own = dict(quantities_of(device))
    return list(dict.fromkeys(each.key for each in alternatives if each.part == "devices" and each.key not in own))


def changed(configured: Sequence[Row], varied: Sequence[Row]) -> bool:
    """Whether any score is another one, or gone, where an assumption is varied."""
    there = _scores(varied)
    return any(
        case not in there or abs(there[case] - score) > SAME * abs(score) for case, score in _scores(configured).items()
    )


def reasons(configured: Sequence[Row], varied: Sequence[Row]) -> list[str]:
    """Why there are no scores where an assumption is varied, of those that there are as configured."""
    usual = _scores(configured)
    return list(dict.fromkeys(row["note"] for row in varied if row["score"] is None and _case(row) in usual))


def orders_held(configured: Sequence[Row], varied: Mapping[str, Sequence[Row]]) -> list[Order]:
    """What becomes of the orders of a device's scores, for each interface and read-out. An order that is certain is
    left out if it follows from two others that are, and hold wherever it does.

    configured: rows of the score table with errors, of conditions that differ. varied: those of each member, which take
    the same errors, relative to the score.
    """
    found: list[Order] = []
    for interface in Interface:
        for readout in Readout:
            own = rows_of(configured, interface, readout)
            members = {name: _with_errors(rows_of(rows, interface, readout), own) for name, rows in varied.items()}
            orders = [_order(interface, readout, pair, members) for pair in resolved_pairs(own)]
            told = without_implied({(each.low, each.high): {*each.holds} for each in orders if each.is_certain})
            found += [each for each in orders if not each.is_certain or (each.low, each.high) in told]
    return found


def _order(interface: Interface, readout: Readout, pair: Pair, members: Mapping[str, Sequence[Row]]) -> Order:
    """What becomes of one order in the members, by their rows of its interface and read-out."""
    held, open_, against, lost = list[str](), list[str](), list[str](), list[str]()
    for name, rows in members.items():
        pairs = resolved_pairs(rows)
        if not {row["condition"] for row in rows if row["score"] is not None}.issuperset(pair):
            lost.append(name)
        else:
            (held if pair in pairs else against if pair[::-1] in pairs else open_).append(name)
    return Order(interface, readout, *pair, tuple(held), tuple(open_), tuple(against), tuple(lost))


def _case(row: Row) -> tuple[str, str, str]:
    return row["condition"], row["interface"], row["readout"]


def _scores(rows: Sequence[Row]) -> dict[tuple[str, str, str], float]:
    """The scores that there are, by condition, interface and read-out."""
    return {_case(row): row["score"] for row in rows if row["score"] is not None}


def _with_errors(rows: Sequence[Row], configured: Sequence[Row]) -> list[Row]:
    """Rows that have scores, with the errors of those as configured, in proportion to the scores, where these are
    known.
    """
    usual = {row["condition"]: row for row in configured if has_error(row)}
    found: list[Row] = []
    for row in rows:
        own = usual.get(row["condition"])
        if own is not None and row["score"] is not None:
            error = error_in_proportion(row["score"], own["score"], own["score_error"])
            found.append({**row, "score_error": None if math.isnan(error) else error})
    return found
