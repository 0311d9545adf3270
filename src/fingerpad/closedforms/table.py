"""All comparisons with closed forms, in the order of the table's rows."""

from __future__ import annotations

from collections.abc import Callable

from ..scene.scene import Scene
from . import (
    bending,
    cattaneo,
    finite_manufactured,
    finite_patch,
    hertz,
    incompressible,
    layers,
    manufactured,
    patch,
    punch,
    spence,
    wave,
)
from .comparison import Comparison

CASES: dict[str, Callable[[Scene], list[Comparison]]] = {
    "patch": lambda scene: patch.rows(),
    "manufactured": manufactured.rows,
    "punch": lambda scene: punch.rows(),
    "hertz": lambda scene: hertz.rows(),
    "cattaneo": lambda scene: cattaneo.rows(),
    "spence": lambda scene: spence.rows(),
    "layers": lambda scene: layers.rows(scene.model),
    "incompressible": lambda scene: incompressible.rows(scene.model),
    "wave": lambda scene: wave.rows(),
    "finite_patch": lambda scene: finite_patch.rows(),
    "finite_manufactured": finite_manufactured.rows,
    "bending": lambda scene: bending.rows(),
}
