"""The finger's section: outline, bone, layers of tissue and their materials."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..requirements import require, require_positive


@dataclass(frozen=True)
class Material:
    """Isotropic linear elastic material: Young's modulus [MPa] and Poisson's ratio [1].

    Raises SceneError if the modulus is not positive, or the ratio not above -1 and below 0.5.
    """

    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        require_positive("material", modulus=self.modulus)
        require(
            -1.0 < self.poisson < 0.5,
            f"material: poisson must lie between -1 and 0.5 (0.5 itself is incompressible), found {self.poisson}",
        )


@dataclass(frozen=True)
class Layer:
    """One tissue layer: name, thickness [mm] along the outline's normal, material.

    Raises SceneError if the thickness is not positive.
    """

    name: str
    thickness: float
    material: Material

    def __post_init__(self) -> None:
        require_positive(f"layer {self.name}", thickness=self.thickness)


@dataclass(frozen=True)
class Finger:
    """Transverse section of the fingertip: elliptical outline, elliptical rigid bone, layers from the outside in.

    The last layer of each stack fills up to the bone; on the mid-line its thickness is exact, and that is what
    places the bone. Every other layer has its thickness along the outline's normal everywhere.

    width, height: of the outline [mm]. bone_width: [mm]. nail_width: arc length of the dorsal outline that carries
    nail and nail bed [mm]. pad, dorsal: layers from the outside in.

    Raises SceneError if a size is not positive, the stacks leave no bone, or bone, nail or layers do not fit the
    outline.
    """

    width: float
    height: float
    bone_width: float
    nail_width: float
    pad: tuple[Layer, ...]
    dorsal: tuple[Layer, ...]

    def __post_init__(self) -> None:
        require_positive(
            "finger",
            width=self.width,
            height=self.height,
            bone_width=self.bone_width,
            nail_width=self.nail_width,
        )
        require(len(self.pad) >= 2 and len(self.dorsal) >= 1, "finger: pad needs two layers or more, dorsal one")
        require(
            self.bone_height > 0,
            f"finger: the layers leave no bone: pad {self.pad_thickness:g} mm + dorsal {self.dorsal_thickness:g} mm"
            f" >= height {self.height:g} mm",
        )
        for name, thickness in (("pad", self.pad_thickness), ("dorsal", self.dorsal_thickness)):
            require(
                self.parallel_depth < thickness,
                f"finger: the {name} layers are {thickness:g} mm thick together and must reach below"
                f" {self.parallel_depth:g} mm, where the last layer of the other side begins",
            )
        half_outline = math.pi * (self.width + self.height) / 4.0
        require(
            self.nail_width < half_outline,
            f"finger: nail_width {self.nail_width:g} mm must be less than half the outline, {half_outline:.1f} mm:"
            " the pad is the rest",
        )
        offset = self.parallel_depth
        smallest_radius = min(self.height**2 / self.width, self.width**2 / self.height) / 2.0
        require(
            offset < smallest_radius,
            f"finger: the layers above the last one are {offset:g} mm thick, more than the outline's smallest radius"
            f" of curvature {smallest_radius:g} mm",
        )
        require(
            self.bone_width / 2.0 < self.width / 2.0 - offset,
            f"finger: bone_width {self.bone_width:g} mm does not fit into width {self.width:g} mm"
            f" less {offset:g} mm of layers on each side",
        )

    @property
    def layers(self) -> tuple[Layer, ...]:
        """All layers, those of the pad first."""
        return (*self.pad, *self.dorsal)

    def skin_height(self, x: FloatArray) -> FloatArray:
        """Height (n,) [mm] of the pad's undeformed skin above its lowest point, at x (n,) [mm] from the mid-line."""
        height: FloatArray = self.height / 2.0 * (1.0 - np.sqrt(1.0 - (2.0 * x / self.width) ** 2))
        return height

    @property
    def materials(self) -> list[Material]:
        """Materials of all layers, in their order."""
        return [layer.material for layer in self.layers]

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
