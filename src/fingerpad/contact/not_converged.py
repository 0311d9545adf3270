"""An increment that did not converge, and why, as far as that is known."""

from __future__ import annotations

from ..errors import ContactError, ConvergenceError

LARGER_COUNTS = "try larger numerics.indentation_increments and numerics.stimulus_increments, or vibration.steps"


class NotConvergedError(Exception):
    """An increment did not converge: it is to be halved. residual: that was left [1]. reason: the error, with what may
    help as its message, in which the path ends if halves do not converge either; if none is known that more increments
    may.
    """

    def __init__(self, residual: float, reason: ContactError | None = None) -> None:
        super().__init__(residual, reason)
        self.residual = residual
        self.reason = ConvergenceError(LARGER_COUNTS) if reason is None else reason
