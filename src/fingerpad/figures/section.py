"""The finger's section with its layers, and the devices' actuators below it, undeformed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.tri import Triangulation

from ..mesh import SectionMesh
from ..scene import ActuatorRow, Device, Model
from .outline import actuator_shapes, curved_lines, layer_lines, touching_face
from .style import GREY, THIN, VERMILLION, WIDE, letter, new_figure, styled

HEIGHT, ROW_HEIGHT = 96.0, 32.0  # mm: of the figure at least, and for each device
WIDTHS = (1.18, 1.0)  # of the columns, relative
LABELS = 8.6  # mm from the mid-line at which the layers' names begin, of a finger of half width 8 mm
TINTS = ("#E9C9A3", "#B98553", "#F3C1AC", "#FBEBC4", "#AEBBC8", "#E3B0BE")  # of the layers, which are named as well
ACTUATOR = "#C8C8C8"
DEPTH = 0.9  # mm of a rigid actuator that is drawn
ASIDE, ABOVE, BELOW = 0.9, 2.6, 1.5  # mm shown beside the row, above the lowest skin and below it
ARROW = 0.7  # mm, length of the arrows that show how actuators are driven


@styled
def section_figure(model: Model, section: SectionMesh, devices: Sequence[Device]) -> Figure:
    """The whole section (A) and the pad with each device's actuators at first touch (B), undeformed, in mm."""
    figure = new_figure(WIDE, max(HEIGHT, ROW_HEIGHT * len(devices)))
    grid = figure.add_gridspec(len(devices), 2, width_ratios=WIDTHS)
    whole = figure.add_subplot(grid[:, 0])
    _draw_section(whole, section)
    _label(whole, model, section)
    letter(whole, "A", (0.0, 4.0))
    for number, device in enumerate(devices):
        axes = figure.add_subplot(grid[number, 1])
        _draw_device(axes, section, device)
        if number == 0:
            letter(axes, "B", (-30.0, 16.0))
        if number == len(devices) - 1:
            axes.set_xlabel("x (mm)")
    return figure


def _draw_section(axes: Axes, section: SectionMesh) -> None:
    """Layers in their tints, their interfaces, and the receptor line."""
    mesh = section.mesh
    first, second, third = mesh.t
    a, b, c = mesh.nvertices + mesh.t2f  # midpoints of the facets 0-1, 1-2 and 0-2
    quarters = np.hstack([np.array(t) for t in ((first, a, c), (a, second, b), (c, b, third), (a, b, c))])
    layers = len(section.layer_names)
    axes.tripcolor(
        Triangulation(*mesh.doflocs, quarters.T), facecolors=np.tile(section.layer, 4), rasterized=True, vmin=-0.5,
        vmax=layers - 0.5, cmap=ListedColormap([TINTS[i % len(TINTS)] for i in range(layers)]),
    )  # fmt: skip
    lines = curved_lines(section, layer_lines(section))
    axes.add_collection(LineCollection(list(lines), colors="black", linewidths=THIN, capstyle="round"))
    receptors = curved_lines(section, section.receptor_facets)
    axes.add_collection(LineCollection(list(receptors), colors=VERMILLION, linewidths=1.6, capstyle="round"))
    axes.set_aspect("equal")


def _label(axes: Axes, model: Model, section: SectionMesh) -> None:
    """Names and thicknesses of layers with leaders to them, and the section's dimensions."""
    finger = model.finger
    half, height = finger.width / 2.0, finger.height
    labels = LABELS / 8.0 * half
    centre = section.mesh.doflocs[:, section.mesh.t].mean(axis=1)
    parts = [(la.name.replace("_", " "), f"{la.thickness:g} mm", centre[:, section.layer == i])
             for i, la in enumerate((*finger.pad, *reversed(finger.dorsal)))]  # fmt: skip
    order = [section.layer_names.index(la.name) for la in (*finger.pad, *reversed(finger.dorsal))]
    for number, index in enumerate(order):
        name, thickness, _ = parts[number]
        parts[number] = (name, thickness, centre[:, section.layer == index])
    receptors = section.mesh.doflocs[:, section.mesh.nvertices + section.receptor_facets]
    parts.insert(len(finger.pad), ("bone", "rigid", np.array([[finger.bone_width / 4.0], [finger.pad_thickness + finger.bone_height / 2.0]])))  # fmt: skip
    epidermis = [la.name for la in finger.pad].index(model.readout.layer_above) + 1
    parts.insert(epidermis, ("receptors", f"{model.receptor_depth:g} mm deep", receptors))
    for number, (name, size, points) in enumerate(parts):
        place = np.array([labels, (number + 0.5) / len(parts) * height])
        target = points[:, np.argmin(np.hypot(*(points - place[:, None])))]
        colour = VERMILLION if name == "receptors" else "black"
        axes.annotate(
            f"{name}, {size}", tuple(target), tuple(place), va="center", color=colour,
            arrowprops={"arrowstyle": "-", "linewidth": THIN, "color": colour, "shrinkA": 1.0, "shrinkB": 0.0},
        )  # fmt: skip
        axes.plot(*target, marker="o", markersize=1.5, color=colour)
    _dimension(axes, (-half, -0.7), (half, -0.7), f"{finger.width:g} mm")
    _dimension(axes, (-half - 0.7, 0.0), (-half - 0.7, height), f"{height:g} mm")
    middle = finger.pad_thickness + finger.bone_height / 2.0
    _dimension(axes, (-finger.bone_width / 2.0, middle), (finger.bone_width / 2.0, middle), f"{finger.bone_width:g} mm")
    axes.set(xlim=(-half - 1.6, 2.0 * half), ylim=(-1.6, height + 0.3))
    axes.set_axis_off()


def _dimension(axes: Axes, start: tuple[float, float], stop: tuple[float, float], text: str) -> None:
    """A dimension line with its value on it."""
    axes.annotate("", start, stop, arrowprops={"arrowstyle": "<->", "linewidth": THIN, "shrinkA": 0.0, "shrinkB": 0.0})
    upright = start[0] == stop[0]
    middle = ((start[0] + stop[0]) / 2.0, (start[1] + stop[1]) / 2.0)
    axes.annotate(
        text, middle, rotation=90.0 if upright else 0.0, ha="center", va="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
    )  # fmt: skip


def _draw_device(axes: Axes, section: SectionMesh, device: Device) -> None:
    """The pad above a device's actuators at first touch, and how they are driven."""
    row = device.actuators
    _draw_section(axes, section)
    face = touching_face(section, row)
    depth = row.body.thickness if row.body else DEPTH
    normal = any(condition.normal.any() for condition in device.conditions)
    lateral = any(condition.tangential.any() for condition in device.conditions)
    for shape, x in zip(actuator_shapes(row, depth), row.positions, strict=True):
        placed = shape + np.array([0.0, face])
        axes.add_patch(Polygon(placed, closed=True, facecolor=ACTUATOR, edgecolor="black", linewidth=THIN))
        if row.body:
            axes.plot(placed[[0, -1], 0], placed[[0, -1], 1], color="black", linewidth=2.0, solid_capstyle="butt")
        for driven, (dx, dy) in ((normal, (0.0, ARROW)), (lateral, (ARROW, 0.0))):
            if driven:
                middle = face - (DEPTH / 2.0 if not row.body else row.body.thickness + 0.45)
                axes.annotate(
                    "", (x - dx / 2.0, middle - dy / 2.0), (x + dx / 2.0, middle + dy / 2.0),
                    arrowprops={"arrowstyle": "<->", "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 0.0},
                )  # fmt: skip
    reach = max(abs(x) for x in row.positions) + row.width / 2.0 + ASIDE
    axes.set(xlim=(-reach, reach), ylim=(-BELOW, ABOVE), ylabel="y (mm)")
    axes.set_title(f"{device.title}\n", loc="left")
    axes.set_title(_described(row), loc="left", fontsize="medium", fontweight="normal", color=GREY)


def _described(row: ActuatorRow) -> str:
    """The row's dimensions in words."""
    pitches = {round(right - left, 6) for left, right in zip(row.positions, row.positions[1:], strict=False)}
    pitch = f"pitch {pitches.pop():g}, " if len(pitches) == 1 else ""
    kind = f"deformable, {row.body.thickness:g} thick" if row.body else "rigid"
    return f"{pitch}width {row.width:g}, edge radius {row.edge_radius:g} mm; {kind}"
