"""How much the tissue's mass matters at a frequency, which the model leaves out.

Where actuators move the skin with amplitudes a, contact forces are f = C^-1 a and receptors are strained by E f. With
friction skin is taken to stick, so that a is the actuators' own; without it, a is what a cycle without mass has shown.
With inertia the stiffness K that C and E come from is K - omega^2 M. Both are taken with tissue as stiff as it is at
the frequency (real part of the modulus) and without its damping, which would only lessen resonance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix

from ..arrays import ComplexArray, FloatArray
from ..contact.formulation import Status
from ..contact.linear_solution import Indented
from ..readouts.roughness import over_span, scene_span
from ..scene.device import Cycle
from ..scene.scene import Scene
from ..tissue.compliance import VOIGT, CondensedSection
from ..tissue.condensation import condense_parts, parts_of, section_stiffness
from ..tissue.elasticity import mass
from ..tissue.mesh import SectionMesh
from ..tissue.reach import contact_tractions
from .creep import stiffened
from .cycling import Vibration

MARGIN = 0.9  # of a frequency that is advised [1]; source: at 105 Hz, advised for 150 Hz, inertia was a tenth beyond


@dataclass(frozen=True)
class Vibrating:
    """The finger at one frequency. frequency: [Hz]. still, moving: condensed without its mass and with it."""

    frequency: float
    still: CondensedSection
    moving: CondensedSection


def condense_vibrating(section: SectionMesh, scene: Scene, frequency: float) -> Vibrating:
    """The finger at a frequency [Hz]. Raises MeshError as `contact_tractions`, CondensationError."""
    speed = 2.0 * math.pi * frequency
    stiff = stiffened(scene, 1j * speed)
    tractions = contact_tractions(section, stiff)
    parts = parts_of(section, stiff, tractions)
    matrix = section_stiffness(section, stiff, parts.elements)
    inertia = speed**2 * mass(section.mesh, parts.elements, scene.model.vibration.density)
    both = (csc_matrix(each) for each in (matrix, matrix - inertia))
    return Vibrating(frequency, *(condense_parts(section, stiff, tractions, parts, each) for each in both))


@dataclass(frozen=True)
class Driven:
    """What actuators do to the skin at a frequency. amplitude: (2n,) of displacement [mm] where it is prescribed, not a
    number elsewhere. force: (2n,) amplitude of forces there [N/mm].
    """

    amplitude: ComplexArray
    force: ComplexArray


def stuck(indented: Indented, cycle: Cycle) -> Driven:
    """Skin that sticks to the actuators which it touches, and moves with them."""
    amplitude = np.stack([cycle.tangential, cycle.normal], axis=1)[indented.state.given]
    amplitude[indented.state.status == Status.OPEN] = np.nan
    return Driven(amplitude.ravel(), np.zeros(amplitude.size, dtype=np.complex128))


def slipping(vibration: Vibration) -> Driven:
    """Skin without friction, from the first harmonic of a cycle: where it never opens it moves across the faces as it
    does there, elsewhere it bears the forces that it does there. Actuators that move sideways drive it by their edges.
    """
    never = np.all([state.status != Status.OPEN for state in vibration.states], axis=0)
    amplitude = _first_harmonic(vibration.skin)
    amplitude[~never] = amplitude[:, 0] = np.nan
    force = _first_harmonic(np.array([state.force for state in vibration.states]))
    return Driven(amplitude.ravel(), force.ravel())


def _first_harmonic(values: FloatArray) -> ComplexArray:
    """Amplitude (...) of values (n_times, ...) over a cycle that ends at phase zero."""
    count = len(values)
    turned: ComplexArray = np.exp(-2j * np.pi * np.arange(1, count + 1) / count)
    return np.tensordot(turned, values, 1) * (2.0 / count)


def inertia_effect(scene: Scene, driven: Driven, still: CondensedSection, moving: CondensedSection) -> float:
    """Change of the receptors' strain by inertia over that strain's own amplitude [1], root mean squares over arc
    length within the score's span. still, moving: the finger condensed at the frequency without its mass and with it.
    """
    first, second = (_strain(each, driven).reshape(-1, VOIGT) for each in (still, moving))
    strained, changed = (_norm(each, still.arc, scene_span(scene)) for each in (first, second - first))
    return 0.0 if strained == 0.0 else changed / strained


def _norm(strain: ComplexArray, arc: FloatArray, span: tuple[float, float]) -> float:
    """Norm of strain amplitudes (m, 3) over a span of arc length (m,) [mm]; gxy = 2 exy stands for exy and eyx."""
    points, squares = over_span(arc, np.abs(strain) ** 2 @ [1.0, 1.0, 0.5], span)
    return float(np.sqrt(np.trapezoid(squares, points)))


def _strain(maps: CondensedSection, driven: Driven) -> ComplexArray:
    """Amplitude (3m,) of the receptors' strain [1] where skin is driven."""
    held = np.isfinite(driven.amplitude)
    force = np.where(held, 0.0, driven.force)
    moved = driven.amplitude[held] - maps.compliance[held] @ force
    force[held] = np.linalg.solve(maps.compliance[np.ix_(held, held)], moved)
    return np.asarray(maps.strain @ force)


def highest_frequency(frequency: float, effect: float, limit: float) -> float:
    """Frequency [Hz] up to which inertia stays within about a limit, from its effect at one: it grows with the square,
    and faster towards a resonance, which MARGIN is for.

    >>> highest_frequency(100.0, 0.4, 0.1)
    45.0
    """
    return MARGIN * frequency * math.sqrt(limit / effect)
