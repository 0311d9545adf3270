"""Gabor filter of a receptor read-out on a uniform arc-length grid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray
from ..scene.readout import GaborFilter, Readout
from .strain import Resampling

REACH = 6.0  # widths sigma [1] at which the kernel ends; source: exp(-18) = 1.5e-8 of its peak


@dataclass(frozen=True)
class FilteredReadouts:
    """Read-outs of one condition on the uniform grid, before and after the filter.

    arc: (k,) [mm]. strain, change_of_strain: (k,) [1]. filtered_strain, filtered_change_of_strain: (k,) [mm].
    """

    arc: FloatArray
    strain: FloatArray
    change_of_strain: FloatArray
    filtered_strain: FloatArray
    filtered_change_of_strain: FloatArray

    def unfiltered(self, readout: Readout) -> FloatArray:
        """The read-out (k,) [1] before the filter."""
        return self.strain if readout is Readout.STRAIN else self.change_of_strain

    def filtered(self, readout: Readout) -> FloatArray:
        """The filtered read-out (k,) [mm]."""
        return self.filtered_strain if readout is Readout.STRAIN else self.filtered_change_of_strain


def filtered_readouts(
    resampling: Resampling, readouts: Mapping[Readout, FloatArray], gabor: GaborFilter
) -> FilteredReadouts:
    """Both read-outs at receptors (m,), resampled to the uniform grid and filtered."""
    grid = resampling.grid
    sampled = {each: resampling.weights @ readouts[each] for each in Readout}
    filtered = {each: gabor_filtered(grid, sampled[each], gabor.wavelength(each), gabor.sigma) for each in Readout}
    return FilteredReadouts(
        arc=grid,
        strain=sampled[Readout.STRAIN],
        change_of_strain=sampled[Readout.CHANGE_OF_STRAIN],
        filtered_strain=filtered[Readout.STRAIN],
        filtered_change_of_strain=filtered[Readout.CHANGE_OF_STRAIN],
    )


def kernel(wavelength: float, sigma: float, spacing: float) -> tuple[FloatArray, FloatArray]:
    """Offsets x (2k+1,) [mm] and Gabor kernel g = cos(2 pi x / wavelength) exp(-x^2 / (2 sigma^2)) there [1]."""
    reach = int(np.ceil(REACH * sigma / spacing))
    x: FloatArray = spacing * np.arange(-reach, reach + 1, dtype=np.float64)
    weights: FloatArray = np.cos(2.0 * np.pi * x / wavelength) * np.exp(-(x**2) / (2.0 * sigma**2))
    return x, weights


def gabor_filtered(grid: FloatArray, values: FloatArray, wavelength: float, sigma: float) -> FloatArray:
    """Convolution (k,) [mm] of a read-out on a uniform grid with the Gabor kernel: sum of g(x - x') s(x') dx'.

    Source: Chatterjee et al. 2024, methods. Outside the grid the read-out is taken as zero: the grid spans the whole
    pad, so its ends are far from the device.

    >>> grid = np.linspace(-10.0, 10.0, 2001)
    >>> bool(abs(gabor_filtered(grid, np.zeros(2001), 2.8, 1.12)).max() == 0.0)
    True
    """
    spacing = float(grid[1] - grid[0])
    _, weights = kernel(wavelength, sigma, spacing)
    full = np.convolve(values, weights)
    start = (weights.size - 1) // 2
    return full[start : start + values.size] * spacing
