"""Statistics of a sampled series: moments, extremes, zero-crossing waves, spectrum."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.results.sampling import INTERVALS, Interval
from hydrodae.support.arrays import Array

#: Segments of the spectrum that the series is cut into, each overlapping half of the next.
SEGMENTS = 4
#: Fewest samples of a spectrum.
FEWEST = 16


@dataclass(frozen=True)
class Spectrum:
    """One-sided spectral density; its integral over the frequency is the variance."""

    omega: Array  #: (n,) angular frequency, rad/s
    density: Array  #: (n,) unit of the series squared, s/rad

    def moment(self, order: int) -> float:
        """Return the moment int omega^order S d omega."""
        return float(np.trapezoid(self.omega**order * self.density, self.omega))

    @property
    def peak_period(self) -> float:
        """Period at the largest density, s; nan if there is none."""
        k = int(np.argmax(self.density[1:])) + 1 if len(self.density) > 1 else 0
        return float(2 * np.pi / self.omega[k]) if k and self.density[k] > 0 else float("nan")


@dataclass(frozen=True)
class Waves:
    """What lies between two upward crossings of the mean."""

    heights: Array  #: (n,) highest minus lowest sample, unit of the series
    periods: Array  #: (n,) s

    @property
    def mean_period(self) -> float:
        """Mean time between two upward crossings, s; nan without any."""
        return float(self.periods.mean()) if len(self.periods) else float("nan")

    @property
    def significant_height(self) -> float:
        """Mean of the highest third; nan without any."""
        if not len(self.heights):
            return float("nan")
        highest = np.sort(self.heights)[::-1]
        return float(highest[: max(1, round(len(highest) / 3))].mean())


@dataclass(frozen=True)
class Statistics:
    """What `Results.statistics_of` shows of a series; print it."""

    name: str
    unit: str
    start: float  #: first sample that counts, s
    end: float  #: last one, s
    mean: float
    std: float
    min: float
    max: float
    waves: Waves  #: between upward crossings of the mean
    spectrum: Spectrum  #: of the deviation from the mean
    #: 95 % intervals of mean, std, min, max in an irregular sea, see `hydrodae.results.sampling`
    intervals: dict[str, Interval] = field(default_factory=dict)
    no_interval: str = ""  #: why an irregular sea gives none

    def __str__(self) -> str:
        waves = self.waves
        return "\n".join(
            [
                f"{self.name} [{self.unit}], {self.start:g} to {self.end:g} s",
                f"  mean {self.mean:.5g}{self._interval('mean')}, "
                f"standard deviation {self.std:.5g}{self._interval('std')}",
                f"  least seen {self.min:.5g}{self._interval('min')}, "
                f"largest seen {self.max:.5g}{self._interval('max')}",
                f"  {len(waves.heights)} waves about the mean: period {waves.mean_period:.4g} s, "
                f"significant height {waves.significant_height:.5g}, "
                f"highest {max(waves.heights, default=float('nan')):.5g}",
                f"  spectrum: peak at {self.spectrum.peak_period:.4g} s",
                *[f"  {self.no_interval}"] * bool(self.no_interval),
            ]
        )

    def _interval(self, statistic: str) -> str:
        if statistic not in self.intervals:
            return ""
        low, high = self.intervals[statistic]
        expected = "expected " if statistic in ("min", "max") else ""
        return f" ({expected}{low:.4g} to {high:.4g})"


def spectral_density(time: ArrayLike, values: ArrayLike) -> Spectrum:
    """Spectral density of an evenly sampled series about its mean, after Welch.

    Half overlapping segments with Hann windows; empty for fewer than `FEWEST` samples.

    Parameters
    ----------
    time : (n,) array, s
        Evenly spaced.
    values : (n,) array

    Raises
    ------
    ValueError
        The samples are not evenly spaced.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    if len(t) < FEWEST:
        return Spectrum(np.empty(0), np.empty(0))
    steps = np.diff(t)
    if np.ptp(steps) > 1e-6 * steps.mean():
        raise ValueError("a spectrum needs evenly spaced samples")
    from scipy.signal import welch

    length = max(FEWEST, 2 * len(t) // (SEGMENTS + 1))
    frequency, density = welch(x - x.mean(), 1.0 / steps.mean(), nperseg=length)
    return Spectrum(2 * np.pi * frequency, density / (2 * np.pi))


def zero_crossing_waves(time: ArrayLike, values: ArrayLike) -> Waves:
    """Heights and periods between upward crossings of the mean, found by linear interpolation.

    Parameters
    ----------
    time : (n,) array, s
        Ascending.
    values : (n,) array
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    x = x - x.mean() if len(x) else x
    up = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    if len(up) < 2:
        return Waves(np.empty(0), np.empty(0))
    crossings = t[up] - x[up] * (t[up + 1] - t[up]) / (x[up + 1] - x[up])
    starts, end = up + 1, up[-1] + 1
    highest = np.maximum.reduceat(x[:end], starts[:-1])
    lowest = np.minimum.reduceat(x[:end], starts[:-1])
    return Waves(highest - lowest, np.diff(crossings))


def statistics(
    name: str,
    unit: str,
    time: ArrayLike,
    values: ArrayLike,
    start: float,
    sampled: bool = False,
    no_interval: str = "",
) -> Statistics:
    """Statistics of the samples from `start` [s] on.

    Parameters
    ----------
    name, unit : str
    time : (n,) array, s
    values : (n,) array
    start : float
    sampled : bool
        The series from `start` on is a sample of an irregular sea: intervals are given.
    no_interval : str
        Why it gives none.

    Raises
    ------
    ValueError
        No sample is left, or they are not evenly spaced.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    t, x = t[t >= start], x[np.asarray(time, dtype=float) >= start]
    if not len(x):
        raise ValueError(f"{name}: no sample from {start:g} s on")
    return Statistics(
        name,
        unit,
        float(t[0]),
        float(t[-1]),
        float(x.mean()),
        float(x.std()),
        float(x.min()),
        float(x.max()),
        zero_crossing_waves(t, x),
        spectral_density(t, x),
        intervals_of(x) if sampled else {},
        no_interval,
    )


def intervals_of(values: Array) -> dict[str, Interval]:
    """Intervals of mean, std, min, max; none of too short a series."""
    found = {name: INTERVALS[name](values) for name in ("mean", "std", "min", "max")}
    return {name: pair for name, pair in found.items() if not np.isnan(pair[0])}
