"""Condensation: the tissue's stiffness, factorised once, reduced to two small dense maps.

With the contact forces f (`traction`) and everything else unloaded, linear tissue answers
    u_c = C f            displacement of the skin in contact; C compliance
    eps_r = E f          strain along the receptor line.
Both come out of one sparse factorisation: the unknowns are ordered [interior, receptors, contact], so that the
trailing blocks of K = L U are factors of the Schur complement S of receptors and contact; C and E follow from them
with dense triangular solves and no right-hand side ever sees the interior.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse import csc_matrix, csr_matrix, diags_array
from scipy.sparse.linalg import SuperLU, splu

from .compliance import VOIGT, CondensedBody, CondensedSection
from .elasticity import displacement_basis, facet_strain, node_dofs, stiffness
from .errors import CondensationError, MeshError
from .mesh import SectionMesh, mesh_strip
from .scene import FloatArray, Scene, Side
from .traction import Tractions, linear_tractions

RESIDUAL_TOLERANCE = 1e-12  # backward error [1]; source: 1e4 units of rounding for factors of 1e4 unknowns
PIVOT_LIMIT = 1e-14  # of the largest pivot [1]; source: rounding; held tissue of contrast 1e6 stays above 1e-10
CONTACT_MARGIN = 0.25  # mm; source: skin moves about 0.1 mm sideways under the outermost actuators (measured)


def contact_tractions(section: SectionMesh, scene: Scene) -> Tractions:
    """Tractions on the skin that an actuator can reach: under a face, or within a margin and the stroke of one."""
    row = scene.device.actuators
    stroke = max(float(np.abs(condition.tangential).max()) for condition in scene.device.conditions)
    points = section.mesh.doflocs[:, section.skin]
    x, y = points[:, 1::2]
    distance = np.min(np.abs(x[:, None] - np.asarray(row.positions)), axis=1)
    near = distance <= row.width / 2.0 + stroke + CONTACT_MARGIN
    return linear_tractions(section.skin, points, near & (y < scene.model.finger.height / 2.0))


def section_stiffness(
    section: SectionMesh, scene: Scene, elements: np.ndarray | None = None
) -> tuple[csc_matrix, np.ndarray]:
    """Stiffness of the section, or of some elements [N/mm per mm], and the unknowns (2, n_nodes) of its nodes."""
    basis = displacement_basis(section.mesh, elements)
    finger = scene.model.finger
    materials = [layer.material for layer in (*finger.pad, *finger.dorsal)]
    layer = section.layer if elements is None else section.layer[elements]
    return stiffness(basis, materials, layer), node_dofs(basis)


def condense_section(section: SectionMesh, scene: Scene) -> CondensedSection:
    """Condense the finger to contact nodes and receptor line.

    The section is its own mirror image, so half of it is condensed twice: under loads that mirror (the mid-line does
    not move sideways) and under loads that mirror with the opposite sign (it moves sideways only). A load on one side
    is half the sum of both: u_right = (C_sym + C_anti) f / 2, u_left = mirror of (C_sym - C_anti) f / 2.

    Raises CondensationError if a factorisation leaves a residual beyond RESIDUAL_TOLERANCE.
    """
    x = section.mesh.doflocs[0]
    elements = np.flatnonzero(x[section.mesh.t].mean(axis=0) > 0.0)
    matrix, dofs = section_stiffness(section, scene, elements)
    points, strain = receptor_strain(section, scene)
    row_place, row_side = _folded(np.ones(points.shape[0], dtype=bool))
    tractions = contact_tractions(section, scene)
    near = np.isin(section.skin, tractions.nodes)
    either = near | near[::-1]
    place, side = _folded(either)
    right = section.skin[either][side > 0]
    still = np.union1d(dofs[:, section.fixed], dofs[:, x < 0.0])
    axis = dofs[:, x == 0.0]
    first = VOIGT * np.count_nonzero(row_side < 0)
    parts = [condense(matrix, dofs, np.union1d(still, axis[sideways]), right, strain[first:]) for sideways in (0, 1)]

    columns = _Unfolding(place, side, np.array([-1.0, 1.0]))
    rows = _Unfolding(row_place, row_side, np.array([1.0, 1.0, -1.0]))
    keep = np.repeat(near[either], 2)
    loads = tractions.by_component()
    compliance = _unfold(parts[0][0], parts[1][0], columns, columns)[np.ix_(keep, keep)]
    compliance = loads.T @ (compliance @ loads)
    return CondensedSection(
        tractions.position,
        tractions.weight,
        (compliance + compliance.T) / 2.0,  # Betti, but for rounding
        points,
        arc_length(points),
        _unfold(parts[0][1], parts[1][1], rows, columns)[:, keep] @ loads,
        max(part[2] for part in parts),
    )


@dataclass(frozen=True)
class _Unfolding:
    """How points of the whole section lie on its right half: place (n,) there, side (n,) +-1, mirror signs (c,)."""

    place: np.ndarray
    side: np.ndarray
    mirror: FloatArray

    def unknowns(self) -> np.ndarray:
        """Row or column of the half's map for every component (n c,)."""
        count = self.mirror.size
        return np.asarray((count * self.place[:, None] + np.arange(count)).ravel())

    def signs(self) -> FloatArray:
        """Sign (n c,) of every component: 1 on the right, the mirror's on the left."""
        return np.asarray(np.where(self.side[:, None] > 0, 1.0, self.mirror).ravel())


def _folded(chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place on the right half and side (+-1) of the chosen points of a line that mirrors end to end (n,)."""
    line = np.arange(chosen.size)
    side = np.where(2 * line >= chosen.size - 1, 1, -1)
    on_right = np.where(side > 0, line, line[::-1])
    rank = np.cumsum(chosen & (side > 0)) - 1
    return rank[on_right][chosen], side[chosen]


def _unfold(symmetric: FloatArray, antisymmetric: FloatArray, rows: _Unfolding, columns: _Unfolding) -> FloatArray:
    """Map of the whole section from those of its half under mirrored and counter-mirrored loads."""
    block = np.ix_(rows.unknowns(), columns.unknowns())
    together = np.outer(np.repeat(rows.side, rows.mirror.size), np.repeat(columns.side, columns.mirror.size))
    signs = np.outer(rows.signs(), columns.signs())
    return np.asarray(signs * (symmetric[block] + together * antisymmetric[block]) / 2.0)


def condense_body(scene: Scene) -> CondensedBody:
    """Condense the deformable body of the scene's actuators (all equal) to its face."""
    row = scene.device.actuators
    if row.body is None:
        raise MeshError("a rigid actuator has no body to condense")
    mesh = mesh_strip(row, scene.model.numerics)
    basis = displacement_basis(mesh)
    matrix = stiffness(basis, [row.body.material], np.zeros(mesh.t.shape[1], dtype=int))
    y = mesh.doflocs[1]
    face = np.flatnonzero(y == y.max())
    face = face[np.argsort(mesh.doflocs[0, face])]
    none = csr_matrix((0, matrix.shape[0]))
    dofs = node_dofs(basis)
    compliance, _, _ = condense(matrix, dofs, dofs[:, y == y.min()].ravel(), face, none)
    return CondensedBody(mesh.doflocs[0, face], compliance)


def condense(
    matrix: csc_matrix, dofs: np.ndarray, fixed: np.ndarray, contact: np.ndarray, strain: csr_matrix
) -> tuple[FloatArray, FloatArray, float]:
    """Compliance (2n, 2n), strain map (n_rows of strain, 2n) and relative residual for contact nodes `contact`.

    matrix: stiffness; dofs: (2, n_nodes) unknowns of the nodes; fixed: unknowns that do not move (a contact node's may
    be among them: it then answers no load); strain: rows that are read, as a linear map of all unknowns.

    Raises CondensationError if the stiffness is singular or the residual is beyond RESIDUAL_TOLERANCE.
    """
    all_loaded = dofs[:, contact].T.ravel()
    moving = ~np.isin(all_loaded, fixed)
    loaded = all_loaded[moving]
    read = np.setdiff1d(np.unique(strain.indices), np.concatenate([loaded, fixed]))
    free = np.ones(matrix.shape[0], dtype=bool)
    free[np.concatenate([loaded, read, fixed])] = False
    inner = _fill_reducing(matrix, dofs, free)
    order = np.concatenate([inner, read, loaded])
    permuted = csc_matrix(matrix[order][:, order])
    factors = _factorise(permuted, "NATURAL")
    kept = read.size + loaded.size
    first = order.size - kept
    if not np.array_equal(factors.perm_c[first:], np.arange(first, order.size)):
        raise CondensationError("the factorisation moved the contact unknowns: is the tissue in one piece?")

    pivots = np.abs(factors.U.diagonal())
    if pivots.min() < PIVOT_LIMIT * pivots.max():
        raise CondensationError("the stiffness is singular: nothing holds some of the tissue")

    lower = factors.L[first:, first:].toarray()
    upper = factors.U[first:, first:].toarray()
    unit = np.zeros((kept, loaded.size))
    unit[read.size + np.arange(loaded.size), np.arange(loaded.size)] = 1.0
    answer = solve_triangular(upper, solve_triangular(lower, unit, lower=True, unit_diagonal=True))
    compliance = np.zeros((all_loaded.size, all_loaded.size))
    compliance[np.ix_(moving, moving)] = (answer[read.size :] + answer[read.size :].T) / 2.0  # Betti, but for rounding
    residual = _residual(permuted, factors, answer)
    if not residual <= RESIDUAL_TOLERANCE:
        raise CondensationError(f"condensation: equilibrium residual {residual:.1e} > {RESIDUAL_TOLERANCE:.0e}")
    strain_map = np.zeros((strain.shape[0], all_loaded.size))
    strain_map[:, moving] = strain[:, order[first:]] @ answer
    return compliance, strain_map, residual


def receptor_strain(section: SectionMesh, scene: Scene) -> tuple[FloatArray, csr_matrix]:
    """Receptor points (m, 2) [mm] and their strain (3m, n_unknowns), read from the side that the scene asks for."""
    above = [layer.name for layer in scene.model.finger.pad].index(scene.model.readout.layer_above)
    wanted = above + 1 if scene.model.readout.side is Side.DERMIS else above
    adjacent = section.mesh.f2t[:, section.receptor_facets]
    element = np.where(section.layer[adjacent[0]] == wanted, adjacent[0], adjacent[1])
    points, strain = facet_strain(section.mesh, section.receptor_facets, element)
    # around the section's centre the angle ascends along the line, also where the line turns back in x
    order = np.argsort(np.arctan2(points[0], scene.model.finger.height / 2.0 - points[1]))
    rows = (VOIGT * order[:, None] + np.arange(VOIGT)).ravel()
    return points[:, order].T, strain[rows]


def arc_length(points: FloatArray) -> FloatArray:
    """Arc length (m,) [mm] along a polyline (m, 2), zero where x crosses the mid-line."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    middle = int(np.argmin(np.abs(points[:, 0])))
    around = slice(max(middle - 1, 0), middle + 2)
    return arc - float(np.interp(0.0, points[around, 0], arc[around]))


def _fill_reducing(matrix: csc_matrix, dofs: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Fill-reducing order of the free unknowns, found on the graph of nodes (an eighth of the work)."""
    nodes = np.flatnonzero(free[dofs].any(axis=0))
    first = dofs[0, nodes]
    graph = csc_matrix(matrix[first][:, first])
    graph.data[:] = -1.0
    graph = csc_matrix(graph + diags_array(np.full(nodes.size, 2.0 * np.diff(graph.indptr).max())))
    permutation = _factorise(graph, "MMD_AT_PLUS_A").perm_c
    order = np.empty_like(permutation)
    order[permutation] = np.arange(permutation.size)
    ordered = dofs[:, nodes[order]].T.ravel()
    return np.asarray(ordered[free[ordered]])


def _factorise(matrix: csc_matrix, ordering: str) -> SuperLU:
    """LU factors without pivoting: the matrix is symmetric and positive definite."""
    return splu(matrix, permc_spec=ordering, diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def _residual(matrix: csc_matrix, factors: SuperLU, answer: FloatArray) -> float:
    """Backward error [1] of K u = f for one random load on the contact unknowns, with the condensed answer inside.

    max |K u - f| / (max row sum of |K| times max |u|): what is left after the rounding that the numbers allow.
    """
    load = np.random.default_rng(0).standard_normal((answer.shape[1],))
    right = np.zeros(matrix.shape[0])
    right[-load.size :] = load
    field = factors.solve(right)
    field[-answer.shape[0] :] = answer @ load
    scale = float(np.abs(matrix).sum(axis=1).max()) * float(np.abs(field).max())
    return float(np.abs(matrix @ field - right).max()) / scale
