"""Corrections of stimuli on deformed tissue without friction, where the finger all but sways freely."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import fingerpad.finite.deformed
import fingerpad.finite.deformed_path
import fingerpad.finite.deformed_solution
import fingerpad.finite.pressing
from fingerpad.contact.advice import left_out
from fingerpad.contact.certificate import Certificate, certify
from fingerpad.contact.formulation import ContactProblem, ContactState, rest
from fingerpad.contact.path import advance
from fingerpad.errors import ContactError, CrossingError, DepthError, InvertedError, ReachError, SnapError
from fingerpad.finite.deformation import Elements, internal_force
from fingerpad.finite.deformed import Passed, Tangent, _followed, deformed_state, is_far, solver_on
from fingerpad.finite.deformed_path import HALVINGS, STEPS_BACK, DeformedTissue, Equilibrium, move
from fingerpad.finite.deformed_solution import (
    PressedFinger,
    certified_equilibria,
    equilibria,
    press_finger,
    receptor_logarithmic_strain,
    stimulate_deformed,
)
from fingerpad.finite.pressing import press
from fingerpad.scene.contact_law import Interface
from fingerpad.scene.device import ActuatorRow, Condition
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.compliance import CondensedSection, displaced
from fingerpad.tissue.mesh import nominal_mesh
from scenes import scene

COARSER = 3.0  # times the shipped sizes and strides
RISEN = np.array([0.0, 0.01])  # mm


@pytest.fixture(scope="module")
def base() -> Scene:
    return scene("device1").coarsened(COARSER).with_kinematics(Kinematics.FINITE)


@pytest.fixture(scope="module")
def finger(base: Scene) -> PressedFinger:
    section = nominal_mesh(base)
    return press_finger(base, section, None, Interface.FRICTIONLESS)


def test_corrections_end_where_new_tangents_do(finger: PressedFinger) -> None:
    """Both ends are in equilibrium: they differ by what corrections leave."""
    up = 0.02 * np.array([1.0, 1.0, -1.0, -1.0])
    target = finger.start.state.actuator + np.stack([np.zeros(4), up], axis=1)
    corrected, _ = move(finger.tissue, finger.problem, finger.start, target, 4)
    assert corrected.tangents == 0
    part = finger.tissue.part
    begin = deformed_state(finger.start.state, finger.start.displacement)
    followed, _ = advance(finger.problem, begin, target, 1, None, solver_on(part, 1))
    way = np.abs(followed.displacement - finger.start.displacement).max()
    # a step that changes less than 1e-3 of the way is the last one, and leaves less (measured: 7e-5)
    assert np.abs(corrected.displacement - followed.displacement).max() < 1e-3 * way


@pytest.mark.parametrize("times", [1, STEPS_BACK])
def test_corrections_that_overshoot_into_inverted_tissue_step_back(
    finger: PressedFinger, monkeypatch: pytest.MonkeyPatch, times: int
) -> None:
    """They end where others do, without new tangents; the first displacement that is refused is that of the move."""
    target = finger.start.state.actuator + 0.02 * np.array([[0.0, 1.0], [0.0, 1.0], [0.0, -1.0], [0.0, -1.0]])
    plain, _ = move(finger.tissue, finger.problem, finger.start, target, 4)
    tried = list[np.ndarray]()

    def refused_at_first(elements: Elements, displacement: np.ndarray) -> np.ndarray:
        tried.append(displacement - finger.start.displacement)
        if len(tried) <= times:
            raise InvertedError("refused")
        return internal_force(elements, displacement)

    monkeypatch.setattr(fingerpad.finite.deformed_path, "internal_force", refused_at_first)
    reached, _ = move(finger.tissue, finger.problem, finger.start, target, 4)
    assert np.allclose(tried[times], tried[0] / 2.0**times, rtol=0.0, atol=1e-12)
    assert reached.tangents == plain.tangents == 0
    # corrections of a move end within 1e-3 of it (measured: 2.4e-4 and 1.2e-4)
    way = np.abs(plain.displacement - finger.start.displacement).max()
    assert np.abs(reached.displacement - plain.displacement).max() < 1e-3 * way


def test_corrections_that_stay_in_inverted_tissue_are_made_again_with_new_tangents(
    finger: PressedFinger, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fingerpad.finite.deformed_path, "internal_force", refusing(InvertedError))
    reached, _ = move(finger.tissue, finger.problem, finger.start, finger.start.state.actuator + RISEN, 4)
    assert reached.tangents > 0


@pytest.mark.parametrize("halvings", range(1, HALVINGS + 1))
def test_moves_with_a_correction_that_overshoots_are_made_in_parts(
    finger: PressedFinger, monkeypatch: pytest.MonkeyPatch, halvings: int
) -> None:
    """As many as are wanted; they end where the whole move does."""
    way = 0.02 * np.array([[0.0, 1.0], [0.0, 1.0], [0.0, -1.0], [0.0, -1.0]])
    target = finger.start.state.actuator + way
    plain, _ = move(finger.tissue, finger.problem, finger.start, target, 4)
    settled, made = fingerpad.finite.deformed_path._corrected, list[float]()

    def overshooting(tissue: DeformedTissue, problem: ContactProblem, start: Equilibrium, *others: Any) -> Equilibrium:
        part = np.abs(others[0] - start.state.actuator).max() / np.abs(way).max()
        if part > 1.01 / 2**halvings:
            raise InvertedError("refused")
        reached = settled(tissue, problem, start, *others)
        made.append(part)
        return reached

    monkeypatch.setattr(fingerpad.finite.deformed_path, "_corrected", overshooting)
    monkeypatch.setattr(fingerpad.finite.deformed_path, "_followed_newly", refusing(ContactError))
    reached, _ = move(finger.tissue, finger.problem, finger.start, target, 4)
    assert made == pytest.approx([1.0 / 2**halvings] * 2**halvings)
    # corrections of a move end within 1e-3 of it
    whole = np.abs(plain.displacement - finger.start.displacement).max()
    assert np.abs(reached.displacement - plain.displacement).max() < 1e-3 * whole


def refusing(kind: type[ContactError]) -> Callable[..., None]:
    """A check that never passes."""

    def refuse(*_: object) -> None:
        raise kind("refused")

    return refuse


@pytest.mark.parametrize(
    ("check", "kind"),
    [("require_uncrossed", CrossingError), ("require_stable", SnapError), ("require_within_reach", ReachError)],
)
def test_pressing_is_refused_by_its_checks(
    base: Scene, monkeypatch: pytest.MonkeyPatch, check: str, kind: type[ContactError]
) -> None:
    """Each is asked, and what it raises is told with device and interface."""
    section = nominal_mesh(base)
    monkeypatch.setattr(fingerpad.finite.pressing, check, refusing(kind))
    with pytest.raises(kind, match="device=device1, interface=frictionless, pre-indentation: refused"):
        press(base, section, None, Interface.FRICTIONLESS)


def test_the_pressed_state_is_in_equilibrium_as_far_as_it_says(finger: PressedFinger) -> None:
    """What its tangent would still move, over the load, is no more than the residual that certificates tell."""
    pressed, tissue = finger.pressed, finger.tissue
    elements = tissue.part.elements
    left = tissue.part.loads @ pressed.state.force.ravel()
    left -= internal_force(elements, tissue.displacement)[elements.free]
    step = tissue.factors.solve(left)
    assert 0.0 < np.abs(step).max() / pressed.state.actuator[0, 1] <= pressed.section.residual


def test_what_corrections_left_is_told_by_certificates(base: Scene, finger: PressedFinger) -> None:
    """As the residual of equilibrium; what a move began with stays in it."""
    found, certificate = certified_equilibria(base, finger, base.device.condition("low_000"))
    assert 0.0 < found[-1].defect <= certificate.equilibrium
    rough = replace(finger.start, defect=0.5)
    reached, _ = move(finger.tissue, finger.problem, rough, finger.start.state.actuator + RISEN, 4)
    assert reached.defect == rough.defect


def test_tissue_that_jumps_is_not_pressed_further(base: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fingerpad.finite.deformed, "is_far", lambda *_: True)
    with pytest.raises(SnapError):
        press(base, nominal_mesh(base), None, Interface.FRICTIONLESS)


@pytest.mark.parametrize(
    ("moved", "length", "load", "jumped"),
    [(3.1, 1.0, 2.0, False), (6.2, 1.0, 2.0, True), (0.0005, 0.0, 1.0, False), (0.002, 0.0, 1.0, True)],
)
def test_tissue_jumps_where_it_goes_much_farther_than_actuators(
    moved: float, length: float, load: float, jumped: bool
) -> None:
    """Tissue that was followed went 3.1 times as far before it snapped; twice that is a jump. Where actuators stand it
    may move by a thousandth of the load, as corrections do.
    """
    assert is_far(moved, length, load) is jumped


def test_on_the_way_skin_drifts_along_the_parabola_through_what_was_before(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where it would be without forces, here on tissue that does not yield: through its places one increment of contact
    ago, at the start and at the end, but for rounding of numbers of about one.
    """
    problem = ContactProblem(
        position=np.array([[0.0, 0.0], [1.0, 0.0]]),
        compliance=np.eye(4),
        row=ActuatorRow((0.5,), 3.0, 0.0),
        body=None,
        friction=0.5,
        tolerance=1e-9,
        max_cuts=5,
    )

    def drifted(way: float) -> np.ndarray:
        return np.array([[0.1, 0.2], [0.3, 0.4]]) * way + np.array([[0.4, 0.3], [-0.2, 0.1]]) * way**2

    found = list[np.ndarray]()

    def solve(problem: ContactProblem, state: ContactState, actuator: np.ndarray, patch: None) -> Any:
        found.append(problem.free)
        return state, patch

    monkeypatch.setattr(fingerpad.finite.deformed, "solve_increment", solve)
    begin, still = deformed_state(rest(problem, 0.0), np.zeros(4)), np.zeros((2, 2))
    begin = replace(begin, passed=Passed(0.5, drifted(-0.5), still))
    tangent, up = Tangent(None, np.zeros((4, 4)), 0.0), np.array([[0.0, 1.0]])
    _followed(4, problem, tangent, begin, begin.actuator + up, drifted(0.0), drifted(1.0))
    assert np.array(found) == pytest.approx(np.array([drifted(way) for way in (0.25, 0.5, 0.75, 1.0)]), abs=1e-14)


def test_a_correction_that_jumps_is_made_again_with_new_tangents(
    finger: PressedFinger, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fingerpad.finite.deformed_path, "is_far", lambda *_: True)
    reached, _ = move(finger.tissue, finger.problem, finger.start, finger.start.state.actuator + RISEN, 4)
    assert reached.tangents > 0


def tap(*heights: float) -> Condition:
    """All four pins up to some heights [mm] above those of pre-indentation, one after the other."""
    normal = np.array(heights)[:, None] * np.ones(4)
    return Condition("tap", "test", 0.0, np.arange(1.0, len(heights) + 1.0), normal, np.zeros_like(normal))


def test_every_equilibrium_of_a_stimulus_is_certified(
    base: Scene, finger: PressedFinger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The pressed one, those on the way, and the last one."""
    heights = list[float]()

    def noting(problem: ContactProblem, section: CondensedSection, state: ContactState) -> Certificate:
        heights.append(float(state.actuator[0, 1] - finger.start.state.actuator[0, 1]))
        return certify(problem, section, state)

    monkeypatch.setattr(fingerpad.finite.deformed_solution, "certify", noting)
    stimulate_deformed(base, finger, tap(0.01, 0.02, 0.0))
    assert heights == pytest.approx([0.0, 0.01, 0.02, 0.0])


def test_a_stimulus_asks_whether_skin_crosses_itself(
    base: Scene, finger: PressedFinger, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fingerpad.finite.deformed_solution, "require_uncrossed", refusing(CrossingError))
    with pytest.raises(CrossingError, match="device=device1, condition=low_000, interface=frictionless: refused"):
        stimulate_deformed(base, finger, base.device.condition("low_000"))


def test_a_stimulus_through_deformed_tissue_is_refused(base: Scene, finger: PressedFinger) -> None:
    """Before it is followed, though it comes back: no path leads there."""
    with pytest.raises(DepthError, match=r"condition=tap, interface=frictionless: .* mm deep, into 5 mm of tissue"):
        stimulate_deformed(base, finger, tap(0.0, 5.0, 0.0))


def test_finite_receptors_read_logarithmic_strain(base: Scene, finger: PressedFinger) -> None:
    """Stretched by exp(0.3) along x and then turned by 2 rad, tissue is strained by 0.3, but for rounding; its linear
    strain is 0.35 without the turn, and -1.56 with it.
    """
    place = nominal_mesh(base).mesh.doflocs
    rotation = np.array([[np.cos(2.0), -np.sin(2.0)], [np.sin(2.0), np.cos(2.0)]])
    displacement = np.zeros(finger.dofs.size)
    displacement[finger.dofs] = rotation @ np.diag([np.exp(0.3), 1.0]) @ place - place
    found = receptor_logarithmic_strain(finger.gradient, displacement).reshape(-1, 3)
    assert np.abs(found - [0.3, 0.0, 0.0]).max() < 1e-12


def test_what_is_read_of_deformed_tissue_is_its_largest_logarithmic_strain(base: Scene, finger: PressedFinger) -> None:
    """From the largest stretch, sqrt of the eigenvalue of F^T F, of the state that the stimulus ends in."""
    condition = base.device.condition("low_000")
    displacement = equilibria(base, finger, condition)[-1].displacement
    gradient = np.eye(2) + (finger.gradient @ displacement).reshape(-1, 2, 2)
    squares = np.linalg.eigvalsh(gradient.transpose(0, 2, 1) @ gradient)[:, -1]
    expected = np.maximum(np.log(squares) / 2.0, 0.0)
    assert expected.max() > 0.05  # where a stretch is another strain by more than a thousandth
    found = stimulate_deformed(base, finger, condition).reading.strain
    assert np.abs(found - expected).max() < 1e-12


@pytest.mark.parametrize("interface", list(Interface))
def test_what_cannot_be_solved_says_what_a_file_may_leave_out(base: Scene, interface: Interface) -> None:
    for given in (base, base.with_kinematics(Kinematics.SMALL)):
        said = left_out(given, interface)
        assert ("`kinematics: {value: small, ...}`" in said) is (given.kinematics is Kinematics.FINITE)
        assert ("`interfaces: {value: shear, ...}`" in said) is (interface is Interface.FRICTIONLESS)


def test_a_stroke_that_cannot_be_followed_says_how_the_rest_goes_on(base: Scene, finger: PressedFinger) -> None:
    far = np.full((1, 4), 0.9)
    stroke = Condition("far", "test", 0.0, np.array([1.0]), np.zeros_like(far), far)
    with pytest.raises(ContactError, match=r"condition=far.*`kinematics: \{value: small, \.\.\.\}` in the device file"):
        stimulate_deformed(base, finger, stroke)


@pytest.mark.parametrize("interface", list(Interface))
def test_moves_far_from_the_pressed_state_run_on_tissue_linearised_there(base: Scene, interface: Interface) -> None:
    """They end where new tangents lead from move to move, which are more."""
    section = nominal_mesh(base)
    finger = press_finger(base, section, None, interface)
    way = 0.03 * np.array([[1.0, 1.0], [-1.0, 1.0], [1.0, 1.0], [-1.0, 1.0]])  # to the sides, and into the skin [mm]
    reached, tissue = finger.start, finger.tissue
    followed = deformed_state(finger.start.state, finger.start.displacement)
    part, tangent = finger.tissue.part, None
    for number in range(1, 5):
        target = finger.start.state.actuator + number * way
        reached, tissue = move(tissue, finger.problem, reached, target, 4)
        followed, tangent = advance(finger.problem, followed, target, 1, tangent, solver_on(part, 4))
    assert tissue is not finger.tissue
    assert 0 < reached.tangents < followed.tangents
    far = np.abs(followed.displacement - finger.start.displacement).max()
    # corrections of each move end within 1e-3 of it (measured: 1.8e-4 and 2.4e-4 of all the way)
    assert np.abs(reached.displacement - followed.displacement).max() < 1e-3 * far
    # and certificates, on the tangent of the pressed state, find the skin where it is
    found = reached.free + displaced(finger.problem.compliance, reached.state.force)
    moved = (part.loads.T @ reached.displacement[part.elements.free]).reshape(-1, 2)
    assert np.abs(found - moved).max() < 1e-3 * far
