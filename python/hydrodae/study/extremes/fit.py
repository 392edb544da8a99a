"""Fits of extremes, levels for a duration, and their intervals by profile likelihood."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri

from hydrodae.errors import CaseError
from hydrodae.study.extremes.distributions import (
    FAMILIES,
    SHAPES,
    Family,
    fit_parameters,
    smallest,
    steps,
)
from hydrodae.support.arrays import Array

#: Fewest maxima of a fit: intervals of so few cover 90 to 99 of 100, as
#: tests/verification/test_extremes_fits.py measures; nothing is known of fewer.
FEWEST = 15
#: Twice the fall of the logarithm of the likelihood at the ends of a 95 % interval: chi-squared, 1.
FALL = float(chdtri(1, 0.05))
#: Relative precision of the half widths of intervals: far below their own uncertainty, which is
#: 1 / sqrt(2 n), that of a standard deviation from n maxima.
PRECISION = 1e-3
#: Scales from the fitted level at which the search for an end of the interval ends.
FARTHEST = 1e4


@dataclass(frozen=True)
class Level:
    """A level, and the ends of its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Fit:
    """Maxima and the distribution that they have.

    Attributes
    ----------
    family : Family
    maxima : (n,) array
        Of blocks or of clusters, ascending.
    span : float
        Duration of one block, or mean time of one cluster: that of all records over n [s].
    loc, scale, shape : float
    threshold : float or None
        Of peaks; None for blocks.
    """

    family: Family
    maxima: Array
    span: float
    loc: float
    scale: float
    shape: float
    threshold: float | None = None

    @property
    def at_end(self) -> bool:
        """Whether the shape is at an end of those that are looked for."""
        return self.family.shaped and min(abs(self.shape - end) for end in SHAPES) < 1e-3

    def quantile(self, p: Array) -> Array:
        """Value that one maximum is below with probability p."""
        return np.asarray(self.loc + self.scale * steps(self.family.of_probability(p), self.shape))

    def qq(self) -> tuple[float, float]:
        """How near the maxima are to the distribution, by quantiles at (i - 0.44) / (n + 0.12).

        Returns
        -------
        correlation : float
            Of maxima and quantiles; 1 where they are on a line (Filliben 1975).
        difference : float
            Root of the mean square of their difference over the standard deviation of the maxima.
        """
        n = len(self.maxima)
        place = np.asarray((np.arange(1, n + 1) - 0.44) / (n + 0.12), dtype=np.float64)
        expected = self.quantile(place)  # Gringorten 1963
        away = float(np.sqrt(np.mean((expected - self.maxima) ** 2)) / self.maxima.std())
        return float(np.corrcoef(expected, self.maxima)[0, 1]), away

    def crossings(self, level: float, seconds: float) -> float:
        """Mean number n of maxima above a level in a duration; its largest is below with e^-n."""
        z = (level - self.loc) / self.scale
        if abs(self.shape) < 1e-12:
            y = math.exp(-z)
        else:
            inner = 1.0 + self.shape * z
            y = inner ** (-1.0 / self.shape) if inner > 0.0 else 0.0 if z > 0.0 else math.inf
        return y * seconds / self.span

    def level(self, seconds: float, crossings: float = 1.0) -> Level:
        """Level with a mean number of maxima above it in a duration, with its 95 % interval.

        The interval is that of the profile likelihood (Coles 2001, 2.6.6). Of peaks the number of
        clusters counts as well, which has a Poisson distribution.

        Parameters
        ----------
        seconds : float
            Duration [s].
        crossings : float
            n; the largest of the duration is above the level with probability 1 - e^-n.

        Raises
        ------
        CaseError
            The level lies below the threshold: the duration is too short.
        """
        y = crossings * self.span / seconds
        if not self.family.blocks and y >= 1.0:
            raise CaseError(
                f"{seconds / 3600.0:.4g} h: there is one cluster in {self.span:.4g} s: the level "
                f"lies below the threshold {self.threshold:.4g}; take a lower one",
                key="hours",
            )
        value = float(self.loc + self.scale * steps(y, self.shape))
        low, high = (self._end(value, y, sign) for sign in (-1.0, 1.0))
        return Level(value, low, high)

    def _end(self, value: float, y: float, sign: float) -> float:
        """One end of the interval of a level."""
        start, least = self._loss(value, y)

        def above(distance: float) -> float:
            nonlocal start
            start, loss = self._loss(value + sign * distance, y, start)
            return 2.0 * (loss - least) - FALL

        size = self.scale
        reach = 0.05 * size
        while above(reach) < 0.0:
            reach *= 1.5
            if reach > FARTHEST * size:
                return sign * math.inf
            if not self.family.blocks and sign < 0.0 and value - reach <= self.loc:
                return self.loc
        inner = reach / 1.5 if reach > 0.05 * size else 0.0
        while reach - inner > PRECISION * reach:
            middle = 0.5 * (inner + reach)
            inner, reach = (middle, reach) if above(middle) < 0.0 else (inner, middle)
        return value + sign * 0.5 * (inner + reach)

    def _start(self) -> Array:
        first = 0.0 if not self.family.blocks else math.log(self.scale)
        return np.array([first, self.shape] if self.family.shaped else [first])

    def _loss(self, level: float, y: float, start: Array | None = None) -> tuple[Array, float]:
        """Loss of the best distribution with this level, over the other parameters.

        Of blocks these are ln scale and shape; of peaks the ratio ln r of the rate of clusters to
        that seen, and the shape: y becomes y / r, and the Poisson number adds n (r - 1 - ln r).
        """
        n = len(self.maxima)

        def loss(p: Array) -> float:
            shape = float(p[1]) if self.family.shaped else 0.0
            if not SHAPES[0] <= shape <= SHAPES[1]:
                return math.inf
            if self.family.blocks:
                scale = math.exp(p[0])
                loc = level - scale * float(steps(y, shape))
                return self.family.loss(self.maxima, loc, scale, shape)
            ratio = math.exp(p[0])
            if y >= ratio:
                return math.inf
            scale = (level - self.loc) / float(steps(y / ratio, shape))
            return self.family.loss(self.maxima, self.loc, scale, shape) + n * (
                ratio - 1.0 - math.log(ratio)
            )

        return smallest(loss, self._start() if start is None else start, 1e-5)


def fit_maxima(
    maxima: Array, span: float, family: str = "gev", threshold: float | None = None
) -> Fit:
    """Fit a distribution to maxima by the largest likelihood.

    Parameters
    ----------
    maxima : (n,) array
        Any unit. The fit moves and grows with them.
    span : float
        Duration of a block, or mean time of a cluster [s].
    family : str
        "gev" or "gumbel" of block maxima, "gpd" of peaks over a threshold.
    threshold : float, optional
        Of "gpd".

    Raises
    ------
    CaseError
        There are too few maxima, or they are all equal.
    """
    kind = FAMILIES[family]
    x = np.sort(np.asarray(maxima, dtype=float))
    what = "maxima of blocks" if kind.blocks else "clusters above the threshold"
    if len(x) < FEWEST:
        more = "shorter blocks" if kind.blocks else "a lower threshold"
        raise CaseError(
            f"{len(x)} {what}: a fit needs at least {FEWEST}; take longer runs, more seeds or "
            f"{more}",
            key="block" if kind.blocks else "threshold",
        )
    if not np.isfinite(x).all():
        raise CaseError(f"{what}: {int((~np.isfinite(x)).sum())} are not finite")
    center, size = float(x.mean()), float(x.std())
    if not size > 1e-12 * max(abs(center), 1e-300):
        raise CaseError(
            f"{what}: all are {center:.6g}: there is no distribution to fit", key="channel"
        )
    z = (x - center) / size
    limit = None if threshold is None else (threshold - center) / size
    loc, scale, shape = fit_parameters(kind, z, limit)
    return Fit(kind, x, span, center + size * loc, size * scale, shape, threshold)
