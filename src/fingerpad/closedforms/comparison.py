"""A computed number or field compared with its closed form: on one mesh, on two, and on ever finer ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray

ACCURACY = 0.005  # error [1]; source: what scores are to have
FIELD_TOLERANCE = 0.002  # error of displacement, strain and stress in tissue [1]; source: below half of ACCURACY
ORDERS = {"displacement": 3.0, "gradient": 2.0, "energy": 2.0}  # of second-order elements [1]; source: Ciarlet 1978
# of an order [1]; source: the error's next term (0.015 for a bent block at nu = 0.4999, measured), and layers that keep
# their thickness, so that meshes are no scaled copies of each other
SHORTFALL = 0.05
ORDER_OF = "order, "  # before the name of a quantity whose error falls with it
EXACT_ORDER = 8  # of quadrature; source: the exact fields are smooth: its error is far below the elements'


@dataclass(frozen=True)
class Comparison:
    """One row of the accuracy table.

    case, quantity: what is compared. spacing: length of an element where it matters [mm]. unknowns: of the mesh [1].
    computed, exact: the number, or a field's root mean square. error: relative [1]; of a field, the root mean square of
    the difference over that of the exact field. tolerance: largest error allowed [1]; None where nothing is asked.
    """

    case: str
    quantity: str
    spacing: float
    unknowns: int
    computed: float
    exact: float
    error: float
    tolerance: float | None


def compare(
    case: str,
    quantity: str,
    mesh: tuple[float, int],
    computed: FloatArray | float,
    exact: FloatArray | float,
    tolerance: float | None,
) -> Comparison:
    """Compare a number, or a field (n,), with its exact value. mesh: spacing [mm] and unknowns [1]."""
    found, wanted = np.atleast_1d(computed), np.atleast_1d(exact)
    if wanted.size == 1:
        values = float(found[0]), float(wanted[0])
    else:
        values = root_mean_square(found), root_mean_square(wanted)
    error = root_mean_square(found - wanted) / root_mean_square(wanted)
    return Comparison(case, quantity, *mesh, *values, error, tolerance)


def compare_fields(
    case: str, quantity: str, mesh: tuple[float, int], computed: FloatArray, exact: FloatArray, dx: FloatArray
) -> Comparison:
    """Compare fields (..., n_elements, n_points) in the norm L2, with no tolerance.

    mesh: as `compare` takes it. dx: (n_elements, n_points) weights of the quadrature points [mm2]. The root mean
    squares in the row are those of the fields times the roots of the weights.
    """
    root = np.sqrt(dx)  # a sum of squares times dx is an integral
    return compare(case, quantity, mesh, (computed * root).ravel(), (exact * root).ravel(), None)


def orders(
    coarse: Iterable[Comparison], fine: Iterable[Comparison], finer: float, wanted: dict[str, float]
) -> list[Comparison]:
    """Orders with which the errors of some quantities fall from a mesh to one whose elements are `finer` times smaller.

    wanted: order [1] by quantity. The error of an order is how far it falls short, relative [1], by SHORTFALL at most.
    """
    before = {row.quantity: row.error for row in coarse}
    found = []
    for row in (row for row in fine if row.quantity in wanted):
        order = float(np.log(before[row.quantity] / row.error) / np.log(finer))
        exact = wanted[row.quantity]
        shortfall = max(1.0 - order / exact, 0.0)  # what falls faster is no error
        name = ORDER_OF + row.quantity
        found.append(replace(row, quantity=name, computed=order, exact=exact, error=shortfall, tolerance=SHORTFALL))
    return found


def root_mean_square(values: FloatArray) -> float:
    """Root mean square of a field (n,)."""
    return float(np.sqrt(np.mean(np.square(values))))


def refined(case: Callable[[float], list[Comparison]], spacings: Iterable[float]) -> list[Comparison]:
    """A case on ever finer meshes: tolerances hold on the finest, the others show how the error falls."""
    rows = [case(spacing) for spacing in sorted(spacings, reverse=True)]
    return [replace(row, tolerance=None) for coarse in rows[:-1] for row in coarse] + rows[-1]


def on_two_meshes(
    case: Callable[[int], list[Comparison]], divisions: tuple[int, int], tolerance: float, wanted: dict[str, float]
) -> list[Comparison]:
    """A case on two meshes: the tolerance [1], and the orders `wanted` with which some errors fall, hold on the finer.

    divisions: of a side of the block, from which the case makes its mesh [1].
    """
    coarse, fine = (case(each) for each in divisions)
    held = [replace(row, tolerance=tolerance) for row in fine]
    return [*coarse, *held, *orders(coarse, fine, divisions[1] / divisions[0], wanted)]


def on_spacings(case: Callable[[float], list[Comparison]], spacings: Iterable[float]) -> list[Comparison]:
    """A case on ever finer meshes, with no tolerance but for the ORDERS with which errors fall on the last two."""
    found = [case(spacing) for spacing in spacings]
    coarse, fine = found[-2:]
    finer = float(np.sqrt(fine[0].unknowns / coarse[0].unknowns))  # times smaller elements, on the whole
    return [row for mesh in found for row in mesh] + orders(coarse, fine, finer, ORDERS)
