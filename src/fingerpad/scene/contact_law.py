"""How skin and actuators touch: friction, where the contact normal turns, when pre-indentation ends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from ..requirements import require
from .tissue_law import Kinematics


class Interface(StrEnum):
    """How actuators and skin touch: with Coulomb friction, or with friction 0 ("shear off")."""

    SHEAR = "shear"
    FRICTIONLESS = "frictionless"


class TurningNormal(StrEnum):
    """With which kinematics the contact normal turns on rounded edges, where friction acts."""

    NEVER = "never"
    FINITE = "finite"
    ALWAYS = "always"


class Criterion(StrEnum):
    """When pre-indentation ends: every flat face wholly in contact, or every actuator touching."""

    FULL = "full"
    TOUCH = "touch"


@dataclass(frozen=True)
class ContactLaw:
    """Coulomb friction coefficient [1], where the contact normal turns, and the criterion that ends pre-indentation.

    Raises SceneError if friction is negative or not finite.
    """

    friction: float
    turning_normal: TurningNormal
    criterion: Criterion

    def __post_init__(self) -> None:
        require(math.isfinite(self.friction) and self.friction >= 0, f"contact: friction {self.friction} < 0")

    def coefficient(self, interface: Interface) -> float:
        """Friction coefficient [1] of an interface: 0 with shear off."""
        return self.friction if interface is Interface.SHEAR else 0.0

    def turns(self, kinematics: Kinematics, interface: Interface) -> bool:
        """Whether the contact normal turns. Never without friction: skin would slide off the edges' slopes sideways."""
        chosen = {TurningNormal.NEVER: False, TurningNormal.ALWAYS: True}
        with_these = chosen.get(self.turning_normal, kinematics is Kinematics.FINITE)
        return with_these and self.coefficient(interface) > 0.0
