"""Linear dispersion relation w^2 = g k tanh(k h)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.support.arrays import Array


def wavenumber(omega: ArrayLike, depth: float, gravity: float) -> Array:
    """Wavenumber k [rad/m] of waves of frequency omega [rad/s] in water of depth h [m].

    Newton iteration on x tanh x = w^2 h / g, to machine precision; `depth` may be infinite.
    """
    w = np.asarray(omega, dtype=float)
    deep = w**2 / gravity
    if not np.isfinite(depth):
        return deep
    a = deep * depth
    x = np.where(a > 1.0, a, np.sqrt(a))
    for _ in range(30):
        t = np.tanh(x)
        slope = t + x * (1.0 - t**2)
        step = np.divide(x * t - a, slope, out=np.zeros_like(x), where=slope > 0.0)
        x, before = x - step, x
        if np.array_equal(x, before):
            break  # further steps change nothing
    return x / depth


def phase_at(
    point: ArrayLike, omega: ArrayLike, heading: ArrayLike, depth: float, gravity: float
) -> Array:
    """Phase k (x cos beta + y sin beta) [rad] of waves at points (..., 2 or more) [m].

    Frequencies [rad/s], headings [rad] and points are taken together as numpy broadcasts them.
    """
    place, beta = np.asarray(point), np.asarray(heading)
    along = place[..., 0] * np.cos(beta) + place[..., 1] * np.sin(beta)
    return np.asarray(wavenumber(omega, depth, gravity) * along)


def frequency(wavenumbers: ArrayLike, depth: float, gravity: float) -> Array:
    """Frequency [rad/s] of waves of the given wavenumbers [rad/m]."""
    k = np.asarray(wavenumbers, dtype=float)
    return np.sqrt(gravity * k * (np.tanh(k * depth) if np.isfinite(depth) else 1.0))


def damping_of_waves(omega: Array, depth: float, gravity: float, rho: float) -> tuple[Array, Array]:
    """Return k [rad/m] and k / (8 rho g c_g) [s/kg], (nw,): half of B_ii over the mean of |F_i|^2.

    The mean is that over all headings: Haskind's relation, as in `hydrodae.hdb.checks.energy`.
    """
    k = wavenumber(omega, depth, gravity)
    return k, k / (8.0 * rho * gravity * group_velocity(omega, depth, gravity))


def group_velocity(omega: Array, depth: float, gravity: float) -> Array:
    """Group velocity c_g = w/(2k) (1 + 2kh / sinh 2kh) of waves, (nw,) [m/s].

    Parameters
    ----------
    omega : (nw,) array
        [rad/s].
    depth, gravity : float
        [m] (may be infinite), [m/s2].
    """
    k = wavenumber(omega, depth, gravity)
    ratio = np.zeros_like(k)
    if np.isfinite(depth):
        kh = np.minimum(2.0 * k * depth, 700.0)
        ratio = kh / np.sinh(kh)
    return np.asarray(0.5 * omega / k * (1.0 + ratio))
