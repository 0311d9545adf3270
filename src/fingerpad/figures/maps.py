"""Strain maps on the deformed section with the contact tractions beneath, for one device and dispersion.

What is drawn are nodal forces over the skin that belongs to their node, with straight lines between: the linear
tractions of the model (`traction`), whose integral is the contact force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, TriMesh
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.tri import Triangulation

from ..arrays import FloatArray
from ..device import ActuatorRow, Condition
from ..fields import Fields
from ..scene import Scene
from ..solution import Solution
from ..tissue_law import Kinematics
from .actuators import draw_actuators
from .style import (
    BLUE,
    DASHED,
    GREY,
    KINEMATICS_NAME,
    MIDDLE,
    NARROW,
    PERCENT,
    THIN,
    VERMILLION,
    WIDE,
    as_title,
    condition_styles,
    conditions_of,
    counted,
    legend_below,
    new_figure,
    plain,
    styled,
)

WIDTHS = (NARROW, MIDDLE, WIDE)  # mm, of figures with one, two or three panels beside each other
ASIDE, BELOW, ABOVE = 1.0, 0.8, 0.9  # mm shown beside the row, below the faces and above the pad's tissue
TRACTION_HEIGHT, FURNITURE, BASE = 24.0, 16.0, 22.0  # mm: a traction panel; labels of a block; legend and title
SIDE, GAP = 28.0, 4.0  # mm of the figure's width that axis labels and colour bar take, and between panels
CAPTION = (
    "{counted}, {kinematics}, at the end of the stimulus; displacements to scale. Tractions: linear between nodes."
)
NARROWEST = 1.2  # width of a map, of its height [1], however few the actuators are
SLACK = 1.15  # height that maps are given, of what they need [1]: so the width decides, and tractions lie beneath
COVERED = 99.5  # per cent of the area in view that the colours tell apart; the rest is beyond the end of the bar
STEP = 5.0  # per cent of strain to which the colours' end is rounded up
HEADROOM = 1.08  # of the tractions' axis beyond the largest [1]
KILO = 1e3  # kPa in a MPa
STRAIN_NAME = {Kinematics.SMALL: "strain", Kinematics.FINITE: "log. strain"}
COLOURS = "viridis"  # perceptually uniform, and monotonic in grey


@styled
def strain_map_figure(
    scene: Scene,
    dispersion: str,
    fields: Fields,
    solutions: Mapping[str, Solution],
) -> Figure:
    """Maximum principal strain at the end of the stimulus and contact tractions, with shear, a panel a condition.

    fields: a loading for each distinct stimulus of the device, in the order of its conditions. solutions: by
    condition, for all of the dispersion. The colours are common to all figures of one device.
    """
    device, pad = scene.device, scene.model.finger.pad_thickness
    row = device.actuators
    conditions = [condition for condition in device.conditions if condition.dispersion == dispersion]
    distinct = [condition.name for condition in device.distinct_conditions]
    face = max(solution.indentation for solution in solutions.values())
    bottom, top = face - BELOW, pad + ABOVE
    reach = max(abs(x) for x in row.positions) + row.width / 2.0 + ASIDE
    reach = max(reach, (top - bottom) * NARROWEST / 2.0)
    window = ((-reach, reach), (bottom, top))
    end = colour_end(fields, window)

    columns = min(len(conditions), len(WIDTHS))
    blocks = math.ceil(len(conditions) / columns)
    width = WIDTHS[columns - 1]
    map_height = SLACK * ((width - SIDE + GAP) / columns - GAP) * (top - bottom) / (2.0 * reach)
    height = blocks * (map_height + TRACTION_HEIGHT + FURNITURE) + BASE
    figure = new_figure(width, height)
    grid = figure.subplots(
        2 * blocks, columns, squeeze=False, sharex=True, height_ratios=[map_height, TRACTION_HEIGHT] * blocks
    )
    maps, tractions = grid[0::2].ravel(), grid[1::2].ravel()
    styles = condition_styles(shown for shown in conditions_of([device]) if shown.dispersion == dispersion)
    drawn_tractions = KILO * np.array([traction for s in solutions.values() for traction in (s.pressure, s.shear)])
    limits = HEADROOM * float(drawn_tractions.min()), HEADROOM * float(drawn_tractions.max())
    for axes, beneath, condition in zip(maps, tractions, conditions, strict=False):
        loading = distinct.index(device.first_with_stimulus_of(condition.name).name)
        solution = solutions[condition.name]
        drawn = _draw_map(axes, fields, loading, end)
        rise = np.array([0.0, solution.indentation])
        offsets = condition.moves[-1] + rise
        draw_actuators(axes, row, offsets, 2.0 * BELOW)
        axes.set(xlim=window[0], ylim=window[1], aspect="equal", anchor="S")
        axes.text(0.0, pad + ABOVE / 2.0, "bone", ha="center", va="center", color=GREY)
        axes.set_title(styles.series[device.name, condition.name].label, loc="left")
        axes.tick_params(labelleft=False)
        beneath.tick_params(labelleft=False, labelbottom=True)
        _draw_tractions(beneath, row, fields.contact, solution, condition)
        beneath.set_ylim(*limits)
        beneath.set_xlabel("x (mm)")
    for axes in (*maps[len(conditions) :], *tractions[len(conditions) :]):
        axes.remove()
    for leftmost, label in ((maps[::columns], "y (mm)"), (tractions[::columns], "Traction (kPa)")):
        for axes in leftmost:
            axes.tick_params(labelleft=True)
            axes.set_ylabel(label)
    figure.colorbar(
        drawn, ax=list(maps[:columns]), extend="max", aspect=14, pad=0.01,
        label=f"Max. principal {STRAIN_NAME[scene.kinematics]}\n(%, square-root scale)",
    )  # fmt: skip
    several = len({condition.dispersion for condition in device.conditions}) > 1
    named = f", {plain(dispersion)} dispersion" if several else ""
    figure.suptitle(as_title(figure, f"{device.title}{named}, with shear"), fontweight="bold")
    legend_below(
        figure,
        [
            Line2D([], [], color=BLUE, label="contact pressure"),
            Line2D([], [], color=VERMILLION, linestyle=DASHED, label="shear traction on the skin, towards +x"),
        ],
        CAPTION.format(counted=counted(conditions), kinematics=KINEMATICS_NAME[scene.kinematics]),
    )
    return figure


def colour_end(fields: Fields, window: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """Strain [%] at which the colours end: COVERED per cent of the area in view, over all loadings, lie below."""
    (left, right), (_, top) = window
    corners = fields.corner.T.reshape(-1, 3, 2)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    centre = corners.mean(axis=1)
    seen = (centre[:, 0] > left) & (centre[:, 0] < right) & (centre[:, 1] < top)
    strain = fields.strain.reshape(len(fields.strain), -1, 3).mean(axis=2)[:, seen]
    order = np.argsort(strain, axis=None)
    share = np.cumsum(np.tile(area[seen], len(strain))[order])
    covered = strain.ravel()[order][np.searchsorted(share, COVERED / PERCENT * share[-1])]
    return STEP * math.ceil(PERCENT * float(covered) / STEP)


def _draw_map(axes: Axes, fields: Fields, loading: int, end: float) -> TriMesh:
    """Strain on the deformed elements, rasterised; the layers' interfaces and the boundary as lines."""
    moved = fields.corner + fields.displacement[loading]
    drawn = axes.tripcolor(
        Triangulation(moved[0], moved[1], np.arange(moved.shape[1]).reshape(-1, 3)), PERCENT * fields.strain[loading],
        shading="gouraud", cmap=COLOURS, norm=PowerNorm(0.5, 0.0, end), rasterized=True,
    )  # fmt: skip
    for lines, colour in ((fields.interface, "white"), (fields.boundary, "black")):
        axes.add_collection(LineCollection(list(moved.T[lines]), colors=colour, linewidths=THIN, capstyle="round"))
    return drawn


def _draw_tractions(
    axes: Axes, row: ActuatorRow, contact: FloatArray, solution: Solution, condition: Condition
) -> None:
    """Pressure and shear of the nodes in contact, one line an actuator. contact: (n,) x of undeformed nodes [mm]."""
    nearest = np.argmin(np.abs(contact[:, None] - np.asarray(row.positions)), axis=1)
    centre = np.asarray(row.positions) + condition.tangential[-1]
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    pressure, shear = KILO * solution.pressure, KILO * solution.shear
    for number in range(len(row.positions)):
        own = np.flatnonzero(nearest == number)
        touched = own[pressure[own] > 0.0]
        if touched.size == 0:
            continue
        shown = own[(own >= touched[0] - 1) & (own <= touched[-1] + 1)]  # from and to a node without contact
        x = centre[number] + solution.place[shown]
        axes.plot(x, pressure[shown], color=BLUE)
        axes.plot(x, shear[shown], color=VERMILLION, linestyle=DASHED)
