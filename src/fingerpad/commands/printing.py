"""How subcommands print tables."""

from __future__ import annotations

from collections.abc import Sequence

from ..scene.scene import Scene

GAP = "  "


def titled(scene: Scene) -> str:
    """The line above a device's table: which device, and with which kinematics."""
    return f"{scene.device.title} ({scene.device.name}), {scene.kinematics} strain"


def aligned(lines: Sequence[Sequence[str]], right: Sequence[bool]) -> list[str]:
    """Lines of cells, the header first, with columns of equal width; those of `right` end at the right.

    >>> aligned([["a", "b"], ["long", "1"]], [False, True])
    ['a     b', 'long  1']
    """
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return [
        GAP.join(
            cell.rjust(width) if at_right else cell.ljust(width)
            for cell, width, at_right in zip(line, widths, right, strict=True)
        ).rstrip()
        for line in lines
    ]
