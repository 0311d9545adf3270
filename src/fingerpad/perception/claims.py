"""The paper's statements, each checked against computed scores and correlations.

Nothing here knows how a check will end: a claim is a test together with the numbers it looked at. Where what is
compared differs by less than its errors, or these are not known, it is undecided; so is what some ratings with the
stated order would bear out and others not, where their order is all that is known of them. What the paper says in words
is held against their usual bounds.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import Any

import pandas as pd

from ..readouts.roughness import KEY, SAME, TYPESET_UNITS
from ..scene.contact_law import Interface
from ..scene.readout import READOUT_NAME, Readout
from .ratings import RatingKind

COLUMNS = ["kinematics", "claim", "kind", "source", "holds", "evidence"]
DISPERSIONS = ("low", "medium", "high")
PHASES = (0.0, 90.0, 180.0)
NEAR = "\N{ALMOST EQUAL TO}"  # between scores that differ by less than their errors
# |r| [1] from which a correlation is called so; source: Evans 1996, Straightforward Statistics for the Behavioral
# Sciences
WEAK, MODERATE, STRONG, VERY_STRONG = 0.2, 0.4, 0.6, 0.8


class Kind(StrEnum):
    """Whether the paper makes a statement, or makes a stronger one from which it follows."""

    STATED = "stated"
    WEAKER = "weaker"


class Holds(StrEnum):
    """Whether a statement holds; undecided where errors of scores or the choice of ratings leave it open."""

    YES = "yes"
    NO = "no"
    UNDECIDED = "undecided"


Key = tuple[str, str, str]  # device, interface, readout
Condition = tuple[str, float]  # dispersion, phase [deg]
Verdict = tuple[Holds, str]  # whether it holds, evidence


class _AbsentError(Exception):
    """A claim needs a number which the tables do not hold."""


@dataclass(frozen=True)
class _Score:
    """A score and its error, in one unit; an infinite error where it is not known."""

    value: float
    error: float


@dataclass(frozen=True)
class _Correlation:
    """Pearson's r [1] over all ratings that may be meant, and what errors of scores can add up to in it."""

    lowest: float
    highest: float
    error: float


Chain = Sequence[tuple[str, _Score]]  # (label, score), in the order in which the scores should rise


@dataclass(frozen=True)
class _Scores:
    """The scores of one key [in `unit`] by condition."""

    values: Mapping[Condition, _Score]
    unit: str

    def __getitem__(self, condition: Condition) -> _Score:
        if condition not in self.values:
            raise _AbsentError
        return self.values[condition]


@dataclass(frozen=True)
class _Tables:
    by_key: Mapping[Key, _Scores]
    correlations: Mapping[Key, Mapping[str, Any]]

    def scores(self, *key: str) -> _Scores:
        device, interface, readout = key
        if (device, interface, readout) not in self.by_key:
            raise _AbsentError
        return self.by_key[device, interface, readout]

    def correlation(self, *key: str) -> Mapping[str, Any]:
        device, interface, readout = key
        row = self.correlations.get((device, interface, readout), {"n": 0})
        if row["n"] == 0:
            raise _AbsentError
        return row


@dataclass(frozen=True)
class _Claim:
    text: str
    source: str
    check: Callable[[_Tables], Verdict]
    kind: Kind = Kind.STATED


def claims_table(scores: pd.DataFrame, correlations: pd.DataFrame) -> pd.DataFrame:
    """Which of the paper's statements hold.

    scores: columns kinematics, device, condition, dispersion, phase_deg, interface, readout, score [in `unit`, NaN
    without a prediction], score_error [in `unit`, NaN if it is not known], unit. correlations: from
    `correlation.correlation_table`, or its CSV read back.

    Returns the columns kinematics, claim, kind (see `Kind`), source, holds (see `Holds`) and evidence (a sentence with
    the numbers). To rise means by more than the larger of both errors; what they can add up to in a correlation is
    taken to first order. A claim which needs a score or a rating that is not there has no row: it is neither confirmed
    nor refuted.
    """
    rows = []
    for kinematics in scores["kinematics"].unique():
        tables = _tables(*(table[table["kinematics"] == kinematics] for table in (scores, correlations)))
        for claim in _CLAIMS:
            try:
                holds, evidence = claim.check(tables)
            except _AbsentError:
                continue
            rows.append((kinematics, claim.text, str(claim.kind), claim.source, str(holds), evidence))
    return pd.DataFrame(rows, columns=COLUMNS)


def verdict_counts(rows: Iterable[Mapping[str, Any]]) -> dict[str, Counter[str]]:
    """How many statements as the paper makes them end in each verdict, by kinematics. rows: of `claims_table`.

    >>> row = {"kinematics": "small", "kind": "stated", "holds": "yes"}
    >>> verdict_counts([row, row, row | {"holds": "undecided"}, row | {"kind": "weaker"}])
    {'small': Counter({'yes': 2, 'undecided': 1})}
    """
    counts: dict[str, Counter[str]] = {}
    for row in rows:
        if row["kind"] == Kind.STATED:
            counts.setdefault(row["kinematics"], Counter())[row["holds"]] += 1
    return counts


def _tables(scores: pd.DataFrame, correlations: pd.DataFrame) -> _Tables:
    by_key = {}
    for (device, interface, readout), group in scores.groupby(KEY[1:], sort=False):
        scored = group.astype({"score": float, "score_error": float}).dropna(subset=["score"])
        rows = scored[["dispersion", "phase_deg", "score", "score_error"]].fillna({"score_error": math.inf})
        by_key[device, interface, readout] = _Scores(
            {(dispersion, float(phase)): _Score(*score) for dispersion, phase, *score in rows.itertuples(index=False)},
            TYPESET_UNITS.get(group["unit"].iloc[0], group["unit"].iloc[0]),
        )
    records = {(row["device"], row["interface"], row["readout"]): row for row in correlations.to_dict("records")}
    return _Tables(by_key, records)


# --- orders --------------------------------------------------------------------------------------------------------


def _step(low: _Score, high: _Score) -> str:
    """How two scores compare: `<`, `=` (within the solver's tolerance), `≈` (within the larger of
    their errors) or `>`.
    """
    difference = abs(high.value - low.value)
    if difference <= SAME * max(abs(low.value), abs(high.value)):
        return "="
    if difference < max(low.error, high.error):
        return NEAR
    return "<" if low.value < high.value else ">"


def _steps(chain: Chain) -> list[str]:
    return [_step(low, high) for (_, low), (_, high) in pairwise(chain)]


def _rises(steps: Sequence[str]) -> Holds:
    """Whether each of the steps rises."""
    if set(steps) <= {"<", NEAR}:
        return Holds.UNDECIDED if NEAR in steps else Holds.YES
    return Holds.NO


def _shown(chain: Chain) -> str:
    """The chain as it is, right or wrong: `0°: 1.2 < 90°: 1.5 > 180°: 1.3`."""
    texts = [f"{label}: {score.value:.4g}" for label, score in chain]
    return " ".join([texts[0], *(f"{step} {text}" for step, text in zip(_steps(chain), texts[1:], strict=True))])


def _by_phase(scores: _Scores, dispersion: str, phases: Sequence[float] = PHASES) -> Chain:
    return [(f"{phase:g}°", scores[dispersion, phase]) for phase in phases]


def _by_dispersion(scores: _Scores, phase: float) -> Chain:
    return [(dispersion, scores[dispersion, phase]) for dispersion in DISPERSIONS]


def _change_rises(device: str, phases: Sequence[float]) -> Callable[[_Tables], Verdict]:
    """With shear, the change-of-strain score rises along these phases."""

    def check(tables: _Tables) -> Verdict:
        scores = tables.scores(device, Interface.SHEAR, Readout.CHANGE_OF_STRAIN)
        chain = _by_phase(scores, "alternate", phases)
        return _rises(_steps(chain)), f"Scores [{scores.unit}]: {_shown(chain)}."

    return check


Chains = Mapping[str, Chain]


def _along_phase(scores: _Scores) -> Chains:
    """Device 1's scores by phase, at every dispersion."""
    return {f"{dispersion} dispersion": _by_phase(scores, dispersion) for dispersion in DISPERSIONS}


def _along_dispersion(scores: _Scores) -> Chains:
    """Device 1's scores by dispersion, at every phase at which dispersions differ."""
    return {f"{phase:g}°": _by_dispersion(scores, phase) for phase in PHASES[1:]}


def _all_steps(chains: Chains) -> list[str]:
    return [step for chain in chains.values() for step in _steps(chain)]


def _all_shown(chains: Chains) -> str:
    return "; ".join(f"{name} {_shown(chain)}" for name, chain in chains.items())


def _device1_rises(along: Callable[[_Scores], Chains]) -> Callable[[_Tables], Verdict]:
    """With shear, Device 1's change-of-strain score rises along these chains."""

    def check(tables: _Tables) -> Verdict:
        scores = tables.scores("device1", Interface.SHEAR, Readout.CHANGE_OF_STRAIN)
        chains = along(scores)
        return _rises(_all_steps(chains)), f"Scores [{scores.unit}]: {_all_shown(chains)}."

    return check


def _device1_strain(tables: _Tables) -> Verdict:
    """The strain score misses a step of those which the two claims above make about the change of strain."""
    scores = tables.scores("device1", Interface.SHEAR, Readout.STRAIN)
    chains = {**_along_phase(scores), **_along_dispersion(scores)}
    steps = _all_steps(chains)
    missed = {Holds.YES: Holds.NO, Holds.NO: Holds.YES, Holds.UNDECIDED: Holds.UNDECIDED}[_rises(steps)]
    return missed, f"{steps.count('<')} of {len(steps)} steps rise. Scores [{scores.unit}]: {_all_shown(chains)}."


def _held(holds: bool) -> Holds:
    return Holds.YES if holds else Holds.NO


def _all_hold(parts: Sequence[Holds]) -> Holds:
    """Whether every part of a statement holds."""
    if Holds.NO in parts:
        return Holds.NO
    return Holds.UNDECIDED if Holds.UNDECIDED in parts else Holds.YES


def _throughout(ends: Sequence[Holds]) -> Holds:
    """Whether a statement holds over a range, from whether it does at its ends."""
    return ends[0] if len(set(ends)) == 1 else Holds.UNDECIDED


def _is_less(low: float, high: float, error: float) -> Holds:
    """Whether a number is less than another, by more than an error."""
    if abs(high - low) < error:
        return Holds.UNDECIDED
    return _held(low < high - SAME * abs(high))


# --- correlations --------------------------------------------------------------------------------------------------


def _slope(row: Mapping[str, Any]) -> int:
    """Sign of the slope; 0 also where there is none, as for a constant score."""
    return 0 if pd.isna(row["slope_sign"]) else int(row["slope_sign"])


def _is_surrogate(row: Mapping[str, Any]) -> bool:
    return bool(row["rating_kind"] == RatingKind.SURROGATE.label)


def _r(row: Mapping[str, Any]) -> _Correlation:
    """Pearson's r [1]; of surrogates over all ratings with the stated order, without one over all there are. What
    errors of scores can add up to in it is taken to the first order. No slope is r = 0.
    """
    sign = _slope(row)
    if sign == 0:
        return _Correlation(0.0, 0.0, 0.0)
    error = math.inf if pd.isna(row["r_error"]) else float(row["r_error"])
    ends = [float(row["r2"])] * 2
    if _is_surrogate(row):
        ends = [0.0, 1.0] if pd.isna(row["r2_lowest"]) else [float(row["r2_lowest"]), float(row["r2_highest"])]
    weakest, strongest = (sign * math.sqrt(each) for each in ends)
    if weakest == 0.0:  # where r can vanish, it can change its sign
        weakest = -strongest
    return _Correlation(min(weakest, strongest), max(weakest, strongest), error)


def _described(row: Mapping[str, Any]) -> str:
    numbers = f"R² {row['r2']:.4g}, Kendall's tau {row['kendall_tau']:.3g}, "
    reason = f"({row['note']}) " if isinstance(row["note"], str) and row["note"] else ""
    sign = "positive" if _slope(row) > 0 else "negative"
    what = f"{sign} slope, {numbers}" if _slope(row) else f"no slope {reason}with "
    ranges = _is_surrogate(row) and not pd.isna(row["r2_lowest"])
    others = f"; R² {row['r2_lowest']:.2g} to {row['r2_highest']:.2g} over all with the stated order" if ranges else ""
    return f"{row['interface']}: {what}n {row['n']} ({row['rating_kind']}{others})"


def _correlates(
    device: str, interface: Interface, readout: Readout, sign: int = 1, more_than: float = 0.0
) -> Callable[[_Tables], Verdict]:
    """The slope has that sign, and |r| is larger than that [1]."""

    def check(tables: _Tables) -> Verdict:
        row = tables.correlation(device, interface, readout)
        r = _r(row)
        ends = [_is_less(more_than, sign * end, r.error) for end in (r.lowest, r.highest)]
        return _throughout(ends), f"{READOUT_NAME[readout]}, {_described(row)}."

    return check


def _correlates_less(device: str, interface: Interface, readout: Readout, than: float) -> Callable[[_Tables], Verdict]:
    """|r| is less than that [1], whichever way the slope is."""

    def check(tables: _Tables) -> Verdict:
        row = tables.correlation(device, interface, readout)
        r = _r(row)
        strengths = [abs(r.lowest), abs(r.highest)] if r.lowest * r.highest > 0.0 else [0.0, max(-r.lowest, r.highest)]
        ends = [_is_less(strength, than, r.error) for strength in strengths]
        return _throughout(ends), f"{READOUT_NAME[readout]}, {_described(row)}."

    return check


def _device2_weaker(tables: _Tables) -> Verdict:
    """Pearson's r is lower without shear."""
    off, on = (
        tables.correlation("device2", interface, Readout.CHANGE_OF_STRAIN)
        for interface in (Interface.FRICTIONLESS, Interface.SHEAR)
    )
    without, with_shear = _r(off), _r(on)
    error = max(without.error, with_shear.error)
    ends = [
        _is_less(low, high, error)
        for low, high in ((without.lowest, with_shear.highest), (without.highest, with_shear.lowest))
    ]
    return _throughout(ends), f"Change of strain, {_described(off)}; {_described(on)}."


# --- shear off -----------------------------------------------------------------------------------------------------


def _both(tables: _Tables, device: str) -> tuple[_Scores, _Scores]:
    """A device's change-of-strain scores without shear and with it."""
    off, on = (
        tables.scores(device, interface, Readout.CHANGE_OF_STRAIN)
        for interface in (Interface.FRICTIONLESS, Interface.SHEAR)
    )
    return off, on


def _device2_slides(tables: _Tables) -> Verdict:
    """The change of strain is smaller without shear at every phase."""
    off, on = _both(tables, "device2")
    pairs = [(off["alternate", phase], on["alternate", phase]) for phase in PHASES]
    shown = "; ".join(
        f"{phase:g}° {without.value:.4g} without shear, {with_shear.value:.4g} with it"
        for phase, (without, with_shear) in zip(PHASES, pairs, strict=True)
    )
    parts = [_is_less(low.value, high.value, max(low.error, high.error)) for low, high in pairs]
    return _all_hold(parts), f"Scores [{on.unit}]: {shown}."


def _device1_keeps(tables: _Tables) -> Verdict:
    """No step by phase or by dispersion turns when shear is left out."""
    without, with_shear = _both(tables, "device1")
    off, on = ({**_along_phase(scores), **_along_dispersion(scores)} for scores in (without, with_shear))
    pairs = zip(_all_steps(off), _all_steps(on), strict=True)
    parts = [Holds.UNDECIDED if NEAR in pair else _held(pair[0] == pair[1]) for pair in pairs]
    effect = _effect_of_shear(tables, "device1", DISPERSIONS)
    return _all_hold(parts), (
        f"{parts.count(Holds.YES)} of {len(parts)} steps stay. Leaving out shear changes the scores, relative to their"
        f" mean, on average by {effect.value:.3g}. Without shear [{without.unit}]: {_all_shown(off)}."
    )


def _device2_spread(tables: _Tables) -> Verdict:
    """Largest less smallest score over the phases is smaller without shear."""
    off, on = _both(tables, "device2")
    ordered = [sorted((s["alternate", phase] for phase in PHASES), key=lambda score: score.value) for s in (off, on)]
    without, with_shear = (scores[-1].value - scores[0].value for scores in ordered)
    error = max(score.error for scores in ordered for score in (scores[0], scores[-1]))
    return _is_less(without, with_shear, error), (
        f"Largest less smallest change-of-strain score [{on.unit}]: {without:.4g} without shear,"
        f" {with_shear:.4g} with it."
    )


def _effect_of_shear(tables: _Tables, device: str, dispersions: Sequence[str]) -> _Score:
    """Mean |score without shear - score with it| over the mean score with it [1]; change of strain."""
    off, on = _both(tables, device)
    conditions = [(dispersion, phase) for dispersion in dispersions for phase in PHASES]
    total = sum(on[c].value for c in conditions)
    if total == 0.0:
        raise _AbsentError
    effect = sum(abs(off[c].value - on[c].value) for c in conditions)
    return _Score(effect / total, sum(max(off[c].error, on[c].error) for c in conditions) / total)


def _device1_insensitive(tables: _Tables) -> Verdict:
    """The device that moves normally depends less on shear than the one that moves laterally."""
    one = _effect_of_shear(tables, "device1", DISPERSIONS)
    two = _effect_of_shear(tables, "device2", ["alternate"])
    return _is_less(one.value, two.value, max(one.error, two.error)), (
        "Leaving out shear changes the change-of-strain scores, relative to their mean, on average by"
        f" {one.value:.3g} for Device 1 and {two.value:.3g} for Device 2."
    )


_ORDER = "paper: Introduction; Results"
_RESULTS = "paper: Results"
_SHEAR = "paper: Role of shear forces in roughness perception"
_CLAIMS: tuple[_Claim, ...] = (
    _Claim("Device 2: the change of strain rises 0° < 90° < 180°.", _ORDER, _change_rises("device2", PHASES)),
    _Claim(
        "Device 3: the change of strain rises 180° < 0° < 90°.",
        "paper: Results (of Table 1); the Introduction once has 0° highest",
        _change_rises("device3", (180.0, 0.0, 90.0)),
    ),
    _Claim(
        "Device 1: the change of strain rises with phase at every dispersion.", _ORDER, _device1_rises(_along_phase)
    ),
    _Claim(
        "Device 1: the change of strain rises with dispersion at 90° and 180°.",
        _ORDER,
        _device1_rises(_along_dispersion),
    ),
    *(
        _Claim(
            f"Device {number}: the change of strain correlates very well.",
            _RESULTS,
            _correlates(f"device{number}", Interface.SHEAR, Readout.CHANGE_OF_STRAIN, more_than=VERY_STRONG),
        )
        for number in (1, 2, 3)
    ),
    _Claim(
        "Device 2: the strain correlates well.",
        _RESULTS,
        _correlates("device2", Interface.SHEAR, Readout.STRAIN, more_than=STRONG),
    ),
    _Claim(
        "Device 1: the strain correlates very poorly.",
        _RESULTS,
        _correlates_less("device1", Interface.SHEAR, Readout.STRAIN, than=WEAK),
    ),
    _Claim("Device 1: the strain misses the order of roughness.", _RESULTS, _device1_strain),
    _Claim(
        "Device 3: the strain correlates negatively.",
        _RESULTS,
        _correlates("device3", Interface.SHEAR, Readout.STRAIN, sign=-1),
    ),
    _Claim(
        "Device 2 without shear: the strain correlates negatively.",
        _SHEAR,
        _correlates("device2", Interface.FRICTIONLESS, Readout.STRAIN, sign=-1),
    ),
    _Claim(
        "Device 2 without shear: the change of strain correlates weakly.",
        _SHEAR,
        _correlates_less("device2", Interface.FRICTIONLESS, Readout.CHANGE_OF_STRAIN, than=MODERATE),
    ),
    _Claim("Device 2 without shear: the change of strain is smaller at every phase.", _SHEAR, _device2_slides),
    _Claim("Device 1: leaving out shear turns no order of the change of strain.", _SHEAR, _device1_keeps),
    _Claim(
        "Device 2 without shear: the change of strain correlates more weakly than with it.",
        _SHEAR,
        _device2_weaker,
        Kind.WEAKER,
    ),
    _Claim(
        "Device 2 without shear: the change of strain varies less with phase.", _SHEAR, _device2_spread, Kind.WEAKER
    ),
    _Claim("Device 1: leaving out shear matters less than for Device 2.", _SHEAR, _device1_insensitive, Kind.WEAKER),
)
