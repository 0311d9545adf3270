"""Maps of strain and its change on the deformed section, contact tractions beneath, for a device and dispersion.

What is drawn are nodal forces over the skin that belongs to their node, with straight lines between: the linear
tractions of the model (`traction`), whose integral is the contact force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import TriMesh
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import Normal, Stroke
from matplotlib.tri import Triangulation

from ..arrays import FloatArray
from ..contact.solution import Solution
from ..fields.section_fields import Fields
from ..scene.device import ActuatorRow, Condition, Device
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..words import CHANGE_COVERED, COVERED, KILO, KINEMATICS_NAME, PERCENT, counted, plain
from .actuators import draw_actuators
from .style import (
    ALONG,
    GREY,
    INTO,
    INTO_EDGE,
    MIDDLE,
    NARROW,
    THIN,
    VERMILLION,
    WIDE,
    as_title,
    condition_styles,
    conditions_of,
    legend_below,
    new_figure,
    styled,
)

WIDTHS = (NARROW, MIDDLE, WIDE)  # mm, of figures with one, two or three panels beside each other
ASIDE, BELOW, ABOVE = 1.0, 0.8, 0.9  # mm shown beside the row, below the faces and above the pad's tissue
TRACTION_HEIGHT, FURNITURE = 24.0, 16.0  # mm: a traction panel; labels of a block
BASES = (42.0, 34.0, 28.0)  # mm: caption, legend and title below and above one, two or three panels beside each other
SIDE, GAP = 28.0, 4.0  # mm of the figure's width that axis labels and colour bar take, and between panels
CAPTION = (
    "{counted}, {kinematics}, {when}; displacements to scale. Strain: square-root scale. Change: from the pre-indented"
    " state, at the same points of tissue. Where bars end in a point colours are clipped: {strain:g} % of the area in"
    " view is strained less, {change:g} % and all receptors change less. White lines: interfaces of layers. Tractions:"
    " linear between nodes."
)
AT_END, WHEN_READ = "at the end of the stimulus", "when strain at the receptors has changed most, as scores are"
NARROWEST = 1.2  # width of a map, of its height [1], however few the actuators are
SLACK = 1.15  # height that maps are given, of what they need [1]: so the width decides, and tractions lie beneath
STEP, CHANGE_STEP = 5.0, 0.5  # per cent of strain, and of its change, to which the colours' end is rounded up
HEADROOM = 1.08  # of the tractions' axis beyond the largest [1]
STRAIN_NAME = {Kinematics.SMALL: "strain", Kinematics.FINITE: "log. strain"}
COLOURS = "viridis"  # perceptually uniform, and monotonic in grey
SHEAR_LINE = 0.6  # pt
EDGE = 0.3  # pt, on either side of white lines, so that they are seen on bright colours
LAYERS: dict[str, Any] = {
    "color": "white",
    "linewidth": THIN,
    "solid_capstyle": "round",
    "path_effects": [Stroke(linewidth=THIN + 2.0 * EDGE, foreground="#404040"), Normal()],
}
OUTSIDE: dict[str, Any] = {"color": "black", "linewidth": THIN, "solid_capstyle": "round"}
BENEATH: dict[str, Any] = {"color": "white", "linewidth": 1.5}  # dashes of the receptor line
RECEPTORS: dict[str, Any] = {"color": VERMILLION, "linewidth": 1.1, "linestyle": (0, (2.4, 1.3))}
CHANGE_COLOURS = "cividis"  # blue is less, yellow more, whichever colours one sees; darker and lighter in print

Window = tuple[tuple[float, float], tuple[float, float]]  # ((left, right), (bottom, top)) that is shown [mm]


@styled
def strain_map_figure(
    scene: Scene,
    dispersion: str,
    fields: Fields,
    solutions: Mapping[str, Solution],
) -> Figure:
    """Maximum principal strain when receptors are read, its change and contact tractions, with shear, a column of
    panels a condition.

    fields: a loading for each distinct stimulus of the device, in the order of its conditions. solutions: of these, by
    condition. Scales are common to all figures of one device.
    """
    device = scene.device
    columns = _columns(device, dispersion, solutions)
    window = _window(scene, max(solution.height for solution in solutions.values()))
    shown = _in_view(fields, window)
    panels = _new_panels(window, len(columns))
    read = max(
        float(np.abs(each.reading.readouts[Readout.CHANGE_OF_STRAIN]).max(initial=0.0)) for each in solutions.values()
    )
    for row, mapped in ((panels.strain, _strain(scene, shown)), (panels.change, _change(scene, shown, read))):
        for axes, column in zip(row, columns, strict=True):
            drawn = _draw_map(axes, shown, mapped, column.loading)
            _draw_surroundings(axes, device.actuators, column, window)
        _label_first(row, panels.columns, "y (mm)")
        panels.figure.colorbar(
            drawn, ax=list(row[: panels.columns]), extend=mapped.extend, aspect=14, pad=0.01, label=mapped.label
        )
    limits = _traction_limits(solutions)
    for axes, column in zip(panels.tractions, columns, strict=True):
        _draw_tractions(axes, device.actuators, column)
        axes.set(ylim=limits, xlabel="x (mm)")
    _label_first(panels.tractions, panels.columns, "Traction (kPa)")
    _title(panels, device, dispersion)
    conditions = device.by_dispersion[dispersion]
    legend_below(
        panels.figure,
        [
            Patch(facecolor=INTO, edgecolor=INTO_EDGE, label="contact pressure"),
            Line2D([], [], color=ALONG, label="shear traction on the skin, towards +x"),
            Line2D([], [], **RECEPTORS, label="receptors"),
        ],
        CAPTION.format(
            counted=counted(conditions),
            kinematics=KINEMATICS_NAME[scene.kinematics],
            strain=COVERED,
            change=CHANGE_COVERED,
            when=WHEN_READ if any(condition.time.size > 1 for condition in conditions) else AT_END,
        ),
    )
    return panels.figure


@dataclass(frozen=True)
class _Column:
    """A condition, which of the fields' loadings is its own, and the solution of its stimulus."""

    condition: Condition
    loading: int
    solution: Solution


def _columns(device: Device, dispersion: str, solutions: Mapping[str, Solution]) -> list[_Column]:
    """The conditions of a dispersion, in order."""
    distinct = [condition.name for condition in device.distinct_conditions]
    found = []
    for condition in device.by_dispersion[dispersion]:
        first = device.first_with_stimulus_of(condition.name).name
        found.append(_Column(condition, distinct.index(first), solutions[first]))
    return found


def _title(panels: _Panels, device: Device, dispersion: str) -> None:
    """Name the conditions above their maps, and the device and dispersion above all."""
    styles = condition_styles(each for each in conditions_of([device]) if each.dispersion == dispersion)
    for axes, condition in zip(panels.strain, device.by_dispersion[dispersion], strict=True):
        axes.set_title(styles.series[device.name, condition.name].label, loc="left")
    named = f", {plain(dispersion)} dispersion" if len(device.by_dispersion) > 1 else ""
    title = as_title(panels.figure, f"{device.title}{named}, with shear")
    panels.figure.suptitle(title, fontweight="bold")


def _window(scene: Scene, face: float) -> Window:
    """What maps show: the row and the pad above its faces, which are at a height [mm]."""
    bottom, top = face - BELOW, scene.model.finger.pad_thickness + ABOVE
    reach = max(scene.device.actuators.reach + ASIDE, (top - bottom) * NARROWEST / 2.0)
    return (-reach, reach), (bottom, top)


@dataclass(frozen=True)
class _Panels:
    """A figure and its panels, for each condition one of a kind, so many columns of them beside each other."""

    figure: Figure
    columns: int
    strain: list[Axes]
    change: list[Axes]
    tractions: list[Axes]


def _new_panels(window: Window, count: int) -> _Panels:
    """Panels of maps that show a window, for `count` conditions, in blocks of as many as fit beside each other."""
    (left, right), (bottom, top) = window
    columns = min(count, len(WIDTHS))
    blocks = math.ceil(count / columns)
    width = WIDTHS[columns - 1]
    map_height = SLACK * ((width - SIDE + GAP) / columns - GAP) * (top - bottom) / (right - left)
    height = blocks * (2.0 * map_height + TRACTION_HEIGHT + FURNITURE) + BASES[columns - 1]
    figure = new_figure(width, height)
    grid = figure.subplots(
        3 * blocks,
        columns,
        squeeze=False,
        sharex=True,
        height_ratios=[map_height, map_height, TRACTION_HEIGHT] * blocks,
    )
    kinds = [list(grid[number::3].ravel()) for number in range(3)]
    for axes in (each for kind in kinds for each in kind[count:]):
        axes.remove()
    return _Panels(figure, columns, *(kind[:count] for kind in kinds))


def _label_first(panels: Sequence[Axes], columns: int, label: str) -> None:
    """Label the vertical axes of the first column alone: the others share it."""
    for number, axes in enumerate(panels):
        axes.tick_params(labelleft=number % columns == 0)
    for axes in panels[::columns]:
        axes.set_ylabel(label)


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


@dataclass(frozen=True)
class _Mapped:
    """Values (n_loadings, 3k) [1] that maps show, their colours, and what the colour bar says: its label, and which of
    its ends are open.
    """

    values: FloatArray
    norm: Normalize
    colours: str
    label: str
    extend: str


def _strain(scene: Scene, shown: _Shown) -> _Mapped:
    return _Mapped(
        values=shown.strain,
        norm=PowerNorm(0.5, 0.0, _colour_end(shown, shown.strain, COVERED, STEP)),
        colours=COLOURS,
        label=f"Max. principal\n{STRAIN_NAME[scene.kinematics]} (%)",
        extend="max",
    )


def _change(scene: Scene, shown: _Shown, read: float) -> _Mapped:
    """Change of strain. read: the largest at the receptors [1], which colours tell apart."""
    most = CHANGE_STEP * math.ceil(PERCENT * read / CHANGE_STEP)
    end = max(_colour_end(shown, np.abs(shown.change), CHANGE_COVERED, CHANGE_STEP), most)
    return _Mapped(
        values=shown.change,
        norm=Normalize(-end, end),
        colours=CHANGE_COLOURS,
        label=f"Change of\n{STRAIN_NAME[scene.kinematics]} (%)",
        extend="both",
    )


def _colour_end(shown: _Shown, values: FloatArray, covered: float, step: float) -> float:
    """Value [%] at which colours end: so many per cent of the area in view, over all loadings, have less.

    values: (n_loadings, 3k) [1], none below zero. covered: share [%]. step: [%] to which it is rounded up.
    """
    corners = shown.fields.corner.T[shown.elements]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    means = values.reshape(len(values), -1, 3).mean(axis=2)
    value = np.percentile(means, covered, weights=np.tile(area, (len(means), 1)), method="inverted_cdf")
    return step * max(math.ceil(PERCENT * float(value) / step), 1)


def _draw_map(axes: Axes, shown: _Shown, mapped: _Mapped, loading: int) -> TriMesh:
    """Values on the deformed elements, rasterised; the layers' interfaces, receptors and the boundary as lines."""
    fields = shown.fields
    moved = fields.corner + fields.displacement[loading]
    at = moved[:, shown.elements.ravel()]
    drawn = axes.tripcolor(
        Triangulation(at[0], at[1], np.arange(at.shape[1]).reshape(-1, 3)), PERCENT * mapped.values[loading],
        shading="gouraud", cmap=mapped.colours, norm=mapped.norm, rasterized=True,
    )  # fmt: skip
    interface, receptors, boundary = (
        facets[np.isin(facets, shown.elements).any(axis=1)]
        for facets in (fields.interface, fields.receptors, fields.boundary)
    )
    for facets, look in ((interface, LAYERS), (boundary, OUTSIDE)):
        # a gap after each facet
        x, y = np.pad(moved[:, facets], ((0, 0), (0, 0), (0, 1)), constant_values=np.nan).reshape(2, -1)
        axes.plot(x, y, **look)
    x, y = moved[:, receptors.ravel()]
    order = np.argsort(x, kind="stable")  # one line from left to right, along which dashes run on
    for look in (BENEATH, RECEPTORS):
        axes.plot(x[order], y[order], **look)
    return drawn


def _draw_surroundings(axes: Axes, row: ActuatorRow, column: _Column, window: Window) -> None:
    """The actuators below a map, where they are then, and the bone's name above it."""
    moves = column.condition.moves[column.solution.reading.time]
    draw_actuators(axes, row, moves + np.array([0.0, column.solution.height]), 2.0 * BELOW)
    axes.set(xlim=window[0], ylim=window[1], aspect="equal", anchor="S")
    axes.text(0.0, window[1][1] - ABOVE / 2.0, "bone", ha="center", va="center", color=GREY)


def _draw_tractions(axes: Axes, row: ActuatorRow, column: _Column) -> None:
    """Pressure and shear of the nodes in contact, one line per actuator."""
    solution = column.solution
    x = solution.skin_x(row, column.condition)
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    axes.tick_params(labelbottom=True)
    pressure, shear = KILO * solution.pressure, KILO * solution.shear
    for number in range(len(row.positions)):
        own = np.flatnonzero(solution.actuator == number)
        touched = own[pressure[own] > 0.0]
        if touched.size == 0:
            continue
        shown = own[(own >= touched[0] - 1) & (own <= touched[-1] + 1)]  # from and to a node without contact
        axes.fill_between(x[shown], pressure[shown], color=INTO, linewidth=0.0)
        axes.plot(x[shown], pressure[shown], color=INTO_EDGE, linewidth=THIN)
        axes.plot(x[shown], shear[shown], color=ALONG, linewidth=SHEAR_LINE)


def _traction_limits(solutions: Mapping[str, Solution]) -> tuple[float, float]:
    """Ends [kPa] of the tractions' axis, common to all, with zero between them, from which areas of pressure rise."""
    found = KILO * np.array([traction for each in solutions.values() for traction in (each.pressure, each.shear)])
    return HEADROOM * min(float(found.min()), 0.0), HEADROOM * float(found.max())
