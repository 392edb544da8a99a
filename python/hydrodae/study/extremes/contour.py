"""Environmental contours of height and period by the inverse first-order reliability method.

Winterstein et al. (ICOSSAR 1993): sea states of a return period are on a circle of radius beta of
independent standard normal numbers u1, u2, with Phi(-beta) = D / (N years). By Rosenblatt's
transformation F_H(h) = Phi(u1), F_T|H(t | h) = Phi(u2). The joint model is that of DNV-RP-C205
(3.6.3): H has a Weibull distribution of three parameters, T | H is lognormal,

    F_H(h) = 1 - exp(-((h - c) / a)^b),
    mean of ln T = a1 + a2 h^a3,    deviation of ln T = b1 + b2 e^(b3 h)
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import astuple, dataclass, field

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import least_squares, minimize
from scipy.special import log_ndtr, ndtri_exp

from hydrodae.errors import CaseError
from hydrodae.study.extremes.long_term import YEAR, check_years
from hydrodae.study.extremes.scatter import ScatterTable, read_scatter
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class JointModel:
    """Heights and peak periods of sea states.

    Attributes
    ----------
    scale, shape, location : float
        a [m], b [-] and c [m] of the Weibull distribution of the height.
    a1, a2, a3 : float
        Mean of ln T, T in s and h in m.
    b1, b2, b3 : float
        Standard deviation of ln T.
    """

    scale: float
    shape: float
    location: float
    a1: float
    a2: float
    a3: float
    b1: float
    b2: float
    b3: float

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, astuple(self))) or self.scale <= 0.0 or self.shape <= 0.0:
            raise CaseError("the joint model needs finite numbers, and scale and shape > 0")

    def height(self, u: ArrayLike) -> Array:
        """Height at standard normal numbers u [m]; exact far out in the tail."""
        tail = -log_ndtr(-np.asarray(u, dtype=float))  # -ln(1 - Phi(u))
        return np.asarray(self.location + self.scale * tail ** (1.0 / self.shape))

    def mean(self, height: ArrayLike) -> Array:
        """Mean of ln T at heights [m]."""
        h = np.maximum(np.asarray(height, dtype=float), 0.0)
        return np.asarray(self.a1 + self.a2 * h**self.a3)

    def deviation(self, height: ArrayLike) -> Array:
        """Standard deviation of ln T at heights [m]."""
        return np.asarray(self.b1 + self.b2 * np.exp(self.b3 * np.asarray(height, dtype=float)))


@dataclass(frozen=True)
class Contour:
    """Sea states of a return period; printed, what the command prints.

    Attributes
    ----------
    model : JointModel
    years : tuple of float
        Return periods.
    hours : float
        Duration of a sea state [h].
    heights, periods : (m, n) arrays
        Of each return period, [m] and [s]; from the highest sea state on, the period ascends.
    notes : list of str
    """

    model: JointModel
    years: tuple[float, ...]
    hours: float
    heights: Array
    periods: Array
    notes: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        from hydrodae.study.extremes.text import contour

        return contour(self)


def contour(
    source: str | os.PathLike[str] | ScatterTable | JointModel,
    *,
    years: float | Sequence[float] = 50.0,
    hours: float = 3.0,
    points: int = 36,
) -> Contour:
    """Return the contour of sea states of each return period.

    Parameters
    ----------
    source : path, ScatterTable or JointModel
        A scatter table, CSV with columns height [m], period [s], hours, to which the joint model is
        fitted; or the model.
    years : float or sequence of float
        Return periods.
    hours : float
        Duration of a sea state [h].
    points : int
        On each contour.

    Raises
    ------
    CaseError
        The table cannot be fitted, or a value cannot be used.
    """
    wanted = check_years(years)
    if not (hours > 0.0 and math.isfinite(hours)):
        raise CaseError(f"hours {hours:g}: expected a number > 0")
    if not 4 <= points <= 100_000:
        raise CaseError(f"points {points}: expected 4 to 100000")
    notes: list[str] = []
    if isinstance(source, JointModel):
        model = source
    else:
        table = source if isinstance(source, ScatterTable) else read_scatter(source)
        model = fit_joint_model(table)
        highest = float(table.height.max())
        notes = [f"the joint model is fitted; the highest sea state of the table has {highest:g} m"]
    for n in wanted:
        if n * YEAR <= 2.0 * hours:
            raise CaseError(f"years {n:g}: no contour has a period of two sea states or less")
    angle = 2.0 * math.pi * np.arange(points) / points
    radius = np.array([[-float(ndtri_exp(math.log(hours / (n * YEAR))))] for n in wanted])
    heights = model.height(radius * np.cos(angle))
    deviation = model.deviation(heights)
    if not (deviation > 0.0).all():
        raise CaseError("the deviation of ln T of the joint model is not positive on the contour")
    periods = np.exp(model.mean(heights) + deviation * radius * np.sin(angle))
    return Contour(model, wanted, hours, heights, periods, notes)


def fit_joint_model(table: ScatterTable) -> JointModel:
    """Fit the joint model to a scatter table.

    The height by the largest likelihood of the bins, whose edges lie halfway between the heights of
    the table; mean and deviation of ln T of each height by least squares, weighted by its hours.

    Raises
    ------
    CaseError
        Fewer than 5 heights, or no height with two periods or more.
    """
    heights = np.unique(table.height)
    if len(heights) < 5:
        raise CaseError(f"{len(heights)} heights: the joint model needs a table of at least 5")
    hours = np.array([table.hours[table.height == h].sum() for h in heights])
    scale, shape, location = _weibull(heights, hours)
    rows = [_of_logarithm(table, h) for h in heights]
    mean, variance, periods = (np.array(x) for x in zip(*rows, strict=True))
    spread = periods > 1
    if spread.sum() < 3:
        raise CaseError("fewer than 3 heights have several periods: T | H has no distribution")
    weight = np.sqrt(hours)
    a = _curve(lambda p, h: p[0] + p[1] * h ** p[2], (1.0, 1.0, 0.3), heights, mean, weight)
    deviation = np.sqrt(np.maximum(variance[spread], 0.0))
    b = _curve(
        lambda p, h: p[0] + p[1] * np.exp(p[2] * h), (0.05, 0.2, -0.3), heights[spread], deviation,
        weight[spread],
    )  # fmt: skip
    return JointModel(scale, shape, location, *a, *b)


def _edges(centers: Array) -> Array:
    """Edges of bins: halfway, the first not below 0, the last as far as that before."""
    half = 0.5 * np.diff(centers)
    low = max(0.0, float(centers[0] - half[0]))
    return np.concatenate([[low], centers[:-1] + half, [centers[-1] + half[-1]]])


def _weibull(heights: Array, hours: Array) -> tuple[float, float, float]:
    edges = _edges(heights)
    share = hours / hours.sum()
    # the range of every bin is the probability of it; the last one is open
    mean = float(share @ heights)
    lowest = float(edges[1])

    def loss(p: Array) -> float:
        location = lowest / (1.0 + math.exp(-p[2]))  # between 0 and the second edge
        z = np.maximum((edges - location) / math.exp(p[0]), 0.0)
        above = np.exp(-(z ** math.exp(p[1])))
        above[0], above[-1] = 1.0, 0.0
        inside = np.maximum(above[:-1] - above[1:], 1e-300)
        return -float(share @ np.log(inside))

    options = {"xatol": 1e-8, "fatol": 1e-12, "maxiter": 10000, "maxfev": 10000}
    starts = [[math.log(mean), math.log(1.4), c] for c in (-2.0, 0.0)]
    tries = [minimize(loss, s, method="Nelder-Mead", options=options) for s in starts]
    best = min(tries, key=lambda found: float(found.fun)).x
    location = lowest / (1.0 + math.exp(-best[2]))
    return math.exp(best[0]), math.exp(best[1]), location


def _of_logarithm(table: ScatterTable, height: float) -> tuple[float, float, int]:
    """Mean and variance of ln T of one height, and the number of its periods."""
    mine = table.height == height
    share = table.hours[mine] / table.hours[mine].sum()
    logarithm = np.log(table.period[mine])
    mean = float(share @ logarithm)
    return mean, float(share @ (logarithm - mean) ** 2), int(mine.sum())


def _curve(of: object, start: Sequence[float], x: Array, y: Array, weight: Array) -> Array:
    """Three parameters of a curve by weighted least squares."""
    assert callable(of)
    found = least_squares(
        lambda p: weight * (of(p, x) - y), start, x_scale=np.abs(start),
        bounds=([-np.inf, -np.inf, -5.0], [np.inf, np.inf, 5.0]), max_nfev=5000,
    )  # fmt: skip
    return np.asarray(found.x, dtype=float)
