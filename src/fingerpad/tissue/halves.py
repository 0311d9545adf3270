"""Halves of a section that is its own mirror image: the parts that are solved, and maps unfolded from them.

Half the section is condensed under loads that mirror (the mid-line does not move sideways) and under loads that mirror
with the opposite sign (it moves sideways only). A load on one side is half the sum of both:
    u_right = (C_sym + C_anti) f / 2,      u_left = mirror of (C_sym - C_anti) f / 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix

from ..arrays import FloatArray
from .compliance import MIRROR
from .elasticity import mesh_dofs, unit_loads
from .mesh import SectionMesh
from .traction import Tractions


@dataclass(frozen=True)
class Parts:
    """The tissue that is solved: the section, or its right half under loads that mirror, and that mirror with the
    opposite sign.

    elements: of the section. dofs: (2, n_nodes) unknowns of nodes. held, loads: for each kind of loads the unknowns
    that do not move, and the nodal forces (n_unknowns, 2m) of unit contact forces.
    """

    elements: np.ndarray
    dofs: np.ndarray
    held: Sequence[np.ndarray]
    loads: Sequence[csc_matrix]


def whole(section: SectionMesh, tractions: Tractions) -> Parts:
    """The whole section."""
    # ASSUME: finger: the bone alone holds the finger; skin beside the actuators and the nail bear nothing
    dofs = mesh_dofs(section.mesh)
    loads = csc_matrix(unit_loads(dofs, tractions.nodes, dofs.size) @ tractions.by_component())
    return Parts(np.arange(section.mesh.t.shape[1]), dofs, [dofs[:, section.fixed].ravel()], [loads])


def right_half(section: SectionMesh, tractions: Tractions) -> Parts:
    """The right half of a section; of contact nodes in the middle the right half takes the one on the mid-line."""
    x = section.mesh.doflocs[0]
    elements = np.flatnonzero(x[section.mesh.t].mean(axis=0) > 0.0)
    dofs = mesh_dofs(section.mesh)
    still, axis = np.union1d(dofs[:, section.fixed], dofs[:, x < 0.0]), dofs[:, x == 0.0]
    held = [np.union1d(still, axis[sideways]) for sideways in (0, 1)]
    first = 2 * (tractions.position.shape[0] // 2)
    loads = [each[:, first:] for each in _folded_loads(section, tractions, dofs)]
    return Parts(elements, dofs, held, loads)


def _folded_loads(section: SectionMesh, tractions: Tractions, dofs: np.ndarray) -> tuple[csc_matrix, csc_matrix]:
    """Nodal forces (n_unknowns, 2m) on the right half from unit resultants that act together with their mirror image,
    and against it.
    """
    index = np.flatnonzero(np.isin(section.skin, tractions.nodes))
    x = section.mesh.doflocs[0, tractions.nodes]
    right, mirror = dofs[:, section.skin[index]].T, dofs[:, section.skin[::-1][index]].T
    forces = tractions.by_component()
    sides = []
    for unknowns, there, sign in ((right, x >= 0.0, 1.0), (mirror, x < 0.0, MIRROR)):
        own = np.flatnonzero(np.repeat(there, 2))
        signs = (sign * np.ones_like(unknowns)).ravel()[own]
        placing = csc_matrix((signs, (unknowns.ravel()[own], own)), shape=(dofs.size, unknowns.size))
        sides.append(placing @ forces)
    return csc_matrix(sides[0] + sides[1]), csc_matrix(sides[0] - sides[1])


@dataclass(frozen=True)
class Unfolding:
    """How points of the whole section lie on its right half: place (n,) there, side (n,) +-1, mirror signs (c,)."""

    place: np.ndarray
    side: np.ndarray
    mirror: FloatArray

    def unknowns(self) -> np.ndarray:
        """Row or column of the half's map for every component (n c,)."""
        count = self.mirror.size
        return (count * self.place[:, None] + np.arange(count)).ravel()

    def signs(self) -> FloatArray:
        """Sign (n c,) of every component: 1 on the right, the mirror's on the left."""
        return np.where(self.side[:, None] > 0, 1.0, self.mirror).ravel()


def unfolding(count: int, mirror: FloatArray) -> Unfolding:
    """Unfolding of `count` points on a line that mirrors end to end; a point in the middle lies on the right."""
    line = np.arange(count)
    left = count // 2
    on_right = line >= left
    return Unfolding(np.where(on_right, line, line[::-1]) - left, np.where(on_right, 1, -1), mirror)


def unfold(symmetric: FloatArray, antisymmetric: FloatArray, rows: Unfolding, columns: Unfolding) -> FloatArray:
    """Map of the whole section from those of its half under mirrored and counter-mirrored loads."""
    block = np.ix_(rows.unknowns(), columns.unknowns())
    together = np.outer(np.repeat(rows.side, rows.mirror.size), np.repeat(columns.side, columns.mirror.size))
    signs = np.outer(rows.signs(), columns.signs())
    return signs * (symmetric[block] + together * antisymmetric[block]) / 2.0
