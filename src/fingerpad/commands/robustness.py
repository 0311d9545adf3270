"""`fingerpad robustness`: which assumptions the orders of a device's scores depend on."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, product
from pathlib import Path
from typing import Any

from ..checkout import find_checkout, model_for
from ..ensemble.alternatives import AS_CONFIGURED, Alternative, by_key, read_ensemble
from ..ensemble.robustness import Order, absent_keys, changed, kept_keys, orders_held, reasons, varied_values
from ..errors import SceneError, UsageError
from ..prediction.forecast import steps
from ..prediction.orders import nothing_resolved, unordered
from ..prediction.side_by_side import forecasts
from ..readouts.roughness import rows_of
from ..scene.contact_law import Interface
from ..scene.readout import Readout
from ..scene.scene import Scene
from ..scene.variation import Document
from ..scene.yamlfile import read_yaml
from .options import add_cores, add_device, add_kinematics, add_scene_options, asked_scene, checked_scene
from .printing import as_csv, in_order, require_scores, titled
from .progress import progress
from .score_table import caveat_lines

DESCRIPTION = """\
Tell which assumptions the orders of a device's scores depend on. What config/ensemble.yaml lists is varied, one at a
time: of the model, and of what the device file assumes; the other half of the stimulus' cycle and the other
kinematics, too.
An order holds where two scores differ the same way by more than the errors of both. Errors are those that
`fingerpad predict` states, in proportion to the scores.

examples:
  fingerpad robustness config/devices/device2.yaml
  fingerpad robustness --kinematics finite config/devices/device2.yaml
  fingerpad robustness --csv config/devices/device2.yaml > device2.csv
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    add_device(parser)
    parser.add_argument("--csv", action="store_true", help="print all scores, with what is varied in the first column")
    add_kinematics(parser, "of the tissue, as configured; the other is one of the assumptions")
    add_cores(parser)
    parser.add_argument(
        "--assumptions",
        type=Path,
        metavar="FILE",
        help="what is varied (default: config/ensemble.yaml of the checkout)",
    )
    add_scene_options(parser)


def run(options: argparse.Namespace) -> None:
    """Solve the device as configured, with errors, and once for each assumption; print what becomes of the orders.

    Raises ContactError if nothing can be scored as configured, UsageError where there is nothing to order.
    """
    scene = _distinct(asked_scene(options))
    if len(scene.device.conditions) < 2:
        raise UsageError(f"{scene.device.name}: found one stimulus; allowed: two or more, so that scores have an order")
    assumptions = options.assumptions or find_checkout(Path.cwd()).ensemble
    alternatives, device = read_ensemble(assumptions), read_yaml(options.device)
    try:
        varied, refused = _varied(scene, options, device, alternatives)
    except SceneError as error:
        raise SceneError(f"{assumptions}: {str(error).removeprefix('ensemble: ')}") from error
    for name, why in refused.items():  # once before all is solved, and at the end
        print(f"left out: {name}: {why}", file=sys.stderr)
    total = steps(scene) + sum(steps(each, error=False) for each in varied.values())
    with progress(total, scene.device.name) as bar:
        predicted = forecasts([(scene, True), *((each, False) for each in varied.values())], options.cores, bar.update)
        configured = next(predicted)
        require_scores(configured)
        if options.csv:
            bar.write(_csv_of(AS_CONFIGURED, configured, header=True), end="")
        tables = {}
        for name, rows in zip(varied, predicted, strict=True):
            tables[name] = rows
            if options.csv:
                bar.write(_csv_of(name, rows, header=False), end="")
    if not options.csv:
        kept, absent = kept_keys(device, alternatives), absent_keys(device, alternatives)
        print("\n".join(_told(scene, configured, tables, refused, kept, absent)))


def _csv_of(name: str, rows: Sequence[Mapping[str, Any]], header: bool) -> str:
    """Rows of the score table with the name of what is varied, as CSV."""
    return as_csv([{"varied": name, **row} for row in rows], header)


def _varied(
    scene: Scene, options: argparse.Namespace, device: Document, alternatives: Sequence[Alternative]
) -> tuple[dict[str, Scene], dict[str, str]]:
    """Scenes by the names of the assumptions that are varied in them; and why some names have none. Raises SceneError
    as `varied_values`.
    """
    found: dict[str, Scene] = {}
    refused: dict[str, str] = {}
    config = read_yaml(model_for(options.device, options.config))
    for name, values in varied_values(config, device, alternatives).items():
        try:
            other = checked_scene(options.device, options, values)
            found[name] = _only(other.with_kinematics(scene.kinematics), scene)
        except SceneError as error:  # as a pattern of four actuators is no alternative for three
            refused[name] = str(error)
    for kinematics in scene.device.kinematics:
        if kinematics is not scene.kinematics:
            found[f"kinematics {kinematics}"] = scene.with_kinematics(kinematics)
    return found, refused


def _distinct(scene: Scene) -> Scene:
    """The scene with one condition of each stimulus."""
    return scene.with_conditions(scene.device.distinct_conditions)


def _only(scene: Scene, other: Scene) -> Scene:
    """The scene with the conditions that another one has."""
    known = {each.name for each in other.device.conditions}
    return scene.with_conditions(each for each in scene.device.conditions if each.name in known)


def _told(
    scene: Scene,
    configured: Sequence[Mapping[str, Any]],
    tables: Mapping[str, Sequence[Mapping[str, Any]]],
    refused: Mapping[str, str],
    kept: Sequence[str],
    absent: Sequence[str],
) -> Iterator[str]:
    """Lines that say what becomes of the orders, then what to know of the scores as configured, what was varied, and
    what could not be, was kept or is not there.
    """
    idle = [name for name, rows in tables.items() if not changed(configured, rows)]
    members = {name: rows for name, rows in tables.items() if name not in idle}
    found = orders_held(configured, members)
    yield f"{titled(scene)}: {len(members)} assumptions varied, one at a time"
    if found:
        certain = sum(each.is_certain for each in found)
        yield f"orders that hold wherever there is a prediction: {certain} of {len(found)}"
    else:
        yield nothing_resolved(bool(unordered(configured)))
    for (interface, readout), orders in groupby(found, key=lambda each: (each.interface, each.readout)):
        yield f"\n{interface}, {readout}"
        yield from map(_as_line, orders)
    for case in product(Interface, Readout):
        if unknown := unordered(rows_of(configured, *case)):
            yield f"\n{', '.join(case)}, not ordered, as errors are unknown: {', '.join(unknown)}"
    yield ""
    yield from caveat_lines(scene, [row for row in in_order(configured) if row["score"] is not None])
    yield f"varied: {by_key(members) or 'nothing that has an effect'}"
    if idle:
        yield f"without effect: {', '.join(idle)}"
    if kept:
        yield f"kept, as the file does not call them assumptions: {', '.join(kept)} (but see `predict --vary`)"
    if absent:
        yield f"not in the file: {', '.join(absent)}"
    for name, rows in members.items():
        yield from (f"{name}: {note}" for note in reasons(configured, rows))
    yield from (f"left out: {name}: {why}" for name, why in refused.items())


def _as_line(order: Order) -> str:
    """An order, in how many members it holds, and in which not."""
    kinds = {"open": order.open, "reversed": order.reversed, "no prediction": order.lost}
    others = [f"{kind} with {', '.join(names)}" for kind, names in kinds.items() if names]
    held = f"  {order.low} < {order.high} holds in {len(order.holds)} of {order.scored}"
    return "; ".join([held, *others])
