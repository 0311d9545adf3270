"""The options of subcommands that take a scene."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..checkout import find_checkout, model_for, schemas_for
from ..errors import UsageError
from ..files import require_folder
from ..guess import closest, hint
from ..scene.contact_law import Interface
from ..scene.device import Condition
from ..scene.scene import Scene
from ..scene.tissue_law import Kinematics
from ..scene.validation import check_device
from ..scene.variation import NO_VALUES, quantity_at, variants
from ..scene.yamlfile import read_values, read_yaml
from .blanks import hint_of_blanks

PICTURES = (".png", ".pdf", ".svg")
CUT_NUMBER = re.compile(r",\s*(0\d+)\s*(?=[,\]]|$)")  # what a decimal comma leaves of a number
VARIATION = "KEY=VALUE or KEY=VALUE,VALUE, such as contact.friction=0.3,0.6, with a list in brackets"


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    """Options for the model and the schemas; both are found without."""
    parser.add_argument(
        "--config",
        type=Path,
        metavar="FILE",
        help="model (default: config.yaml beside the device file's folder, else that of the checkout)",
    )
    parser.add_argument(
        "--schemas",
        type=Path,
        metavar="FOLDER",
        help="schemas that both files must fit (default: those of fingerpad's own checkout)",
    )


def add_device(parser: argparse.ArgumentParser) -> None:
    """The device file."""
    parser.add_argument("device", type=Path, metavar="FILE", help="device, as in config/devices")


def add_case_options(parser: argparse.ArgumentParser, kinematics: str) -> None:
    """One condition of a device; `kinematics` says what there is to choose between."""
    add_device(parser)
    parser.add_argument("--condition", required=True, metavar="NAME", help="condition of the device")
    parser.add_argument(
        "--interface", required=True, choices=[each.value for each in Interface], help="friction or none"
    )
    add_kinematics(parser, kinematics)


def add_cores(parser: argparse.ArgumentParser) -> None:
    """How many scenes are solved at once."""
    parser.add_argument(
        "--cores",
        type=_positive,
        default=_cores(),
        metavar="N",
        help="solve so many scenes at once, each on one core, with half a GB of memory (default: all that there are"
        " for this process)",
    )


def _cores() -> int:
    """How many cores this process may use [1]: in an allocation of a cluster fewer than the machine has."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _positive(text: str) -> int:
    """A whole number above zero. Raises ArgumentTypeError."""
    if not (text.isascii() and text.isdecimal() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"found {text!r}; allowed: a whole number, at least 1")
    return int(text)


def add_conditions(parser: argparse.ArgumentParser) -> None:
    """The option for some of a device's conditions."""
    parser.add_argument(
        "--condition",
        action="append",
        default=[],
        dest="conditions",
        metavar="NAME",
        help="this condition alone, on a mesh that is made for it; give it again for another (default: all)",
    )


def add_kinematics(parser: argparse.ArgumentParser, what: str) -> None:
    """The kinematics of the tissue; `what` says what there is to choose between."""
    parser.add_argument(
        "--kinematics",
        choices=[each.value for each in Kinematics],
        default=Kinematics.SMALL.value,
        help=f"{what} (default: %(default)s)",
    )


def checked_case(options: argparse.Namespace) -> tuple[Scene, Condition, Interface]:
    """The scene, condition and interface of the options. Raises SceneError, UsageError."""
    scene = asked_scene(options)
    return scene, scene.device.condition(options.condition), scene.device.interface(options.interface)


def checked_scene(device: Path, options: argparse.Namespace, values: Mapping[str, Any] = NO_VALUES) -> Scene:
    """The scene of a device file and the options, with some values in place of those in the files.

    Raises SceneError, and UsageError without a checkout.
    """
    found = existing_file(device)
    config, schemas = model_for(found, options.config), schemas_for(options.schemas)
    return check_device(found, schemas, config, values)


def asked_scene(options: argparse.Namespace) -> Scene:
    """The scene of the options' device, with the kinematics that they ask for. Raises as `checked_scene`."""
    return checked_scene(options.device, options).with_kinematics(Kinematics(options.kinematics))


def add_picture(parser: argparse.ArgumentParser, what: str) -> None:
    """The option for a picture; `what` says what it shows."""
    parser.add_argument(
        "-o", "--output", type=Path, metavar="PICTURE", help=f"{what} ({', '.join(PICTURES)}); replaced if it is there"
    )


def picture_of(options: argparse.Namespace) -> Path | None:
    """The picture that the options ask for. Raises UsageError for a kind that cannot be drawn, and an OSError as
    `require_folder`.
    """
    return None if options.output is None else writable(options.output, PICTURES)


def writable(output: Path, endings: Sequence[str]) -> Path:
    """That file, if it can be written. Raises UsageError unless it has one of the endings, and an OSError as
    `require_folder`.
    """
    if output.suffix not in endings:
        raise UsageError(f"{output}: found the ending '{output.suffix}'; allowed: {', '.join(endings)}")
    require_folder(output)
    return output


def add_forms(parser: argparse.ArgumentParser, as_json: str, as_csv: str) -> None:
    """The forms for programs, in place of text for people; what each holds."""
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--json", action="store_true", help=f"print {as_json}")
    how.add_argument("--csv", action="store_true", help=f"print {as_csv}")


def add_no_error(parser: argparse.ArgumentParser) -> None:
    """The option not to estimate errors."""
    parser.add_argument("--no-error", action="store_true", help="skip the coarser solution and the errors")


def add_variation(parser: argparse.ArgumentParser) -> None:
    """The option for values in place of those in the scene files."""
    parser.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="KEY=VALUE[,VALUE]",
        help="take these values in turn, in place of the one in the files; with several keys, all combinations that can"
        " be; the end says in how many of them which scores exceed which others by more than their errors",
    )


def variations(options: argparse.Namespace) -> list[dict[str, Any]]:
    """The combinations of values that the options ask for; one without any if they ask for none. Raises UsageError."""
    vary: dict[str, list[Any]] = {}
    for entry in options.vary:
        key, _, text = entry.partition("=")
        if cut := CUT_NUMBER.search(text):
            raise UsageError(f"--vary: found '{cut[1]}' in '{entry}'; allowed: numbers with a point, as 0.{cut[1]}")
        values = read_values(text)
        if not (key.strip() and values):
            raise UsageError(f"--vary: found '{entry}'; allowed: {VARIATION}")
        vary.setdefault(key.strip(), []).extend(values)
    return variants(vary)


def require_lists(device: Path, options: argparse.Namespace) -> None:
    """Raise UsageError where --vary has no brackets about the values of a list, or has them about those of a number."""
    if not options.vary:
        return
    checked_scene(device, options)  # files are right as they stand before anything in them is varied
    documents = {file: read_yaml(file) for file in (device, model_for(device, options.config))}
    for entry in options.vary:
        key, _, text = entry.partition("=")
        values, bare = read_values(text), text.strip().removeprefix("[").removesuffix("]")
        is_list = isinstance(quantity_at(key.strip(), documents)["value"], list)
        if is_list and not any(isinstance(each, list) for each in values):
            allowed, meant = "a list in brackets, as the file has it", f"{key}=[{bare}]"
        elif not is_list and len(values) == 1 and isinstance(values[0], list):
            allowed, meant = "values without brackets", f"{key}={bare}"
        else:
            continue
        raise UsageError(f"--vary: found '{entry}'; allowed: {allowed}{hint(meant)}")


def existing_file(device: Path) -> Path:
    """That file. Raises UsageError that names the device file that was probably meant if there is none."""
    if device.is_file():
        return device
    found, folders = "no such file", [device.parent]
    if device.is_dir() or device.is_symlink():
        found = "a folder" if device.is_dir() else "a link to nothing"
    with suppress(UsageError):
        folders.insert(0, find_checkout(Path.cwd()).devices)  # of two of one name that beside it is meant
    known = {path.stem: path for folder in folders for path in sorted(folder.glob("*.yaml")) if path.is_file()}
    stem = "" if device.is_dir() else closest(device.stem, known)
    meant = hint(os.path.relpath(known[stem]) if stem else "")
    meant = meant or hint_of_blanks([str(device)])
    raise UsageError(f"{device}: found {found}; allowed: a device file, such as those in config/devices{meant}")
