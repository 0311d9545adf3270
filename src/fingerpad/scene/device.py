"""A device: its actuators, what it controls, and the stimuli of the conditions it is tried in."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..csvrows import listed
from ..errors import SceneError
from ..guess import closest, hint
from ..requirements import require, require_positive
from .contact_law import Interface
from .finger import Material
from .tissue_law import Kinematics

CROSSING = 15  # decimals of displacements [1]; cos(pi/2) is 6e-17 in floating point: a pin at its zero crossing rests
# ASSUME: actuators.edge_radius = 0 is regularised to SHARP_RADIUS, so that a node at the edge has one slope
SHARP_RADIUS = 0.001  # mm; source: a fifteenth of the smallest elements at edges, that no solution tells from none
ROUNDING = 1e-9  # relative [1]; by so much neighbours that touch may overlap: their places are rounded


class Control(StrEnum):
    """What the device prescribes. A force-controlled device has no displacements without friction."""

    DISPLACEMENT = "displacement"
    FORCE = "force"


@dataclass(frozen=True)
class Body:
    """Deformable body of an actuator: material and thickness [mm] of the strip on its rigid base.

    Bodies that are no such strip say how they differ from it (`bodies`). Raises SceneError if the thickness is not
    positive.
    """

    material: Material
    thickness: float

    def __post_init__(self) -> None:
        require_positive("actuator body", thickness=self.thickness)

    def placed(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Where the strip's points x, y (n,) lie in this body (2, n) [mm]: its face on y = 0 and the height of its base
        stay as they are.
        """
        return np.stack([x, y])

    def mount(self) -> FloatArray:
        """Compliance (2, 2) [mm per N/mm] of what the base stands on, in x and y; nothing turns it."""
        return np.zeros((2, 2))


@dataclass(frozen=True)
class ActuatorRow:
    """A row of equal actuators, flat-faced with rounded edges.

    positions: centres x [mm] from the finger's middle, ascending. width: over the rounded edges [mm]. edge_radius:
    [mm], 0 for sharp edges, width/2 for a cylinder. body: None for rigid actuators.

    Raises SceneError if there is no actuator, positions do not ascend, neighbours overlap, a number is not finite, the
    width is not positive, or edge_radius not between 0 and width/2.
    """

    positions: tuple[float, ...]
    width: float
    edge_radius: float
    body: Body | None = None

    def __post_init__(self) -> None:
        require(len(self.positions) >= 1, "actuators: there must be at least one")
        require(all(map(math.isfinite, self.positions)), "actuators: positions must be finite numbers")
        require_positive("actuators", width=self.width)
        require(
            0.0 <= self.edge_radius <= self.width / 2.0,
            f"actuators: edge_radius must lie between 0 and width/2 = {self.width / 2.0:g} mm,"
            f" found {self.edge_radius:g}",
        )
        for left, right in pairwise(self.positions):
            require(left < right, f"actuators: positions must ascend, found {left:g} mm before {right:g} mm")
            require(
                right - left >= self.width * (1.0 - ROUNDING),
                f"actuators: neighbours at x = {left:g} and {right:g} mm overlap: width {self.width:g} mm is more"
                f" than their distance {right - left:g} mm",
            )

    @property
    def corner_radius(self) -> float:
        """Radius of the edges as they are modelled [mm]: that of sharp ones is SHARP_RADIUS."""
        return max(self.edge_radius, SHARP_RADIUS)

    @property
    def span(self) -> tuple[float, float]:
        """Where the row begins and ends along x [mm]."""
        return self.positions[0] - self.width / 2.0, self.positions[-1] + self.width / 2.0

    @property
    def reach(self) -> float:
        """How far it reaches from the finger's middle [mm]."""
        return max(abs(x) for x in self.positions) + self.width / 2.0

    @property
    def mirrors(self) -> bool:
        """Whether actuators stand in places that are their own mirror image about the finger's middle."""
        return self.positions == tuple(-x for x in reversed(self.positions))

    def nearest(self, x: FloatArray) -> np.ndarray:
        """Index (n,) of the actuator whose centre is nearest to each place (n,) [mm]."""
        return nearest(np.asarray(self.positions), x)

    @property
    def half_face(self) -> float:
        """Half width of the flat part of the face, between the edges as they are modelled [mm]."""
        return self.width / 2.0 - self.corner_radius

    @property
    def edges(self) -> FloatArray:
        """Where each rounded edge begins and ends (2, 2), the left one first, from an actuator's centre [mm]."""
        outer, inner = self.width / 2.0, self.half_face
        return np.array([[-outer, -inner], [inner, outer]])


def evenly(count: int, pitch: float) -> tuple[float, ...]:
    """Centres [mm] of so many actuators, a pitch [mm] apart, about zero.

    >>> evenly(3, 2.5)
    (-2.5, 0.0, 2.5)
    """
    return tuple((i - (count - 1) / 2.0) * pitch for i in range(count))


def nearest(centres: FloatArray, x: FloatArray) -> np.ndarray:
    """Index (n,) of the ascending centre (k,) [mm] that is nearest to each place (n,) [mm].

    >>> nearest(np.array([-1.0, 1.0]), np.array([-3.0, 0.5]))
    array([0, 1])
    """
    return np.searchsorted((centres[1:] + centres[:-1]) / 2.0, x)


@dataclass(frozen=True)
class Condition:
    """One stimulus of a device: displacement histories relative to the pre-indented position.

    time: (n_times,) [s], ascending; of cycles in periods [1], and 1 of a stimulus of one time. normal, tangential:
    (n_times, n_actuators) [mm]; linear in between. The path starts from rest, so a first row that is not zero is
    reached from zero. settling: how many of the times pass before receptors may be read, as friction remembers how a
    cycle was begun.

    Raises SceneError if time is empty, not finite or does not ascend, settling leaves none of them, or displacements
    are not finite or of another shape.
    """

    name: str
    dispersion: str
    phase_deg: float
    time: FloatArray
    normal: FloatArray
    tangential: FloatArray
    settling: int = 0

    def __post_init__(self) -> None:
        where = f"condition {self.name}"
        require(self.time.ndim == 1 and self.time.size >= 1, f"{where}: time must have one row or more")
        require(bool(np.isfinite(self.time).all()), f"{where}: times must be finite numbers")
        for before, after in pairwise(self.time):
            require(before < after, f"{where}: times must ascend, found {before:g} s before {after:g} s")
        require(
            0 <= self.settling < self.time.size,
            f"{where}: settling must leave a time to read of {self.time.size}, found {self.settling}",
        )
        for name, array in (("normal", self.normal), ("tangential", self.tangential)):
            require(
                array.ndim == 2 and array.shape[0] == self.time.size,
                f"{where}: {name}: found the shape {array.shape}; allowed: {self.time.size} rows, one for each time",
            )
            require(bool(np.all(np.isfinite(array))), f"{where}: {name} must be finite numbers")
        require(self.normal.shape == self.tangential.shape, f"{where}: normal and tangential differ in shape")

    @property
    def times(self) -> FloatArray:
        """Times (1 + n_times,) [s] of pre-indentation and of the rows: 0, or one step before a first row at 0.

        >>> nothing = np.zeros((2, 1))
        >>> rows = np.array([1.0, 3.0]), np.array([0.0, 2.0])
        >>> [Condition("a", "b", 0.0, time, nothing, nothing).times.tolist() for time in rows]
        [[0.0, 1.0, 3.0], [-2.0, 0.0, 2.0]]
        """
        first, second, *_ = *self.time, self.time[-1] + 1.0
        return np.array([0.0 if first > 0.0 else first - (second - first), *self.time])

    @property
    def time_unit(self) -> str:
        """Of its times: s, or periods of a cycle; nothing where one time has no length."""
        return "" if self.time.size == 1 else "periods" if self.settling else "s"

    @property
    def moves(self) -> FloatArray:
        """Displacements (n_times, n_actuators, 2) [mm], tangential and normal."""
        return np.stack([self.tangential, self.normal], axis=2)

    @property
    def stroke(self) -> float:
        """Farthest [mm] that it moves an actuator along x or y."""
        return float(np.abs(self.moves).max())

    def until(self, read: int) -> Condition:
        """The path up to one of its times, at which receptors are read: what follows changes nothing there."""
        time, normal, tangential = (each[: read + 1] for each in (self.time, self.normal, self.tangential))
        return replace(self, time=time, normal=normal, tangential=tangential, settling=read)

    @property
    def prescribed(self) -> tuple[FloatArray | int, ...]:
        """What it prescribes, without its names."""
        return self.time, self.normal, self.tangential, self.settling

    def same_stimulus(self, other: Condition) -> bool:
        """Whether both prescribe the same path, whatever they are called."""
        return all(np.array_equal(one, two) for one, two in zip(self.prescribed, other.prescribed, strict=True))


@dataclass(frozen=True)
class Cycle:
    """A condition as vibration: actuator i moves by the real part of a_i exp(i omega t) from the pre-indented position.

    name, dispersion, phase_deg: of the condition. normal, tangential: amplitudes a (n_actuators,), complex [mm].
    """

    name: str
    dispersion: str
    phase_deg: float
    normal: ComplexArray
    tangential: ComplexArray

    @property
    def is_at_peak(self) -> bool:
        """Whether an actuator is at its peak where receptors are read, at phase 0; one that rests is anywhere."""
        amplitude = np.concatenate([self.normal, self.tangential])
        size = np.abs(amplitude)
        return not size.any() or bool((size > 0.0)[np.abs(amplitude.imag) <= ROUNDING * size].any())


@dataclass(frozen=True)
class Device:
    """A device: its actuators, what it controls, and the conditions it is tried in.

    cycles: the conditions as vibrations, none if they are given in time. frequencies: at which they are asked for [Hz].
    kinematics: with which the workflow predicts it; strokes that turn elements inside out leave finite ones out.
    frictionless: whether it is predicted without friction; rows that only friction holds leave that out.

    Raises SceneError if there is no condition, two share a name, one moves another number of actuators or neighbours
    into each other, or one that is asked for at a frequency has no actuator at its peak where it is read.
    """

    name: str
    title: str
    control: Control
    actuators: ActuatorRow
    conditions: tuple[Condition, ...]
    cycles: tuple[Cycle, ...] = ()
    frequencies: tuple[float, ...] = ()
    kinematics: tuple[Kinematics, ...] = tuple(Kinematics)
    frictionless: bool = True

    def __post_init__(self) -> None:
        require(len(self.conditions) >= 1, f"{self.name}: there must be at least one condition")
        names = [condition.name for condition in self.conditions]
        require(len(set(names)) == len(names), f"{self.name}: condition names must differ, found {names}")
        count = len(self.actuators.positions)
        for condition in self.conditions:
            require(
                condition.normal.shape[1] == count,
                f"{self.name}: condition {condition.name} moves {condition.normal.shape[1]} actuators,"
                f" the device has {count}",
            )
            for time, tangential in zip(condition.time, condition.tangential, strict=True):
                when = f", time {time:g} s" if condition.time.size > 1 else ""
                self._require_apart(f"condition {condition.name}{when}", -np.diff(tangential))
        for cycle in self.cycles:
            self._require_apart(f"condition {cycle.name}, as a vibration", np.abs(np.diff(cycle.tangential)))
            require(
                cycle.is_at_peak or not self.frequencies,
                f"stimulus.dispersions.{cycle.dispersion}: found no actuator at its peak where receptors are read"
                f" ({self.name}, {cycle.name}, as a vibration); allowed: an actuator of group index 0",
            )

    def _require_apart(self, what: str, approach: FloatArray) -> None:
        """Raise SceneError if neighbours that come closer by `approach` (n_actuators - 1,) [mm] run into each other."""
        # linear between rows, so that rows suffice; bodies reach down from their faces, so that heights do not matter
        row = self.actuators
        overlap = approach - (np.diff(row.positions) - row.width)
        for i in np.flatnonzero(overlap > ROUNDING * row.width)[:1]:
            raise SceneError(
                f"{self.name}: {what}: actuators {i + 1} and {i + 2} run into each other: they come {approach[i]:g} mm"
                f" closer and overlap by {overlap[i]:.3g} mm; allowed: strokes within their gap of"
                f" {approach[i] - overlap[i]:.3g} mm"
            )

    @property
    def strokes(self) -> tuple[float, float]:
        """Farthest [mm] that any condition moves an actuator along y (normal) and along x (lateral)."""
        return (
            max(float(np.abs(each.normal).max()) for each in self.conditions),
            max(float(np.abs(each.tangential).max()) for each in self.conditions),
        )

    @property
    def stroke(self) -> float:
        """Farthest [mm] that any condition moves an actuator along x or y: it decides which skin is within reach."""
        return max(self.strokes)

    def condition(self, name: str) -> Condition:
        """The condition of that name. Raises SceneError if there is none."""
        for condition in self.conditions:
            if condition.name == name:
                return condition
        names = [condition.name for condition in self.conditions]
        meant = hint(closest(name, names), "'")
        raise SceneError(f"{self.name}: no condition '{name}'; allowed: {', '.join(names)}{meant}")

    def interface(self, name: str) -> Interface:
        """The interface of that name. Raises SceneError if the device is not predicted with it."""
        if name not in self.interfaces():
            why = "the device controls force, or `interfaces` in its file skips the frictionless case"
            raise SceneError(f"{self.name}: found the interface '{name}'; allowed: {listed(self.interfaces())} ({why})")
        return Interface(name)

    def first_with_stimulus_of(self, name: str) -> Condition:
        """The first condition with the same stimulus. Raises SceneError if there is no condition of that name."""
        wanted = self.condition(name)
        return next(c for c in self.conditions if c.same_stimulus(wanted))

    @property
    def by_dispersion(self) -> dict[str, list[Condition]]:
        """The conditions of every dispersion, in the order of the file."""
        found: dict[str, list[Condition]] = {}
        for condition in self.conditions:
            found.setdefault(condition.dispersion, []).append(condition)
        return found

    @property
    def distinct_conditions(self) -> tuple[Condition, ...]:
        """One condition of every stimulus, the first."""
        return tuple(each for each in self.conditions if self.first_with_stimulus_of(each.name) is each)

    def interfaces(self) -> tuple[Interface, ...]:
        """Interfaces that can be predicted: how a force-controlled device moves without friction is unknown."""
        alone = self.control is Control.FORCE or not self.frictionless
        return (Interface.SHEAR,) if alone else tuple(Interface)
