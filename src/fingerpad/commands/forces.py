"""`fingerpad forces`: the forces that actuators have to bear."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import ContactError
from ..prediction.forces import ERROR, NORMAL, TANGENTIAL, force_rows
from ..prediction.forecast import steps
from ..rounding import rounded
from ..scene.contact_law import Interface
from ..scene.scene import Scene
from .options import (
    add_conditions,
    add_device,
    add_forms,
    add_kinematics,
    add_no_error,
    add_scene_options,
    asked_scene,
)
from .printing import aligned, caveats_told, print_rows, read_times, titled
from .progress import progress

PRESSED = "(pre-indented)"  # in place of a condition: all begin there; no condition has such a name
COLUMNS = ("condition", "interface", "actuator", "x", "normal", "tangential", "error")
DESCRIPTION = """\
Print the forces with which every actuator acts on the skin, in N per mm of finger, as the model is a section: normal
into the skin, tangential to the right, after pre-indentation and when each condition is read. They are what actuators
have to bear, and can be compared with what a load cell under your device says. Errors are those of discretisation,
estimated from a second solution on a coarser mesh. --csv and --json hold all times of the stimuli.

examples:
  fingerpad forces config/devices/device2.yaml
  fingerpad forces --kinematics finite config/devices/device2.yaml
  fingerpad forces --csv config/devices/device2.yaml > device2.csv
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_device(parser)
    add_forms(parser, "a list of objects, one an actuator, condition and time", "the same as a table for programs")
    add_no_error(parser)
    add_conditions(parser)
    add_kinematics(parser, "of the tissue: small displacements and strains, or finite ones, which take longer")
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Solve the device and print all forces once they are there. Raises ContactError if there is none."""
    scene = asked_scene(options).with_asked(options.conditions)
    error = not options.no_error
    with progress(steps(scene, error), scene.device.name) as bar:
        rows = force_rows(scene, error, bar.update)
    print_rows(options, rows, lambda: as_table(scene, rows))
    if all(row[NORMAL] is None for row in rows):
        raise ContactError(f"nothing could be solved: {rows[0]['note']}")


def as_table(scene: Scene, rows: Sequence[Mapping[str, Any]]) -> str:
    """Forces after pre-indentation at each interface, and in every condition when it is read; caveats below."""
    lines = [list(COLUMNS)]
    for interface in Interface:
        own = [row for row in rows if row["interface"] == interface and row[NORMAL] is not None]
        lines += [_cells(row, PRESSED) for row in own[: len(scene.device.actuators.positions)]]
        lines += [_cells(row, row["condition"]) for row in own if row["is_read"]]
    every = [condition.name for condition in scene.device.conditions]
    caveats = [f"caveat: {told}" for told in caveats_told(rows, every, lambda _: "forces")]
    right = [False, False, *(True for _ in COLUMNS[2:])]
    unit = "forces on the skin [N/mm of finger], positive into it and to the right; x [mm]"
    forces = [unit, *aligned(lines, right)] if len(lines) > 1 else []
    several = {condition.name for condition in scene.device.conditions if condition.time.size > 1}
    times = read_times(row for row in rows if row["condition"] in several and row["is_read"])
    read = [f"read at time: {times}"] if times else []
    return "\n".join([titled(scene), *forces, *read, *caveats])


def _cells(row: Mapping[str, Any], name: str) -> list[str]:
    """A line of the table: forces as far as their error tells."""
    error = row[ERROR]
    normal, tangential = (rounded(row[way], math.nan if error is None else error)[0] for way in (NORMAL, TANGENTIAL))
    within = "" if error is None else rounded(0.0, error)[1]
    return [name, row["interface"], str(row["actuator"]), f"{row['x_mm']:g}", normal, tangential, within]
