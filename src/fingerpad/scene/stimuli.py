"""Kinds of stimuli: what a device file says of a drive, to the conditions of a device.

A kind is a function in KINDS and a definition of the same name in `workflow/schemas/device.schema.yaml`. Nothing else
knows the kinds (docs/extending.md shows how to add one). A file that a kind reads stands at a key `file`, so that
rules depend on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..errors import SceneError
from .device import CROSSING, Condition, Cycle
from .recording import read_recording

# The plain values under `stimulus`, the number of actuators and the device file's folder, to conditions
Builder = Callable[[Mapping[str, Any], int, Path], list[Condition]]

Displacement = TypeVar("Displacement", FloatArray, ComplexArray)

ALTERNATE = "alternate"  # dispersion of a row whose neighbours differ
# What actuators in turn move of a relative displacement [1], by what it is relative to
SHARES = {"neighbour": (0.5, -0.5), "row": (1.0, -1.0), "leader": (0.0, -1.0)}
# ASSUME: stimulus.playback: cycle is followed in CYCLE_STEPS straight lines
CYCLE_STEPS = 64  # [1]; source: scores are within 0.2 % of those with 128 for Devices 1 and 2, with 16 within 1.4 %
# ASSUME: stimulus.playback: cycle is read in the one after SETTLING, as friction remembers how the first one began
SETTLING = 2  # [1]; source: changes of strain of waves that differ in time alone are within 0.8 %, not 6 % as with 1

# Decimals to which a phase's distance from the peak [deg] is rounded, so that 60 and 300 degrees are one stimulus;
# source: 64 steps of up to 360 degrees are rounded by 4e-12
FOLDED = 9


def phased(stimulus: Mapping[str, Any], count: int, folder: Path) -> list[Condition]:
    """Actuator i at A cos(k_i p) (snapshot), or A sin(w t + k_i p) over SETTLING periods and one more (cycle); minus in
    the second half-cycle, here as in all that follows. Raises SceneError where a snapshot has no actuator with k_i = 0,
    or k are not as many as actuators.
    """
    conditions = []
    for dispersion, phase, lead in _leads(stimulus, count):
        settling = 0
        if stimulus["playback"] == "snapshot":
            if 0 not in stimulus["dispersions"][dispersion]:
                raise SceneError(
                    f"stimulus.dispersions.{dispersion}: found {list(stimulus['dispersions'][dispersion])}; allowed: at"
                    " least one group index 0, as a snapshot is the state at the peak of such actuators"
                )
            displacement = at_peak(stimulus["amplitude"], lead)[None, :]
            time = np.array([1.0])
        else:
            settling = SETTLING * CYCLE_STEPS
            time = np.arange(1, settling + CYCLE_STEPS + 1) / CYCLE_STEPS
            displacement = stimulus["amplitude"] * np.sin(2.0 * math.pi * time[:, None] + np.radians(lead))
        moves = _directed(stimulus, displacement)
        name = condition_name(dispersion, phase)
        conditions.append(Condition(name, dispersion, float(phase), time, *moves, settling))
    return conditions


def at_peak(amplitude: float, lead: FloatArray) -> FloatArray:
    """Displacements A cos(lead) (n,) [mm] of actuators that are ahead (n,) [deg] of one at its peak, as a snapshot has
    them: to CROSSING decimals, and the same for phases that are mirror images.
    """
    from_peak = np.round(np.abs(np.mod(lead + 180.0, 360.0) - 180.0), FOLDED)
    return np.asarray(amplitude * np.round(np.cos(np.radians(from_peak)), CROSSING))


def phased_cycles(stimulus: Mapping[str, Any], count: int) -> list[Cycle]:
    """Actuator i at A cos(w t + k_i p). Raises SceneError where k are not as many as actuators."""
    cycles = []
    for dispersion, phase, lead in _leads(stimulus, count):
        amplitude: ComplexArray = stimulus["amplitude"] * np.exp(1j * np.radians(lead))
        name, moves = condition_name(dispersion, phase), _directed(stimulus, amplitude)
        cycles.append(Cycle(name, dispersion, float(phase), *moves))
    return cycles


def condition_name(dispersion: str, phase: float) -> str:
    """A condition's name: its dispersion and phase difference [deg], with as many digits as tell it from all others.

    >>> condition_name("low", 90), condition_name("low", 22.5)
    ('low_090', 'low_022_5')
    """
    whole, _, fraction = np.format_float_positional(phase, trim="-").partition(".")
    return "_".join([dispersion, whole.zfill(3), *filter(None, [fraction])])


def _leads(stimulus: Mapping[str, Any], count: int) -> Iterator[tuple[str, float, FloatArray]]:
    """Dispersion and phase difference p [deg] of each condition, and by how much k_i p (count,) [deg] actuators are
    ahead.
    """
    for dispersion, groups in stimulus["dispersions"].items():
        if len(groups) != count:
            raise SceneError(
                f"stimulus.dispersions.{dispersion}: found {len(groups)} group indices; allowed: {count}, one for each"
                " actuator"
            )
        for phase in stimulus["phases"]:
            yield dispersion, phase, np.asarray(groups, dtype=float) * phase


def alternating(stimulus: Mapping[str, Any], count: int, folder: Path) -> list[Condition]:
    """Actuators at their absolute displacement and shares of the relative one in turn (paper, Table 1)."""
    return [
        Condition(
            condition_name(ALTERNATE, row["phase"]),
            ALTERNATE,
            float(row["phase"]),
            np.array([1.0]),
            *_directed(stimulus, _alternating(row, stimulus["relative_to"], count)[None, :]),
        )
        for row in stimulus["rows"]
    ]


def alternating_cycles(stimulus: Mapping[str, Any], count: int) -> list[Cycle]:
    """Actuators at the displacements of `alternating` times cos(w t)."""
    cycles = []
    for row in stimulus["rows"]:
        amplitude: ComplexArray = _alternating(row, stimulus["relative_to"], count).astype(np.complex128)
        moves = _directed(stimulus, amplitude)
        cycles.append(Cycle(condition_name(ALTERNATE, row["phase"]), ALTERNATE, float(row["phase"]), *moves))
    return cycles


def _alternating(row: Mapping[str, Any], relative_to: str, count: int) -> FloatArray:
    """Displacements (count,) [mm] of a row of actuators whose neighbours differ."""
    return row["absolute"] + np.resize(SHARES[relative_to], count) * row["relative"]


def history(stimulus: Mapping[str, Any], count: int, folder: Path) -> list[Condition]:
    """Any path: per-actuator normal and tangential displacements at given times. Raises SceneError where a row has not
    one number per actuator, and as Condition.
    """
    conditions = []
    for name, given in stimulus["histories"].items():
        for key in ("normal", "tangential"):
            for number, row in enumerate(given[key], start=1):
                if len(row) != count:
                    raise SceneError(
                        f"stimulus.histories.{name}.{key}: found {len(row)} in row {number}; allowed: {count} numbers,"
                        " one for each actuator"
                    )
        time, normal, tangential = (np.asarray(given[key], dtype=float) for key in ("time", "normal", "tangential"))
        conditions.append(Condition(name, given["dispersion"], float(given["phase"]), time, normal, tangential))
    return conditions


def measured(stimulus: Mapping[str, Any], count: int, folder: Path) -> list[Condition]:
    """Any path, from CSV files in the device file's folder. Raises SceneError, naming the recording, as
    `read_recording`.
    """
    conditions = []
    for name, given in stimulus["recordings"].items():
        try:
            recording = read_recording(folder / given["file"], count)
        except SceneError as error:
            raise SceneError(f"stimulus.recordings.{name}.file: {error}") from error
        conditions.append(
            Condition(
                name=name,
                dispersion=given["dispersion"],
                phase_deg=float(given["phase"]),
                time=recording.time,
                normal=recording.normal,
                tangential=recording.tangential,
            )
        )
    return conditions


KINDS: Mapping[str, Builder] = {
    "phased": phased,
    "alternating": alternating,
    "history": history,
    "measured": measured,
}

# The kinds that may be asked for at a `frequency_hz`: the plain values under `stimulus` and the number of actuators
CYCLES: Mapping[str, Callable[[Mapping[str, Any], int], list[Cycle]]] = {
    "phased": phased_cycles,
    "alternating": alternating_cycles,
}


def _directed(stimulus: Mapping[str, Any], displacement: Displacement) -> tuple[Displacement, Displacement]:
    """Displacements (..., n_actuators) [mm] of a half-cycle as normal and tangential ones; `both` is both."""
    # ASSUME: stimulus.half_cycle: first is positive into the skin or to the right. In the second every displacement has
    # the opposite sign, and a row that is not its own mirror image has other gaps open.
    direction, still = stimulus["direction"], np.zeros_like(displacement)
    shown = displacement if stimulus["half_cycle"] == "first" else still - displacement  # no -0
    return still if direction == "lateral" else shown, still if direction == "normal" else shown
