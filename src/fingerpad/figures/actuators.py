"""A row of actuators, as figures draw it [mm]."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon, Rectangle

from ..arrays import FloatArray
from ..contact.profile import profile
from ..scene.device import ActuatorRow
from .style import THIN

PROFILE_POINTS = 41  # along a rounded edge [1]
SIDE_POINTS = 21  # along a side [1]
BASE = 0.25  # mm of a deformable actuator's rigid base that is drawn
FACE, UNDER = "#CFCFCF", "#5A5A5A"  # fill of actuators, and of the base of deformable ones


def draw_actuators(axes: Axes, row: ActuatorRow, offsets: FloatArray, depth: float) -> None:
    """Actuators moved by offsets (n_actuators, 2) from the row's position with faces on y = 0.

    Rigid ones end at `depth` below their faces; of deformable ones the body is drawn undeformed, on its base.
    """
    half = row.width / 2.0
    bottom = row.body.thickness if row.body else depth
    rounded = np.linspace(row.half_face, half, PROFILE_POINTS)
    x = np.concatenate([-rounded[::-1], rounded])
    drop, _ = profile(row, x)
    down = np.linspace(drop[-1], bottom, SIDE_POINTS)
    side = np.full_like(down, half)
    outline = np.concatenate([-side, x, side]), -np.concatenate([down[::-1], drop, down])
    shape = (row.body.placed(*outline) if row.body else np.stack(outline)).T
    for centre, offset in zip(row.positions, offsets, strict=True):
        placed = shape + offset + np.array([centre, 0.0])
        axes.add_patch(Polygon(placed, closed=True, facecolor=FACE, edgecolor="black", linewidth=THIN, zorder=2))
        if row.body:
            corner = (float(placed[0, 0]), float(placed[0, 1]) - BASE)
            wide = float(placed[-1, 0] - placed[0, 0])
            axes.add_patch(Rectangle(corner, wide, BASE, facecolor=UNDER, edgecolor="black", linewidth=THIN))
