"""One comparison of a computed number or field with its closed form, and how many make a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray

ACCURACY = 0.005  # error [1]; source: what scores are to have
ORDERS = {"displacement": 3.0, "gradient": 2.0, "energy": 2.0}  # of second-order elements [1]; source: Ciarlet 1978
ORDER_OF = "order, "  # before the name of a quantity whose error falls with it


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


def orders(
    coarse: Iterable[Comparison], fine: Iterable[Comparison], finer: float, wanted: dict[str, float], tolerance: float
) -> list[Comparison]:
    """Orders with which the errors of some quantities fall from a mesh to one whose elements are `finer` times smaller.

    wanted: order [1] by quantity. tolerance: largest shortfall of an order, relative [1].
    """
    before = {row.quantity: row.error for row in coarse}
    found = []
    for row in (row for row in fine if row.quantity in wanted):
        order = float(np.log(before[row.quantity] / row.error) / np.log(finer))
        exact = wanted[row.quantity]
        shortfall = max(1.0 - order / exact, 0.0)  # what falls faster is no error
        name = ORDER_OF + row.quantity
        found.append(replace(row, quantity=name, computed=order, exact=exact, error=shortfall, tolerance=tolerance))
    return found


def root_mean_square(values: FloatArray) -> float:
    """Root mean square of a field (n,)."""
    return float(np.sqrt(np.mean(np.square(values))))


def refined(case: Callable[[float], list[Comparison]], spacings: Iterable[float]) -> list[Comparison]:
    """A case on ever finer meshes: tolerances hold on the finest, the others show how the error falls."""
    rows = [case(spacing) for spacing in sorted(spacings, reverse=True)]
    return [replace(row, tolerance=None) for coarse in rows[:-1] for row in coarse] + rows[-1]


def on_two_meshes(
    case: Callable[[int], list[Comparison]],
    divisions: tuple[int, int],
    tolerance: float,
    wanted: dict[str, float],
    shortfall: float,
) -> list[Comparison]:
    """A case on two meshes: the tolerance, and the orders with which some errors fall, hold on the finer."""
    coarse, fine = (case(each) for each in divisions)
    held = [replace(row, tolerance=tolerance) for row in fine]
    return [*coarse, *held, *orders(coarse, fine, divisions[1] / divisions[0], wanted, shortfall)]


def on_spacings(
    case: Callable[[float], list[Comparison]], spacings: Iterable[float], shortfall: float
) -> list[Comparison]:
    """A case on ever finer meshes, with no tolerance but for the ORDERS with which errors fall on the last two."""
    found = [case(spacing) for spacing in spacings]
    coarse, fine = found[-2:]
    finer = float(np.sqrt(fine[0].unknowns / coarse[0].unknowns))  # times smaller elements, on the whole
    return [row for mesh in found for row in mesh] + orders(coarse, fine, finer, ORDERS, shortfall)
