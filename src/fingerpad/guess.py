"""What was probably meant, where a name is none of those that are known."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def closest(found: str, known: Iterable[str]) -> str:
    """The known name that is most similar to one that was found, or nothing.

    >>> closest("alternat", ["alternate", "phased"]), closest("x", ["alternate"])
    ('alternate', '')
    """
    return next(iter(get_close_matches(found, list(known), n=1)), "")


def hint(meant: str, quote: str = "") -> str:
    """The end of a message that asks whether that was meant, in quotes if given; nothing if nothing was.

    >>> hint("alternate", "'"), hint("")
    ("; did you mean 'alternate'?", '')
    """
    return f"; did you mean {quote}{meant}{quote}?" if meant else ""
