"""Near incompressibility: the same closed forms at nu = 0.4999, where an element that locks would be far too stiff.

Displacement, fronts of contact and pressures keep their tolerances. Strain at receptor depth converges late and stands
in the table without one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from ..scene.finger import Layer
from ..scene.scene import Model
from . import hertz, layers, punch
from .blocks import NEAR_LIMIT
from .comparison import Comparison, refined

DISPLACEMENT = "displacement"


def rows(model: Model) -> list[Comparison]:
    """Flat punch, Hertz, and the pad's layers with their Poisson ratios replaced."""
    soft = [replace(la, material=replace(la.material, poisson=NEAR_LIMIT)) for la in model.finger.pad]
    return [
        *refined(partial(punch.flat_punch, poisson=NEAR_LIMIT), punch.SPACINGS),
        *refined(partial(hertz.hertz, poisson=NEAR_LIMIT), hertz.SPACINGS),
        *(row for load in layers.Load for row in _layered(soft, model.layers_above, load)),
    ]


def _layered(soft: Sequence[Layer], above: int, load: layers.Load) -> list[Comparison]:
    """The layers under one load; only displacement has a tolerance."""
    case = partial(layers.layered, f"layers, nu = {NEAR_LIMIT:g}", soft, above, load)
    found = refined(case, layers.SPACINGS)
    return _without(found, {row.quantity for row in found} - {DISPLACEMENT})


def _without(rows: Sequence[Comparison], quantities: set[str]) -> list[Comparison]:
    """The rows, those of some quantities without tolerance."""
    return [replace(row, tolerance=None) if row.quantity in quantities else row for row in rows]
