"""The whole prediction of a scene in one process: scores with errors, ranks and caveats."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from threadpoolctl import threadpool_limits

from ..readouts.accuracy import score_key, with_error, with_errors
from ..readouts.roughness import unpredicted_rows
from ..scene.contact_law import Interface
from ..scene.device import Control
from ..scene.scene import Scene
from .edges import edge_intervals
from .ranking import ranks
from .scoring import Case, ReadSolution, error_rows, solved_rows

SILENT = "the device controls forces: its displacements without friction are unknown"
LEFT_OUT = "skipped by `interfaces` in the device file"


def forecast(scene: Scene, error: bool = True, step: Callable[[], object] = lambda: None) -> list[dict[str, Any]]:
    """Rows of the score table, as the workflow's, with `rank`, `first_rank` and `last_rank` (`ranks`), `indentation_mm`
    and `force_N_per_mm` of pre-indentation, `sliding_share` (`Solution.sliding_share`), `time` at which a condition
    of several times is read, its `time_unit`, and `caveats` (sentences) behind.

    What cannot be meshed or solved has no score, and a note that says why. error: whether to solve once more, more
    coarsely, for `score_error`; without, or if that cannot be done, as the note then says, that is None. step: called
    after each of `steps`.
    """
    with threadpool_limits(1):  # two threads take longer (decision 14), and results depend on their number
        edges = edge_intervals(scene)
        rows, read = solved_rows(scene, edges, step)
        checks = error_rows(scene, edges, read, step) if error and read else []
    silent = unpredicted_rows(scene)
    found = [*rows, *silent]
    table = with_errors(found, checks) if error else [with_error(row, None) for row in found]
    why = LEFT_OUT if scene.device.control is Control.DISPLACEMENT else SILENT
    caveats = [_caveats(row, read, checks) for row in table[: len(rows)]] + [[why] for _ in silent]
    return [
        row | rank | _contact(scene, row, read) | {"caveats": tuple(own)}
        for row, rank, own in zip(table, ranks(table), caveats, strict=True)
    ]


def _caveats(
    row: Mapping[str, Any], read: Mapping[Case, ReadSolution], checks: Sequence[Mapping[str, Any]]
) -> list[str]:
    """What to know of a row: the caveats of its solution and why its error is unknown, or why it has no score."""
    case = row["condition"], Interface(row["interface"])
    if case not in read:
        return [row["note"]]
    unknown = [check["note"] for check in checks if check["note"] and score_key(check) == score_key(row)]
    return [*read[case].caveats, *unknown]


def _contact(scene: Scene, row: Mapping[str, Any], read: Mapping[Case, ReadSolution]) -> dict[str, float | str | None]:
    """Columns that say how a device was pressed, and how much slid, if it was, and when it was read."""
    case = row["condition"], Interface(row["interface"])
    if case not in read:
        return dict.fromkeys(("indentation_mm", "force_N_per_mm", "sliding_share", "time", "time_unit"))
    solution, condition = read[case].solution, scene.device.condition(case[0])
    sliding = solution.sliding_share
    return {
        "indentation_mm": solution.indentation,
        "force_N_per_mm": float(solution.pressing[0].sum()),
        "sliding_share": None if math.isnan(sliding) else sliding,
        "time": float(condition.time[solution.reading.time]) if condition.time.size > 1 else None,
        "time_unit": condition.time_unit or None,
    }


def steps(scene: Scene, error: bool = True) -> int:
    """How often at most `forecast` calls its `step`: after condensation and after every condition of every solution."""
    return (2 if error else 1) * (1 + len(scene.device.interfaces()) * len(scene.device.conditions))
