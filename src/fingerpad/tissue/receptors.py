"""The receptor line: its points in order, their arc length, and the linear map from displacement to strain there."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_matrix

from ..arrays import FloatArray
from ..scene.scene import Scene
from .compliance import GRADIENT
from .elasticity import facet_gradient, strain_of_gradient
from .mesh import SectionMesh


def receptor_strain(section: SectionMesh, scene: Scene) -> tuple[FloatArray, csr_matrix]:
    """Receptor points (m, 2) [mm] and their strain (3m, n_unknowns), read from the side that the scene asks for."""
    points, gradient = receptor_gradient(section, scene)
    return points, strain_of_gradient(gradient)


def receptor_gradient(section: SectionMesh, scene: Scene) -> tuple[FloatArray, csr_matrix]:
    """Receptor points (m, 2) [mm] and their displacement gradient (4m, n_unknowns), read from the side that the scene
    asks for.
    """
    wanted = scene.model.receptor_layer(scene.model.readout.side)
    adjacent = section.mesh.f2t[:, section.receptor_facets]
    element = np.where(section.layer[adjacent[0]] == wanted, adjacent[0], adjacent[1])
    points, gradient = facet_gradient(section.mesh, section.receptor_facets, element)
    # around the section's centre the angle ascends along the line, also where the line turns back in x
    order = np.argsort(np.arctan2(points[0], scene.model.finger.height / 2.0 - points[1]))
    rows = (GRADIENT * order[:, None] + np.arange(GRADIENT)).ravel()
    return points[:, order].T, gradient[rows]


def arc_length(points: FloatArray) -> FloatArray:
    """Arc length (m,) [mm] along a polyline (m, 2), zero where x crosses the mid-line."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    middle = int(np.argmin(np.abs(points[:, 0])))
    around = slice(max(middle - 1, 0), middle + 2)
    return arc - float(np.interp(0.0, points[around, 0], arc[around]))
