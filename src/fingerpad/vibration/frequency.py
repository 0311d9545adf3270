"""Scores of a device's conditions as vibrations, at each frequency it is asked for.

Receptors are read when the phase is zero, as in a snapshot. The RA-1 proxy is the change from the cycle's mean, as
these afferents answer change, not what stays.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import FloatArray
from ..contact.advice import named
from ..contact.certificate import certify
from ..contact.depth import depth, require_tissue
from ..contact.formulation import actuator_forces
from ..contact.linear_solution import Indented, indent_device
from ..errors import ContactError, InertiaError, UnsolvedError
from ..prediction.caveats import note_of, pressing_caveats, scene_caveats, state_caveats
from ..prediction.scoring import Condensed, attempt
from ..readouts.gabor import filtered_readouts
from ..readouts.roughness import NO_PREDICTION, SCORE_UNIT, roughness_scores
from ..readouts.strain import Resampling, maximum_principal, without_rounding
from ..scene.contact_law import Interface
from ..scene.device import Cycle
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..tissue.mesh import SectionMesh
from ..words import PERCENT
from .creep import Creep, condense_creep
from .cycling import Vibration, vibrate
from .inertia import Vibrating, condense_vibrating, highest_frequency, inertia_effect, slipping, stuck
from .speed import SLOWLY, frequency_name


@dataclass(frozen=True)
class Outcome:
    """Scores [mm2] by read-out, none if there is no prediction; inertia: its effect [1], None where it is not known;
    caveats: why there is no prediction, or what to beware of.
    """

    scores: dict[Readout, float]
    inertia: float | None
    caveats: list[str]


def vibration_rows(
    scene: Scene, section: SectionMesh, condensed: Condensed, step: Callable[[], object] = lambda: None
) -> list[dict[str, Any]]:
    """Rows of the frequency table of a scene, of slow cycles first, with `caveats` (sentences) behind, which
    the note joins. section, condensed: of the scene. step: called after what each speed needs is condensed, and after
    each row pair. Raises MeshError, CondensationError.
    """
    creep = condense_creep(section, scene)
    step()
    speeds: list[Vibrating | None] = [None]
    for frequency in scene.device.frequencies:
        speeds.append(condense_vibrating(section, scene, frequency))
        step()
    return [
        row
        for interface in scene.device.interfaces()
        for row in frequency_rows(scene, condensed, creep, speeds, interface, step)
    ]


def frequency_rows(
    scene: Scene,
    condensed: Condensed,
    creep: Creep,
    speeds: Sequence[Vibrating | None],
    interface: Interface,
    step: Callable[[], object] = lambda: None,
) -> list[dict[str, Any]]:
    """Rows of the frequency table for one interface. speeds: None for slow cycles. step: called after each row pair.

    Where inertia matters, or a path cannot be followed, there is a note instead of a score.
    """
    indented = attempt(indent_device, scene, condensed.section, condensed.body, interface)
    shares_equal = scene.model.skips.equal_stimuli
    rows = []
    found: dict[tuple[object, float], Outcome] = {}
    for cycle in scene.device.cycles:
        stimulus = (cycle.normal.tobytes(), cycle.tangential.tobytes()) if shares_equal else cycle.name
        for at in speeds:
            frequency = at.frequency if at else SLOWLY
            if (stimulus, frequency) not in found:
                found[stimulus, frequency] = (
                    Outcome({}, None, [f"{NO_PREDICTION}: {indented}"])
                    if isinstance(indented, UnsolvedError)
                    else _outcome(scene, condensed.resampling, creep, indented, cycle, at)
                )
            rows += [_row(scene, cycle, frequency, interface, each, found[stimulus, frequency]) for each in Readout]
            step()
    return rows


def _outcome(
    scene: Scene, resampling: Resampling, creep: Creep, indented: Indented, cycle: Cycle, at: Vibrating | None
) -> Outcome:
    """What becomes of a condition at a frequency, slowly if there is none."""
    frequency, sticks = at.frequency if at else SLOWLY, indented.problem.friction > 0.0
    at = at if np.any(cycle.normal) or np.any(cycle.tangential) else None
    effect = None if at else 0.0  # what rests, or moves slowly, has no inertia
    try:
        if at and sticks:
            effect = inertia_effect(scene, stuck(indented, cycle), at.still, at.moving)
            _require_no_inertia(scene, frequency, effect)
        vibration = certified_vibration(scene, creep, indented, cycle, frequency)
        if at and not sticks:
            effect = inertia_effect(scene, slipping(vibration), at.still, at.moving)
            _require_no_inertia(scene, frequency, effect)
        deepest, read = depth(indented.problem, _highest(indented, cycle)), maximum_principal(vibration.strain[-1])
        pressing = actuator_forces(indented.problem, [indented.state, *vibration.states])[:, :, 1]
        told = [
            *state_caveats(scene, deepest, read),
            *scene_caveats(scene, indented.interface),
            *pressing_caveats(pressing),
        ]
        return Outcome(_vibration_scores(scene, resampling, vibration), effect, told)
    except ContactError as error:
        return Outcome({}, effect, [f"{NO_PREDICTION}: {error}"])


def certified_vibration(scene: Scene, creep: Creep, indented: Indented, cycle: Cycle, frequency: float) -> Vibration:
    """A condition at a frequency [Hz], if all states of its last cycle have their certificate. Raises ContactError,
    naming it.
    """
    case = f"device={scene.device.name}, condition={cycle.name}, interface={indented.interface}"
    with named(f"{case}, {frequency_name(frequency)}"):
        require_tissue(indented.problem, _highest(indented, cycle), scene.model.finger.pad_thickness)
        vibration = vibrate(indented, creep, cycle, frequency, scene.model.vibration.steps)
        for problem, state in zip(vibration.problems, vibration.states, strict=True):
            certify(problem, indented.section, state)
    return vibration


def _vibration_scores(scene: Scene, resampling: Resampling, vibration: Vibration) -> dict[Readout, float]:
    """Both scores [mm2] of a vibration."""
    filtered = filtered_readouts(resampling, cyclic_readouts(vibration.strain), scene.model.gabor)
    return roughness_scores(scene, filtered)


def _highest(indented: Indented, cycle: Cycle) -> FloatArray:
    """Where actuators (1, n_actuators, 2) [mm] stand highest in a cycle, each at its own time."""
    amplitude = np.stack([np.zeros(cycle.normal.size), np.abs(cycle.normal)], axis=1)
    return (indented.state.actuator + amplitude)[None]


def cyclic_readouts(strain: FloatArray) -> dict[Readout, FloatArray]:
    """Both read-outs (m,) [1] at the receptors, from strains (n_times, 3m) over a cycle that ends at phase zero."""
    measured = np.array([maximum_principal(each) for each in strain])
    change = without_rounding(measured[-1] - measured.mean(axis=0), measured[-1])
    return {Readout.STRAIN: measured[-1], Readout.CHANGE_OF_STRAIN: change}


def _require_no_inertia(scene: Scene, frequency: float, effect: float) -> None:
    limit = scene.model.vibration.inertia_limit
    if not effect <= limit:
        advised = float(f"{highest_frequency(frequency, effect, limit):.2g}")
        raise InertiaError(
            f"inertia changes receptor strain by {PERCENT * effect:.3g} > {PERCENT * limit:g} % at {frequency:g} Hz;"
            f" try about {advised:g} Hz, or less"
        )


def _row(
    scene: Scene,
    cycle: Cycle,
    frequency: float,
    interface: Interface,
    readout: Readout,
    outcome: Outcome,
) -> dict[str, Any]:
    """One row of the frequency table."""
    return {
        "device": scene.device.name,
        "condition": cycle.name,
        "dispersion": cycle.dispersion,
        "phase_deg": cycle.phase_deg,
        "frequency_hz": frequency,
        "interface": str(interface),
        "readout": str(readout),
        "score": outcome.scores.get(readout),
        "unit": SCORE_UNIT,
        "inertia": outcome.inertia,
        "note": note_of(outcome.caveats),
        "caveats": tuple(outcome.caveats),
    }


def without_caveats(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows as a table holds them: of caveats, the note that joins them."""
    return [{name: value for name, value in row.items() if name != "caveats"} for row in rows]
