"""Passivity by a penalty on what Re H lacks: fast far from the limit, for many coordinates too.

With the eigenvalues l_j and eigenvectors q_j of Re H(i omega) on a grid, each relative to the
largest, least squares of the fit are extended by

    mu sum_{omega, j} min(0, l_j - margin)^2 .

Where bodies radiate in few directions many eigenvalues lie near zero together, and a step that
lifts each of them along its own eigenvector turns the others; its curvature therefore holds the
products q_i^T dH q_j of all pairs that lie below the margin, as the second derivative of such a
spectral function does. The margin rises until the smallest eigenvalue between the points passes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve

from hydrodae.hdb.memory.modes import (
    Modes,
    Problem,
    damped,
    error,
    moved,
    normal_equations,
    resistance,
)
from hydrodae.hdb.memory.passivity import (
    derivatives,
    eigenvalues,
    eigenvectors,
    local_minima,
)
from hydrodae.hdb.memory.vector_fitting import Array

FLOOR = -4e-5
"""Smallest eigenvalue of Re H over the largest that ends the search."""
MARGINS = (-1e-5, 3e-4)
"""First and largest margin."""
POINTS = 120
"""Uniform points of the grid."""
LOOSENED = 10.0
"""Penalties of more than this times the error are not raised further."""


@dataclass(frozen=True)
class _Low:
    """Eigenpairs below the margin: omega (k,), vectors (k, n), values (k,) over the largest."""

    omega: Array
    vectors: Array
    values: Array


def press(
    modes: Modes, problem: Problem, good: Callable[[Modes], bool], iterations: int = 30
) -> Modes:
    """Refit the modes with a growing penalty until they are passive and good.

    Parameters
    ----------
    modes
        Start, usually the best unconstrained fit.
    problem
        Data of the fit.
    good
        Returns whether the error of the fit is small enough: the search ends there.
    iterations
        Most steps.

    Returns
    -------
    Modes
        The passive ones of least weighted error, or the last ones when the floor was not reached.
    """
    highest, top = float(problem.samples.omega.max()), 0.0
    best: tuple[float, Modes] | None = None
    margin, damping, factor, stalled = MARGINS[0], 1e-3, 0.0, 0
    for _ in range(iterations):
        if problem.clock.over():
            break
        strict = local_minima(modes, highest)
        top, now = strict.largest, error(modes, problem)
        lowest = strict.lowest / strict.largest
        if lowest >= FLOOR:
            if best is not None and now > 0.98 * best[0]:
                stalled += 1
            if best is None or now < best[0]:
                best = now, modes
            if good(modes) or stalled > 2:
                break
        grid = np.union1d(_grid(modes, highest), strict.omega)
        lack = _lack(modes, grid, margin, top)
        if factor == 0.0 and lack.values.size:
            factor = 0.3 * now**2 / float(lack.values @ lack.values)
        weights = (margin, top, factor, damping)
        modes, damping, gain = _step(modes, problem, grid, lack, weights)
        if lowest < FLOOR and gain < 0.3:
            size = factor * float(lack.values @ lack.values)
            if size < LOOSENED * now**2:
                factor *= 4.0
            else:
                margin = min(margin + max(1e-5, 0.5 * (FLOOR - lowest)), MARGINS[1])
        if damping > 1e6:
            break
    return best[1] if best else modes


def _grid(modes: Modes, highest: float) -> Array:
    """Return frequencies [rad/s] from 0 to far beyond poles and data, with some at each pole."""
    span = 1.5 * max(highest, float(np.abs(modes.poles).max()))
    around = np.array([-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0])
    near = np.abs(modes.poles.imag[:, None] + np.abs(modes.poles.real)[:, None] * around)
    far = span * np.geomspace(1.05, 20.0, 12)
    return np.unique(np.concatenate([np.linspace(0.0, span, POINTS), near.ravel(), far]))


def _lack(modes: Modes, grid: Array, margin: float, top: float) -> _Low:
    """Return the eigenpairs of Re H / top below the margin, and by how much."""
    matrices = resistance(modes, grid)
    values = eigenvalues(matrices)
    at, branch = np.nonzero(values < margin * top)
    vectors = eigenvectors(matrices, at, branch)
    return _Low(grid[at], vectors, values[at, branch] / top - margin)


def _lacking(modes: Modes, grid: Array, margin: float, top: float) -> Array:
    """Return by how much eigenvalues of Re H / top are below the margin."""
    values = eigenvalues(resistance(modes, grid)) / top - margin
    return np.asarray(values[values < 0.0])


def _step(
    modes: Modes,
    problem: Problem,
    grid: Array,
    low: _Low,
    weights: tuple[float, float, float, float],
) -> tuple[Modes, float, float]:
    """Take one damped Newton step; return the modes, the damping, and the share that was won."""
    margin, top, factor, damping = weights
    matrix, gradient = normal_equations(modes, problem)
    before = error(modes, problem) ** 2 + factor * float(low.values @ low.values)
    for rows, values in _rows(modes, low, top):
        if problem.clock.over():
            return modes, damping, 0.0
        inner = rows.shape[1]
        matrix[:inner, :inner] += factor * (rows.T @ rows)
        gradient[:inner] += factor * (rows.T @ values)
    for _ in range(6):
        if problem.clock.over():
            break
        try:
            step = -cho_solve(cho_factor(damped(matrix, damping)), gradient)
        except LinAlgError:
            damping *= 5.0
            continue
        trial = moved(modes, step, problem)
        left = _lacking(trial, grid, margin, top)
        after = error(trial, problem) ** 2 + factor * float(left @ left)
        if after < before:
            return trial, max(damping / 5.0, 1e-7), 1.0 - after / before
        damping *= 5.0
    return modes, damping, 0.0


def _rows(modes: Modes, low: _Low, top: float) -> Iterator[tuple[Array, Array]]:
    """Yield derivatives of q_i^T Re H q_j / top and residuals, some thousand rows at a time."""
    i, j = _pairs(low.omega)
    values = np.where(i == j, low.values[i], 0.0)
    for pick in np.array_split(np.arange(i.size), i.size // 2000 + 1):
        left, right = low.vectors[i[pick]], low.vectors[j[pick]]
        rows = derivatives(modes, low.omega[i[pick]], left, right)[0] / top
        rows *= np.where(i[pick] == j[pick], 1.0, np.sqrt(2.0))[:, None]
        yield rows, values[pick]


def _pairs(omega: Array) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices i <= j of all pairs at equal frequency; omega is sorted."""
    starts = np.append(np.flatnonzero(np.diff(omega, prepend=-1.0) > 0.0), omega.size)
    first, second = [np.zeros(0, int)], [np.zeros(0, int)]
    for start, end in pairwise(starts):
        i, j = _upper(int(end - start))
        first.append(start + i)
        second.append(start + j)
    return np.concatenate(first), np.concatenate(second)


@cache
def _upper(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices i <= j of a matrix of this size."""
    return np.triu_indices(size)
