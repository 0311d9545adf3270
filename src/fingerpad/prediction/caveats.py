"""What one should know before believing a score."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import FloatArray
from ..contact.solution import Solution
from ..readouts.gabor import gabor_filtered
from ..readouts.roughness import SCORE_UNIT, roughness_score, scene_span
from ..readouts.strain import Reading, Resampling
from ..scene.contact_law import Criterion, Interface
from ..scene.device import ActuatorRow, Condition
from ..scene.finger import Finger
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics

MANY_SEARCHES = 10  # increments that did not settle at once [1]; source: assumption: some; shipped devices have none
MANY_CUTS = 3  # halved increments [1]; source: shipped devices have up to 3, with finite kinematics and no friction
NEAR = 0.2  # of a certificate's limit [1]; source: shipped devices stay below 0.11
# Difference of scores at two times [1] from which on it is told; source: assumption: as much as nobody tells apart
OTHERWISE = 0.05

# Depth of an actuator over the pad's thickness [1]; source: mean strain is then 0.5, the logarithmic one 0.69: small
# strain is off by over a quarter
DEEP = 0.5
# Principal strain at receptors [1]; source: ln(1 + e) is then a tenth less than e. Shipped devices have up to 0.13
STRAINED = 0.22
# The same [1], from which on nobody has compared small with finite strain; source: shipped devices have 0.35 and 0.37
DEEPER = 0.37
BARELY = 1e-3  # indentation [mm]; source: `touch` goes 2e-4 mm past first touch (contact.criterion.NEARLY)
# Elements at edges that an actuator is wide [1]; source: with 7, a sharp pin of 0.1 mm goes as deep as with 28, to 1 %
FEW = 5.0
# Radius of edges over the size of elements there [1]; source: with finite strain and friction, scores with a sixth are
# 1.6 times too high, with a third to two thirds paths end, and from one on finer elements change nothing (decision 43)
SHARP = 1.0
COARSE = 2.0  # elements [1] of the receptor line in a wavelength; source: with 1.1, scores are noise (measured)
PRESS_AS_ASKED = "contact.criterion depth or force, in the device file or with predict --vary, presses them as asked"
TOO_WIDE = (
    "The row is wide for this finger: covering all faces may take an indentation of half the pad, which may take"
    " minutes to solve and may have no solution. A narrower row needs less, and so may contact.criterion: touch, depth"
    " or force."
)
TOO_FAR_OUT = (
    "The row lies to one side of the finger: covering its outer face may take an indentation of half the pad, which may"
    " take minutes to solve and may have no solution. Nearer to the middle (actuators.offset) it needs less, and so may"
    " contact.criterion: touch, depth or force."
)
# Height of the skin over the outermost faces above that touched first, over the pad's thickness [1]; source: six pins
# of 1.2 mm with 0.28 (pitch 1.8 mm) are pressed 0.43 of the pad deep; with 0.32 (1.9 mm) they have no solution without
# friction
WIDE = 0.3
TOO_DEEP = "Pre-indentation to contact.depth goes deeper than half of the pad: small strain is invalid there."
TOO_SHALLOW = (
    "contact.depth is less than the height of the skin over some actuators, which may bear nothing;"
    " counted from the left: {clear}"
)
NO_SUCH_DEPTH = "contact.depth is more than the pad is thick: is it in mm, and from first touch?"
TOO_FAR = "A normal stroke goes deeper than the pad is thick: are displacements in mm?"
BESIDE = "A lateral stroke takes an actuator beside the finger: are displacements in mm?"
AWAY = 0.1  # of the stroke [1] at time 0; source: assumption: more than a sensor's noise
JUMP = 2.0  # of the largest step between later times [1]; source: assumption: more than motion that goes on as it began
SHORTEST = 1e-4  # mm; source: assumption: a two-hundredth of the shipped pins' stroke


def stimulus_caveats(condition: Condition) -> list[str]:
    """Nothing that moves; strokes and phases so small that they may be in other units than mm and degrees; and
    displacements that may be counted from elsewhere than the pre-indented position.
    """
    stroke, phase = condition.stroke, condition.phase_deg
    found = []
    if stroke == 0.0:
        found.append("no actuator moves")
    elif stroke < SHORTEST:
        found.append(f"actuators move by {stroke:.2g} mm at most: are displacements in mm?")
    start = float(np.abs(condition.moves[0]).max())
    step = float(np.abs(np.diff(condition.moves, axis=0)).max(initial=0.0))
    is_jump = 0.0 < JUMP * step < start and not condition.settling  # cycles begin anywhere
    if condition.time.size > 1 and start > AWAY * stroke and (condition.time[0] == 0.0 or is_jump):
        found.append(
            f"actuators begin {start:.2g} mm away from where they were pressed to, from where displacements count"
        )
    if phase != round(phase) and abs(phase) < 2.0 * math.pi:
        found.append(f"the phase is {phase:g} degrees: are phases in degrees?")
    return found


def device_caveats(scene: Scene) -> list[str]:
    """What can be told before anything is solved: rows too wide, preloads too deep or too shallow, and strokes that
    leave the finger.
    """
    law, row, pad = scene.model.contact, scene.device.actuators, scene.model.finger.pad_thickness
    normal = max(float(each.normal.max()) for each in scene.device.conditions)
    rises = skin_rises(scene)
    rise = float(rises.max())
    indentations = {Criterion.FULL: rise, Criterion.DEPTH: law.depth}  # at least; elsewhere solving alone tells
    aside = max(float(np.abs(row.positions + each.tangential).max()) for each in scene.device.conditions)
    clear = numbers_of(rises > law.depth)
    is_far_up = law.criterion is Criterion.FULL and rise > WIDE * pad
    # in the middle of the finger the same row would not be wide
    centred = replace(row, positions=tuple(np.asarray(row.positions) - np.mean(row.positions)))
    is_wide = float(_rises(scene.model.finger, centred).max()) > WIDE * pad
    is_deep = law.criterion is Criterion.DEPTH and law.depth > DEEP * pad
    is_beyond = law.criterion is Criterion.DEPTH and law.depth > pad
    found = {
        TOO_WIDE: is_far_up and is_wide,
        TOO_FAR_OUT: is_far_up and not is_wide,
        NO_SUCH_DEPTH: is_beyond,
        TOO_DEEP: is_deep and not is_beyond,
        TOO_SHALLOW.format(clear=clear): law.criterion is Criterion.DEPTH and bool(clear),
        TOO_FAR: not is_beyond and indentations.get(law.criterion, 0.0) + normal > pad,
        BESIDE: aside + row.width / 2.0 > scene.model.finger.width / 2.0,
    }
    return [caveat for caveat, holds in found.items() if holds]


def skin_rises(scene: Scene) -> FloatArray:
    """How far (n_actuators,) [mm] undeformed skin over the outer end of each face lies above the lowest over any."""
    return _rises(scene.model.finger, scene.device.actuators)


def _rises(finger: Finger, row: ActuatorRow) -> FloatArray:
    """The same of a finger and a row."""
    centre = np.abs(row.positions)
    nearest = np.array([max(centre.min() - row.half_face, 0.0)])
    return finger.skin_height(centre + row.half_face) - finger.skin_height(nearest)


def scene_caveats(scene: Scene, interface: Interface) -> list[str]:
    """No friction where it is asked for, actuators without a face to cover or too narrow for the mesh, edges too sharp
    for finite strain with friction, and a filter too fine for the mesh.
    """
    found = []
    if interface is Interface.SHEAR and scene.model.contact.friction == 0.0:
        found.append("contact.friction is 0: the interface called shear has no friction here either")
    if scene.lacks_faces:
        found.append(
            "round actuators have no flat face to cover: pre-indentation ends where contact reaches the middle of each;"
            f" {PRESS_AS_ASKED}"
        )
    numerics = scene.model.numerics
    row, size = scene.device.actuators, numerics.edge_size
    elements = row.width / size
    if elements < FEW:
        found.append(f"actuators are {elements:.1f} elements wide: try a smaller numerics.edge_size")
    is_sharp = scene.kinematics is Kinematics.FINITE and row.edge_radius < SHARP * size
    if is_sharp and scene.model.contact.coefficient(interface) > 0.0:
        found.append(
            "edges are sharper than the mesh there can tell, so with friction scores may be far too high, or paths end:"
            f" compare predict --vary actuators.edge_radius={size:g}"
        )
    waves = min(scene.model.gabor.wavelength(each) for each in Readout) / numerics.receptor_size
    if waves < COARSE:
        found.append(f"the filter's wavelength is {waves:.1f} receptor elements: try a smaller numerics.receptor_size")
    return found


def state_caveats(scene: Scene, depth: float, strain: FloatArray) -> list[str]:
    """Actuators too deep [mm], and receptors with principal strains (m,) [1] too large, for small strain."""
    found = []
    share, strained = depth / scene.model.finger.pad_thickness, float(strain.max())
    if scene.kinematics is Kinematics.SMALL and share > DEEPER:
        doubt = "small strain is invalid" if share > DEEP else "compare predict --kinematics finite"
        found.append(f"actuators indent {share:.0%} of the pad: {doubt}")
    if scene.kinematics is Kinematics.SMALL and strained > STRAINED:
        found.append(
            f"receptors are strained by up to {strained:.0%}, too much for small strain: compare predict --kinematics"
            " finite"
        )
    return found


def pressing_caveats(pressing: FloatArray) -> list[str]:
    """Actuators without force after pre-indentation, and off the skin later, by their pressing forces (1 + n_times,
    n_actuators) [N/mm] then.
    """
    found = []
    if idle := numbers_of(pressing[0] <= 0.0):
        found.append(f"actuators without force after pre-indentation, counted from the left: {idle}")
    if left := numbers_of((pressing[0] > 0.0) & (pressing[1:] <= 0.0).any(axis=0)):
        found.append(
            f"actuators that leave the skin, counted from the left: {left} (of a normal drive positive points into it)"
        )
    return found


def solution_caveats(scene: Scene, solution: Solution, interface: Interface) -> list[str]:
    """Those of the scene, of the state that is read and of what presses; no pre-indentation to speak of, many
    increments that were cut or did not settle at once, and figures of the certificate near their limits.
    """
    certificate = solution.certificate
    found = state_caveats(scene, solution.depth, solution.reading.strain) + scene_caveats(scene, interface)
    if scene.model.contact.criterion is Criterion.TOUCH and solution.indentation <= BARELY:
        found.append(f"all actuators touch at once, so that pre-indentation ends at first touch: {PRESS_AS_ASKED}")
    found += pressing_caveats(solution.pressing)
    if solution.cuts > MANY_CUTS:
        found.append(f"increments were halved {solution.cuts} times")
    if solution.searches > MANY_SEARCHES:
        found.append(f"{solution.searches} increments did not settle at once")
    shares = {
        "penetration": certificate.penetration_share,
        "gap in contact": certificate.gap_share,
        "tension": certificate.tension_share,
        "excess over the friction cone": certificate.cone_share,
    }
    found += [f"certificate: {name} is {share:.0%} of its limit" for name, share in shares.items() if share > NEAR]
    return found


def caveats_of(scene: Scene, condition: Condition, solution: Solution, interface: Interface) -> list[str]:
    """Those of a stimulus and of its solution, a sentence each."""
    return stimulus_caveats(condition) + solution_caveats(scene, solution, interface)


def note_of(caveats: Sequence[str]) -> str:
    """Caveats as the note of a row of the score table."""
    return "; ".join(caveats)


def rival_caveats(scene: Scene, condition: Condition, reading: Reading, resampling: Resampling) -> list[str]:
    """That another time of the stimulus might as well be read, where it has another score."""
    if not reading.rivalled:
        return []
    changes = {reading.time: reading.change_of_strain, reading.rival: reading.rival_change}
    read, other = (_change_score(scene, change, resampling) for change in changes.values())
    if abs(other - read) <= OTHERWISE * read:
        return []
    now, then = (f"{condition.time[time]:.9g} {condition.time_unit}" for time in changes)
    return [
        f"read at {now}; at {then} strain changes by {reading.rival_peak:.0%} as much, in another pattern: there"
        f" change_of_strain would score {other:.3g} in place of {read:.3g} {SCORE_UNIT}; which of them people answer is"
        " an assumption, and the error does not cover it"
    ]


def _change_score(scene: Scene, change: FloatArray, resampling: Resampling) -> float:
    """Score [mm2] of a change of strain (m,) at the receptors."""
    readout, gabor, grid = Readout.CHANGE_OF_STRAIN, scene.model.gabor, resampling.grid
    filtered = gabor_filtered(grid, resampling.weights @ change, gabor.wavelength(readout), gabor.sigma)
    return roughness_score(grid, filtered, scene_span(scene))


def score_caveats(
    scene: Scene, condition: Condition, interface: Interface, solution: Solution, resampling: Resampling
) -> list[str]:
    """`caveats_of` a solution, and of when it is read."""
    return [
        *caveats_of(scene, condition, solution, interface),
        *rival_caveats(scene, condition, solution.reading, resampling),
    ]


def numbers_of(which: np.ndarray) -> str:
    """Numbers, from 1, of the actuators that are marked (n_actuators,)."""
    return ", ".join(str(number + 1) for number in np.flatnonzero(which))
