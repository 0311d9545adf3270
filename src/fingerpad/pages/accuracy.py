"""The page on accuracy and stability."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np
import pandas as pd

from ..calculix.case import ContactModel
from ..closedforms.comparison import ORDER_OF
from ..readouts.roughness import SCORE_KEY, SERIES
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME, PERCENT, READOUT_NAME
from .filling import digits, percent, table

AIM = 0.005  # error [1] that every score should keep; source: the project's aim
BOUND = 2.0  # times the stated error [1] within which the true one should lie
FINEST = "finer_mesh"  # case of the comparison with CalculiX that has the finest mesh, with small kinematics
# what begins the names of cases with friction from the first touch, as scores have
RUBBING = {Kinematics.SMALL: "rubbing", Kinematics.FINITE: "finite_rubbing"}
CALCULIX_COLUMNS = [
    "strain_indented",
    "pressing_indented",
    "strain_actuated",
    "force_actuated",
    "change_of_strain",
    "score_strain",
    "score_change_of_strain",
]


def accuracy_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/accuracy.md` asks for, from the tables that its rule names."""
    return (
        _of_scores(tables["scores"])
        | _of_increments(tables["increments"])
        | _of_closed_forms(tables["closed_forms"])
        | _of_calculix(tables["calculix"])
        | of_orders(tables["calculix_orders"], tables["scores"])
        | {"stress": table(tables["stress"].convert_dtypes().astype(object).fillna(""))}
    )


def _of_scores(scores: pd.DataFrame) -> dict[str, object]:
    size = scores["error"].abs()
    groups = scores.assign(size=size).groupby(SERIES, sort=False)
    largest = groups.agg(n=("size", "size"), stated=("stated", "max"), true=("size", "max")).reset_index()
    ratio = groups["error_over_stated"].max().map("{:.2f}".format).to_numpy()
    beyond = scores[size > AIM]
    return {
        "scores": len(scores),
        "within": int((scores["error_over_stated"] <= BOUND).sum()),
        "bound": f"{BOUND:g}",
        "exceeding": int((scores["error_over_stated"] > 1.0).sum()),
        "worst": f"{scores['error_over_stated'].max():.2f}",
        "times": f"{scores['times_unknowns'].min():.1f}",
        "median": f"{PERCENT * size.median():.2f} %",
        "groups": table(
            largest.assign(stated=percent(largest["stated"]), true=percent(largest["true"]), true_over_stated=ratio)
        ),
        "aim": f"{PERCENT * AIM:g} %",
        "beyond": len(beyond),
        "missed": table(beyond[SCORE_KEY].assign(stated=percent(beyond["stated"]), true=percent(beyond["error"]))),
    }


def _of_increments(increments: pd.DataFrame) -> dict[str, object]:
    return {
        "moved": increments["beyond_stated_error"].sum(),
        "increments_scores": increments.groupby("times_the_increments")["scores"].sum().max(),
        "increments_multiples": increments["times_the_increments"].nunique(),
        "increments_largest": f"{PERCENT * increments['largest_change'].max():.2f} %",
        "increments": table(
            increments.assign(
                largest_change=digits(increments["largest_change"]),
                largest_change_over_stated_error=increments["largest_change_over_stated_error"].map("{:.2f}".format),
            )
        ),
    }


def _of_closed_forms(closed_forms: pd.DataFrame) -> dict[str, object]:
    is_order = closed_forms["quantity"].str.startswith(ORDER_OF)
    held, orders = closed_forms[closed_forms["tolerance"].notna() & ~is_order], closed_forms[is_order]
    free = closed_forms[closed_forms["tolerance"].isna() & ~is_order]
    is_finest = free["spacing"] <= closed_forms.groupby("case")["spacing"].min()[free["case"]].to_numpy()
    return {
        "closed_forms": table(
            held[["case", "quantity", "unknowns"]].assign(
                error=digits(held["error"]), tolerance=digits(held["tolerance"])
            )
        ),
        "orders": table(orders[["case", "quantity"]].assign(order=orders["computed"].map("{:.2f}".format))),
        "free_finest": _worst_form(free[is_finest]),
        "free_coarser": _worst_form(free[~is_finest]),
    }


def _worst_form(rows: pd.DataFrame) -> str:
    """How many rows there are, and the largest error among them."""
    if rows.empty:
        return "none"
    worst = rows.loc[rows["error"].idxmax()]
    return f"{len(rows)}, largest error {worst['error']:.1e} ({worst['case']}: {worst['quantity']})"


def _of_calculix(calculix: pd.DataFrame) -> dict[str, object]:
    if "case" not in calculix:
        return {"calculix_verdict": str(calculix["note"].iloc[0]), "calculix": ""}
    known = calculix.reindex(columns=[*dict.fromkeys([*calculix, *CALCULIX_COLUMNS, "note"])])
    is_compared = known[CALCULIX_COLUMNS].notna().all(axis=1)
    compared = known[is_compared]
    shown = compared[["case", "against", *CALCULIX_COLUMNS]].copy()
    for column in CALCULIX_COLUMNS:
        shown[column] = percent(shown[column].astype(float))
    told = "\n\n".join([table(shown), *_left_out(known[~is_compared])])
    finest = shown[shown["case"] == FINEST].set_index("against")
    if not {ContactModel.OWN, ContactModel.TURNING} <= {*finest.index}:
        return {"calculix_verdict": f"CalculiX did not converge in the case `{FINEST}`.", "calculix": told}
    verdict = (
        f"Where CalculiX converges (`{FINEST}`: friction is switched on after pre-indentation), the two programs,"
        f" which share no code, differ by {_differences(finest.loc[ContactModel.TURNING])} if fingerpad uses"
        " CalculiX's contact law, which is soft and turns the normal with the surface. With its own, rigid and at small"
        f" strain with a fixed normal, fingerpad differs by {_differences(finest.loc[ContactModel.OWN])}."
    )
    return {"calculix_verdict": f"{_of_rubbing(compared)}\n\n{verdict}", "calculix": told}


def _left_out(rows: pd.DataFrame) -> list[str]:
    """A list of what has no numbers, and why, in which cases; nothing if there are none."""
    grouped = rows.fillna({"against": ""}).groupby(["against", "note"], sort=False)["case"].unique()
    lines = [
        f"- {against or 'CalculiX'}, {', '.join(f'`{case}`' for case in cases)}: {note}"
        for (against, note), cases in grouped.items()
    ]
    return ["Not in the table:", "\n".join(lines)] if lines else []


def of_orders(orders: pd.DataFrame, scores: pd.DataFrame) -> dict[str, object]:
    """Whether both programs order the conditions of a device alike, and by how much their scores differ, with small
    strain also over what the score's error is stated as: with finite strain decks are not pressed as scores are.

    scores: with the stated errors, relative to the score [1].
    """
    if "fingerpad" not in orders:
        return {"same_order": str(orders["note"].iloc[0]), "calculix_orders": ""}
    solved = orders[["fingerpad", "calculix"]].notna().all(axis=1)
    both, lost = orders[solved], orders[~solved].drop_duplicates(["kinematics", "device", "condition"])
    verdicts = [
        f"- {KINEMATICS_NAME[Kinematics(kinematics)]}, {READOUT_NAME[Readout(readout)].lower()}: {_alike(own)}"
        for (kinematics, readout), own in both.groupby(["kinematics", "readout"], sort=False)
    ]
    verdicts += [
        f"- {KINEMATICS_NAME[Kinematics(row.kinematics)]}, {row.device}, {row.condition} is left out: {row.note}"
        for row in lost.itertuples()
    ]
    case = ["kinematics", "device", "condition", "readout"]
    known = scores[(scores["interface"] == Interface.SHEAR) & (scores["kinematics"] == Kinematics.SMALL)]
    stated = both[case].merge(known[[*case, "stated"]], on=case, how="left")["stated"].to_numpy()
    apart = both["fingerpad"] / both["calculix"] - 1.0
    over = (apart.abs() / stated).map("{:.1f}".format, na_action="ignore").fillna("")
    shown = both[[*case, "fingerpad", "calculix"]].astype(str).assign(difference=percent(apart), over_stated=over)
    return {"same_order": "\n".join(verdicts), "calculix_orders": table(shown)}


def _alike(scores: pd.DataFrame) -> str:
    """How many pairs of conditions of one device have the same order in both programs."""
    same = pairs = 0
    for _, own in scores.groupby("device"):
        for one, two in combinations(own[["fingerpad", "calculix"]].to_numpy(), 2):
            pairs += 1
            same += bool(np.all(one < two) or np.all(one > two))
    return f"{same} of {pairs} pairs of conditions of a device are in the same order"


def _of_rubbing(compared: pd.DataFrame) -> str:
    """How far the programs differ where friction acts from the first touch, and CalculiX from itself, in words."""
    found = " ".join(_of_rubbing_with(kinematics, compared) for kinematics in Kinematics)
    return (
        "For one condition, Device 2 at 180°, with friction from the first touch, **as shipped scores have it**,"
        " CalculiX has not converged: it moves with its own increments and mesh, so it cannot tell which of the two is"
        f" nearer. {found}"
    )


def _of_rubbing_with(kinematics: Kinematics, compared: pd.DataFrame) -> str:
    """The same with one kinematics, in a sentence."""
    name = RUBBING[kinematics]
    rows = compared[compared["case"].str.startswith(name)]
    own, itself = rows[rows["against"] == ContactModel.OWN], rows[rows["against"] == f"CalculiX in {name}"]
    if own.empty or itself.empty:
        return f"With {kinematics} strain (`{name}`) it found no solution."
    return (
        f"With {kinematics} strain (`{name}` and what follows it) fingerpad differs by"
        f" {_range(own, 'strain_actuated')} in strain, {_range(own, 'change_of_strain')} in the change of strain and"
        f" {_range(own, 'score_change_of_strain')} in its score, and CalculiX with another mesh or other increments"
        f" from itself by {_range(itself, 'change_of_strain')} in the change of strain."
    )


def _range(rows: pd.DataFrame, column: str) -> str:
    """Least and most of a column of differences [1], in per cent."""
    values = PERCENT * rows[column].astype(float)
    return f"{values.min():.1f} to {values.max():.1f} %"


def _differences(row: pd.Series) -> str:
    """Differences of a row of the comparison with CalculiX, in words."""
    strain, force, change = row["strain_actuated"], row["force_actuated"], row["change_of_strain"]
    return f"{strain} in strain, {force} in forces and {change} in the change of strain"
