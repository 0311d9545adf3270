"""Condensation: the tissue's stiffness, factorised once, reduced to two small dense maps.

With forces f on the skin that actuators can reach (`traction`), nodal forces L f, and everything else unloaded,
    K u = L f,      u_c = L^T u = C f      displacement of the skin in contact; C compliance
                    eps_r = B u = E f      strain along the receptor line.
K is factorised once, and a solution for every unit force gives a column of both maps (docs/decisions/0014).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse import csc_matrix, csr_matrix, diags_array, hstack
from scipy.sparse.linalg import SuperLU, splu
from threadpoolctl import threadpool_limits

from .compliance import GRADIENT, VOIGT, CondensedBody, CondensedSection
from .elasticity import displacement_basis, facet_gradient, node_dofs, stiffness, strain_of_gradient
from .errors import CondensationError, MeshError
from .mesh import SectionMesh, mesh_strip
from .scene import FloatArray, Scene, Side
from .traction import Tractions, linear_tractions

RESIDUAL_TOLERANCE = 1e-12  # backward error [1]; source: 1e4 units of rounding for factors of 1e4 unknowns
TRAILING_TOLERANCE = 1e-8  # of displacements [1]; source: a soft mode magnifies rounding; Newton corrects the rest
PIVOT_LIMIT = 1e-14  # of the largest pivot [1]; source: rounding; held tissue of contrast 1e6 stays above 1e-10
AT_ONCE = 32  # solutions [1] in one call; source: fewest seconds of 8, 16, 32, 64, 314 (measured)
MAX_CONTACT = 4000  # skin nodes that may come into contact [1]; source: their compliance then takes half a gigabyte
BODY_FINER = 2.0  # times [1] smaller elements of actuators' bodies than of skin; source: decision 24
CONTACT_MARGIN = 0.25  # mm; source: skin moves about 0.1 mm sideways under the outermost actuators (measured)


def contact_tractions(section: SectionMesh, scene: Scene) -> Tractions:
    """Tractions on the skin that an actuator can reach: under a face, or within a margin and the stroke of one; and on
    its mirror image. Raises MeshError if no element lies there, or more than MAX_CONTACT nodes.
    """
    row = scene.device.actuators
    stroke = max(float(np.abs(condition.tangential).max()) for condition in scene.device.conditions)
    points = section.mesh.doflocs[:, section.skin]
    x, y = points
    distance = np.min(np.abs(x[:, None] - np.asarray(row.positions)), axis=1)
    within = (distance <= row.width / 2.0 + stroke + CONTACT_MARGIN) & (y < scene.model.finger.height / 2.0)
    out_of_reach = (x == 0.0) & ~within  # without such a node both halves are alike, and one is enough
    near = within[1::2] & ~out_of_reach[:-1:2] & ~out_of_reach[2::2]
    if not near.any():
        raise MeshError(
            f"{scene.device.name}: no element of the skin lies within reach of an actuator; try a smaller"
            " numerics.face_size"
        )
    tractions = linear_tractions(section.skin, points, near | near[::-1])
    if tractions.weight.size > MAX_CONTACT:
        raise MeshError(
            f"{scene.device.name}: {tractions.weight.size} skin nodes may come into contact, more than {MAX_CONTACT};"
            " try larger numerics.edge_size and numerics.face_size"
        )
    return tractions


def section_stiffness(
    section: SectionMesh, scene: Scene, elements: np.ndarray | None = None
) -> tuple[csc_matrix, np.ndarray]:
    """Stiffness of the section, or of some elements [N/mm per mm], and the unknowns (2, n_nodes) of its nodes."""
    basis = displacement_basis(section.mesh, elements)
    finger = scene.model.finger
    materials = [layer.material for layer in finger.layers]
    layer = section.layer if elements is None else section.layer[elements]
    return stiffness(basis, materials, layer), node_dofs(basis)


def condense_section(section: SectionMesh, scene: Scene) -> CondensedSection:
    """Condense the finger to contact nodes and receptor line.

    The section is its own mirror image, so half of it is condensed twice: under loads that mirror (the mid-line does
    not move sideways) and under loads that mirror with the opposite sign (it moves sideways only). A load on one side
    is half the sum of both: u_right = (C_sym + C_anti) f / 2, u_left = mirror of (C_sym - C_anti) f / 2.

    Raises CondensationError if a factorisation leaves a residual beyond RESIDUAL_TOLERANCE, MeshError if too many nodes
    may come into contact.
    """
    tractions = contact_tractions(section, scene)
    halved = scene.model.skips.halved_condensation
    parts = right_half(section, tractions) if halved else whole(section, tractions)
    matrix, _ = section_stiffness(section, scene, parts.elements)
    return condense_parts(section, scene, tractions, parts, matrix)


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
        columns = unfolding(tractions.position.shape[0], np.array([-1.0, 1.0]))
        rows = unfolding(points.shape[0], np.array([1.0, 1.0, -1.0]))
        read = strain[VOIGT * np.count_nonzero(rows.side < 0) :]
        together, against, residual = _condensed_halves(matrix, parts, read)
        compliance = unfold(together[0], against[0], columns, columns)
        strain_map = unfold(together[1], against[1], rows, columns)
    else:
        compliance, strain_map, residual = condense(matrix, parts.dofs, parts.held[0], parts.loads[0], strain)
    arc = arc_length(points)
    return CondensedSection(tractions.position, tractions.weight, compliance, points, arc, strain_map, residual)


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
    compliance, strain_map, residual = condense(matrix, parts.dofs, still, all_loads, read)

    ends = np.cumsum([mirrored.shape[1], across.size, *(axis.shape[1] for axis in axes)])
    first = np.arange(ends[0])
    second = first.copy()
    second[across] = np.arange(ends[0], ends[1])
    together = _holding(compliance, strain_map, first, np.arange(ends[1], ends[2]))
    against = _holding(compliance, strain_map, second, np.arange(ends[2], ends[3]))
    return together, against, residual


def _holding(
    compliance: FloatArray, strain: FloatArray, loads: np.ndarray, held: np.ndarray
) -> tuple[FloatArray, FloatArray]:
    """Maps of some loads (k,) while forces that belong to other columns (h,) keep their own displacements at zero.
    Raises CondensationError.
    """
    try:
        reaction = np.linalg.solve(compliance[np.ix_(held, held)], compliance[np.ix_(held, loads)])
    except np.linalg.LinAlgError:
        raise CondensationError("nothing holds the section's halves apart but its mid-line") from None
    left = compliance[np.ix_(loads, loads)] - compliance[np.ix_(loads, held)] @ reaction
    return (left + left.T) / 2.0, strain[:, loads] - strain[:, held] @ reaction


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
    dofs = node_dofs(displacement_basis(section.mesh))
    loads = csc_matrix(unit_loads(dofs, tractions.nodes, dofs.size) @ tractions.by_component())
    return Parts(np.arange(section.mesh.t.shape[1]), dofs, [dofs[:, section.fixed].ravel()], [loads])


def right_half(section: SectionMesh, tractions: Tractions) -> Parts:
    """The right half of a section; of contact nodes in the middle the right half takes the one on the mid-line."""
    x = section.mesh.doflocs[0]
    elements = np.flatnonzero(x[section.mesh.t].mean(axis=0) > 0.0)
    dofs = node_dofs(displacement_basis(section.mesh, elements))
    still, axis = np.union1d(dofs[:, section.fixed], dofs[:, x < 0.0]), dofs[:, x == 0.0]
    held = [np.union1d(still, axis[sideways]) for sideways in (0, 1)]
    first = 2 * (tractions.position.shape[0] // 2)
    loads = [each[:, first:] for each in _folded_loads(section, tractions, dofs)]
    return Parts(elements, dofs, held, loads)


@dataclass(frozen=True)
class Unfolding:
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


def unfolding(count: int, mirror: FloatArray) -> Unfolding:
    """Unfolding of `count` points on a line that mirrors end to end; a point in the middle lies on the right."""
    line = np.arange(count)
    left = count // 2
    on_right = line >= left
    return Unfolding(np.where(on_right, line, line[::-1]) - left, np.where(on_right, 1, -1), mirror)


def _folded_loads(section: SectionMesh, tractions: Tractions, dofs: np.ndarray) -> tuple[csc_matrix, csc_matrix]:
    """Nodal forces (n_unknowns, 2m) on the right half from unit resultants that act together with their mirror image,
    and against it.
    """
    index = np.flatnonzero(np.isin(section.skin, tractions.nodes))
    x = section.mesh.doflocs[0, tractions.nodes]
    right, mirror = dofs[:, section.skin[index]].T, dofs[:, section.skin[::-1][index]].T
    forces = tractions.by_component()
    sides = []
    for unknowns, there, sign in ((right, x >= 0.0, 1.0), (mirror, x < 0.0, np.array([-1.0, 1.0]))):
        own = np.flatnonzero(np.repeat(there, 2))
        signs = (sign * np.ones_like(unknowns)).ravel()[own]
        placing = csc_matrix((signs, (unknowns.ravel()[own], own)), shape=(dofs.size, unknowns.size))
        sides.append(placing @ forces)
    return csc_matrix(sides[0] + sides[1]), csc_matrix(sides[0] - sides[1])


def unfold(symmetric: FloatArray, antisymmetric: FloatArray, rows: Unfolding, columns: Unfolding) -> FloatArray:
    """Map of the whole section from those of its half under mirrored and counter-mirrored loads."""
    block = np.ix_(rows.unknowns(), columns.unknowns())
    together = np.outer(np.repeat(rows.side, rows.mirror.size), np.repeat(columns.side, columns.mirror.size))
    signs = np.outer(rows.signs(), columns.signs())
    return np.asarray(signs * (symmetric[block] + together * antisymmetric[block]) / 2.0)


def body_of(scene: Scene) -> CondensedBody | None:
    """The condensed body of the scene's actuators, or None if they are rigid."""
    return condense_body(scene) if scene.device.actuators.body else None


def condense_body(scene: Scene) -> CondensedBody:
    """Condense the deformable body of the scene's actuators (all equal) to its face; what its base stands on gives way
    to all of the face alike.
    """
    row = scene.device.actuators
    if row.body is None:
        raise MeshError("a rigid actuator has no body to condense")
    mesh = mesh_strip(row, scene.model.numerics.coarsened(1.0 / BODY_FINER))
    basis = displacement_basis(mesh)
    matrix = stiffness(basis, [row.body.material], np.zeros(mesh.t.shape[1], dtype=int))
    y = mesh.doflocs[1]
    face = np.flatnonzero(y == y.max())
    face = face[np.argsort(mesh.doflocs[0, face])]
    dofs = node_dofs(basis)
    loads = unit_loads(dofs, face, matrix.shape[0])
    none = csr_matrix((0, matrix.shape[0]))
    compliance, _, _ = condense(matrix, dofs, dofs[:, y == y.min()].ravel(), loads, none)
    return CondensedBody(mesh.doflocs[0, face], compliance + np.tile(row.body.mount(), (face.size, face.size)))


def unit_loads(dofs: np.ndarray, nodes: np.ndarray, size: int) -> csc_matrix:
    """Unit forces on both unknowns of some nodes (n,): a matrix (size, 2n) for `condense`."""
    return unit_forces(dofs[:, nodes].T.ravel(), size)


def unit_forces(unknowns: np.ndarray, size: int) -> csc_matrix:
    """Unit forces on some unknowns (k,) of `size`: a matrix (size, k) for `condense`."""
    return csc_matrix((np.ones(unknowns.size), (unknowns, np.arange(unknowns.size))), shape=(size, unknowns.size))


def condense(
    matrix: csc_matrix, dofs: np.ndarray, fixed: np.ndarray, loads: csc_matrix, strain: csr_matrix
) -> tuple[FloatArray, FloatArray, float]:
    """Compliance (k, k), strain map (n_rows of strain, k) and relative residual of k loads.

    matrix: stiffness; dofs: (2, n_nodes) unknowns of the nodes; fixed: unknowns that do not move (loads on them are
    borne without an answer); loads: nodal forces (n_unknowns, k) of unit forces; strain: rows that are read, as a
    linear map of all unknowns.

    Raises CondensationError if the stiffness is singular or the residual is beyond RESIDUAL_TOLERANCE.
    """
    free = np.ones(matrix.shape[0], dtype=bool)
    free[fixed] = False
    order = fill_reducing_order(matrix, dofs, free)
    permuted, right, read = csc_matrix(matrix[order][:, order]), csc_matrix(loads[order]), strain[:, order]
    return condense_ordered(permuted, factorise(permuted), right, read)


def condense_ordered(
    permuted: csc_matrix, factors: SuperLU, right: csc_matrix, read: csr_matrix
) -> tuple[FloatArray, FloatArray, float]:
    """`condense` of a stiffness already in a fill-reducing order, with its factors. Raises CondensationError."""
    count = right.shape[1]
    compliance, strain_map = np.zeros((count, count)), np.zeros((read.shape[0], count))
    mix = np.random.default_rng(0).standard_normal(count)
    mixed = np.zeros(permuted.shape[0])
    with threadpool_limits(1):  # the factors' blocks are small: more threads take longer, and round otherwise
        for start in range(0, count, AT_ONCE):
            block = slice(start, start + AT_ONCE)
            field = factors.solve(right[:, block].toarray(order="F"))
            compliance[:, block] = right.T @ field
            strain_map[:, block] = read @ field
            mixed += field @ mix[block]
    residual = _residual(permuted, mixed, right @ mix)
    if not residual <= RESIDUAL_TOLERANCE:
        raise CondensationError(f"condensation: equilibrium residual {residual:.1e} > {RESIDUAL_TOLERANCE:.0e}")
    return (compliance + compliance.T) / 2.0, strain_map, residual  # Betti, but for rounding


def trailing_compliance(permuted: csc_matrix, factors: SuperLU, loads: csc_matrix) -> tuple[FloatArray, float]:
    """Compliance (k, k) of loads (n_free, k) on the last unknowns of a stiffness, and relative residual.

    The trailing block of the factors K = L D L^T is that of the stiffness condensed to the last unknowns, so that
    C = Y^T D^-1 Y with L Y = W on that block: nothing is solved on the whole. Raises CondensationError.
    """
    size = permuted.shape[0] - int(loads.indices.min())
    place = factors.perm_c[-size:] - (permuted.shape[0] - size)
    if place.min() < 0:
        raise CondensationError("some of the tissue hangs together with nothing that actuators can touch")
    upper = np.asarray(factors.U[-size:, -size:].toarray())
    pivots = np.diag(upper)[:, None]
    last = np.empty((size, loads.shape[1]))
    last[place] = loads[-size:].toarray()
    carried = solve_triangular((upper / pivots).T, last, lower=True, unit_diagonal=True)
    compliance = carried.T @ (carried / pivots)

    mix = np.random.default_rng(0).standard_normal(loads.shape[1])
    load = loads @ mix
    field = factors.solve(load)
    residual = _residual(permuted, field, load)
    residual = max(residual, float(np.abs(loads.T @ field - compliance @ mix).max() / np.abs(field).max()))
    if not residual <= TRAILING_TOLERANCE:
        raise CondensationError(f"condensation: equilibrium residual {residual:.1e} > {TRAILING_TOLERANCE:.0e}")
    return (compliance + compliance.T) / 2.0, residual


def receptor_strain(section: SectionMesh, scene: Scene) -> tuple[FloatArray, csr_matrix]:
    """Receptor points (m, 2) [mm] and their strain (3m, n_unknowns), read from the side that the scene asks for."""
    points, gradient = receptor_gradient(section, scene)
    return points, strain_of_gradient(gradient)


def receptor_gradient(section: SectionMesh, scene: Scene) -> tuple[FloatArray, csr_matrix]:
    """Receptor points (m, 2) [mm] and their displacement gradient (4m, n_unknowns), read from the side that the scene
    asks for.
    """
    above = [layer.name for layer in scene.model.finger.pad].index(scene.model.readout.layer_above)
    wanted = above + 1 if scene.model.readout.side is Side.DERMIS else above
    adjacent = section.mesh.f2t[:, section.receptor_facets]
    element = np.where(section.layer[adjacent[0]] == wanted, adjacent[0], adjacent[1])
    points, gradient = facet_gradient(section.mesh, section.receptor_facets, element)
    # around the section's centre the angle ascends along the line, also where the line turns back in x
    order = np.argsort(np.arctan2(points[0], scene.model.finger.height / 2.0 - points[1]))
    rows = (GRADIENT * order[:, None] + np.arange(GRADIENT)).ravel()
    return points[:, order].T, gradient[rows]


def arc_length(points: FloatArray) -> FloatArray:
    """Arc length (m,) [mm] along a polyline (m, 2), zero where x crosses the mid-line."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    middle = int(np.argmin(np.abs(points[:, 0])))
    around = slice(max(middle - 1, 0), middle + 2)
    return arc - float(np.interp(0.0, points[around, 0], arc[around]))


def fill_reducing_order(
    matrix: csc_matrix, dofs: np.ndarray, free: np.ndarray, last: np.ndarray | None = None
) -> np.ndarray:
    """Fill-reducing order of the free unknowns, found on the graph of nodes (an eighth of the work).

    last: unknowns that come last in it. The factors join them to one another, and so does the graph beforehand.
    """
    nodes = np.flatnonzero(free[dofs].any(axis=0))
    first = dofs[0, nodes]
    graph = csc_matrix(matrix[first][:, first])
    if last is not None:
        joined = np.isin(dofs[:, nodes], last).any(axis=0).astype(float)[:, None]
        graph = csc_matrix(abs(graph) + csc_matrix(joined) @ csc_matrix(joined).T)
    graph.data[:] = -1.0
    graph = csc_matrix(graph + diags_array(np.full(nodes.size, 2.0 * np.diff(graph.indptr).max())))
    permutation = _factorise(graph, "MMD_AT_PLUS_A").perm_c
    order = np.empty_like(permutation)
    order[permutation] = np.arange(permutation.size)
    ordered = dofs[:, nodes[order]].T.ravel()
    ordered = ordered[free[ordered]]
    after = np.isin(ordered, [] if last is None else last)
    return np.concatenate([ordered[~after], ordered[after]])


def factorise(permuted: csc_matrix) -> SuperLU:
    """LU factors of a symmetric stiffness already in a fill-reducing order.

    Raises CondensationError if it is singular.
    """
    factors = _factorise(permuted, "NATURAL")
    pivots = np.abs(factors.U.diagonal())
    if pivots.min() < PIVOT_LIMIT * pivots.max():
        raise CondensationError("the stiffness is singular: nothing holds some of the tissue")
    return factors


def _factorise(matrix: csc_matrix, ordering: str) -> SuperLU:
    """LU factors without pivoting, which a symmetric matrix far from singular does not need."""
    return splu(matrix, permc_spec=ordering, diag_pivot_thresh=0.0, options={"SymmetricMode": True})


def _residual(matrix: csc_matrix, field: FloatArray, load: FloatArray) -> float:
    """Backward error [1] of K u = f: max |K u - f| / (max row sum of |K| times max |u|). Rounding leaves some 1e-16."""
    scale = float(np.abs(matrix).sum(axis=1).max()) * float(np.abs(field).max())
    return float(np.abs(matrix @ field - load).max()) / scale
