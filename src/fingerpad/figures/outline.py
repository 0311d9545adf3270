"""Lines and shapes of a section and its actuators, as figures draw them [mm]."""

from __future__ import annotations

import numpy as np

from ..mesh import SectionMesh
from ..profile import profile
from ..scene import ActuatorRow, FloatArray

PROFILE_POINTS = 41  # along a rounded edge [1]


def layer_lines(section: SectionMesh) -> np.ndarray:
    """Facets (k,) between two layers, or on the outside."""
    left, right = section.mesh.f2t
    return np.flatnonzero((right < 0) | (section.layer[left] != section.layer[right]))


def curved_lines(section: SectionMesh, facets: np.ndarray) -> FloatArray:
    """Undeformed facets (k, 3, 2): end, midpoint, end."""
    ends = section.mesh.facets[:, facets]
    middle = section.mesh.nvertices + facets
    return np.asarray(section.mesh.doflocs[:, np.stack([ends[0], middle, ends[1]], axis=1)].transpose(1, 2, 0))


def actuator_shapes(row: ActuatorRow, depth: float) -> list[FloatArray]:
    """Outline (m, 2) of each actuator, its face on y = 0, its sides down to -depth."""
    half = row.width / 2.0
    rounded = np.linspace(row.half_face, half, PROFILE_POINTS)
    x = np.concatenate([-rounded[::-1], rounded])
    drop, _ = profile(row, x)
    x, y = np.concatenate([[-half], x, [half]]), np.concatenate([[-depth], -drop, [-depth]])
    return [np.stack([x + centre, y], axis=1) for centre in row.positions]


def touching_face(section: SectionMesh, row: ActuatorRow) -> float:
    """Height [mm] of the faces where the undeformed skin first touches one."""
    skin = section.mesh.doflocs[:, section.skin]
    heights = []
    for centre in row.positions:
        x, y = skin[:, np.abs(skin[0] - centre) <= row.width / 2.0]
        heights.append(float((y + profile(row, x - centre)[0]).min()))
    return min(heights)
