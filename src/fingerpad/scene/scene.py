"""A scene: a model of finger, contact and read-out, and a device on it, frozen and validated.

Units are mm, N, MPa, s throughout. The finger pad points down: x runs along the row of actuators, y points into
the finger, and the lowest point of the undeformed pad is the origin. Positive normal displacement of an actuator
is +y, into the skin; positive tangential displacement is +x.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..requirements import require
from .contact_law import ContactLaw, Criterion
from .device import Condition, Device
from .finger import Finger
from .numerics import Numerics, Skips
from .readout import GaborFilter, ReadoutRule, Side
from .tissue_law import Kinematics, TissueLaw
from .vibration_rule import VibrationRule


@dataclass(frozen=True)
class Model:
    """Everything but the device: finger, tissue, contact, filter, read-out, vibration, numerics and what is skipped.

    Raises SceneError if the layer above the receptors is none of the pad's or its last, or a layer that relaxes is none
    of the finger's.
    """

    finger: Finger
    tissue: TissueLaw
    contact: ContactLaw
    gabor: GaborFilter
    readout: ReadoutRule
    vibration: VibrationRule
    numerics: Numerics
    skips: Skips

    def __post_init__(self) -> None:
        names = [layer.name for layer in self.finger.pad[:-1]]
        require(
            self.readout.layer_above in names,
            f"readout: layer_above {self.readout.layer_above!r} must be one of {names}",
        )
        every = [layer.name for layer in self.finger.layers]
        for name in self.vibration.relaxation.layers:
            require(name in every, f"vibration: layers {name!r} must be among {every}")

    @property
    def layers_above(self) -> int:
        """How many of the pad's layers lie above the receptor line: the index of the one below."""
        return [layer.name for layer in self.finger.pad].index(self.readout.layer_above) + 1

    def receptor_layer(self, side: Side) -> int:
        """Index of the pad's layer on one side of the receptor line."""
        return self.layers_above - (side is Side.EPIDERMIS)

    @property
    def receptor_depth(self) -> float:
        """Depth of the receptor line below the skin [mm]."""
        return sum(layer.thickness for layer in self.finger.pad[: self.layers_above])


@dataclass(frozen=True)
class Scene:
    """A model and a device that fits it. Raises SceneError if an actuator reaches beyond the finger."""

    model: Model
    device: Device

    def __post_init__(self) -> None:
        reach = self.device.actuators.reach
        require(
            reach < self.model.finger.width / 2.0,
            f"{self.device.name}: found an actuator that reaches x = {reach:g} mm; allowed: less than half the finger's"
            f" width, {self.model.finger.width / 2.0:g} mm (leave out actuators beside the finger)",
        )

    def solved_as(self, name: str) -> Condition:
        """The condition whose solution holds for that one as well: the first with its stimulus. Raises SceneError if
        there is none of that name.
        """
        if not self.model.skips.equal_stimuli:
            return self.device.condition(name)
        return self.device.first_with_stimulus_of(name)

    @property
    def kinematics(self) -> Kinematics:
        """Of the tissue."""
        return self.model.tissue.kinematics

    @property
    def computed(self) -> tuple[Kinematics, ...]:
        """Kinematics that the workflow computes: those of the model that the device's file does not leave out."""
        return tuple(each for each in self.model.tissue.computed if each in self.device.kinematics)

    @property
    def lacks_faces(self) -> bool:
        """Whether skin is to cover all faces of actuators that are round, and have none."""
        return self.model.contact.criterion is Criterion.FULL and self.device.actuators.half_face <= 0.0

    def with_kinematics(self, kinematics: Kinematics) -> Scene:
        """The scene with other kinematics."""
        return self.with_model(tissue=replace(self.model.tissue, kinematics=kinematics))

    def with_model(self, **parts: Any) -> Scene:
        """The scene with other parts of its model, by their names."""
        return replace(self, model=replace(self.model, **parts))

    def with_device(self, **parts: Any) -> Scene:
        """The scene with other parts of its device, by their names."""
        return replace(self, device=replace(self.device, **parts))

    def with_conditions(self, conditions: Iterable[Condition]) -> Scene:
        """The scene with other conditions of its device; as vibrations those that it has under these names."""
        kept = tuple(conditions)
        cycles = tuple(cycle for cycle in self.device.cycles if any(cycle.name == each.name for each in kept))
        return self.with_device(conditions=kept, cycles=cycles)

    def with_asked(self, names: Collection[str]) -> Scene:
        """The scene with the conditions of these names alone, in their order here, or with all if none is named. Raises
        SceneError if there is no condition of a name.
        """
        asked = {self.device.condition(name).name for name in names}
        return self.with_conditions(each for each in self.device.conditions if each.name in asked) if asked else self

    def coarsened(self, factor: float) -> Scene:
        """The scene with coarser numerics."""
        return self.with_model(numerics=self.model.numerics.coarsened(factor))


def with_all_kinematics(scenes: Sequence[Scene]) -> Iterator[Scene]:
    """Every scene with each kinematics computed for it: all with small ones, then all with finite ones."""
    return (
        each.with_kinematics(kinematics) for kinematics in Kinematics for each in scenes if kinematics in each.computed
    )
