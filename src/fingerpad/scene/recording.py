"""Measured displacements of a device's actuators, read from a CSV file and checked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..csvrows import checked_rows, number, told
from ..errors import SceneError

COLUMNS = ("time", "actuator", "normal", "tangential")  # [s], [1] from 1 at the left, [mm], [mm]
LATEST = 1e6  # time [s]; source: as in the schema of `kind: history`
FARTHEST = 10.0  # displacement [mm]; source: as in the schema of `kind: history`
MOST_TIMES = 10_000  # [1]; source: as in the schema of `kind: history`
UM = 1e-3  # mm


@dataclass(frozen=True)
class Recording:
    """Displacements from the pre-indented position. time: (n_times,) [s], ascending. normal (into the skin),
    tangential (along the row): (n_times, n_actuators) [mm].
    """

    time: FloatArray
    normal: FloatArray
    tangential: FloatArray


def read_recording(path: Path, count: int) -> Recording:
    """Displacements of `count` actuators from a CSV with one row per time and actuator, in any order.

    Columns: time [s], from 0; actuator, 1 to count from left to right; normal, tangential [mm]. Every actuator has a
    row at every time. Raises SceneError, which names file, line, column, what was found and what is allowed.
    """
    found: dict[tuple[float, int], tuple[float, float]] = {}
    lines: dict[tuple[float, int], int] = {}
    first: dict[float, tuple[str, int]] = {}  # how the file writes a time, and on which line it first does
    for line, row in checked_rows(path, COLUMNS, SceneError):
        time = _within(path, line, "time", row["time"], (0.0, LATEST), "s")
        at = time, _actuator(path, line, row["actuator"], count)
        if at in lines:
            allowed = f"one row per time and actuator; {row['time']} s has it on line {lines[at]}"
            raise SceneError(told(path, line, "actuator", row["actuator"], allowed))
        lines[at] = line
        first.setdefault(time, (row["time"], line))
        if len(first) > MOST_TIMES:
            raise SceneError(f"{path}, column time: found more than {MOST_TIMES} times; allowed: at most {MOST_TIMES}")
        normal, tangential = (
            _within(path, line, name, row[name], (-FARTHEST, FARTHEST), "mm") for name in ("normal", "tangential")
        )
        found[at] = normal, tangential
    times = sorted(first)
    for time in times:
        for actuator in range(1, count + 1):
            if (time, actuator) not in found:
                text, line = first[time]
                raise SceneError(
                    f"{path}, column actuator: found no row of actuator {actuator} at '{text}' s, where line {line} has"
                    f" others; allowed: at every time a row of each of the {count} actuators"
                )
    values = np.array([[found[time, actuator] for actuator in range(1, count + 1)] for time in times])
    return Recording(np.array(times), values[..., 0], values[..., 1])


def _actuator(path: Path, line: int, text: str, count: int) -> int:
    value = number(text)
    if value not in range(1, count + 1):
        raise SceneError(
            told(path, line, "actuator", text, f"a whole number, counted from 1 (the left one) to {count}")
        )
    return int(value)


def _within(path: Path, line: int, column: str, text: str, limits: tuple[float, float], unit: str) -> float:
    value, (lowest, highest) = number(text), limits
    if not lowest <= value <= highest:
        micrometres = unit == "mm" and math.isfinite(value) and abs(value) * UM <= highest
        meant = f"{value * UM:g}" if micrometres else ""
        raise SceneError(told(path, line, column, text, f"a number from {lowest:g} to {highest:g} [{unit}]", meant))
    return value
