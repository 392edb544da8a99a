r"""Noise of tables: what of H no smooth function of the frequency follows.

A smooth H is nearly a polynomial over a few neighbouring frequencies, and noise is not. Divided
differences of order n over n + 1 frequencies, their coefficients scaled to unit length, take away
the polynomial and leave white noise as it is. Curvature leaves them with rising order, noise does
not: the least of several orders is what the tables are uncertain by, at least.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.memory.data import in_band
from hydrodae.hdb.memory.modes import Problem
from hydrodae.hdb.memory.vector_fitting import Array

ORDERS = (4, 6, 8)
"""Orders of the differences."""


def noise(problem: Problem, added_mass: Array, band: tuple[float, float]) -> float:
    """Return the noise of Z in the band relative to H, weighted as `Quality.weighted_band` is.

    Parameters
    ----------
    problem
        Samples (nw + 1, ne); the last is that of H(0) = 0.
    added_mass
        (ne,) A_inf.
    band
        (low, high), rad/s.
    """
    samples = problem.samples
    omega, value, weight = samples.omega[:-1], samples.value[:-1], samples.weight[:-1]
    inside = in_band(omega, band)
    size = float(np.linalg.norm((weight * (value - 1j * omega[:, None] * added_mass))[inside]))
    found = [np.inf]
    for order in ORDERS:
        if omega.size <= order or size == 0.0:
            break
        window = np.arange(omega.size - order)[:, None] + np.arange(order + 1)
        x = omega[window]
        apart = x[:, :, None] - x[:, None, :] + np.eye(order + 1) * np.ptp(x, axis=1)[:, None, None]
        coefficients = 1.0 / np.prod(apart / np.ptp(x, axis=1)[:, None, None], axis=2)
        coefficients /= np.linalg.norm(coefficients, axis=1)[:, None]
        left = np.einsum("wk,wke->we", coefficients, value[window])
        middle = window[:, order // 2]
        part = (weight[middle] * left)[inside[middle]]
        # windows whose middle is in the band; not so for the first of the table
        share = float(inside.sum()) / max(1.0, float(inside[middle].sum()))
        if part.size:
            found.append(float(np.linalg.norm(part)) * np.sqrt(share) / size)
    return float(min(found)) if len(found) > 1 else 0.0
