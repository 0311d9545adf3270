"""`fingerpad check`: whether a device file is valid, and a drawing of it."""

from __future__ import annotations

import argparse
import os

import numpy as np

from ..checkout import model_for
from ..prediction.caveats import device_caveats, skin_rises, stimulus_caveats
from ..scene.contact_law import Criterion
from ..scene.device import Device
from ..scene.scene import Scene
from ..tissue.mesh import nominal_mesh
from ..words import several
from .options import add_device, add_picture, add_scene_options, checked_scene, picture_of
from .printing import whose
from .progress import progress

DESCRIPTION = """\
Check a device file: keys, units, ranges, and whether the device fits the finger. Errors name the file, the key, the
value found and what is allowed. With -o the section is drawn with the actuators under it.

examples:
  fingerpad check config/devices/device2.yaml
  fingerpad check config/devices/device2.yaml -o device2.png
"""
PRESSED = {
    Criterion.FULL: "until skin covers all faces",
    Criterion.TOUCH: "until all actuators carry some skin",
    Criterion.DEPTH: "{depth:g} mm deep from first touch",
    Criterion.FORCE: "with {force:g} N per mm of finger",
}
DOMED = "until contact reaches the middle of each"  # as there is no flat face to cover
STEPS = 3  # of the progress: mesh, figure, picture


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_device(parser)
    add_picture(parser, "draw the section with the actuators under it")
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Validate, say what there is, and draw. Raises UsageError for a picture that cannot be drawn, SceneError,
    MeshError.
    """
    picture = picture_of(options)
    scene = checked_scene(options.device, options)
    model = os.path.relpath(model_for(options.device, options.config))
    print(f"{options.device}: valid with {model}\n{described(scene)}")
    if picture is not None:
        # what draws takes as long to load as all else
        from ..figures.section import section_figure  # noqa: PLC0415
        from ..figures.style import letters_without_a_glyph, save_as  # noqa: PLC0415

        with progress(STEPS, scene.device.name) as bar:
            section = nominal_mesh(scene)
            bar.update()
            figure = section_figure(scene.model, section, [scene.device])
            bar.update()
            save_as(figure, picture)
            bar.update()
        print(f"drawn: {picture}")
        if boxes := letters_without_a_glyph(scene.device.title):
            print(f"figures have no letters for {boxes} in the title: they show boxes")


def _unordered_phases(device: Device) -> list[str]:
    """What to doubt of phases that do not ascend, as those of [0, 22,5] with a decimal comma do not."""
    for dispersion in dict.fromkeys(cycle.dispersion for cycle in device.cycles):
        phases = [cycle.phase_deg for cycle in device.cycles if cycle.dispersion == dispersion]
        if phases != sorted(phases):
            listed = ", ".join(f"{phase:g}" for phase in phases)
            return [f"phases do not ascend: {listed}; numbers have a decimal point, and no comma"]
    return []


def described(scene: Scene) -> str:
    """Title, actuators, conditions and contact in words."""
    device, row = scene.device, scene.device.actuators
    actuators = several(len(row.positions), f"{'deformable' if row.body else 'rigid'} actuator")
    conditions = ", ".join(condition.name for condition in device.conditions)
    drives = {
        "normal": [each.normal for each in device.conditions],
        "lateral": [each.tangential for each in device.conditions],
    }
    ranges = {way: (min(map(np.min, moved)), max(map(np.max, moved))) for way, moved in drives.items()}
    moves = " and ".join(
        f"{low:g} to {high:g} mm {way}" for way, (low, high) in ranges.items() if low < 0.0 or high > 0.0
    )
    distinct = ", ".join(condition.name for condition in device.distinct_conditions)
    alike = f"; distinct stimuli: {distinct}" if len(device.distinct_conditions) < len(device.conditions) else ""
    places = ", ".join(f"{x:g}" for x in row.positions)
    law, rise, pad = scene.model.contact, float(skin_rises(scene).max()), scene.model.finger.pad_thickness
    pressed = DOMED if scene.lacks_faces else PRESSED[law.criterion].format(depth=law.depth, force=law.force)
    doubted: dict[str, list[str]] = {}
    for condition in device.conditions:
        for doubt in stimulus_caveats(condition):
            doubted.setdefault(doubt, []).append(condition.name)
    every = [condition.name for condition in device.conditions]
    doubts = [
        *device_caveats(scene),
        *_unordered_phases(device),
        *(f"{whose(names, every)}: {doubt}" for doubt, names in doubted.items()),
    ]
    return (
        f"{device.title} ({device.name})\n"
        f"{actuators}, {row.width:g} mm wide, edge radius {row.edge_radius:g} mm,"
        f" at x = {places} mm\n"
        f"{several(len(device.conditions), 'condition')}: {conditions}{alike}\n"
        f"{f'actuators move {moves} (positive: into the skin, to the right)' if moves else 'actuators rest'}\n"
        f"friction {law.friction:g}; pressed {pressed}, and held\n"
        f"undeformed skin over the outermost faces lies {rise:.2g} mm above first touch; pad thickness {pad:g} mm"
        + "".join(f"\n{doubt}" for doubt in doubts)
    )
