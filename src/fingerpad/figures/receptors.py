"""Strain and change of strain at the receptors, a row per device and dispersion (mirrors the paper's figure 4)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..arrays import FloatArray
from ..contact.solution import Solution
from ..readouts.gabor import FilteredReadouts
from ..scene.device import Condition, Device
from ..scene.readout import Readout
from ..scene.tissue_law import Kinematics
from ..tissue.compliance import CondensedSection
from ..words import KINEMATICS_NAME, PERCENT, READOUT_NAME, plain
from .style import (
    GREY,
    SHADE,
    THIN,
    WIDE,
    Series,
    Shown,
    as_title,
    condition_styles,
    conditions_of,
    face_handle,
    legend_below,
    letter,
    new_figure,
    styled,
)

ROW_HEIGHT, LEGEND_HEIGHT = 38.0, 18.0  # mm
MARGIN = 1.5  # mm of the receptor line that is shown beyond the outermost faces of all devices
MARKER_SPACING = 2.0  # mm between markers on a curve

BEFORE: dict[str, Any] = {"color": GREY, "linewidth": THIN, "zorder": 3}
MOST_ALIKE = 44  # characters of what is said of conditions with one stimulus, beside a panel's count

CAPTION = "With shear, {kinematics}. n: conditions; in a row, those with one and the same stimulus are drawn once."
# small strains of the shipped devices have no such place, finite ones do at the mid-line
ZERO = " Strain is zero where both strains in the plane are compressive, as the one out of it is zero."


@dataclass(frozen=True)
class DeviceReadouts:
    """What one device does at the receptors, with shear.

    readouts: by condition. faces: (n_actuators, 2) arc lengths [mm] from `face_arcs`.
    """

    device: Device
    readouts: Mapping[str, FilteredReadouts]
    faces: FloatArray


def face_arcs(device: Device, section: CondensedSection, solution: Solution) -> FloatArray:
    """Where the skin that touches each actuator before the stimulus begins and ends (n_actuators, 2) along the receptor
    line [mm]: at the receptors nearest to its ends in the undeformed section. NaN for an actuator that touches none.
    """
    touching = solution.force[0, :, 1] > 0.0
    skin, actuator = solution.position[touching], solution.indented_actuator[touching]
    ends = np.full((len(device.actuators.positions), 2), np.nan)
    for number in np.unique(actuator):
        own = skin[actuator == number]
        outermost = own[[own[:, 0].argmin(), own[:, 0].argmax()]]
        apart = np.linalg.norm(outermost[:, None] - section.receptor, axis=2)
        ends[number] = section.arc[apart.argmin(axis=1)]
    return ends


@styled
def receptor_figure(devices: Sequence[DeviceReadouts], kinematics: Kinematics) -> Figure:
    """Strain (A) and change of strain (B) along the receptor line for all conditions of all devices, with shear."""
    rows = [(entry, *each) for entry in devices for each in entry.device.by_dispersion.items()]
    figure = new_figure(WIDE, ROW_HEIGHT * len(rows) + LEGEND_HEIGHT)
    drawn = [
        Shown(entry.device.name, each[0].name, each[0].dispersion, each[0].phase_deg)
        for entry, _, own in rows
        for each in _alike(entry.device, own)
    ]
    styles = condition_styles(conditions_of(entry.device for entry in devices), drawn)
    grid = figure.subplots(len(rows), len(Readout), squeeze=False)
    ends = np.concatenate([_ends(entry) for entry in devices])
    shown = ends.min() - MARGIN, ends.max() + MARGIN
    for row, (entry, dispersion, own) in zip(grid, rows, strict=True):
        alike = _alike(entry.device, own)
        for axes, readout in zip(row, Readout, strict=True):
            draw_faces(axes, entry.faces)
            for number, (condition, *_) in enumerate(alike):
                found = entry.readouts[condition.name]
                values = PERCENT * found.unfiltered(readout)
                series = styles.series[entry.device.name, condition.name]
                draw_readout(axes, found.arc, values, series, number / len(alike))
            if readout is Readout.STRAIN:
                draw_before(axes, entry.readouts[own[0].name])
            axes.set_xlim(*shown)
            axes.set_ylabel(f"{READOUT_NAME[readout]} (%)")
        several = len(own) < len(entry.device.conditions)
        named = f"{entry.device.title}{f', {plain(dispersion)} dispersion' if several else ''}"
        row[0].set_title(as_title(figure, named, len(Readout)), loc="left")
        names = [[styles.series[entry.device.name, each.name].short for each in group] for group in alike]
        row[1].set_title(f"n = {len(own)}{_said(names)}", loc="right", fontweight="normal")
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text)
    for axes in grid[-1]:
        axes.set_xlabel("Arc length along the receptor line, s (mm)")
    caption = CAPTION.format(kinematics=KINEMATICS_NAME[kinematics]) + (ZERO if kinematics is Kinematics.FINITE else "")
    legend_below(figure, [*styles.legend, before_handle()], caption, [*styles.spreads, face_handle()])
    return figure


def _ends(entry: DeviceReadouts) -> FloatArray:
    """Arc lengths (n_actuators, 2) [mm] to show: of the faces, and of those that touch nothing about their place."""
    row = entry.device.actuators
    place = np.asarray(row.positions)[:, None] + [-row.width / 2.0, row.width / 2.0]
    return np.where(np.isnan(entry.faces), place, entry.faces)


def _alike(device: Device, conditions: Sequence[Condition]) -> list[list[Condition]]:
    """Conditions in groups with one and the same stimulus."""
    groups: dict[str, list[Condition]] = {}
    for condition in conditions:
        groups.setdefault(device.first_with_stimulus_of(condition.name).name, []).append(condition)
    return list(groups.values())


def _said(groups: Sequence[Sequence[str]]) -> str:
    """Which conditions a row draws as others, or how many curves it has if that is much to say."""
    pairs = [f"{', '.join(others)} as {first}" for first, *others in groups if others]
    said = f": {'; '.join(pairs)}" if pairs else ""
    return said if len(said) <= MOST_ALIKE else f", {len(groups)} drawn"


def draw_faces(axes: Axes, faces: FloatArray) -> None:
    """Shade where skin touches the actuators' faces before the stimulus, along an axis of whole millimetres."""
    axes.locator_params(axis="x", integer=True)
    for start, stop in faces[np.isfinite(faces).all(axis=1)]:
        axes.axvspan(start, stop, color=SHADE, linewidth=0.0, zorder=0)


def draw_before(axes: Axes, found: FilteredReadouts) -> None:
    """Strain (%) of the pre-indented state, from which it changes, along the receptor line, over the curves."""
    axes.plot(found.arc, PERCENT * (found.strain - found.change_of_strain), **BEFORE)


def before_handle() -> Line2D:
    """Legend entry of the pre-indented state."""
    return Line2D([], [], **BEFORE, label="pre-indented")


def draw_readout(axes: Axes, arc: FloatArray, values: FloatArray, series: Series, shift: float) -> None:
    """A read-out along the receptor line; markers, shifted by a share [1] of their spacing, tell curves apart."""
    spacing = max(round(MARKER_SPACING / float(arc[1] - arc[0])), 1)
    axes.plot(
        arc, values, color=series.colour, linestyle=series.line, marker=series.marker, fillstyle=series.fill,
        markerfacecoloralt="white", markevery=(int(shift * spacing), spacing), markersize=3.0, zorder=2,
    )  # fmt: skip
    axes.axhline(0.0, color=GREY, linewidth=THIN, zorder=1)
