"""Profile of an actuator: flat face with rounded edges, as gap and slope above a skin point.

In the actuator's frame the face lies on y = 0, the actuator below it. The profile is a drop d(x) >= 0: zero on the flat
face, a circle of the edge radius beyond, and from WALL_ANGLE on a straight wall.
"""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..scene.device import ActuatorRow

WALL_ANGLE = np.deg2rad(75.0)  # rad; beyond it the circle goes on as its tangent; source: skin wraps by less (measured)


def profile(row: ActuatorRow, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Drop d (n,) [mm] of the profile below its face, and its slope dd/dx (n,) [1], at x (n,) [mm] from its centre.

    d = r - sqrt(r^2 - b^2) with b the distance beyond the flat face and r the edge radius.

    >>> drop, slope = profile(ActuatorRow((0.0,), width=1.0, edge_radius=0.1), np.array([0.3, 0.46]))
    >>> drop.round(12).tolist(), slope.round(12).tolist()
    ([0.0, 0.02], [0.0, 0.75])
    """
    radius, beyond, wall = _edge(row, x)
    on_circle = np.minimum(beyond, wall)
    squared = on_circle * on_circle
    root = np.sqrt(radius**2 - squared)
    steepness = on_circle / root
    drop = squared / (radius + root) + (beyond - on_circle) * steepness  # r - root without its cancellation
    return drop, np.copysign(steepness, x)


def touching_heights(row: ActuatorRow, points: FloatArray) -> FloatArray:
    """Heights (n_actuators,) [mm] to which each actuator rises until it touches the first of the points (n, 2) [mm]
    that are nearest to it; infinite if there are none.

    >>> touching_heights(ActuatorRow((0.0, 2.0, 4.0), 1.0, 0.1), np.array([[0.1, 0.2], [0.46, 0.1], [2.0, 0.4]]))
    array([0.12, 0.4 ,  inf])
    """
    nearest = row.nearest(points[:, 0])
    height = points[:, 1] + profile(row, points[:, 0] - np.asarray(row.positions)[nearest])[0]
    return np.array([height[nearest == number].min(initial=np.inf) for number in range(len(row.positions))])


def bend(row: ActuatorRow, x: FloatArray) -> FloatArray:
    """Change of the slope along the face, d²d/dx² (n,) [1/mm], at x (n,) [mm]: r²(r² - b²)^(-3/2) on the circles.

    >>> bend(ActuatorRow((0.0,), width=1.0, edge_radius=0.1), np.array([0.3, 0.401])).round(2).tolist()
    [0.0, 10.0]
    """
    radius, beyond, wall = _edge(row, x)
    on_circle = (beyond > 0.0) & (beyond < wall)
    return np.where(on_circle, radius**2 * (radius**2 - np.minimum(beyond, wall) ** 2) ** -1.5, 0.0)


def _edge(row: ActuatorRow, x: FloatArray) -> tuple[float, FloatArray, float]:
    """Radius of the edges [mm], distance beyond the flat face (n,) [mm], and that at which the wall begins [mm]."""
    radius = row.corner_radius
    return radius, np.maximum(np.abs(x) - row.half_face, 0.0), float(radius * np.sin(WALL_ANGLE))
