"""Entries of symmetric tables over the roots of their diagonals, and the worst of them."""

from __future__ import annotations

import numpy as np

from hydrodae.support.arrays import Array


def entry_scale(table: Array, least: float = 1e-6) -> Array:
    """Return sqrt(T_ii T_jj) (n, n) of a table (..., n, n), each T_ii the largest over frequency.

    Infinite where it is no more than the share `least` of the largest: such entries are noise.
    """
    n = table.shape[-1]
    diagonal = np.abs(np.diagonal(table, axis1=-2, axis2=-1)).reshape(-1, n).max(axis=0)
    size = np.sqrt(diagonal)
    scale = np.outer(size, size)
    scale[scale <= least * scale.max()] = np.inf
    return scale


def asymmetry(table: Array) -> Array:
    """Return |T - T^T| (nw, n, n) over `entry_scale`."""
    return np.asarray(np.abs(table - table.transpose(0, 2, 1)) / entry_scale(table))


def worst(error: Array) -> tuple[float, tuple[int, ...]]:
    """Return the largest entry and its place."""
    at = tuple(int(i) for i in np.unravel_index(error.argmax(), error.shape))
    return float(error[at]), at
