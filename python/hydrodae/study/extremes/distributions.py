"""Distributions of extremes: generalised extreme value (GEV), Gumbel, generalised Pareto (GPD).

All three have a level that is exceeded y times a block (or of y of all clusters) on average,

    x(y) = loc + scale h(y),    h = (y^-shape - 1) / shape,    h = -ln y for shape 0

(Coles, An Introduction to Statistical Modeling of Extreme Values, 2001, eqs. 3.4 and 4.12). The
shape is positive for heavy tails; scipy's genextreme has the opposite sign.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import minimize

from hydrodae.support.arrays import Array

#: Shapes between which a fit is looked for: below -1/2 the likelihood has no regular maximum (Smith
#: 1985), above 1/2 the distribution has no variance.
SHAPES = (-0.5, 0.5)
#: Loss in place of an infinite one, which has no differences.
WORST = 1e12
#: Below this |shape| the series h = -ln y + shape (ln y)^2 / 2 is more exact than the quotient:
#: rounding 1e-16 / shape against the next term shape^2 (ln y)^3 / 6.
SMALL = 1e-5


def steps(y: Any, shape: float) -> Any:
    """h(y), see this module."""
    u = -np.log(y)
    return u + 0.5 * shape * u**2 if abs(shape) < SMALL else np.expm1(shape * u) / shape


def _reduced(x: Array, loc: float, scale: float, shape: float) -> Array | None:
    """Number u with x = loc + scale (e^(shape u) - 1) / shape; None where a value lies outside."""
    z = (x - loc) / scale
    if abs(shape) < SMALL:
        return np.asarray(z - 0.5 * shape * z**2)
    inner = 1.0 + shape * z
    return None if inner.min() <= 0.0 else np.asarray(np.log(inner) / shape)


def gev_loss(x: Array, loc: float, scale: float, shape: float) -> float:
    """Negative logarithm of the likelihood of block maxima (n,)."""
    if not (scale > 0.0 and SHAPES[0] <= shape <= SHAPES[1]):
        return float("inf")
    u = _reduced(x, loc, scale, shape)
    if u is None or u.min() < -700.0:
        return float("inf")
    return float(len(x) * np.log(scale) + np.sum((1.0 + shape) * u + np.exp(-u)))


def gpd_loss(x: Array, loc: float, scale: float, shape: float) -> float:
    """Negative logarithm of the likelihood of peaks (n,) above loc."""
    if not (scale > 0.0 and SHAPES[0] <= shape <= SHAPES[1]):
        return float("inf")
    u = _reduced(x, loc, scale, shape)
    if u is None:
        return float("inf")
    return float(len(x) * np.log(scale) + np.sum((1.0 + shape) * u))


@dataclass(frozen=True)
class Family:
    """A family of distributions.

    Attributes
    ----------
    name, title : str
    blocks : bool
        Of the maxima of blocks; else of peaks over a threshold.
    shaped : bool
        The shape is fitted; else it is 0.
    loss : callable
        Negative logarithm of the likelihood of (x, loc, scale, shape).
    of_probability : callable
        y at which the distribution function has a value p.
    """

    name: str
    title: str
    blocks: bool
    shaped: bool
    loss: Callable[[Array, float, float, float], float]
    of_probability: Callable[[Array], Array]


FAMILIES = {
    family.name: family
    for family in (
        Family("gev", "generalised extreme value", True, True, gev_loss, lambda p: -np.log(p)),
        Family("gumbel", "Gumbel", True, False, gev_loss, lambda p: -np.log(p)),
        Family("gpd", "generalised Pareto", False, True, gpd_loss, lambda p: 1.0 - p),
    )
}


def smallest(
    loss: Callable[[Array], float], start: Array, tolerance: float = 1e-8
) -> tuple[Array, float]:
    """Where a function of few numbers of the size 1 is least, and its value (Nelder and Mead)."""
    options = {"xatol": 30.0 * tolerance, "fatol": tolerance, "maxiter": 2000, "maxfev": 2000}
    found = minimize(lambda p: min(loss(p), WORST), start, method="Nelder-Mead", options=options)
    return np.asarray(found.x, dtype=float), float(found.fun)


def fit_parameters(family: Family, x: Array, threshold: float | None) -> tuple[float, float, float]:
    """loc, scale and shape of the largest likelihood.

    Parameters
    ----------
    family : Family
    x : (n,) array
    threshold : float or None
        loc of peaks over a threshold.
    """
    center, size = float(x.mean()), float(x.std())
    scale0 = np.log(size * np.sqrt(6.0) / np.pi) if family.blocks else np.log(size)
    shapes = (-0.2, 0.0, 0.1) if family.shaped else (0.0,)
    best: tuple[Array, float] | None = None
    for shape in shapes:
        start = [scale0, shape] if family.shaped else [scale0]
        if family.blocks:
            start.append(center - 0.45 * size)
        found = smallest(
            lambda p: family.loss(x, *_unpacked(family, p, threshold)), np.array(start)
        )
        if best is None or found[1] < best[1]:
            best = found
    assert best is not None
    return _unpacked(family, best[0], threshold)


def _unpacked(family: Family, p: Array, threshold: float | None) -> tuple[float, float, float]:
    """loc, scale, shape from what is looked for: ln scale, shape, loc."""
    shape = float(p[1]) if family.shaped else 0.0
    loc = float(p[-1]) if threshold is None else threshold
    return loc, float(np.exp(p[0])), shape
