"""Values of `--vary` that a blank has cut off, so that they are taken for something else."""

from __future__ import annotations

import re
from collections.abc import Iterable

NUMBER = re.compile(r"[-+]?[.\d][\d.,e+-]*")  # or several with commas


def hint_of_blanks(arguments: Iterable[str]) -> str:
    """The end of a message on arguments that are all numbers: a blank after a comma cuts values of `--vary` off.

    >>> hint_of_blanks(["0.6"]), hint_of_blanks(["device2"])
    ('; values of --vary are separated by commas alone, or stand in quotes', '')
    """
    is_value = all(NUMBER.fullmatch(each) for each in arguments)
    return "; values of --vary are separated by commas alone, or stand in quotes" if is_value else ""
