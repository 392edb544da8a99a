r"""Linear equivalents of nonlinear loads, for motions that are Gaussian or one harmonic.

The linear load that misses a law f(u) least in the mean square, B u, has

    B <u u^T> = <f(u) u^T>

so that it takes the same mean power. Along the principal axes e_k of the motion, u = sum of
s_k z_k e_k, the quadratic drag f = |u| u has

    B = sum of e_k e_k^T <|u| z_k^2> / <z_k^2>

In a random sea z_k are independent normal numbers (Borgman 1969; Atalik and Utku, Earthquake
Engineering and Structural Dynamics 4 (1976) 411-420): along one axis B = sqrt(8/pi) sigma. In a
regular wave u runs on an ellipse, z_1 = cos, z_2 = sin (Lorentz): along one axis
B = 8/(3 pi) |U|.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hydrodae.support.arrays import Array, Complex

#: Laws of one rate: load against the motion [N, N m] over the rate [m/s, rad/s].
Law = Callable[[Array], Array]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)
#: Where laws of one rate are sampled: normal numbers, and phases of a cycle.
NORMAL = np.linspace(-8.0, 8.0, 8001)
CYCLE = 2.0 * np.pi * (np.arange(4097) + 0.5) / 4096
#: Corners of a law that are sought, and pieces of the intervals beside them.
CORNERS, PIECES = 8, 256


def _quarter() -> tuple[Array, Array]:
    """Angles of a quarter circle, and weights whose sum is 1."""
    return 0.25 * np.pi * (NODES + 1.0), 0.5 * WEIGHTS


def _directions(count: int) -> tuple[Array, Array]:
    """Unit vectors (m, count) over one orthant, and weights whose sum is 1."""
    angle, weight = _quarter()
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    if count == 2:
        return circle, weight
    up = 0.5 * (NODES + 1.0)  # cos of the polar angle, uniform on a sphere
    around = np.sqrt(1.0 - up**2)[:, None, None] * circle[None]
    height = np.broadcast_to(up[:, None, None], (*around.shape[:2], 1))
    return (
        np.concatenate([around, height], axis=2).reshape(-1, 3),
        np.outer(0.5 * WEIGHTS, weight).ravel(),
    )


def gauss_drag(covariance: Array) -> Array:
    """Equivalent of |u| u for a Gaussian u without a mean.

    Parameters
    ----------
    covariance : (n, d, d) array
        <u u^T> of n points, d = 1 to 3 [m2/s2].

    Returns
    -------
    (n, d, d) array
        B [m/s].
    """
    if covariance.shape[-1] == 1:
        return np.asarray(np.sqrt(8.0 / np.pi * np.maximum(covariance, 0.0)))
    values, axes = np.linalg.eigh(covariance)
    d = values.shape[1]
    # <|u| z_k^2> = <r^3> times the mean over directions, r^2 the sum of d squares of normals.
    cubed = 3.0 * np.sqrt(0.5 * np.pi) if d == 2 else 8.0 * np.sqrt(2.0 / np.pi)
    directions, weights = _directions(d)
    speed = np.sqrt(np.maximum(values, 0.0) @ (directions**2).T)
    factor = cubed * (speed * weights) @ directions**2
    return np.asarray(np.einsum("nik,nk,njk->nij", axes, factor, axes))


def lorentz_drag(amplitude: Complex) -> Array:
    """Equivalent of |u| u for u = Re(U e^{iwt}).

    Parameters
    ----------
    amplitude : (n, d) complex array
        U of n points, d = 1 to 3 [m/s].

    Returns
    -------
    (n, d, d) array
        B [m/s]; across the plane of the motion the mean speed.
    """
    if amplitude.shape[-1] == 1:
        return np.asarray(8.0 / (3.0 * np.pi) * np.abs(amplitude)[:, :, None])
    d = amplitude.shape[1]
    square = 0.5 * np.einsum("ni,nj->nij", amplitude, amplitude.conj()).real
    values, axes = np.linalg.eigh(square)
    half = np.sqrt(2.0 * np.maximum(values, 0.0))  # half axes of the ellipse, ascending
    angle, weight = _quarter()
    small, large = half[:, d - 2, None], half[:, d - 1, None]
    speed = np.hypot(large * np.cos(angle), small * np.sin(angle))
    factor = np.empty((len(amplitude), d))
    factor[:, d - 1] = 2.0 * (speed * np.cos(angle) ** 2) @ weight
    factor[:, d - 2] = 2.0 * (speed * np.sin(angle) ** 2) @ weight
    if d == 3:
        factor[:, 0] = speed @ weight
    return np.asarray(np.einsum("nik,nk,njk->nij", axes, factor, axes))


def gauss_law(law: Law, sigma: float) -> tuple[float, float]:
    """Damping c = <f v> / sigma^2 of a law for a Gaussian rate, and its mean load <f>."""

    def sample(z: Array) -> tuple[Array, Array, Array]:
        return z, law(sigma * z), np.exp(-0.5 * z**2) / np.sqrt(2.0 * np.pi)

    work, mean = _means(sample, NORMAL)
    return work / sigma, mean


def lorentz_law(law: Law, amplitude: float) -> tuple[float, float]:
    """Damping c = 2 <f cos> / V of a law for the rate V cos, and its mean load <f>."""

    def sample(phase: Array) -> tuple[Array, Array, Array]:
        z = np.cos(phase)
        return z, law(amplitude * z), np.full(z.shape, 0.5 / np.pi)

    work, mean = _means(sample, CYCLE)
    return 2.0 * work / amplitude, mean


def _means(
    sample: Callable[[Array], tuple[Array, Array, Array]], grid: Array
) -> tuple[float, float]:
    """<f z> and <f> by trapezoids over equal steps, finer where f has corners (limits).

    Parameters
    ----------
    sample : callable
        z, f and their density at places of the grid.
    grid : (n,) array
    """
    z, f, density = sample(grid)
    step = grid[1] - grid[0]
    bend = np.abs(f[2:] - 2.0 * f[1:-1] + f[:-2])
    corners = np.argpartition(bend, -CORNERS)[-CORNERS:] + 1
    cells = np.unique([corners - 1, corners])
    places = grid[cells][:, None] + step * np.linspace(0.0, 1.0, PIECES + 1)
    inside = [values.reshape(places.shape) for values in sample(places.ravel())]

    def mean(values: Array, fine: Array) -> float:
        rough = 0.5 * (values[cells] + values[cells + 1]).sum()
        better = (fine.sum() - 0.5 * (fine[:, 0] + fine[:, -1]).sum()) / PIECES
        return float(step * (values.sum() - 0.5 * (values[0] + values[-1]) - rough + better))

    return (
        mean(density * f * z, inside[2] * inside[1] * inside[0]),
        mean(density * f, inside[2] * inside[1]),
    )
