"""What receptors may answer to: scalar measures of a plane strain, and the stress that belongs to it.

Strains come as (3m,) exx, eyy, gxy = 2 exy point by point; out of the plane there is no strain, but a stress szz. The
material is that of the layer in which the strain is read.
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ..arrays import FloatArray
from ..scene.finger import Material
from ..tissue.compliance import VOIGT
from ..tissue.elasticity import lame
from .strain import maximum_principal


class Measure(StrEnum):
    """A scalar that a receptor may answer to."""

    MAXIMUM_PRINCIPAL = "maximum_principal_strain"
    MAXIMUM_SHEAR = "maximum_shear_strain"
    STRAIN_ENERGY = "strain_energy_density"
    VON_MISES = "von_mises_stress"

    @property
    def unit(self) -> str:
        """Its unit: strains have none ("1"), energy density and stress are in MPa."""
        return "1" if self in {Measure.MAXIMUM_PRINCIPAL, Measure.MAXIMUM_SHEAR} else "MPa"


def measured(measure: Measure, components: FloatArray, material: Material) -> FloatArray:
    """A measure (m,) of strains (3m,)."""
    match measure:
        case Measure.MAXIMUM_PRINCIPAL:
            return maximum_principal(components)
        case Measure.MAXIMUM_SHEAR:
            return maximum_shear(components)
        case Measure.STRAIN_ENERGY:
            return strain_energy_density(components, material)
        case Measure.VON_MISES:
            return von_mises_stress(components, material)


def maximum_shear(components: FloatArray) -> FloatArray:
    """Largest engineering shear strain (m,) [1]: largest less smallest of the three principal strains.

    In-plane principal strains of one sign leave the smallest or largest to the third, which is zero.

    >>> maximum_shear(np.array([0.01, -0.02, 0.0, 0.01, 0.02, 0.0])).round(12).tolist()
    [0.03, 0.02]
    """
    exx, eyy, gxy = components.reshape(-1, VOIGT).T
    middle, radius = (exx + eyy) / 2.0, np.hypot((exx - eyy) / 2.0, gxy / 2.0)
    return np.maximum(middle + radius, 0.0) - np.minimum(middle - radius, 0.0)


def stress(components: FloatArray, material: Material) -> FloatArray:
    """Stress (m, 4) [MPa]: sxx, syy, szz, sxy of sigma = lambda tr(eps) I + 2 mu eps.

    >>> stress(np.array([0.1, 0.0, 0.2]), Material(1.0, 0.0)).round(12).tolist()
    [[0.1, 0.0, 0.0, 0.1]]
    """
    lam, mu = lame(material)
    exx, eyy, gxy = components.reshape(-1, VOIGT).T
    spherical = lam * (exx + eyy)
    return np.stack([spherical + 2.0 * mu * exx, spherical + 2.0 * mu * eyy, spherical, mu * gxy], axis=-1)


def strain_energy_density(components: FloatArray, material: Material) -> FloatArray:
    """Elastic energy (m,) of unit volume [N mm per mm³ = MPa]: sigma : eps / 2 = (sxx exx + syy eyy + sxy gxy) / 2."""
    exx, eyy, gxy = components.reshape(-1, VOIGT).T
    sxx, syy, _, sxy = stress(components, material).T
    return (sxx * exx + syy * eyy + sxy * gxy) / 2.0


def von_mises_stress(components: FloatArray, material: Material) -> FloatArray:
    """Von Mises' equivalent stress (m,) [MPa]: sqrt(3/2 s : s) with s the deviator of the stress, szz included.

    sqrt(((sxx - syy)² + (syy - szz)² + (szz - sxx)²) / 2 + 3 sxy²)
    """
    sxx, syy, szz, sxy = stress(components, material).T
    return np.sqrt(((sxx - syy) ** 2 + (syy - szz) ** 2 + (szz - sxx) ** 2) / 2.0 + 3.0 * sxy**2)
