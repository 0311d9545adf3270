"""Random valid scenes, each told by its number.

Scenes come in groups that share a finger, whose mesh is coarse, so that most cost no more than a path of contact.
Within a group everything else is redrawn: actuators, friction, criterion, increments and stimulus. The ranges are
wider than any use: they ask for an answer or a named error, not for a sensible device.
"""

from __future__ import annotations

import math
from dataclasses import replace
from enum import StrEnum

import numpy as np

from ..arrays import FloatArray
from ..errors import SceneError
from ..scene.contact_law import ContactLaw, Criterion, FrictionFrom, TurningNormal
from ..scene.device import ActuatorRow, Body, Condition, Control, Device, evenly
from ..scene.finger import Finger, Layer, Material
from ..scene.numerics import Numerics, Skips
from ..scene.readout import GaborFilter, ReadoutRule, Side
from ..scene.scene import Model, Scene
from ..scene.tissue_law import Kinematics, Law, TissueLaw
from ..scene.vibration_rule import Relaxation, VibrationRule

GROUP = 50  # scenes that share a finger [1]

# Ranges; those that span decades are drawn by their logarithms
WIDTH = (8.0, 40.0)  # of the finger [mm]
FLATNESS = (0.6, 1.0)  # height of the finger over its width [1]
BONE = (0.3, 0.6)  # width of the bone over the finger's [1]
NAIL = 0.5  # the same of the nail [1]
PAD_LAYERS = (2, 5)  # layers of the pad [1]
THICKNESS = (0.01, 0.5)  # of all layers but the last [mm]
DEPTH = (0.1, 0.3)  # of the last layer on either side over the finger's width [1]
MODULUS = (1e-3, 1e3)  # [MPa]: a contrast of 1e6
POISSON = (0.0, 0.4999)  # [1]
LIMIT_SHARE = 0.2  # of layers that have the largest Poisson's ratio, and of rows that touch [1]
SPAN = (0.05, 0.6)  # of the row over the finger's width [1]
ACTUATORS = (1, 64)  # [1]
PITCH = 0.1  # smallest [mm]
FILLED = (0.3, 1.0)  # width of an actuator over pitch [1]; 1 is touching
BODY = (0.02, 0.5)  # thickness of a deformable actuator over its width [1]
BODY_ELEMENTS = 8  # of a deformable actuator along its smallest division [1]
BODIED = 0.3  # share of rows that are deformable [1]
ELEMENTS = (12, 30)  # of skin along the row [1], or more where actuators are many
ELEMENTS_AN_ACTUATOR = 2.0  # at least [1], as one without a node of its own has no contact
RECEPTOR_ELEMENTS, LARGEST_ELEMENTS = 30.0, 10.0  # along the finger's width [1]
CLOSENESS = 1e-3  # smallest element on the skin over the largest [1], for one actuator; times their number squared
ROUNDED_ELEMENTS = 100  # most on all rounded edges of a row [1]
FRICTION = (0.01, 10.0)  # [1], beside 0
FRICTIONLESS = 0.1  # share of scenes without friction [1]
DEEP = (1e-3, 1.0)  # pre-indentation to a depth, over the pad's thickness [1]
PRESSED = (1e-4, 1.0)  # force of a row over its length [MPa], over the modulus of the softest layer [1]
AMPLITUDE = (1e-6, 2.0)  # of a stimulus [mm]
INDENTATION_INCREMENTS = (3, 15)  # [1]
STIMULUS_INCREMENTS = (1, 3)  # [1]
ROWS = (1, 8)  # of a stimulus's history [1]
CYCLES = 10  # most in a stimulus [1]
ROWS_A_CYCLE = 6  # [1]
STILL = VibrationRule(Relaxation((), (), ()), 1e-9, 1.0, 8)  # nothing vibrates
# of the shipped model (config/config.yaml)
TOLERANCE, MAX_CUTS, CONTACT_MARGIN = 1e-9, 10, 0.5
GABOR = GaborFilter(2.8, 1.15, 1.12, 0.02)
# with finite kinematics
LAWS = (Law.HENCKY, Law.NEO_HOOKEAN, Law.OGDEN)
OGDEN_EXPONENT = (1.0, 12.0)  # [1]
LARGEST_POISSON = 0.49  # [1]
FEW = 8  # actuators [1], where a group has scenes with as few; coarse meshes have no nodes for more
CONTRAST = 2.0 / 3.0  # power of the modulus [1]: a contrast of 1e4


class Stimulus(StrEnum):
    """Kinds of random stimuli."""

    HISTORY = "history"  # every actuator on a path of its own
    WAVE = "wave"  # cycles, each actuator a little later than its neighbour: slip travels along the row
    REVERSAL = "reversal"  # all to and fro, ever farther
    RETURN = "return"  # off the skin and back
    AWAY = "away"  # off the skin


def random_scene(number: int) -> Scene:
    """The scene of that number, with one condition; scenes number // GROUP share the finger and what it is made of."""
    group = random_group(number // GROUP)
    rng = np.random.default_rng([number, 1])
    inner = group.device.actuators
    span = inner.positions[-1] - inner.positions[0] + inner.width
    # half of the rows are what the mesh was made for
    served = span / (ELEMENTS_AN_ACTUATOR * group.model.numerics.face_size)
    row = _row(rng, span, served) if rng.random() < 0.5 else _finished(rng, inner)
    friction = 0.0 if rng.random() < FRICTIONLESS else _decades(rng, FRICTION)
    law = _law(rng, friction, group, span)
    numerics = replace(
        group.model.numerics,
        edge_size=row.width / BODY_ELEMENTS,
        indentation_increments=_whole(rng, INDENTATION_INCREMENTS),
        stimulus_increments=_whole(rng, STIMULUS_INCREMENTS),
    )
    model = replace(group.model, contact=law, numerics=numerics)
    condition = _apart(row, _condition(rng, len(row.positions), group.device.stroke))
    return Scene(model, Device(f"stress_{number:05d}", "random", Control.DISPLACEMENT, row, (condition,)))


def _law(rng: np.random.Generator, friction: float, group: Scene, span: float) -> ContactLaw:
    """A law of contact with that friction [1], all else of it drawn for a row of that span [mm]."""
    pad = group.model.finger.pad
    softest = min(layer.material.modulus for layer in pad)
    return replace(
        group.model.contact,
        friction=friction,
        friction_from=FrictionFrom(rng.choice(list(FrictionFrom))),
        turning_normal=TurningNormal(rng.choice(list(TurningNormal))),
        criterion=Criterion(rng.choice(list(Criterion))),
        depth=group.model.finger.pad_thickness * _decades(rng, DEEP),
        force=softest * span * _decades(rng, PRESSED),
    )


def random_deformed_scene(number: int) -> Scene:
    """The scene of that number with finite kinematics, a finger of its own, few actuators where its group has a row of
    few, and a law drawn for it.
    """
    members = (random_scene(GROUP * number + member) for member in range(GROUP))
    few = (each for each in members if len(each.device.actuators.positions) <= FEW)
    scene = next(few, None) or random_scene(GROUP * number)
    rng = np.random.default_rng([number, 2])
    law, exponent = Law(rng.choice(list(LAWS))), _decades(rng, OGDEN_EXPONENT)
    tissue = TissueLaw(Kinematics.FINITE, (Kinematics.FINITE,), law, exponent)
    finger = scene.model.finger
    pad, dorsal = (tuple(_milder(rng, layer) for layer in stack) for stack in (finger.pad, finger.dorsal))
    model = replace(scene.model, finger=replace(finger, pad=pad, dorsal=dorsal), tissue=tissue)
    return Scene(model, replace(scene.device, name=f"deformed_{number:05d}"))


def _milder(rng: np.random.Generator, layer: Layer) -> Layer:
    """The layer with less contrast, and another Poisson's ratio."""
    poisson = LARGEST_POISSON if rng.random() < 0.5 else rng.uniform(POISSON[0], LARGEST_POISSON)
    return replace(layer, material=Material(layer.material.modulus**CONTRAST, poisson))


def random_group(number: int) -> Scene:
    """The scene whose mesh a group shares; its row is as long as any of theirs, its stimulus goes as far."""
    rng = np.random.default_rng([number, 0])
    while True:
        try:
            return _group(rng, number)
        except SceneError:  # layers that leave no bone, and the like: drawn again
            continue


def _group(rng: np.random.Generator, number: int) -> Scene:
    """A scene drawn for a group. Raises SceneError if there is no such finger."""
    finger = _finger(rng)
    row = _row(rng, finger.width * _decades(rng, SPAN), ACTUATORS[1])
    numerics = _numerics(rng, row, finger.width)
    above = finger.pad[int(rng.integers(len(finger.pad) - 1))].name
    model = Model(
        finger=finger,
        tissue=TissueLaw(Kinematics.SMALL, (Kinematics.SMALL,), Law.HENCKY, 2.0),
        contact=ContactLaw(0.0, FrictionFrom.TOUCH, TurningNormal.FINITE, Criterion.TOUCH, depth=1.0, force=1.0),
        gabor=GABOR,
        readout=ReadoutRule(above, Side(rng.choice(list(Side))), 1.0),
        vibration=STILL,
        numerics=numerics,
        skips=Skips(
            halved_condensation=True,
            equal_stimuli=True,
            shared_indentation=True,
            mirrored_half=bool(rng.random() < 0.5),
            frictionless_path=bool(rng.random() < 0.5),
            inactive_nodes=True,
        ),
    )
    stroke = np.full((1, len(row.positions)), _decades(rng, AMPLITUDE))
    farthest = Condition(
        name="farthest",
        dispersion="random",
        phase_deg=0.0,
        time=np.array([1.0]),
        normal=np.zeros_like(stroke),
        tangential=stroke,
    )
    return Scene(model, Device(f"group_{number:03d}", "random", Control.DISPLACEMENT, row, (farthest,)))


def _finger(rng: np.random.Generator) -> Finger:
    """A finger. Raises SceneError if its layers leave no bone."""
    width = _decades(rng, WIDTH)
    height = width * rng.uniform(*FLATNESS)
    count = _whole(rng, PAD_LAYERS)
    pad = tuple(_layer(rng, f"pad_{i}", THICKNESS) for i in range(count - 1))
    deep = width * DEPTH[0], width * DEPTH[1]
    pad, dorsal = (*pad, _layer(rng, "pad", deep)), (_layer(rng, "dorsal", deep),)
    return Finger(
        width=width,
        height=height,
        bone_width=width * rng.uniform(*BONE),
        nail_width=width * NAIL,
        pad=pad,
        dorsal=dorsal,
    )


def _numerics(rng: np.random.Generator, row: ActuatorRow, width: float) -> Numerics:
    """Sizes for a row under a finger of that width [mm], and as few increments as there can be."""
    span, count = row.positions[-1] - row.positions[0] + row.width, len(row.positions)
    spacing = span / max(_whole(rng, ELEMENTS), ELEMENTS_AN_ACTUATOR * count)
    at_edges = spacing * _decades(rng, (min(CLOSENESS * count**2, 1.0), 1.0))
    at_edges = max(at_edges, 2.0 * count * row.edge_radius / ROUNDED_ELEMENTS)
    return Numerics(
        edge_size=at_edges,
        edge_zone=spacing * CLOSENESS,
        face_size=spacing,
        growth=1.0,
        receptor_size=width / RECEPTOR_ELEMENTS,
        nail_size=width / LARGEST_ELEMENTS,
        largest_size=width / LARGEST_ELEMENTS,
        contact_margin=CONTACT_MARGIN,
        indentation_increments=1,
        stimulus_increments=1,
        newton_tolerance=TOLERANCE,
        max_cuts=MAX_CUTS,
    )


def _layer(rng: np.random.Generator, name: str, thickness: tuple[float, float]) -> Layer:
    poisson = POISSON[1] if rng.random() < LIMIT_SHARE else rng.uniform(*POISSON)
    return Layer(name, _decades(rng, thickness), Material(_decades(rng, MODULUS), poisson))


def _row(rng: np.random.Generator, span: float, served: float) -> ActuatorRow:
    """A row of equal actuators over the span [mm], no more than the mesh has nodes for: `served` [1]."""
    most = int(np.clip(min(span / PITCH, served), *ACTUATORS))
    count = min(int(_decades(rng, (ACTUATORS[0], ACTUATORS[1] + 1.0))), most)
    filled = FILLED[1] if rng.random() < LIMIT_SHARE else rng.uniform(*FILLED)
    pitch = span / (count - 1 + filled)
    row = ActuatorRow(evenly(count, pitch), filled * pitch, 0.0)
    return _finished(rng, row)


def _finished(rng: np.random.Generator, row: ActuatorRow) -> ActuatorRow:
    """The row with edges, from sharp to a cylinder's, and bodies, redrawn."""
    edge = float(rng.choice([0.0, row.width / 2.0, row.width / 2.0 * rng.random()]))
    body = None
    if rng.random() < BODIED:
        material = Material(_decades(rng, MODULUS), rng.uniform(*POISSON))
        body = Body(material, row.width * rng.uniform(*BODY))
    return replace(row, edge_radius=edge, body=body)


def _condition(rng: np.random.Generator, count: int, stroke: float) -> Condition:
    """A stimulus of `count` actuators that goes no farther sideways than the stroke [mm]."""
    kind = Stimulus(rng.choice(list(Stimulus)))
    amplitude = np.array([stroke * rng.random(), _decades(rng, AMPLITUDE)]) * rng.choice([[1, 1], [1, 0], [0, 1]])
    if kind is Stimulus.HISTORY:
        moves = rng.uniform(-1.0, 1.0, (_whole(rng, ROWS), count, 2))
    elif kind is Stimulus.WAVE:
        cycles, lag = int(_decades(rng, (1.0, CYCLES + 1.0))), rng.uniform(0.0, math.pi)
        time = 2.0 * math.pi * np.arange(1, cycles * ROWS_A_CYCLE + 1) / ROWS_A_CYCLE
        angle = time[:, None] + lag * np.arange(count)
        moves = np.stack([np.sin(angle), np.cos(angle)], axis=2)
    elif kind is Stimulus.REVERSAL:
        times = np.arange(1, _whole(rng, ROWS) + 1)
        moves = np.tile(((-1.0) ** times * times / times[-1])[:, None, None], (1, count, 2))
    else:
        off = np.array([0.0, -AMPLITUDE[1] * (2.0 if kind is Stimulus.AWAY else 1.0)]) / np.maximum(
            amplitude, AMPLITUDE[0]
        )
        moves = np.tile(off, (1 if kind is Stimulus.AWAY else 2, count, 1))
        if kind is Stimulus.RETURN:
            moves[1] = rng.uniform(-1.0, 1.0, (count, 2))
        amplitude = np.maximum(amplitude, AMPLITUDE[0])
    history: FloatArray = moves * amplitude
    time = np.arange(1.0, len(history) + 1.0)
    return Condition(
        name=str(kind),
        dispersion="random",
        phase_deg=0.0,
        time=time,
        normal=history[:, :, 1],
        tangential=history[:, :, 0],
    )


def _apart(row: ActuatorRow, condition: Condition) -> Condition:
    """The condition with so much of the movement against each other that neighbours keep apart."""
    gap = max(float((np.diff(row.positions) - row.width).min(initial=math.inf)), 0.0)
    closer = float(-np.diff(condition.tangential, axis=1).min(initial=0.0))
    if closer <= gap:
        return condition
    together = condition.tangential.mean(axis=1, keepdims=True)
    return replace(condition, tangential=together + gap / closer * (condition.tangential - together))


def _decades(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    """A number between two bounds, each decade as likely."""
    return float(math.exp(rng.uniform(*np.log(bounds))))


def _whole(rng: np.random.Generator, bounds: tuple[int, int]) -> int:
    """A whole number between two bounds, both included."""
    return int(rng.integers(bounds[0], bounds[1] + 1))
