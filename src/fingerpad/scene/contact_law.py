"""How skin and actuators touch: friction and when it acts, where the normal turns, when pre-indentation ends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from ..requirements import require, require_positive
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


class FrictionFrom(StrEnum):
    """From when on friction acts: from first touch, or once the device is pressed: what touches then sticks."""

    TOUCH = "touch"
    STIMULUS = "stimulus"


class Criterion(StrEnum):
    """When pre-indentation ends: every flat face wholly in contact, every actuator touching, or the row as deep or as
    heavy as it is to be, whatever touches.
    """

    FULL = "full"
    TOUCH = "touch"
    DEPTH = "depth"
    FORCE = "force"


@dataclass(frozen=True)
class ContactLaw:
    """Coulomb friction coefficient [1], from when on it acts, where the contact normal turns, and the criterion that
    ends pre-indentation.

    depth: from first touch [mm], of Criterion.DEPTH alone. force: of the row per mm of finger [N/mm], of
    Criterion.FORCE alone. Raises SceneError if friction is negative or not finite, depth or force not positive.
    """

    friction: float
    friction_from: FrictionFrom
    turning_normal: TurningNormal
    criterion: Criterion
    depth: float
    force: float

    def __post_init__(self) -> None:
        require(
            math.isfinite(self.friction) and self.friction >= 0,
            f"contact: friction must be 0 or a positive number, found {self.friction}",
        )
        require_positive("contact", depth=self.depth, force=self.force)

    def coefficient(self, interface: Interface) -> float:
        """Friction coefficient [1] of an interface: 0 with shear off."""
        return self.friction if interface is Interface.SHEAR else 0.0

    def turns(self, kinematics: Kinematics, interface: Interface) -> bool:
        """Whether the contact normal turns. Never where anything is pressed without friction: skin would slide off the
        edges' slopes sideways.
        """
        chosen = {TurningNormal.NEVER: False, TurningNormal.ALWAYS: True}
        with_these = chosen.get(self.turning_normal, kinematics is Kinematics.FINITE)
        rubs_from_touch = self.coefficient(interface) > 0.0 and self.friction_from is FrictionFrom.TOUCH
        return with_these and rubs_from_touch
