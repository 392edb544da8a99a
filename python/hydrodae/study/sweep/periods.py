"""Periods and amplitudes of a series."""

from __future__ import annotations

import math

import numpy as np

from hydrodae.support.arrays import Array


def mean_period(values: Array, mean: float, duration: float) -> float:
    """Mean period of the crossings of the mean upwards [s]: the duration over their number.

    Parameters
    ----------
    values : (n,) array
        Samples, or turning points.
    mean : float
        Of the series.
    duration : float
        [s].
    """
    above = np.asarray(values) > mean
    count = int(np.count_nonzero(~above[:-1] & above[1:]))
    return duration / count if count else math.nan


def amplitude(
    frequency: float, start: float, duration: float, mean: float, cosine: float, sine: float
) -> float:
    """Amplitude of a series at a frequency, 2 |1/T int (x - mean) exp(-i w t) dt|.

    Parameters
    ----------
    frequency : float
        w / 2 pi [Hz].
    start, duration : float
        Of the series [s].
    mean : float
        Of x.
    cosine, sine : float
        Means of x cos(w t) and x sin(w t).
    """
    w, end = 2.0 * math.pi * frequency, start + duration
    c = (math.sin(w * end) - math.sin(w * start)) / (w * duration)
    s = (math.cos(w * start) - math.cos(w * end)) / (w * duration)
    return 2.0 * math.hypot(cosine - mean * c, sine - mean * s)


def amplitude_of_samples(time: Array, values: Array, frequency: float) -> float:
    """`amplitude` by the trapezoidal rule, from samples at `time` (n,) [s]."""
    from scipy.integrate import trapezoid  # only where it is used

    w, duration = 2.0 * math.pi * frequency, float(time[-1] - time[0])
    if duration <= 0.0:
        return math.nan
    mean = trapezoid(values, time) / duration
    wave = np.exp(-1j * w * time)
    return float(2.0 * abs(trapezoid((values - mean) * wave, time)) / duration)
