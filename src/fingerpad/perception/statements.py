"""The paper's statements: each a text, where it stands, and a check that returns a verdict with the numbers behind it.

Nothing here knows how a check will end. What the paper says in words is held against their usual bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import pandas as pd

from ..readouts.comparison import Relation, Score
from ..readouts.roughness import SERIES
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..words import INTERFACE_NAME, READOUT_NAME, typeset
from .correlation import CONSTANT_SCORE
from .verdicts import (
    Chain,
    Holds,
    all_hold,
    chain_text,
    held,
    is_less,
    is_lower,
    is_surrogate,
    misses,
    r_of,
    relations,
    rises,
    slope_of,
    throughout,
)
from .wording import is_open

DISPERSIONS = ("low", "medium", "high")
PHASES = (0.0, 90.0, 180.0)
# |r| [1] from which a correlation is called so; source: Evans 1996, Straightforward Statistics for the Behavioral
# Sciences
WEAK, MODERATE, STRONG = 0.2, 0.4, 0.6
VERY_WELL = math.sqrt(0.876)  # |r| [1]; source: paper: Results, the lowest R² that it calls "very well correlated"


class Kind(StrEnum):
    """Whether the paper makes a statement, or one that asks less stands in its spirit."""

    STATED = "stated"
    WEAKER = "weaker"


Key = tuple[str, str, str]  # device, interface, readout
Condition = tuple[str, float]  # dispersion, phase [deg]
Verdict = tuple[Holds, str]  # whether it holds, evidence


class AbsentError(Exception):
    """A claim needs a number which the tables do not hold."""


@dataclass(frozen=True)
class Scores:
    """The scores of one key [in `unit`] by condition."""

    values: Mapping[Condition, Score]
    unit: str

    def __getitem__(self, condition: Condition) -> Score:
        if condition not in self.values:
            raise AbsentError
        return self.values[condition]


@dataclass(frozen=True)
class Tables:
    """What statements are checked against: scores, and rows of correlations. What is not there raises AbsentError."""

    by_key: Mapping[Key, Scores]
    correlations: Mapping[Key, Mapping[str, Any]]

    def scores(self, device: str, interface: Interface, readout: Readout) -> Scores:
        if (device, interface, readout) not in self.by_key:
            raise AbsentError
        return self.by_key[device, interface, readout]

    def correlation(self, device: str, interface: Interface, readout: Readout) -> Mapping[str, Any]:
        row = self.correlations.get((device, interface, readout), {"n": 0})
        if row["n"] == 0 or (pd.isna(row["r2"]) and row["note"] != CONSTANT_SCORE):
            raise AbsentError
        return row


@dataclass(frozen=True)
class Statement:
    """What the paper says, where, and the check of it; that raises AbsentError where a number it needs is absent."""

    text: str
    source: str
    check: Callable[[Tables], Verdict]
    kind: Kind = Kind.STATED


def tables_of(scores: pd.DataFrame, correlations: pd.DataFrame) -> Tables:
    """The tables of one kind of kinematics; scores that are absent (NaN) are left out."""
    by_key = {}
    for (device, interface, readout), group in scores.groupby(SERIES[1:], sort=False):
        scored = group.astype({"score": float, "score_error": float}).dropna(subset=["score"])
        rows = scored[["dispersion", "phase_deg", "score", "score_error"]].fillna({"score_error": math.inf})
        by_key[device, interface, readout] = Scores(
            {(dispersion, float(phase)): Score(*score) for dispersion, phase, *score in rows.itertuples(index=False)},
            typeset(group["unit"].iloc[0]),
        )
    records = {(row["device"], row["interface"], row["readout"]): row for row in correlations.to_dict("records")}
    return Tables(by_key, records)


def _by_phase(scores: Scores, dispersion: str, phases: Sequence[float] = PHASES) -> Chain:
    return [(f"{phase:g}°", scores[dispersion, phase]) for phase in phases]


def _by_dispersion(scores: Scores, phase: float) -> Chain:
    return [(dispersion, scores[dispersion, phase]) for dispersion in DISPERSIONS]


def _change_rises(device: str, phases: Sequence[float]) -> Callable[[Tables], Verdict]:
    """With shear, the change-of-strain score rises along these phases."""

    def check(tables: Tables) -> Verdict:
        scores = tables.scores(device, Interface.SHEAR, Readout.CHANGE_OF_STRAIN)
        chain = _by_phase(scores, "alternate", phases)
        return rises(relations(chain)), f"Scores [{scores.unit}]: {chain_text(chain)}."

    return check


Chains = Mapping[str, Chain]


def _along_phase(scores: Scores) -> Chains:
    """Device 1's scores by phase, at every dispersion."""
    return {f"{dispersion} dispersion": _by_phase(scores, dispersion) for dispersion in DISPERSIONS}


def _along_dispersion(scores: Scores) -> Chains:
    """Device 1's scores by dispersion, at every phase at which dispersions differ."""
    return {f"{phase:g}°": _by_dispersion(scores, phase) for phase in PHASES[1:]}


def _all_steps(chains: Chains) -> list[Relation]:
    return [step for chain in chains.values() for step in relations(chain)]


def _all_shown(chains: Chains) -> str:
    return "; ".join(f"{name} {chain_text(chain)}" for name, chain in chains.items())


def _device1_rises(along: Callable[[Scores], Chains]) -> Callable[[Tables], Verdict]:
    """With shear, Device 1's change-of-strain score rises along these chains."""

    def check(tables: Tables) -> Verdict:
        scores = tables.scores("device1", Interface.SHEAR, Readout.CHANGE_OF_STRAIN)
        chains = along(scores)
        return rises(_all_steps(chains)), f"Scores [{scores.unit}]: {_all_shown(chains)}."

    return check


def _device1_strain(tables: Tables) -> Verdict:
    """The strain score misses a step of those which the two claims above make about the change of strain."""
    scores = tables.scores("device1", Interface.SHEAR, Readout.STRAIN)
    chains = {**_along_phase(scores), **_along_dispersion(scores)}
    steps = _all_steps(chains)
    rising = f"{steps.count(Relation.LESS)} of {len(steps)} steps rise"
    return misses(steps), f"{rising}. Scores [{scores.unit}]: {_all_shown(chains)}."


def _described(row: Mapping[str, Any]) -> str:
    numbers = f"R² {row['r2']:.4g}, Kendall's tau {row['kendall_tau']:.3g}, "
    reason = f"({row['note']}) " if isinstance(row["note"], str) and row["note"] else ""
    sign = "positive" if slope_of(row) > 0 else "negative"
    doubt = " (open)" if is_open(row) else ""
    what = f"{sign} slope{doubt}, {numbers}" if slope_of(row) else f"no slope {reason}with "
    others = ""
    if is_surrogate(row) and not pd.isna(row["r2_lowest"]):
        doubt = ", the slope's sign open for some" if r_of(row).is_open else ""
        others = f"; R² {row['r2_lowest']:.2g} to {row['r2_highest']:.2g} over all ratings with the stated order{doubt}"
    return f"{INTERFACE_NAME[Interface(row['interface'])]}: {what}n {row['n']} ({row['rating_kind']}{others})"


def _correlates(
    device: str, interface: Interface, readout: Readout, sign: int = 1, more_than: float = 0.0
) -> Callable[[Tables], Verdict]:
    """The slope has that sign, and |r| is larger than that [1]."""

    def check(tables: Tables) -> Verdict:
        row = tables.correlation(device, interface, readout)
        r = r_of(row)
        error = r.error if more_than > 0.0 or r.is_open else 0.0  # a sign is certain where errors do not turn it
        ends = [is_less(more_than, sign * end, error) for end in r.ends]
        return throughout(ends), f"{READOUT_NAME[readout]}, {_described(row)}."

    return check


def _correlates_less(device: str, interface: Interface, readout: Readout, than: float) -> Callable[[Tables], Verdict]:
    """|r| is less than that [1], whichever way the slope is."""

    def check(tables: Tables) -> Verdict:
        row = tables.correlation(device, interface, readout)
        r = r_of(row)
        ends = [is_less(strength, than, r.error) for strength in r.strengths]
        return throughout(ends), f"{READOUT_NAME[readout]}, {_described(row)}."

    return check


def _device2_weaker(tables: Tables) -> Verdict:
    """|r| is smaller without shear, whichever way the slopes are."""
    off, on = (
        tables.correlation("device2", interface, Readout.CHANGE_OF_STRAIN)
        for interface in (Interface.FRICTIONLESS, Interface.SHEAR)
    )
    without, with_shear = r_of(off), r_of(on)
    (weakest, strongest), error = without.strengths, without.error + with_shear.error
    ends = [
        is_less(low, high, error)
        for low, high in zip((weakest, strongest), reversed(with_shear.strengths), strict=True)
    ]
    return throughout(ends), f"Change of strain, {_described(off)}; {_described(on)}."


# --- shear off -----------------------------------------------------------------------------------------------------


def _both(tables: Tables, device: str) -> tuple[Scores, Scores]:
    """A device's change-of-strain scores without shear and with it."""
    off, on = (
        tables.scores(device, interface, Readout.CHANGE_OF_STRAIN)
        for interface in (Interface.FRICTIONLESS, Interface.SHEAR)
    )
    return off, on


def _device2_misses(tables: Tables) -> Verdict:
    """Without shear the change of strain misses a step of those by which it rises with shear."""
    scores = tables.scores("device2", Interface.FRICTIONLESS, Readout.CHANGE_OF_STRAIN)
    chain = _by_phase(scores, "alternate")
    return misses(relations(chain)), f"Scores [{scores.unit}]: {chain_text(chain)}."


def _device2_slides(tables: Tables) -> Verdict:
    """The change of strain is smaller without shear at every phase."""
    off, on = _both(tables, "device2")
    pairs = [(off["alternate", phase], on["alternate", phase]) for phase in PHASES]
    shown = "; ".join(
        f"{phase:g}° {without.value:.4g} without shear, {with_shear.value:.4g} with it"
        for phase, (without, with_shear) in zip(PHASES, pairs, strict=True)
    )
    parts = [is_lower(low, high) for low, high in pairs]
    return all_hold(parts), f"Scores [{on.unit}]: {shown}."


def _device1_keeps(tables: Tables) -> Verdict:
    """Every step by phase or by dispersion has the same relation when shear is left out."""
    without, with_shear = _both(tables, "device1")
    off, on = ({**_along_phase(scores), **_along_dispersion(scores)} for scores in (without, with_shear))
    pairs = zip(_all_steps(off), _all_steps(on), strict=True)
    parts = [Holds.UNDECIDED if Relation.NEAR in pair else held(pair[0] == pair[1]) for pair in pairs]
    effect = _effect_of_shear(tables, "device1", DISPERSIONS)
    return all_hold(parts), (
        f"{parts.count(Holds.YES)} of {len(parts)} steps stay. Leaving out shear changes the scores, relative to their"
        f" mean, on average by {effect.value:.3g}. Without shear [{without.unit}]: {_all_shown(off)}."
    )


def _device2_spread(tables: Tables) -> Verdict:
    """Largest less smallest score over the phases is smaller without shear."""
    off, on = _both(tables, "device2")
    ends, shown = [], []
    for scores in (off, on):
        own = [scores["alternate", phase] for phase in PHASES]
        lowest, highest = ([score.value + sign * score.error for score in own] for sign in (-1.0, 1.0))
        ends.append((max(max(lowest) - min(highest), 0.0), max(highest) - min(lowest)))
        shown.append(max(score.value for score in own) - min(score.value for score in own))
    (least, most), (least_with, most_with) = ends
    holds = Holds.YES if most < least_with else Holds.NO if most_with <= least else Holds.UNDECIDED
    return holds, (
        f"Largest less smallest change-of-strain score [{on.unit}]: {shown[0]:.4g} without shear,"
        f" {shown[1]:.4g} with it."
    )


def _effect_of_shear(tables: Tables, device: str, dispersions: Sequence[str]) -> Score:
    """Mean |score without shear - score with it| over the mean score with it [1]; change of strain."""
    off, on = _both(tables, device)
    conditions = [(dispersion, phase) for dispersion in dispersions for phase in PHASES]
    total = sum(on[c].value for c in conditions)
    if total == 0.0:
        raise AbsentError
    effect = sum(abs(off[c].value - on[c].value) for c in conditions)
    # the sum of scores in the denominator has an error, too
    error = sum(off[c].error + on[c].error * (1.0 + effect / total) for c in conditions)
    return Score(effect / total, error / total)


def _device1_insensitive(tables: Tables) -> Verdict:
    """The device that moves normally depends less on shear than the one that moves laterally."""
    one = _effect_of_shear(tables, "device1", DISPERSIONS)
    two = _effect_of_shear(tables, "device2", ["alternate"])
    return is_lower(one, two), (
        "Leaving out shear changes the change-of-strain scores, relative to their mean, on average by"
        f" {one.value:.3g} for Device 1 and {two.value:.3g} for Device 2."
    )


_ORDER = "paper: Introduction; Results"
_ENHANCED = "paper: Discussion (enhancement of roughness by dispersion and phase difference)"
_RESULTS = "paper: Results"
_SHEAR = "paper: Role of shear forces in roughness perception"
STATEMENTS: tuple[Statement, ...] = (
    Statement("Device 2: the change of strain rises 0° < 90° < 180°.", _ORDER, _change_rises("device2", PHASES)),
    Statement(
        "Device 3: the change of strain rises 180° < 0° < 90°.",
        "paper: Results; a sentence of the Introduction contradicts itself: 0° highest, the peak at 90°",
        _change_rises("device3", (180.0, 0.0, 90.0)),
    ),
    Statement(
        "Device 1: the change of strain rises with phase (0°, 90°, 180°) at every dispersion.",
        _ENHANCED,
        _device1_rises(_along_phase),
    ),
    Statement(
        "Device 1: the change of strain rises with dispersion at 90° and 180°.",
        _ENHANCED,
        _device1_rises(_along_dispersion),
    ),
    *(
        Statement(
            f"Device {number}: the change of strain correlates very well.",
            _RESULTS,
            _correlates(f"device{number}", Interface.SHEAR, Readout.CHANGE_OF_STRAIN, more_than=VERY_WELL),
        )
        for number in (1, 2, 3)
    ),
    Statement(
        "Device 2: the strain correlates well.",
        _RESULTS,
        _correlates("device2", Interface.SHEAR, Readout.STRAIN, more_than=STRONG),
    ),
    Statement(
        "Device 1: the strain correlates very poorly.",
        _RESULTS,
        _correlates_less("device1", Interface.SHEAR, Readout.STRAIN, than=WEAK),
    ),
    Statement("Device 1: the strain misses the order of roughness.", _RESULTS, _device1_strain),
    Statement(
        "Device 3: the strain correlates negatively.",
        _RESULTS,
        _correlates("device3", Interface.SHEAR, Readout.STRAIN, sign=-1),
    ),
    Statement(
        "Device 2 without shear: the change of strain misses the order of roughness.",
        "paper: Significance (shear is essential); Role of shear forces in roughness perception",
        _device2_misses,
    ),
    Statement(
        "Device 2 without shear: the strain correlates negatively.",
        _SHEAR,
        _correlates("device2", Interface.FRICTIONLESS, Readout.STRAIN, sign=-1),
    ),
    Statement(
        "Device 2 without shear: the change of strain correlates weakly.",
        _SHEAR,
        _correlates_less("device2", Interface.FRICTIONLESS, Readout.CHANGE_OF_STRAIN, than=MODERATE),
    ),
    Statement("Device 2 without shear: the change of strain is smaller at every phase.", _SHEAR, _device2_slides),
    Statement(
        "Device 1 without shear: the change of strain still correlates very well.",
        _SHEAR,
        _correlates("device1", Interface.FRICTIONLESS, Readout.CHANGE_OF_STRAIN, more_than=VERY_WELL),
    ),
    Statement(
        "Device 1 without shear: the strain still correlates very poorly.",
        _SHEAR,
        _correlates_less("device1", Interface.FRICTIONLESS, Readout.STRAIN, than=WEAK),
    ),
    Statement(
        "Device 1: leaving out shear reverses no order of the change of strain.", _SHEAR, _device1_keeps, Kind.WEAKER
    ),
    Statement(
        "Device 2 without shear: the change of strain correlates more weakly than with it.",
        _SHEAR,
        _device2_weaker,
        Kind.WEAKER,
    ),
    Statement(
        "Device 2 without shear: the change of strain varies less with phase.", _SHEAR, _device2_spread, Kind.WEAKER
    ),
    Statement("Device 1: leaving out shear matters less than for Device 2.", _SHEAR, _device1_insensitive, Kind.WEAKER),
)
