"""From the receptors' strains to a score, for one device (mirrors the paper's figure 3)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from ..readouts.roughness import score_span
from ..rounding import rounded
from ..scene.readout import GaborFilter, Readout, ReadoutRule
from ..words import PERCENT, READOUT_NAME, SCORE_SCALE, counted, score_label, shortened
from .receptors import DeviceReadouts, draw_curve, draw_faces
from .style import (
    WIDE,
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

HEIGHT, SLANTED = 100.0, 34.0  # mm, and what slanted labels take besides
WIDTHS = (1.0, 1.0, 0.9)  # of the columns, relative
HEADINGS = ("1  At the receptors", "2  Gabor-filtered", "3  Area")
LONG = 6  # characters of a condition's name beyond which names are slanted
HEADROOM = 1.45  # of the bars' axis over the tallest bar [1]
MOST_NUMBERS, MOST_NAMES = 5, 12  # conditions whose scores fit above their bars, and whose names below
NUMBERS = "Small strain. Above bars: scores and their stated errors of discretisation."
LINES = "Small strain. Lines on bars: the scores' stated errors of discretisation."


@styled
def workflow_figure(entry: DeviceReadouts, gabor: GaborFilter, rule: ReadoutRule, scores: pd.DataFrame) -> Figure:
    """Receptor read-outs, the same after the Gabor filter, and their areas; strain (A), change of strain (B).

    scores: condition, interface, readout, score and score_error [unit], unit; rows of this device with shear and small
    strain.
    """
    device = entry.device
    styles = condition_styles(conditions_of([device]))
    names = [shortened(styles.series[device.name, condition.name].label) for condition in device.conditions]
    long = max(map(len, names)) > LONG
    figure = new_figure(WIDE, HEIGHT + (SLANTED if long else 0.0))
    grid = figure.subplots(len(Readout), len(WIDTHS), width_ratios=WIDTHS)
    span = score_span(device.actuators, rule.span_margin)
    for row, readout in zip(grid, Readout, strict=True):
        receptors, filtered, bars = row
        factor, power = SCORE_SCALE[readout]
        for axes in (receptors, filtered):
            draw_faces(axes, entry.faces)
            axes.set_xlim(*span)
        for number, condition in enumerate(device.conditions):
            found = entry.readouts[condition.name]
            series = styles.series[device.name, condition.name]
            shift = number / len(device.conditions)
            draw_curve(receptors, found.arc, PERCENT * found.unfiltered(readout), series, shift)
            draw_curve(filtered, found.arc, factor * found.filtered(readout), series, shift)
        receptors.set_ylabel(f"{READOUT_NAME[readout]} (%)")
        filtered.set_ylabel(f"Filtered {READOUT_NAME[readout].lower()}\n({power}mm)")
        kernel = f"λ = {gabor.wavelength(readout):g} mm, \N{GREEK SMALL LETTER SIGMA} = {gabor.sigma:g} mm"
        headings = HEADINGS if readout is Readout.STRAIN else ("", "", "")
        for axes, heading, text in zip(row, headings, ("", kernel, "under |filtered|, over this span"), strict=True):
            subtitle(axes, heading, text)

        part = scores[scores["readout"] == readout].set_index("condition")
        part = part.reindex([condition.name for condition in device.conditions])
        heights, errors = factor * part["score"], factor * part["score_error"]
        places = np.arange(len(heights))
        colours = [styles.series[device.name, name].colour for name in heights.index]
        drawn = bars.bar(places, heights, color=colours, width=0.65)
        if len(heights) <= MOST_NUMBERS:
            labels = ["\n±".join(rounded(*each)) for each in zip(heights, errors, strict=True)]
            bars.bar_label(drawn, labels, padding=1.0)
        else:
            draw_errors(bars, places, heights.to_numpy(), errors.to_numpy(), along="y")
        named = slice(len(places) if len(places) <= MOST_NAMES else 0)
        bars.set_xticks(places[named], names[named], rotation=30.0 if long else 0.0, ha="right" if long else "center")
        bars.set_ylim(0.0, HEADROOM * float(heights.max()))
        bars.set_ylabel(score_label(readout, str(part["unit"].iloc[0]), in_two_lines=True))
    for axes in grid[-1][:2]:
        axes.set_xlabel("Arc length along the receptor line, s (mm)")
    many = len(device.conditions) > MOST_NAMES
    by_phase = all(
        name == f"{condition.phase_deg:g}°" for name, condition in zip(names, device.conditions, strict=True)
    )
    grid[-1][2].set_xlabel("Conditions, in order" if many else "Phase difference" if by_phase else "Condition")
    for axes, text in zip(grid[:, 0], "AB", strict=True):
        letter(axes, text, (-30.0, 14.0))
    title = f"{device.title}, with shear ({counted(device.conditions)})"
    figure.suptitle(as_title(figure, title), fontweight="bold")
    caption = NUMBERS if len(device.conditions) <= MOST_NUMBERS else LINES
    legend_below(figure, styles.legend, caption, [*styles.spreads, face_handle()])
    return figure
