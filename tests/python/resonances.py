"""Radiation as a sum of resonances: its tables, transfer function and kernel in closed form."""

from __future__ import annotations

import numpy as np
from tests.verification.point_absorbers import Table

# Each resonance is r s / (s^2 + 2 a s + w0^2) v v^T: a damped cosine, passive, zero at s = 0.
RESONANCES = (
    (0.30, 0.80, 4.0e4, (1.0, 0.2, 3.0)),
    (0.12, 1.50, 1.0e4, (0.3, -1.0, 1.0)),
    (0.40, 2.20, 2.0e4, (-0.5, 0.4, 2.0)),
)
ADDED_MASS_INF = np.array([[5.0e4, 1.0e3, 2.0e4], [1.0e3, 3.0e4, 0.0], [2.0e4, 0.0, 9.0e5]])
LABELS = ("float.surge", "float.heave", "float.pitch")


def exact_transfer(omega: np.ndarray) -> np.ndarray:
    s = 1j * omega[:, None, None]
    return sum(
        r * s / (s**2 + 2 * a * s + w0**2) * np.outer(v, v) for a, w0, r, v in RESONANCES
    ) + np.zeros((omega.size, 3, 3))


def exact_kernel(time: np.ndarray) -> np.ndarray:
    kernel = np.zeros((time.size, 3, 3))
    for a, w0, r, v in RESONANCES:
        wd = np.sqrt(w0**2 - a**2)
        scalar = r * np.exp(-a * time) * (np.cos(wd * time) - a / wd * np.sin(wd * time))
        kernel += scalar[:, None, None] * np.outer(v, v)
    return kernel


def table(transfer: np.ndarray, omega: np.ndarray) -> Table:
    added_mass = ADDED_MASS_INF + transfer.imag / omega[:, None, None]
    return Table(LABELS, omega, added_mass, transfer.real.copy())
