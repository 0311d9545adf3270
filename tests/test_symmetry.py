"""Pre-indentation by halves against the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.contact.certificate import certify
from fingerpad.contact.force_curve import small_strain_curve
from fingerpad.contact.formulation import Status, touching_height
from fingerpad.contact.linear_solution import indented_state
from fingerpad.contact.problem import contact_problem
from fingerpad.contact.symmetry import mirrors
from fingerpad.errors import UniquenessError
from fingerpad.finite.pressing import press
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.actuator_body import body_of
from fingerpad.tissue.compliance import MIRROR
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.mesh import mesh_section, nominal_edges, nominal_mesh
from scenes import condensed, scene

# Gaps are solved to 1e-9 of the indentation of some 2 mm
LENGTH = 1e-7  # mm; the height at which the last edge touches follows gaps tenfold (measured: up to 3e-8)
SHARE = 1e-5  # of the largest [1]; forces at edges, pressed by some 0.01 mm, follow heights (measured: up to 1.3e-6)


def without_halves(base: Scene) -> Scene:
    return base.with_model(skips=replace(base.model.skips, mirrored_half=False))


def with_row(row: ActuatorRow, device: str = "device2") -> Scene:
    """A device with another row at rest, on a mesh of twice the sizes."""
    base = scene(device)
    still = np.zeros((1, len(row.positions)))
    condition = replace(base.device.conditions[0], time=np.array([1.0]), normal=still, tangential=still)
    found = replace(base.device, actuators=row, conditions=(condition,), cycles=(), frequencies=())
    return replace(base, device=found).coarsened(2.0)


def aside(row: ActuatorRow) -> list[Scene]:
    """A row on tissue that deforms much, and its mirror image."""
    image = replace(row, positions=tuple(-x for x in reversed(row.positions)))
    return [with_row(each).with_kinematics(Kinematics.FINITE) for each in (row, image)]


@pytest.mark.parametrize(
    ("device", "interface"),
    [("device2", Interface.SHEAR), ("device2", Interface.FRICTIONLESS), ("device3", Interface.SHEAR)],
)
def test_halves_give_the_same_state_as_the_whole(device: str, interface: Interface) -> None:
    """Heights, places, forces, also the largest so far, states and dissipation agree as far as the solver's tolerance
    lets them. Mirrored skin slips the other way.
    """
    base = scene(device)
    problem = contact_problem(base, *condensed(device), interface)
    assert mirrors(problem)
    halves = indented_state(base, problem)
    whole = indented_state(without_halves(base), problem)
    assert np.abs(halves.actuator - whole.actuator).max() < LENGTH
    assert np.abs(halves.force - whole.force).max() < SHARE * whole.force.max()
    assert np.abs(halves.place - whole.place).max() < LENGTH
    assert np.array_equal(halves.status > 0, whole.status > 0)
    forward, backward = (halves.status == way for way in (Status.SLIP_FORWARD, Status.SLIP_BACKWARD))
    assert forward.any()
    assert np.array_equal(forward, backward[::-1])
    assert halves.dissipation == pytest.approx(whole.dissipation, rel=SHARE)
    assert halves.largest_force == pytest.approx(whole.largest_force, rel=SHARE)


@pytest.mark.parametrize("interface", Interface)
@pytest.mark.parametrize(
    "row",
    [
        ActuatorRow((0.0,), 1.0, 0.1),
        ActuatorRow((-2.2, 0.0, 2.2), 1.2, 0.15),
        ActuatorRow((-2.0, -1.0, 0.0, 1.0, 2.0), 0.7, 0.05),
        ActuatorRow((-0.5, 0.5), 0.9, 0.0),
    ],
    ids=["one", "three", "five", "close"],
)
def test_a_node_in_the_middle_belongs_to_both_halves(row: ActuatorRow, interface: Interface) -> None:
    """A pin over the mid-line, or pins so close beside it that they might reach the skin there. The next increment is
    foreseen alike. The largest force is no less than what is borne; of the middle node's before, the half knew half.
    """
    base = with_row(row)
    section = condense_section(mesh_section(base, nominal_edges(row)), base)
    problem = contact_problem(base, section, None, interface)
    assert (problem.position[:, 0] == 0.0).sum() == 1
    assert mirrors(problem)
    halves = indented_state(base, problem)
    whole = indented_state(without_halves(base), problem)
    assert np.abs(halves.actuator - whole.actuator).max() < LENGTH
    assert np.abs(halves.force - whole.force).max() < SHARE * whole.force.max()
    assert np.abs(halves.heading - whole.heading).max() < SHARE
    for last in ("drift", "trend"):  # of the last increment, which may be short (measured: up to 2e-8)
        one, other = getattr(halves, last), getattr(whole, last)
        assert np.abs(one - other).max() < SHARE * np.abs(other).max(), last
    assert np.abs(halves.force).max() <= halves.largest_force <= (1.0 + SHARE) * whole.largest_force
    # skin half-way between two pins is either's
    places = [state.place + np.asarray(row.positions)[state.given] for state in (halves, whole)]
    assert np.abs(places[0] - places[1]).max() < LENGTH
    assert np.array_equal(halves.status > 0, whole.status > 0)


@pytest.mark.parametrize("interface", Interface)
def test_deformed_tissue_is_pressed_by_halves_with_a_pin_in_the_middle(interface: Interface) -> None:
    """The condensed section, too, is that of the whole: its compliance, and where skin would be without contact."""
    row = ActuatorRow((-2.2, 0.0, 2.2), 1.2, 0.15)
    base = with_row(row).with_kinematics(Kinematics.FINITE)
    mesh = mesh_section(base, nominal_edges(row))
    halves, whole = (press(each, mesh, None, interface) for each in (base, without_halves(base)))
    assert np.abs(halves.state.actuator - whole.state.actuator).max() < LENGTH
    assert np.abs(halves.state.force - whole.state.force).max() < SHARE * whole.state.force.max()
    assert np.abs(halves.displacement - whole.displacement).max() < LENGTH
    scale = np.abs(whole.section.compliance).max()
    assert np.abs(halves.section.compliance - whole.section.compliance).max() < SHARE * scale
    assert np.abs(halves.free - whole.free).max() < LENGTH
    assert halves.curve[-1] == pytest.approx(whole.curve[-1], rel=SHARE)


@pytest.mark.parametrize("positions", [(0.35,), (0.305, 4.0), (-2.6, -1.3, 0.8)])
def test_deformed_halves_of_a_row_that_does_not_mirror_meet(positions: tuple[float, ...]) -> None:
    """Each half is refined for its own edges, wherever they lie by the mid-line: its elements bound on nothing but
    outline and bone. The mesh of the mirrored row is the mirror image.
    """
    row = ActuatorRow(positions, 0.6, 0.1)
    found, image = (nominal_mesh(base) for base in aside(row))
    ends = found.mesh.doflocs[:, found.mesh.facets[:, found.mesh.boundary_facets()]]
    assert not np.all(ends[0] == 0.0, axis=0).any()
    assert not found.mirrors
    nodes, images = found.mesh.doflocs, image.mesh.doflocs * MIRROR[:, None]
    assert np.array_equal(nodes[:, np.lexsort(nodes)], images[:, np.lexsort(images)])
    assert found.unknowns < mesh_section(with_row(row), nominal_edges(row)).unknowns


def test_a_mesh_of_deformed_tissue_is_fine_where_a_row_aside_lies_and_there_alone() -> None:
    """Under the whole row elements of the skin are as small as asked, at its edges smaller; at their images they are
    not. Sizes grow within an element.
    """
    base, _ = aside(ActuatorRow((0.8, 2.8), 1.2, 0.15))
    row, numerics = base.device.actuators, base.model.numerics
    mesh = mesh_section(base, nominal_edges(row))
    nodes = mesh.mesh.doflocs[:, mesh.skin]
    middle, length = nodes[0, 1::2], np.hypot(*(nodes[:, 2::2] - nodes[:, :-2:2]))
    on_pad = nodes[1, 1::2] < base.model.finger.height / 2.0
    under = on_pad & (middle > 0.2) & (middle < 3.4)
    assert length[under].max() <= numerics.face_size * (1.0 + numerics.growth)
    ends = mesh.mesh.p[:, mesh.mesh.facets[:, mesh.receptor_facets]]
    read = np.hypot(*(ends[:, 1] - ends[:, 0]))[(ends[0].min(axis=0) > 0.2) & (ends[0].max(axis=0) < 3.4)]
    assert read.max() <= numerics.receptor_size * (1.0 + numerics.growth)
    for start, stop in nominal_edges(row):
        assert length[on_pad & (middle > start) & (middle < stop)].max() <= numerics.edge_size
    images = on_pad & (middle > -3.5) & (middle < -1.0)
    assert length[images].min() > numerics.edge_size
    assert length[on_pad & (middle < -3.5)].max() > length[under].max()


def test_tissue_deformed_aside_mirrors_what_is_deformed_on_the_other_side() -> None:
    """A row of two pins to the right of the finger's middle, and its mirror image, each on a mesh of its own."""
    found, image = (
        press(base, nominal_mesh(base), None, Interface.SHEAR) for base in aside(ActuatorRow((-0.4, 1.6), 1.2, 0.15))
    )
    assert found.section.position[:, 0].mean() > 0.0
    assert np.abs(found.state.actuator - image.state.actuator[::-1] * MIRROR).max() < LENGTH
    assert np.abs(found.state.force - image.state.force[::-1] * MIRROR).max() < SHARE * found.state.force.max()


def test_soft_pucks_with_a_node_between_them_are_pressed_whole() -> None:
    """Its hat is that of one of them, whose face feels it: no half knows of it."""
    row = replace(scene("device3").device.actuators, positions=(-1.8, -0.6, 0.6, 1.8), width=1.19)
    base = with_row(row, "device3")
    section = condense_section(mesh_section(base, nominal_edges(row)), base)
    problem = contact_problem(base, section, body_of(base), Interface.SHEAR)
    assert 0.0 in problem.position[:, 0]
    assert not mirrors(problem)
    certify(problem, section, indented_state(base, problem))


@pytest.mark.parametrize("edge_radius", [0.0, 0.05])
def test_close_pins_are_pressed_though_a_row_that_sways_might_go_elsewhere(edge_radius: float) -> None:
    """At first touch pins 0.3 mm apart have one node each, on edges that face each other. There friction lets the row
    slip to either side, and the states of the whole row are refused as not unique; the mirrored ones are.
    """
    row = ActuatorRow((-1.5, -0.5, 0.5, 1.5), 0.7, edge_radius)
    base = with_row(row)
    section = condense_section(mesh_section(base, nominal_edges(row)), base)
    problem = contact_problem(base, section, None, Interface.SHEAR)
    state = indented_state(base, problem)
    assert state.force[:, 1] == pytest.approx(state.force[::-1, 1], abs=SHARE * state.force.max())
    certify(problem, section, state)
    height, force = small_strain_curve(base, problem)[-1]
    assert height == pytest.approx(state.actuator[0, 1] - touching_height(problem), abs=LENGTH)
    assert force == pytest.approx(state.force[:, 1].sum(), rel=SHARE)
    with pytest.raises(UniquenessError):
        indented_state(without_halves(base), problem)


def test_a_lopsided_row_presses_as_its_mirror_image_does() -> None:
    """Neither is folded, and one bears the mirrored forces of the other."""
    base = scene("device2")
    problem = contact_problem(base, *condensed("device2"), Interface.SHEAR)
    rows = (-3.7, -1.25, 1.25, 3.75), (-3.75, -1.25, 1.25, 3.7)
    problems = [replace(problem, row=replace(problem.row, positions=row)) for row in rows]
    assert not any(mirrors(each) for each in problems)
    left, right = (indented_state(base, each) for each in problems)
    assert np.abs(left.actuator - right.actuator[::-1] * MIRROR).max() < LENGTH
    assert np.abs(left.force - right.force[::-1] * MIRROR).max() < SHARE * left.force.max()
    assert np.abs(left.force - right.force).max() > 0.01 * left.force.max()
