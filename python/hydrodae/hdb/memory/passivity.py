"""Passivity of a radiation memory: waves take energy, v^T Re H(i omega) v >= 0 for all v, omega.

A fit that breaks this between the samples can make a free device unstable. `enforce` moves all
parameters of the modes by the least weighted distance such that the violating minima of the
smallest eigenvalue rise above a floor (sequential quadratic programming; each step is a
least-distance problem solved by non-negative least squares).

References
----------
C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, SIAM 1995, ch. 23 (least-distance
programming); B. Gustavsen, A. Semlyen, Enforcing passivity for admittance matrices approximated by
rational functions, IEEE Trans. Power Systems 16 (2001) 97.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import nnls

from hydrodae.hdb.memory.modes import (
    IntArray,
    Modes,
    Problem,
    damped,
    error,
    moved,
    normal_equations,
    real_parts,
    resistance,
)
from hydrodae.hdb.memory.vector_fitting import Array, ComplexArray

CONSTRAIN_BELOW = 2e-3
"""Local minima of the eigenvalues below this share of the largest are held as constraints."""


REFINED, BETWEEN = 8, 13
"""Lowest minima that are looked at between the points of the grid, and points for each."""
ACCEPTED = -5e-5
"""Modes whose smallest eigenvalue of Re H is above this share of the largest are passive."""


class Passivity(NamedTuple):
    """Smallest eigenvalue of Re H relative to the largest, and its frequency [rad/s]."""

    relative: float
    omega: float


class Minima(NamedTuple):
    """Local minima of the eigenvalues of Re H: omega (k,), vectors (k, n); the extremes of all."""

    omega: Array
    vectors: Array
    lowest: float
    largest: float


_UNIFORM, _AROUND, _FAR = (
    np.linspace(0.0, 1.0, 1200),
    np.tan(np.linspace(-1.45, 1.45, 25)),
    np.geomspace(1.0, 20.0, 30),
)


def frequency_grid(poles: ComplexArray, highest: float, points: int = 1200) -> Array:
    """Return a grid [rad/s] from 0 to far beyond poles and data, dense around each pole."""
    span = 1.5 * max(highest, float(np.abs(poles).max()))
    near = poles.imag[:, None] + np.abs(poles.real)[:, None] * _AROUND
    uniform = _UNIFORM if points == _UNIFORM.size else np.linspace(0.0, 1.0, points)
    return np.unique(np.abs(np.concatenate([span * uniform, near.ravel(), span * _FAR])))


def local_minima(modes: Modes, highest: float, below: float = CONSTRAIN_BELOW) -> Minima:
    """Find the local minima of all eigenvalues of Re H under `below` times the largest."""
    omega = frequency_grid(modes.poles, highest)
    matrices = resistance(modes, omega)
    values = eigenvalues(matrices)
    largest = float(values.max())
    padded = np.pad(values, ((1, 1), (0, 0)), constant_values=np.inf)
    lowest = (values <= padded[:-2]) & (values <= padded[2:]) & (values < below * largest)
    at, branch = np.nonzero(lowest)
    between = _between(omega, values[:, 0])
    inner = resistance(modes, between)
    inner_values = eigenvalues(inner)[:, 0]
    best = inner_values.reshape(-1, BETWEEN).argmin(axis=1)
    best += BETWEEN * np.arange(best.size)
    best = best[inner_values[best] < below * largest]
    return Minima(
        np.concatenate([omega[at], between[best]]),
        np.concatenate([eigenvectors(matrices, at, branch), eigenvectors(inner, best, 0 * best)]),
        float(inner_values.min(initial=values[:, 0].min())),
        largest,
    )


def is_passive(modes: Modes, problem: Problem) -> bool:
    """Return whether Re H has no eigenvalue below `ACCEPTED` of the largest, at any frequency."""
    found = local_minima(modes, float(problem.samples.omega.max()))
    return found.lowest >= ACCEPTED * found.largest


def eigenvalues(matrices: Array) -> Array:
    """Return the ascending eigenvalues (k, n) of symmetric matrices."""
    if matrices.shape[-1] == 1:
        return matrices[:, :, 0]
    if matrices.shape[-1] == 2:
        first, second = matrices[:, 0, 0], matrices[:, 1, 1]
        mean, radius = 0.5 * (first + second), np.hypot(0.5 * (first - second), matrices[:, 1, 0])
        return np.stack([mean - radius, mean + radius], axis=1)
    return np.asarray(np.linalg.eigvalsh(matrices))


def eigenvectors(matrices: Array, at: IntArray, branch: IntArray) -> Array:
    """Return the eigenvectors (k, n) of the eigenvalues `branch` (k,) of the matrices `at` (k,)."""
    rows, back = np.unique(at, return_inverse=True)
    return np.asarray(np.linalg.eigh(matrices[rows])[1][back, :, branch])


def _between(omega: Array, values: Array) -> Array:
    """Return frequencies around the lowest local minima of values (nw,), some for each."""
    inner = np.flatnonzero((values[1:-1] <= values[:-2]) & (values[1:-1] <= values[2:])) + 1
    inner = inner[np.argsort(values[inner], kind="stable")[:REFINED]]
    return np.linspace(omega[inner - 1], omega[inner + 1], BETWEEN, axis=1).ravel()


def derivatives(modes: Modes, omega: Array, left: Array, right: Array) -> tuple[Array, Array]:
    """Return d(u^T Re H v)/d(parameters but A_inf), and u^T Re H v (k,), at omega (k,).

    u and v are rows of `left` and `right`, (k, n).
    """
    value, slope = real_parts(modes, omega)
    pair = ~modes.real
    on_left, on_right = left @ modes.vectors.T, right @ modes.vectors.T

    def by_vector(beta: ComplexArray) -> tuple[Array, Array]:
        return (
            beta.real * value[0] + beta.imag * value[1],
            pair * (-beta.imag * value[0] + beta.real * value[1]),
        )

    shape, product = (omega.size, modes.vectors.size), on_left * on_right
    columns = [
        (a[:, None] * left[:, :, None] + b[:, None] * right[:, :, None]).reshape(shape)
        for a, b in zip(by_vector(on_right), by_vector(on_left), strict=True)
    ]
    columns += [
        modes.poles.real * (product.real * slope[0] + product.imag * slope[1]),
        pair * (-product.imag * slope[0] + product.real * slope[1]),
    ]
    form = (product.real * value[0] + product.imag * value[1]).sum(axis=1)
    return np.concatenate(columns, axis=1), form


def least_distance(matrix: Array, gradient: Array, rows: Array, bound: Array) -> Array | None:
    """Return argmin 1/2 d^T matrix d + gradient^T d with rows d >= bound; None if infeasible."""
    lower = cholesky(matrix, lower=True)
    shift = solve_triangular(lower, gradient, lower=True)
    if not bound.size:
        return np.asarray(solve_triangular(lower.T, -shift))
    turned = solve_triangular(lower, rows.T, lower=True).T
    level = bound + turned @ shift
    norm = np.linalg.norm(turned, axis=1)
    turned, level = turned / norm[:, None], level / norm
    scale = max(float(np.abs(level).max()), 1e-300)
    system = np.vstack([turned.T, level / scale])
    target = np.zeros(system.shape[0])
    target[-1] = 1.0
    multipliers, misfit = nnls(system, target, maxiter=30 * system.shape[1])
    if misfit < 1e-10:
        return None
    left = system @ multipliers - target
    return np.asarray(solve_triangular(lower.T, -left[:-1] / left[-1] * scale - shift))


def enforce(
    modes: Modes,
    problem: Problem,
    lowering: float = 0.8,
    floor: float = -1e-5,
    tolerance: float = 1e-5,
    iterations: int = 80,
) -> Modes:
    """Make the modes passive and refit them, all parameters free.

    Parameters
    ----------
    modes
        Start, usually the best unconstrained fit.
    problem
        Data of the fit.
    lowering
        Factor by which the allowed violation shrinks from step to step; nearer to 1 is slower and
        follows the best fit more closely.
    floor, tolerance
        Goal for the smallest eigenvalue of Re H relative to the largest; reached within
        `tolerance`.
    iterations
        Most steps.

    Returns
    -------
    Modes
        The passive ones of least weighted error, or the last ones when the floor was not reached.
    """
    now, minima = error(modes, problem), local_minima(modes, float(problem.samples.omega.max()))
    level, damping, ratio, stalled = minima.lowest / minima.largest, 1e-3, lowering, 0
    best: tuple[float, Modes] | None = None
    for _ in range(iterations):
        if problem.clock.over():
            break
        level = level * ratio if level * ratio < floor - 0.25 * tolerance else floor
        step = _constrained_step(modes, problem, minima, level, tolerance, (now, damping))
        if step is None:
            if ratio > 0.97:
                break
            level, ratio = level / ratio, 0.5 * (1.0 + ratio)
            continue
        trial, minima, value, damping = step
        ratio = max(lowering, 1.4 * ratio - 0.4)
        at_floor = level == floor and minima.lowest / minima.largest >= floor - tolerance
        stalled = stalled + 1 if at_floor and abs(now - value) < 2e-3 * now else 0
        modes, now = trial, value
        if at_floor and (best is None or value < best[0]):
            best = (value, modes)
        if stalled > 2:
            break
    return best[1] if best else modes


def _constrained_step(
    modes: Modes,
    problem: Problem,
    minima: Minima,
    level: float,
    tolerance: float,
    state: tuple[float, float],
) -> tuple[Modes, Minima, float, float] | None:
    """Take one damped Gauss-Newton step with all minima held above `level` times the largest.

    `state`: the error of the modes, and the damping.
    """
    (now, damping), highest = state, float(problem.samples.omega.max())
    matrix, gradient = normal_equations(modes, problem)
    rows, quadratic = derivatives(modes, minima.omega, minima.vectors, minima.vectors)
    rows = np.pad(rows, ((0, 0), (0, problem.rows.size)))
    lack = max(0.0, level - minima.lowest / minima.largest)
    for _ in range(6):
        step = least_distance(
            damped(matrix, damping), gradient, rows, level * minima.largest - quadratic
        )
        if step is not None:
            trial = moved(modes, step, problem)
            value, found = error(trial, problem), local_minima(trial, highest)
            left = max(0.0, level - found.lowest / found.largest)
            if (
                left <= max(0.5 * lack, 0.3 * abs(level), tolerance)
                and value < (1.02 if lack < tolerance else 2.0) * now
            ):
                return trial, found, value, max(damping / 3.0, 1e-7)
        damping *= 4.0
    return None
