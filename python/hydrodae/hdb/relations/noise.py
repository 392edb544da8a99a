"""The noise of a table itself: what its values scatter by about smooth curves, and its last digit.

Values below it say nothing: a phase of a force of 1e-6 N, a damping of -1e-6 N s/m beside a peak of
1e5. Checks judge a value to a tolerance only where that is above the noise.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array

#: Frequencies at the low end of a table whose scatter is taken.
LOWEST = 12


def cubic_miss(omega: Array, values: NDArray[Any]) -> Array:
    """Distance of values (nw, ...) from the cubic through two neighbours on either side.

    Returns
    -------
    (nw - 4, ...) array
        Of all frequencies but the first and last two.
    """
    at = np.arange(2, omega.size - 2)
    nodes = at[:, None] + np.array([-2, -1, 1, 2])
    weights = _weights(omega[at], omega[nodes])
    return np.asarray(np.abs(values[at] - np.einsum("wk,wk...->w...", weights, values[nodes])))


def scatter(omega: Array, values: NDArray[Any]) -> Array:
    """Noise of values (nw, ...) at the lowest frequencies: their median scatter, (...).

    By the distance from the polynomials through two, four and six neighbours: noise is in all of
    them, the curve of a coarse table leaves less in each. The least counts. Zero for tables of
    fewer than 7 frequencies.
    """
    found = np.full(values.shape[1:], np.inf)
    for neighbours in (2, 4, 6):
        if omega.size >= neighbours + 5:
            found = np.minimum(found, _scatter(omega[:LOWEST], values[:LOWEST], neighbours))
    return np.where(np.isfinite(found), found, 0.0)


def _scatter(omega: Array, values: NDArray[Any], neighbours: int) -> Array:
    """Median distance from the polynomial through so many neighbours, over that of noise of 1."""
    half = neighbours // 2
    at = np.arange(half, omega.size - half)
    nodes = at[:, None] + np.r_[-half:0, 1 : half + 1]
    weights = _weights(omega[at], omega[nodes])
    miss = np.abs(values[at] - np.einsum("wk,wk...->w...", weights, values[nodes]))
    size = np.sqrt(1.0 + (weights**2).sum(axis=1)).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(np.median(miss / size, axis=0))


def last_digit(values: Array) -> Array:
    """Smallest step between two neighbours of (nw, ...) values that differ, (...); 0 if none do."""
    step = np.abs(np.diff(values, axis=0))
    least = np.where(step > 0.0, step, np.inf).min(axis=0, initial=np.inf)
    return np.asarray(np.where(np.isfinite(least), least, 0.0))


def _weights(x: Array, nodes: Array) -> Array:
    """Weights (n, 4) that interpolate from nodes (n, 4) to x (n,)."""
    result = np.ones(nodes.shape)
    for k in range(nodes.shape[1]):
        for j in range(nodes.shape[1]):
            if j != k:
                result[:, k] *= (x - nodes[:, j]) / (nodes[:, k] - nodes[:, j])
    return result
