"""VTU files: node order, fields of known displacements, and agreement with the condensed solution they come from."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from scipy.spatial import KDTree

from fingerpad.arrays import FloatArray
from fingerpad.contact.linear_solution import solve_condition
from fingerpad.fields.states import States, linear_states, strain_at, stress_at
from fingerpad.fields.vtu import field_meshes, skin_tractions, write_collection, write_path, write_vtu
from fingerpad.readouts.measures import stress
from fingerpad.readouts.strain import maximum_principal
from fingerpad.scene.contact_law import Interface, TurningNormal
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.elasticity import FACET_ENDS, GAUSS_POINTS, lame
from fingerpad.tissue.mesh import NODES
from fingerpad.tissue.reach import contact_tractions
from scenes import condensed, scene, section, solved

DEVICE, CONDITION = "device2", "alternate_180"
# of VTK's quadratic triangle (corners, midpoints 01, 12, 20) at (x, y), from VTK's book of cell types
SHAPES = [
    lambda x, y: (1 - x - y) * (1 - 2 * x - 2 * y),
    lambda x, y: x * (2 * x - 1),
    lambda x, y: y * (2 * y - 1),
    lambda x, y: 4 * x * (1 - x - y),
    lambda x, y: 4 * x * y,
    lambda x, y: 4 * y * (1 - x - y),
]
STEP = 0.5  # of reference coordinates, for gradients by central differences: exact for second order, however large
ROUNDING = 1e-10  # of strains and mm; source: 1e-16 of sums of 1e4 terms, over elements of 0.01 mm
ENGINEERING = np.array([1.0, 1.0, 2.0])  # gxy = 2 exy
# a cubic on the reference triangle: weights and points of Hammer's rule of the third degree, whose sum is 1/2
RULE = [(-27 / 96, 1 / 3, 1 / 3), *((25 / 96, *at) for at in ((0.2, 0.2), (0.6, 0.2), (0.2, 0.6)))]


def interpolated(nodal: FloatArray, x: float, y: float) -> FloatArray:
    """Values (n_elements, ...) at a reference point, from those at VTK's nodes (n_elements, 6, ...)."""
    return np.asarray(sum(shape(x, y) * nodal[:, i] for i, shape in enumerate(SHAPES)))


def gradient(nodal: FloatArray, x: float, y: float) -> FloatArray:
    """Derivatives (2, n_elements, ...) along both reference coordinates."""
    steps = ((STEP, 0.0), (0.0, STEP))
    return np.array(
        [(interpolated(nodal, x + a, y + b) - interpolated(nodal, x - a, y - b)) / (2 * STEP) for a, b in steps]
    )


@cache
def meshes() -> list[meshio.Mesh]:
    """Pre-indented and actuated state of one condition."""
    solution = solved(DEVICE, CONDITION, Interface.SHEAR)
    states = linear_states(scene(DEVICE), section(DEVICE), solution)
    return list(field_meshes(section(DEVICE), scene(DEVICE), states))


@pytest.fixture(scope="module")
def read(tmp_path_factory: pytest.TempPathFactory) -> meshio.Mesh:
    """The actuated state, written and read back."""
    path = tmp_path_factory.mktemp("vtu") / "fields.vtu"
    write_vtu(path, meshes()[-1])
    return meshio.read(path)


def by_element(read: meshio.Mesh, values: FloatArray) -> FloatArray:
    """Point values (n_points, ...) by element and node (n_elements, 6, ...)."""
    return np.asarray(values[read.cells_dict["triangle6"]])


def test_what_is_read_is_what_was_written(read: meshio.Mesh) -> None:
    written = meshes()[-1]
    assert np.array_equal(read.points, written.points)
    assert np.array_equal(read.cells_dict["triangle6"], written.cells_dict["triangle6"])
    assert read.point_data.keys() == written.point_data.keys()
    for name, values in written.point_data.items():
        assert np.array_equal(read.point_data[name], values), name
    assert np.array_equal(read.cell_data["layer"][0], section(DEVICE).layer)


def test_midpoints_lie_between_their_corners(read: meshio.Mesh) -> None:
    """VTK's order 01, 12, 20: curved or not, a midpoint is off the middle of its side by less than an eighth of it."""
    points = by_element(read, read.points)
    for middle, (start, stop) in zip((3, 4, 5), ((0, 1), (1, 2), (2, 0)), strict=True):
        off = np.linalg.norm(points[:, middle] - (points[:, start] + points[:, stop]) / 2.0, axis=1)
        assert np.all(off < np.linalg.norm(points[:, stop] - points[:, start], axis=1) / 8.0)


def test_elements_turn_one_way_and_cover_the_section(read: meshio.Mesh) -> None:
    """Jacobians of VTK's shapes are positive and integrate to outline less bone, pi (a b - c d), in mm2.

    Sides that are parabolas miss an ellipse by the fourth order of their length: 5e-9 of the area here (measured).
    """
    points = by_element(read, read.points[:, :2])
    area = 0.0
    for weight, x, y in RULE:
        (ax, ay), (bx, by) = (each.T for each in gradient(points, x, y))
        assert np.all(ax * by - ay * bx > 0.0)
        area += weight * float(np.sum(ax * by - ay * bx))
    finger = scene(DEVICE).model.finger
    outline, bone = finger.width * finger.height, finger.bone_width * finger.bone_height
    assert area == pytest.approx(np.pi / 4.0 * (outline - bone), rel=1e-8)


def strain_of(read: meshio.Mesh, x: float, y: float) -> FloatArray:
    """exx, eyy, gxy (n_elements, 3) at a reference point: gradients of the displacement read, by VTK's shapes."""
    points = by_element(read, read.points[:, :2])
    moved = by_element(read, read.point_data["displacement_mm"][:, :2])
    jacobian, rise = (gradient(values, x, y).transpose(1, 2, 0) for values in (points, moved))
    slope = rise @ np.linalg.inv(jacobian)
    return np.stack([slope[:, 0, 0], slope[:, 1, 1], slope[:, 0, 1] + slope[:, 1, 0]], axis=1)


@pytest.mark.parametrize("node", range(6))
def test_strain_is_the_gradient_of_the_displacement(read: meshio.Mesh, node: int) -> None:
    """At every node of every element, by VTK's shapes."""
    strain = by_element(read, read.point_data["strain"])[:, node]
    expected = strain_of(read, *NODES[:, node])
    assert np.abs(strain[:, [0, 1, 3]] * ENGINEERING - expected).max() < ROUNDING
    assert not strain[:, [2, 4, 5]].any()
    principal = by_element(read, read.point_data["maximum_principal_strain"])[:, node]
    assert np.abs(principal - maximum_principal(expected.ravel())).max() < ROUNDING


def test_linear_displacement_has_constant_strain() -> None:
    mesh = section(DEVICE).mesh
    x, y = mesh.doflocs
    linear = np.array([0.01 * x + 0.02 * y, 0.03 * x - 0.04 * y])
    assert np.abs(strain_at(scene(DEVICE), mesh, linear, NODES) - [0.01, -0.04, 0.05]).max() < 1e-12


def test_finite_fields_begin_as_the_small_ones() -> None:
    """Of displacements a millionth of a solution's, the logarithmic strain and Cauchy's stress are linear: off by the
    square of the strain."""
    small, finite = scene(DEVICE), scene(DEVICE).with_kinematics(Kinematics.FINITE)
    tiny = 1e-6 * linear_states(small, section(DEVICE), solved(DEVICE, CONDITION, Interface.SHEAR)).displacement[-1]
    for linear, found in (
        (strain_at(each, section(DEVICE).mesh, tiny, NODES) for each in (small, finite)),
        (stress_at(each, section(DEVICE), tiny, NODES) for each in (small, finite)),
    ):
        assert np.abs(found - linear).max() < 1e-5 * np.abs(linear).max()


def test_turned_tissue_has_no_finite_strain() -> None:
    """A rotation of the whole section by a quarter of a turn: no strain, no stress; displacement as it is."""
    finite = scene(DEVICE).with_kinematics(Kinematics.FINITE)
    x, y = section(DEVICE).mesh.doflocs
    nothing = np.zeros((1, skin_nodes(), 2))
    (turned,) = field_meshes(section(DEVICE), finite, States(np.array([[-y - x, x - y]]), nothing))
    assert np.abs(turned.point_data["logarithmic_strain"]).max() < ROUNDING
    stiffest = max(sum(lame(layer.material)) for layer in finite.model.finger.layers)  # lambda + mu [MPa]
    assert np.abs(turned.point_data["cauchy_stress_MPa"]).max() < ROUNDING * stiffest
    x, y, _ = turned.points.T
    assert turned.point_data["displacement_mm"][:, 1] == pytest.approx(x - y)


def skin_nodes() -> int:
    """How many nodes of the skin may come into contact."""
    return int(contact_tractions(section(DEVICE), scene(DEVICE)).weight.size)


def test_stress_is_that_of_the_elements_layer(read: meshio.Mesh) -> None:
    """Its deviator is 2 mu that of the strain, with the layer's own material, at every node; its mean is linear."""
    finger = scene(DEVICE).model.finger
    for number, layer in enumerate(finger.layers):
        own = section(DEVICE).layer == number
        strain = by_element(read, read.point_data["strain"])[own].reshape(-1, 6)
        stresses = by_element(read, read.point_data["stress_MPa"])[own].reshape(-1, 6)
        exx, eyy, _, exy, _, _ = strain.T
        expected = stress(np.stack([exx, eyy, 2.0 * exy], axis=1).ravel(), layer.material)
        tolerance = 1e-12 * np.abs(stresses).max()  # some thousand roundings
        mean = stresses[:, :3].mean(axis=1)
        assert np.abs(stresses[:, 3] - expected[:, 3]).max() < tolerance
        for component in range(3):
            deviator = expected[:, component] - expected[:, :3].mean(axis=1)
            assert np.abs(stresses[:, component] - mean - deviator).max() < tolerance
        place = by_element(read, read.points[:, :2])[own]
        linear = np.concatenate([np.ones((*place.shape[:2], 1)), place - place.mean(axis=1, keepdims=True)], axis=2)
        nodal = mean.reshape(-1, 6, 1)
        assert np.abs(linear @ (np.linalg.pinv(linear) @ nodal) - nodal).max() < tolerance


def test_pressure_and_shear_are_those_of_the_solution(read: meshio.Mesh) -> None:
    """Their ends, which lie at vertices, but for rounding."""
    solution = solved(DEVICE, CONDITION, Interface.SHEAR)
    for name, traction in (("contact_pressure_MPa", solution.pressure), ("contact_shear_MPa", solution.shear)):
        drawn = read.point_data[name]
        assert (drawn.min(), drawn.max()) == pytest.approx((traction.min(), traction.max()), rel=1e-9)


@pytest.mark.parametrize("state", [0, 1])
def test_tractions_integrate_to_the_contact_forces(state: int) -> None:
    """Integrals of pressure and shear along the skin, linear between vertices, are the forces of the solution,
    but for the rounding of sums of some hundred terms.
    """
    solution = solved(DEVICE, CONDITION, Interface.SHEAR)
    forces = solution.force
    mesh, skin = section(DEVICE).mesh, section(DEVICE).skin
    on_skin = skin_tractions(section(DEVICE), scene(DEVICE), forces)[state][:, skin]
    assert on_skin.max() > 0.0
    vertices = mesh.doflocs[:, skin[::2]]
    length = np.hypot(*np.diff(vertices, axis=1))
    ends = on_skin[:, ::2]
    found = np.sum((ends[:, 1:] + ends[:, :-1]) / 2.0 * length, axis=1)
    assert found == pytest.approx(forces[state].sum(axis=0), rel=1e-13, abs=1e-13 * forces[state].sum())
    assert on_skin[:, 1::2] == pytest.approx((ends[:, 1:] + ends[:, :-1]) / 2.0)


def test_tractions_are_those_across_and_along_a_normal_that_turns() -> None:
    """With small strain, too, if it is asked to: in every state they hold Coulomb's cone, as components of forces along
    x and y do not at rounded edges, and at the end they are the solution's.
    """
    model = scene(DEVICE).model
    turning = replace(model, contact=replace(model.contact, turning_normal=TurningNormal.ALWAYS))
    base = replace(scene(DEVICE), model=turning)
    tissue, body = condensed(DEVICE)
    found = solve_condition(base, tissue, body, base.device.condition(CONDITION), Interface.SHEAR)

    def beyond(forces: FloatArray) -> float:
        """The cone, over the largest force [1]."""
        shearing, pressing = np.moveaxis(forces, -1, 0)
        return float((np.abs(shearing) - model.contact.friction * pressing).max() / pressing.max())

    contact = linear_states(base, section(DEVICE), found).contact
    assert beyond(contact) < model.numerics.newton_tolerance
    assert beyond(found.force) > 1e-3
    assert np.array_equal(contact[-1] / tissue.weight[:, None], np.stack([found.shear, found.pressure], axis=1))


def test_skin_moves_as_the_condensed_skin_does() -> None:
    """Means of the written displacement under the hats of traction are the compliance's, C f."""
    solution, (tissue, _) = solved(DEVICE, CONDITION, Interface.SHEAR), condensed(DEVICE)
    mesh = meshes()[-1]
    distance, point = KDTree(mesh.points[:, :2]).query(section(DEVICE).mesh.doflocs.T)
    assert distance.max() == 0.0
    tractions = contact_tractions(section(DEVICE), scene(DEVICE))
    found = tractions.loads.T @ mesh.point_data["displacement_mm"][point[tractions.nodes], :2]
    expected = tissue.compliance @ solution.force[-1].ravel()
    assert np.abs(found.ravel() - expected).max() < ROUNDING


def test_receptor_strain_is_the_strain_map(read: meshio.Mesh) -> None:
    """Strain at the Gauss points of the receptor line, from the dermis, is what the condensed strain map gives."""
    base, (tissue, _) = scene(DEVICE), condensed(DEVICE)
    own = section(DEVICE).layer == [layer.name for layer in base.model.finger.pad].index("dermis")
    points = by_element(read, read.points[:, :2])
    places, strains = [], []
    for start, stop in FACET_ENDS:
        for share in GAUSS_POINTS:
            at = (1.0 - share) * start + share * stop
            places.append(interpolated(points, *at)[own])
            strains.append(strain_of(read, *at)[own])
    distance, index = KDTree(np.concatenate(places)).query(tissue.receptor)
    assert distance.max() < ROUNDING
    expected = tissue.strain @ solved(DEVICE, CONDITION, Interface.SHEAR).force[-1].ravel()
    assert np.abs(np.concatenate(strains)[index].ravel() - expected).max() < ROUNDING


def test_collection_names_files_and_times(tmp_path: Path) -> None:
    files = [tmp_path / "states" / "0000.vtu", tmp_path / "fields.vtu"]
    write_collection(tmp_path / "fields.pvd", np.array([0.0, 0.25]), files)
    sets = ElementTree.parse(tmp_path / "fields.pvd").getroot().findall("Collection/DataSet")
    assert [(each.get("timestep"), each.get("file")) for each in sets] == [
        ("0.0", "states/0000.vtu"),
        ("0.25", "fields.vtu"),
    ]


def test_a_shorter_path_leaves_no_state_of_a_longer_one(tmp_path: Path) -> None:
    """And no file of others goes away."""
    state = meshio.Mesh(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), [("triangle", [[0, 1, 2]])])
    pvd, folder, last = tmp_path / "path.pvd", tmp_path / "path", tmp_path / "path.vtu"
    write_path(pvd, folder, last, np.arange(4.0), [state] * 4)
    own = folder / "2024.vtu"
    own.write_text("mine", encoding="utf-8")
    write_path(pvd, folder, last, np.arange(2.0), [state] * 2)
    assert sorted(path.name for path in folder.iterdir()) == ["0000.vtu", own.name]
