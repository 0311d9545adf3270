"""The page of other scorings: filter, sign, area, pre-indented state, the drive alone, friction, phases between."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import pandas as pd

from ..perception.wording import published_text, slope_name
from ..readouts.comparison import Relation, Score, relation
from ..readouts.roughness import SCORE_KEY
from ..readouts.scorings import DRIVES, Scoring
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..words import KILO, PERCENT, SCORE_SCALE
from .filling import table

# What the paper states of the order of change-of-strain scores, by the start of the claim
ORDERS = {
    "Device 1: the change of strain rises with phase": "device 1 by phase",
    "Device 1: the change of strain rises with dispersion": "device 1 by dispersion",
    "Device 2: the change of strain rises": "device 2",
    "Device 3: the change of strain rises": "device 3",
}


def scorings_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/scorings.md` asks for. tables: scores as configured; others, correlations and claims, of
    `perception.scorings`; response of the filters; phases, of `prediction.phases.phase_rows`; frictions, of
    `prediction.frictions.friction_rows`.
    """
    correlations = tables["correlations"][tables["correlations"]["interface"] == Interface.SHEAR]
    orders = _orders(tables["claims"])
    change = correlations[correlations["readout"] == Readout.CHANGE_OF_STRAIN]
    drives = {str(each) for each in DRIVES}
    return {
        "drives": table(_of_drives(_joined(orders, change, drives))),
        "change": table(_joined(orders, change, {str(each) for each in Scoring} - drives)),
        "strain": table(_strengths(correlations[correlations["readout"] == Readout.STRAIN]).reset_index()),
        "published": _published(correlations),
        "indented": _indented(tables["scores"], tables["others"]),
        "response": table(_response(tables["response"])),
        "phases": table(_phases(tables["phases"])),
        "frictions": "(No device is predicted without friction.)"
        if (frictions := tables["frictions"]).empty
        else table(_frictions(frictions)),
    }


def _orders(claims: pd.DataFrame) -> pd.DataFrame:
    """Verdicts on the stated orders, one column for each, by scoring and kinematics."""
    named = claims.assign(order=claims["claim"].map(_order_of)).dropna(subset="order")
    wide = named.pivot_table("holds", ["scoring", "kinematics"], "order", aggfunc="first", sort=False)
    return wide.reindex(columns=[name for name in ORDERS.values() if name in wide]).fillna("")


def _order_of(claim: str) -> str | None:
    """Which of the stated orders a claim is about, if any."""
    return next((name for start, name in ORDERS.items() if claim.startswith(start)), None)


def _strengths(correlations: pd.DataFrame) -> pd.DataFrame:
    """R² and slope of every device, one column for each, by scoring and kinematics; empty where all scores are one."""
    known = correlations.dropna(subset="r2")
    shown = known.assign(told=[f"{row['r2']:.3f}, {slope_name(row)}" for row in known.to_dict("records")])
    wide = shown.pivot_table("told", ["scoring", "kinematics"], "device", aggfunc="first", sort=False).fillna("")
    return wide.rename(columns=lambda device: f"R² {device}")


def _joined(orders: pd.DataFrame, correlations: pd.DataFrame, chosen: Collection[str]) -> pd.DataFrame:
    """Verdicts and correlations of the chosen scorings side by side."""
    rows = orders.join(_strengths(correlations)).fillna("").reset_index()
    return rows[rows["scoring"].isin(chosen)]


def _of_drives(rows: pd.DataFrame) -> pd.DataFrame:
    """One row for each scoring of the drive, which knows no kinematics."""
    return rows.drop(columns="kinematics").drop_duplicates("scoring")


def _published(correlations: pd.DataFrame) -> str:
    """What the paper says of the strain of each device, in words."""
    strain = correlations[correlations["readout"] == Readout.STRAIN].drop_duplicates("device")
    told = {row["device"]: published_text(row) for row in strain.to_dict("records")}
    return "; ".join(f"{device} {text}" for device, text in told.items() if text)


def _indented(scores: pd.DataFrame, others: pd.DataFrame) -> str:
    """By how much stimuli move the strain score of the pre-indented state with shear: least and most, by kinematics."""
    is_shown = (others["scoring"] == Scoring.INDENTED) & (others["interface"] == Interface.SHEAR)
    alone = others[is_shown][[*SCORE_KEY, "score"]]
    both = alone.merge(scores[[*SCORE_KEY, "score"]], on=SCORE_KEY, suffixes=("_alone", ""))
    moved = PERCENT * (both["score"] / both["score_alone"] - 1.0)
    ranges = moved.groupby(both["kinematics"], sort=False).agg(["min", "max"])
    return " and ".join(
        f"{row['min']:+.1f} to {row['max']:+.1f} % with {name} kinematics" for name, row in ranges.iterrows()
    )


def _response(response: pd.DataFrame) -> pd.DataFrame:
    """What both filters leave of each length of each device."""
    wide = response.assign(left=[f"{PERCENT * value:.2g} %" for value in response["response"]]).pivot_table(
        "left", ["device", "length", "period"], "readout", aggfunc="first", sort=False
    )
    rows = wide.reset_index().rename(
        columns={"period": "mm", "strain": "SA-1 filter", "change_of_strain": "RA-1 filter"}
    )
    return rows.assign(mm=rows["mm"].map("{:g}".format).replace("inf", "∞"))


def _frictions(frictions: pd.DataFrame) -> pd.DataFrame:
    """The change of strain of every condition, one column for each coefficient of friction."""
    scale = SCORE_SCALE[Readout.CHANGE_OF_STRAIN][0]
    change = frictions[frictions["readout"] == Readout.CHANGE_OF_STRAIN]
    told = change.assign(told=(scale * change["score"]).map("{:.2f}".format))
    wide = told.pivot_table("told", ["device", "condition"], "friction", aggfunc="first", sort=False).fillna("")
    return wide.rename(columns="{:g}".format).reset_index()


def _phases(phases: pd.DataFrame) -> pd.DataFrame:
    """Per device and dispersion with a prediction at 0°: at which phase the change of strain is lowest, whether it is
    lower there than at 0° by more than both errors, what both motions of the drive do on the way, and whether the
    change of strain rises in every step from there.
    """
    scale = SCORE_SCALE[Readout.CHANGE_OF_STRAIN][0]
    rows = []
    change = phases[phases["readout"] == Readout.CHANGE_OF_STRAIN].dropna(subset="score")
    for (kinematics, device, dispersion), own in change.groupby(["kinematics", "device", "dispersion"], sort=False):
        ordered = own.sort_values("phase_deg").fillna({"score_error": math.inf})
        if ordered["phase_deg"].iloc[0] > 0.0:
            continue
        known = [
            Score(scale * value, scale * error)
            for value, error in zip(ordered["score"], ordered["score_error"], strict=True)
        ]
        lowest = int(ordered["score"].argmin())
        steps = ordered["score"].diff().iloc[lowest + 1 :]
        falls = relation(known[lowest], known[0]) is Relation.LESS
        rows.append(
            {
                "kinematics": kinematics,
                "device": device,
                "dispersion": dispersion,
                "at 0°": f"{known[0].value:.3f}",
                "lowest": f"{known[lowest].value:.3f} at {ordered['phase_deg'].iloc[lowest]:g}°",
                "falls first": "yes" if falls else "within errors" if lowest else "no",
                "drive, µm": " to ".join(
                    f"{KILO * ordered['motion_mm'].iloc[at]:.1f}" for at in dict.fromkeys((0, lowest))
                ),
                "then rises throughout": "yes" if (steps > 0.0).all() else "no",
            }
        )
    return pd.DataFrame(rows)
