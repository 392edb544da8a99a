"""Means over repetitions and their intervals, with or without a control variate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import stdtrit

#: Fewest runs with which a slope is estimated: two of them are left for the scatter.
FEWEST = 4


@dataclass(frozen=True)
class Estimate:
    """A mean, half the width of its 95 % interval, and the number of runs; nan where unknown."""

    mean: float
    half: float
    count: int


def plain(values: ArrayLike) -> Estimate:
    """Student's t over runs with other seeds: m +- t_{0.975, n-1} s / sqrt(n).

    Parameters
    ----------
    values : (n,) array
        nan of a run without a value.
    """
    y = np.asarray(values, dtype=float)
    y = y[np.isfinite(y)]
    n = len(y)
    if n < 2:
        return Estimate(float(y.mean()) if n else float("nan"), float("nan"), n)
    half = float(stdtrit(n - 1, 0.975)) * float(y.std(ddof=1)) / np.sqrt(n)
    return Estimate(float(y.mean()), float(half), n)


def controlled(values: ArrayLike, control: ArrayLike) -> Estimate:
    """The mean of y where its control variate x, of mean zero, is zero.

        y = a + b x + e,    a +- t_{0.975, n-2} s sqrt(1/n + mean(x)^2 / sum (x - mean(x))^2)

    by least squares, s^2 the squares of e over n - 2: the slope costs a degree of freedom. The
    interval is exact for normal y given x (Lavenberg and Welch, Management Science 27, 1981).

    Parameters
    ----------
    values, control : (n,) arrays
        nan of a run without one.

    Returns
    -------
    Estimate
        `plain` for fewer than `FEWEST` runs, or a control variate that does not vary.
    """
    y, x = np.asarray(values, dtype=float), np.asarray(control, dtype=float)
    both = np.isfinite(y) & np.isfinite(x)
    if both.sum() < FEWEST or both.sum() < np.isfinite(y).sum():
        return plain(y)
    y, x = y[both], x[both]
    n, middle = len(y), float(x.mean())
    squares = float(np.sum((x - middle) ** 2))
    if not squares > 0.0:
        return plain(y)
    slope = float(np.sum((x - middle) * (y - y.mean()))) / squares
    rest = y - y.mean() - slope * (x - middle)
    s = np.sqrt(float(np.sum(rest**2)) / (n - 2))
    half = float(stdtrit(n - 2, 0.975)) * s * np.sqrt(1.0 / n + middle**2 / squares)
    return Estimate(float(y.mean() - slope * middle), float(half), n)
