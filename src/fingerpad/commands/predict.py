"""`fingerpad predict`: scores with their errors, as a table, JSON or CSV."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..checkout import model_for
from ..csvrows import listed
from ..errors import UsageError
from ..prediction.forecast import steps
from ..prediction.orders import orders
from ..prediction.side_by_side import forecasts
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..scene.validation import possible
from ..scene.variation import quantity_at
from ..scene.yamlfile import read_yaml
from .options import (
    add_conditions,
    add_cores,
    add_forms,
    add_kinematics,
    add_no_error,
    add_picture,
    add_scene_options,
    add_variation,
    checked_scene,
    picture_of,
    require_lists,
    variations,
)
from .printing import as_csv, require_scores
from .progress import progress
from .score_table import as_table, named

DESCRIPTION = """\
Predict the roughness scores of devices, as `snakemake all` does, without running it. Scores come with their estimated
discretisation errors, from a second solution on a coarser mesh. Rank 1 is the largest score of a device, interface and
read-out: predicted roughest. A range such as 1-3 means that errors leave the rank open, a question mark that the error
is not known. Caveats follow below the table. Ranks compare stimuli of one device; whether scores of two devices compare
has not been tested.

examples:
  fingerpad predict config/devices/device2.yaml
  fingerpad predict --no-error config/devices/*.yaml
  fingerpad predict --kinematics finite config/devices/device2.yaml
  fingerpad predict --condition alternate_000 --condition alternate_180 config/devices/device2.yaml
  fingerpad predict --json config/devices/device2.yaml > device2.json
  fingerpad predict --vary contact.friction=0.3,0.6,1.0 config/devices/device2.yaml
  fingerpad predict --vary actuators.pitch=1.5,2,2.5,3 -o pitch.png config/devices/device2.yaml
"""

ONE_TABLE = "ranks compare the stimuli of one table; whether scores of several devices compare has not been tested"


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("devices", type=Path, nargs="+", metavar="FILE", help="device, as in config/devices")
    add_forms(parser, "a list of objects, one a score", "the columns of results/scores.csv, ranks and caveats")
    add_no_error(parser)
    add_conditions(parser)
    add_kinematics(parser, "of the tissue: small displacements and strains, or finite ones, which take longer")
    add_variation(parser)
    add_cores(parser)
    add_picture(parser, "draw the scores against the values of the key that --vary gives several")
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Solve every variant of every device; print each table once it is there, as text or CSV, or all scores as JSON,
    which are those that are there if it is interrupted.

    Raises ContactError if there is none, UsageError for a picture that cannot be drawn.
    """
    kinematics, varied, error = Kinematics(options.kinematics), variations(options), not options.no_error
    picture = picture_of(options)
    files = list({file.resolve(): file for file in options.devices}.values())  # each once
    key = _drawn_key(files, varied) if picture else ""
    is_text = not (options.json or options.csv)
    devices = [_scenes(file, options, kinematics, varied) for file in files]
    rows: list[dict[str, Any]] = []
    predictions: list[list[dict[str, Any]]] = []
    tasks = [(scene, error) for cases, _ in devices for _, scene in cases]
    try:
        with progress(sum(steps(*task) for task in tasks)) as bar:
            solved = forecasts(tasks, options.cores, bar.update)
            for cases, refused in devices:
                tables: dict[str, list[dict[str, Any]]] = {}
                for values, scene in cases:
                    bar.set_description(scene.device.name)
                    predicted = tables[named(values)] = next(solved)
                    predictions.append(predicted)
                    found = [values | row for row in predicted]
                    if options.csv:
                        bar.write(as_csv(found, header=not rows), end="")
                    elif is_text:
                        bar.write(("\n" if rows else "") + as_table(scene, predicted, values))
                    sys.stdout.flush()
                    rows += found
                if is_text and len(cases) > 1:
                    title = f"{cases[0][1].device.name}, {kinematics} strain: {len(cases)} variants"
                    said = orders(tables) if error else ["orders need errors: leave out --no-error"]
                    bar.write("\n".join(["", title, *said]))
                for why in refused:
                    bar.write(f"left out: {why}", file=sys.stdout if is_text else sys.stderr)
            if is_text and len(predictions) > 1:
                bar.write(f"\n{ONE_TABLE}")
    finally:
        if options.json:
            print(json.dumps(rows, indent=2))
    require_scores(rows)
    if picture:
        documents = {file: read_yaml(file) for file in (files[0], model_for(files[0], options.config))}
        unit = str(quantity_at(key, documents)["unit"])
        cases, _ = devices[0]
        _draw(picture, key, unit, [values[key] for values, _ in cases], [scene for _, scene in cases], predictions)
        if is_text:
            print(f"drawn: {picture}")


def _scenes(
    device: Path, options: argparse.Namespace, kinematics: Kinematics, varied: Sequence[dict[str, Any]]
) -> tuple[list[tuple[dict[str, Any], Scene]], list[str]]:
    """The scenes of a device's combinations of values, and why others are left out. Raises as `require_lists` and
    `possible`.
    """
    require_lists(device, options)
    return possible(
        varied,
        lambda values: (
            checked_scene(device, options, values).with_asked(options.conditions).with_kinematics(kinematics)
        ),
    )


def _draw(
    picture: Path,
    key: str,
    unit: str,
    values: Sequence[Any],
    scenes: Sequence[Scene],
    predictions: Sequence[Sequence[Mapping[str, Any]]],
) -> None:
    """Draw the scores of scenes against the values [unit] of the key in which these differ."""
    # what draws takes as long to load as all else
    from ..figures.style import save_as  # noqa: PLC0415
    from ..figures.variation import variation_figure  # noqa: PLC0415

    save_as(variation_figure(key, unit, values, scenes, predictions), picture)


def _drawn_key(devices: Sequence[Path], varied: Sequence[Mapping[str, Any]]) -> str:
    """The key of the values against which scores are drawn. Raises UsageError unless there is one, and one device."""
    several = [key for key in varied[0] if any(values[key] != varied[0][key] for values in varied)]
    if len(devices) != 1 or len(several) != 1:
        found = f"{len(devices)} devices" if len(devices) != 1 else listed(several) or "no key with several values"
        raise UsageError(f"-o: found {found}; allowed: one device, and one key with several values in --vary")
    return several[0]
