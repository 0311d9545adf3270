"""Results, for those who look inside them: where they are, which target makes what is missing, and their scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from .checkout import find_checkout
from .errors import MissingResultError, UsageError
from .guess import closest, hint
from .scene.device_names import known_devices
from .scene.scene import Scene
from .scene.validation import check_device

FOLDER = "results"


def results_root(start: Path) -> Path:
    """The nearest folder, from `start` upwards, that holds results. Raises MissingResultError if there is none."""
    for folder in (start.resolve(), *start.resolve().parents):
        if (folder / FOLDER).is_dir():
            return folder
    raise MissingResultError(f"no folder {FOLDER!r} in {start} or above: make it with `snakemake all`")


def needed(root: Path, result: str, target: str | None = None) -> Path:
    """Path of a result, such as results/scores.csv. target: what makes it, if not its own name.

    Raises MissingResultError, with the command to type, if it is not there.
    """
    path = root / result
    if not path.exists():
        raise MissingResultError(f"{result} is not there yet: make it with `snakemake {target or result}`")
    return path


def scenes() -> dict[str, Scene]:
    """Scenes of small kinematics by device: of the folder that SCENES in the environment names, where a rule runs a
    notebook, or else of the checkout's config/. Raises SceneError if one of them is not valid, and as
    `find_checkout`.
    """
    checkout = find_checkout(Path.cwd())
    folder = Path(os.environ.get("SCENES", checkout.config.parent))
    config, devices = folder / "config.yaml", folder / "devices"
    files = {name: devices / f"{name}.yaml" for name in known_devices(devices)}
    return {name: check_device(path, checkout.schemas, config) for name, path in files.items()}


def scene_of_case(known: Mapping[str, Scene], device: str, condition: str, interface: str) -> Scene:
    """The scene of a case, by its names. Raises UsageError if there is no such device, SceneError if it has no such
    condition or is not predicted at such an interface; both name those that there are.
    """
    if device not in known:
        meant = hint(closest(device, known), "'")
        raise UsageError(f"device: found {device!r}; allowed: {', '.join(known)}{meant}")
    scene = known[device]
    scene.device.condition(condition)
    scene.device.interface(interface)
    return scene
