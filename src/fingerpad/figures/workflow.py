"""From the receptors' strains to a score, for one device (mirrors the paper's figure 3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..readouts.roughness import scene_span
from ..rounding import rounded
from ..scene.device import Device
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..words import PERCENT, READOUT_NAME, SCORE_SCALE, counted, score_label, shortened
from .receptors import DeviceReadouts, before_handle, draw_before, draw_faces, draw_readout
from .style import (
    WIDE,
    Styles,
    as_title,
    condition_styles,
    conditions_of,
    draw_errors,
    face_handle,
    legend_below,
    letter,
    new_figure,
    styled,
    subtitle,
)

HEIGHT, UPRIGHT = 100.0, 17.0  # mm, and what upright labels take besides, which stand in the last row alone
LAST = list(Readout)[-1]  # row
WIDTHS = (1.0, 1.0, 0.9)  # of the columns, relative
LETTER_PLACE = (-30.0, 14.0)  # of letters from panels' upper left corners, beside titles [pt]
HEADINGS = ("1  At the receptors", "2  Gabor-filtered", "3  Area")
LONG = 6  # characters of a condition's name beyond which names stand upright
HEADROOM = 1.45  # of the bars' axis over the tallest bar [1]
MOST_NUMBERS, MOST_NAMES = 3, 12  # conditions whose scores fit above their bars, and whose names below
NUMBERS = "Small strain. Above bars: scores and their stated errors of discretisation."
LINES = "Small strain. Lines on bars: the scores' stated errors of discretisation."


@styled
def workflow_figure(scene: Scene, entry: DeviceReadouts, scores: pd.DataFrame) -> Figure:
    """Receptor read-outs, the same after the Gabor filter, and their areas; strain (A), change of strain (B).

    scores: condition, interface, readout, score and score_error [unit], unit; rows of this device with shear and small
    strain.
    """
    device, gabor = scene.device, scene.model.gabor
    styles = condition_styles(conditions_of([device]))
    names = [shortened(styles.series[device.name, condition.name].label) for condition in device.conditions]
    upright = max(map(len, names)) > LONG
    figure = new_figure(WIDE, HEIGHT + (UPRIGHT if upright else 0.0))
    grid = figure.subplots(len(Readout), len(WIDTHS), width_ratios=WIDTHS)
    for row, readout in zip(grid, Readout, strict=True):
        receptors, filtered, bars = row
        kernel = f"λ = {gabor.wavelength(readout):g} mm, \N{GREEK SMALL LETTER SIGMA} = {gabor.sigma:g} mm"
        headings = HEADINGS if readout is Readout.STRAIN else ("", "", "")
        details = ("", kernel, "under |filtered|, over the span at left")
        for axes, heading, text in zip(row, headings, details, strict=True):
            subtitle(axes, heading, text)
        for axes in (receptors, filtered):
            draw_faces(axes, entry.faces)
            axes.set_xlim(*scene_span(scene))
        _draw_curves(receptors, filtered, entry, readout, styles)
        own = scores[scores["readout"] == readout].set_index("condition")
        _draw_bars(bars, own.reindex([condition.name for condition in device.conditions]), device, readout, styles)
        _name_bars(bars, () if upright and readout is not LAST else names, upright)
    for axes in grid[-1][:2]:
        axes.set_xlabel("Arc length along the receptor line, s (mm)")
    grid[-1][2].set_xlabel(_what_bars_are(names, device))
    for axes, text in zip(grid[:, 0], "AB", strict=True):
        letter(axes, text, LETTER_PLACE)
    title = f"{device.title}, with shear ({counted(device.conditions)})"
    figure.suptitle(as_title(figure, title), fontweight="bold")
    caption = NUMBERS if len(device.conditions) <= MOST_NUMBERS else LINES
    legend_below(figure, [*styles.legend, before_handle()], caption, [*styles.spreads, face_handle()])
    return figure


def _draw_curves(receptors: Axes, filtered: Axes, entry: DeviceReadouts, readout: Readout, styles: Styles) -> None:
    """One read-out of every condition along the receptor line, and what the filter makes of it."""
    factor, power = SCORE_SCALE[readout]
    conditions = entry.device.conditions
    for number, condition in enumerate(conditions):
        found = entry.readouts[condition.name]
        series = styles.series[entry.device.name, condition.name]
        shift = number / len(conditions)
        draw_readout(receptors, found.arc, PERCENT * found.unfiltered(readout), series, shift)
        draw_readout(filtered, found.arc, factor * found.filtered(readout), series, shift)
    if readout is Readout.STRAIN:
        draw_before(receptors, entry.readouts[conditions[0].name])
    receptors.set_ylabel(f"{READOUT_NAME[readout]} (%)")
    filtered.set_ylabel(f"Filtered {READOUT_NAME[readout].lower()}\n({power}mm)")


def _draw_bars(axes: Axes, scores: pd.DataFrame, device: Device, readout: Readout, styles: Styles) -> None:
    """Scores of one read-out with their errors, as numbers if these are few."""
    factor, _ = SCORE_SCALE[readout]
    heights, errors = factor * scores["score"], factor * scores["score_error"]
    places = np.arange(len(heights))
    colours = [styles.series[device.name, name].colour for name in heights.index]
    drawn = axes.bar(places, heights, color=colours, width=0.65)
    if len(heights) <= MOST_NUMBERS:
        axes.bar_label(drawn, ["\n±".join(rounded(*each)) for each in zip(heights, errors, strict=True)], padding=1.0)
    else:
        draw_errors(axes, places, heights.to_numpy(), errors.to_numpy(), along="y")
    if (highest := float(heights.max())) > 0.0:
        axes.set_ylim(0.0, HEADROOM * highest)
    axes.set_ylabel(score_label(readout, str(scores["unit"].iloc[0]), in_two_lines=True))


def _name_bars(axes: Axes, names: Sequence[str], upright: bool) -> None:
    """Conditions' names below their bars, unless there are too many."""
    named = names if len(names) <= MOST_NAMES else ()
    axes.set_xticks(range(len(named)), named, rotation=90.0 if upright else 0.0)


def _what_bars_are(names: Sequence[str], device: Device) -> str:
    """The label below bars of conditions with these names."""
    if len(names) > MOST_NAMES:
        return "Conditions, in order"
    phases = [f"{condition.phase_deg:g}°" for condition in device.conditions]
    return "Phase difference" if [*names] == phases else "Condition"
