"""Power laws that radiation damping follows beyond the last frequency of a table.

B(w) ~ B(w_max) (w / w_max)^-n, pair by pair, and its parts of K(t) and of A_inf - A(w).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from hydrodae.support.arrays import Array

TAIL_POWERS = (2.0, 8.0)  # range of n in c w^-n
TAIL_FROM = 0.7  # the tail is fitted to w > TAIL_FROM w_max
TAIL_SCATTER = 0.05  # largest rms of ln|B| about its fit that counts as clean [-]


@cache
def leggauss(count: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre quadrature on -1..1, (count,) each."""
    return legendre.leggauss(count)


@dataclass(frozen=True)
class Tail:
    """B(w) ~ B(w_max) (w / w_max)^-n beyond the last frequency, pair by pair.

    Attributes
    ----------
    amplitude : (m,) array
        B(w_max) where the tail is used, 0 where the table is cut off.
    power : (m,) array
        Exponent n, within `TAIL_POWERS`.
    """

    amplitude: Array
    power: Array

    @property
    def used(self) -> NDArray[np.bool_]:
        """(m,) True where a tail is used."""
        return np.asarray(self.amplitude != 0.0)


def fit_tail(omega: ArrayLike, damping: ArrayLike) -> Tail:
    """Fit B ~ c w^-n to the last points, pair by pair.

    A tail is used only if the points above 0.7 w_max (at least 4) keep their sign and lie within
    5 % rms of the fit, and B falls there (n > 0.5). n is then clamped to 2..8.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    damping : (nw, m) array
        B(w).
    """
    w = np.asarray(omega, dtype=float)
    b = np.asarray(damping, dtype=float)
    last = w > TAIL_FROM * w[-1]
    if last.sum() < 4:
        return no_tail(b.shape[1])
    y = b[last]
    one_sign = np.all(y > 0.0, axis=0) | np.all(y < 0.0, axis=0)
    logs = np.log(np.where(one_sign, np.abs(y), 1.0))
    u2 = (w[-1] / w[last]) ** 2
    design = np.stack([np.ones_like(u2), 0.5 * np.log(u2), u2 - 1.0], axis=1)
    line, _, scatter = _fit(design[:, :2], logs)
    curve, curve_power, curve_scatter = _fit(design, logs)
    clean = one_sign & (np.minimum(scatter, curve_scatter) < TAIL_SCATTER) & (line > 0.5)
    # smooth tables determine the next term too, B ~ c u^n exp(d (u^2 - 1)), u = w_max/w: take the
    # power that encloses the same area
    d = curve_power[2]
    smooth = (curve_scatter < 1e-3) & (np.abs(curve - line) < 1.0) & (np.abs(d) < 0.5)
    safe = np.where(smooth & (curve > 1.2), curve, 3.0)
    area = (1.0 - d) / (safe - 1.0) + d / (safe + 1.0)
    same_area = 1.0 + 1.0 / np.where(area > 0.05, area, 1.0)
    power = np.where(smooth & (curve > 1.2) & (area > 0.05), same_area, line)
    power = np.clip(power, *TAIL_POWERS)
    return Tail(np.where(clean, b[-1], 0.0), np.where(clean, power, TAIL_POWERS[1]))


def _fit(design: Array, logs: Array) -> tuple[Array, Array, Array]:
    """Least squares in log-log axes: exponent (m,), all coefficients (k, m), rms scatter (m,)."""
    coefficients = np.asarray(np.linalg.lstsq(design, logs, rcond=None)[0], dtype=float)
    scatter = np.sqrt(np.mean((logs - design @ coefficients) ** 2, axis=0))
    return coefficients[1], coefficients, np.asarray(scatter, dtype=float)


def no_tail(pairs: int) -> Tail:
    """Return the tail of a table that is cut off."""
    return Tail(np.zeros(pairs), np.full(pairs, TAIL_POWERS[1]))


def _power_nodes(count: int = 28) -> tuple[Array, Array]:
    """Chebyshev points in the exponent n and their barycentric weights."""
    j = np.arange(count)
    low, high = TAIL_POWERS
    points = 0.5 * (low + high) + 0.5 * (high - low) * np.cos(np.pi * j / (count - 1))
    weights = (-1.0) ** j
    weights[[0, -1]] *= 0.5
    return points, np.asarray(weights, dtype=float)


def _interpolation(power: Array) -> Array:
    """Matrix (m, nodes) from values at the Chebyshev points in n to values at `power`."""
    points, weights = _power_nodes()
    difference = power[:, None] - points
    exact = np.abs(difference) < 1e-13
    terms = weights / np.where(exact, 1.0, difference)
    matrix = terms / terms.sum(axis=1, keepdims=True)
    hit = exact.any(axis=1)
    matrix[hit] = exact[hit]
    return np.asarray(matrix, dtype=float)


def tail_cosine(tail: Tail, w_max: float, t: Array) -> Array:
    """Return int_{w_max}^inf of the tail times cos(wt); (nt, m).

    With y = w_max t: amplitude w_max Re int_1^inf x^-n e^{iyx} dx, in u = ln x up to x = 1 + 30/y,
    then along x = X + i s/y, where the integrand only decays.
    """
    result = np.zeros((t.size, tail.amplitude.size))
    if not np.any(tail.used):
        return result
    points, _ = _power_nodes()
    y = np.maximum(w_max * t, 1e-9)
    gauss, gauss_weight = leggauss(160)
    end = np.log1p(30.0 / y)  # (nt,)
    values = np.empty((t.size, points.size))
    lag, lag_weight = np.polynomial.laguerre.laggauss(24)
    for i, n in enumerate(points):
        upper = np.minimum(end, 40.0 / (n - 1.0))
        u = 0.5 * upper[:, None] * (1.0 + gauss)
        near = (np.exp((1.0 - n) * u) * np.cos(y[:, None] * np.exp(u))) @ gauss_weight
        x_end = np.exp(upper)
        path = (x_end[:, None] + 1j * lag / y[:, None]) ** (-n) @ lag_weight
        far = (1j / y * np.exp(1j * y * x_end) * path).real
        values[:, i] = 0.5 * upper * near + np.where(upper < end, 0.0, far)
    used = tail.used
    result[:, used] = w_max * (values @ _interpolation(tail.power[used]).T) * tail.amplitude[used]
    return result


def tail_kramers_kronig(tail: Tail, w: Array) -> Array:
    """Return amplitude/w_max int_0^1 (u^n - 1) / (1 - x^2 u^2) du with x = w/w_max; (nw, m)."""
    result = np.zeros((w.size, tail.amplitude.size))
    if not np.any(tail.used):
        return result
    points, _ = _power_nodes()
    nodes, weights = leggauss(80)
    u = 0.5 * (1.0 + nodes)
    x = w / w[-1]
    green = 0.5 * weights / (1.0 - (x[:, None] * u) ** 2)
    values = green @ (u[:, None] ** points - 1.0)
    used = tail.used
    result[:, used] = (values @ _interpolation(tail.power[used]).T) * tail.amplitude[used] / w[-1]
    return result
