"""`fingerpad vibrate`: scores of a device's conditions as vibrations."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from ..scene.scene import Scene
from ..vibration.forecast import at_frequencies, steps, vibration_forecast
from ..vibration.frequency import without_caveats
from ..vibration.speed import SLOWLY, frequency_name
from .options import add_conditions, add_device, add_forms, add_scene_options, checked_scene
from .printing import aligned, caveats_told, in_order, print_rows, require_scores, titled
from .progress import progress

DESCRIPTION = """\
Score the conditions of a device as vibrations, as `snakemake frequency` does, without running it: on tissue that
creeps, with small kinematics. Where the tissue's mass matters there is no prediction, and a note says up to which
frequency there is one. "slow" is a cycle in which tissue is always relaxed. No discretisation error is estimated here;
`fingerpad predict` states that of the same conditions as snapshots.

examples:
  fingerpad vibrate config/devices/device2.yaml
  fingerpad vibrate config/devices/device2.yaml --frequency 25 60
  fingerpad vibrate config/devices/device2.yaml --condition alternate_180
  fingerpad vibrate --csv config/devices/device2.yaml > device2.csv
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_device(parser)
    parser.add_argument(
        "--frequency",
        action="extend",
        type=hertz,
        nargs="+",
        default=[],
        metavar="HZ",
        help="frequencies (default: the file's frequency_hz)",
    )
    add_conditions(parser)
    add_forms(parser, "a list of objects, one a score, with caveats", "the columns of results/frequency.csv")
    add_scene_options(parser)


def hertz(text: str) -> float:
    """A frequency [Hz]; all that follows `--frequency` is taken for one."""
    try:
        return float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(
            f"found '{text}'; allowed: numbers [Hz], as in fingerpad vibrate FILE --frequency 10 20"
        ) from error


def run(options: argparse.Namespace) -> None:
    """Vibrate the device, and print all scores once they are there. Raises ContactError if there is none."""
    scene = checked_scene(options.device, options).with_asked(options.conditions)
    scene = at_frequencies(scene, options.frequency)
    with progress(steps(scene), scene.device.name) as bar:
        rows = vibration_forecast(scene, bar.update)
    print_rows(options, without_caveats(rows) if options.csv else rows, lambda: as_table(scene, rows))
    require_scores(rows)


def as_table(scene: Scene, rows: Sequence[Mapping[str, Any]]) -> str:
    """A table for each interface and read-out with scores, one line per condition and one column per frequency; then
    the caveats.
    """
    frequencies = (SLOWLY, *scene.device.frequencies)
    header = ["condition", *map(frequency_name, frequencies)]
    parts = [titled(scene)]
    for (interface, readout), group in groupby(in_order(rows), key=lambda row: (row["interface"], row["readout"])):
        own = list(group)
        if all(row["score"] is None for row in own):
            continue
        cells = [
            [name, *("-" if row["score"] is None else f"{row['score']:.4g}" for row in condition)]
            for name, condition in groupby(own, key=lambda row: str(row["condition"]))
        ]
        right = [False, *(True for _ in frequencies)]
        parts.append("\n".join([f"{interface}, {readout} [{own[0]['unit']}]", *aligned([header, *cells], right)]))
    every = [cycle.name for cycle in scene.device.cycles]
    told = caveats_told(rows, every, lambda row: frequency_name(row["frequency_hz"]))
    return "\n\n".join([*parts, "\n".join(told)]).rstrip()
