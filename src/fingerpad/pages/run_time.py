"""The page on run time."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from ..benchmark.ladders import CALCULIX_LADDER, COMPARED_AT, OWN_LADDER
from ..words import PERCENT
from .filling import percent, table


def run_time_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/run-time.md` asks for, from the tables that its rule names."""
    return _of_graph(tables["graph"]) | _of_timings(tables["timings"], tables["ladder"], tables["exponents"])


def _of_graph(graph: pd.DataFrame) -> dict[str, object]:
    kinematics = graph.groupby("kinematics", sort=False)
    median = kinematics[["real_s", "empty_s", "ratio", "again_s"]].median().map("{:.1f}".format)
    real = graph.pivot(index="repeat", columns="kinematics", values="real_s")
    return {
        "graph": table(median.reset_index().set_axis(["kinematics", "all", "empty scripts", "ratio", "again"], axis=1)),
        "graph_both": f"{(real['both'] / real['small']).median():.1f}",
        "graph_cores": graph["cores"].iloc[0],
        "graph_n": len(real),
    }


def _of_timings(timings: pd.DataFrame, ladder: pd.DataFrame, exponents: pd.DataFrame) -> dict[str, object]:
    error = ladder[["error_strain", "error_change_of_strain"]].max(axis=1)
    rungs = ladder[["kinematics", "solver", "coarsening", "unknowns"]].assign(
        error=percent(error),
        **{name: ladder[name].map("{:.3g}".format) for name in ("cold_s", "warm_s", "stimulus_s")},
    )
    names = {"cold_s": "scene to score", "warm_s": "further condition", "stimulus_s": "further stimulus"}
    return {
        "timings": table(timings[["kinematics", "device", "step", "n", "median_s", "lowest_s", "highest_s"]]),
        "ladder": table(rungs.rename(columns=names)),
        "compared": f"{_missing(ladder)}{_compared(ladder, error)}",
        "exponents": table(exponents),
    }


def _missing(ladder: pd.DataFrame) -> str:
    """For which kinematics CalculiX has no rows, in words; nothing if it has some for all."""
    climbed = {*ladder.loc[ladder["solver"] == CALCULIX_LADDER, "kinematics"]}
    without = " and ".join(each for each in ladder["kinematics"].unique() if each not in climbed)
    return f"CalculiX has no rows for {without} kinematics: it was not installed, or failed.\n\n" if without else ""


def _compared(ladder: pd.DataFrame, error: pd.Series) -> str:
    """How much longer the others take, each on its cheapest mesh from which on errors are at most COMPARED_AT, beside
    fingerpad with the same kinematics: a coarse mesh that is right by chance does not count.
    """
    climbed = ["kinematics", "solver"]
    finest_first = ladder.assign(error=error).sort_values("unknowns", ascending=False)
    good = finest_first[finest_first.groupby(climbed)["error"].cummax() <= COMPARED_AT]
    cheapest = good.loc[good.groupby(climbed)["cold_s"].idxmin()].sort_index()
    rows = [
        row
        for kinematics, solvers in cheapest.groupby("kinematics", sort=False)
        for row in _ratios(kinematics, solvers)
    ]
    if not rows:
        return f"No other solver reached an error of {PERCENT * COMPARED_AT:g} %."
    return (
        "Times as long as fingerpad, each on its cheapest mesh from which on errors are at most"
        f" {PERCENT * COMPARED_AT:g} %:\n\n{table(pd.DataFrame(rows))}"
    )


def _ratios(kinematics: object, cheapest: pd.DataFrame) -> list[dict[str, object]]:
    """A row for every other solver, if fingerpad is among them."""
    solvers = cheapest.set_index("solver")
    if OWN_LADDER not in solvers.index:
        return []
    own = solvers.loc[OWN_LADDER]
    return [
        {
            "kinematics": kinematics,
            "solver": solver,
            "scene_to_score": f"{other['cold_s'] / own['cold_s']:.0f}",
            "further_condition": f"{other['warm_s'] / own['warm_s']:.0f}",
            "further_stimulus": f"{other['stimulus_s'] / own['stimulus_s']:.0f}",
        }
        for solver, other in solvers.drop(OWN_LADDER).iterrows()
    ]
