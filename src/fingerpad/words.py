"""What people read in place of the code's names, and in which units: figures, the report, what commands print."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .scene.contact_law import Interface
from .scene.readout import Readout
from .scene.tissue_law import Kinematics

LONGEST_LABEL = 16  # characters of a name at an axis

READOUT_NAME = {Readout.STRAIN: "Strain", Readout.CHANGE_OF_STRAIN: "Change of strain"}
KINEMATICS_NAME = {Kinematics.SMALL: "small strain", Kinematics.FINITE: "finite strain"}
MODE_ENDING = {
    Kinematics.SMALL: "",
    Kinematics.FINITE: "_finite",
}  # of names of figures that are drawn for all kinematics
INTERFACE_NAME = {Interface.SHEAR: "with shear", Interface.FRICTIONLESS: "without shear"}
SCORE_SCALE = {
    Readout.STRAIN: (1.0, ""),
    Readout.CHANGE_OF_STRAIN: (1e3, "10⁻³ "),
}  # factor [1] and its typeset inverse
TYPESET_UNITS = {"mm2": "mm²"}  # of those in tables, which keep to plain letters
# Per cent of the area in view whose strain colours of maps tell apart, and of its change, of which they tell apart all
# that receptors have besides; the rest is beyond the end of the bar. Strain changes most where no receptors are: at the
# bone and at the edges of faces
COVERED, CHANGE_COVERED = 99.5, 90.0
PERCENT = 100.0
KILO = 1e3  # kPa in a MPa, µm in a mm
MINUS = "\N{MINUS SIGN}"


def typeset(unit: str) -> str:
    """A unit from a table as people read it.

    >>> typeset("mm2"), typeset("mm")
    ('mm²', 'mm')
    """
    return TYPESET_UNITS.get(unit, unit)


def score_label(readout: Readout, unit: str, in_two_lines: bool = False) -> str:
    """Label of a score in a unit such as mm2.

    >>> score_label(Readout.STRAIN, "mm2")
    'Strain score (mm²)'
    """
    gap = "\n" if in_two_lines else " "
    return f"{READOUT_NAME[readout]}{gap}score ({SCORE_SCALE[readout][1]}{typeset(unit)})"


def plain(name: str) -> str:
    """A name from a scene file as text."""
    return name.replace("_", " ")


def shortened(name: str, most: int = LONGEST_LABEL) -> str:
    """A name of that many characters or fewer: of a longer one the middle is left out, as phases stand at the end.

    >>> shortened("every_second_actuator_090")
    'every_s…ator_090'
    >>> shortened("medium_090", 1)
    '…'
    """
    end = most // 2
    return name if len(name) <= most else f"{name[: max(most - 1 - end, 0)]}…{name[len(name) - end :]}"


def counted(conditions: Sequence[Any]) -> str:
    """How many conditions there are."""
    return f"n = {several(len(conditions), 'condition')}"


def enumerated(names: Sequence[str]) -> str:
    """One name or more as a sentence lists them.

    >>> enumerated(["a"]), enumerated(["a", "b", "c"])
    ('a', 'a, b and c')
    """
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def several(count: int, what: str) -> str:
    """A count of things that take an s.

    >>> several(1, "pin"), several(2, "pin")
    ('1 pin', '2 pins')
    """
    return f"{count} {what}{'' if count == 1 else 's'}"
