"""Names of devices, which are those of their files, and parts of others."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import SceneError
from ..guess import closest
from .meant import RESERVED, as_name
from .problems import problem, report, shown, shown_name

LONGEST_NAME = 64  # characters of a device's name [1]; source: as in the schemas
NAME = f"small letters, digits and underscores that begin with a letter, at most {LONGEST_NAME}"
YAML_ENDINGS = {".yaml", ".yml"}


def known_devices(folder: Path) -> list[str]:
    """The names of the devices in a folder: the stems of its YAML files, sorted. Hidden files are left out.

    Raises SceneError if there is no such folder, or if a file's name cannot be a device's.

    >>> known_devices(Path("config/devices"))
    ['device1', 'device2', 'device3']
    """
    if not folder.is_dir():
        raise SceneError(f"{folder}: is not a folder; it should hold one YAML file for each device")
    files = [p for p in folder.iterdir() if p.suffix.lower() in YAML_ENDINGS and not p.name.startswith(".")]
    for path in sorted(files):
        require_name(path)
    return sorted(path.stem for path in files)


def require_device(name: str, folder: Path) -> Path:
    """The file of a device. Raises SceneError that names the known devices if there is none of that name."""
    known = known_devices(folder)
    if name not in known:
        allowed, meant = ", ".join(known) or "none, as there is no file yet", closest(name, known)
        found = f"{shown(name)}, which has no file"
        report(folder, [problem(0, "device", found, allowed, meant=meant, about="a device's file name without .yaml")])
    return folder / f"{name}.yaml"


def _is_name(text: str) -> bool:
    """Whether that may be a device's name."""
    return bool(re.fullmatch("[a-z][a-z0-9_]*", text)) and len(text) <= LONGEST_NAME and text not in RESERVED


def _allowed_name(found: str) -> str:
    """What may be a device's name, where what was found may not."""
    return f"a name other than {', '.join(sorted(RESERVED))}" if found in RESERVED else NAME


def require_name(path: Path) -> None:
    """Raise SceneError for a device file whose name cannot be part of other files' names."""
    fits = _is_name(path.stem)
    if not fits or path.suffix != ".yaml":
        allowed = f"{_allowed_name(path.stem)}, then .yaml"
        meant = path.stem if fits else as_name(path.stem)
        file = f"{meant}.yaml" if meant and path.suffix.lower() in YAML_ENDINGS else ""
        about = "the file name is the device's name"
        report(path, [problem(0, "file name", shown_name(path.name), allowed, meant=file, about=about)])


def require_new_name(name: str) -> None:
    """Raise SceneError for what cannot be the name of a new device."""
    if not _is_name(name):
        stem, about = name.removesuffix(".yaml"), "name of a device, and of its file without .yaml"
        meant = as_name(stem) or (stem if stem.isidentifier() and stem.isascii() and stem != name else "")
        raise SceneError(problem(0, "NAME", shown_name(name), _allowed_name(stem), meant=meant, about=about)[1])
