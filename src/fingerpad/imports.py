"""An import of a package without one of its optional, slow dependencies, of which there is no use here."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without(module: str) -> Iterator[None]:
    """While it lasts, an import of that module raises ImportError; later ones find it as ever.

    >>> with without("this"):
    ...     import this
    Traceback (most recent call last):
        ...
    ModuleNotFoundError: import of this halted; None in sys.modules
    """
    loaded = sys.modules.get(module)
    sys.modules[module] = None  # type: ignore[assignment]  # as Python's import system documents
    try:
        yield
    finally:
        if loaded is None:
            del sys.modules[module]
        else:
            sys.modules[module] = loaded
