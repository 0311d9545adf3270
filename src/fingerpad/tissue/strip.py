"""Mesh of a deformable actuator's body: a strip on its base, of second-order elements."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from skfem import MeshTri, MeshTri2

from ..arrays import FloatArray
from ..errors import MeshError
from ..scene.device import ActuatorRow
from ..scene.numerics import Numerics
from .compliance import MIRROR
from .mesh import MAX_ELEMENTS, require_valid

NEAR = 0.25  # depth in a body, of its width [1], to which its elements are as at the edges; source: HIGHEST
# Height of a body's elements over its width times growth [1]; source: pucks 0.7 to 12 times as thick as wide then press
# and shear as on elements of one height to 0.4 % (measured)
HIGHEST = 0.2
JOINED = 8  # decimals of a length [mm]; nodes that agree in them are one


def mesh_strip(row: ActuatorRow, numerics: Numerics) -> MeshTri2:
    """Mesh of one deformable actuator's body: a strip on its base, face at y = 0, centred on x = 0, and placed as the
    body says.

    Graded towards both ends of the face like the skin. Raises MeshError if the row is rigid, more than MAX_ELEMENTS are
    asked for, or its body is turned inside out or has another face or base than the strip.
    """
    if row.body is None:
        raise MeshError("a rigid actuator has no body to mesh")
    half = row.width / 2.0
    count = int(np.ceil(np.log1p(numerics.growth * half / numerics.edge_size) / np.log1p(numerics.growth)))
    distance = numerics.edge_size * np.expm1(np.arange(count + 1) * np.log1p(numerics.growth)) / numerics.growth
    across = half * (1.0 - distance[::-1] / distance[-1])
    down = -_depths(row.body.thickness, row.width, numerics)[::-1]
    if 4 * across.size * down.size > MAX_ELEMENTS:
        raise MeshError(
            f"the mesh of an actuator's body needs more than {MAX_ELEMENTS} elements; try a thinner body, or a larger"
            " numerics.edge_size"
        )
    right = MeshTri.init_tensor(across, down)
    # mirrored with its diagonals; joined here, as scikit-fem's + warns of its own arrays' order
    points = np.hstack([right.p, right.p * MIRROR[:, None]]).round(JOINED)
    _, kept, joined = np.unique(points, axis=1, return_index=True, return_inverse=True)
    triangles = joined.ravel()[np.hstack([right.t, right.t + right.p.shape[1]])]
    strip = MeshTri2.from_mesh(MeshTri(np.ascontiguousarray(points[:, kept]), triangles))
    mesh = replace(strip, doflocs=row.body.placed(*strip.doflocs))
    y = strip.doflocs[1]
    face, base = y == y.max(), y == y.min()
    if not (
        np.array_equal(mesh.doflocs[:, face], strip.doflocs[:, face])
        and np.array_equal(mesh.doflocs[1, base], strip.doflocs[1, base])
    ):
        raise MeshError("actuator body: its face must lie where the strip's does, and its base as deep")
    require_valid(mesh, "actuator body")
    return mesh


def _depths(thickness: float, width: float, numerics: Numerics) -> FloatArray:
    """Depths (n_rows + 1,) [mm] of a strip's rows: as high as elements at the edges; where the face is far, in a body
    that is thick for its width, higher row by row by `growth`, to a share of the width.
    """
    near, size = NEAR * width, numerics.edge_size
    if thickness <= near:
        return np.flip(thickness * np.linspace(1.0, 0.0, max(2, math.ceil(thickness / size)) + 1))
    depths: list[float] = np.linspace(0.0, near, math.ceil(near / size) + 1).tolist()
    while depths[-1] < thickness:
        size = min(size * (1.0 + numerics.growth), HIGHEST * numerics.growth * width)
        depths.append(depths[-1] + size)
    return np.asarray(depths) * (thickness / depths[-1])
