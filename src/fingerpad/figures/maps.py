"""Strain maps on the deformed section with the contact tractions beneath, for one device and dispersion.

Nodal tractions of second-order elements alternate between vertices and midpoints, as a nodal force divided by a
node's share of skin does not follow a kinked traction. What is drawn is the mean over each element, by Simpson's rule
on its three nodes: it is smooth, and its integral is the contact force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.tri import Triangulation

from ..compliance import CondensedSection
from ..fields import Fields
from ..mesh import SectionMesh
from ..scene import ActuatorRow, Condition, FloatArray, Scene
from ..solution import Solution
from .outline import actuator_shapes, layer_lines
from .style import (  # fmt: skip
    BLUE,
    GREY,
    LINES,
    PERCENT,
    THIN,
    VERMILLION,
    WIDE,
    condition_styles,
    conditions_of,
    legend_below,
    new_figure,
    styled,
)

COLUMNS = 3  # panels beside each other
ASIDE, BELOW, ABOVE = 1.5, 0.9, 0.9  # mm shown beside the row, below the faces and above the pad's tissue
TRACTION_HEIGHT, FURNITURE, BASE = 24.0, 16.0, 22.0  # mm: a traction panel; labels of a block; legend and title
SIDE = 34.0  # mm of the figure's width that axis labels and colour bar take
COVERED = 99.5  # per cent of the area in view that the colours tell apart; the rest is beyond the end of the bar
STEP = 5.0  # per cent of strain to which the colours' end is rounded up
KILO = 1e3  # kPa in a MPa
MIDPOINT = 0.5  # weight over distance of a node's neighbours [1]: 2/3 at midpoints, 1/3 at vertices (Simpson)
COLOURS = "viridis"  # perceptually uniform, and monotonic in grey


@styled
def strain_map_figure(
    scene: Scene,
    dispersion: str,
    section: SectionMesh,
    fields: Fields,
    contact: CondensedSection,
    solutions: Mapping[str, Solution],
) -> Figure:
    """Maximum principal strain at the end of the stimulus and contact tractions, with shear, a panel a condition.

    fields: a loading for each distinct stimulus of the device, in the order of its conditions. solutions: by
    condition, for all of the dispersion. The colours are common to all figures of one device.
    """
    device, pad = scene.device, scene.model.finger.pad_thickness
    conditions = [condition for condition in device.conditions if condition.dispersion == dispersion]
    distinct = [c.name for c in device.conditions if device.first_with_stimulus_of(c.name) is c]
    face = max(solution.indentation for solution in solutions.values())
    reach = max(abs(x) for x in device.actuators.positions) + device.actuators.width / 2.0 + ASIDE
    window = ((-reach, reach), (face - BELOW, pad + ABOVE))
    end = colour_end(fields, window)

    columns = min(len(conditions), COLUMNS)
    blocks = math.ceil(len(conditions) / columns)
    map_height = (WIDE - SIDE) / COLUMNS * (window[1][1] - window[1][0]) / (2.0 * reach)
    height = blocks * (map_height + TRACTION_HEIGHT + FURNITURE) + BASE
    figure = new_figure(WIDE * columns / COLUMNS if columns > 1 else WIDE / 2.0, height)
    grid = figure.subplots(
        2 * blocks, columns, squeeze=False, sharex=True, height_ratios=[map_height, TRACTION_HEIGHT] * blocks
    )
    maps, tractions = grid[0::2].ravel(), grid[1::2].ravel()
    styles = condition_styles(conditions_of([device]))
    largest = KILO * max(float(solution.pressure.max()) for solution in solutions.values())
    for axes, beneath, condition in zip(maps, tractions, conditions, strict=False):
        loading = distinct.index(device.first_with_stimulus_of(condition.name).name)
        solution = solutions[condition.name]
        drawn = _draw_map(axes, section, fields, loading, end)
        _draw_actuators(axes, device.actuators, condition, solution.indentation)
        axes.set(xlim=window[0], ylim=window[1], aspect="equal")
        axes.text(0.0, pad + ABOVE / 2.0, "bone", ha="center", va="center", color=GREY)
        axes.set_title(styles.series[device.name, condition.name].label, loc="left")
        _draw_tractions(beneath, device.actuators, contact, solution, condition)
        beneath.set_ylim(-0.75 * largest, 1.05 * largest)
        beneath.set_xlabel("x (mm)")
    for axes in (*maps[len(conditions) :], *tractions[len(conditions) :]):
        axes.remove()
    for first, beneath in zip(maps[::columns], tractions[::columns], strict=True):
        first.set_ylabel("y (mm)")
        beneath.set_ylabel("Traction (kPa)")
    figure.colorbar(drawn, ax=list(maps[: len(conditions)]), extend="max", label="Max. principal strain (%)", aspect=14, pad=0.01)  # fmt: skip
    figure.suptitle(f"{device.title}, {dispersion} dispersion, with shear", fontweight="bold")
    legend_below(
        figure,
        [
            Line2D([], [], color=BLUE, linestyle=LINES[0], label="contact pressure"),
            Line2D([], [], color=VERMILLION, linestyle=LINES[1], label="shear traction on the skin, along x"),
        ],
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


def element_means(row: ActuatorRow, contact: CondensedSection, nodal: FloatArray) -> tuple[np.ndarray, FloatArray]:
    """Midpoint node (k,) of every skin element under an actuator, and the element's mean (k,) of a nodal traction (n,).

    The mean is (left + 4 middle + right) / 6. Elements that the candidate nodes cut off are left out.
    """
    inner = np.arange(1, len(nodal) - 1)
    distance = np.hypot(*(contact.position[2:] - contact.position[:-2]).T)
    nearest = np.argmin(np.abs(contact.position[:, [0]] - np.asarray(row.positions)), axis=1)
    whole = nearest[:-2] == nearest[2:]
    middle = inner[whole & (contact.weight[1:-1] > MIDPOINT * distance)]
    return middle, (nodal[middle - 1] + 4.0 * nodal[middle] + nodal[middle + 1]) / 6.0


def _draw_map(axes: Axes, section: SectionMesh, fields: Fields, loading: int, end: float) -> object:
    """Strain on the deformed elements, rasterised, and the layers' interfaces as lines."""
    moved = fields.corner + fields.displacement[loading]
    triangles = np.arange(moved.shape[1]).reshape(-1, 3)
    drawn = axes.tripcolor(
        Triangulation(*moved, triangles), PERCENT * fields.strain[loading], shading="gouraud", cmap=COLOURS, vmin=0.0,
        vmax=end, rasterized=True,
    )  # fmt: skip
    vertices = np.empty((2, section.mesh.nvertices))
    vertices[:, section.mesh.t.T.ravel()] = moved
    lines = vertices[:, section.mesh.facets[:, layer_lines(section)]].transpose(2, 1, 0)
    axes.add_collection(LineCollection(list(lines), colors="white", linewidths=THIN, capstyle="round"))
    return drawn


def _draw_actuators(axes: Axes, row: ActuatorRow, condition: Condition, height: float) -> None:
    """Actuators where they end up; the body of a deformable one undeformed (it yields by less than a line's width)."""
    depth = row.body.thickness if row.body else BELOW + abs(float(condition.normal[-1].min()))
    for shape, x, y in zip(actuator_shapes(row, depth), condition.tangential[-1], condition.normal[-1], strict=True):
        placed = shape + np.array([x, height + y])
        axes.add_patch(Polygon(placed, closed=True, facecolor="#C8C8C8", edgecolor="black", linewidth=THIN))
        if row.body:
            axes.plot(placed[[0, -1], 0], placed[[0, -1], 1], color="black", linewidth=2.0, solid_capstyle="butt")


def _draw_tractions(
    axes: Axes, row: ActuatorRow, contact: CondensedSection, solution: Solution, condition: Condition
) -> None:
    """Mean pressure and shear of the elements in contact, one line an actuator."""
    nearest = np.argmin(np.abs(contact.position[:, [0]] - np.asarray(row.positions)), axis=1)
    centre = np.asarray(row.positions) + condition.tangential[-1]
    axes.axhline(0.0, color=GREY, linewidth=THIN)
    for nodal, colour, line in ((solution.pressure, BLUE, LINES[0]), (solution.shear, VERMILLION, LINES[1])):
        middle, mean = element_means(row, contact, KILO * nodal)
        for number in range(len(row.positions)):
            own = middle[nearest[middle] == number]
            x = centre[number] + solution.place[own]
            values = mean[nearest[middle] == number]
            touched = np.flatnonzero(solution.pressure[own] > 0.0)
            shown = slice(max(int(touched[0]) - 1, 0), int(touched[-1]) + 2) if touched.size else slice(0)
            axes.plot(x[shown], values[shown], color=colour, linestyle=line)
