"""What condensation leaves of tissue and actuators: small dense maps, all that a contact problem needs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import FloatArray
from ..store import load

VOIGT = 3  # strain components [1]: exx, eyy, gxy = 2 exy
MIRROR = np.array([-1.0, 1.0])  # signs [1] of the components x and y of a mirror image about x = 0
MIRROR_VOIGT = np.array([1.0, 1.0, -1.0])  # signs [1] of its strain components
GRADIENT = 4  # components of a displacement gradient [1]: du_x/dx, du_x/dy, du_y/dx, du_y/dy


@dataclass(frozen=True)
class CondensedSection:
    """What a contact problem needs of the finger.

    position: (n, 2) undeformed contact nodes [mm], by ascending x: means of the skin under a linear traction's hats
    (`traction`). weight: (n,) length of skin that belongs to each node [mm]; force over weight is the traction there.
    compliance: (2n, 2n) [mm per N/mm], ordered x0, y0, x1, y1, ... receptor: (m, 2) undeformed receptor points [mm],
    and arc: (m,) their arc length from the mid-line [mm]. strain: (3m, 2n) [1 per N/mm], ordered exx, eyy, gxy point
    by point. residual: relative equilibrium residual of the factorisation [1].
    """

    position: FloatArray
    weight: FloatArray
    compliance: FloatArray
    receptor: FloatArray
    arc: FloatArray
    strain: FloatArray
    residual: float

    def receptor_strain(self, forces: FloatArray) -> FloatArray:
        """Strain (k, 3m) [1] at the receptors under contact forces (k, n, 2) [N/mm]."""
        return forces.reshape(forces.shape[0], -1) @ self.strain.T


@dataclass(frozen=True)
class CondensedBody:
    """Surface compliance of one deformable actuator, fixed at its base.

    coordinate: (k,) face nodes [mm] from the actuator's centre, ascending, vertices and midpoints alternating.
    compliance: (2k, 2k) [mm per N/mm], ordered x0, y0, x1, y1, ...
    """

    coordinate: FloatArray
    compliance: FloatArray


def displaced(compliance: FloatArray, force: FloatArray) -> FloatArray:
    """Displacement (n, 2) [mm] of nodes under forces (n, 2) [N/mm], by their compliance (2n, 2n) [mm per N/mm], ordered
    x0, y0, x1, y1, ...
    """
    return (compliance @ force.ravel()).reshape(-1, 2)


def load_body(path: Path | None) -> CondensedBody | None:
    """Read the body that `store.save` wrote, or nothing where actuators are rigid. Raises ResultError."""
    return load(path, CondensedBody) if path else None
