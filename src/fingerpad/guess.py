"""What was probably meant, where a name is none of those that are known."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

SIMILAR = 0.7  # likeness of words [1] above which one is taken for the other (difflib's); source: chosen
SHORT = 3  # letters of a word [1] that says too little for another that contains it to be meant; source: chosen
TYPED = str.maketrans({",": ".", "\N{MINUS SIGN}": "-", "\N{EN DASH}": "-"})  # of numbers, as they are typeset


def closest(found: object, known: Iterable[str]) -> str:
    """The known name that contains what was found or else is most similar to it, or nothing; in small letters or not.

    >>> closest("alternat", ["alternate", "phased"]), closest("PITCH", ["actuators.pitch"]), closest("x", ["xyz"])
    ('alternate', 'actuators.pitch', '')
    """
    text, names = str(found).lower(), {name.lower(): name for name in known}
    longer = [name for name in names if len(text) > SHORT and text in name]
    meant = longer or get_close_matches(text, names, 1, SIMILAR)
    return names[meant[0]] if meant else ""


def hint(meant: str, quote: str = "") -> str:
    """The end of a message that asks whether that was meant, in quotes if given; nothing if nothing was.

    >>> hint("alternate", "'"), hint("")
    ("; did you mean 'alternate'?", '')
    """
    return f"; did you mean {quote}{meant}{quote}?" if meant else ""
