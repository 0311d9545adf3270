"""Solved conditions: certificates, symmetry, independence of increments, what the issue of friction does."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

import fingerpad.contact.linear_solution
from fingerpad.contact.advice import named_stimulus
from fingerpad.contact.certificate import (
    CONE_LIMIT,
    DISSIPATION_LIMIT,
    PENETRATION_LIMIT,
    TENSION_LIMIT,
    Certificate,
    certify,
    reevaluated_gap,
    require_within_reach,
    worst,
)
from fingerpad.contact.criterion import END_TOLERANCE, NEARLY
from fingerpad.contact.depth import require_tissue
from fingerpad.contact.faces import face_shape, touch
from fingerpad.contact.force_curve import small_strain_curve
from fingerpad.contact.formulation import ContactProblem, ContactState, Status, rest, touching_height
from fingerpad.contact.increment import solve_increment
from fingerpad.contact.indentation import indent
from fingerpad.contact.linear_solution import (
    follow_condition,
    indent_device,
    indented_state,
    solve_condition,
    stimulate,
)
from fingerpad.contact.ownership import handed_over
from fingerpad.contact.path import follow, recording
from fingerpad.contact.problem import contact_problem, indentation_increments, stimulus_increments
from fingerpad.contact.profile import profile
from fingerpad.contact.solution import Solution
from fingerpad.errors import CertificateError, ContactError, CriterionError, DepthError, ReachError
from fingerpad.prediction.caveats import solution_caveats
from fingerpad.prediction.edges import mesh_device
from fingerpad.readouts.gabor import filtered_readouts
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import roughness_scores
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.device import ActuatorRow, Condition
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.stimuli import CYCLE_STEPS, phased
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.actuator_body import condense_body
from fingerpad.tissue.compliance import MIRROR, CondensedSection, displaced
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.mesh import mesh_section, nominal_edges, nominal_mesh
from fingerpad.tissue.reach import contact_tractions
from scenes import condensed, scene, section, solve, solved

ROUNDING = 1e-10  # of a share [1]: that of shares of 1e-6 of forces
FINE = {"indentation_increments": 80, "stimulus_increments": 16}
CASES = [
    (device, condition.name, interface)
    for device in ("device1", "device2", "device3")
    for condition in scene(device).device.conditions
    for interface in scene(device).device.interfaces()
]


@pytest.mark.parametrize(("device", "condition", "interface"), CASES)
def test_every_solution_is_certified(device: str, condition: str, interface: Interface) -> None:
    """The laws of contact hold for every device, condition and interface, and nothing had to be cut.

    Far better than certificates ask: equilibrium but for rounding, contact to its tolerance. Faces that give way
    may be amiss by a tenth of what a certificate allows.
    """
    base, solution = scene(device), solved(device, condition, interface)
    certificate, tolerance = solution.certificate, base.model.numerics.newton_tolerance
    assert certificate.equilibrium < 1e-14
    assert certificate.contact <= tolerance
    allowed = 0.1 * PENETRATION_LIMIT if base.device.actuators.body else tolerance
    assert certificate.penetration <= allowed * solution.height
    assert certificate.smallest_pressure > 0.0
    assert certificate.cone_excess <= tolerance
    assert certificate.dissipation >= 0.0
    assert (certificate.dissipation > 0.0) == (interface is Interface.SHEAR)
    assert solution.cuts == 0
    assert np.all(np.isfinite(solution.reading.strain))


def lateral(name: str, tangential: list[float]) -> Condition:
    """A condition of four lateral displacements [mm]."""
    row = np.array([tangential])
    return Condition(name, "test", 0.0, np.array([1.0]), np.zeros_like(row), row)


@pytest.mark.parametrize("interface", list(Interface))
def test_mirrored_stimulus_gives_mirrored_strains(interface: Interface) -> None:
    """Pins 1 and 3 to the right are the mirror image of pins 2 and 4 to the left.

    Gaps are solved to the tolerance of contact, of the indentation; over the receptors' depth that is a strain.
    """
    right = solve("device2", lateral("right", [0.02, 0.0, 0.02, 0.0]), interface)
    left = solve("device2", lateral("left", [0.0, -0.02, 0.0, -0.02]), interface)
    model = scene("device2").model
    left_over = model.numerics.newton_tolerance * right.height / model.receptor_depth
    for readout, read in right.reading.readouts.items():
        assert np.abs(read - left.reading.readouts[readout][::-1]).max() < left_over


def test_indentation_alone_is_symmetric() -> None:
    """All pins pressed alike: the strain mirrors, but for the rounding of sums over some hundred nodes, as one half is
    solved and the other is its image.
    """
    still = solve("device2", lateral("still", [0.0] * 4), Interface.SHEAR)
    assert np.abs(still.reading.strain - still.reading.strain[::-1]).max() < 1e-12 * still.reading.strain.max()
    assert not still.reading.change_of_strain.any()


@pytest.mark.parametrize("device", ["device1", "device2", "device3"])
def test_full_criterion_covers_every_face_and_no_less_would(device: str) -> None:
    """After pre-indentation every node over a flat face presses; a per cent less and some face is not covered."""
    base = scene(device)
    problem = contact_problem(base, *condensed(device), Interface.SHEAR)
    state = indented_state(base, problem)
    assert np.all(pressed_over_faces(state, problem))
    lower = state.actuator * [1.0, 0.99]
    shallow = follow(
        problem, rest(problem, touching_height(problem)), lower, base.model.numerics.indentation_increments
    )
    assert not np.all(pressed_over_faces(shallow, problem))


def pressed_over_faces(state: ContactState, problem: ContactProblem) -> np.ndarray:
    """Whether each node presses that lies over a flat face, but for what may be missing at the criterion's end."""
    over_face = np.abs(state.place) < problem.row.half_face - END_TOLERANCE
    return np.asarray(state.force[over_face, 1] > 0.0)


def ending(base: Scene, criterion: Criterion, mirrored_half: bool = True, **asked: float) -> Scene:
    """The scene with another end of pre-indentation, solved on one half of the row or on all of it."""
    law = replace(base.model.contact, criterion=criterion, **asked)
    return base.with_model(contact=law, skips=replace(base.model.skips, mirrored_half=mirrored_half))


@pytest.mark.parametrize("interface", Interface)
def test_pre_indentation_ends_at_the_depth_or_the_force_that_is_asked_for(interface: Interface) -> None:
    """One path leads to both: the force at a depth is borne at that depth, on half of the row as on all of it. The row
    becomes stiffer as it is pressed, so of the depth no larger share is missing than of the force.
    """
    base, (section, body) = scene("device2"), condensed("device2")
    problem = contact_problem(base, section, body, interface)
    touch, depth = touching_height(problem), 1.1
    deep = indented_state(ending(base, Criterion.DEPTH, depth=depth), problem)
    assert deep.actuator[:, 1] - touch == pytest.approx(depth, abs=END_TOLERANCE)
    borne = float(deep.force[:, 1].sum())
    for mirrored_half in (True, False):
        heavy = indented_state(ending(base, Criterion.FORCE, mirrored_half, force=borne), problem)
        assert heavy.force[:, 1].sum() == pytest.approx(borne, rel=END_TOLERANCE)
        # what increments of another length leave of the path's friction comes on top
        assert heavy.actuator[:, 1] - touch == pytest.approx(depth, rel=10.0 * END_TOLERANCE)


def test_a_row_that_cannot_be_covered_is_pressed_as_hard_as_is_asked() -> None:
    """Pins so far apart that the outer ones touch nothing: the middle one bears what there is."""
    base, still = row_of(5, 3.8, 0.3, [0.0] * 5)
    found = condense_section(nominal_mesh(base), base)
    with pytest.raises(
        CriterionError,
        match=r"contact\.criterion: (touch, )?depth or force .* may need less indentation",
    ):
        indent_device(base, found, None, Interface.SHEAR)
    heavy = ending(base, Criterion.FORCE, force=0.05)
    solution = solve_condition(heavy, found, None, still, Interface.SHEAR)
    borne = solution.pressing[0]
    assert borne.sum() == pytest.approx(0.05, rel=END_TOLERANCE)
    assert borne[[0, -1]] == pytest.approx(0.0, abs=1e-15)
    assert borne[2] > 0.9 * borne.sum()


@pytest.mark.parametrize(
    ("criterion", "asked", "said"),
    [
        (
            Criterion.DEPTH,
            {"depth": 6.0},
            r"did not reach a depth of 6 mm within 5 mm from first touch: 1 mm short at 5 mm",
        ),
        (
            Criterion.FORCE,
            {"force": 50.0},
            r"did not reach a force of 50 N/mm within 5 mm .* N/mm short at 5 mm",
        ),
    ],
)
def test_what_is_out_of_reach_is_said(criterion: Criterion, asked: dict[str, float], said: str) -> None:
    base, (section, body) = scene("device2"), condensed("device2")
    with pytest.raises(CriterionError, match=said + rf".*; try less contact\.{criterion}"):
        indent_device(ending(base, criterion, **asked), section, body, Interface.SHEAR)


@pytest.mark.parametrize("interface", list(Interface))
def test_force_curve_ends_where_pre_indentation_does(interface: Interface) -> None:
    """Not where increments went that were taken back."""
    base = scene("device2")
    problem = contact_problem(base, *condensed("device2"), interface)
    state, curve = indented_state(base, problem), small_strain_curve(base, problem)
    assert curve[-1, 0] == pytest.approx(state.actuator[0, 1] - touching_height(problem), abs=1e-6)
    assert curve[-1, 1] == pytest.approx(state.force[:, 1].sum(), rel=1e-6)


@pytest.mark.parametrize("condition", ["alternate_090", "alternate_180"])
def test_increments_leave_little_trace(condition: str) -> None:
    """Four times the increments change both scores by less than the error they aim at (0.5 %)."""
    base = scene("device2")
    fine = solve("device2", base.device.condition(condition), Interface.SHEAR, **FINE)
    scores = []
    for solution in (solved("device2", condition, Interface.SHEAR), fine):
        resampling = resampling_to_grid(solution.arc, base.model.gabor.spacing)
        scores.append(
            roughness_scores(base, filtered_readouts(resampling, solution.reading.readouts, base.model.gabor))
        )
    assert scores[0] == pytest.approx(scores[1], rel=5e-3)


def test_frictionless_path_leaves_no_trace_at_all() -> None:
    """Without friction there is no history: to and fro ends where it began."""
    row = np.array([[0.02, -0.02, 0.02, -0.02], [0.0, 0.0, 0.0, 0.0]])
    there_and_back = Condition("loop", "test", 0.0, np.array([1.0, 2.0]), np.zeros_like(row), row)
    solution = solve("device2", there_and_back, Interface.FRICTIONLESS)
    # gaps are solved to 1e-9 of 1.7 mm; the stiffest pattern of nodal forces costs 0.027 mm per N/mm: 6e-8 N/mm
    assert np.abs(solution.force[-1] - solution.force[0]).max() < 6e-8


@pytest.mark.parametrize(("kinematics", "share"), [(Kinematics.SMALL, 2), (Kinematics.FINITE, 1)])
def test_paths_that_leave_no_trace_take_half_the_increments(kinematics: Kinematics, share: int) -> None:
    """Without friction, and on linear tissue alone: on any other half of them are too far for Newton's method."""
    base = scene("device2").with_kinematics(kinematics)
    for interface, expected in ((Interface.FRICTIONLESS, share), (Interface.SHEAR, 1)):
        problem = contact_problem(base, *condensed("device2"), interface)
        numerics = base.model.numerics
        assert indentation_increments(base, problem) == numerics.indentation_increments / expected
        assert stimulus_increments(base, problem) == numerics.stimulus_increments / expected


def test_friction_remembers() -> None:
    """With friction the same loop leaves the skin sheared: history counts."""
    row = np.array([[0.02, -0.02, 0.02, -0.02], [0.0, 0.0, 0.0, 0.0]])
    there_and_back = Condition("loop", "test", 0.0, np.array([1.0, 2.0]), np.zeros_like(row), row)
    solution = solve("device2", there_and_back, Interface.SHEAR)
    assert np.abs(solution.force[-1] - solution.force[0]).max() > 1e-3 * solution.force.max()


def test_what_is_shown_is_what_is_read() -> None:
    """Pressure, place and status are those of the time at which receptors are read, here where pins that tap turn."""
    row = np.array([[0.02, 0.0, 0.02, 0.0], [0.0, 0.0, 0.0, 0.0]])
    there = Condition("there", "test", 0.0, np.array([1.0]), row[:1], np.zeros_like(row[:1]))
    back = Condition("tap", "test", 0.0, np.array([1.0, 2.0]), row, np.zeros_like(row))
    one, both = (solve("device2", condition, Interface.SHEAR) for condition in (there, back))
    assert (one.reading.time, both.reading.time) == (0, 0)
    for name in ("pressure", "shear", "place", "status"):
        assert np.array_equal(getattr(one, name), getattr(both, name)), name
    for readout, read in one.reading.readouts.items():  # strains of several times at once are summed in another order
        assert np.abs(read - both.reading.readouts[readout]).max() < 1e-12 * np.abs(one.reading.strain).max(), readout


def test_skin_is_shown_where_its_forces_move_it() -> None:
    """Along the row, of pins that go to either side; to the tolerance of contact."""
    base, moved = scene("device2"), lateral("moved", [0.02, -0.01, 0.0, 0.02])
    solution, (section, _) = solve("device2", moved, Interface.SHEAR), condensed("device2")
    x = section.position[:, 0] + displaced(section.compliance, solution.force[-1])[:, 0]
    apart = solution.skin_x(base.device.actuators, moved) - x
    assert np.abs(apart).max() < base.model.numerics.newton_tolerance * solution.height


def tap(*heights: float) -> Condition:
    """All four pins up to some heights [mm] above those of pre-indentation, one after the other."""
    normal = np.repeat(np.array(heights)[:, None], 4, axis=1)
    return Condition("tap", "test", 0.0, 1.0 + np.arange(len(heights)), normal, np.zeros_like(normal))


def test_depth_is_the_largest_of_all_times() -> None:
    """A tap is as much deeper than rest as it is high, though pins come back; but for rounding."""
    still, tapped = (solve("device2", tap(*heights), Interface.SHEAR) for heights in ((0.0,), (0.02, 0.0)))
    assert tapped.depth - still.depth == pytest.approx(0.02, abs=1e-9)


def test_every_state_of_a_stimulus_is_certified(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those on the way as the last one."""
    base, (section, body) = scene("device2"), condensed("device2")
    pressed, heights = indent_device(base, section, body, Interface.SHEAR), []

    def noting(problem: ContactProblem, section: CondensedSection, state: ContactState) -> Certificate:
        heights.append(state.actuator[0, 1] - pressed.state.actuator[0, 1])
        return certify(problem, section, state)

    monkeypatch.setattr(fingerpad.contact.linear_solution, "certify", noting)
    stimulate(base, pressed, tap(0.01, 0.03, 0.02))
    assert heights == pytest.approx([0.01, 0.03, 0.02])


def test_of_several_states_the_worst_figures_are_told() -> None:
    """Whichever comes first: the largest, but of pressure and of frictional work the smallest."""
    names = [each.name for each in fields(Certificate)]
    low, high = (Certificate(**dict.fromkeys(names, figure)) for figure in (1.0, 2.0))
    expected = replace(high, smallest_pressure=1.0, dissipation=1.0)
    assert worst([low, high]) == worst([high, low]) == expected


def test_sliding_share_counts_both_directions() -> None:
    """Of what presses at the time that is read, not before."""
    solution = solved("device2", "alternate_180", Interface.SHEAR)
    status = np.full_like(solution.status, Status.OPEN)
    status[:4] = Status.STICK, Status.SLIP_FORWARD, Status.SLIP_BACKWARD, Status.STICK
    contact = np.full_like(solution.contact, 9.0)
    contact[1 + solution.reading.time, :, 1] = 0.0
    contact[1 + solution.reading.time, :4, 1] = 4.0, 3.0, 2.0, 1.0
    assert replace(solution, contact=contact, status=status).sliding_share == pytest.approx(0.5)


def test_normal_and_lateral_histories_combine() -> None:
    """An arbitrary stimulus: each pin its own normal and tangential path; lifting one pin off unloads it alone."""
    time = np.array([1.0, 2.0, 3.0])
    normal = np.array([[0.0, 0.01, 0.0, 0.0], [0.0, 0.02, 0.0, -0.01], [0.0, 0.0, 0.0, -2.0]])
    tangential = np.array([[0.01, 0.0, 0.0, 0.0], [0.0, 0.0, -0.01, 0.0], [0.02, 0.0, 0.0, 0.0]])
    solution = solve("device2", Condition("free", "test", 0.0, time, normal, tangential), Interface.SHEAR)
    problem = contact_problem(scene("device2"), *condensed("device2"), Interface.SHEAR)
    pressed = [solution.force[-1][problem.actuator_of == pin, 1].sum() for pin in range(4)]
    assert solution.force.shape[0] == 1 + 3  # pre-indentation, and the times
    assert pressed[3] == 0.0
    assert min(pressed[:3]) > 0.01


def test_a_patch_from_the_last_move_leaves_no_trace() -> None:
    """A history is the same whether the patch of one move serves the next, or every move makes its own."""
    base, time = scene("device2"), np.arange(1.0, 5.0)
    tangential = 0.01 * np.array([[1.0, -1.0, 1.0, -1.0], [2.0, 0.0, 0.0, -2.0], [-1.0, 0.0, 1.0, 0.0], [0.0] * 4])
    history = Condition("history", "test", 0.0, time, np.zeros_like(tangential), tangential)
    problem = contact_problem(base, *condensed("device2"), Interface.SHEAR)
    before = indented_state(base, problem)
    anew = before
    for state, moved in zip(follow_condition(base, problem, before, history), history.moves, strict=True):
        anew = follow(problem, anew, before.actuator + moved, base.model.numerics.stimulus_increments)
        # as without friction above: what gaps of 1e-9 of 1.7 mm are worth
        assert np.abs(state.force - anew.force).max() < 6e-8


def solve_anew(changed: Scene, condition: Condition) -> Solution:
    """A condition without friction on a scene of a mesh of its own."""
    section = condense_section(mesh_device(changed), changed)
    return solve_condition(changed, section, None, condition, Interface.FRICTIONLESS)


def test_a_deep_drive_stays_within_reach() -> None:
    """Pins that go 0.5 mm into the skin push it sideways by more than the margin: reach grows with their stroke."""
    base = scene("device2")
    row = np.array([[0.5, -0.5, 0.5, -0.5]])
    deep = Condition("deep", "test", 0.0, np.array([1.0]), row, np.zeros_like(row))
    device = replace(base.device, conditions=(deep,))
    assert device.stroke == 0.5
    found = solve_anew(replace(base, device=device).coarsened(2.0), deep)
    assert found.certificate.penetration <= base.model.numerics.newton_tolerance * found.height


def test_a_row_too_wide_says_what_helps() -> None:
    base = scene("device2")
    still = lateral("still", [0.0, 0.0])
    row = replace(base.device.actuators, positions=(-7.0, 7.0))
    wide = base.with_device(actuators=row, conditions=(still,))
    advice = r"contact\.criterion: touch, depth or force \(in the device file, or .* may need less indentation"
    with pytest.raises(ContactError, match=advice):
        solve_anew(wide.coarsened(4.0), still)


@pytest.mark.parametrize(("row", "solved_by_touch"), [((5, 3.8, 0.3), False), ((3, 7.4, 0.6), True)])
def test_rows_that_are_never_covered_say_what_helps(row: tuple[int, float, float], solved_by_touch: bool) -> None:
    """Of five pins on 15 mm the outer ones touch no skin at any height that the inner ones allow, so that `touch` is no
    way out; of three on as many it is.
    """
    wide, _ = row_of(*row, [0.0] * row[0])
    wide = wide.with_model(numerics=replace(wide.model.numerics, contact_margin=1.0))
    found = condense_section(nominal_mesh(wide), wide)
    with pytest.raises(CriterionError, match="may need less indentation, as a narrower row does") as failure:
        indent_device(wide, found, None, Interface.SHEAR)
    assert ("never touched at once" in str(failure.value)) is not solved_by_touch
    assert ("contact.criterion: touch" in str(failure.value)) is solved_by_touch
    touching = ending(wide, Criterion.TOUCH)
    if solved_by_touch:
        state = indent_device(touching, found, None, Interface.SHEAR).state
        assert np.all(np.bincount(state.given, state.force[:, 1], minlength=row[0]) > 0.0)
    else:
        with pytest.raises(CriterionError):
            indent_device(touching, found, None, Interface.SHEAR)


def test_where_close_faces_are_covered_does_not_hang_on_rounding() -> None:
    """Skin that touches one of two faces side by side is on the other one, too, not above it by 1e-16 mm."""
    base, _ = row_of(6, 1.53, 1.5, [0.0] * 6, edge_radius=0.0)
    base = base.coarsened(2.0)
    found = condense_section(nominal_mesh(base), base)
    heights = []
    for mirrored_half, inactive_nodes in ((True, True), (True, False), (False, True)):
        asked = ending(base, Criterion.FULL, mirrored_half)
        skips = replace(asked.model.skips, inactive_nodes=inactive_nodes)
        asked = asked.with_model(skips=skips)
        heights.append(indent_device(asked, found, None, Interface.SHEAR).state.actuator[0, 1])
    assert heights == pytest.approx([heights[0]] * 3, abs=END_TOLERANCE)


@pytest.mark.parametrize("increments", [5, 40])
def test_actuators_that_all_touch_at_once_are_pressed_no_further(increments: int) -> None:
    """By the first step, however long increments are, they would go past where each touches."""
    base, still = row_of(2, 3.0, 2.0, [0.0] * 2)
    base = base.with_model(numerics=replace(base.model.numerics, indentation_increments=increments))
    found = condense_section(nominal_mesh(base), base)
    touching = ending(base, Criterion.TOUCH)
    solution = solve_condition(touching, found, None, still, Interface.SHEAR)
    assert np.all(solution.pressing[0] > 0.0)
    assert solution.indentation == pytest.approx(NEARLY, rel=1e-6)
    assert any("ends at first touch" in caveat for caveat in solution_caveats(touching, solution, Interface.SHEAR))


def test_a_criterion_that_is_met_just_within_the_limit_is_met() -> None:
    """The last step goes to the limit, not past it."""
    base, (section, body) = scene("device2"), condensed("device2")
    problem = contact_problem(base, section, body, Interface.SHEAR)
    met = float(indented_state(base, problem).actuator[0, 1]) - touching_height(problem)
    count = base.model.numerics.indentation_increments
    limited = indent(problem, base.model.contact, count, met + 2.0 * END_TOLERANCE)
    assert limited.actuator[0, 1] - touching_height(problem) == pytest.approx(met, abs=2.0 * END_TOLERANCE)
    with pytest.raises(CriterionError, match="did not reach 'full' contact"):
        indent(problem, base.model.contact, count, 0.99 * met)


def test_a_stimulus_is_not_blamed_for_where_pressing_ended() -> None:
    """Five pins on so curved a pad: with little skin beside them, contact leaves it before anything has moved."""
    base = scene("device2")
    base = base.with_model(numerics=replace(base.model.numerics, contact_margin=0.25))
    still = lateral("still", [0.0] * 5)
    row = replace(base.device.actuators, positions=(-5.0, -2.5, 0.0, 2.5, 5.0))
    wide = base.with_device(actuators=row, conditions=(still,), cycles=())
    said = r"device=device2, interface=shear, pre-indentation: .* moved [\d.]+ mm sideways; .* as a narrower row does"
    with pytest.raises(ReachError, match=said):
        indent_device(wide, condense_section(mesh_section(wide, nominal_edges(row)), wide), None, Interface.SHEAR)


def test_failures_name_device_condition_and_interface() -> None:
    """A path that leaves the candidate nodes, and an indentation that cannot be reached."""
    far = lateral("far", [0.0, 0.0, 0.0, -0.9])
    with pytest.raises(
        ContactError, match=r"device=device2, condition=far, interface=frictionless: .*numerics\.contact_margin"
    ):
        solve("device2", far, Interface.FRICTIONLESS)
    base = scene("device2")
    problem = contact_problem(base, *condensed("device2"), Interface.SHEAR)
    for beyond, what in ((3.6, r"[\d.]+ mm short"), (2.6, "an actuator touches no skin")):
        lifted = np.where(np.abs(problem.position[:, [0]]) > beyond, [0.0, 30.0], [0.0, 0.0])
        with pytest.raises(
            ContactError, match=rf"pre-indentation did not reach 'full' contact within 5 mm from first touch: {what} at"
        ):
            indented_state(base, replace(problem, position=problem.position + lifted))


@pytest.mark.parametrize("way", [[1.4], [1.4, 0.0]])
def test_every_state_on_the_way_is_certified(way: list[float]) -> None:
    """Scores are read at the peak: that all pins come back from where no skin was considered mends nothing."""
    row = np.array(way)[:, None] * np.ones(4)
    far = Condition("far", "test", 0.0, np.arange(1.0, len(way) + 1.0), np.zeros_like(row), row)
    with pytest.raises(ReachError):
        solve_anew(scene("device2").coarsened(3.0), far)


def test_every_increment_asks_whether_contact_stays_within_reach(monkeypatch: pytest.MonkeyPatch) -> None:
    """So that no path is followed that leads to no solution."""
    base = scene("device2")
    pressed = indent_device(base, *condensed("device2"), Interface.SHEAR)

    def refuse(*_: object) -> None:
        raise ReachError("refused")

    monkeypatch.setattr(fingerpad.contact.linear_solution, "require_within_reach", refuse)
    with pytest.raises(ReachError, match="device=device2, condition=tap, interface=shear: refused"):
        stimulate(base, pressed, tap(0.01))


@pytest.mark.parametrize("interface", Interface)
def test_wider_sharp_pins_are_covered_deeper(interface: Interface) -> None:
    """Evenly, wherever nodes lie beside an edge: as a cylinder's contact grows, by a power between 1 and 2 (Hertz, with
    its logarithm), but for the few per cent by which fronts between nodes are known."""
    base, row = scene("device2"), ActuatorRow((0.0,), 0.3, 0.0)
    still = Condition("still", "alone", 0.0, np.array([1.0]), np.zeros((1, 1)), np.zeros((1, 1)))
    device = replace(base.device, actuators=row, conditions=(still,), cycles=(), frequencies=())
    pin = replace(base, device=device)
    found, widths = condense_section(mesh_section(pin, nominal_edges(row)), pin), np.linspace(0.26, 0.34, 9)
    problems = [
        replace(contact_problem(pin, found, None, interface), row=replace(row, width=float(width))) for width in widths
    ]
    depths = [indented_state(pin, each).actuator[0, 1] - touching_height(each) for each in problems]
    assert np.all(np.diff(depths) > 0.0)
    fit = np.polynomial.Polynomial.fit(np.log(widths), np.log(depths), 1)
    assert 1.0 < fit.deriv()(0.0) < 2.0
    assert np.abs(fit(np.log(widths)) - np.log(depths)).max() < 0.03


@pytest.mark.parametrize("count", [3, 4])
def test_pins_are_covered_the_deeper_the_wider_until_they_abut(count: int) -> None:
    """Skin in a gap of few nodes, or of one, covers the faces beside it whosever node it is."""
    depths = []
    for gap in (0.1, 0.05, 0.03, 0.02, 0.01, 0.0):
        base, still = row_of(count, 1.0, 1.0 - gap, [0.0] * count)
        found = condense_section(nominal_mesh(base), base)
        depths.append(solve_condition(base, found, None, still, Interface.SHEAR).depth)
    assert np.all(np.diff(depths) > 0.0)
    assert depths[-1] < 1.1 * depths[0]  # as much as the faces are wider


@pytest.mark.parametrize("interface", Interface)
@pytest.mark.parametrize("count", [1, 2, 3])
def test_touch_ends_where_the_last_pin_bears_something(count: int, interface: Interface) -> None:
    base, still = row_of(count, 1.2, 0.8, [0.0] * count)
    base = ending(base, Criterion.TOUCH)
    found = condense_section(nominal_mesh(base), base)
    solution = solve_condition(base, found, None, still, interface)
    assert np.all(solution.pressing[0] > 0.0)
    if count == 3:  # one or two touch from the start
        less = ending(base, Criterion.DEPTH, depth=solution.depth - 0.01)
        borne = solve_condition(less, found, None, still, interface).pressing[0]
        assert borne[[0, -1]] == pytest.approx(0.0, abs=1e-15)


def test_round_pins_are_pressed_until_contact_reaches_the_middle_of_each() -> None:
    """They have no flat face to cover: outer ones touch first with their inner flanks, and then go deeper."""
    base, still = row_of(4, 2.5, 1.0, [0.0] * 4, edge_radius=0.5)
    found = condense_section(nominal_mesh(base), base)
    covered, touching = (
        solve_condition(ending(base, each), found, None, still, Interface.SHEAR)
        for each in (Criterion.FULL, Criterion.TOUCH)
    )
    assert covered.depth > 1.2 * touching.depth
    outermost = [each.place[(each.actuator == 3) & (each.status != 0)].max() for each in (covered, touching)]
    assert outermost[0] == pytest.approx(0.0, abs=0.05)  # to an element
    assert outermost[1] < -0.05


def test_round_pins_are_pressed_in_about_as_many_increments_as_flat_ones() -> None:
    """The way to the skin over their middles is as long as that to faces: within a third, as contact is found there by
    increments that grow shorter."""
    counts = {}
    for share in (0.45, 0.5):
        base, _ = row_of(4, 2.5, 1.0, [0.0] * 4, edge_radius=share)
        found = condense_section(nominal_mesh(base), base)
        problem = contact_problem(base, found, None, Interface.SHEAR)
        passed: list[ContactState] = []
        indent(
            problem, base.model.contact, 20, base.model.finger.pad_thickness, recording(solve_increment, passed.append)
        )
        counts[share] = len(passed)
    assert counts[0.5] == pytest.approx(counts[0.45], rel=1.0 / 3.0)


def test_skin_that_is_handed_over_keeps_actuators_in_order() -> None:
    """One node of the left pin has come to lie over the right one, and the next to its right has not: both go."""
    base, _ = row_of(2, 1.0, 0.9, [0.0, 0.0])
    found = condense_section(nominal_mesh(base), base)
    problem = contact_problem(base, found, None, Interface.SHEAR)
    state = rest(problem, 2.0)
    last = int(np.flatnonzero(state.given == 0)[-1])
    place = state.place.copy()
    place[last - 1] = 0.9  # 0.1 mm to the left of the right pin's middle, and so over its face
    given = handed_over(problem, replace(state, place=place, gap=np.full_like(place, -0.1)), 0.01)
    assert given[last - 1] == given[last] == 1
    assert np.all(np.diff(given) >= 0)


def touching(x: np.ndarray, row: ActuatorRow, node: int) -> tuple[ContactProblem, ContactState]:
    """Skin with nodes at x (n,) [mm], of which one touches a row that stands 0.1 mm deep in it."""
    problem = ContactProblem(
        position=np.stack([x, np.zeros(x.size)], axis=1),
        compliance=np.eye(2 * x.size),
        row=row,
        body=None,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=10,
    )
    state = rest(problem, 0.1)
    return problem, replace(state, status=np.where(np.arange(x.size) == node, Status.STICK, Status.OPEN))


@pytest.mark.parametrize(("node", "is_within"), [(0, False), (1, True), (2, False), (3, False), (4, True), (5, False)])
def test_contact_ends_beside_skin_that_is_not_considered(node: int, is_within: bool) -> None:
    """Elements of 1 mm, without the one in the middle, whose ends bear half of it: they are no neighbours."""
    problem, state = touching(np.array([0.0, 1.0, 2.0, 4.0, 5.0, 6.0]), ActuatorRow((3.0,), 8.0, 0.0), node)
    section = replace(condensed("device2")[0], weight=np.array([0.5, 1.0, 1.0, 1.0, 1.0, 0.5]))
    with nullcontext() if is_within else pytest.raises(ReachError, match="edge of the modelled contact zone"):
        require_within_reach(problem, section, state)


@pytest.mark.parametrize(("share", "is_within"), [(0.5, True), (2.0, False)])
def test_skin_that_presses_into_the_neighbour_of_its_actuator_is_refused(share: float, is_within: bool) -> None:
    """An open node of the left pin lies over the right one's face, deeper than PENETRATION_LIMIT allows or less."""
    x = np.arange(-1.0, 3.1, 0.25)
    problem, state = touching(x, ActuatorRow((0.0, 2.0), 1.0, 0.1), 4)
    last = int(np.flatnonzero(state.given == 0)[-1])
    place, gap = state.place.copy(), state.gap.copy()
    place[last] = 1.9  # 0.1 mm to the left of the right pin's middle
    gap[last] = profile(problem.row, place[last : last + 1])[0][0] - share * PENETRATION_LIMIT * 0.1
    section = replace(condensed("device2")[0], weight=np.full(x.size, 0.25))
    with nullcontext() if is_within else pytest.raises(ReachError, match="skin that only its neighbour's may touch"):
        require_within_reach(problem, section, replace(state, place=place, gap=gap))


@pytest.mark.parametrize("interface", Interface)
@pytest.mark.parametrize("force", [1e-4, 1e-2])
def test_light_forces_are_met_as_well(force: float, interface: Interface) -> None:
    base, still = row_of(1, 1.0, 0.8, [0.0])
    base = ending(base, Criterion.FORCE, force=force)
    found = condense_section(nominal_mesh(base), base)
    borne = solve_condition(base, found, None, still, interface).pressing[0].sum()
    assert borne == pytest.approx(force, rel=END_TOLERANCE)


@pytest.mark.parametrize("interface", Interface)
def test_certificate_refuses_what_breaks_a_single_law(interface: Interface) -> None:
    """States that obey all laws but one, which the error names; half of what a law allows passes, and is told."""
    base = scene("device2")
    found, body = condensed("device2")
    problem = contact_problem(base, found, body, interface)
    state = indented_state(base, problem)
    (least,) = np.flatnonzero(state.status != 0)[[np.argmin(state.force[state.status != 0, 1])]]
    largest = state.force[:, 1].max()

    def bearing(shearing: float, pressing: float) -> tuple[ContactProblem, ContactState]:
        """With another force on that node, on tissue that leaves all nodes where they were."""
        tampered = state.force.copy()
        tampered[least] = shearing, pressing
        free = -(problem.compliance @ (tampered - state.force).ravel()).reshape(-1, 2)
        return replace(problem, free=free), replace(state, force=tampered)

    def lowered(share: float) -> tuple[ContactProblem, ContactState]:
        overlap = np.array([0.0, share * PENETRATION_LIMIT * state.actuator[0, 1]])
        return replace(problem, position=problem.position - overlap), state

    def pulling(share: float) -> tuple[ContactProblem, ContactState]:
        pressure = (state.force[:, 1] / found.weight).max()
        return bearing(0.0, -share * TENSION_LIMIT * pressure * found.weight[least])

    def sheared(share: float, way: float = 1.0) -> tuple[ContactProblem, ContactState]:
        limit = problem.friction * state.force[least, 1]
        beyond = share * CONE_LIMIT * (problem.friction or 1.0) * largest
        return bearing(way * (limit + beyond), state.force[least, 1])

    def certified(tampered: tuple[ContactProblem, ContactState]) -> Certificate:
        return certify(tampered[0], found, tampered[1])

    left_over = problem.tolerance / PENETRATION_LIMIT  # by the solver, of gaps, over what a certificate allows
    tenth = 5e-4  # of the error that strain scores aim at
    assert certify(problem, found, state).penetration_share < left_over
    assert certified(lowered(0.5)).penetration_share == pytest.approx(0.5, abs=left_over)
    assert certified(lowered(-0.5)).gap_share == pytest.approx(0.5, abs=left_over)
    assert certified(pulling(0.5)).tension_share == pytest.approx(0.5, abs=ROUNDING)
    assert certified(sheared(0.5)).cone_share == pytest.approx(0.5, abs=ROUNDING)
    for law, tampered in (
        ("contact residual", (problem, replace(state, residual=2.0 * problem.tolerance))),
        ("penetration", lowered(2.0)),
        ("penetration", lowered(tenth / PENETRATION_LIMIT)),
        ("gap in contact", lowered(-2.0)),
        ("tension", pulling(2.0)),
        ("tension", pulling(tenth / TENSION_LIMIT)),
        ("excess over the friction cone", sheared(2.0)),
        ("excess over the friction cone", sheared(2.0, -1.0)),
        ("excess over the friction cone", sheared(tenth / CONE_LIMIT)),
    ):
        with pytest.raises(CertificateError, match=f"certificate: {law} "):
            certified(tampered)


def test_opposite_waves_that_are_played_in_cycles_score_alike() -> None:
    """Half a cycle later a wave is the other one's mirror image. Friction remembers how a cycle was begun: in the first
    one alone they score 40 % apart. Skin walks on by half a per cent a cycle."""
    stimulus = {
        "direction": "lateral",
        "half_cycle": "first",
        "amplitude": 0.02,
        "playback": "cycle",
        "phases": [90],
        "dispersions": {"left": [0, 1, 2], "right": [2, 1, 0]},
    }
    waves = tuple(phased(stimulus, 3, Path()))
    base = scene("device2")
    row = replace(base.device.actuators, positions=(-2.5, 0.0, 2.5))
    three = base.with_device(actuators=row, conditions=waves, cycles=()).coarsened(3.0)
    section = condense_section(mesh_device(three), three)
    resampling = resampling_to_grid(section.arc, three.model.gabor.spacing)

    def score(wave: Condition) -> float:
        """Of the change of strain, with friction."""
        solution = solve_condition(three, section, None, wave, Interface.SHEAR)
        read = filtered_readouts(resampling, solution.reading.readouts, three.model.gabor)
        return roughness_scores(three, read)[Readout.CHANGE_OF_STRAIN]

    def first(wave: Condition) -> Condition:
        """Its first cycle alone."""
        count = CYCLE_STEPS
        return replace(
            wave, time=wave.time[:count], normal=wave.normal[:count], tangential=wave.tangential[:count], settling=0
        )

    left, right = map(score, waves)
    assert right == pytest.approx(left, rel=0.01)
    left, right = (score(first(wave)) for wave in waves)
    assert right < 0.9 * left


def test_waves_that_differ_in_time_alone_score_alike() -> None:
    """On six close pins sin(t + 300 - 60 i) is sin(t - 60 i) later in the cycle. In the second cycle of each friction
    still remembers how they began: 6 % apart."""
    stimulus = {
        "direction": "lateral",
        "half_cycle": "first",
        "amplitude": 0.02,
        "playback": "cycle",
        "phases": [60, 300],
        "dispersions": {"left": [5, 4, 3, 2, 1, 0], "right": [0, 1, 2, 3, 4, 5]},
    }
    waves = {wave.name: wave for wave in phased(stimulus, 6, Path())}
    asked = waves["left_060"], waves["right_300"]
    base = scene("device2")
    row = ActuatorRow(tuple(1.2 * np.arange(-2.5, 3.0)), 0.5, 0.05)
    six = base.with_device(actuators=row, conditions=asked, cycles=()).coarsened(3.0)
    section = condense_section(mesh_device(six), six)
    resampling = resampling_to_grid(section.arc, six.model.gabor.spacing)
    scores = []
    for wave in asked:
        solution = solve_condition(six, section, None, wave, Interface.SHEAR)
        read = filtered_readouts(resampling, solution.reading.readouts, six.model.gabor)
        scores.append(roughness_scores(six, read)[Readout.CHANGE_OF_STRAIN])
    assert scores[0] == pytest.approx(scores[1], rel=0.015)


def row_of(
    count: int, pitch: float, width: float, stroke: list[float], edge_radius: float = 0.1
) -> tuple[Scene, Condition]:
    """Pins that move sideways, and the stimulus, with twice the sizes of elements."""
    base, condition = scene("device2"), lateral("stroke", stroke)
    row = ActuatorRow(tuple(pitch * (np.arange(count) - (count - 1) / 2.0)), width, edge_radius)
    device = replace(base.device, actuators=row, conditions=(condition,), cycles=())
    return replace(base, device=device).coarsened(2.0), condition


def test_a_long_stroke_is_not_halved_again_and_again() -> None:
    """Fronts cross many nodes in one increment of a long stroke. Once one was halved, the others stay as short, and end
    where shorter ones end.
    """
    base, condition = row_of(2, 2.5, 1.0, [0.7, -0.7])
    found = condense_section(mesh_device(base), base)
    pressed = indent_device(base, found, None, Interface.SHEAR)
    few, many = (
        follow_condition(
            base.with_model(numerics=replace(base.model.numerics, stimulus_increments=count)),
            pressed.problem,
            pressed.state,
            condition,
        )[-1]
        for count in (2, 200)
    )
    assert 0 < few.cuts <= 4
    assert np.abs(few.force - many.force).max() < 1e-8 * np.abs(many.force).max()


@pytest.mark.parametrize("interface", Interface)
def test_pins_sweep_over_skin_that_lay_under_others(interface: Interface) -> None:
    """By three times their distance, to one side as to the other."""
    there, back = row_of(4, 1.0, 0.6, [3.0] * 4), row_of(4, 1.0, 0.6, [-3.0] * 4)
    found = condense_section(mesh_device(there[0]), there[0])
    one, other = (solve_condition(base, found, None, condition, interface) for base, condition in (there, back))
    assert np.any(one.actuator != there[0].device.actuators.nearest(one.position[:, 0]))
    largest = np.abs(one.force[-1]).max()
    assert np.abs(one.force[-1] - other.force[-1][::-1] * MIRROR).max() < 1e-6 * largest


@pytest.mark.parametrize("interface", Interface)
@pytest.mark.parametrize("stroke", [0.05, 0.4])
def test_pins_that_abut_and_move_together_are_one(stroke: float, interface: Interface) -> None:
    """Skin slides from one face to the next. What the corners between them leave is as small as they are, 2e-3 mm."""
    row, condition = row_of(4, 1.0, 1.0, [stroke] * 4, edge_radius=0.0)
    wide, same = row_of(1, 4.0, 4.0, [stroke], edge_radius=0.0)
    mesh = nominal_mesh(row)
    many, one = (
        solve_condition(pressed, condense_section(mesh, pressed), None, moved, interface)
        for pressed, moved in (
            (ending(row, Criterion.DEPTH, depth=0.5), condition),
            (ending(wide, Criterion.DEPTH, depth=0.5), same),
        )
    )
    assert many.pressing.sum(axis=1) == pytest.approx(one.pressing.sum(axis=1), rel=1e-3)
    assert np.abs(many.reading.strain - one.reading.strain).max() < 1e-3 * one.reading.strain.max()
    change = many.reading.change_of_strain - one.reading.change_of_strain
    assert np.abs(change).max() < 1e-3 * one.reading.strain.max()


@pytest.mark.parametrize("interface", Interface)
def test_a_stimulus_through_the_tissue_is_refused(interface: Interface) -> None:
    """Linear tissue would let it pass. Of four pins the one that goes deepest counts, from where it touches itself."""
    base = scene("device2")
    pressed = indent_device(base, condensed("device2")[0], None, interface)
    touching = touching_height(pressed.problem)  # of the inner pins
    room = base.model.finger.pad_thickness - (pressed.state.actuator[0, 1] - touching)
    for extra, pins in ((-0.01, [0, 0, 1, 0]), (0.01, [1, 0, 0, 1])):
        up = np.stack([np.zeros(4), (room + extra) * np.array(pins)], axis=1)
        require_tissue(pressed.problem, (pressed.state.actuator + up)[None], base.model.finger.pad_thickness)
    normal = np.zeros((3, 4))
    normal[1, 2] = room + 0.01  # on the way, not at its ends
    deep = Condition("deep", "test", 0.0, np.arange(1.0, 4.0), normal, np.zeros_like(normal))
    with pytest.raises(DepthError, match=r"5\.01 mm deep, into 5 mm of tissue"):
        follow_condition(base, pressed.problem, pressed.state, deep)
    with pytest.raises(DepthError, match=r"displacements are in mm$"), named_stimulus(base, deep, interface):
        follow_condition(base, pressed.problem, pressed.state, deep)  # nothing else that could be left out helps


def test_work_of_friction_is_measured_by_the_largest_force_so_far() -> None:
    """Where the skin was left nothing presses, and rounding of the work is no error; more than that is."""
    base = scene("device2").coarsened(3.0)
    found = condense_section(nominal_mesh(base), base)
    problem = contact_problem(base, found, None, Interface.SHEAR)
    pressed = indented_state(base, problem)
    left = follow(problem, pressed, np.full_like(pressed.actuator, -0.1), 8)  # down and aside
    assert not left.force.any()
    assert left.largest_force >= pressed.largest_force > 0.0
    allowed = DISSIPATION_LIMIT * problem.friction * left.largest_force * np.abs(left.actuator).max()
    certify(problem, found, replace(left, dissipation=-0.9 * allowed))
    for share in (1.1, 5e-4 / DISSIPATION_LIMIT):  # a tenth of the error that strain scores aim at
        with pytest.raises(CertificateError, match="certificate: negative dissipation "):
            certify(problem, found, replace(left, dissipation=-share * allowed))


def test_face_shape_functions_interpolate_quadratics() -> None:
    """They sum to one and reproduce a quadratic anywhere on the face, but for a few roundings of numbers below one;
    beyond its ends they hold the end.
    """
    _, body = condensed("device3")
    assert body is not None
    at = np.linspace(body.coordinate[0], body.coordinate[-1], 37)[None]
    shape = face_shape(body, at, np.ones_like(at))
    assert np.abs(shape.sum(axis=1) - 1.0).max() < 1e-14
    assert np.abs(shape @ body.coordinate**2 - at**2).max() < 1e-14
    (end,) = face_shape(body, np.array([[9.0]]), np.ones((1, 1)))
    assert end[-1] == 1.0
    assert not end[:-1].any()


def test_skin_touches_faces_with_its_hats() -> None:
    """A node, whose place is the mean of the skin under its hat, feels the mean of the face there. Of a quadratic that
    is x^2 + (a^2 + a b + b^2) / 18, with the distances a and b to its neighbours, but for rounding."""
    base = scene("device3")
    section, body = condensed("device3")
    assert body is not None
    problem = contact_problem(base, section, body, Interface.SHEAR)
    place = rest(problem, 0.0).place
    there = touch(problem, place)
    assert there is not None
    for own in problem.spans:
        x, a, b = place[own][1:-1], np.diff(place[own])[:-1], np.diff(place[own])[1:]
        on_face = np.abs(x) + np.maximum(a, b) < body.coordinate[-1]
        found = (there[own] @ body.coordinate**2)[1:-1]
        expected = x**2 + (a**2 + a * b + b**2) / 18.0
        assert np.abs(found - expected)[on_face].max() < 1e-14
        assert on_face.sum() > 10


def test_body_mesh_may_be_finer_than_the_skin() -> None:
    """Faces bear what a node's hat spreads, not a point load, under which a finer mesh would give way ever more: 1.5
    times smaller elements of the bodies move strain by less than 0.1 % of the largest, its change by less than 1 %.
    """
    base = scene("device3")
    section, body = condensed("device3")
    finer = condense_body(base.coarsened(1.0 / 1.5))
    condition = base.device.conditions[0]
    one, other = (solve_condition(base, section, each, condition, Interface.SHEAR).reading for each in (body, finer))
    assert np.abs(other.strain - one.strain).max() < 1e-3 * np.abs(one.strain).max()
    change = other.change_of_strain - one.change_of_strain
    assert np.abs(change).max() < 0.01 * np.abs(one.change_of_strain).max()


def test_a_larger_margin_considers_as_much_more_skin() -> None:
    """To an element: 0.6 mm beside the row in place of 0.25."""
    base = scene("device2")
    section, numerics = mesh_device(base), base.model.numerics
    margins = (replace(numerics, contact_margin=margin) for margin in (0.25, 0.6))
    near, far = (contact_tractions(section, base.with_model(numerics=each)).position[:, 0].max() for each in margins)
    assert far - near == pytest.approx(0.35, abs=numerics.face_size)


def test_skin_on_the_mid_line_is_left_out_only_where_no_face_gets_near() -> None:
    """Both halves of a row that mirrors are then alike. Near is half the margin beside it."""
    base, margin = scene("device2"), replace(scene("device2").model.numerics, contact_margin=0.8)
    section = mesh_device(base)
    for stroke, reached in ((0.3, False), (0.4, True)):  # the inner pins' faces end 0.75 mm beside it
        moved = base.with_device(conditions=(lateral("moved", [stroke] * 4),), cycles=())
        x = contact_tractions(section, moved.with_model(numerics=margin)).position[:, 0]
        assert (0.0 in x) is reached


@pytest.mark.parametrize("interface", Interface)
def test_skin_belongs_to_the_actuator_that_it_is_pressed_to(interface: Interface) -> None:
    """Skin under the outer pins of a dense row goes sideways by more than half of a gap. With friction it goes with the
    pins; without they slide by more than a gap over skin that others touched.
    """
    base, condition = row_of(6, 1.7, 1.44, [0.6] * 6, edge_radius=0.186)
    found = condense_section(mesh_device(base), base)
    pressed = indent_device(base, found, None, interface)
    assert np.any(pressed.state.given != base.device.actuators.nearest(found.position[:, 0]))
    gap = reevaluated_gap(pressed.problem, pressed.state)
    assert np.abs(gap - pressed.state.gap).max() < 1e-9
    slid = stimulate(base, pressed, condition)
    before, after = pressed.state.given, slid.actuator
    touching = (pressed.state.status != 0) & (slid.status != 0)
    assert np.any((before != after)[touching]) == (interface is Interface.FRICTIONLESS)


def test_skin_that_is_considered_is_the_pads_and_mirrors() -> None:
    """Of a row that lies aside, too; the back of the finger, above the pins, is out of reach."""
    base = scene("device2")
    row = replace(base.device.actuators, positions=(-0.5, 2.0, 4.5, 7.0))
    aside = base.with_device(actuators=row)
    x, y = contact_tractions(section("device2"), aside).position.T
    assert np.sort(x) == pytest.approx(np.sort(-x), abs=1e-9)
    assert y.max() < base.model.finger.height / 2.0
