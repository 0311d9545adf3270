"""The section's mesh: conforming, curved, mirrored, deterministic, graded as asked."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipe
from skfem import MeshTri, MeshTri2

from fingerpad.errors import ContactError, ConvergenceError, CriterionError, MeshError, SceneError
from fingerpad.prediction import edges
from fingerpad.prediction.edges import REACH, edge_intervals, mesh_device
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow, Condition
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue import strip
from fingerpad.tissue.actuator_body import condense_body
from fingerpad.tissue.elasticity import displacement_basis, node_dofs
from fingerpad.tissue.mesh import (
    load_section,
    merged,
    mesh_section,
    nominal_edges,
    nominal_mesh,
    require_valid,
    save_section,
)
from fingerpad.tissue.reach import contact_tractions
from fingerpad.tissue.receptors import receptor_strain
from fingerpad.tissue.strip import mesh_strip
from scenes import scene, section, solved

DEVICES = ("device1", "device2", "device3")
MEASURED = 0.003  # mm to which edges on coarse meshes agree (edges.COARSER)


@pytest.mark.parametrize("device", DEVICES)
def test_mesh_is_its_own_mirror_image_to_the_last_bit(device: str) -> None:
    """Every node (x, y) has a twin (-x, y)."""
    nodes = section(device).mesh.doflocs.T
    order = np.lexsort(nodes.T)
    mirrored = nodes * np.array([-1.0, 1.0])
    assert np.array_equal(nodes[order], mirrored[np.lexsort(mirrored.T)])


def test_areas_of_outline_bone_and_layers() -> None:
    """Curved elements fill the ellipse less the bone; each skin layer has the area between its parallel curves."""
    mesh, finger = section("device2"), scene("device2").model.finger
    basis = displacement_basis(mesh.mesh)
    area = basis.dx.sum(axis=1)
    whole = np.pi / 4.0 * (finger.width * finger.height - finger.bone_width * finger.bone_height)
    assert area.sum() == pytest.approx(whole, rel=2e-8)  # parabolas for arcs: 5e-9 (measured)
    # between parallel curves at depths d1, d2 lies L (d2 - d1) - (turning angle) (d2^2 - d1^2) / 2 of area
    a, b = finger.width / 2.0, finger.height / 2.0
    skin = mesh.mesh.doflocs[:, mesh.skin]
    t = np.linspace(0.0, np.arctan2(skin[0, -1] / a, (b - skin[1, -1]) / b), 200001)
    length = 2.0 * np.trapezoid(np.hypot(a * np.cos(t), b * np.sin(t)), t)
    turning = 2.0 * np.arctan2(b * np.sin(t[-1]), a * np.cos(t[-1]))
    outer = 0.0
    for index, layer in enumerate(finger.pad[:-1]):
        inner = outer + layer.thickness
        exact = length * layer.thickness - turning * (inner**2 - outer**2) / 2.0
        assert area[mesh.layer == index].sum() == pytest.approx(exact, rel=2e-8), layer.name
        outer = inner


def test_receptor_line_lies_between_epidermis_and_dermis() -> None:
    """Every receptor facet separates the two layers, and the line is unbroken."""
    mesh = section("device2")
    adjacent = mesh.layer[mesh.mesh.f2t[:, mesh.receptor_facets]]
    names = np.array([layer.name for layer in scene("device2").model.finger.layers])[np.sort(adjacent, axis=0)]
    assert set(map(tuple, names.T)) == {("viable_epidermis", "dermis")}
    ends = mesh.mesh.facets[:, mesh.receptor_facets]
    assert np.all([np.intersect1d(ends[:, i], ends[:, i + 1]).size == 1 for i in range(ends.shape[1] - 1)])


def test_skin_ends_where_the_nail_begins() -> None:
    """Along the outline the pad's skin leaves the nail's width out; chords of its coarse part are 0.02 mm short."""
    finger, mesh = scene("device2").model.finger, section("device2")
    half_width, half_height = finger.width / 2.0, finger.height / 2.0
    outline = 4.0 * half_width * ellipe(1.0 - (half_height / half_width) ** 2)
    length = np.hypot(*np.diff(mesh.mesh.doflocs[:, mesh.skin], axis=1)).sum()
    assert length == pytest.approx(outline - finger.nail_width, abs=0.05)


def test_sizes_are_as_asked() -> None:
    """On the skin, elements within the edge zone are at most edge_size long, none under the row above face_size, and
    none of the receptor line above receptor_size; but for what sizes grow by within an element."""
    base = scene("device2")
    numerics, row, mesh = base.model.numerics, base.device.actuators, section("device2")
    nodes = mesh.mesh.doflocs[:, mesh.skin]
    length = np.hypot(*(nodes[:, 2::2] - nodes[:, :-2:2]))
    middle = nodes[0, 1::2]
    start, stop = edge_intervals(base).T
    on_pad = nodes[1, 1::2] < base.model.finger.height / 2
    at_edge = on_pad & np.any((middle[:, None] > start) & (middle[:, None] < stop), axis=1)
    under = on_pad & (np.abs(middle) < max(row.positions) + row.width / 2)
    assert at_edge.any()
    assert length[at_edge].max() <= numerics.edge_size
    assert length[under].max() <= numerics.face_size * (1.0 + numerics.growth)
    ends = mesh.mesh.p[:, mesh.mesh.facets[:, mesh.receptor_facets]]
    read = np.hypot(*(ends[:, 1] - ends[:, 0]))
    below = np.abs(ends[0].mean(axis=0)) < max(row.positions) + row.width / 2
    assert read[below].max() <= numerics.receptor_size * (1.0 + numerics.growth)


def test_elements_around_the_nails_corners_are_as_small_as_asked() -> None:
    """Where nail, pad and the bed of the nail meet, and where nail and pad do on the skin: at the ends of its sides.
    Other elements of the nail are larger.
    """
    base, mesh = scene("device2"), section("device2")
    names = np.array([layer.name for layer in base.model.finger.layers])[mesh.layer]
    points, triangles = mesh.mesh.p, mesh.mesh.t
    in_nail, in_bed = np.unique(triangles[:, names == "nail"]), np.unique(triangles[:, names == "nail_bed"])
    of_pad = np.unique(triangles[:, ~np.isin(names, ["nail", "nail_bed"])])
    side = np.intersect1d(in_nail, of_pad)
    corners = np.union1d(np.intersect1d(side, in_bed), np.intersect1d(side, mesh.skin))
    assert corners.size == 4
    length = np.hypot(*(points[:, triangles] - np.roll(points[:, triangles], 1, axis=1))).max(axis=0)
    around = np.isin(triangles, corners).any(axis=0)
    largest = base.model.numerics.nail_size * (1.0 + base.model.numerics.growth)
    assert length[around].max() <= largest < length[names == "nail"].max()


def test_the_back_of_the_finger_is_as_coarse_as_its_nail_allows() -> None:
    """Over the row, too: its skin is near the skin, but not the pad's. Elements there would be half of all."""
    base, mesh = scene("device2"), section("device2")
    corners = mesh.mesh.p[:, mesh.mesh.t]
    length = np.hypot(*(corners - np.roll(corners, 1, axis=1))).max(axis=0)
    x, y = corners.mean(axis=1)
    over_row = (y > base.model.finger.height / 2.0) & (np.abs(x) < 1.0)  # some 5 mm from the nail's corners
    assert length[over_row].min() > base.model.numerics.face_size


def test_an_element_that_folds_between_its_corners_is_refused() -> None:
    """At them its map is upright: twice the area, by its determinant, is a tenth and more; in the middle of its base it
    is turned inside out.
    """
    corners = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    straight = MeshTri2.from_mesh(MeshTri(corners, np.array([[0], [1], [2]])))
    require_valid(straight, "triangle")
    bent = {(0.5, 0.0): (0.5, 0.2), (0.0, 0.5): (-0.05, 0.3), (0.5, 0.5): (0.75, 0.3)}
    folded = replace(straight, doflocs=np.array([bent.get((x, y), (x, y)) for x, y in straight.doflocs.T.tolist()]).T)
    (a, b), (c, d) = folded.mapping().DF(corners)
    assert (a * d - b * c).min() > 0.1
    with pytest.raises(MeshError, match="triangle: 1 inverted elements"):
        require_valid(folded, "triangle")


def test_elements_in_a_zone_beside_edges_are_as_small_as_at_them() -> None:
    """However much wider than an element it is."""
    base, zone = scene("device2").coarsened(4.0), 0.2  # mm
    base = base.with_model(numerics=replace(base.model.numerics, edge_zone=zone))
    edges = nominal_edges(base.device.actuators)
    mesh = mesh_section(base, edges)
    nodes = mesh.mesh.doflocs[:, mesh.skin]
    length, (x, y) = np.hypot(*(nodes[:, 2::2] - nodes[:, :-2:2])), nodes[:, 1::2]
    beside = np.any((x[:, None] > edges[:, 0] - zone) & (x[:, None] < edges[:, 1] + zone), axis=1)
    beside &= y < base.model.finger.height / 2.0
    assert length[beside].max() <= base.model.numerics.edge_size


def test_same_scene_same_mesh_and_round_trip(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """Meshing is deterministic, and a stored mesh comes back whole, with its facets in the same order."""
    first, second = section("device1"), mesh_device(scene("device1"))
    assert np.array_equal(first.mesh.doflocs, second.mesh.doflocs)
    save_section(tmp_path / "mesh.npz", first)
    save_section(tmp_path / "again.npz", second)
    assert (tmp_path / "mesh.npz").read_bytes() == (tmp_path / "again.npz").read_bytes()
    stored = load_section(tmp_path / "mesh.npz")
    assert np.array_equal(stored.mesh.facets, first.mesh.facets)
    assert np.array_equal(stored.receptor_facets, first.receptor_facets)
    assert np.array_equal(stored.layer, first.layer)


def test_a_strip_of_many_nodes_is_no_warning(caplog: pytest.LogCaptureFixture) -> None:
    base = scene("device3")
    row = base.device.actuators
    assert row.body is not None
    thick = replace(row, body=replace(row.body, thickness=1.0))
    assert mesh_strip(thick, base.model.numerics).p.shape[1] > 1000
    assert not caplog.records


@pytest.mark.parametrize("thickness", [1.0, 2.0, 6.0])
def test_thick_bodies_have_higher_elements_far_from_the_face(thickness: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pressed and sheared as a whole, a body answers as with elements of one height, which are many more."""
    base = scene("device3")
    row = base.device.actuators
    assert row.body is not None
    given = base.with_device(actuators=replace(row, body=replace(row.body, thickness=thickness)))
    sizes, answers = [], []
    for near in (strip.NEAR, np.inf):
        monkeypatch.setattr(strip, "NEAR", near)
        body = condense_body(given)
        sizes.append(mesh_strip(given.device.actuators, base.model.numerics).t.shape[1])
        along = np.tile(np.eye(2), (body.coordinate.size, 1))  # the face moves as a whole
        answers.append(along.T @ np.linalg.solve(body.compliance, along))
    assert sizes[0] < 0.6 * sizes[1]
    # the source of HIGHEST: 0.4 %
    assert np.abs(answers[0] - answers[1]).max() < 4.5e-3 * np.abs(answers[1]).max()


def test_a_body_of_too_many_elements_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(strip, "MAX_ELEMENTS", 100)
    base = scene("device3")
    with pytest.raises(MeshError, match=r"actuator's body needs more than 100 elements; try a thinner body"):
        mesh_strip(base.device.actuators, base.model.numerics)


def test_strip_mirrors_and_is_fine_at_its_ends() -> None:
    """A deformable actuator's mesh mirrors, and its face elements are at most edge_size at the ends."""
    base = scene("device3")
    mesh = mesh_strip(base.device.actuators, base.model.numerics)
    x = np.sort(mesh.doflocs[0, mesh.doflocs[1] == 0.0])
    assert np.abs(x + x[::-1]).max() < 1e-15
    assert x[2] - x[0] <= base.model.numerics.edge_size * (1.0 + 1e-12)
    with pytest.raises(MeshError, match="rigid"):
        mesh_strip(scene("device1").device.actuators, base.model.numerics)


def test_a_nail_around_the_finger_is_refused() -> None:
    """The nail must leave a pad; the message says how much it may take."""
    finger = scene("device2").model.finger
    with pytest.raises(SceneError, match=r"nail_width 30 mm must be less than half the outline, 22\.8 mm"):
        replace(finger, nail_width=30.0)


def test_other_layers_and_outlines_mesh_too() -> None:
    """Nail and epidermis need not be equally thick; round and flat fingers mesh."""
    base = scene("device2")
    finger = base.model.finger
    nail = replace(finger.dorsal[0], thickness=0.4)
    thick = replace(finger.dorsal[1], thickness=3.1)
    for changed in (
        replace(finger, dorsal=(nail, thick)),
        replace(finger, width=14.0, height=14.0),
        replace(finger, width=20.0, height=14.0),
    ):
        other = base.with_model(finger=changed)
        mesh = nominal_mesh(other)
        assert set(np.unique(mesh.layer)) == set(range(6))


def test_thicknesses_may_have_any_number_of_digits() -> None:
    """Layers of 1/3 mm, and of 10 um, mesh and are read: no slivers between lines that should be one."""
    base = scene("device2")
    finger = base.model.finger
    pad = tuple(
        replace(layer, thickness=thickness)
        for layer, thickness in zip(finger.pad, (1.0 / 3.0, 0.01, 4.0 / 3.0, 3.0), strict=True)
    )
    changed = base.with_model(finger=replace(finger, pad=pad))
    mesh = nominal_mesh(changed)
    x, y = mesh.mesh.p[:, mesh.mesh.t]
    twice_areas = np.abs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]))
    assert twice_areas.min() > 1e-8  # mm²; a sliver of rounding would have 1e-11
    points, strain = receptor_strain(mesh, changed)
    linear = 1e-3 * mesh.mesh.doflocs[1]
    dofs = node_dofs(displacement_basis(mesh.mesh))
    field = np.zeros(strain.shape[1])
    field[dofs[1]] = linear
    read = (strain @ field).reshape(-1, 3)
    assert np.abs(read - [0.0, 1e-3, 0.0]).max() < 1e-12
    assert points.shape[0] == read.shape[0]


def test_layers_that_reach_below_the_other_side_are_refused() -> None:
    """The parallel layers of the pad must fit above the bone on the dorsal side too."""
    finger = scene("device2").model.finger
    thin = tuple(replace(layer, thickness=0.5) for layer in finger.dorsal)
    with pytest.raises(SceneError, match=r"the dorsal layers are 1 mm thick together and must reach below 2 mm"):
        replace(finger, dorsal=thin)


def test_sharp_edges_are_sharper_than_any_element_can_tell() -> None:
    """What stands for them is a small part of the smallest elements, which lie at edges."""
    base = scene("device2")
    sharp = replace(base.device.actuators, edge_radius=0.0)
    assert 0.0 < sharp.corner_radius < 0.1 * base.model.numerics.edge_size


def test_touching_actuators_are_no_overlap() -> None:
    """Widths may fill the pitch, though places are rounded."""
    pitch = 0.1
    ActuatorRow(tuple((i - 31.5) * pitch for i in range(64)), pitch, 0.0)
    with pytest.raises(SceneError, match="overlap"):
        ActuatorRow((0.0, 0.0999), pitch, 0.0)


def test_a_mesh_too_large_is_a_named_error() -> None:
    """Sizes below a micrometre under every face: refused before memory runs out."""
    base = scene("device2")
    numerics = replace(base.model.numerics, edge_size=0.0003, face_size=0.0003)
    fine = base.with_model(numerics=numerics)
    with pytest.raises(MeshError, match="more than 500000 elements"):
        nominal_mesh(fine)


def test_an_interface_that_is_out_of_reach_has_no_say_where_edges_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """The other's are as they are, and without another nobody looks widely. Where a path is lost, all may be."""
    base = scene("device2")
    nominal = nominal_edges(base.device.actuators)
    wide = nominal + REACH * np.array([-1.0, 1.0])
    both, press = edge_intervals(base), edges._pressed_state

    def refusing(error: type[ContactError], *refused: Interface) -> np.ndarray:
        def pressed(*given: Any) -> Any:
            if given[-1] in refused:
                raise error("refused")
            return press(*given)

        monkeypatch.setattr(edges, "_pressed_state", pressed)
        return edge_intervals(base)

    for interface in Interface:
        (start, stop), (first, last) = refusing(CriterionError, interface).T, both.T
        assert (start >= first - MEASURED).all()
        assert (stop <= last + MEASURED).all()
        assert (stop - start).sum() < (last - first).sum()
    assert np.array_equal(refusing(CriterionError, *Interface), nominal)
    assert np.array_equal(refusing(ConvergenceError, Interface.SHEAR), wide)


@pytest.mark.parametrize("name", ["alternate_000", "alternate_180"])
def test_edges_end_up_in_their_intervals(name: str) -> None:
    """Skin over both ends of every rounded edge, when pins on the fine mesh have slid aside together, or in turn."""
    base, found = scene("device2"), solved("device2", name, Interface.FRICTIONLESS)
    condition = base.device.condition(name)
    row, (start, stop) = base.device.actuators, edge_intervals(base.with_conditions([condition])).T
    centre = row.positions + condition.tangential[found.reading.time]
    ends = np.add.outer(centre, [-row.width / 2.0, -row.half_face, row.half_face, row.width / 2.0])
    undeformed = np.interp(ends, found.place + centre[found.actuator], found.position[:, 0])[..., None]
    inside = (undeformed >= start - MEASURED) & (undeformed <= stop + MEASURED)
    assert inside.any(axis=-1).all()


def edges_of_strokes(base: Scene, *ways: float) -> np.ndarray:
    """Intervals of a device whose actuators go some ways [mm] aside together, one after the other."""
    tangential = np.repeat(np.array(ways)[:, None], 4, axis=1)
    strokes = Condition("strokes", "test", 0.0, np.arange(1.0, len(ways) + 1.0), np.zeros_like(tangential), tangential)
    return edge_intervals(base.with_conditions((strokes,)))


def test_edges_of_a_stimulus_that_comes_back_lie_where_they_did_on_the_way() -> None:
    base = scene("device2").coarsened(2.0)
    (start, stop), (first, last) = edges_of_strokes(base, 0.3, 0.0).T, edges_of_strokes(base, 0.3).T
    assert np.all(start <= first)
    assert np.all(stop >= last)


def test_edges_of_next_to_no_stimulus_are_those_of_pre_indentation() -> None:
    """With finite kinematics, where stimuli go on from tissue that is deformed already."""
    base = scene("device2").coarsened(2.0).with_kinematics(Kinematics.FINITE)
    base = base.with_device(frictionless=False)
    assert np.abs(edges_of_strokes(base, 1e-5) - edges_of_strokes(base, 0.0)).max() < MEASURED


def test_an_interval_within_another_takes_nothing_from_it() -> None:
    both = np.array([[0.1, 0.9], [0.2, 0.3], [1.5, 1.6]])
    assert merged(both).tolist() == [[0.1, 0.9], [1.5, 1.6]]


def test_without_a_coarse_mesh_edges_are_sought_widely() -> None:
    """A mesh four times as coarse as this one has pins that no node is near."""
    given = scene("device2").coarsened(9.0)
    nominal = nominal_edges(given.device.actuators)
    wide = nominal + REACH * np.array([-1.0, 1.0])
    assert np.array_equal(edge_intervals(given), wide)
    assert not np.array_equal(edge_intervals(scene("device2")), wide)


def test_skin_too_coarse_for_any_actuator_is_refused() -> None:
    """Two pins, and elements as wide as both."""
    base = scene("device2").coarsened(32.0)
    moved = base.device.conditions[0]
    moved = replace(moved, normal=moved.normal[:, 1:3], tangential=moved.tangential[:, 1:3])
    pair = replace(base.device.actuators, positions=base.device.actuators.positions[1:3])
    given = base.with_device(actuators=pair, conditions=(moved,))
    with pytest.raises(MeshError, match=r"no element of the skin lies within reach .* numerics\.face_size"):
        contact_tractions(mesh_section(given, nominal_edges(pair)), given)


@pytest.mark.parametrize("change", [{"width": 44.0}, {"width": 8.8, "height": 20.0}])
def test_layers_that_meet_inside_a_bend_are_refused(change: dict[str, float]) -> None:
    """An ellipse bends most at the ends of its longer half axis a: with radius b^2 / a, whichever axis that is."""
    finger = scene("device2").model.finger
    with pytest.raises(
        SceneError, match=r"2 mm thick, more than the outline's smallest radius of curvature [12]\.\d+ mm"
    ):
        replace(finger, nail_width=1.0, bone_width=1.0, **change)
