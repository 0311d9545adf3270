"""Friction that acts from first touch, or from the stimulus on: what is pressed, and what happens then."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fingerpad.benchmark.plain import plain_scores
from fingerpad.contact.force_curve import small_strain_curve
from fingerpad.contact.formulation import Status
from fingerpad.contact.linear_solution import indent_device, indented_state, stimulate
from fingerpad.contact.problem import contact_problem, pressing_problem
from fingerpad.finite.deformed_solution import pressed_finger, stimulate_deformed
from fingerpad.finite.pressing import press
from fingerpad.readouts.gabor import filtered_readouts
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import roughness_scores
from fingerpad.scene.contact_law import FrictionFrom, Interface
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.tissue_law import Kinematics
from fingerpad.tissue.mesh import nominal_mesh
from scenes import condensed, scene, section

COARSER = 3.0  # times the shipped sizes and strides
# A plain solver takes other increments, whose friction leaves another trace: scores then differ by less than this [1],
# which is far less than pressing with friction makes of them
TRACE = 0.02


def rubbing_from(base: Scene, when: FrictionFrom) -> Scene:
    return base.with_model(contact=replace(base.model.contact, friction_from=when))


@pytest.mark.parametrize("mirrored_half", [True, False])
@pytest.mark.parametrize("device", ["device2", "device3"])
def test_what_rubs_later_is_pressed_as_without_friction(device: str, mirrored_half: bool) -> None:
    """The same forces to the last bit; what touches sticks. Its curve of force is that without friction, too."""
    base = rubbing_from(scene(device), FrictionFrom.STIMULUS)
    base = base.with_model(skips=replace(base.model.skips, mirrored_half=mirrored_half))
    rubbing, smooth = (contact_problem(base, *condensed(device), each) for each in Interface)
    assert pressing_problem(base, smooth) is smooth
    state, without = indented_state(base, rubbing), indented_state(base, smooth)
    assert np.array_equal(state.force, without.force)
    assert np.array_equal(state.actuator, without.actuator)
    touching = without.status != Status.OPEN
    assert touching.any()
    assert np.all(state.status[touching] == Status.STICK)
    assert np.all(state.status[~touching] == Status.OPEN)
    assert np.array_equal(small_strain_curve(base, rubbing), small_strain_curve(base, smooth))


def test_friction_from_first_touch_leaves_shear_that_pressing_without_does_not() -> None:
    """Both ways the stimulus then ends with shear, within Coulomb's limit, and scores differ."""
    found, (given, _) = dict[FrictionFrom, float](), condensed("device2")
    for when in FrictionFrom:
        base = rubbing_from(scene("device2"), when)
        pressed = indent_device(base, given, None, Interface.SHEAR)
        assert np.any(pressed.state.force[:, 0]) == (when is FrictionFrom.TOUCH)
        solution = stimulate(base, pressed, base.device.conditions[-1])
        assert np.any(solution.force[-1, :, 0])
        read = filtered_readouts(
            resampling_to_grid(given.arc, base.model.gabor.spacing), solution.reading.readouts, base.model.gabor
        )
        found[when] = roughness_scores(base, read)[Readout.CHANGE_OF_STRAIN]
    assert abs(found[FrictionFrom.STIMULUS] / found[FrictionFrom.TOUCH] - 1.0) > TRACE


def test_a_plain_solver_switches_friction_at_the_same_time() -> None:
    base = rubbing_from(scene("device2"), FrictionFrom.STIMULUS)
    given, condition = condensed("device2")[0], base.device.conditions[-1]
    pressed = indent_device(base, given, None, Interface.SHEAR)
    height = float(pressed.state.actuator[0, 1])
    rows = plain_scores(base, section("device2"), condition, height, (2, 2))
    own = stimulate(base, pressed, condition)
    read = filtered_readouts(
        resampling_to_grid(given.arc, base.model.gabor.spacing), own.reading.readouts, base.model.gabor
    )
    scores = roughness_scores(base, read)
    for row in rows:
        assert row["score"] == pytest.approx(scores[Readout(row["readout"])], rel=TRACE)


def test_deformed_tissue_is_pressed_as_without_friction_and_then_rubs() -> None:
    """With finite strain, where the normal turns only if friction acts from first touch."""
    base = scene("device2").coarsened(COARSER).with_kinematics(Kinematics.FINITE)
    base = rubbing_from(base, FrictionFrom.STIMULUS)
    mesh = nominal_mesh(base)
    rubbing, smooth = (press(base, mesh, None, each) for each in Interface)
    assert np.array_equal(rubbing.state.force, smooth.state.force)
    assert np.array_equal(rubbing.displacement, smooth.displacement)
    touching = smooth.state.status != Status.OPEN
    assert np.all(rubbing.state.status[touching] == Status.STICK)
    finger = pressed_finger(base, mesh, None, rubbing, Interface.SHEAR)
    assert not finger.problem.turning
    solution = stimulate_deformed(base, finger, base.device.conditions[-1])
    shear, pressing = np.abs(solution.force[-1, :, 0]), solution.force[-1, :, 1]
    assert shear.max() > 0.1 * base.model.contact.friction * pressing.max()  # not rounding
