"""Gabor filter of a receptor read-out on a uniform arc-length grid."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import make_interp_spline

from .scene import FloatArray, GaborFilter, Readout
from .strain import FilteredReadouts

REACH = 6.0  # widths sigma [1] at which the kernel ends; source: exp(-18) = 1.5e-8 of its peak


def filtered_readouts(
    arc: FloatArray, strain: FloatArray, change_of_strain: FloatArray, gabor: GaborFilter
) -> FilteredReadouts:
    """Both read-outs at receptors (m,), resampled to the uniform grid and filtered."""
    grid = uniform_grid(arc, gabor.spacing)
    sampled = {
        Readout.STRAIN: resample(arc, strain, grid),
        Readout.CHANGE_OF_STRAIN: resample(arc, change_of_strain, grid),
    }
    filtered = (gabor_filtered(grid, values, gabor.wavelength(key), gabor.sigma) for key, values in sampled.items())
    return FilteredReadouts(grid, *sampled.values(), *filtered)


def uniform_grid(arc: FloatArray, spacing: float) -> FloatArray:
    """Uniform grid (k,) [mm] over the receptor line, symmetric about the mid-line, at most `spacing` apart."""
    half = min(-arc[0], arc[-1])
    count = int(np.ceil(half / spacing))
    return np.linspace(-half, half, 2 * count + 1)


def resample(arc: FloatArray, values: FloatArray, grid: FloatArray) -> FloatArray:
    """Read-out (k,) on the grid by a cubic spline through the receptor points (m,)."""
    return np.asarray(make_interp_spline(arc, values, k=3)(grid))


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
