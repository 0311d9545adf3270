"""What condensation leaves of tissue and actuators: small dense maps, all that a contact problem needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .finite_strain import logarithmic_strain
from .scene import FloatArray

VOIGT = 3  # strain components [1]: exx, eyy, gxy = 2 exy
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

    @property
    def free(self) -> FloatArray | None:
        """Displacement (n, 2) [mm] of the contact nodes without contact forces; None is zero."""
        return None

    def receptor_strain(self, forces: FloatArray) -> FloatArray:
        """Strain (k, 3m) [1] at the receptors under contact forces (k, n, 2) [N/mm]."""
        return np.asarray(forces.reshape(forces.shape[0], -1) @ self.strain.T)


@dataclass(frozen=True)
class TangentSection(CondensedSection):
    """A finger condensed about a deformed state: what holds for small changes of it.

    compliance: of the tangent. rest: (n, 2) displacement that contact nodes had without contact forces if the tangent
    held so far [mm]. gradient: (4m, 2n) of displacement gradients [1 per N/mm] at the receptors, and at_rest: (4m,) what
    they had without contact forces [1]. strain: without rows.
    """

    rest: FloatArray
    gradient: FloatArray
    at_rest: FloatArray

    @property
    def free(self) -> FloatArray:
        """Displacement (n, 2) [mm] of the contact nodes without contact forces."""
        return self.rest

    def receptor_strain(self, forces: FloatArray) -> FloatArray:
        """Logarithmic strain (k, 3m) [1] at the receptors under contact forces (k, n, 2) [N/mm]."""
        gradient = self.at_rest + forces.reshape(forces.shape[0], -1) @ self.gradient.T
        points = gradient.reshape(forces.shape[0], -1, 2, 2).transpose(2, 3, 0, 1)
        return np.asarray(logarithmic_strain(points).transpose(1, 2, 0).reshape(forces.shape[0], -1))


@dataclass(frozen=True)
class CondensedBody:
    """Surface compliance of one deformable actuator, fixed at its base.

    coordinate: (k,) face nodes [mm] from the actuator's centre, ascending, vertices and midpoints alternating.
    compliance: (2k, 2k) [mm per N/mm], ordered x0, y0, x1, y1, ...
    """

    coordinate: FloatArray
    compliance: FloatArray
