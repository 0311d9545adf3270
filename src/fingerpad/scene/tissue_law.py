"""How tissue deforms: kinematics, and the law that it obeys where they are finite."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from ..requirements import require


class Kinematics(StrEnum):
    """SMALL: linear tissue, equilibrium on the undeformed finger. FINITE: large displacements and strains."""

    SMALL = "small"
    FINITE = "finite"


class Law(StrEnum):
    """Stored energy of tissue that deforms much. HENCKY: the linear law in logarithmic strain. NEO_HOOKEAN, OGDEN:
    2 mu/alpha^2 (sum of (J^-1/3 lambda)^alpha - 3) + kappa/2 (J - 1)^2, alpha = 2 for the first, as in Abaqus and
    CalculiX. GREEN: the linear law in Green's strain (St. Venant-Kirchhoff), which is what CalculiX takes a linear
    elastic material for.
    """

    HENCKY = "hencky"
    NEO_HOOKEAN = "neo_hookean"
    OGDEN = "ogden"
    GREEN = "green"


@dataclass(frozen=True)
class TissueLaw:
    """How tissue deforms.

    kinematics: of this scene. computed: those of the workflow. law: with finite kinematics. ogden_exponent: of
    Ogden's law [1]. Raises SceneError if that is 0 or not finite.
    """

    kinematics: Kinematics
    computed: tuple[Kinematics, ...]
    law: Law
    ogden_exponent: float

    def __post_init__(self) -> None:
        require(
            math.isfinite(self.ogden_exponent) and self.ogden_exponent != 0.0,
            f"tissue: ogden_exponent must be a number other than 0, found {self.ogden_exponent}",
        )
