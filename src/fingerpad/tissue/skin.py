"""The deformed skin as a line, and whether it crosses itself.

Contact knows actuators and skin, not skin and skin: where a fold of the skin would touch itself the line runs through
itself, which elements need not notice, as each of them may stay upright.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..errors import CrossingError
from .compliance import MIRROR
from .mesh import SectionMesh


@dataclass(frozen=True)
class Skin:
    """Nodes of the skin along its line, or of its right half: undeformed (n, 2) [mm], and their unknowns (n, 2)."""

    position: FloatArray
    unknowns: np.ndarray
    halved: bool


def skin_of(section: SectionMesh, dofs: np.ndarray, halved: bool) -> Skin:
    """The skin of a section whose nodes have the unknowns (2, n_nodes)."""
    nodes = section.skin
    if halved:
        nodes = nodes[section.mesh.doflocs[0, nodes] >= 0.0]
    return Skin(section.mesh.doflocs[:, nodes].T, dofs[:, nodes].T, halved)


def require_uncrossed(skin: Skin, displacement: FloatArray, when: str) -> None:
    """Raise CrossingError, with the place, if the skin crosses itself at a displacement (size,) [mm]."""
    line = skin.position + displacement[skin.unknowns]
    if skin.halved:
        line = np.concatenate([line[::-1] * MIRROR, line])
    found = crossing(line)
    if found is not None:
        x, y = line[found[0]]
        raise CrossingError(f"the skin crosses itself near x, y = {x:.3f}, {y:.3f} mm {when}; try less indentation")


def crossing(line: FloatArray) -> tuple[int, int] | None:
    """The first two segments, by their first points, in which a polyline (n, 2) crosses itself, or None.

    Segments are compared where they overlap in x, which few do on a line that hardly turns back. Those that only touch
    do not cross.

    >>> crossing(np.array([[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]))
    (0, 2)
    """
    start, end = line[:-1], line[1:]
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.argsort(low[:, 0])
    place = np.arange(order.size)
    count = np.searchsorted(low[order, 0], high[order, 0], side="right") - place - 1
    first = np.repeat(place, count)
    second = first + 1 + np.arange(first.size) - np.repeat(np.cumsum(count) - count, count)
    one, two = np.sort(np.stack([order[first], order[second]]), axis=0)
    near = (two - one > 1) & (low[one, 1] <= high[two, 1]) & (low[two, 1] <= high[one, 1])
    one, two = one[near], two[near]
    crossed = _on_both_sides(start, end, one, two) & _on_both_sides(start, end, two, one)
    if not crossed.any():
        return None
    at = np.flatnonzero(crossed)[np.argmin(one[crossed])]
    return int(one[at]), int(two[at])


def _on_both_sides(start: FloatArray, end: FloatArray, one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Whether segments `two` (k,) end on different sides of the lines through segments `one` (k,)."""
    along = (end - start)[one]
    sides = [along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0] for to in (start[two] - start[one], end[two] - start[one])]
    return sides[0] * sides[1] < 0.0
