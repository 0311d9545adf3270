"""From receptor points to a uniform grid, by a cubic spline: one linear map for all read-outs of a device."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from ..arrays import FloatArray
from ..scene.scene import Scene
from ..tissue.mesh import SectionMesh
from ..tissue.receptors import arc_length, receptor_strain
from .strain import Resampling


def resampling_to_grid(arc: FloatArray, spacing: float) -> Resampling:
    """Cubic spline through receptors at arc lengths (m,) [mm], read on a uniform grid of that spacing [mm].

    A spline is linear in the values it goes through, so its weights are the splines through unit values.
    """
    grid = _uniform_grid(arc, spacing)
    return Resampling(grid, make_interp_spline(arc, np.eye(arc.size), k=3)(grid))


def section_resampling(section: SectionMesh, scene: Scene) -> Resampling:
    """`resampling_to_grid` of the receptors of a mesh, as the scene asks for it."""
    points, _ = receptor_strain(section, scene)
    return resampling_to_grid(arc_length(points), scene.model.gabor.spacing)


def _uniform_grid(arc: FloatArray, spacing: float) -> FloatArray:
    """Uniform grid (k,) [mm] over the receptor line, symmetric about the mid-line, at most `spacing` apart."""
    half = min(-arc[0], arc[-1])
    count = int(np.ceil(half / spacing))
    return np.linspace(-half, half, 2 * count + 1)
