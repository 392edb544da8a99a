r"""The noise of a table: what its values are off the curves through their neighbours, least of all.

A smooth function is nearly a polynomial over a few neighbouring frequencies, and noise is not. The
distance of a value from the polynomial through 2, 4, 6 or 8 neighbours, over the root of 1 + sum of
the squared weights of these, is that of white noise itself; curvature leaves it as neighbours get
more, or as the steps get finer. The least of all numbers of neighbours is what the table is
uncertain by, at least. Values below it say nothing: a phase of a force of 1e-6 N, a damping of
-1e-6 N s/m beside a peak of 1e5.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array

#: Numbers of neighbours, half of them on either side.
NEIGHBOURS = (2, 4, 6, 8)
#: Frequencies at the low end of a table whose scatter is taken, and fewest of a median.
LOWEST, FEWEST = 12, 5


def miss(omega: Array, values: NDArray[Any], neighbours: int) -> tuple[NDArray[Any], Array]:
    """Distances of values (nw, ...) from the polynomial through so many neighbours.

    Returns
    -------
    distance : (nw - neighbours, ...) array
        Of all frequencies but half of the neighbours at either end.
    weights : (nw - neighbours, neighbours) array
        What each neighbour counts.
    """
    half = neighbours // 2
    at = np.arange(half, omega.size - half)
    nodes = at[:, None] + np.r_[-half:0, 1 : half + 1]
    x, near = omega[at], omega[nodes]
    weights = np.ones(near.shape)
    for k in range(neighbours):
        for j in range(neighbours):
            if j != k:
                weights[:, k] *= (x - near[:, j]) / (near[:, k] - near[:, j])
    return values[at] - np.einsum("wk,wk...->w...", weights, values[nodes]), weights


def noises(omega: Array, values: NDArray[Any]) -> Iterator[NDArray[Any]]:
    """Yield the distances (nw - n, ...), n = 2, 4, 6, 8, as those of white noise itself."""
    for neighbours in NEIGHBOURS:
        if omega.size > neighbours:
            off, weights = miss(omega, values, neighbours)
            size = np.sqrt(1.0 + (weights**2).sum(axis=1))
            yield off / size.reshape(-1, *[1] * (values.ndim - 1))


def scatter(omega: Array, values: NDArray[Any]) -> Array:
    """Noise of values (nw, ...) at the lowest frequencies: their least median distance, (...).

    Zero for tables of fewer than 7 frequencies.
    """
    found = np.full(values.shape[1:], np.inf)
    for off in noises(omega[:LOWEST], values[:LOWEST]):
        if len(off) >= FEWEST:
            found = np.minimum(found, np.median(np.abs(off), axis=0))
    return np.where(np.isfinite(found), found, 0.0)


def last_digit(values: Array) -> Array:
    """Smallest step between two neighbours of (nw, ...) values that differ, (...); 0 if none do."""
    step = np.abs(np.diff(values, axis=0))
    least = np.where(step > 0.0, step, np.inf).min(axis=0, initial=np.inf)
    return np.asarray(np.where(np.isfinite(least), least, 0.0))
