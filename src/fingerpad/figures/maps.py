"""Maps of strain and its change on the deformed section, contact tractions beneath, for a device and dispersion.

What is drawn are nodal forces over the skin that belongs to their node, with straight lines between: the linear
tractions of the model (`traction`), whose integral is the contact force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import TriMesh
from matplotlib.colors import Normalize, PowerNorm
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
    "{counted}, {kinematics}, at the end of the stimulus; displacements to scale. Change: from the pre-indented state,"
    " at the same tissue. Tractions: linear between nodes."
)
NARROWEST = 1.2  # width of a map, of its height [1], however few the actuators are
SLACK = 1.15  # height that maps are given, of what they need [1]: so the width decides, and tractions lie beneath
# Per cent of the area in view that the colours tell apart; the rest is beyond the end of the bar. Strain changes most
# at the bone, where no receptors are
COVERED, CHANGE_COVERED = 99.5, 90.0
STEP, CHANGE_STEP = 5.0, 0.5  # per cent of strain, and of its change, to which the colours' end is rounded up
HEADROOM = 1.08  # of the tractions' axis beyond the largest [1]
KILO = 1e3  # kPa in a MPa
STRAIN_NAME = {Kinematics.SMALL: "strain", Kinematics.FINITE: "log. strain"}
COLOURS = "viridis"  # perceptually uniform, and monotonic in grey
CHANGE_COLOURS = "RdBu_r"  # red and blue are told apart whichever colours one sees; white is no change

Window = tuple[tuple[float, float], tuple[float, float]]  # ((left, right), (bottom, top)) that is shown [mm]


@styled
def strain_map_figure(
    scene: Scene,
    dispersion: str,
    fields: Fields,
    solutions: Mapping[str, Solution],
) -> Figure:
    """Maximum principal strain at the end of the stimulus, its change and contact tractions, with shear, a column of
    panels a condition.

    fields: a loading for each distinct stimulus of the device, in the order of its conditions. solutions: by
    condition, for all of the dispersion. The colours are common to all figures of one device.
    """
    device, pad = scene.device, scene.model.finger.pad_thickness
    row = device.actuators
    conditions = device.by_dispersion[dispersion]
    distinct = [condition.name for condition in device.distinct_conditions]
    face = max(solution.indentation for solution in solutions.values())
    bottom, top = face - BELOW, pad + ABOVE
    reach = max(abs(x) for x in row.positions) + row.width / 2.0 + ASIDE
    reach = max(reach, (top - bottom) * NARROWEST / 2.0)
    window = ((-reach, reach), (bottom, top))
    shown = _in_view(fields, window)
    name, end = STRAIN_NAME[scene.kinematics], colour_end(shown, shown.strain, COVERED, STEP)
    change_end = colour_end(shown, np.abs(shown.change), CHANGE_COVERED, CHANGE_STEP)

    columns = min(len(conditions), len(WIDTHS))
    blocks = math.ceil(len(conditions) / columns)
    width = WIDTHS[columns - 1]
    map_height = SLACK * ((width - SIDE + GAP) / columns - GAP) * (top - bottom) / (2.0 * reach)
    height = blocks * (2.0 * map_height + TRACTION_HEIGHT + FURNITURE) + BASE
    figure = new_figure(width, height)
    grid = figure.subplots(
        3 * blocks,
        columns,
        squeeze=False,
        sharex=True,
        height_ratios=[map_height, map_height, TRACTION_HEIGHT] * blocks,
    )
    maps, changes, tractions = (grid[number::3].ravel() for number in range(3))
    styles = condition_styles(each for each in conditions_of([device]) if each.dispersion == dispersion)
    drawn_tractions = KILO * np.array([traction for s in solutions.values() for traction in (s.pressure, s.shear)])
    limits = HEADROOM * float(drawn_tractions.min()), HEADROOM * float(drawn_tractions.max())
    scales = {
        "max": (PowerNorm(0.5, 0.0, end), COLOURS, "white", f"Max. principal {name}\n(%, square-root scale)"),
        "both": (Normalize(-change_end, change_end), CHANGE_COLOURS, GREY, f"Change of\n{name} (%)"),
    }
    drawn = {}
    for above, below, beneath, condition in zip(maps, changes, tractions, conditions, strict=False):
        loading = distinct.index(device.first_with_stimulus_of(condition.name).name)
        solution = solutions[condition.name]
        rise = np.array([0.0, solution.indentation])
        offsets = condition.moves[-1] + rise
        for axes, values, (extend, scale) in zip(
            (above, below), (shown.strain, shown.change), scales.items(), strict=True
        ):
            drawn[extend] = _draw_map(axes, shown, loading, values, *scale[:3])
            draw_actuators(axes, row, offsets, 2.0 * BELOW)
            axes.set(xlim=window[0], ylim=window[1], aspect="equal", anchor="S")
            axes.text(0.0, pad + ABOVE / 2.0, "bone", ha="center", va="center", color=GREY)
            axes.tick_params(labelleft=False)
        above.set_title(styles.series[device.name, condition.name].label, loc="left")
        beneath.tick_params(labelleft=False, labelbottom=True)
        _draw_tractions(beneath, row, solution, condition)
        beneath.set_ylim(*limits)
        beneath.set_xlabel("x (mm)")
    for axes in (each for kind in (maps, changes, tractions) for each in kind[len(conditions) :]):
        axes.remove()
    for kind, label in ((maps, "y (mm)"), (changes, "y (mm)"), (tractions, "Traction (kPa)")):
        for axes in kind[::columns]:
            axes.tick_params(labelleft=True)
            axes.set_ylabel(label)
    for kind, (extend, scale) in zip((maps, changes), scales.items(), strict=True):
        figure.colorbar(
            drawn[extend], ax=list(kind[:columns]), extend=extend, aspect=14, pad=0.01, label=scale[3],
        )  # fmt: skip
    several = len(device.by_dispersion) > 1
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


@dataclass(frozen=True)
class _Shown:
    """What is seen of fields: elements (k, 3) as corners of theirs; strain, change (n_loadings, 3k) [1] there."""

    fields: Fields
    elements: np.ndarray
    strain: FloatArray
    change: FloatArray


def _in_view(fields: Fields, window: Window) -> _Shown:
    """The elements that a window shows under any loading, at whose corners alone fields are drawn."""
    (left, right), (bottom, top) = window
    x, y = (fields.corner + fields.displacement).reshape(len(fields.displacement), 2, -1, 3).transpose(1, 0, 2, 3)
    across = (x.max(axis=2) > left) & (x.min(axis=2) < right)
    seen = (across & (y.max(axis=2) > bottom) & (y.min(axis=2) < top)).any(axis=0)
    elements = np.arange(fields.corner.shape[1]).reshape(-1, 3)[seen]
    return _Shown(fields, elements, fields.strain[:, elements.ravel()], fields.change[:, elements.ravel()])


def colour_end(shown: _Shown, values: FloatArray, covered: float, step: float) -> float:
    """Value [%] at which colours end: so many per cent of the area in view, over all loadings, have less.

    values: (n_loadings, 3k) [1], none below zero. covered: share [%]. step: [%] to which it is rounded up.
    """
    corners = shown.fields.corner.T[shown.elements]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    means = values.reshape(len(values), -1, 3).mean(axis=2)
    order = np.argsort(means, axis=None)
    share = np.cumsum(np.tile(area, len(means))[order])
    value = means.ravel()[order][np.searchsorted(share, covered / PERCENT * share[-1])]
    return step * max(math.ceil(PERCENT * float(value) / step), 1)


def _draw_map(
    axes: Axes, shown: _Shown, loading: int, values: FloatArray, norm: Normalize, colours: str, lines: str
) -> TriMesh:
    """Values on the deformed elements, rasterised; the layers' interfaces, in a colour, and the boundary as lines."""
    fields = shown.fields
    moved = fields.corner + fields.displacement[loading]
    at = moved[:, shown.elements.ravel()]
    drawn = axes.tripcolor(
        Triangulation(at[0], at[1], np.arange(at.shape[1]).reshape(-1, 3)), PERCENT * values[loading],
        shading="gouraud", cmap=colours, norm=norm, rasterized=True,
    )  # fmt: skip
    for facets, colour in ((fields.interface, lines), (fields.boundary, "black")):
        ends = moved[:, facets[np.isin(facets, shown.elements).any(axis=1)]]
        x, y = np.pad(ends, ((0, 0), (0, 0), (0, 1)), constant_values=np.nan).reshape(2, -1)  # a gap after each facet
        axes.plot(x, y, color=colour, linewidth=THIN, solid_capstyle="round")
    return drawn


def _draw_tractions(axes: Axes, row: ActuatorRow, solution: Solution, condition: Condition) -> None:
    """Pressure and shear of the nodes in contact, one line an actuator."""
    nearest = row.nearest(solution.position[:, 0])
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
