"""The command `fingerpad`: one subcommand for each thing that can be done with a scene outside the workflow."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from .condensation import condense_body, condense_section
from .edges import mesh_device
from .errors import FingerpadError
from .export import DeckSettings, input_deck
from .files import write_text
from .scene import Interface
from .solution import contact_problem, indented_state
from .validation import check_device

FAILED = 2  # exit code [1] of anything that a user can mend

EXPORT = """\
Write one condition of a device as an input deck in Abaqus keywords, which CalculiX runs unchanged. Pre-indentation goes
as deep as fingerpad's own.

example:
  fingerpad export config/devices/device2.yaml --condition alternate_090 --interface shear -o scene.inp
  ccx -i scene
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; its exit code. A FingerpadError is printed as one line."""
    options = _parser().parse_args(arguments)
    try:
        options.run(options)
    except FingerpadError as error:
        print(f"fingerpad: {error}", file=sys.stderr)
        return FAILED
    except OSError as error:
        print(f"fingerpad: {error.filename}: {error.strerror}", file=sys.stderr)
        return FAILED
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="fingerpad", description="Predicts how rough a distributed haptic device feels."
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_export(commands)
    return parser


def _add_export(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "export",
        help="write a condition as an input deck for Abaqus or CalculiX",
        description=EXPORT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("device", type=Path, metavar="DEVICE_FILE", help="device, as in config/devices")
    parser.add_argument("--condition", required=True, metavar="NAME", help="condition of the device")
    parser.add_argument("--interface", required=True, type=Interface, choices=list(Interface), help="friction or none")
    parser.add_argument("-o", "--output", required=True, type=Path, metavar="FILE", help="deck to write")
    parser.add_argument(
        "--config", type=Path, default=Path("config/config.yaml"), metavar="FILE", help="model (default: %(default)s)"
    )
    parser.add_argument(
        "--schemas",
        type=Path,
        default=Path("workflow/schemas"),
        metavar="FOLDER",
        help="schemas that both files must fit (default: %(default)s)",
    )
    parser.add_argument(
        "--friction-from",
        choices=["indentation", "stimulus"],
        default="indentation",
        help="when friction begins to act; 'stimulus' indents without it and converges better (default: %(default)s)",
    )
    for flag, default, what in (
        ("--pressure-slope", 500.0, "pressure over penetration [MPa/mm]"),
        ("--stick-slope", 100.0, "shear over elastic slip [MPa/mm]"),
    ):
        parser.add_argument(flag, type=float, default=default, metavar="NUMBER", help=f"{what} (default: %(default)g)")
    for flag, increments, what in (
        ("--indentation-increments", 20, "of pre-indentation"),
        ("--stimulus-increments", 4, "of each time of the stimulus"),
        ("--rest-increments", 3, "at rest after each of them"),
    ):
        parser.add_argument(
            flag, type=int, default=increments, metavar="N", help=f"increments {what} (default: %(default)d)"
        )
    parser.set_defaults(run=_export)


def _export(options: argparse.Namespace) -> None:
    """Mesh the scene, find how deep it is indented, and write the deck."""
    scene = check_device(options.device, options.schemas, options.config)
    condition = scene.device.condition(options.condition)
    section = mesh_device(scene)
    acting = scene.model.contact.coefficient(options.interface)
    indenting = acting if options.friction_from == "indentation" else 0.0
    body = condense_body(scene) if scene.device.actuators.body else None
    interface = Interface.SHEAR if indenting > 0.0 else Interface.FRICTIONLESS
    problem = contact_problem(scene, condense_section(section, scene), body, interface)
    settings = DeckSettings(
        float(indented_state(scene, problem).actuator[0, 1]),
        indenting,
        acting,
        options.pressure_slope,
        options.stick_slope,
        options.indentation_increments,
        options.stimulus_increments,
        options.rest_increments,
    )
    write_text(options.output, input_deck(scene, section, condition, settings))


if __name__ == "__main__":
    sys.exit(main())
