"""How far statistics of one record may be from those of its sea state.

A record of an irregular sea is one sample of all seas with its spectrum. What it varies by is seen
in itself: it is cut into `SPANS` equal spans, and what they differ by says what the whole is worth.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from hydrodae import _core
from hydrodae.support.arrays import Array

Interval = tuple[float, float]

#: Spans of a record.
SPANS: int = _core.SAMPLING_SPANS
#: Energy periods of the sea that a record has to last: fewer waves have no interval.
PERIODS: float = _core.SAMPLING_PERIODS
#: Fewest samples of a record.
FEWEST: int = _core.SAMPLING_FEWEST
#: Of records that are too short.
NONE: Interval = (float("nan"), float("nan"))


def mean_interval(values: ArrayLike) -> Interval:
    """95 % interval of the mean of a sea state, by batch means.

        m +- h,    h = t_{0.975, n-1} s / sqrt(n)

    with s the standard deviation of the means of n = `SPANS` equal spans (Law and Carson,
    Operations Research 27, 1979). Nothing is assumed of the spectrum but that waves of different
    spans have little to do with each other. The mean of what never changes its sign, such as a
    power or a square, is skewed: its logarithm has the same interval, so m exp(+- h / m).

    Parameters
    ----------
    values : (n,) array
        At equal steps, after the ramp.

    Returns
    -------
    (float, float)
        In the unit of `values`; nan for fewer than `FEWEST` samples.
    """
    return _core.mean_interval(np.asarray(values, dtype=float)) or NONE


def std_interval(values: ArrayLike) -> Interval:
    """95 % interval of the standard deviation: the root of that of the variance."""
    x = np.asarray(values, dtype=float)
    return rms_interval(x - x.mean()) if len(x) else NONE


def rms_interval(values: ArrayLike) -> Interval:
    """95 % interval of the root mean square: the root of that of the mean square."""
    low, high = mean_interval(np.asarray(values, dtype=float) ** 2)
    return float(np.sqrt(low)), float(np.sqrt(high))


def largest_interval(values: ArrayLike) -> Interval:
    """95 % interval of the largest value that records of this length have on average.

    The largest values of the n = `SPANS` spans, of mean m and standard deviation s, are taken to be
    distributed after Gumbel, of scale b = s sqrt(6) / pi. The largest of all n is then on average

        E = m + b ln n = m + c s,    var E = (1 + 1.14 c + 1.1 c^2) s^2 / n

    by the moments of that distribution (skewness 1.14, kurtosis 5.4), and its interval has
    Student's t with n - 1 degrees of freedom.

    Parameters
    ----------
    values : (n,) array
        At equal steps, after the ramp.

    Returns
    -------
    (float, float)
        Least and largest; nan for fewer than `FEWEST` samples.
    """
    x = np.asarray(values, dtype=float)
    if len(x) < FEWEST:
        return NONE
    return largest_of_spans(np.array([span.max() for span in np.array_split(x, SPANS)]))


def mean_of_spans(means: ArrayLike, one_sign: bool) -> Interval:
    """Interval of `mean_interval` from the means of the spans.

    Parameters
    ----------
    means : (SPANS,) array
        Of equal spans.
    one_sign : bool
        The values never change their sign.

    Returns
    -------
    (float, float)
        In the unit of the means.
    """
    values = np.repeat(np.asarray(means, dtype=float), FEWEST // SPANS)
    mean = 0.0 if one_sign else float(values.mean())  # around zero it takes no logarithms
    low, high = _core.mean_interval(values - mean) or NONE
    return mean + low, mean + high


def largest_of_spans(highest: Array) -> Interval:
    """Interval of `largest_interval` from the largest value of each span (SPANS,)."""
    from scipy.special import stdtrit  # takes half a second: only where it is used

    s, c = float(highest.std(ddof=1)), np.sqrt(6.0) / np.pi * np.log(SPANS)
    expected = float(highest.mean()) + c * s
    half = float(stdtrit(SPANS - 1, 0.975)) * s * np.sqrt((1.0 + 1.14 * c + 1.1 * c**2) / SPANS)
    return float(expected - half), float(expected + half)


def least_interval(values: ArrayLike) -> Interval:
    """95 % interval of the least value that records of this length have on average."""
    low, high = largest_interval(-np.asarray(values, dtype=float))
    return -high, -low


def range_interval(values: ArrayLike) -> Interval:
    """95 % interval of the average of largest minus least value: that of both, at worst opposed."""
    (least, above), (below, largest) = least_interval(values), largest_interval(values)
    return below - above, largest - least


#: Interval of a statistic, from the samples: of a mean, standard deviation or root mean square that
#: of the sea state; of an extreme that of its average over records of the same length.
INTERVALS: dict[str, Callable[[Array], Interval]] = {
    "mean": mean_interval,
    "std": std_interval,
    "rms": rms_interval,
    "max": largest_interval,
    "min": least_interval,
    "range": range_interval,
}
