"""`fingerpad fields`: the full fields of a condition as VTU files, which ParaView opens."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from threadpoolctl import threadpool_limits

from ..errors import UsageError
from ..fields.states import solved_states
from ..fields.vtu import field_meshes, write_path, write_vtu
from ..files import require_folder
from ..prediction.edges import mesh_device
from .options import add_case_options, add_scene_options, checked_case, writable
from .progress import progress

STEPS = 3  # of the progress: mesh, solution, fields
ENDINGS = (".vtu", ".pvd")
STATE = re.compile(r"\d+\.vtu(\.\w+\.part)?")  # or what a killed writer left of one
DESCRIPTION = """\
Write the fields of one condition of a device for ParaView: displacement, strain, stress, layer and contact tractions,
in mm and MPa. A file that ends in .vtu holds the end of the stimulus. With the ending .pvd, say path.pvd, the path to
it is written: pre-indented and at each time of the stimulus, in path/ and path.vtu. With --kinematics finite the
strain is the logarithmic one and the stress Cauchy's.

examples:
  fingerpad fields config/devices/device2.yaml --condition alternate_180 --interface shear -o fields.vtu
  fingerpad fields config/devices/device2.yaml --condition alternate_180 --interface shear -o path.pvd
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_case_options(parser, "small displacements and strains, or finite ones")
    parser.add_argument(
        "-o", "--output", required=True, type=Path, metavar="FILE", help=f"file to write ({', '.join(ENDINGS)})"
    )
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Solve the condition, and write what it does to the section. Raises UsageError for an output of another kind than
    ENDINGS or a path whose folder is a file or holds others than states, and what `checked_case`, `mesh_device` and
    `solved_states` raise.
    """
    output = writable(options.output, ENDINGS)
    folder, last = output.with_suffix(""), output.with_suffix(".vtu")
    if output.suffix == ".pvd":
        require_folder(last)
        if folder.exists() and not folder.is_dir():
            raise UsageError(f"{folder}: found a file; allowed: a folder, or nothing, where states on the way go")
        others = [each.name for each in folder.iterdir() if not STATE.fullmatch(each.name)] if folder.exists() else []
        if others:
            allowed = "states alone, as these on the way go there; choose another name for -o"
            raise UsageError(f"{folder}: found {min(others)} in it; allowed: {allowed}")
    scene, condition, interface = checked_case(options)
    # two threads take longer (decision 14), and results depend on their number
    with progress(STEPS, scene.device.name) as bar, threadpool_limits(1):
        section = mesh_device(scene)
        bar.update()
        states = solved_states(scene, section, condition, interface)
        bar.update()
        if output.suffix == ".pvd":
            write_path(output, folder, last, condition.times, field_meshes(section, scene, states))
        else:
            write_vtu(output, *field_meshes(section, scene, states.last))
        bar.update()
    end = f" at {condition.time[-1]:g} {condition.time_unit}" if condition.time.size > 1 else ""
    on_the_way = " with all times on the way" if output.suffix == ".pvd" else ""
    print(f"written: {output}, the end of the stimulus{end}{on_the_way}")
