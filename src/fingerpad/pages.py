"""Pages of docs/ that say what was measured: prose from a template, every number from a table of results."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from string import Template

import pandas as pd

from . import markdown
from .benchmark.ladder import COMPARED_AT, OWN_LADDER
from .closedforms.comparison import ORDER_OF
from .contact_law import Interface
from .readout import Readout
from .tissue_law import Kinematics

AIM = 0.005  # error [1] that every score should keep; source: the project's aim
BOUND = 2.0  # times the stated error [1] within which the true one should lie
PERCENT = 100.0
GROUP = ["kinematics", "device", "interface", "readout"]
CALCULIX_COLUMNS = [
    "strain_indented",
    "pressing_indented",
    "strain_actuated",
    "force_actuated",
    "change_of_strain",
    "score_strain",
    "score_change_of_strain",
]


def filled(template: str, values: Mapping[str, object]) -> str:
    """A template whose every ${name} is replaced. Raises KeyError if a value is missing."""
    return Template(template).substitute(values)


def table(rows: pd.DataFrame) -> str:
    """A Markdown table of a frame, its columns with spaces for underscores.

    >>> print(table(pd.DataFrame({"a_b": [1], "c": ["x"]})))
    | a b | c |
    |---|---|
    | 1 | x |
    """
    heads = [str(column).replace("_", " ") for column in rows.columns]
    return markdown.table(heads, rows.itertuples(index=False))


def accuracy_values(tables: Mapping[str, pd.DataFrame]) -> dict[str, object]:
    """What `workflow/pages/accuracy.md` asks for, from the tables that its rule names."""
    return (
        _of_scores(tables["scores"])
        | _of_increments(tables["increments"])
        | _of_closed_forms(tables["closed_forms"])
        | {"calculix": _of_calculix(tables["calculix"])}
        | {"stress": table(tables["stress"].convert_dtypes().astype(object).fillna(""))}
        | _of_graph(tables["graph"])
        | _of_run_time(tables["timings"], tables["ladder"], tables["exponents"])
    )


def skipping_values(switches: pd.DataFrame, always: pd.DataFrame) -> dict[str, object]:
    """What `workflow/pages/skipping.md` asks for."""
    names = {"setup_ratio": "set-up", "conditions_ratio": "all conditions", "total_ratio": "both"}
    shown = switches.rename(columns=names)
    for column in ("largest_difference", "smallest_stated_error"):
        shown[column] = _digits(shown[column])
    return {"switches": table(shown), "always": table(always)}


def _percent(values: pd.Series) -> pd.Series:
    return (PERCENT * values).map("{:.2f} %".format)


def _digits(values: pd.Series) -> pd.Series:
    return values.map("{:.1e}".format)


def _of_scores(scores: pd.DataFrame) -> dict[str, object]:
    size = scores["error"].abs()
    groups = scores.assign(size=size).groupby(GROUP, sort=False)
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
            largest.assign(stated=_percent(largest["stated"]), true=_percent(largest["true"]), true_over_stated=ratio)
        ),
        "aim": f"{PERCENT * AIM:g} %",
        "beyond": len(beyond),
        "missed": table(
            beyond[["kinematics", "device", "condition", "interface", "readout"]].assign(
                stated=_percent(beyond["stated"]), true=_percent(beyond["error"])
            )
        ),
    }


def _of_increments(increments: pd.DataFrame) -> dict[str, object]:
    return {
        "moved": increments["beyond_stated_error"].sum(),
        "increments_scores": increments["scores"].sum(),
        "increments_largest": f"{PERCENT * increments['largest_change'].max():.2f} %",
        "increments": table(increments.assign(largest_change=_digits(increments["largest_change"]))),
    }


def _of_closed_forms(closed_forms: pd.DataFrame) -> dict[str, object]:
    is_order = closed_forms["quantity"].str.startswith(ORDER_OF)
    held, orders = closed_forms[closed_forms["tolerance"].notna() & ~is_order], closed_forms[is_order]
    free = closed_forms[closed_forms["tolerance"].isna() & ~is_order]
    is_finest = free["spacing"] <= closed_forms.groupby("case")["spacing"].min()[free["case"]].to_numpy()
    return {
        "closed_forms": table(
            held[["case", "quantity", "unknowns"]].assign(
                error=_digits(held["error"]), tolerance=_digits(held["tolerance"])
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


def _of_calculix(calculix: pd.DataFrame) -> str:
    if "case" not in calculix:
        return str(calculix["note"].iloc[0])
    compared = calculix.dropna(subset=CALCULIX_COLUMNS)
    shown = compared[["case", "against", *CALCULIX_COLUMNS]].copy()
    for column in CALCULIX_COLUMNS:
        shown[column] = _percent(shown[column].astype(float))
    return table(shown)


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


def _of_run_time(timings: pd.DataFrame, ladder: pd.DataFrame, exponents: pd.DataFrame) -> dict[str, object]:
    error = ladder[["error_strain", "error_change_of_strain"]].max(axis=1)
    rungs = ladder[["kinematics", "solver", "coarsening", "unknowns"]].assign(
        error=_percent(error),
        **{name: ladder[name].map("{:.3g}".format) for name in ("cold_s", "warm_s", "stimulus_s")},
    )
    names = {"cold_s": "scene to score", "warm_s": "further condition", "stimulus_s": "further stimulus"}
    return {
        "timings": table(timings[["kinematics", "device", "step", "n", "median_s", "lowest_s", "highest_s"]]),
        "ladder": table(rungs.rename(columns=names)),
        "compared": _compared(ladder, error),
        "exponents": table(exponents),
    }


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


def frequency_values(frequencies: pd.DataFrame, variants: pd.DataFrame, quasistatic: pd.DataFrame) -> dict[str, object]:
    """What `workflow/pages/frequency.md` asks for: frequency.csv, frequency_variants.csv, scores.csv in results/."""
    shear = frequencies[frequencies["interface"] == Interface.SHEAR]
    change = shear[shear["readout"] == Readout.CHANGE_OF_STRAIN]
    scores = change.pivot_table("score", ["device", "condition"], "frequency_hz", sort=False)
    scores = scores.reindex(columns=sorted(scores.columns))
    shown = (1e3 * scores).map("{:.3f}".format).replace("nan", "")
    shown.columns = pd.Index([_frequency(each) for each in shown.columns])
    worst = shear.groupby(["device", "frequency_hz"], sort=False)["inertia"].max()
    refused = change[change["score"].isna()].groupby(["device", "frequency_hz"]).size()
    inertia = worst.rename("inertia").to_frame().assign(refused=refused).fillna({"refused": 0}).reset_index()
    inertia = inertia[inertia["frequency_hz"] > 0.0]
    return {
        "scores": table(shown.reset_index()),
        "spread": _spread(scores[scores.columns[scores.columns > 0.0]]),
        "spread_with_slow": _spread(scores),
        "orders": table(_orders(scores)),
        "varied_at": f"{variants['frequency_hz'].iloc[0]:g}",
        "variants": table(_varied(variants)),
        "discretisation": _discretisation(quasistatic, set(frequencies["device"])),
        "inertia": table(
            inertia.assign(
                frequency_hz=inertia["frequency_hz"].map("{:g}".format),
                inertia=_percent(inertia["inertia"]),
                refused=inertia["refused"].astype(int),
            )
        ),
    } | _of_rises(change[change["device"] == change["device"].iloc[0]])


def _spread(scores: pd.DataFrame) -> str:
    """By how much the highest score of a condition exceeds its lowest: least and most of all conditions."""
    spread = PERCENT * (scores.max(axis=1) / scores.min(axis=1) - 1.0)
    return f"{spread.min():.0f} to {spread.max():.0f} %"


def _discretisation(quasistatic: pd.DataFrame, devices: set[str]) -> str:
    """Stated errors of the same conditions' quasi-static scores: least and most."""
    alike = quasistatic[
        (quasistatic["kinematics"] == Kinematics.SMALL)
        & quasistatic["device"].isin(devices)
        & (quasistatic["interface"] == Interface.SHEAR)
        & (quasistatic["readout"] == Readout.CHANGE_OF_STRAIN)
    ]
    stated = PERCENT * alike["score_error"] / alike["score"]
    return f"{stated.min():.1f} to {stated.max():.1f} %"


def _of_rises(change: pd.DataFrame) -> dict[str, object]:
    """Whether a device's scores rise with phase at the highest frequency, and where they do not with dispersion."""
    asked, predicted = change["frequency_hz"].max(), change.dropna(subset="score")["frequency_hz"].max()
    dispersions = change[change["frequency_hz"] == predicted].groupby("dispersion", sort=False)
    rising = [group.sort_values("phase_deg")["score"].is_monotonic_increasing for _, group in dispersions]
    return {
        "highest": f"{predicted:g}",
        "what_highest": "the highest that it was asked for" if predicted == asked else "the highest with a prediction",
        "rising": sum(rising),
        "dispersions": len(rising),
        "falls": _falls(change[change["frequency_hz"] > 0.0]),
    }


def _falls(change: pd.DataFrame) -> str:
    """Where a device's score is lower at a wider dispersion, which stands later in the table."""
    found = []
    for phase, alike in change.groupby("phase_deg"):
        scores = alike.pivot_table("score", "dispersion", "frequency_hz", sort=False)
        scores = scores.reindex(columns=sorted(scores.columns))
        for lower, higher in pairwise(scores.index):
            at = scores.columns[scores.loc[higher] < scores.loc[lower]]
            if len(at):
                hertz = ", ".join(f"{each:g}" for each in at)
                found.append(f"at {phase:g}° `{higher}` lies below `{lower}` at {hertz} Hz")
    return f"does not always rise: {'; '.join(found)}" if found else "rises at every phase and frequency"


def _frequency(frequency: float) -> str:
    return f"{frequency:g} Hz" if frequency > 0.0 else "slow"


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
                tau = both[slow].corr(both[frequency], method="kendall")
                rows.append(
                    {"device": device, "at": _frequency(frequency), "conditions": len(both), "tau": f"{tau:.2f}"}
                )
    return pd.DataFrame(rows)


def _varied(variants: pd.DataFrame) -> pd.DataFrame:
    """Per device and assumption how far scores of the change of strain move, and whether their order stays."""
    scores = variants.pivot_table(
        str(Readout.CHANGE_OF_STRAIN), ["device", "condition"], "assumption", sort=False, dropna=False
    )
    shipped, *others = variants["assumption"].drop_duplicates()
    rows = []
    for device, own in scores.groupby(level="device", sort=False):
        for other in others:
            moved = PERCENT * (own[other] / own[shipped] - 1.0)
            tau = own[shipped].corr(own[other], method="kendall")
            change = f"{moved.min():+.0f} to {moved.max():+.0f} %"
            rows.append({"device": device, "assumption": other, "change": change, "tau": f"{tau:.2f}"})
    return pd.DataFrame(rows)
