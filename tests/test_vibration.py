"""Vibration on tissue that creeps, against the frequency domain, the correspondence principle and slow paths."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from skfem import MeshTri, MeshTri2
from threadpoolctl import threadpool_info, threadpool_limits

import fingerpad.vibration.cycling
from fingerpad.contact.certificate import certify
from fingerpad.contact.formulation import OPEN, ContactState
from fingerpad.contact.linear_solution import Indented, indent_device
from fingerpad.contact.path import follow
from fingerpad.errors import CondensationError, CycleError, DepthError, InertiaError, ReachError, SceneError
from fingerpad.prediction.edges import mesh_device
from fingerpad.prediction.scoring import condense_mesh
from fingerpad.readouts.roughness import scene_span
from fingerpad.readouts.strain import maximum_principal
from fingerpad.scene.contact_law import Criterion, Interface
from fingerpad.scene.device import ActuatorRow, Cycle
from fingerpad.scene.readout import Readout
from fingerpad.scene.scene import Scene
from fingerpad.scene.vibration_rule import Relaxation
from fingerpad.tissue.compliance import CondensedSection
from fingerpad.tissue.condensation import condense_section
from fingerpad.tissue.elasticity import mass, mesh_dofs
from fingerpad.tissue.mesh import SectionMesh
from fingerpad.vibration.creep import IN_BAND, Creep, answer, condense_creep, creep_times, stiffened
from fingerpad.vibration.cycling import MAX_CYCLES, Moment, Vibration, displacement, vibrate
from fingerpad.vibration.forecast import steps as steps_of
from fingerpad.vibration.forecast import vibration_forecast
from fingerpad.vibration.frequency import (
    _require_no_inertia,
    certified_vibration,
    cyclic_readouts,
    frequency_rows,
    vibration_rows,
    without_caveats,
)
from fingerpad.vibration.frequency_variants import _relaxation_variants, relaxation_rows
from fingerpad.vibration.inertia import condense_vibrating, inertia_effect, slipping, stuck
from fingerpad.vibration.speed import SLOWLY
from fingerpad.vibration.viscoelasticity import retardation_times, stiffening
from scenes import scene

COARSER = 3.0  # times the shipped sizes: physics holds on any mesh
SMALL = 1e-6  # mm: too little for contact to change
DEEP = ("dermis", "subcutaneous_tissue")  # layers under the stiff shell
BOTH = [Interface.SHEAR, Interface.FRICTIONLESS]


@cache
def coarse(device: str = "device2", layers: tuple[str, ...] | None = None, sharp: bool = False) -> Scene:
    """A shipped scene on a coarse mesh; other layers that relax, or sharp edges, on request."""
    base = scene(device).coarsened(COARSER)
    relaxation = base.model.vibration.relaxation
    vibration = replace(base.model.vibration, relaxation=replace(relaxation, layers=layers or relaxation.layers))
    row = base.device.actuators
    actuators = ActuatorRow(row.positions, row.width, 0.0) if sharp else row
    return base.with_device(actuators=actuators).with_model(vibration=vibration)


def with_relaxation(relaxation: Relaxation) -> Scene:
    """Device 2's coarse scene with sharp edges and tissue that relaxes like that."""
    given = coarse(sharp=True)
    return given.with_model(vibration=replace(given.model.vibration, relaxation=relaxation))


def every_layer() -> tuple[str, ...]:
    """All layers, nail and nail bed included."""
    finger = scene("device2").model.finger
    return tuple(layer.name for layer in finger.layers)


@cache
def mesh(given: tuple[str, bool]) -> SectionMesh:
    """The mesh of a coarse scene."""
    return mesh_device(coarse(given[0], sharp=given[1]))


@cache
def creeping(layers: tuple[str, ...] | None = None, sharp: bool = False) -> Creep:
    """The creep of Device 2's coarse scene."""
    return condense_creep(mesh(("device2", sharp)), coarse("device2", layers, sharp))


@cache
def pressed(interface: Interface, sharp: bool = False) -> Indented:
    """Device 2 pressed onto the coarse finger."""
    section = condense_section(mesh(("device2", sharp)), coarse(sharp=sharp))
    return indent_device(coarse(sharp=sharp), section, None, interface)


def vibration(
    interface: Interface,
    cycle: Cycle,
    frequency: float,
    layers: tuple[str, ...] | None = None,
    steps: int = 16,
    sharp: bool = False,
) -> Vibration:
    """Device 2 vibrating on the coarse finger."""
    return vibrate(pressed(interface, sharp), creeping(layers, sharp), cycle, frequency, steps)


def normal(amplitude: float, signs: tuple[float, ...] = (1.0, -1.0, 1.0, -1.0)) -> Cycle:
    """Actuators that move normally."""
    moved = amplitude * np.array(signs, dtype=complex)
    return Cycle("normal", "alternate", 180.0, moved, np.zeros(4, dtype=complex))


def test_material_is_stiffer_at_once_by_what_relaxes() -> None:
    relaxation = Relaxation((0.3, 0.2), (0.01, 1.0), ("dermis",))
    assert stiffening(relaxation, 0.0) == 1.0
    assert stiffening(relaxation, np.inf) == pytest.approx(1.0 / 0.5)
    # storage modulus over g: (g + sum g_i w^2 t^2 / (1 + w^2 t^2)) / g, loss sum g_i w t / (1 + w^2 t^2) / g
    speed, shares, times = 7.0, np.array([0.3, 0.2]), np.array([0.01, 1.0])
    storage = 1.0 + np.sum(shares * (speed * times) ** 2 / (1.0 + (speed * times) ** 2)) / 0.5
    loss = np.sum(shares * speed * times / (1.0 + (speed * times) ** 2)) / 0.5
    assert stiffening(relaxation, 1j * speed) == pytest.approx(storage + 1j * loss)


def test_layers_that_relax_are_stiffened_to_their_storage_modulus() -> None:
    """What they lose does not stiffen them; the others stay as they are."""
    given = coarse()
    relaxation, speed = given.model.vibration.relaxation, 2.0 * np.pi * 40.0
    shares, squares = np.array(relaxation.shares), (speed * np.array(relaxation.times)) ** 2
    storage = 1.0 + np.sum(shares * squares / (1.0 + squares)) / (1.0 - shares.sum())
    stiff = stiffened(given, 1j * speed).model.finger
    for before, after in zip(given.model.finger.layers, stiff.layers, strict=True):
        factor = storage if before.name in relaxation.layers else 1.0
        assert after.material.modulus == pytest.approx(factor * before.material.modulus, rel=1e-12), before.name


def test_strain_creeps_where_stress_relaxes_to_nothing() -> None:
    relaxation = scene("device2").model.vibration.relaxation
    times = retardation_times(relaxation)
    assert np.all(times > np.sort(relaxation.times))  # creep is slower than relaxation
    for time in times:
        assert abs(stiffening(relaxation, -1.0 / time)) < 1e-9  # rounding of a sum of terms of order ten


@pytest.mark.parametrize("shares", [(0.5, 0.5), (0.3,)])
def test_relaxation_must_leave_something_and_have_a_time_for_each_share(shares: tuple[float, ...]) -> None:
    with pytest.raises(SceneError, match="shares"):
        Relaxation(shares, (0.1, 1.0), ("dermis",))


def test_tissue_that_relaxes_as_one_creeps_as_one() -> None:
    # correspondence principle: C(s) = C / phi(s), as all moduli are in proportion. The times on which maps are founded
    # include the exact ones, so that only rounding of their inversion is left
    given = coarse("device2", every_layer(), sharp=True)
    creep, relaxed = creeping(every_layer(), sharp=True), condense_section(mesh(("device2", True)), given)
    times = creep_times(given.model.vibration.relaxation, IN_BAND)
    for rate in (0.5, 30.0, 2e3):
        found = relaxed.compliance - np.tensordot(1.0 - answer_at(times, rate), creep.compliance, 1)
        exact = relaxed.compliance / stiffening(given.model.vibration.relaxation, rate)
        assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()


def answer_at(times: np.ndarray, rate: float) -> np.ndarray:
    """1 / (1 + s t) of each term."""
    return np.array([answer(np.array([rate]), time)[0] for time in times])


@pytest.mark.parametrize(
    ("shares", "times"), [((0.24, 0.24, 0.24), (0.004, 0.07, 1.4)), ((0.9,), (0.1,)), ((0.72,), (0.004,))]
)
def test_maps_hold_at_rates_they_were_not_found_from(shares: tuple[float, ...], times: tuple[float, ...]) -> None:
    """Also where much relaxes at once, which takes more times."""
    given, section = with_relaxation(Relaxation(shares, times, DEEP)), mesh(("device2", True))
    creep, relaxed = condense_creep(section, given), condense_section(section, given)
    assert creep.time.size > IN_BAND * len(times) or len(times) == 3
    for rate in (0.2, 3.0, 9.0, 30.0, 77.0, 900.0):
        exact = condense_section(section, stiffened(given, rate))
        left = 1.0 - answer_at(creep.time, rate)
        for name in ("compliance", "strain"):
            found = getattr(relaxed, name) - np.tensordot(left, getattr(creep, name), 1)
            assert np.abs(found - getattr(exact, name)).max() < 1e-3 * np.abs(getattr(exact, name)).max()  # their limit


@pytest.mark.parametrize("frequency", [0.2, 5.0, 80.0])
def test_small_vibration_is_that_of_the_frequency_domain(frequency: float) -> None:
    # flat faces and no friction: nodes in contact move by a normally and bear no shear, so that f = C_yy(i w)^-1 a, and
    # the time domain must come to Re(E f exp(i w t)), but for steps linear in force: (w h)^2 / 12 = 0.3 % of 32, of
    # what creeps, which is no more than 12 % of strain here: 4e-4 (measured: 1.2e-4)
    indented, steps = pressed(Interface.FRICTIONLESS, sharp=True), 32
    found = vibration(Interface.FRICTIONLESS, normal(SMALL), frequency, DEEP, steps, sharp=True)
    relaxed = condense_section(mesh(("device2", True)), coarse(sharp=True))
    creep = creeping(DEEP, sharp=True)
    left = 1.0 - 1.0 / (1.0 + 2j * np.pi * frequency * creep.time)
    compliance = relaxed.compliance - np.tensordot(left, creep.compliance, 1)
    strain = relaxed.strain - np.tensordot(left, creep.strain, 1)
    touching = np.flatnonzero(indented.state.status > 0)
    unknowns = 2 * touching + 1
    moved = normal(SMALL).normal[indented.problem.actuator_of[touching]]
    force = np.linalg.solve(compliance[np.ix_(unknowns, unknowns)], moved)
    expected = (strain[:, unknowns] @ force).real
    got = found.strain[-1] - found.strain.mean(axis=0)
    assert np.linalg.norm(got - expected) < 5e-4 * np.linalg.norm(expected)


def test_strain_does_not_know_the_frequency_where_all_tissue_relaxes_as_one() -> None:
    # displacement control, nothing opens or slips: forces grow by phi, and strain is that of the displacement
    slow, fast = (
        vibration(Interface.FRICTIONLESS, normal(SMALL), frequency, every_layer(), sharp=True)
        for frequency in (0.0, 150.0)
    )
    ranges = [np.ptp(each.strain, axis=0) for each in (slow, fast)]
    # a millionth at most opens at edges (measured: 6e-9)
    assert np.linalg.norm(ranges[1] - ranges[0]) < 1e-6 * np.linalg.norm(ranges[0])
    forces = [np.ptp([state.force[:, 1] for state in each.states], axis=0) for each in (slow, fast)]
    stiffer = np.linalg.norm(forces[1]) / np.linalg.norm(forces[0])
    expected = abs(stiffening(coarse().model.vibration.relaxation, 2j * np.pi * 150.0))
    assert stiffer == pytest.approx(expected, rel=0.03)  # 16 samples of a sinusoid miss its range by up to 2 %


def ends_of_cycles(indented: Indented, cycle: Cycle) -> Iterator[np.ndarray]:
    """Forces (n, 2) [N/mm] at the end of each cycle of 16 steps on relaxed tissue, the first of which grows evenly."""
    state = indented.state
    for number in range(16 * MAX_CYCLES):
        growth = (number + 1) / 16 if number < 16 else 1.0
        phase = 2.0 * np.pi * (number % 16 + 1) / 16
        target = indented.state.actuator + growth * displacement(cycle, phase)
        state = follow(indented.problem, state, target, 1)
        if number % 16 == 15:
            yield state.force


@pytest.mark.parametrize("interface", BOTH)
def test_slow_cycles_are_a_path_on_relaxed_tissue(interface: Interface) -> None:
    """One of its cycles ends as the one that repeats itself."""
    cycle = coarse().device.cycles[2]
    last = vibration(interface, cycle, SLOWLY).states[-1].force
    # one carries its patch from step to step and one does not: apart by ten tolerances of the contact solver a step at
    # most, as slips add up over the cycles (23 with friction)
    off = (np.abs(force - last).max() / np.abs(last).max() for force in ends_of_cycles(pressed(interface), cycle))
    assert any(each < 1e-8 * 16 * cycles for cycles, each in enumerate(off, 1))


def test_read_out_does_not_know_the_number_of_steps() -> None:
    scores = []
    for steps in (16, 48):
        found = vibration(Interface.SHEAR, coarse().device.cycles[2], 80.0, steps=steps)
        scores.append(cyclic_readouts(found.strain)[Readout.CHANGE_OF_STRAIN])
    # a tenth of what scores state on this mesh, four times as large as the shipped one's 0.5 %
    assert np.linalg.norm(scores[1] - scores[0]) < 0.01 * np.linalg.norm(scores[1])


def test_every_state_of_the_last_cycle_is_certified() -> None:
    """Pins that swing to where no skin was considered have no scores, though they are read at rest in the middle."""
    still = np.zeros(4, dtype=complex)
    far = Cycle("far", "test", 0.0, still, np.full(4, 1.4j))
    with pytest.raises(ReachError, match=r"condition=far, interface=frictionless, slow"):
        certified_vibration(coarse(), creeping(), pressed(Interface.FRICTIONLESS), far, SLOWLY)


def test_a_vibration_through_the_tissue_is_refused() -> None:
    """Its highest place counts, not where it is read."""
    late = replace(normal(5.0), normal=1j * normal(5.0).normal)
    for cycle in (normal(5.0), late):
        with pytest.raises(DepthError, match=r"condition=normal, .*, slow: .* mm deep, into 5 mm of tissue"):
            certified_vibration(coarse(), creeping(), pressed(Interface.FRICTIONLESS), cycle, SLOWLY)


def test_a_cycle_whose_mean_still_moves_has_not_repeated_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """Though its end does, from the first one on: the change is that from the mean. Here it moves in five cycles."""
    cycles = list[int]()

    def strain(section: CondensedSection, creep: Creep, before: ContactState, moments: list[Moment]) -> np.ndarray:
        cycles.append(len(moments))
        return np.array([[max(5.0 - len(cycles), 0.0)]] * (len(moments) - 1) + [[1.0]])

    monkeypatch.setattr(fingerpad.vibration.cycling, "_strain", strain)
    vibration(Interface.FRICTIONLESS, normal(0.0), SLOWLY, steps=4)
    assert cycles == [4] * 6


def test_cycles_that_do_not_repeat_say_what_helps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two cycles are too few for any: nothing can have been repeated. Without friction none walks on."""
    monkeypatch.setattr(fingerpad.vibration.cycling, "MAX_CYCLES", 2)
    with pytest.raises(CycleError, match=r"no periodic state after 2 cycles at 80 Hz: .*; try a smaller amplitude"):
        vibration(Interface.SHEAR, coarse().device.cycles[2], 80.0)
    with pytest.raises(
        CycleError, match=r"no periodic state after 2 cycles without creep: friction ratchets the skin; try"
    ):
        vibration(Interface.SHEAR, coarse().device.cycles[2], SLOWLY)
    with pytest.raises(CycleError, match=r"no periodic state after 2 cycles at 80 Hz: tissue still creeps$"):
        vibration(Interface.FRICTIONLESS, coarse().device.cycles[2], 80.0)


@pytest.mark.parametrize("interface", BOTH)
@pytest.mark.parametrize(("steps", "lag"), [(15, 0.0), (24, 7.5)])
def test_tissue_creeps_on_where_actuators_stand(interface: Interface, steps: int, lag: float) -> None:
    """Steps from one side of a peak to the other move no actuator, but what crept before goes on: nothing overlaps."""
    moved = np.full(4, 0.02 * np.exp(1j * np.radians(lag)))
    found = vibration(interface, Cycle("lateral", "test", lag, np.zeros(4, dtype=complex), moved), 80.0, steps=steps)
    standing = [
        np.array_equal(one.actuator, other.actuator) for one, other in zip(found.states, found.states[1:], strict=False)
    ]
    assert any(standing)
    section = condense_section(mesh(("device2", False)), coarse())
    for problem, state in zip(found.problems, found.states, strict=True):
        assert certify(problem, section, state).penetration < 1e-8  # ten tolerances of the contact solver


def test_mass_is_density_times_area() -> None:
    section = mesh(("device2", False))
    matrix = mass(section.mesh, None, 2.0)
    both = np.ones(matrix.shape[0])  # every node moves by 1 in x and in y
    finger = scene("device2").model.finger
    soft = np.pi / 4.0 * (finger.width * finger.height - finger.bone_width * finger.bone_height)
    assert both @ matrix @ both / 2.0 == pytest.approx(2.0 * soft, rel=1e-7)  # parabolas for arcs: 6e-9 (measured)


def test_mass_is_exact_of_motion_that_elements_can_follow() -> None:
    """On a square of 1 mm that moves by x^2 it is the density times the integral of x^4, but for rounding."""
    square = MeshTri2.from_mesh(MeshTri.init_symmetric())
    moved = np.zeros(2 * square.doflocs.shape[1])
    moved[mesh_dofs(square)[0]] = square.doflocs[0] ** 2
    assert moved @ mass(square, None, 3.0) @ moved == pytest.approx(3.0 / 5.0, rel=1e-12)


def test_inertia_grows_with_the_square_of_frequency_and_is_nothing_without_mass() -> None:
    given, section = coarse(), mesh(("device2", False))
    cycle, indented = given.device.cycles[0], pressed(Interface.SHEAR)
    vibration = replace(given.model.vibration, density=1e-24)
    lightest = given.with_model(vibration=vibration)
    effects = []
    for frequency in (40.0, 80.0):
        at, light = (condense_vibrating(section, each, frequency) for each in (given, lightest))
        assert inertia_effect(given, stuck(indented, cycle), light.still, light.moving) < 1e-12
        effects.append(inertia_effect(given, stuck(indented, cycle), at.still, at.moving))
    # four times, more by resonance (by less than the effect itself, 5 %) and less by stiffening (8 % from 40 to 80 Hz)
    assert 0.9 < effects[1] / (4.0 * effects[0]) < 1.0


def test_mass_makes_tissue_yield_more_below_resonance() -> None:
    """K - w^2 M is softer than K as long as it is positive: no pattern of forces moves the skin less, but for rounding.
    K is that of tissue stiffened by its storage modulus."""
    given, frequency = coarse(), 80.0
    at = condense_vibrating(mesh(("device2", False)), given, frequency)
    stiff = condense_section(mesh(("device2", False)), stiffened(given, 2j * np.pi * frequency))
    scale = np.abs(stiff.compliance).max()
    assert np.abs(at.still.compliance - stiff.compliance).max() < 1e-12 * scale
    softer = np.linalg.eigvalsh(at.moving.compliance - at.still.compliance)
    assert softer.min() > -1e-10 * scale
    assert softer.max() > scale  # mass is felt


def answers(section: CondensedSection, change: np.ndarray) -> CondensedSection:
    """The section with receptors stretched along the skin by the sum of all forces across it, and strained by changes
    (m, 3) more."""
    stretched = np.tile([1.0, 0.0, 0.0], (section.arc.size, 1)) + change
    return replace(section, strain=np.outer(stretched.ravel(), np.tile([0.0, 1.0], section.weight.size)))


def test_inertia_is_the_norm_of_strain_within_the_span() -> None:
    """Of the tensor: gxy = 2 is exy = eyx = 1, as large as a stretch of sqrt(2). Beyond the span nothing counts."""
    given = coarse()
    section = condense_section(mesh(("device2", False)), given)
    driven, nothing = stuck(pressed(Interface.SHEAR), normal(0.01, (1.0,) * 4)), np.zeros((section.arc.size, 3))
    start, stop = scene_span(given)
    outermost = np.searchsorted(section.arc, [start, stop]) - [1, 0]  # the span ends between these and their neighbours
    beyond = (section.arc < section.arc[outermost[0]]) | (section.arc > section.arc[outermost[1]])
    assert beyond.any()
    assert not beyond.all()
    for change, effect in (([0.0, 0.0, 2.0], 2.0**0.5), ([0.0, 1.0, 0.0], 1.0), ([1.0, 0.0, 0.0], 1.0)):
        everywhere = answers(section, nothing + change)
        outside = answers(section, nothing + beyond[:, None] * change)
        still = answers(section, nothing)
        assert inertia_effect(given, driven, still, everywhere) == pytest.approx(effect, rel=1e-12)
        assert inertia_effect(given, driven, still, outside) == 0.0


def test_inertia_counts_in_a_span_narrower_than_a_receptors_element() -> None:
    """As much as in a wide one, where it is everywhere the same."""
    given = coarse()
    pin = replace(given.device.actuators, positions=(0.001,), width=0.002, edge_radius=0.0)
    readout = replace(given.model.readout, span_margin=0.0)
    still = replace(given.device.conditions[0], normal=np.zeros((1, 1)), tangential=np.zeros((1, 1)))
    alone = replace(given.device, actuators=pin, conditions=(still,), cycles=())
    narrow = Scene(replace(given.model, readout=readout), alone)
    section = condense_section(mesh(("device2", False)), given)
    start, stop = scene_span(narrow)
    assert not ((section.arc > start) & (section.arc < stop)).any()
    light, heavy = (answers(section, np.tile([0.0, each, 0.0], (section.arc.size, 1))) for each in (0.0, 3.0))
    driven = stuck(pressed(Interface.SHEAR), normal(0.01, (1.0,) * 4))
    assert inertia_effect(narrow, driven, light, heavy) == pytest.approx(3.0, rel=1e-12)


def test_skin_that_sticks_moves_with_its_actuators_and_open_skin_bears_nothing() -> None:
    indented, cycle = pressed(Interface.SHEAR), normal(0.01, (1.0, 2.0, 3.0, 4.0))
    driven = stuck(indented, cycle)
    closed = indented.state.status != OPEN
    moved = driven.amplitude.reshape(-1, 2)
    assert np.array_equal(moved[closed, 1], cycle.normal[indented.state.given[closed]])
    assert not moved[closed, 0].any()
    assert np.isnan(moved[~closed]).all()
    assert not driven.force.any()


def test_skin_that_never_opens_moves_with_the_faces_where_nothing_sticks() -> None:
    found = slipping(vibration(Interface.FRICTIONLESS, normal(SMALL), 80.0, sharp=True))
    own = pressed(Interface.FRICTIONLESS, sharp=True).problem.actuator_of
    held = np.flatnonzero(np.isfinite(found.amplitude))
    assert np.all(held % 2 == 1)  # across the faces alone
    assert np.unique(own[held // 2]).size == 4
    # ten tolerances of the contact solver
    assert np.abs(found.amplitude[held] - normal(SMALL).normal[own[held // 2]]).max() < 1e-8 * SMALL


def test_sideways_drives_feel_inertia_by_their_edges_where_nothing_sticks() -> None:
    """It grows with the square of frequency or faster, and is less than where all of the skin sticks."""
    given, cycle = coarse(), coarse().device.cycles[0]
    effects = []
    for frequency in (75.0, 150.0):
        at = condense_vibrating(mesh(("device2", False)), given, frequency)
        slips = slipping(vibration(Interface.FRICTIONLESS, cycle, frequency))
        effects.append(inertia_effect(given, slips, at.still, at.moving))
        assert inertia_effect(given, slips, at.still, at.still) == 0.0
        sticks = stuck(pressed(Interface.SHEAR), cycle)
        assert 0.0 < effects[-1] < inertia_effect(given, sticks, at.still, at.moving)
    assert effects[1] > 3.0 * effects[0]  # four times, less by stiffening


def test_skin_that_opens_and_closes_bears_the_forces_that_it_does_in_the_cycle() -> None:
    """Their first harmonics, which strain the receptors besides."""
    vibrating = vibration(Interface.FRICTIONLESS, normal(0.1), 40.0)
    found = slipping(vibrating)
    opens = np.array([state.status == OPEN for state in vibrating.states])
    between = opens.any(axis=0) & ~opens.all(axis=0)
    assert between.any()
    pressing = np.array([state.force[:, 1] for state in vibrating.states])
    phases = 2.0 * np.pi * np.arange(1, len(pressing) + 1) / len(pressing)
    harmonic = 2.0 * np.mean(pressing * np.exp(-1j * phases)[:, None], axis=0)
    assert np.abs(harmonic[between]).min() > 0.0
    assert np.allclose(found.force[1::2][between], harmonic[between], rtol=1e-12, atol=0.0)
    at = condense_vibrating(mesh(("device2", False)), coarse(), 40.0)
    whole, part = (
        inertia_effect(coarse(), each, at.still, at.moving) for each in (found, replace(found, force=0.0 * found.force))
    )
    assert abs(part - whole) > 1e-3 * whole


@pytest.mark.parametrize("amplitude", [0.0, 1e-13])
def test_next_to_no_vibration_comes_to_repeat_itself(amplitude: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Soon. What is left is rounding, which never repeats itself."""
    monkeypatch.setattr(fingerpad.vibration.cycling, "MAX_CYCLES", 9)
    for interface in BOTH:
        vibration(interface, normal(amplitude), 40.0)


def test_what_rests_has_neither_score_nor_inertia() -> None:
    """Of rounding a share as large as any would be inertia's."""
    given = coarse()
    asked = Scene(given.model, replace(given.device, frequencies=(80.0,), cycles=(normal(0.0),)))
    condensed = condense_mesh(given, mesh(("device2", False)))
    speeds = [None, condense_vibrating(mesh(("device2", False)), asked, 80.0)]
    rows = frequency_rows(asked, condensed, creeping(), speeds, Interface.FRICTIONLESS)
    assert [row["inertia"] for row in rows] == [0.0] * 4
    # a billionth of the others' 3e-3
    assert all(abs(row["score"]) < 1e-12 for row in rows if row["readout"] == Readout.CHANGE_OF_STRAIN)


@pytest.mark.parametrize("interface", BOTH)
def test_table_says_where_inertia_forbids_a_prediction(interface: Interface) -> None:
    given = coarse()
    device = replace(given.device, frequencies=(5.0,), cycles=given.device.cycles[:1])
    careful = replace(given.model, vibration=replace(given.model.vibration, inertia_limit=1e-6))
    condensed, cycle = condense_mesh(given, mesh(("device2", False))), device.cycles[0]
    if interface is Interface.SHEAR:
        driven = stuck(pressed(interface), cycle)
    else:
        driven = slipping(vibration(interface, cycle, 5.0))
    for model, predicted in ((given.model, True), (careful, False)):
        asked = Scene(model, device)
        at = condense_vibrating(mesh(("device2", False)), asked, 5.0)
        rows = frequency_rows(asked, condensed, creeping(), [None, at], interface)
        assert [row["frequency_hz"] for row in rows] == [0.0, 0.0, 5.0, 5.0]
        assert all(row["score"] > 0.0 for row in rows[:2])  # slow cycles have no inertia
        assert all((row["score"] is not None) is predicted for row in rows[2:])
        assert predicted or all("inertia" in row["note"] and "try about" in row["note"] for row in rows[2:])
        effect = inertia_effect(given, driven, at.still, at.moving)
        assert all(row["inertia"] == pytest.approx(effect, rel=1e-12) for row in rows[2:])


def test_advised_frequencies_are_written_out() -> None:
    with pytest.raises(InertiaError, match="at 150 Hz; try about 100 Hz, or less"):
        _require_no_inertia(coarse(), 150.0, 0.177)


def test_lateral_conditions_have_scores_of_their_own() -> None:
    """Stimuli are equal if both of their components are: Device 2 moves along the skin alone."""
    given = coarse()
    condensed = condense_mesh(given, mesh(("device2", False)))
    rows = frequency_rows(given, condensed, creeping(), [None], Interface.SHEAR)
    change = [row["score"] for row in rows if row["readout"] == Readout.CHANGE_OF_STRAIN]
    assert change[0] < 0.8 * change[1] < 0.8 * change[2]  # 0°, 90°, 180°: far more than a coarse mesh's errors


def test_vibrations_have_the_caveats_of_their_scene_and_of_what_is_read() -> None:
    """A receptor line too coarse for the filter, and strain that is large for small kinematics, as in a pressed finger
    whose receptors answer three times as much."""
    given = coarse()
    device = replace(given.device, cycles=given.device.cycles[:1])
    model = replace(given.model, numerics=replace(given.model.numerics, receptor_size=0.9))
    condensed = condense_mesh(given, mesh(("device2", False)))
    strained = replace(condensed, section=replace(condensed.section, strain=3.0 * condensed.section.strain))
    plain, told = (
        frequency_rows(Scene(each, device), over, creeping(), [None], Interface.SHEAR)[0]
        for each, over in ((given.model, condensed), (model, strained))
    )
    assert plain["caveats"] == ()
    strain, filtered = told["caveats"]
    assert strain.startswith("receptors are strained by up to")
    assert filtered.startswith("the filter's wavelength is 1.3 receptor elements")
    assert [row["note"] for row in without_caveats([plain, told])] == ["", f"{strain}; {filtered}"]
    assert "caveats" not in without_caveats([told])[0]


def test_actuators_that_leave_the_skin_at_any_time_of_a_cycle_are_told() -> None:
    """Two of the pins that hardly touch lift off in each half of it."""
    given = coarse()
    touching = replace(given.model, contact=replace(given.model.contact, criterion=Criterion.TOUCH))
    lifted = Scene(touching, replace(given.device, cycles=(normal(0.4),)))
    condensed = condense_mesh(given, mesh(("device2", False)))
    row, _ = frequency_rows(lifted, condensed, creeping(), [None], Interface.FRICTIONLESS)
    (told,) = row["caveats"]
    assert told.startswith("actuators that leave the skin, counted from the left: 1, 2, 3, 4 (")


def test_what_cannot_be_pressed_has_rows_that_say_so() -> None:
    """So the other interface keeps its scores."""
    given = coarse()
    device = replace(given.device, frequencies=(5.0,), cycles=given.device.cycles[:1])
    lost = replace(given.model, numerics=replace(given.model.numerics, newton_tolerance=1e-30))
    condensed = condense_mesh(given, mesh(("device2", False)))
    rows = frequency_rows(Scene(lost, device), condensed, creeping(), [None], Interface.SHEAR)
    assert [row["readout"] for row in rows] == list(Readout)
    assert all(row["score"] is None for row in rows)
    assert all(row["note"].startswith("no prediction: device=device2, interface=shear, pre-ind") for row in rows)
    assert all(row["inertia"] is None for row in rows)  # nobody knows it


def test_a_forecast_is_the_table_on_a_mesh_of_its_own_and_says_how_far_it_has_come() -> None:
    """Whatever the number of threads, on which rounding depends."""
    given = coarse()
    asked = given.with_device(frequencies=(5.0,), cycles=given.device.cycles[:1])
    section, done = mesh(("device2", False)), list[int]()
    with threadpool_limits(1):
        table = vibration_rows(asked, section, condense_mesh(asked, section))
    with threadpool_limits(2):
        found = vibration_forecast(asked, lambda: done.append(max(each["num_threads"] for each in threadpool_info())))
    assert found == table
    assert done == [1] * steps_of(asked)


def test_other_assumptions_on_relaxation_keep_to_the_limit_of_inertia(monkeypatch: pytest.MonkeyPatch) -> None:
    """Creep, which does not know the limit, is condensed once of each."""
    given = coarse()
    device = replace(given.device, cycles=given.device.cycles[:1])
    careful = replace(given.model, vibration=replace(given.model.vibration, inertia_limit=1e-6))
    section = mesh(("device2", False))
    condensed = condense_mesh(given, section)

    @cache
    def crept(relaxation: Relaxation) -> Creep:
        return condense_creep(
            section, given.with_model(vibration=replace(given.model.vibration, relaxation=relaxation))
        )

    monkeypatch.setattr(
        "fingerpad.vibration.frequency_variants.condense_creep",
        lambda _, variant: crept(variant.model.vibration.relaxation),
    )
    for model, predicted in ((given.model, True), (careful, False)):
        rows = relaxation_rows(Scene(model, device), section, condensed, 5.0)
        assert len({row["assumption"] for row in rows}) == len(rows) / len(Readout) == 5
        assert all((row["score"] is not None) is predicted for row in rows)
        assert predicted or all("inertia" in row["note"] for row in rows)


def test_tissue_that_next_to_never_relaxes_is_a_named_error() -> None:
    given = coarse()
    hardly = replace(given.model.vibration.relaxation, shares=(1e-17,) * len(given.model.vibration.relaxation.times))
    model = replace(given.model, vibration=replace(given.model.vibration, relaxation=hardly))
    with pytest.raises(CondensationError, match=r"device2: vibration.shares: one is too small"):
        condense_creep(mesh(("device2", False)), Scene(model, given.device))


def test_tissue_that_relaxes_all_but_whole_is_a_named_error() -> None:
    given = with_relaxation(Relaxation((0.9999,), (0.1,), DEEP))
    with pytest.raises(CondensationError, match=r"device2: the creep .*; try smaller vibration.shares"):
        condense_creep(mesh(("device2", True)), given)


def test_cycles_without_an_actuator_at_its_peak_are_refused() -> None:
    """All pins a quarter of a cycle ahead would be read as they pass through zero."""
    device = replace(coarse().device, frequencies=(5.0,), cycles=(normal(0.01),))
    late = replace(normal(0.01), normal=1j * normal(0.01).normal)
    assert normal(0.01).is_at_peak
    assert normal(0.0).is_at_peak
    with pytest.raises(SceneError, match=r"no actuator at its peak .* group index 0"):
        replace(device, cycles=(late,))
    assert replace(device, cycles=(late,), frequencies=()).cycles == (late,)  # nothing is read


def test_what_rounding_leaves_of_a_change_is_none() -> None:
    steady = np.tile([0.1, 0.0, 0.0], (4, 5))
    noisy = steady * (1.0 + 1e-13 * np.random.default_rng(0).standard_normal(steady.shape))
    assert not cyclic_readouts(noisy)[Readout.CHANGE_OF_STRAIN].any()


def test_vibrations_are_read_at_phase_zero() -> None:
    """With which a cycle ends; the change is that from the cycle's mean."""
    strains = np.random.default_rng(4).standard_normal((8, 30))
    found = cyclic_readouts(strains)
    measured = np.array([maximum_principal(each) for each in strains])
    assert np.array_equal(found[Readout.STRAIN], measured[-1])
    assert found[Readout.CHANGE_OF_STRAIN] == pytest.approx(measured[-1] - measured.mean(axis=0), rel=1e-12)


def test_inertia_does_not_know_how_receptors_are_spaced() -> None:
    """Maps of one point of the line, or of three there, to the same strains: linear along the arc."""
    given = coarse()
    section = condense_section(mesh(("device2", False)), given)
    finer = np.interp(
        np.linspace(0.0, 1.0, 3 * section.arc.size) ** 2, np.linspace(0.0, 1.0, section.arc.size), section.arc
    )
    driven = stuck(pressed(Interface.SHEAR), normal(0.01))
    effects = []
    for arc in (section.arc, finer):
        still = replace(section, arc=arc, strain=_interpolated(section, arc))
        moving = replace(still, strain=still.strain * np.repeat(1.0 + 0.01 * np.abs(arc), 3)[:, None])
        effects.append(inertia_effect(given, driven, still, moving))
    # but for what trapezoids miss of squares, which are no longer linear (measured: 7e-5)
    assert effects[1] == pytest.approx(effects[0], rel=1e-3)


def _interpolated(section: CondensedSection, arc: np.ndarray) -> np.ndarray:
    """The map to strain (3k, 2n) at other arc lengths (k,)."""
    columns = section.strain.reshape(section.arc.size, -1)
    return np.array([np.interp(arc, section.arc, column) for column in columns.T]).T.reshape(3 * arc.size, -1)


def test_cycles_pass_through_the_snapshot() -> None:
    for name in ("device1", "device2", "device3"):
        device = scene(name).device
        for cycle, condition in zip(device.cycles, device.conditions, strict=True):
            assert cycle.name == condition.name
            peak = displacement(cycle, 2.0 * np.pi)
            assert np.allclose(peak[:, 0], condition.tangential[-1], rtol=0.0, atol=1e-15)
            assert np.allclose(peak[:, 1], condition.normal[-1], rtol=0.0, atol=1e-15)


def test_variants_of_relaxation_leave_what_they_say() -> None:
    """Of the modulus: as configured, of some layers alone, half-way to all, half, and as much at another speed. The
    layers are those below the receptors, and the speed is the fastest.
    """
    variants = {name: each.model.vibration.relaxation for name, each in _relaxation_variants(scene("device2")).items()}
    usual, *_ = variants.values()
    left = 1.0 - sum(usual.shares)
    found = {name: 1.0 - sum(each.shares) for name, each in variants.items()}
    assert list(found.values()) == pytest.approx([left, left, (1.0 + left) / 2.0, left / 2.0, left])
    assert [each.layers for each in variants.values()] == [usual.layers, DEEP] + [usual.layers] * 3
    assert [each.times for each in variants.values()] == [usual.times] * 4 + [(min(usual.times),)]
