"""Fits of maxima: known distributions, scipy, invariance, coverage of intervals, Gaussian seas."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats
from tests.errors import wrong
from tests.verification.test_sampling import STEP, gaussian_seas, jonswap

from hydrodae.study.extremes.distributions import FAMILIES, gev_loss, gpd_loss, steps
from hydrodae.study.extremes.fit import FEWEST, Fit, fit_maxima
from hydrodae.study.extremes.gumbel import fit_gumbel
from hydrodae.study.extremes.peaks import Record, block_maxima, clusters, extremal_index
from hydrodae.study.extremes.rayleigh import Narrow, interval, largest
from hydrodae.support.arrays import Array

#: scipy's genextreme has the opposite sign of the shape.
TRUE = {
    "gev": stats.genextreme(0.1, 10.0, 2.0),
    "gumbel": stats.gumbel_r(10.0, 2.0),
    "gpd": stats.genpareto(-0.1, 5.0, 2.0),
}
THRESHOLD = {"gev": None, "gumbel": None, "gpd": 5.0}
SPAN = 100.0  # s


def fitted(name: str, x: Array, duration: float) -> Fit:
    """A fit to the maxima of records of a duration [s]."""
    return fit_maxima(x, duration / len(x), name, THRESHOLD[name])


def test_likelihoods_are_those_of_scipy() -> None:
    x = TRUE["gev"].rvs(50, random_state=1)
    wanted = -stats.genextreme(0.07, 9.0, 1.5).logpdf(x).sum()
    assert gev_loss(x, 9.0, 1.5, -0.07) == pytest.approx(wanted, rel=1e-12)
    wanted = -stats.gumbel_r(9.0, 1.5).logpdf(x).sum()
    assert gev_loss(x, 9.0, 1.5, 0.0) == pytest.approx(wanted, rel=1e-12)
    assert gev_loss(x, 9.0, 1.5, 1e-9) == pytest.approx(wanted, rel=1e-7)
    y = TRUE["gpd"].rvs(50, random_state=1)
    wanted = -stats.genpareto(0.2, 5.0, 1.5).logpdf(y).sum()
    assert gpd_loss(y, 5.0, 1.5, 0.2) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("name", [*TRUE])
def test_fit_is_that_of_scipy(name: str) -> None:
    x = TRUE[name].rvs(200, random_state=2)
    found = fitted(name, x, 200 * SPAN)
    if FAMILIES[name].blocks and not FAMILIES[name].shaped:
        loc, scale = stats.gumbel_r.fit(x)
        wanted = (loc, scale, 0.0)
    elif FAMILIES[name].blocks:
        shape, loc, scale = stats.genextreme.fit(x, 0.05, loc=10.0, scale=2.0)
        wanted = (loc, scale, -shape)
    else:
        shape, loc, scale = stats.genpareto.fit(x, -0.05, floc=5.0, scale=2.0)
        wanted = (loc, scale, shape)
    assert (found.loc, found.scale, found.shape) == pytest.approx(wanted, abs=2e-4)
    p = np.linspace(0.01, 0.99, 9)
    own = {"gev": stats.genextreme, "gumbel": stats.gumbel_r, "gpd": stats.genpareto}[name]
    sign = -1.0 if FAMILIES[name].blocks else 1.0
    shapes = [sign * found.shape] if FAMILIES[name].shaped else []
    assert found.quantile(p) == pytest.approx(own(*shapes, found.loc, found.scale).ppf(p))
    assert found.qq()[0] > 0.98


@pytest.mark.parametrize("name", [*TRUE])
def test_levels_move_and_grow_with_the_values(name: str) -> None:
    """x -> 2e6 x + 1e7 gives the same of levels and ends of intervals."""
    x = TRUE[name].rvs(40, random_state=3)
    first = fitted(name, x, 40 * SPAN).level(100 * SPAN)
    limit = THRESHOLD[name] and 2e6 * 5.0 + 1e7
    second = fit_maxima(2e6 * x + 1e7, SPAN, name, limit).level(100 * SPAN)
    wanted = [2e6 * value + 1e7 for value in (first.value, first.low, first.high)]
    assert [second.value, second.low, second.high] == pytest.approx(wanted, rel=1e-5)


def test_level_has_the_crossings_that_were_asked_for() -> None:
    found = fitted("gev", TRUE["gev"].rvs(60, random_state=4), 60 * SPAN)
    for crossings in (0.1, 1.0):
        level = found.level(500 * SPAN, crossings)
        assert found.crossings(level.value, 500 * SPAN) == pytest.approx(crossings)
        assert level.low < level.value < level.high


def covered(name: str, count: int, samples: int, beyond: float) -> int:
    """Samples whose interval holds the level of `beyond` times their duration."""
    random, hits = np.random.default_rng(3), 0
    for _ in range(samples):
        n = max(FEWEST, int(random.poisson(count))) if name == "gpd" else count
        x = TRUE[name].rvs(n, random_state=random)
        found = fitted(name, x, count * SPAN).level(beyond * count * SPAN)
        y = 1.0 / (beyond * count)
        truth = TRUE[name].ppf(np.exp(-y) if FAMILIES[name].blocks else 1.0 - y)
        hits += found.low <= truth <= found.high
    return hits


def test_intervals_of_gumbel_cover_the_truth() -> None:
    """Of 100 with 95 % each 90 to 99 cover, in all but 2 % of such hundreds (binomial)."""
    assert 90 <= covered("gumbel", 20, 100, 10.0) <= 99


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), [("gev", 15), ("gev", 50), ("gpd", 15), ("gpd", 50)])
def test_intervals_of_three_parameters_cover_the_truth(name: str, count: int) -> None:
    """Of 100 with 95 % each 90 to 99 cover, in all but 2 % of such hundreds (binomial)."""
    assert 90 <= covered(name, count, 100, 10.0) <= 99


def test_many_gumbel_fits_at_once_are_those_of_scipy() -> None:
    x = TRUE["gumbel"].rvs((20, 8), random_state=5)
    loc, scale = fit_gumbel(x)
    wanted = np.array([stats.gumbel_r.fit(one) for one in x]).T
    assert loc == pytest.approx(wanted[0], abs=1e-5)
    assert scale == pytest.approx(wanted[1], abs=1e-5)


def test_series_of_the_step_goes_over_into_the_closed_form() -> None:
    y = np.array([1e-6, 0.1, 3.0])
    assert steps(y, 1e-9) == pytest.approx(-np.log(y), rel=1e-7)
    u = -np.log(y)
    assert steps(y, 0.99e-5) == pytest.approx(np.expm1(0.99e-5 * u) / 0.99e-5, rel=1e-8)


def test_hundred_hours_of_gaussian_seas_lie_in_the_interval_of_rayleigh() -> None:
    """The largest of 100 h, of 100 seas: 90 to 99 in the 95 % interval (binomial)."""
    length = 2**20
    frequency = np.asarray(np.fft.rfftfreq(length, STEP), dtype=float)
    spectrum = jonswap(frequency, 3.3)
    spectrum /= spectrum.sum()
    sea = Narrow.of(2.0 * np.pi * frequency, spectrum)
    low, high = interval(sea, 100.0)
    random, inside, above = np.random.default_rng(11), 0, 0
    for _ in range(100):
        parts = random.standard_normal((2, len(spectrum)))
        x = np.fft.irfft(np.sqrt(spectrum) * (parts[0] + 1j * parts[1]) * length / 2.0, length)
        x = x[: round(100.0 * 3600.0 / STEP)]
        record = Record(STEP * np.arange(len(x), dtype=float), x)
        k = int(np.argmax(x))
        (top,) = block_maxima([Record(record.time[k - 3 : k + 4], x[k - 3 : k + 4])], 6 * STEP)
        inside += low <= top <= high
        above += top > largest(sea, 100.0, 0.5)
    assert 90 <= inside <= 99
    assert 35 <= above <= 65  # of 100 with 1/2 each, in all but 0.3 %


def test_fits_of_gaussian_seas_meet_rayleigh() -> None:
    """Level of 3 h from 12 records of 20 min: within the interval of each distribution."""
    seas = gaussian_seas(3.3, 150, 12)
    records = [Record(STEP * np.arange(len(x), dtype=float), x) for x in seas]
    frequency = np.linspace(0.02, 1.0, 4000)
    sea = Narrow.of(2.0 * np.pi * frequency, jonswap(frequency, 3.3))
    truth = largest(Narrow(1.0, sea.rate), 3.0, 1.0 - np.exp(-1.0))
    found = clusters(records)
    peaks = fit_maxima(found.peaks, found.duration / len(found.peaks), "gpd", found.threshold)
    for fit in (peaks, fit_maxima(block_maxima(records, 240.0), 240.0, "gumbel")):
        level = fit.level(3 * 3600.0)
        assert level.low <= truth <= level.high
        assert level.value == pytest.approx(truth, rel=0.2)


def test_extremal_index_is_that_of_a_moving_maximum() -> None:
    """Of max(z_i, z_(i+1)) with independent z every exceedance comes twice: the index is 1/2."""
    random = np.random.default_rng(8)
    z = random.random(200_001)
    above = np.flatnonzero(np.maximum(z[1:], z[:-1]) > 0.99)
    assert extremal_index(np.diff(above)) == pytest.approx(0.5, abs=0.03)
    alone = np.flatnonzero(random.random(200_000) > 0.99)
    assert extremal_index(np.diff(alone)) == pytest.approx(1.0, abs=0.05)


def test_blocks_have_the_crests_between_samples() -> None:
    time = np.arange(0.0, 100.0, 0.5)
    found = block_maxima([Record(time, 3.0 * np.cos(0.7 * time - 0.3))], 20.0)
    assert found == pytest.approx(np.full(4, 3.0), rel=5e-4)


def test_what_cannot_be_fitted_is_refused() -> None:
    with wrong("block"):
        fit_maxima(np.arange(14.0), 1.0)
    with wrong("channel"):
        fit_maxima(np.full(20, 2.0), 1.0)
    sea = Record(np.arange(100.0), np.sin(np.arange(100.0)))
    with wrong("threshold"):
        clusters([sea], 2.0)
    with wrong("hours"):
        fitted("gpd", TRUE["gpd"].rvs(40, random_state=1), 40 * SPAN).level(50.0)
