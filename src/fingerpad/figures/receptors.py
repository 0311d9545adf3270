"""Strain and change of strain at the receptors, one row a device (mirrors the paper's figure 4)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..arrays import FloatArray
from ..compliance import CondensedSection
from ..device import Device
from ..readout import Readout
from ..strain import FilteredReadouts
from ..tissue_law import Kinematics
from .style import (
    GREY,
    KINEMATICS_NAME,
    PERCENT,
    READOUT_NAME,
    SHADE,
    THIN,
    WIDE,
    Series,
    as_title,
    condition_styles,
    conditions_of,
    counted,
    face_handle,
    legend_below,
    letter,
    new_figure,
    styled,
)

ROW_HEIGHT, LEGEND_HEIGHT = 44.0, 18.0  # mm
MARGIN = 1.5  # mm of the receptor line that is shown beyond the outermost faces of all devices
MARKER_SPACING = 2.0  # mm between markers on a curve

CAPTION = "With shear, {kinematics}. Conditions with one and the same stimulus are drawn once."


@dataclass(frozen=True)
class DeviceReadouts:
    """What one device does at the receptors, with shear.

    readouts: by condition. faces: (n_actuators, 2) arc lengths [mm] at which the actuators' faces begin and end.
    """

    device: Device
    readouts: Mapping[str, FilteredReadouts]
    faces: FloatArray


def face_arcs(device: Device, section: CondensedSection) -> FloatArray:
    """Where the faces (n_actuators, 2) begin and end along the receptor line [mm], straight above each."""
    half = device.actuators.width / 2.0
    edges = np.asarray(device.actuators.positions)[:, None] + np.array([-half, half])
    across = section.receptor[:, 0]
    pad = slice(int(across.argmin()), int(across.argmax()) + 1)  # beyond its widest the line comes back
    return np.asarray(np.interp(edges, across[pad], section.arc[pad]))


@styled
def receptor_figure(devices: Sequence[DeviceReadouts], kinematics: Kinematics = Kinematics.SMALL) -> Figure:
    """Strain (A) and change of strain (B) along the receptor line for all conditions of all devices, with shear."""
    figure = new_figure(WIDE, ROW_HEIGHT * len(devices) + LEGEND_HEIGHT)
    styles = condition_styles(conditions_of(entry.device for entry in devices))
    grid = figure.subplots(len(devices), len(Readout), squeeze=False)
    outermost = [(entry.faces.min(), entry.faces.max()) for entry in devices]
    shown = min(start for start, _ in outermost) - MARGIN, max(stop for _, stop in outermost) + MARGIN
    for row, entry in zip(grid, devices, strict=True):
        for axes, readout in zip(row, Readout, strict=True):
            draw_faces(axes, entry.faces)
            distinct = [c for c in entry.device.conditions if entry.device.first_with_stimulus_of(c.name) is c]
            for number, condition in enumerate(distinct):
                found = entry.readouts[condition.name]
                values = PERCENT * (found.strain if readout is Readout.STRAIN else found.change_of_strain)
                series = styles.series[entry.device.name, condition.name]
                draw_curve(axes, found.arc, values, series, number / len(distinct))
            axes.set_xlim(*shown)
            axes.set_ylabel(f"{READOUT_NAME[readout]} (%)")
        named = f"{entry.device.title} ({counted(entry.device.conditions)})"
        row[0].set_title(as_title(figure, named, len(Readout)), loc="left")
    for axes, text in zip(grid[0], "AB", strict=True):
        letter(axes, text)
    for axes in grid[-1]:
        axes.set_xlabel("Arc length along the receptor line, s (mm)")
    legend_below(figure, [*styles.legend, face_handle()], CAPTION.format(kinematics=KINEMATICS_NAME[kinematics]))
    return figure


def draw_faces(axes: Axes, faces: FloatArray) -> None:
    """Shade where the actuators' faces are."""
    for start, stop in faces:
        axes.axvspan(start, stop, color=SHADE, linewidth=0.0, zorder=0)


def draw_curve(axes: Axes, arc: FloatArray, values: FloatArray, series: Series, shift: float) -> None:
    """A read-out along the receptor line; markers, shifted by a share [1] of their spacing, tell curves apart."""
    spacing = max(round(MARKER_SPACING / float(arc[1] - arc[0])), 1)
    axes.plot(
        arc, values, color=series.colour, linestyle=series.line, marker=series.marker, fillstyle=series.fill,
        markerfacecoloralt="white", markevery=(int(shift * spacing), spacing), markersize=3.0, zorder=2,
    )  # fmt: skip
    axes.axhline(0.0, color=GREY, linewidth=THIN, zorder=1)
