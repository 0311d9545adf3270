"""Score against perceived roughness, for every device and both read-outs (mirrors the paper's figure 5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import wrap
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..perception.ratings import NO_RATINGS
from ..perception.wording import (
    OPEN_SLOPE,
    SMALLEST_P,
    SURROGATE,
    has_open,
    has_p,
    is_open,
    is_surrogate,
    p_text,
    published_text,
    r2_text,
    range_text,
    slope_name,
    tau_text,
)
from ..readouts.comparison import classes
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..words import KINEMATICS_NAME, PERCENT, SCORE_SCALE, score_label, shortened
from .style import (
    GREY,
    WIDE,
    Styles,
    as_points,
    as_title,
    condition_styles,
    draw_errors,
    draw_point,
    legend_below,
    letter,
    new_figure,
    note_in,
    shown_in,
    styled,
    unknown_errors,
)

ROW_HEIGHT, LEGEND_HEIGHT = 40.0, 22.0  # mm
STATISTICS_WIDTH = 22  # characters in a line beside a panel
BESIDE = 11.0  # of statistics from their panel, past half a number below its end [pt]
MOST_NAMES = 8  # conditions' names that fit a panel's height
TICKS = 4  # along a score's axis, at most
SPREAD_DIGITS = 10.0  # per cent from which a spread has no decimals
PADDING = 0.12  # of the axes beyond the outermost points, relative to their spread
CAPTION = (
    "{interface}n: conditions; identical stimuli share one score.{rated}"
    " spread: range of scores over their mean. Bars: estimated discretisation error of a score; where none is seen it"
    " is smaller than the mark."
)
RATED = " Line: least squares, where the slope is not open.{p}{ratings} τ: Kendall's with these ratings{between}."
BETWEEN = " (and its range under errors of scores)"
RANGE = " R² range: over all ratings with the stated order; errors of scores are not in it."
SURROGATES = " Steps between surrogates, and so their R², mean nothing more than the order."
P = " p: two-sided, over distinct conditions alone, while R² is over all."
UNRATED = " Devices without ratings: the order of scores is a prediction, not compared with perception."


@styled
def correlation_figure(
    scores: pd.DataFrame,
    ratings: pd.DataFrame,
    correlations: pd.DataFrame,
    titles: Mapping[str, str],
    kinematics: Kinematics,
) -> Figure:
    """Strain score (A) and change-of-strain score (B) with shear against perceived roughness, one row per device.

    A device without ratings is shown with its conditions in the order of their scores, equal ones side by side.

    scores, correlations: the tables of that name. ratings: device, condition, rating. titles: by device.
    """
    figure = new_figure(WIDE, ROW_HEIGHT * len(titles) + LEGEND_HEIGHT)
    styles = condition_styles(shown_in(scores))
    grid = figure.subplots(len(titles), len(Readout), squeeze=False)
    for row, (device, title) in zip(grid, titles.items(), strict=True):
        for axes, readout in zip(row, Readout, strict=True):
            correlation_panel(axes, scores, ratings, correlations, (device, Interface.SHEAR, readout), styles)
        row[0].set_title(as_title(figure, title, len(Readout)), loc="left")
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text)
    shown = correlations[correlations["interface"] == Interface.SHEAR]
    unknown = unknown_errors(scores[scores["interface"] == Interface.SHEAR])
    said = caption(shown, f"With shear, {KINEMATICS_NAME[kinematics]}. ") + unknown
    legend_below(figure, as_points(styles.legend), said, as_points(styles.spreads))
    return figure


def correlation_panel(
    axes: Axes,
    scores: pd.DataFrame,
    ratings: pd.DataFrame,
    correlations: pd.DataFrame,
    key: tuple[str, Interface, Readout],
    styles: Styles,
) -> None:
    """Ratings over scores of one device, interface and read-out, with their statistics beside; or why there is none.

    Without ratings the conditions stand in the order of their scores; those that rounding alone tells apart share one.
    """
    device, _, readout = key
    row = _only(correlations, key)
    scored = _rows(scores, key).dropna(subset=["score"])
    rated = scored.merge(ratings[["device", "condition", "rating"]], on=["device", "condition"])
    points = scored.sort_values("score", kind="stable") if rated.empty else rated
    if points.empty:
        note_in(axes, str(row["note"]))
        return
    factor = SCORE_SCALE[readout][0]
    x = factor * points["score"].to_numpy()
    y = 1.0 + classes(x) if rated.empty else points["rating"].to_numpy()
    if pd.notna(row["r2"]) and not is_open(row):  # a line would say what the errors leave open
        slope, intercept = np.polyfit(x, y, 1)
        ends = np.array([x.min(), x.max()])
        axes.plot(ends, intercept + slope * ends, color=GREY, zorder=1)
    draw_errors(axes, x, y, factor * points["score_error"].to_numpy(float), along="x")
    for name, one, other in zip(points["condition"], x, y, strict=True):
        draw_point(axes, one, other, styles.series[device, name])
    axes.margins(PADDING)
    axes.locator_params(axis="x", nbins=TICKS)
    axes.set_xlabel(score_label(readout, str(points["unit"].iloc[0])))
    if rated.empty:
        names = [shortened(styles.series[device, name].label) for name in points["condition"]]
        _name_places(axes, y, names)
    else:
        axes.locator_params(axis="y", nbins=TICKS)
        axes.set_ylabel(f"Perceived roughness\n({row['rating_kind']})")
    axes.annotate(
        statistics(row, x.size), (1.0, 1.0), xycoords="axes fraction", xytext=(BESIDE, 0.0), textcoords="offset points",
        va="top", linespacing=1.35,
    )  # fmt: skip


def _name_places(axes: Axes, place: FloatArray, names: Sequence[str]) -> None:
    """Names of conditions at their places, lowest score first; places alone where names would not fit."""
    groups = [[name for name, at in zip(names, place, strict=True) if at == each] for each in np.unique(place)]
    said = [f"{first} +{len(others)}" if others else first for first, *others in groups]
    if len(said) <= MOST_NAMES:
        axes.set_yticks(np.unique(place), said)
    else:
        axes.locator_params(axis="y", integer=True)
    axes.set_ylabel("In order of score")


def statistics(row: Mapping[str, Any], n: int) -> str:
    """What the correlation table says of one panel with n scores, line by line."""
    spread = PERCENT * row["spread"]
    told = "" if pd.isna(spread) else f", spread {spread:.{0 if spread >= SPREAD_DIGITS else 1}f} %"
    lines = [f"n = {n}{told}"]
    related, alike = pd.notna(row["r2"]), is_surrogate(row)
    if related and not alike:
        lines.append(f"R² = {r2_text(row)}{_p(row)}")
    if related:
        lines += [f"τ = {tau_text(row)}", f"slope {slope_name(row)}"]
    if between := range_text(row):
        lines.append(f"R² range {between}")
    if published := published_text(row):
        lines.append(f"published{' R²' if pd.notna(row['published_r2']) else ':'} {published}")
    if related and alike:
        lines.append(f"{SURROGATE} = {r2_text(row)}")
    if isinstance(row["note"], str) and row["note"]:
        lines.append(row["note"])
    return "\n".join(part for line in lines for part in wrap(line, STATISTICS_WIDTH))


def _p(row: Mapping[str, Any]) -> str:
    """The p of R², if it has one."""
    if not has_p(row["p"], row["rating_kind"]):
        return ""
    return f", p {'' if row['p'] < SMALLEST_P else '= '}{p_text(row['p'])}"


def caption(correlations: pd.DataFrame, interface: str) -> str:
    """What a figure's statistics mean and what its ratings are."""
    unrated = UNRATED if (correlations["note"] == NO_RATINGS).any() else ""
    ratings = ratings_caption(correlations)
    p = P if any(has_p(row["p"], row["rating_kind"]) for row in correlations.to_dict("records")) else ""
    between = BETWEEN if (correlations["tau_lowest"] < correlations["tau_highest"]).any() else ""
    rated = RATED.format(ratings=ratings, between=between, p=p) if ratings else ""
    return CAPTION.format(interface=interface, rated=rated) + unrated


def ratings_caption(correlations: pd.DataFrame) -> str:
    """What ratings are, if there are any, and what a range of R² and an open slope mean, if they are shown."""
    kinds = ", ".join(kind for kind in correlations["rating_kind"].dropna().unique() if kind)
    ranges = RANGE if correlations["r2_lowest"].notna().any() else ""
    opened = f" {OPEN_SLOPE}" if has_open(correlations.to_dict("records")) else ""
    alike = any(is_surrogate(row) and pd.notna(row["r2"]) for row in correlations.to_dict("records"))
    return f" Ratings: {kinds}.{SURROGATES if alike else ''}{ranges}{opened}" if kinds else ""


def _rows(table: pd.DataFrame, key: tuple[str, Interface, Readout]) -> pd.DataFrame:
    device, interface, readout = key
    found = (table["device"] == device) & (table["interface"] == interface) & (table["readout"] == readout)
    return table[found]


def _only(table: pd.DataFrame, key: tuple[str, Interface, Readout]) -> pd.Series[Any]:
    return _rows(table, key).iloc[0]
