"""The page of vibrations: scores at each frequency, and what they depend on."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import pandas as pd
from scipy.stats import kendalltau

from ..readouts.comparison import classes
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..vibration.speed import SLOWLY, frequency_name
from ..words import PERCENT, SCORE_SCALE
from .filling import percent, table


def frequency_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/frequency.md` asks for. tables: frequencies, of all devices; variants, under other
    assumptions; scores, those of the same conditions as snapshots.
    """
    frequencies, variants, quasistatic = (tables[name] for name in ("frequencies", "variants", "scores"))
    shear = frequencies[frequencies["interface"] == Interface.SHEAR]
    change = shear[shear["readout"] == Readout.CHANGE_OF_STRAIN]
    scores = _wide(change, "frequency_hz")
    scores = scores.reindex(columns=sorted(scores.columns))
    shown = (SCORE_SCALE[Readout.CHANGE_OF_STRAIN][0] * scores).map("{:.3f}".format).replace("nan", "")
    shown.columns = pd.Index([frequency_name(each) for each in shown.columns])
    worst = shear.groupby(["device", "frequency_hz"], sort=False)["inertia"].max()
    missing = change[change["score"].isna()].groupby(["device", "frequency_hz"]).size()
    inertia = worst.rename("inertia").to_frame().assign(without_prediction=missing).reset_index()
    inertia = inertia[inertia["frequency_hz"] > SLOWLY]
    stated = _stated(quasistatic, set(frequencies["device"]))
    return {
        "scores": table(shown.reset_index()),
        "spread": _spread(scores[scores.columns[scores.columns > SLOWLY]]),
        "spread_with_slow": _spread(scores),
        "orders": table(_orders(scores)),
        "varied_at": f"{variants['frequency_hz'].iloc[0]:g}",
        "variants": table(_varied(variants)),
        "discretisation": f"{PERCENT * stated.min():.1f} to {PERCENT * stated.max():.1f} %",
        "inertia": table(
            inertia.assign(
                frequency_hz=inertia["frequency_hz"].map("{:g}".format),
                inertia=percent(inertia["inertia"]),
                without_prediction=inertia["without_prediction"].fillna(0).astype(int),
            )
        ),
        "device1": _of_device1(change[change["device"] == "device1"], stated),
    }


def _wide(change: pd.DataFrame, column: str) -> pd.DataFrame:
    """Scores by device and condition in their order, one column for each value of a column; empty without a score."""
    scores = change.set_index(["device", "condition", column])["score"].unstack(column)
    cases = pd.MultiIndex.from_frame(change[["device", "condition"]].drop_duplicates())
    return scores.reindex(index=cases, columns=change[column].drop_duplicates())


def _spread(scores: pd.DataFrame) -> str:
    """By how much the highest score of a condition exceeds its lowest: least and most of all conditions."""
    spread = PERCENT * (scores.max(axis=1) / scores.min(axis=1) - 1.0)
    return f"{spread.min():.0f} to {spread.max():.0f} %"


def _stated(quasistatic: pd.DataFrame, devices: set[str]) -> pd.Series:
    """Stated errors of the same conditions' quasi-static scores, relative [1], by device and condition."""
    alike = quasistatic[
        (quasistatic["kinematics"] == Kinematics.SMALL)
        & quasistatic["device"].isin(devices)
        & (quasistatic["interface"] == Interface.SHEAR)
        & (quasistatic["readout"] == Readout.CHANGE_OF_STRAIN)
    ]
    by_condition = alike.set_index(["device", "condition"])
    return by_condition["score_error"] / by_condition["score"]


def _of_device1(change: pd.DataFrame, stated: pd.Series) -> str:
    """Whether Device 1's scores rise with phase at the highest frequency, and where they do not with dispersion; if it
    is there.
    """
    if change.empty:
        return ""
    asked, predicted = change["frequency_hz"].max(), change.dropna(subset="score")["frequency_hz"].max()
    dispersions = change[change["frequency_hz"] == predicted].groupby("dispersion", sort=False)
    rising = [group.sort_values("phase_deg")["score"].is_monotonic_increasing for _, group in dispersions]
    highest = "the highest in its device file" if predicted == asked else "the highest with a prediction"
    return (
        "Of Device 1, Grigorii et al. (2022) say that perceived roughness depends on the spatial variation of"
        f" indentation also at 80 Hz. Here the change-of-strain score of Device 1 at {predicted:g} Hz, {highest}, rises"
        f" with phase at {sum(rising)} of {len(rising)} dispersions. With dispersion, counting only differences larger"
        f" than the errors stated below, it {_falls(change[change['frequency_hz'] > SLOWLY], stated)}. "
    )


def _falls(change: pd.DataFrame, stated: pd.Series) -> str:
    """Where a device's score is lower at a wider dispersion, which stands later in the table, by more than the stated
    errors of both, relative.
    """
    found = []
    for phase, alike in change.groupby("phase_deg"):
        scores = alike.pivot_table("score", "dispersion", "frequency_hz", sort=False)
        scores = scores.reindex(columns=sorted(scores.columns))
        error = {row.dispersion: stated[row.device, row.condition] for row in alike.itertuples()}
        for lower, higher in pairwise(scores.index):
            below = scores.loc[higher] * (1.0 + error[higher]) < scores.loc[lower] * (1.0 - error[lower])
            at = scores.columns[below]
            if len(at):
                hertz = ", ".join(f"{each:g}" for each in at)
                found.append(f"at {phase:g}° `{higher}` lies below `{lower}` at {hertz} Hz")
    return f"does not always rise: {'; '.join(found)}" if found else "rises at every phase and frequency"


def _orders(scores: pd.DataFrame) -> pd.DataFrame:
    """Per device and frequency whether conditions come in the order of slow cycles: Kendall's tau, and how many there
    are.
    """
    slow = scores.columns[0]
    rows = []
    for device, own in scores.groupby(level="device", sort=False):
        for frequency in scores.columns[1:]:
            both = own[[slow, frequency]].dropna()
            if len(both) > 1:
                tau = _tau(both[slow], both[frequency])
                rows.append(
                    {"device": device, "at": frequency_name(frequency), "conditions": len(both), "tau": f"{tau:.2f}"}
                )
    return pd.DataFrame(rows)


def _tau(one: pd.Series, other: pd.Series) -> float:
    """Kendall's tau of scores of the same conditions, of which some may be one."""
    return float(kendalltau(*(classes(each.to_numpy()) for each in (one, other))).statistic)


def _varied(variants: pd.DataFrame) -> pd.DataFrame:
    """Per device and assumption how far scores of the change of strain move, and whether their order stays."""
    change = variants[variants["readout"] == Readout.CHANGE_OF_STRAIN]
    scores = _wide(change, "assumption")
    shipped, *others = variants["assumption"].drop_duplicates()
    rows = []
    for device, own in scores.groupby(level="device", sort=False):
        for other in others:
            both = own[[shipped, other]].dropna()
            moved = PERCENT * (both[other] / both[shipped] - 1.0)
            told = f"{moved.min():+.0f} to {moved.max():+.0f} %" if len(both) else "no prediction"
            tau = f"{_tau(both[shipped], both[other]):.2f}" if len(both) > 1 else ""
            rows.append({"device": device, "assumption": other, "change": told, "tau": tau})
    return pd.DataFrame(rows)
