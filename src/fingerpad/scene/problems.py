"""What is wrong with a file: lines that name key, found, allowed and meant, and one error of the first few."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable

import yaml

from ..errors import SceneError
from ..guess import hint

Problem = tuple[int, str]  # how fundamental (0 is the most), and the line that begins with its key

MOST_REPORTED = 5  # problems in one message [1]
LONGEST_SHOWN = 60  # characters of a found value in a message [1]


def problem(rank: int, key: str, found: str, allowed: str, *, about: str, meant: str = "") -> Problem:
    """A problem in words. about: what the key is. meant: what was probably meant, or nothing."""
    return rank, f"{key}: found {found}; allowed: {allowed}{hint(meant)} ({about})"


def report(path: object, problems: Iterable[Problem]) -> None:
    """Raise the first few problems, if there are any, as one SceneError."""
    ordered = sorted(set(problems))  # by key within a rank: jsonschema has no fixed order
    lines = [f"{path}: {line}" for _, line in ordered[:MOST_REPORTED]]
    if len(ordered) > MOST_REPORTED:
        lines.append(f"{path}: and {len(ordered) - MOST_REPORTED} more")
    if lines:
        raise SceneError("\n".join(lines))


def shown_name(name: object) -> str:
    """A name on one line, in quotes and with codes of its letters if some are look-alikes or cannot be seen."""
    text = str(name)
    return text if text.isascii() and text.isprintable() and text else ascii(text)


def written(value: object) -> str:
    """A value as YAML would write it, on one line, with codes of its letters if some cannot be seen, as blanks that are
    no blank.
    """
    text = yaml.safe_dump(value, default_flow_style=True, allow_unicode=True, width=sys.maxsize)
    line = re.sub("[ \n]+", " ", text.removesuffix("...\n").strip(" \n"))
    return line if line.isprintable() else ascii(line)


def as_python(value: object) -> str:
    """A value in a message as Python writes it, on one line, cut if it is long.

    >>> as_python("10"), as_python(10**5000)
    ("'10'", 'a number of thousands of digits')
    """
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # more digits than Python writes
        text = "a number of thousands of digits"
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ..."


def shown(value: object) -> str:
    """A value in a message: as YAML would write it, cut if it is long."""
    text = written(value)
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]} ..."
