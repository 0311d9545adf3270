"""Condensation: the tissue's stiffness, factorised once, reduced to two small dense maps.

With forces f on the skin that actuators can reach (`reach`), nodal forces W f, and everything else unloaded,
    K u = W f,      u_c = W^T u = C f      displacement of the skin in contact; C compliance
                    eps_r = B u = E f      strain along the receptor line.
K is factorised once, with W^T and B as rows below it, out of which both maps come (`factors`, docs/decisions/0045).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix, hstack, vstack
from threadpoolctl import threadpool_limits

from ..arrays import FloatArray
from ..errors import CondensationError
from ..scene.scene import Scene
from .compliance import MIRROR, MIRROR_VOIGT, VOIGT, CondensedSection
from .elasticity import displacement_basis, stiffness, unit_forces
from .factors import Factors, backward_error, factorise, fill_reducing_order
from .halves import Parts, right_half, unfold, unfolding, whole
from .mesh import SectionMesh
from .reach import contact_tractions
from .receptors import arc_length, receptor_strain
from .traction import Tractions

RESIDUAL_TOLERANCE = 1e-12  # backward error [1]; source: 1e4 units of rounding for factors of 1e4 unknowns
READ_TOLERANCE = 1e-5  # of displacements [1]; source: any solution of contrast 1e6 is off by 2e-6 (measured)


@dataclass(frozen=True)
class Answers:
    """Compliance (k, k) and strain map (n_rows, k) of k loads on a factorised stiffness.

    residual: relative, of a solution's equilibrium [1]. off: displacements by the compliance from that solution's [1].
    """

    factors: Factors
    compliance: FloatArray
    strain: FloatArray
    residual: float
    off: float


def section_stiffness(section: SectionMesh, scene: Scene, elements: np.ndarray | None = None) -> csc_matrix:
    """Stiffness (n_unknowns, n_unknowns) of the section, or of some elements [N/mm per mm]."""
    layer = section.layer if elements is None else section.layer[elements]
    return stiffness(displacement_basis(section.mesh, elements), scene.model.finger.materials, layer)


def condense_section(section: SectionMesh, scene: Scene) -> CondensedSection:
    """Condense the finger to contact nodes and receptor line, where it mirrors by halves (`halves`).

    Raises CondensationError as `condense`, MeshError as `contact_tractions`.
    """
    tractions = contact_tractions(section, scene)
    parts = parts_of(section, scene, tractions)
    matrix = section_stiffness(section, scene, parts.elements)
    return condense_parts(section, scene, tractions, parts, matrix)


def parts_of(section: SectionMesh, scene: Scene, tractions: Tractions) -> Parts:
    """What is condensed of a section: its right half if it mirrors, or with that skip off the whole of it."""
    halved = scene.model.skips.halved_condensation and section.mirrors
    return right_half(section, tractions) if halved else whole(section, tractions)


def condense_parts(
    section: SectionMesh,
    scene: Scene,
    tractions: Tractions,
    parts: Parts,
    matrix: csc_matrix,
    nodal: csr_matrix | None = None,
) -> CondensedSection:
    """`condense_section` of tissue with any stiffness. nodal: (n_unknowns, n_unknowns) displacements of all nodes by
    the unknowns that parts and matrix are of; None if they are these. Raises CondensationError.
    """
    points, strain = receptor_strain(section, scene)
    strain = strain if nodal is None else csr_matrix(strain @ nodal)
    if len(parts.loads) > 1:
        columns = unfolding(tractions.position.shape[0], MIRROR)
        rows = unfolding(points.shape[0], MIRROR_VOIGT)
        read = strain[VOIGT * np.count_nonzero(rows.side < 0) :]
        together, against, residual = _condensed_halves(matrix, parts, read)
        compliance = unfold(together[0], against[0], columns, columns)
        strain_map = unfold(together[1], against[1], rows, columns)
    else:
        found = condense(matrix, parts.dofs, parts.held[0], parts.loads[0], strain)
        compliance, strain_map, residual = found.compliance, found.strain, found.residual
    arc = arc_length(points)
    return CondensedSection(
        position=tractions.position,
        weight=tractions.weight,
        compliance=compliance,
        receptor=points,
        arc=arc,
        strain=strain_map,
        residual=residual,
    )


def _condensed_halves(
    matrix: csc_matrix, parts: Parts, read: csr_matrix
) -> tuple[tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray], float]:
    """Compliance and strain map under loads that mirror, the same under those that mirror with the opposite sign, and
    the residual. Raises CondensationError.

    One factorisation serves both: what the mid-line is held by are forces that take back its displacement,
        C = C_LL - C_LH C_HH^-1 C_HL,
    L: the loads, H: unit forces on the components that are held, as few as the mid-line has nodes.
    """
    mirrored, opposite = parts.loads
    still = np.intersect1d(parts.held[0], parts.held[1])
    axes = [unit_forces(np.setdiff1d(held, still), matrix.shape[0]) for held in parts.held]
    across = np.flatnonzero(abs(mirrored - opposite).sum(axis=0))  # loads that reach over the mid-line
    all_loads = csc_matrix(hstack([mirrored, opposite[:, across], *axes]))
    found = condense(matrix, parts.dofs, still, all_loads, read)

    ends = np.cumsum([mirrored.shape[1], across.size, *(axis.shape[1] for axis in axes)])
    first = np.arange(ends[0])
    second = first.copy()
    second[across] = np.arange(ends[0], ends[1])
    together = _holding(found, first, np.arange(ends[1], ends[2]))
    against = _holding(found, second, np.arange(ends[2], ends[3]))
    return together, against, found.residual


def _holding(found: Answers, loads: np.ndarray, held: np.ndarray) -> tuple[FloatArray, FloatArray]:
    """Maps of some loads (k,) while forces that belong to other columns (h,) keep their own displacements at zero.
    Raises CondensationError.
    """
    compliance, strain = found.compliance, found.strain
    try:
        reaction = np.linalg.solve(compliance[np.ix_(held, held)], compliance[np.ix_(held, loads)])
    except np.linalg.LinAlgError:
        raise CondensationError("nothing holds the section's halves apart but its mid-line") from None
    left = compliance[np.ix_(loads, loads)] - compliance[np.ix_(loads, held)] @ reaction
    return (left + left.T) / 2.0, strain[:, loads] - strain[:, held] @ reaction


def condense(matrix: csc_matrix, dofs: np.ndarray, fixed: np.ndarray, loads: csc_matrix, strain: csr_matrix) -> Answers:
    """Compliance (k, k) and strain map (n_rows of strain, k) of k loads.

    matrix: stiffness; dofs: (2, n_nodes) unknowns of the nodes; fixed: unknowns that do not move (loads on them are
    borne without an answer); loads: nodal forces (n_unknowns, k) of unit forces; strain: rows that are read, as a
    linear map of all unknowns.

    Raises CondensationError if the stiffness is singular, if the residual is beyond RESIDUAL_TOLERANCE, or if
    displacements by the compliance are off those of a solution by more than READ_TOLERANCE.
    """
    order = fill_reducing_order(matrix, dofs, fixed)
    return condense_ordered(csc_matrix(matrix[order][:, order]), csc_matrix(loads[order]), strain[:, order])


def condense_ordered(
    permuted: csc_matrix, loads: csc_matrix, strain: csr_matrix, tolerance: float = READ_TOLERANCE
) -> Answers:
    """`condense` of a stiffness in a fill-reducing order, loads (size, k) and rows (n_rows, size).

    tolerance: of displacements, in place of READ_TOLERANCE. Raises CondensationError as that.
    """
    count = loads.shape[1]
    factors = factorise(permuted, csr_matrix(vstack([loads.T, strain])))
    with threadpool_limits(1):  # two threads take longer (decision 14), and results depend on their number
        read = factors.read(count)
    compliance = (read[:count] + read[:count].T) / 2.0  # Betti, but for rounding
    mix = np.random.default_rng(0).standard_normal(count)
    load = loads @ mix
    field = factors.solve(load)
    residual = backward_error(permuted, field, load)
    if not residual <= RESIDUAL_TOLERANCE:
        raise CondensationError(f"condensation: equilibrium residual {residual:.1e} > {RESIDUAL_TOLERANCE:.0e}")
    off = float(np.abs(loads.T @ field - compliance @ mix).max() / np.abs(field).max())
    if not off <= tolerance:
        raise CondensationError(f"condensation: displacements are off by {off:.1e} > {tolerance:.0e}")
    return Answers(factors, compliance, read[count:], residual, off)
