"""The page of what depends on which assumption: tables of the ensemble's claims and correlations."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from ..ensemble.alternatives import AS_CONFIGURED, FIRST, HALF_CYCLES, SECOND, by_key
from ..ensemble.effect import with_effect
from ..perception.statements import Kind
from ..perception.verdicts import Holds
from ..perception.wording import published_text, slope_name
from ..readouts.roughness import NO_PREDICTION, SERIES
from ..scene.contact_law import Interface
from ..scene.tissue_law import Kinematics
from ..words import MODE_ENDING
from .filling import table

NOTHING = ""
SHOWN = {  # by a figure
    Kinematics.SMALL: "A mark for every statement, member and half-cycle, with small strain",
    Kinematics.FINITE: "The same with finite strain",
}
TOLD = ["claim", "kind"]


def robustness_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/robustness.md` asks for. tables: claims, correlations and scores, of
    `members.ensemble_tables`.
    """
    claims, correlations, scores = tables["claims"], tables["correlations"], tables["scores"]
    members = claims["varied"].nunique()
    kinematics = list(claims["kinematics"].unique())
    return {
        "members": members,
        "always": _always(claims),
        "statements": "\n\n".join(
            f"With {each} kinematics:\n\n{table(_statements(claims[claims['kinematics'] == each]))}"
            for each in kinematics
        ),
        "correlations": table(_correlations(correlations)),
        "halves": table(_halves(scores)),
        "unsolved": _unsolved(scores),
        "figures": "\n\n".join(
            f"![{SHOWN[each]}](figures/ensemble{MODE_ENDING[Kinematics(each)]}.png)" for each in kinematics
        ),
    }


def _always(claims: pd.DataFrame) -> str:
    """Statements that hold in every member and half-cycle, whatever the kinematics, as a list."""
    held = claims.groupby(TOLD, sort=False)["holds"].agg(lambda column: (column == Holds.YES).all())
    return "\n".join(f"- {_told(*each)}" for each in held[held].index)


def _told(claim: str, kind: str) -> str:
    """A statement, with a mark where the paper's is stronger."""
    return claim if kind == Kind.STATED else f"{claim} *({kind})*"


def _statements(claims: pd.DataFrame) -> pd.DataFrame:
    """One row per statement: in how many members it holds, and which change its verdict, by half-cycle."""
    rows = []
    for (claim, kind), own in claims.groupby(TOLD, sort=False):
        row: dict[str, object] = {"statement": _told(claim, kind)}
        for half_cycle in HALF_CYCLES:
            found = with_effect(own[own["half_cycle"] == half_cycle], "evidence").set_index("varied")["holds"]
            usual = found.get(AS_CONFIGURED, NOTHING)
            row[half_cycle] = f"{usual}, {(found == Holds.YES).sum()} of {found.size}"
            row[f"changed in {half_cycle} by"] = by_key(found[found != usual].index)
        rows.append(row)
    return pd.DataFrame(rows)


def _correlations(correlations: pd.DataFrame) -> pd.DataFrame:
    """Signed R² of each device and read-out with shear: published, as configured in each half-cycle, and in how many
    members of both the slope rises, whether or not errors of scores leave its sign open.
    """
    shear = correlations[(correlations["interface"] == Interface.SHEAR) & correlations["r2"].notna()]
    rows = []
    for key, own in shear.groupby(SERIES, sort=False):
        row = dict(zip(SERIES, key, strict=True))
        del row["interface"]
        published = published_text(own.iloc[0])
        usual = own[own["varied"] == AS_CONFIGURED].set_index("half_cycle")
        halves = {each: f"{usual.loc[each, 'r2']:.3g}, {slope_name(usual.loc[each])}" for each in HALF_CYCLES}
        different = pd.concat([with_effect(own[own["half_cycle"] == each], "r2", "slope_sign") for each in HALF_CYCLES])
        rising = int((different["slope_sign"] > 0).sum())
        rows.append(row | {"published": published} | halves | {"rising in": f"{rising} of {len(different)}"})
    return pd.DataFrame(rows)


def _halves(scores: pd.DataFrame) -> pd.DataFrame:
    """Scores with shear in the second half-cycle over those in the first, as configured: a row for each kinematics,
    device and read-out, with the conditions that have the least and the most.
    """
    is_shown = (scores["varied"] == AS_CONFIGURED) & (scores["interface"] == Interface.SHEAR) & (scores["score"] > 0.0)
    wide = scores[is_shown].pivot_table("score", [*SERIES, "condition"], "half_cycle", sort=False)
    wide = wide.reindex(columns=list(HALF_CYCLES))
    ratios = (wide[SECOND] / wide[FIRST]).dropna()
    rows = []
    for key, own in ratios.groupby(SERIES, sort=False):
        row = dict(zip(SERIES, key, strict=True))
        del row["interface"]
        ends = {"least": own.idxmin(), "most": own.idxmax()}
        rows.append(row | {name: f"{own[case]:.2f} (`{case[-1]}`)" for name, case in ends.items()})
    return pd.DataFrame(rows)


def _unsolved(scores: pd.DataFrame) -> str:
    """Members in which what is predicted as configured has no solution, and why, as a list."""
    usual = scores[(scores["varied"] == AS_CONFIGURED) & scores["score"].notna()]
    case = [*SERIES, "condition", "half_cycle"]
    is_lost = scores["score"].isna() & pd.MultiIndex.from_frame(scores[case]).isin(
        pd.MultiIndex.from_frame(usual[case])
    )
    lost = scores[is_lost].drop_duplicates(["kinematics", "varied", "device", "interface", "note"])
    told = [
        f"- `{row['varied']}`, {row['kinematics']} kinematics: {str(row['note']).removeprefix(f'{NO_PREDICTION}: ')}"
        for row in lost.to_dict("records")
    ]
    return "\n".join(dict.fromkeys(told)) or "None."
