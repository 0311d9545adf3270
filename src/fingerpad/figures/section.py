"""The finger's section with its layers, and the devices' actuators below it, undeformed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.figure import Figure
from matplotlib.path import Path
from matplotlib.ticker import MultipleLocator

from ..arrays import FloatArray
from ..contact.profile import touching_heights
from ..scene.device import ActuatorRow, Device
from ..scene.finger import Material
from ..scene.scene import Model
from ..tissue.mesh import SectionMesh, element_nodes
from ..words import KILO, plain
from .actuators import BASE, draw_actuators
from .style import THIN, VERMILLION, WIDE, as_title, fitted, letter, new_figure, styled, subtitle

HEIGHT, ROW_HEIGHT = 76.0, 37.0  # mm: of the whole section, and of a row of devices whose bases are thin
PANEL = 49.0  # mm of the figure's width across a device
NU = "\N{GREEK SMALL LETTER NU}"
CAPTION = (
    f"Undeformed, at first touch. E: Young's modulus, {NU}: Poisson's ratio. Arrows: directions in which the actuators"
    " are driven."
)
COLUMNS = 3  # devices beside each other
LETTER_WHOLE, LETTER_DEVICES = (-12.0, -8.0), (-26.0, 26.0)  # of letters from panels' upper left corners [pt]
LABELS = 1.075  # of the finger's half width [1]: from the mid-line to where the layers' names begin
BONE_LABEL = (0.3, 0.7)  # of the bone's width and height [1]: the point that its name is for
DIMENSION = 0.7  # mm from the section to its dimensions
MARGIN, TOP = 1.6, 0.3  # mm shown beside the section and below it, and above
TINTS = ("#E9C9A3", "#F7E6D0", "#F3C1AC", "#FBEBC4", "#AEBBC8", "#E3B0BE")  # of the layers, which are named as well
ASIDE, ABOVE = 0.8, 1.7  # mm shown beside the row, and above the lowest skin at least
OVER = 0.3  # mm shown above the skin over the outermost faces
REACH = 5.3  # mm from the mid-line to which panels show a row, above which what follows grows with it
DEPTH, BELOW = 0.9, 1.2  # mm of a rigid actuator that is drawn, and that are shown below the lowest skin, at least
LEADER = {"arrowstyle": "-", "linewidth": THIN, "shrinkA": 1.0, "shrinkB": 0.0, "relpos": (0.0, 0.5)}
DOUBLE = {"arrowstyle": "<->", "shrinkA": 0.0, "shrinkB": 0.0}
HEAD, DRIVEN = 5.0, 0.8  # pt: arrow heads, and lines of the arrows that show how actuators are driven
ARROW = 0.8  # mm, length of these arrows


@styled
def section_figure(model: Model, section: SectionMesh, devices: Sequence[Device]) -> Figure:
    """The whole section (A) and the pad with each device's actuators at first touch (B), undeformed, in mm."""
    columns = min(len(devices), COLUMNS)
    blocks = math.ceil(len(devices) / columns)
    rows = [device.actuators for device in devices]
    outermost = max(row.reach for row in rows)
    reach = outermost + ASIDE
    size = max(1.0, reach / REACH)
    below = max([BELOW * size, *(_arrow_depth(row, size) + ARROW * size / 2.0 for row in rows)])
    over = model.finger.skin_height(np.array([min(outermost, model.finger.width / 2.0)]))
    above = max(ABOVE, float(over[0]) + OVER)
    row_height = ROW_HEIGHT + (below - BELOW * size + above - ABOVE) * PANEL / (2.0 * size * REACH)
    figure = new_figure(WIDE, HEIGHT + row_height * blocks)
    grid = figure.add_gridspec(1 + blocks, columns, height_ratios=[HEIGHT, *[row_height] * blocks])
    whole = figure.add_subplot(grid[0, :])
    _draw_section(whole, section)
    _label(whole, model, section)
    letter(whole, "A", LETTER_WHOLE)
    for number, device in enumerate(devices):
        block, column = divmod(number, columns)
        axes = figure.add_subplot(grid[1 + block, column])
        _draw_device(axes, section, device, size)
        axes.set(xlim=(-reach, reach), ylim=(-below, above))
        subtitle(axes, as_title(figure, device.title, columns), _described(device.actuators))
        axes.set_xlabel("x (mm)")
        axes.xaxis.set_major_locator(MultipleLocator(2.0))
        if column == 0:
            axes.set_ylabel("y (mm)")
        if number == 0:
            letter(axes, "B", LETTER_DEVICES)
    figure.supxlabel(fitted(figure, CAPTION), fontsize="medium")
    return figure


def _draw_section(axes: Axes, section: SectionMesh) -> None:
    """Layers in their tints, their interfaces, and the receptor line."""
    mesh = section.mesh
    # where elements of one path turn alike, no seams show
    around = mesh.doflocs[:, element_nodes(mesh).T[[0, 3, 1, 4, 2, 5, 0]]]
    turn = [Path.MOVETO, *[Path.LINETO] * 5, Path.CLOSEPOLY]
    paths = []
    for number in range(section.layer.max() + 1):
        own = around[:, :, section.layer == number].T.reshape(-1, 2)
        paths.append(Path(own, np.tile(turn, len(own) // len(turn))))
    tints = [TINTS[number % len(TINTS)] for number in range(len(paths))]
    axes.add_collection(PathCollection(paths, facecolors=tints, linewidths=0.0, rasterized=True), autolim=False)
    lines = _curved_lines(section, np.concatenate([section.interfaces(), mesh.boundary_facets()]))
    axes.add_collection(LineCollection(list(lines), colors="black", linewidths=THIN, capstyle="round"))
    receptors = _curved_lines(section, section.receptor_facets)
    axes.add_collection(LineCollection(list(receptors), colors=VERMILLION, linewidths=1.0, capstyle="round"))
    axes.set_aspect("equal")


def _curved_lines(section: SectionMesh, facets: np.ndarray) -> FloatArray:
    """Undeformed facets (k, 3, 2): end, midpoint, end."""
    ends = section.mesh.facets[:, facets]
    middle = section.mesh.nvertices + facets
    return np.asarray(section.mesh.doflocs[:, np.stack([ends[0], middle, ends[1]], axis=1)].transpose(1, 2, 0))


def _label(axes: Axes, model: Model, section: SectionMesh) -> None:
    """Names and thicknesses of layers with leaders to them, and the section's dimensions."""
    finger = model.finger
    half, height = finger.width / 2.0, finger.height
    labels = LABELS * half
    mesh = section.mesh
    centre = mesh.doflocs[:, mesh.t].mean(axis=1)
    layers = (*finger.pad, *reversed(finger.dorsal))
    parts = [
        (
            plain(la.name),
            f"{la.thickness:g} mm, {_stiffness(la.material)}",
            centre[:, section.layer == finger.layers.index(la)],
        )
        for la in layers
    ]
    inside_bone = np.array(
        [[BONE_LABEL[0] * finger.bone_width], [finger.pad_thickness + BONE_LABEL[1] * finger.bone_height]]
    )
    parts.insert(len(finger.pad), ("bone", "rigid", inside_bone))
    receptors = mesh.doflocs[:, mesh.nvertices + section.receptor_facets]
    parts.insert(model.layers_above, ("receptors", f"{model.receptor_depth:g} mm deep", receptors))
    for number, (name, size, points) in enumerate(parts):
        place = np.array([labels, (number + 0.5) / len(parts) * height])
        target = points[:, np.argmin(np.hypot(*(points - place[:, None])))]
        colour = VERMILLION if name == "receptors" else "black"
        axes.annotate(
            f"{name}, {size}", tuple(target), tuple(place), va="center", color=colour,
            arrowprops={"color": colour, **LEADER},
        )  # fmt: skip
        axes.plot(*target, marker="o", markersize=1.5, color=colour)
    _dimension(axes, (-half, -DIMENSION), (half, -DIMENSION), f"{finger.width:g} mm")
    _dimension(axes, (-half - DIMENSION, 0.0), (-half - DIMENSION, height), f"{height:g} mm")
    middle = finger.pad_thickness + finger.bone_height / 2.0
    _dimension(axes, (-finger.bone_width / 2.0, middle), (finger.bone_width / 2.0, middle), f"{finger.bone_width:g} mm")
    axes.set(xlim=(-half - MARGIN, 2.0 * half), ylim=(-MARGIN, height + TOP))
    axes.set_axis_off()


def _stiffness(material: Material) -> str:
    """Young's modulus, in kPa below one MPa, and Poisson's ratio."""
    modulus = f"{material.modulus:g} MPa" if material.modulus >= 1.0 else f"{KILO * material.modulus:g} kPa"
    return f"E {modulus}, {NU} {material.poisson:g}"


def _dimension(axes: Axes, start: tuple[float, float], stop: tuple[float, float], text: str) -> None:
    """A dimension line with its value on it."""
    axes.annotate("", start, stop, arrowprops={"linewidth": THIN, **DOUBLE})
    upright = start[0] == stop[0]
    middle = ((start[0] + stop[0]) / 2.0, (start[1] + stop[1]) / 2.0)
    axes.annotate(
        text, middle, rotation=90.0 if upright else 0.0, ha="center", va="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
    )  # fmt: skip


def _draw_device(axes: Axes, section: SectionMesh, device: Device, size: float) -> None:
    """The pad above a device's actuators at first touch, and how they are driven.

    size: of arrows and of what is drawn of rigid actuators, where 1 is that of rows within REACH [1].
    """
    row = device.actuators
    _draw_section(axes, section)
    face = np.array([0.0, touching_heights(row, section.mesh.doflocs[:, section.skin].T).min()])
    draw_actuators(axes, row, np.tile(face, (len(row.positions), 1)), DEPTH * size)
    moves = np.any([each.moves.any(axis=(0, 2)) for each in device.conditions], axis=0)
    for x in np.asarray(row.positions)[moves]:
        middle = face + np.array([x, -_arrow_depth(row, size)])
        for direction, heads in _directions(device):
            half = ARROW * size / 2.0 * np.array(direction)
            axes.annotate(
                "", tuple(middle - half), tuple(middle + half),
                arrowprops={"linewidth": DRIVEN, "mutation_scale": HEAD, **DOUBLE, "arrowstyle": heads},
            )  # fmt: skip


def _arrow_depth(row: ActuatorRow, size: float) -> float:
    """Depth [mm] below the faces at which a row's arrows have their middle: under the base of deformable actuators."""
    return row.body.thickness + BASE + ARROW * size / 2.0 if row.body else DEPTH * size / 2.0


def _directions(device: Device) -> list[tuple[tuple[float, float], str]]:
    """Directions in which actuators are driven, as unit vectors: one if they move as far along the skin as into it.
    With each the heads of its arrow: at one end if no actuator goes the other way, and none would in a cycle.
    """
    if all(np.array_equal(each.normal, each.tangential) for each in device.conditions):
        axes = {"normal": (math.sqrt(0.5), math.sqrt(0.5))}
    else:
        axes = {"normal": (0.0, 1.0), "tangential": (1.0, 0.0)}
    moved = {driven: np.concatenate([getattr(each, driven).ravel() for each in device.conditions]) for driven in axes}
    return [(unit, _heads(moved[driven], bool(device.cycles))) for driven, unit in axes.items() if moved[driven].any()]


def _heads(moved: FloatArray, cyclic: bool) -> str:
    """Style of an arrow, from its far end, for what actuators move by (n,) [mm]."""
    if cyclic or (moved.min() < 0.0 < moved.max()):
        return "<->"
    return "<-" if moved.max() > 0.0 else "->"


def _described(row: ActuatorRow) -> str:
    """The row's dimensions in words."""
    pitches = {round(right - left, 6) for left, right in pairwise(row.positions)}
    pitch = f"pitch {pitches.pop():g}, " if len(pitches) == 1 else ""
    thick = f", thickness {row.body.thickness:g}" if row.body else ""
    kind = "deformable" if row.body else "rigid"
    return f"{kind}, {pitch}width {row.width:g} mm\nedge radius {row.edge_radius:g}{thick} mm"
