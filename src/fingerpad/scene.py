"""A scene: finger, layers, contact, device, stimuli, read-outs and numerics, frozen and validated.

Units are mm, N, MPa, s throughout. The finger pad points down: x runs along the row of actuators, y points into
the finger, and the lowest point of the undeformed pad is the origin. Positive normal displacement of an actuator
is +y, into the skin; positive tangential displacement is +x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from difflib import get_close_matches
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from .errors import SceneError

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

ROUNDING = 1e-9  # relative [1]; by so much neighbours that touch may overlap: their places are rounded


class Interface(StrEnum):
    """How actuators and skin touch: with Coulomb friction, or with friction 0 ("shear off")."""

    SHEAR = "shear"
    FRICTIONLESS = "frictionless"


class Readout(StrEnum):
    """What is read at the receptors: SA-1 proxy (strain) or RA-1 proxy (change of strain)."""

    STRAIN = "strain"
    CHANGE_OF_STRAIN = "change_of_strain"


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


class Kinematics(StrEnum):
    """SMALL: linear tissue, equilibrium on the undeformed finger. FINITE: large displacements and strains."""

    SMALL = "small"
    FINITE = "finite"


class Control(StrEnum):
    """What the device prescribes. A force-controlled device has no displacements without friction."""

    DISPLACEMENT = "displacement"
    FORCE = "force"


class Criterion(StrEnum):
    """When pre-indentation ends: every flat face wholly in contact, or every actuator touching."""

    FULL = "full"
    TOUCH = "touch"


class Side(StrEnum):
    """From which side of the epidermis/dermis interface the strain is read."""

    DERMIS = "dermis"
    EPIDERMIS = "epidermis"


def _require(condition: bool, message: str) -> None:
    if not condition:
        raise SceneError(message)


def _require_positive(owner: str, **values: float) -> None:
    for name, value in values.items():
        _require(math.isfinite(value) and value > 0, f"{owner}: {name} must be a positive number, found {value}")


@dataclass(frozen=True)
class Material:
    """Isotropic linear elastic material: Young's modulus [MPa] and Poisson's ratio [1]."""

    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        _require_positive("material", modulus=self.modulus)
        _require(
            -1.0 < self.poisson < 0.5,
            f"material: poisson must lie between -1 and 0.5 (0.5 itself is incompressible), found {self.poisson}",
        )


@dataclass(frozen=True)
class Layer:
    """One tissue layer: name, thickness [mm] along the outline's normal, material."""

    name: str
    thickness: float
    material: Material

    def __post_init__(self) -> None:
        _require_positive(f"layer {self.name}", thickness=self.thickness)


@dataclass(frozen=True)
class Finger:
    """Transverse section of the fingertip: elliptical outline, elliptical rigid bone, layers from the outside in.

    The last layer of each stack fills up to the bone; on the mid-line its thickness is exact, and that is what
    places the bone. Every other layer has its thickness along the outline's normal everywhere.

    width, height: of the outline [mm]. bone_width: [mm]. nail_width: arc length of the dorsal outline that carries
    nail and nail bed [mm]. pad, dorsal: layers from the outside in.

    Raises SceneError if the stacks leave no bone, or the bone does not fit.
    """

    width: float
    height: float
    bone_width: float
    nail_width: float
    pad: tuple[Layer, ...]
    dorsal: tuple[Layer, ...]

    def __post_init__(self) -> None:
        _require_positive(
            "finger",
            width=self.width,
            height=self.height,
            bone_width=self.bone_width,
            nail_width=self.nail_width,
        )
        _require(len(self.pad) >= 2 and len(self.dorsal) >= 1, "finger: pad needs two layers or more, dorsal one")
        _require(
            self.bone_height > 0,
            f"finger: the layers leave no bone: pad {self.pad_thickness:g} mm + dorsal {self.dorsal_thickness:g} mm"
            f" >= height {self.height:g} mm",
        )
        for name, thickness in (("pad", self.pad_thickness), ("dorsal", self.dorsal_thickness)):
            _require(
                self.parallel_depth < thickness,
                f"finger: the {name} layers are {thickness:g} mm thick together and must reach below"
                f" {self.parallel_depth:g} mm, where the last layer of the other side begins",
            )
        half_outline = math.pi * (self.width + self.height) / 4.0
        _require(
            self.nail_width < half_outline,
            f"finger: nail_width {self.nail_width:g} mm must be less than half the outline, {half_outline:.1f} mm:"
            " the pad is the rest",
        )
        offset = self.parallel_depth
        smallest_radius = min(self.height**2 / self.width, self.width**2 / self.height) / 2.0
        _require(
            offset < smallest_radius,
            f"finger: the layers above the last one are {offset:g} mm thick, more than the outline's smallest radius"
            f" of curvature {smallest_radius:g} mm",
        )
        _require(
            self.bone_width / 2.0 < self.width / 2.0 - offset,
            f"finger: bone_width {self.bone_width:g} mm does not fit into width {self.width:g} mm"
            f" less {offset:g} mm of layers on each side",
        )

    @property
    def layers(self) -> tuple[Layer, ...]:
        """All layers, those of the pad first."""
        return (*self.pad, *self.dorsal)

    @property
    def pad_thickness(self) -> float:
        """Soft tissue between pad and bone on the mid-line [mm]."""
        return sum(layer.thickness for layer in self.pad)

    @property
    def dorsal_thickness(self) -> float:
        """Nail and nail bed above the bone on the mid-line [mm]."""
        return sum(layer.thickness for layer in self.dorsal)

    @property
    def bone_height(self) -> float:
        """Height of the bone [mm]."""
        return self.height - self.pad_thickness - self.dorsal_thickness

    @property
    def parallel_depth(self) -> float:
        """Depth [mm] down to which layer interfaces run parallel to the outline."""
        return max(sum(la.thickness for la in stack[:-1]) for stack in (self.pad, self.dorsal))

    def layer(self, name: str) -> Layer:
        """The layer of that name. Raises SceneError if there is none."""
        for layer in self.layers:
            if layer.name == name:
                return layer
        raise SceneError(f"finger: no layer {name!r}")


@dataclass(frozen=True)
class Body:
    """Deformable body of an actuator: material and thickness [mm] of the strip on its rigid base.

    Bodies that are no such strip say how they differ from it (`bodies`).
    """

    material: Material
    thickness: float

    def __post_init__(self) -> None:
        _require_positive("actuator body", thickness=self.thickness)

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

    positions: centres x [mm], ascending. width: over the rounded edges [mm]. edge_radius: [mm], 0 for sharp edges,
    width/2 for a cylinder. body: None for rigid actuators.
    """

    positions: tuple[float, ...]
    width: float
    edge_radius: float
    body: Body | None = None

    def __post_init__(self) -> None:
        _require(len(self.positions) >= 1, "actuators: there must be at least one")
        _require(all(map(math.isfinite, self.positions)), "actuators: positions must be finite numbers")
        _require_positive("actuators", width=self.width)
        _require(
            0.0 <= self.edge_radius <= self.width / 2.0,
            f"actuators: edge_radius must lie between 0 and width/2 = {self.width / 2.0:g} mm,"
            f" found {self.edge_radius:g}",
        )
        for left, right in zip(self.positions, self.positions[1:], strict=False):
            _require(
                right - left >= self.width * (1.0 - ROUNDING),
                f"actuators: neighbours at x = {left:g} and {right:g} mm overlap: width {self.width:g} mm is more"
                f" than their distance {right - left:g} mm",
            )

    @property
    def half_face(self) -> float:
        """Half width of the flat part of the face [mm]."""
        return self.width / 2.0 - self.edge_radius


@dataclass(frozen=True)
class Condition:
    """One stimulus of a device: displacement histories relative to the pre-indented position.

    time: (n_times,) [s], ascending. normal, tangential: (n_times, n_actuators) [mm]; linear in between. The path
    starts from rest, so a first row that is not zero is reached from zero.
    """

    name: str
    dispersion: str
    phase_deg: float
    time: FloatArray
    normal: FloatArray
    tangential: FloatArray

    def __post_init__(self) -> None:
        where = f"condition {self.name}"
        _require(self.time.ndim == 1 and self.time.size >= 1, f"{where}: time must have one row or more")
        _require(bool(np.all(np.diff(self.time) > 0)), f"{where}: time must ascend")
        for name, array in (("normal", self.normal), ("tangential", self.tangential)):
            _require(
                array.ndim == 2 and array.shape[0] == self.time.size,
                f"{where}: {name} must have {self.time.size} rows (one a time), found shape {array.shape}",
            )
            _require(bool(np.all(np.isfinite(array))), f"{where}: {name} must be finite numbers")
        _require(self.normal.shape == self.tangential.shape, f"{where}: normal and tangential differ in shape")

    def same_stimulus(self, other: Condition) -> bool:
        """Whether both prescribe the same path, whatever they are called."""
        return (
            np.array_equal(self.time, other.time)
            and np.array_equal(self.normal, other.normal)
            and np.array_equal(self.tangential, other.tangential)
        )


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


@dataclass(frozen=True)
class Device:
    """A device: its actuators, what it controls, and the conditions it is tried in.

    cycles: the conditions as vibrations, none if they are given in time. frequencies: at which they are asked for [Hz].
    """

    name: str
    title: str
    control: Control
    actuators: ActuatorRow
    conditions: tuple[Condition, ...]
    cycles: tuple[Cycle, ...] = ()
    frequencies: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        _require(len(self.conditions) >= 1, f"{self.name}: there must be at least one condition")
        names = [condition.name for condition in self.conditions]
        _require(len(set(names)) == len(names), f"{self.name}: condition names must differ, found {names}")
        count = len(self.actuators.positions)
        for condition in self.conditions:
            _require(
                condition.normal.shape[1] == count,
                f"{self.name}: condition {condition.name} moves {condition.normal.shape[1]} actuators,"
                f" the device has {count}",
            )

    def condition(self, name: str) -> Condition:
        """The condition of that name. Raises SceneError if there is none."""
        for condition in self.conditions:
            if condition.name == name:
                return condition
        names = [condition.name for condition in self.conditions]
        hint = "".join(f"; did you mean '{close}'?" for close in get_close_matches(name, names, n=1))
        raise SceneError(f"{self.name}: no condition '{name}'; allowed: {', '.join(names)}{hint}")

    def first_with_stimulus_of(self, name: str) -> Condition:
        """The first condition with the same stimulus."""
        wanted = self.condition(name)
        return next(c for c in self.conditions if c.same_stimulus(wanted))

    def interfaces(self) -> tuple[Interface, ...]:
        """Interfaces that can be predicted: a force-controlled device moves nothing without friction."""
        return (Interface.SHEAR,) if self.control is Control.FORCE else tuple(Interface)


class TurningNormal(StrEnum):
    """With which kinematics the contact normal turns on rounded edges, where friction acts."""

    NEVER = "never"
    FINITE = "finite"
    ALWAYS = "always"


@dataclass(frozen=True)
class ContactLaw:
    """Coulomb friction coefficient [1], where the contact normal turns, and the criterion that ends pre-indentation."""

    friction: float
    turning_normal: TurningNormal
    criterion: Criterion

    def __post_init__(self) -> None:
        _require(math.isfinite(self.friction) and self.friction >= 0, f"contact: friction {self.friction} < 0")

    def coefficient(self, interface: Interface) -> float:
        """Friction coefficient [1] of an interface: 0 with shear off."""
        return self.friction if interface is Interface.SHEAR else 0.0

    def turns(self, kinematics: Kinematics, interface: Interface) -> bool:
        """Whether the contact normal turns. Never without friction: skin would slide off the edges' slopes sideways."""
        chosen = {TurningNormal.NEVER: False, TurningNormal.ALWAYS: True}
        with_these = chosen.get(self.turning_normal, kinematics is Kinematics.FINITE)
        return with_these and self.coefficient(interface) > 0.0


@dataclass(frozen=True)
class GaborFilter:
    """Gabor filter: wavelength [mm] of each read-out, width sigma [mm], largest grid spacing [mm]."""

    wavelength_strain: float
    wavelength_change: float
    sigma: float
    spacing: float

    def __post_init__(self) -> None:
        _require_positive(
            "filter",
            wavelength_strain=self.wavelength_strain,
            wavelength_change=self.wavelength_change,
            sigma=self.sigma,
            spacing=self.spacing,
        )

    def wavelength(self, readout: Readout) -> float:
        """Wavelength [mm] for a read-out."""
        return self.wavelength_strain if readout is Readout.STRAIN else self.wavelength_change


@dataclass(frozen=True)
class ReadoutRule:
    """Where receptors are read (interface above which layer, which side) and over which span the score runs.

    depth_below: name of the layer above the receptor line. span_margin: length [mm] added to the actuator row's
    span on each side for the area under the curve.
    """

    layer_above: str
    side: Side
    span_margin: float


@dataclass(frozen=True)
class Numerics:
    """Mesh sizes [mm], load increments and tolerances.

    edge_size: element size on the skin within edge_zone of an actuator's edge. face_size: largest on the skin under an
    actuator. growth: growth of element size with distance [1]. receptor_size: largest on the receptor line.
    largest_size: anywhere. indentation_increments, stimulus_increments: load increments (per segment of a stimulus).
    newton_tolerance: on forces relative to the largest and on gaps relative to the load. max_cuts: how often an
    increment may be halved.
    """

    edge_size: float
    edge_zone: float
    face_size: float
    growth: float
    receptor_size: float
    largest_size: float
    indentation_increments: int
    stimulus_increments: int
    newton_tolerance: float
    max_cuts: int

    def __post_init__(self) -> None:
        _require_positive(
            "numerics",
            edge_size=self.edge_size,
            edge_zone=self.edge_zone,
            face_size=self.face_size,
            growth=self.growth,
            receptor_size=self.receptor_size,
            largest_size=self.largest_size,
            indentation_increments=self.indentation_increments,
            stimulus_increments=self.stimulus_increments,
            newton_tolerance=self.newton_tolerance,
        )
        _require(self.max_cuts >= 0, f"numerics: max_cuts {self.max_cuts} < 0")

    def coarsened(self, factor: float) -> Numerics:
        """Element sizes, everywhere, and load increments `factor` times as large; finer below 1."""
        return replace(
            self,
            edge_size=factor * self.edge_size,
            face_size=factor * self.face_size,
            growth=factor * self.growth,
            receptor_size=factor * self.receptor_size,
            largest_size=factor * self.largest_size,
            indentation_increments=max(round(self.indentation_increments / factor), 1),
            stimulus_increments=max(round(self.stimulus_increments / factor), 1),
        )


@dataclass(frozen=True)
class Skips:
    """What a scene may skip; each switch turns one saving off for comparison (docs/skipping.md).

    halved_condensation: the section mirrors, so half of it is condensed twice. equal_stimuli: conditions with the same
    stimulus are solved once. shared_indentation: pre-indentation, the same for all conditions, is solved once where one
    process solves several. mirrored_half: pre-indentation of a row that mirrors solves one half. frictionless_path:
    without friction the path leaves no trace, so it is followed in a few increments. inactive_nodes: an increment
    takes only nodes in contact or about to be.
    """

    halved_condensation: bool
    equal_stimuli: bool
    shared_indentation: bool
    mirrored_half: bool
    frictionless_path: bool
    inactive_nodes: bool


@dataclass(frozen=True)
class TissueLaw:
    """How tissue deforms.

    kinematics: of this scene, one of `computed`, those of the workflow. law: with finite kinematics. ogden_exponent: of
    Ogden's law [1].
    """

    kinematics: Kinematics
    computed: tuple[Kinematics, ...]
    law: Law
    ogden_exponent: float

    def __post_init__(self) -> None:
        _require(
            math.isfinite(self.ogden_exponent) and self.ogden_exponent != 0.0,
            f"tissue: ogden_exponent must be a number other than 0, found {self.ogden_exponent}",
        )


@dataclass(frozen=True)
class Relaxation:
    """How tissue relaxes (see `viscoelasticity`).

    shares: of the instantaneous modulus that relax [1]. times: in which they do [s]. layers: names of those that relax.
    """

    shares: tuple[float, ...]
    times: tuple[float, ...]
    layers: tuple[str, ...]

    def __post_init__(self) -> None:
        _require(
            len(self.shares) == len(self.times),
            f"vibration: shares and times must be as many, found {len(self.shares)} and {len(self.times)}",
        )
        _require_positive("vibration", **{f"share {i + 1}": share for i, share in enumerate(self.shares)})
        _require_positive("vibration", **{f"time {i + 1}": time for i, time in enumerate(self.times)})
        _require(len(set(self.times)) == len(self.times), f"vibration: times must differ, found {list(self.times)}")
        _require(
            sum(self.shares) < 1.0,
            f"vibration: shares must leave something that does not relax, found a sum of {sum(self.shares):g}",
        )


@dataclass(frozen=True)
class VibrationRule:
    """What vibration needs besides.

    relaxation. density: of all tissue [t/mm3]. inertia_limit: change of receptor strain by inertia [1] beyond which
    there is no prediction. steps: of a cycle [1].
    """

    relaxation: Relaxation
    density: float
    inertia_limit: float
    steps: int

    def __post_init__(self) -> None:
        _require_positive("vibration", density=self.density, inertia_limit=self.inertia_limit, steps=self.steps)


@dataclass(frozen=True)
class Model:
    """Everything but the device: finger, tissue, contact, filter, read-out, vibration, numerics and what is skipped."""

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
        _require(
            self.readout.layer_above in names,
            f"readout: layer_above {self.readout.layer_above!r} must be one of {names}",
        )
        every = [layer.name for layer in self.finger.layers]
        for name in self.vibration.relaxation.layers:
            _require(name in every, f"vibration: layers {name!r} must be among {every}")

    @property
    def receptor_depth(self) -> float:
        """Depth of the receptor line below the skin [mm]."""
        depth = 0.0
        for layer in self.finger.pad:
            depth += layer.thickness
            if layer.name == self.readout.layer_above:
                break
        return depth


@dataclass(frozen=True)
class Scene:
    """A model and a device that fits it. Raises SceneError if an actuator lies beyond the finger."""

    model: Model
    device: Device

    def solved_as(self, name: str) -> Condition:
        """The condition whose solution holds for that one as well: the first with its stimulus."""
        if not self.model.skips.equal_stimuli:
            return self.device.condition(name)
        return self.device.first_with_stimulus_of(name)

    @property
    def kinematics(self) -> Kinematics:
        """Of the tissue."""
        return self.model.tissue.kinematics

    def with_kinematics(self, kinematics: Kinematics) -> Scene:
        """The scene with other kinematics."""
        tissue = replace(self.model.tissue, kinematics=kinematics)
        return replace(self, model=replace(self.model, tissue=tissue))

    def coarsened(self, factor: float) -> Scene:
        """The scene with coarser numerics."""
        numerics = self.model.numerics.coarsened(factor)
        return replace(self, model=replace(self.model, numerics=numerics))

    def __post_init__(self) -> None:
        row = self.device.actuators
        reach = max(abs(x) for x in row.positions) + row.width / 2.0
        _require(
            reach < self.model.finger.width / 2.0,
            f"{self.device.name}: an actuator reaches x = {reach:g} mm, beyond the finger's half width"
            f" {self.model.finger.width / 2.0:g} mm",
        )
