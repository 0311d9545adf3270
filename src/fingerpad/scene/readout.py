"""What is read at the receptors, where, and how it is filtered."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import isfinite

from ..requirements import require, require_positive


class Readout(StrEnum):
    """What is read at the receptors: SA-1 proxy (strain) or RA-1 proxy (change of strain)."""

    STRAIN = "strain"
    CHANGE_OF_STRAIN = "change_of_strain"


class Side(StrEnum):
    """From which side of the epidermis/dermis interface the strain is read."""

    DERMIS = "dermis"
    EPIDERMIS = "epidermis"


@dataclass(frozen=True)
class ReadoutRule:
    """Where receptors are read (interface above which layer, which side) and over which span the score runs.

    layer_above: name of the layer above the receptor line. side: of the interface. span_margin: length [mm] added to
    the actuator row's span on each side for the area under the curve. Raises SceneError if that is negative or not
    finite.
    """

    layer_above: str
    side: Side
    span_margin: float

    def __post_init__(self) -> None:
        require(
            isfinite(self.span_margin) and self.span_margin >= 0.0,
            f"readout: span_margin must be a number >= 0, found {self.span_margin}",
        )


@dataclass(frozen=True)
class GaborFilter:
    """Gabor filter: wavelength [mm] of each read-out, width sigma [mm], largest grid spacing [mm].

    Raises SceneError unless all are positive.
    """

    wavelength_strain: float
    wavelength_change: float
    sigma: float
    spacing: float

    def __post_init__(self) -> None:
        require_positive("filter", **vars(self))

    def wavelength(self, readout: Readout) -> float:
        """Wavelength [mm] for a read-out."""
        return self.wavelength_strain if readout is Readout.STRAIN else self.wavelength_change
