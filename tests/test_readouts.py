"""Principal strain, Gabor filter and score against what can be worked out by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from fingerpad.errors import SceneError
from fingerpad.readouts.comparison import is_constant
from fingerpad.readouts.gabor import filtered_readouts, gabor_filtered
from fingerpad.readouts.resampling import resampling_to_grid
from fingerpad.readouts.roughness import roughness_score
from fingerpad.readouts.strain import maximum_principal, read_receptors
from fingerpad.scene.readout import GaborFilter, Readout

SIGMA = 1.12
REACH = 6.0  # widths sigma [1] within which the kernel lies; source: docs/model.md


def test_principal_strain_equals_the_largest_eigenvalue() -> None:
    """Of the three-dimensional strain tensor of plane strain, for random strains of about one, but for rounding."""
    rows = np.random.default_rng(2).standard_normal((200, 3))
    tensors = np.zeros((200, 3, 3))
    tensors[:, 0, 0], tensors[:, 1, 1] = rows[:, 0], rows[:, 1]
    tensors[:, 0, 1] = tensors[:, 1, 0] = rows[:, 2] / 2.0
    assert np.abs(maximum_principal(rows.ravel()) - np.linalg.eigvalsh(tensors)[:, -1]).max() < 1e-14


def test_a_change_of_rounding_is_none() -> None:
    """The solver's tolerance leaves a billionth of strain; what changes by less has not changed."""
    before = np.array([0.1, -0.2, 0.05])
    for share, changed in ((1e-12, False), (1e-6, True)):
        read = read_receptors(np.array([before, before * (1.0 + share)]), np.zeros(1))
        assert read.change_of_strain.any() == changed


def test_readout_of_a_cycle_is_taken_at_its_peak() -> None:
    """Of several times, the one with the largest change."""
    before, *along = np.array([0.1, 0.1, 0.3, 0.2])[:, None] * np.array([1.0, 0.0, 0.0] * 2)
    found = read_receptors(np.array([before, *along]), np.array([0.0, 1.0]))
    assert found.time == 1
    assert found.strain == pytest.approx([0.3, 0.3])
    assert found.change_of_strain == pytest.approx([0.2, 0.2])


def test_of_times_that_mirror_the_first_is_read() -> None:
    """Rounding may leave either one larger, here the second by a billionth; by a hundredth, it is larger."""
    for more, read in ((1e-9, 0), (1e-2, 1)):
        exx = np.array([np.zeros(4), [0.2, 0.1, 0.0, 0.0], np.array([0.0, 0.0, 0.1, 0.2]) * (1.0 + more)])
        components = np.stack([exx, np.zeros_like(exx), np.zeros_like(exx)], axis=2).reshape(3, -1)
        assert read_receptors(components, np.arange(4.0)).time == read


@pytest.mark.parametrize("finer", ["left", "right"])
def test_the_peak_does_not_depend_on_where_receptors_lie_close(finer: str) -> None:
    """Half of the line changes by 0.2, then the other half by 0.3: the latter is more, whichever has more receptors."""
    left = np.linspace(-1.0, 0.0, 101 if finer == "left" else 6)
    right = np.linspace(0.0, 1.0, 101 if finer == "right" else 6)
    arc = np.concatenate([left, right[1:]])
    exx = np.array([np.zeros(arc.size), np.where(arc < 0.0, 0.2, 0.0), np.where(arc < 0.0, 0.0, 0.3)])
    components = np.stack([exx, np.zeros_like(exx), np.zeros_like(exx)], axis=2).reshape(3, -1)
    assert read_receptors(components, arc).strain.max() == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("other", "mirrors", "rivals"),
    [
        ([0.0, 0.0, 0.0, 0.99, 0.0], True, False),  # but for 1 %, the mirror image of what is read
        ([0.0, 0.0, 0.0, 0.99, 0.0], False, True),  # which is another pattern to a row that does not mirror
        ([0.0, 0.99, 0.0, 0.0, 0.0], True, False),  # as just beside the peak
        ([0.0, 0.99, 0.0, 0.0, 0.0], False, False),
        ([0.0, 0.0, 0.99, 0.0, 0.0], True, True),
        ([0.0, 0.0, 0.94, 0.0, 0.0], True, False),  # as people may tell apart
    ],
)
def test_a_time_that_may_as_well_be_read_is_a_rival(other: list[float], mirrors: bool, rivals: bool) -> None:
    """Five receptors, of which one is stretched by 1 at the time that is read, the second after one of settling."""
    peak = np.array([0.0, 1.0, 0.0, 0.0, 0.0])
    exx = np.array([np.zeros(5), 0.9 * peak, peak, other])
    components = np.stack([exx, np.zeros_like(exx), np.zeros_like(exx)], axis=2).reshape(4, -1)
    reading = read_receptors(components, np.arange(5.0), settling=1, mirrors=mirrors)
    assert (reading.time, reading.rival) == (1, 2 if rivals else 1)
    assert reading.rivalled is rivals
    assert reading.rival_change.tolist() == (other if rivals else peak.tolist())
    assert reading.rival_peak == pytest.approx(max(other) if rivals else 1.0)


@pytest.mark.parametrize(("beside", "rivals"), [(0.06, False), (0.15, True)])
def test_a_pattern_that_differs_by_a_tenth_is_another(beside: float, rivals: bool) -> None:
    """A peak that has faded by 3 % differs from itself by that alone, less than a twentieth, as all within RIVAL do;
    with some strain at the next receptor by sqrt(0.03^2 + 0.06^2) = 0.07 or by sqrt(0.03^2 + 0.15^2) = 0.15.
    """
    exx = np.array([np.zeros(5), [0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.97, beside, 0.0, 0.0]])
    components = np.stack([exx, np.zeros_like(exx), np.zeros_like(exx)], axis=2).reshape(3, -1)
    reading = read_receptors(components, np.arange(5.0))
    assert (reading.time, reading.rivalled) == (0, rivals)


def test_of_several_rivals_the_most_different_one_counts() -> None:
    """Its score, too, may differ most."""
    exx = np.zeros((4, 5))
    exx[1:, 1:4] = [[1.0, 0.0, 0.0], [0.98, 0.15, 0.0], [0.0, 0.96, 0.0]]
    components = np.stack([exx, np.zeros_like(exx), np.zeros_like(exx)], axis=2).reshape(4, -1)
    reading = read_receptors(components, np.arange(5.0))
    assert (reading.time, reading.rival) == (0, 2)


@pytest.mark.parametrize("wavelength", [2.8, 1.15])
@pytest.mark.parametrize("period", [0.9, 1.15, 2.5])
def test_filter_of_a_cosine(wavelength: float, period: float) -> None:
    """A cosine of period P comes out times the kernel's Fourier transform at 1/P, in the middle of a long grid, but for
    the kernel's tails that are cut off.
    """
    grid = np.linspace(-20.0, 20.0, 4001)
    k, k0 = 2 * np.pi / period, 2 * np.pi / wavelength
    peaks = (np.exp(-((k - sign * k0) ** 2) * SIGMA**2 / 2) for sign in (1, -1))
    gain = SIGMA * np.sqrt(np.pi / 2) * sum(peaks)
    found = gabor_filtered(grid, np.cos(k * grid), wavelength, SIGMA)
    middle = np.abs(grid) < 5.0
    tails = SIGMA * math.sqrt(2.0 * math.pi) * math.erfc(REACH / math.sqrt(2.0))
    assert np.abs(found - gain * np.cos(k * grid))[middle].max() < tails


def test_change_filter_has_almost_no_mean() -> None:
    """The signed area of the filtered change all but vanishes for every stimulus: that is why the score is rectified.
    It is that of the stimulus times the kernel's, but for the tails behind REACH, which are cut off.
    """
    grid = np.linspace(-12.0, 12.0, 2401)
    bump = np.exp(-((grid - 0.7) ** 2))
    filtered = gabor_filtered(grid, bump, 1.15, SIGMA)
    mean = math.exp(-((2.0 * math.pi * SIGMA / 1.15) ** 2) / 2.0)  # of the kernel over its envelope's: 7e-9
    areas = math.sqrt(math.pi) * SIGMA * math.sqrt(2.0 * math.pi)  # of the bump and of the envelope
    tails = areas * math.erfc(REACH / math.sqrt(2.0))
    assert np.trapezoid(filtered, grid) == pytest.approx(areas * mean, abs=tails)
    assert roughness_score(grid, filtered, (-5.0, 5.0)) > 1e-3


def test_score_is_the_rectified_area_over_the_span() -> None:
    """|cos| over whole periods has mean 2 / pi, less (k h)^2 / 12 = 8e-5 of it by the trapezoidal rule; spans that end
    between samples count their share.
    """
    grid = np.linspace(-10.0, 10.0, 4001)
    assert roughness_score(grid, np.cos(2 * np.pi * grid), (-3.0, 3.0)) == pytest.approx(6 * 2 / np.pi, rel=1e-4)
    assert roughness_score(grid, np.ones_like(grid), (-0.0012, 0.0031)) == pytest.approx(0.0043, rel=1e-12)


def test_beyond_the_receptors_a_span_adds_nothing() -> None:
    """A wide row, or a large margin, on a finger whose receptor line ends before."""
    grid = np.linspace(-2.0, 2.0, 401)
    for span, area in (((-5.0, 1.0), 3.0), ((-5.0, 5.0), 4.0), ((3.0, 5.0), 0.0)):
        assert roughness_score(grid, np.ones(401), span) == pytest.approx(area)


def test_resampling_is_cubic_and_finer_grids_change_nothing() -> None:
    """A smooth read-out at uneven receptors is resampled to 5/384 times the fourth power of their spacing times its
    fourth derivative (Hall and Meyer 1976; at its ends it vanishes). Half the grid spacing moves its score by less than
    a tenth of the error that scores aim at (0.5 %), though the rectified integrand has kinks.
    """
    arc = np.sort(np.random.default_rng(3).uniform(-10, 10, 400))
    arc = np.unique(np.concatenate([-arc, arc, [-10.0, 10.0]]))
    strain = np.exp(-(arc**2) / 4) * np.cos(3 * arc)
    found = resampling_to_grid(arc, 0.02)
    assert np.diff(found.grid).max() <= 0.02 + 1e-12
    resampled, derivative = found.weights @ strain, 108.75  # the fourth, at its largest, which is in the middle
    bound = 5.0 / 384.0 * np.diff(arc).max() ** 4 * derivative
    assert np.abs(resampled - np.exp(-(found.grid**2) / 4) * np.cos(3 * found.grid)).max() < bound
    scores = []
    for spacing in (0.02, 0.01):
        resampling = resampling_to_grid(arc, spacing)
        filtered = filtered_readouts(resampling, dict.fromkeys(Readout, strain), GaborFilter(2.8, 1.15, SIGMA, spacing))
        scores.append(roughness_score(filtered.arc, filtered.filtered(Readout.STRAIN), (-4.0, 4.0)))
    assert scores[0] == pytest.approx(scores[1], rel=5e-4)


@pytest.mark.parametrize(("start", "stop"), [(-1.0, 1.2), (-1.2, 1.0)])
def test_a_grid_ends_where_the_shorter_half_of_the_receptors_does(start: float, stop: float) -> None:
    """Whichever that is: it mirrors, and has no value that is not measured."""
    grid = resampling_to_grid(np.linspace(start, stop, 50), 0.1).grid
    assert grid[[0, -1]].tolist() == [-1.0, 1.0]


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e6])
def test_values_are_constant_up_to_a_share_of_the_largest(scale: float) -> None:
    assert is_constant(scale * np.array([1.0, 1.0 + 1e-10]))
    assert not is_constant(scale * np.array([1.0, 1.0 + 1e-8]))
    assert is_constant(np.zeros(3))


@pytest.mark.parametrize("name", ["wavelength_strain", "wavelength_change", "sigma", "spacing"])
def test_a_filter_has_positive_sizes(name: str) -> None:
    with pytest.raises(SceneError, match=name):
        replace(GaborFilter(2.8, 1.15, 1.12, 0.02), **{name: 0.0})
