"""How much the tissue's mass matters at a frequency, which the model leaves out.

Where skin sticks to actuators that vibrate with amplitudes a, contact forces are f = C^-1 a and receptors are strained
by E f. With inertia the stiffness K that C and E come from is K - omega^2 M. Both are taken with the tissue as stiff as
it is at that frequency (real part of the modulus) and without its damping, which would only lessen resonance.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import csc_matrix

from ..contact.formulation import Status
from ..contact.linear_solution import Indented
from ..readouts.roughness import score_span
from ..scene.device import Cycle
from ..scene.scene import Scene
from ..tissue.compliance import VOIGT, CondensedSection
from ..tissue.condensation import condense_parts, section_stiffness
from ..tissue.elasticity import mass
from ..tissue.halves import right_half
from ..tissue.mesh import SectionMesh
from ..tissue.reach import contact_tractions
from .creep import stiffened


def condense_vibrating(section: SectionMesh, scene: Scene, frequency: float, density: float) -> CondensedSection:
    """The finger condensed at a frequency [Hz], with tissue of a density [t/mm3]. Raises CondensationError."""
    speed = 2.0 * math.pi * frequency
    stiff = stiffened(scene, 1j * speed)
    tractions = contact_tractions(section, stiff)
    parts = right_half(section, tractions)
    matrix, _ = section_stiffness(section, stiff, parts.elements)
    moving = csc_matrix(matrix - speed**2 * mass(section.mesh, parts.elements, density))
    return condense_parts(section, stiff, tractions, parts, moving)


def inertia_effect(
    scene: Scene,
    indented: Indented,
    cycle: Cycle,
    still: CondensedSection,
    moving: CondensedSection,
) -> float:
    """Change of the receptors' strain by inertia over that strain's own amplitude [1], root mean squares over the
    score's span. still, moving: the finger condensed at the frequency without its mass and with it.

    Without friction actuators move the skin along their normal alone.
    """
    problem, pressed = indented.problem, indented.state
    start, stop = score_span(scene.device.actuators, scene.model.readout.span_margin)
    inside = np.repeat((still.arc > start) & (still.arc < stop), VOIGT)
    touching = np.flatnonzero(pressed.status != Status.OPEN)
    directions = (0, 1) if problem.friction > 0.0 else (1,)
    unknowns = np.concatenate([2 * touching + direction for direction in directions])
    amplitude = np.stack([cycle.tangential, cycle.normal])[:, problem.actuator_of[touching]]
    moved = np.concatenate([amplitude[direction] for direction in directions])
    if not np.any(moved):
        return 0.0
    strains = [_strain(each, unknowns, moved)[inside] for each in (still, moving)]
    return float(np.linalg.norm(strains[1] - strains[0]) / np.linalg.norm(strains[0]))


def _strain(maps: CondensedSection, unknowns: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """Amplitude (3m,) of the receptors' strain [1] where some unknowns (k,) of the skin move by (k,) [mm]."""
    force = np.linalg.solve(maps.compliance[np.ix_(unknowns, unknowns)], moved)
    return np.asarray(maps.strain[:, unknowns] @ force)


def highest_frequency(frequency: float, effect: float, limit: float) -> float:
    """Frequency [Hz] up to which inertia stays within a limit, from its effect at one: it grows with the square.

    >>> highest_frequency(100.0, 0.4, 0.1)
    50.0
    """
    return frequency * math.sqrt(limit / effect)
