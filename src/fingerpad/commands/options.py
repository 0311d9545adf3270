"""The options of subcommands that take a scene."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..checkout import find_checkout
from ..scene import Scene
from ..validation import check_device


def add_scene_options(parser: argparse.ArgumentParser) -> None:
    """Options for the model and the schemas; both are found from any folder of a checkout."""
    parser.add_argument(
        "--config", type=Path, metavar="FILE", help="model (default: config/config.yaml of the checkout)"
    )
    parser.add_argument(
        "--schemas",
        type=Path,
        metavar="FOLDER",
        help="schemas that both files must fit (default: workflow/schemas of the checkout)",
    )


def checked_scene(device: Path, options: argparse.Namespace) -> Scene:
    """The scene of a device file and the options. Raises SceneError, and UsageError outside a checkout."""
    config = options.config or find_checkout(Path.cwd()).config
    schemas = options.schemas or find_checkout(Path.cwd()).schemas
    return check_device(device, schemas, config)
