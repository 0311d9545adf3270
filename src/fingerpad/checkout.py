"""The checkout in which somebody works: where config, devices and schemas are."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .errors import UsageError

# Where the package lies in a checkout, if it was installed from one in place (pip's -e)
OWN = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Checkout:
    """Root folder of a copy of the project."""

    root: Path

    @property
    def config(self) -> Path:
        """The model."""
        return self.root / "config" / "config.yaml"

    @property
    def ensemble(self) -> Path:
        """What its assumptions might be as well."""
        return self.root / "config" / "ensemble.yaml"

    @property
    def devices(self) -> Path:
        """The folder of device files."""
        return self.root / "config" / "devices"

    @property
    def schemas(self) -> Path:
        """The folder of schemas that scene files must fit."""
        return self.root / "workflow" / "schemas"


def find_checkout(start: Path) -> Checkout:
    """The checkout that holds a folder, or else the one that the package is used from. Raises UsageError without any.

    >>> find_checkout(Path.cwd() / "src").root == Path.cwd()
    True
    """
    folder = start.resolve()
    for root in (folder, *folder.parents, OWN):
        found = Checkout(root)
        if (found.schemas / "device.schema.yaml").is_file():
            return found
    raise UsageError(
        f"{folder}: is not in a checkout of fingerpad, which holds config/ and workflow/schemas/; go there, or give"
        " --config and --schemas to a command that has them"
    )


def model_for(device: Path, config: Path | None = None) -> Path:
    """The config.yaml that a device file goes with: the one that is given; or that beside the folder that it lies in,
    as in a folder of scenes; or that of the checkout. Raises UsageError if there is none.

    >>> model_for(Path("config/devices/device2.yaml")) == Path("config/config.yaml").resolve()
    True
    """
    beside = device.parent.resolve().parent / "config.yaml"
    return config or (beside if beside.is_file() else find_checkout(Path.cwd()).config)


def schemas_for(folder: Path | None) -> Path:
    """The folder of schemas that is given; or that which this code goes with; or, of code that was installed without,
    that of the checkout in which somebody works. Raises UsageError if there is none.
    """
    own = Checkout(OWN).schemas
    return folder or (own if own.is_dir() else find_checkout(Path.cwd()).schemas)
