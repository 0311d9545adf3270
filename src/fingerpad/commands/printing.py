"""How subcommands print tables."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from ..errors import ContactError
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..store import csv_text
from ..words import enumerated

Row = TypeVar("Row", bound=Mapping[str, Any])

GAP = "  "
SHARE = re.compile(r"\d+(?:\.\d+)?%")


def titled(scene: Scene) -> str:
    """The line above a device's table: which device, and with which kinematics."""
    return f"{scene.device.title} ({scene.device.name}), {scene.kinematics} strain"


def print_rows(options: argparse.Namespace, rows: Sequence[Row], text: Callable[[], str]) -> None:
    """Print rows in the form that `options.add_forms` lets ask for, or as text."""
    if options.json:
        print(json.dumps(rows, indent=2))
    elif options.csv:
        print(as_csv(rows), end="")
    else:
        print(text())


def as_csv(rows: Iterable[Mapping[str, Any]], header: bool = True) -> str:
    """Rows as CSV, with their caveats, if they have any such list, in one cell."""
    told = ({**row, "caveats": "; ".join(row["caveats"])} if "caveats" in row else {**row} for row in rows)
    return csv_text([*told], header=header)


def read_times(rows: Iterable[Mapping[str, Any]]) -> str:
    """When conditions are read, each once, from rows with `time`, `time_unit`, `condition` and `interface`."""
    told = (f"{row['time']:.9g} {row['time_unit']} ({row['condition']}, {row['interface']})" for row in rows)
    return ", ".join(dict.fromkeys(told))


def whose(conditions: Sequence[str], every: Sequence[str]) -> str:
    """Conditions in words, or that it is `every` one.

    >>> whose(["a"], ["a", "b"]), whose(["a", "b"], ["a", "b"])
    ('a', 'all conditions')
    """
    return "all conditions" if len(every) > 1 and [*conditions] == [*every] else ", ".join(conditions)


def cases(rows: Iterable[Row], every: Sequence[str], detail: Callable[[Row], str]) -> str:
    """Which rows they are: by interface and details, each of them once, the conditions, or that it is `every` one.

    >>> rows = [{"condition": name, "interface": "shear", "readout": "strain"} for name in ("a", "b")]
    >>> cases(rows, ["a", "b", "c"], lambda row: row["readout"])
    'a, b (shear, strain)'
    """
    details: dict[tuple[str, str], dict[str, None]] = {}
    for row in rows:
        details.setdefault((row["interface"], row["condition"]), {})[detail(row)] = None
    conditions: dict[tuple[str, str], list[str]] = {}
    for (interface, condition), own in details.items():
        conditions.setdefault((interface, enumerated([*own])), []).append(condition)
    return "; ".join(f"{whose(own, every)} ({interface}, {told})" for (interface, told), own in conditions.items())


def caveats_told(rows: Sequence[Row], every: Sequence[str], detail: Callable[[Row], str]) -> list[str]:
    """Each caveat of the rows once, after the cases that it is about; those that differ in one share alone as one."""
    return [f"{cases(own, every, detail)}: {caveat}" for caveat, own in _alike(rows)]


def _alike(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    """Each caveat once, with the rows that have it; those that differ in one share alone as one, with both ends."""
    alike: dict[str, list[tuple[str, Row]]] = {}
    for row in rows:
        for caveat in row["caveats"]:
            kind = SHARE.sub("%", caveat) if len(SHARE.findall(caveat)) == 1 else caveat
            alike.setdefault(kind, []).append((caveat, row))
    for found in alike.values():
        caveats = sorted({caveat for caveat, _ in found}, key=_share)
        ends = f"{SHARE.findall(caveats[0])[0]} to {SHARE.findall(caveats[-1])[0]}" if len(caveats) > 1 else ""
        yield SHARE.sub(ends, caveats[0]) if ends else caveats[0], [row for _, row in found]


def _share(caveat: str) -> float:
    """The first share in a caveat [%], or zero."""
    return float(next(iter(SHARE.findall(caveat)), "0%").removesuffix("%"))


def require_scores(rows: Sequence[Mapping[str, Any]]) -> None:
    """Raise ContactError, with the first note, if no row has a score."""
    if all(row["score"] is None for row in rows):
        raise ContactError(f"nothing could be scored: {rows[0]['note']}")


def in_order(rows: Iterable[Row]) -> list[Row]:
    """Rows of the score table with interfaces and read-outs in the order in which figures show them.

    >>> rows = [{"interface": i, "readout": "strain"} for i in ("frictionless", "shear")]
    >>> [row["interface"] for row in in_order(rows)]
    ['shear', 'frictionless']
    """
    places = {str(each): place for names in (Interface, Readout) for place, each in enumerate(names)}
    return sorted(rows, key=lambda row: (places[row["interface"]], places[row["readout"]]))


def aligned(lines: Sequence[Sequence[str]], right: Sequence[bool]) -> list[str]:
    """Lines of cells, the header first, with columns of equal width; those of `right` end at the right.

    >>> aligned([["a", "b"], ["long", "1"]], [False, True])
    ['a     b', 'long  1']
    """
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        GAP.join(
            cell.rjust(width) if at_right else cell.ljust(width)
            for cell, width, at_right in zip(line, widths, right, strict=True)
        ).rstrip()
        for line in lines
    ]
