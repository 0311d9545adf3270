"""An ensemble over assumptions: scores of every member, and which of the paper's statements then hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from ..perception.evaluation import evaluate
from ..perception.ratings import Literature
from ..prediction.edges import edge_intervals
from ..prediction.scoring import solved_rows
from ..readouts.accuracy import error_in_proportion
from ..readouts.roughness import SERIES, unpredicted_rows
from ..scene.scene import Scene, with_all_kinematics
from ..scene.tissue_law import Kinematics
from .alternatives import AS_CONFIGURED, Alternative

MEMBER = ["kinematics", "half_cycle", "varied"]  # columns that tell members apart


@dataclass(frozen=True)
class EnsembleTables:
    """Claims, correlations and scores of every member, in the columns of their tables behind MEMBER."""

    claims: pd.DataFrame
    correlations: pd.DataFrame
    scores: pd.DataFrame


def member_scores(
    scenes: Sequence[Scene], kinematics: Kinematics, alternative: Alternative | None, half_cycle: str
) -> list[dict[str, Any]]:
    """Rows of the score table of a member behind MEMBER; what cannot be solved has none, and its note says why."""
    rows: list[dict[str, Any]] = []
    for scene in (each for each in with_all_kinematics(scenes) if each.kinematics == kinematics):
        rows += solved_rows(scene, edge_intervals(scene))[0]
        rows += unpredicted_rows(scene)
    varied = alternative.name if alternative else AS_CONFIGURED
    return [{"half_cycle": half_cycle, "varied": varied} | row for row in rows]


def ensemble_tables(members: pd.DataFrame, configured: pd.DataFrame, literature: Literature) -> EnsembleTables:
    """What becomes of claims, correlations and scores in every member.

    members: rows of the score table of all members behind MEMBER; devices that a member leaves as they are have rows as
    configured alone. configured: the score table with errors, which members' scores have too, in proportion to the
    score (`error_in_proportion`).
    Raises RatingError as `correlation_table`.
    """
    usual = configured[[*SERIES, "condition", "score", "score_error"]]
    scored = members.merge(usual, on=[*SERIES, "condition"], how="left", suffixes=("", "_usual"))
    scored["score_error"] = [
        error_in_proportion(*each)
        for each in zip(scored["score"], scored["score_usual"], scored["score_error"], strict=True)
    ]
    found = evaluate(_with_all_devices(scored), MEMBER, literature)
    scores = scored[[*MEMBER, *configured.columns.difference(MEMBER, sort=False)]]
    return EnsembleTables(found.claims, found.correlations, scores)


def _with_all_devices(members: pd.DataFrame) -> pd.DataFrame:
    """The rows of every member, and of devices that it leaves as they are those as configured."""
    found: list[pd.DataFrame] = []
    for _, group in members.groupby(MEMBER[:2], sort=False):
        usual = group[group["varied"] == AS_CONFIGURED]
        for varied, own in group.groupby("varied", sort=False):
            found += [own, usual[~usual["device"].isin(own["device"])].assign(varied=varied)]
    return pd.concat(found)
