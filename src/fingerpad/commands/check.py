"""`fingerpad check`: whether a device file is valid, and a drawing of it."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from tqdm import tqdm

from ..caveats import DEEP
from ..contact_law import Criterion
from ..errors import UsageError
from ..figures.section import section_figure
from ..figures.style import save_as
from ..files import require_folder
from ..mesh import mesh_section, nominal_edges
from ..scene import Scene
from .options import add_scene_options, checked_scene

DESCRIPTION = """\
Check a device file: keys, units, ranges, and whether the device fits the finger. A mistake is answered with file, key,
what was found and what is allowed. With -o the section is drawn with the actuators under it.

examples:
  fingerpad check config/devices/device2.yaml
  fingerpad check config/devices/device2.yaml -o device2.png
"""
TOO_WIDE = (
    "The row is wide for this finger: until all faces are covered it is pressed deeper than half of the pad, which"
    " takes minutes and may have no solution. A narrower row, or contact.criterion: touch, goes less deep."
)
TOO_FAR = "A normal stroke goes deeper than the pad is thick: are displacements in mm?"
STEPS = 3  # of the progress: mesh, figure, picture
PICTURES = (".png", ".pdf", ".svg")


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.set_defaults(run=run)
    parser.description = DESCRIPTION
    parser.add_argument("device", type=Path, metavar="FILE", help="device, as in config/devices")
    parser.add_argument("-o", "--output", type=Path, metavar="PICTURE", help=f"picture to draw ({', '.join(PICTURES)})")
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Validate, say what there is, and draw."""
    picture = options.output
    if picture is not None and picture.suffix not in PICTURES:
        raise UsageError(f"{picture}: found the ending '{picture.suffix}'; allowed: {', '.join(PICTURES)}")
    scene = checked_scene(options.device, options)
    print(f"{options.device}: valid\n{described(scene)}")
    if picture is not None:
        require_folder(picture)
        with tqdm(total=STEPS, desc=scene.device.name, leave=False, disable=None) as bar:
            section = mesh_section(scene, nominal_edges(scene.device.actuators))
            bar.update()
            figure = section_figure(scene.model, section, [scene.device])
            bar.update()
            save_as(figure, picture)
            bar.update()
        print(f"drawn: {picture}")


def described(scene: Scene) -> str:
    """Title, actuators and conditions in words."""
    device, row = scene.device, scene.device.actuators
    kind = "deformable" if row.body else "rigid"
    conditions = ", ".join(condition.name for condition in device.conditions)
    normal, lateral = device.strokes
    distinct = ", ".join(condition.name for condition in device.distinct_conditions)
    alike = f"; distinct stimuli: {distinct}" if len(device.distinct_conditions) < len(device.conditions) else ""
    places = ", ".join(f"{x:g}" for x in row.positions)
    rise, pad = _rise(scene), scene.model.finger.pad_thickness
    deep = scene.model.contact.criterion is Criterion.FULL and rise > DEEP * pad
    return (
        f"{device.title} ({device.name})\n"
        f"{len(row.positions)} {kind} actuators, {row.width:g} mm wide, edge radius {row.edge_radius:g} mm,"
        f" at x = {places} mm\n"
        f"{len(device.conditions)} conditions: {conditions}{alike}\n"
        f"largest stroke {normal:g} mm normal, {lateral:g} mm lateral\n"
        f"skin over the outermost faces lies {rise:.2g} mm above that touched first, on a pad of {pad:g} mm"
        + (f"\n{TOO_WIDE}" if deep else "")
        + (f"\n{TOO_FAR}" if rise + normal > pad else "")
    )


def _rise(scene: Scene) -> float:
    """How far [mm] undeformed skin over the ends of the outermost faces lies above the lowest over any face."""
    finger, row = scene.model.finger, scene.device.actuators
    centre = np.abs(row.positions)
    ends = np.array([max(centre.min() - row.half_face, 0.0), centre.max() + row.half_face])
    lowest, highest = finger.skin_height(ends)
    return float(highest - lowest)
