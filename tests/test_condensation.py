"""Condensation against the full model that it replaces."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from scipy.sparse import csc_matrix, csr_matrix, diags_array, kronsum
from scipy.sparse.linalg import spsolve

from fingerpad.errors import CondensationError
from fingerpad.fields.recovery import recover_displacement
from fingerpad.fields.states import states_fields
from fingerpad.readouts.strain import maximum_principal
from fingerpad.scene.contact_law import Interface
from fingerpad.tissue.condensation import condense, condense_ordered, condense_section, section_stiffness
from fingerpad.tissue.elasticity import mesh_dofs, unit_loads
from fingerpad.tissue.factors import Factors, backward_error, factorise
from fingerpad.tissue.mesh import nominal_mesh
from fingerpad.tissue.reach import contact_tractions
from fingerpad.tissue.receptors import receptor_strain
from scenes import condensed, scene, section, solved


def test_maps_equal_a_direct_solve_of_the_whole_section() -> None:
    """Displacement and receptor strain under a lopsided load: folded halves against one sparse solve,
    apart by rounding, 1e-16, times some 1e6 by which the stiffness magnifies it. Strain is a difference of what moves
    at the ends of elements, a hundredth of the section, and loses two digits more (measured: 1e-11 and 1e-9).
    """
    mesh, base = section("device2"), scene("device2")
    found, _ = condensed("device2")
    matrix, dofs = section_stiffness(mesh, base), mesh_dofs(mesh.mesh)
    tractions = contact_tractions(mesh, base)
    nodes, loads = tractions.nodes, tractions.by_component()
    load = np.random.default_rng(1).standard_normal(loads.shape[1])
    free = np.setdiff1d(np.arange(matrix.shape[0]), dofs[:, mesh.fixed].ravel())
    right = np.zeros(matrix.shape[0])
    right[dofs[:, nodes].T.ravel()] = loads @ load
    field = np.zeros_like(right)
    field[free] = spsolve(matrix[free][:, free].tocsc(), right[free])
    exact = loads.T @ field[dofs[:, nodes].T.ravel()]
    assert np.abs(found.compliance @ load - exact).max() < 1e-9 * np.abs(exact).max()
    points, strain = receptor_strain(mesh, base)
    assert np.array_equal(points, found.receptor)
    exact_strain = strain @ field
    assert np.abs(found.strain @ load - exact_strain).max() < 1e-8 * np.abs(exact_strain).max()


@pytest.mark.parametrize("device", ["device1", "device2", "device3"])
def test_compliance_is_symmetric_and_positive(device: str) -> None:
    """To the last bit, as what inverts it relies on (that reciprocity holds but for rounding, before halves are made
    equal, the direct solve tells); and energy for every load.
    """
    found, body = condensed(device)
    for compliance in [found.compliance] + ([body.compliance] if body else []):
        assert np.array_equal(compliance, compliance.T)
        assert np.linalg.eigvalsh(compliance).min() > 0.0


def test_receptor_line_is_ordered_and_spans_the_pad() -> None:
    """Its arc is as long as its facets are, but for what lies beyond the outermost receptors: it goes through them in
    turn. It is odd about the mid-line but for the rounding of sums of some hundred segments, and reaches past the
    widest point on both sides.
    """
    (found, _), mesh = condensed("device1"), section("device1")
    ends = mesh.mesh.p[:, mesh.mesh.facets[:, mesh.receptor_facets]]
    length = np.hypot(*(ends[:, 1] - ends[:, 0]))
    assert 0.0 < length.sum() - np.ptp(found.arc) < length.max()
    assert np.abs(found.arc + found.arc[::-1]).max() < 1e-12
    assert found.arc[-1] > 10.0


def test_contact_nodes_lie_where_their_forces_are_shared_out_about() -> None:
    """A unit resultant has the moment of the nodal forces that stand for it, to rounding."""
    tractions, mesh = contact_tractions(section("device2"), scene("device2")), section("device2").mesh
    moment = tractions.loads.T @ mesh.doflocs[:, tractions.nodes].T
    assert moment == pytest.approx(tractions.position, abs=1e-12)


def test_global_equilibrium_bone_carries_what_the_pins_press() -> None:
    """The reaction at the bone, from the full field, balances the contact forces in x and y."""
    mesh, base = section("device2"), scene("device2")
    solution = solved("device2", "alternate_090", Interface.SHEAR)
    matrix, dofs = section_stiffness(mesh, base), mesh_dofs(mesh.mesh)
    tractions = contact_tractions(mesh, base)
    free = np.setdiff1d(np.arange(matrix.shape[0]), dofs[:, mesh.fixed].ravel())
    right = np.zeros(matrix.shape[0])
    right[dofs[:, tractions.nodes].T.ravel()] = tractions.by_component() @ solution.force[-1].ravel()
    field = np.zeros_like(right)
    field[free] = spsolve(matrix[free][:, free].tocsc(), right[free])
    reaction = (matrix @ field)[dofs[:, mesh.fixed]].sum(axis=1)
    applied = solution.force[-1].sum(axis=0)
    assert applied[1] > 0.05
    assert np.abs(reaction + applied).max() < 1e-9 * applied[1]


def test_full_field_agrees_with_the_strain_map() -> None:
    """The recovered field near the receptors has the strain that the condensed map gave."""
    mesh, base = section("device2"), scene("device2")
    solution = solved("device2", "alternate_180", Interface.SHEAR)
    displacement = recover_displacement(mesh, base, solution.force)
    fields = states_fields(base, mesh, displacement)
    assert np.array_equal(fields.displacement, displacement[1:, :, mesh.mesh.t.T.ravel()])  # not of pre-indentation
    found, _ = condensed("device2")
    strain = maximum_principal(found.strain @ solution.force[-1].ravel())
    dermis = [layer.name for layer in base.model.finger.layers].index("dermis")
    corner_layer = np.repeat(mesh.layer, 3)
    middle = int(np.argmin(np.abs(found.arc)))
    inside = np.flatnonzero(corner_layer == dermis)
    near = inside[np.argsort(np.hypot(*(fields.corner[:, inside].T - found.receptor[middle]).T))[:6]]
    # corners of the elements at the mid-line point: their spread is the jump between second-order elements
    assert fields.strain[0, near].min() * 0.97 < strain[middle] < fields.strain[0, near].max() * 1.03
    before = maximum_principal(found.strain @ solution.force[0].ravel())
    change = strain[middle] - before[middle]
    assert change == pytest.approx(solution.reading.change_of_strain[middle], rel=1e-12)  # but for rounding
    assert fields.change[0, near].min() * 0.97 < change < fields.change[0, near].max() * 1.03
    between = np.setdiff1d(mesh.interfaces(), mesh.receptor_facets)
    for lines, facets in (
        (fields.interface, between),
        (fields.receptors, mesh.receptor_facets),
        (fields.boundary, mesh.mesh.boundary_facets()),
    ):
        assert np.array_equal(fields.corner[:, lines], mesh.mesh.doflocs[:, mesh.mesh.facets[:, facets].T])


def test_a_singular_stiffness_is_a_named_error() -> None:
    """A body that nothing holds cannot be condensed."""
    mesh, base = section("device1"), scene("device1")
    matrix, dofs = section_stiffness(mesh, base), mesh_dofs(mesh.mesh)
    none = csr_matrix((0, matrix.shape[0]))
    with pytest.raises(CondensationError, match="nothing holds"):
        condense(matrix, dofs, np.array([], dtype=int), unit_loads(dofs, mesh.skin[:5], matrix.shape[0]), none)


def test_factors_that_leave_a_residual_are_a_named_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of another stiffness, by a thousandth."""
    base = scene("device2").coarsened(4.0)

    def off(matrix: csc_matrix, rows: csr_matrix) -> Factors:
        return factorise(csc_matrix(1.001 * matrix), rows)

    monkeypatch.setattr("fingerpad.tissue.condensation.factorise", off)
    with pytest.raises(CondensationError, match="equilibrium residual"):
        condense_section(nominal_mesh(base), base)


def test_a_backward_error_is_what_is_missing_over_what_the_rows_might_bear() -> None:
    """By the largest sum of a row's magnitudes, here 3 N/mm, and the largest displacement."""
    springs, field = csc_matrix([[2.0, -1.0], [-1.0, 1.0]]), np.array([0.25, -0.5])
    missing = np.array([0.03, -0.06])
    assert backward_error(springs, field, springs @ field + missing) == pytest.approx(0.06 / (3.0 * 0.5), rel=1e-12)


SPRINGS = csc_matrix(
    diags_array([np.full(4, -1.0), np.array([2.0, 2.0, 2.0, 2.0, 1.0]), np.full(4, -1.0)], offsets=[-1, 0, 1])
)


def test_what_is_read_from_the_factors_is_held_against_a_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of five springs of 1 N/mm in line the last nodes yield by 4 and 5 mm; what is off by a thousandth is an error."""
    loads = csc_matrix(np.eye(5)[:, 3:])
    strain = csr_matrix([[0.0, 0.0, 0.0, -1.0, 1.0]])
    found = condense_ordered(SPRINGS, loads, strain)
    assert found.compliance == pytest.approx(np.array([[4.0, 4.0], [4.0, 5.0]]), rel=1e-12)
    assert found.strain == pytest.approx(np.array([[0.0, 1.0]]), abs=1e-12)

    read = Factors.read
    monkeypatch.setattr(Factors, "read", lambda self, count: 1.001 * read(self, count))
    with pytest.raises(CondensationError, match="displacements are off"):
        condense_ordered(SPRINGS, loads, strain)


def test_rows_may_read_nothing_or_anything_in_any_order() -> None:
    """Tissue in two pieces, unknowns in no order, stiffness of either sign: K^-1 of numpy, and the number of negative
    eigenvalues, to rounding.
    """
    random = np.random.default_rng(1)
    pieces = []
    for size, sign in ((30, 1.0), (12, -1.0)):
        chain = np.diag(np.full(size, 4.0)) - np.eye(size, k=1) - np.eye(size, k=-1)
        pieces.append(sign * chain)
    stiffness = np.zeros((42, 42))
    stiffness[:30, :30], stiffness[30:, 30:] = pieces
    order = random.permutation(42)
    stiffness = stiffness[np.ix_(order, order)]
    rows = np.where(random.random((9, 42)) < 0.1, random.standard_normal((9, 42)), 0.0)
    rows[[0, 4]] = 0.0
    factors = factorise(csc_matrix(stiffness), csr_matrix(rows))
    inverse = np.linalg.inv(stiffness)
    assert np.abs(factors.read(5) - rows @ inverse @ rows[:5].T).max() < 1e-14
    assert np.abs(factors.solve(rows.T) - inverse @ rows.T).max() < 1e-14
    assert np.count_nonzero(factors.pivots < 0.0) == 12


def test_factors_keep_no_copy_of_their_triangles() -> None:
    """SuperLU copies them out to show pivots and rows, and would keep the copies: numbers of 8 bytes, which numpy's
    memory then lacks. A grid of 60 by 60 springs fills in some twenty times.
    """
    line = diags_array([np.full(59, -1.0), np.full(60, 2.0), np.full(59, -1.0)], offsets=[-1, 0, 1])
    grid = csc_matrix(kronsum(line, line))
    tracemalloc.start()
    try:
        factors = factorise(grid, csr_matrix(np.eye(1, grid.shape[0])))
        of_numpy = tracemalloc.DomainFilter(True, np.lib.tracemalloc_domain)
        kept = sum(trace.size for trace in tracemalloc.take_snapshot().filter_traces([of_numpy]).traces)
    finally:
        tracemalloc.stop()
    assert kept < 8 * factors.lu.nnz / 4


def test_a_pivot_that_is_zero_to_the_last_bit_is_not_one_of_the_rows() -> None:
    """Two nodes that a spring joins and nothing holds, one of them read."""
    with pytest.raises(CondensationError, match="nothing holds"):
        factorise(csc_matrix([[1.0, -1.0], [-1.0, 1.0]]), csr_matrix([[0.0, 1.0]]))


def test_body_compliance_is_its_own_mirror_image() -> None:
    """A puck answers a mirrored load with mirrored displacement: its mesh mirrors, diagonals included."""
    _, body = condensed("device3")
    assert body is not None
    count = body.coordinate.size
    image = (2 * np.arange(count)[::-1][:, None] + np.arange(2)).ravel()
    sign = np.tile([-1.0, 1.0], count)
    mirrored = sign[:, None] * body.compliance[np.ix_(image, image)] * sign
    assert np.abs(mirrored - body.compliance).max() < 1e-12 * np.abs(body.compliance).max()
