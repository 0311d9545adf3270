"""By which law of contact fingerpad solves what CalculiX solves."""

from __future__ import annotations

from enum import StrEnum


class ContactModel(StrEnum):
    """Contact on fingerpad's side: its own; with CalculiX's penalties; with its turning normal too."""

    OWN = "fingerpad"
    PENALTIES = "fingerpad with penalties"
    TURNING = "fingerpad with penalties and turning normal"
