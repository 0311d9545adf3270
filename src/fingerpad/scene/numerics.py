"""Numerics: mesh sizes, load increments, tolerances, and what a scene may skip."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..requirements import require, require_positive


@dataclass(frozen=True)
class Numerics:
    """Mesh sizes [mm], load increments and tolerances.

    edge_size: element size on the skin within edge_zone of an actuator's edge. face_size: largest on the skin under an
    actuator. growth: growth of element size with distance [1]. receptor_size: largest on the receptor line. nail_size:
    at the corners of the nail's edges. largest_size: anywhere. contact_margin: beyond actuators and their strokes, in
    which skin may come into contact. indentation_increments, stimulus_increments: load increments (per segment of a
    stimulus). newton_tolerance: on forces relative to the largest and on gaps relative to the load. max_cuts: how often
    an increment may be halved.

    Raises SceneError if max_cuts is negative, or anything else not positive.
    """

    edge_size: float
    edge_zone: float
    face_size: float
    growth: float
    receptor_size: float
    nail_size: float
    largest_size: float
    contact_margin: float
    indentation_increments: int
    stimulus_increments: int
    newton_tolerance: float
    max_cuts: int

    def __post_init__(self) -> None:
        require_positive("numerics", **{name: each for name, each in vars(self).items() if name != "max_cuts"})
        require(self.max_cuts >= 0, f"numerics: max_cuts {self.max_cuts} < 0")

    def coarsened(self, factor: float) -> Numerics:
        """Element sizes, everywhere, and load increments `factor` times as large; finer below 1."""
        return replace(
            self,
            edge_size=factor * self.edge_size,
            face_size=factor * self.face_size,
            growth=factor * self.growth,
            receptor_size=factor * self.receptor_size,
            nail_size=factor * self.nail_size,
            largest_size=factor * self.largest_size,
        ).with_increments(1.0 / factor)

    def with_increments(self, times: float) -> Numerics:
        """With so many times as many increments [1], at least one of each."""
        return replace(
            self,
            indentation_increments=max(round(times * self.indentation_increments), 1),
            stimulus_increments=max(round(times * self.stimulus_increments), 1),
        )


@dataclass(frozen=True)
class Skips:
    """What a scene may skip; each switch turns one saving off for comparison (docs/skipping.md).

    halved_condensation: the section mirrors, so half of it is condensed. equal_stimuli: conditions with the same
    stimulus are solved once. shared_indentation: pre-indentation, the same for all conditions, is solved once where one
    process solves several. mirrored_half: pre-indentation of a row that mirrors solves one half. frictionless_path:
    without friction the path leaves no trace, so it is followed in half as many increments. inactive_nodes: an
    increment takes only nodes in contact or about to be.
    """

    halved_condensation: bool
    equal_stimuli: bool
    shared_indentation: bool
    mirrored_half: bool
    frictionless_path: bool
    inactive_nodes: bool
