"""`fingerpad new`: a device file of one's own, from that of another device."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
from pathlib import Path

from ..checkout import find_checkout, model_for, schemas_for
from ..errors import UsageError
from ..files import replacing, write_text
from ..scene.device_names import require_device, require_new_name
from ..scene.scenefile import recordings
from ..scene.template import device_text
from ..scene.validation import check_device, checked_document
from .options import existing_file

DESCRIPTION = """\
Write config/devices/NAME.yaml with the values of another device and a comment on every key: what it is, its unit, what
is allowed, and how to change the drive. Its sources name the other device. An existing file is never overwritten. With
--scenes the file goes to devices/ in a folder of your own, with the other device's model beside it.

examples:
  fingerpad new mydevice --from device2
  fingerpad new mydevice --from somewhere/else/theirs.yaml
  fingerpad new mydevice --from device2 --scenes mine
"""


def add(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("name", metavar="NAME", help="small letters, digits and underscores; begins with a letter")
    parser.add_argument(
        "--from", dest="source", required=True, metavar="DEVICE", help="a device in config/devices, or a device file"
    )

    parser.add_argument(
        "--scenes",
        type=Path,
        metavar="FOLDER",
        help="write into devices/ of that folder, with a copy of config.yaml beside if it has none (default: config/)",
    )


def run(options: argparse.Namespace) -> None:
    """Read the source, write the new file, with its recordings beside it, and say what comes next. Raises UsageError
    without a checkout, for a source that is no file, and if a file is there already; SceneError.
    """
    checkout = find_checkout(Path.cwd())
    require_new_name(options.name)
    scenes = options.scenes or checkout.config.parent
    for folder in (scenes, scenes / "devices"):
        if folder.exists() and not folder.is_dir():
            raise UsageError(f"{folder}: found a file; allowed: a folder, or nothing")
    target = scenes / "devices" / f"{options.name}.yaml"
    is_file = options.source.endswith(".yaml")
    source = existing_file(Path(options.source)) if is_file else require_device(options.source, checkout.devices)
    model = model_for(source)
    schemas = schemas_for(None)
    check_device(source, schemas, model)
    text = device_text(options.name, source.stem, *checked_document(source, schemas / "device.schema.yaml"))
    copies = {path: target.parent / path.relative_to(source.parent) for path in recordings(source)}
    copies = {path: copy for path, copy in copies.items() if path.resolve() != copy.resolve()}
    for path in (target, *copies.values()):
        if path.exists():
            way = "choose another name" if path == target else f"rename the recording and its `file:` key in {source}"
            raise UsageError(f"{path}: exists already, and is not overwritten; {way}, or remove it")
    if not (own := scenes / "config.yaml").exists():
        copies[model] = own
    for path, copy in copies.items():
        copy.parent.mkdir(parents=True, exist_ok=True)
        with replacing(copy) as part:
            shutil.copyfile(path, part)
    target.parent.mkdir(parents=True, exist_ok=True)
    write_text(target, text)
    shown, how = os.path.relpath(target), _elsewhere(scenes) if options.scenes else []
    if Path.cwd().resolve() != checkout.root:
        how = ["--snakefile", str(checkout.root / "Snakefile"), *(how or ["--directory", str(checkout.root)])]
    following = ["fingerpad", "check", shown], ["fingerpad", "predict", shown], ["snakemake", "all", *how]
    print("\n  ".join([f"{shown}: written. Edit it, then:", *map(shlex.join, following)]))


def _elsewhere(scenes: Path) -> list[str]:
    """Options with which the workflow reads a folder of scenes and keeps what it makes apart from the project's."""
    whole = scenes.resolve()
    return ["--config", f"scenes={whole}", "--directory", f"{whole.name}_results"]
