"""The table in which `fingerpad predict` prints scores: how the device was pressed, ranks, and caveats below."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ..rounding import rounded
from ..scene.contact_law import Interface
from ..scene.problems import written
from ..scene.scene import Scene
from ..scene.variation import NO_VALUES
from ..words import plain
from .printing import aligned, caveats_told, in_order, read_times, titled

COLUMNS = ("condition", "interface", "readout", "score", "score_error", "unit", "rank", "note")  # of the table
RIGHT = {"score", "score_error", "rank"}  # columns that are aligned at the right


def as_table(scene: Scene, rows: Sequence[Mapping[str, Any]], values: Mapping[str, Any] = NO_VALUES) -> str:
    """Title, aligned table (unless nothing has a score) and caveats of one device, with these values in place of those
    in its files.
    """
    title = ", ".join([titled(scene), *([named(values)] if values else [])])
    ordered = in_order(rows)
    # why there is none is a caveat, as are the notes of scores
    notes = ["" if row["score"] is not None else row["note"].partition(":")[0] for row in ordered]
    told = [
        {**row, **_score(row), "note": note, "rank": _ranked(row)} for row, note in zip(ordered, notes, strict=True)
    ]
    cells = [[str(row[column]) for column in COLUMNS] for row in told]
    columns = [i for i, name in enumerate(COLUMNS) if name != "note" or any(notes)]
    chosen = [[line[i] for i in columns] for line in ([plain(name) for name in COLUMNS], *cells)]
    lines = [title, *_contact(ordered)]
    if any(row["score"] is not None for row in rows):
        lines += aligned(chosen, [COLUMNS[i] in RIGHT for i in columns])
    return "\n".join([*lines, *caveat_lines(scene, ordered)])


def caveat_lines(scene: Scene, rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """What to know before believing the scores of one device, each once, with those that it is about."""
    every = [condition.name for condition in scene.device.conditions]
    return [f"caveat: {told}" for told in caveats_told(rows, every, lambda row: row["readout"])]


def _contact(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """How deep and how hard the device was pressed at each interface, if it was, how much slides in each condition
    where there is friction, and when conditions of several times are read.
    """
    preloads = dict.fromkeys(
        f"{row['indentation_mm']:.3g} mm and {row['force_N_per_mm']:.3g} N/mm ({row['interface']})"
        for row in rows
        if row["indentation_mm"] is not None
    )
    shares = {
        row["condition"]: row["sliding_share"]
        for row in rows
        if row["interface"] == Interface.SHEAR and row["sliding_share"] is not None
    }
    sliding = ", ".join(f"{share:.0%} ({condition})" for condition, share in shares.items())
    told = {
        "pre-indentation": ", ".join(preloads),
        "sliding, share of the pressing force (shear)": sliding,
        "read at time, where strain has changed most": read_times(row for row in rows if row["time"] is not None),
    }
    return [f"{what}: {text}" for what, text in told.items() if text]


def named(values: Mapping[str, Any]) -> str:
    """What a variant differs in, in words, whole, as variants may differ at the end of a long value."""
    return ", ".join(f"{key} {written(value)}" for key, value in values.items())


def _ranked(row: Mapping[str, Any]) -> str:
    """The rank of a row's score, or the first and the last that errors leave it; in question without an error, nothing
    without a score.
    """
    if row["rank"] is None:
        return ""
    if row["first_rank"] is None:
        return f"{row['rank']}?"
    first, last = row["first_rank"], row["last_rank"]
    return str(row["rank"]) if first == last else f"{first}-{last}"


def _score(row: Mapping[str, Any]) -> dict[str, str]:
    """The score and its error as far as the error tells; nothing in place of what is not there."""
    score, error = row["score"], row["score_error"]
    told, within = rounded(score, math.nan if error is None else error) if score is not None else ("", "")
    return {"score": told, "score_error": within if error is not None else ""}
