r"""Vertical eigenfunctions of the water outside and below a floating cylinder.

Outside, over the whole depth h, with s = z + h the height above the seabed::

    Z_0 = cosh(k s) / N_0,  k tanh(k h) = w^2/g;   Z_m = cos(k_m s) / N_m,  k_m tan(k_m h) = -w^2/g

and, at infinite frequency, where the potential vanishes on the free surface, Z_m only, with
k_m h = (m - 1/2) pi. Below the cylinder, over the gap b = h - draft: P_0 = 1 and
P_q = sqrt(2) cos(q pi s / b). Means over h of Z_m^2 and over b of P_q^2 are 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Outside:
    """Eigenfunctions outside, the propagating one first if there is one.

    Attributes
    ----------
    depth : float
        h [m].
    numbers : (M,) array
        k or k_m [1/m].
    waves : bool
        Whether the first one is the propagating mode (false at infinite frequency).
    norms : (M,) array
        N_m; that of the propagating one over e^{kh}, so that it does not overflow.
    """

    depth: float
    numbers: Array
    waves: bool
    norms: Array

    def at(self, height: float) -> Array:
        """Z_m at a height above the seabed [m], (M,)."""
        values = np.cos(self.numbers * height)
        if self.waves:
            k, h = self.numbers[0], self.depth
            values[0] = 0.5 * (np.exp(k * (height - h)) + np.exp(-k * (height + h)))
        return np.asarray(values / self.norms)

    def integral(self, low: float, high: float) -> Array:
        """Int Z_m ds between two heights above the seabed [m], (M,)."""
        k, h = self.numbers, self.depth
        values = (np.sin(k * high) - np.sin(k * low)) / k
        if self.waves:
            values[0] = _sinh(k[0], high, h) - _sinh(k[0], low, h)
            values[0] /= k[0]
        return np.asarray(values / self.norms)

    def moment(self, low: float, high: float) -> Array:
        """Int s Z_m ds between two heights above the seabed [m2], (M,)."""
        k, h = self.numbers, self.depth

        def primitive(s: float) -> Array:
            values = s * np.sin(k * s) / k + np.cos(k * s) / k**2
            if self.waves:
                cosh = 0.5 * (np.exp(k[0] * (s - h)) + np.exp(-k[0] * (s + h)))
                values[0] = s * _sinh(k[0], s, h) / k[0] - cosh / k[0] ** 2
            return np.asarray(values)

        return np.asarray((primitive(high) - primitive(low)) / self.norms)

    def overlap(self, gap: float, count: int) -> Array:
        """Means (1/b) int_0^b P_q Z_m ds for q < count, (count, M)."""
        k, b = self.numbers, gap
        q = np.pi * np.arange(count)[:, None] / b
        # int cos cos = half the sum of both sinc, which has no poles where k = q
        values = 0.5 * (np.sinc((k - q) * b / np.pi) + np.sinc((k + q) * b / np.pi))
        if self.waves:
            sign = (-1.0) ** np.arange(count)
            values[:, 0] = (
                sign * k[0] * _sinh(k[0], b, self.depth) / (b * (k[0] ** 2 + q[:, 0] ** 2))
            )
        values[1:] *= np.sqrt(2.0)
        return np.asarray(values / self.norms)


def outside(omega: float, depth: float, gravity: float, count: int) -> Outside:
    """Return the first `count` eigenfunctions outside at a frequency [rad/s], which may be inf."""
    if not np.isfinite(omega):
        numbers = np.linspace(0.5, count - 0.5, count) * (np.pi / depth)
        return Outside(depth, numbers, False, np.full(count, np.sqrt(0.5)))
    k = float(wavenumber(omega, depth, gravity))
    x = _evanescent(omega**2 / gravity * depth, count - 1)
    norms: Array = np.empty(count)
    twice = _sinh(k, 2.0 * depth, 2.0 * depth) / (2.0 * k * depth)
    norms[0] = np.sqrt(0.5 * (np.exp(-2.0 * k * depth) + twice))
    norms[1:] = np.sqrt(0.5 * (1.0 + np.sin(2.0 * x) / (2.0 * x)))
    numbers = np.concatenate([np.array([k]), x / depth])
    return Outside(depth, numbers, True, norms)


def _sinh(k: float, s: float, h: float) -> float:
    """sinh(k s) e^{-kh}, without overflow for s <= h."""
    return float(0.5 * (np.exp(k * (s - h)) - np.exp(-k * (s + h))))


def _evanescent(v: float, count: int) -> Array:
    """Roots x_m of x tan x = -v in ((m - 1/2) pi, m pi), by Newton on x - m pi + atan(v/x)."""
    m = np.arange(1, count + 1) * np.pi
    x = m - np.arctan(v / m)
    for _ in range(20):
        x = x - (x - m + np.arctan(v / x)) / (1.0 - v / (x**2 + v**2))
    return np.asarray(x)
