"""Kernels in time: how long the memory lasts, and the noncausal excitation kernel."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from hydrodae import irf
from hydrodae.hdb.coordinates import split_label
from hydrodae.hdb.scales import scales
from hydrodae.hdb.tables import Tables

Array = NDArray[np.float64]
#: Share of int |K| dt that may be left after the memory length.
REST = 1e-3


def envelope_length(time: Array, kernel: Array, rest: float = REST) -> Array:
    """Smallest time after which no more than `rest` of int |K| dt is left, column by column.

    Parameters
    ----------
    time : (nt,) array
        Equally spaced, from 0 [s].
    kernel : (nt, m) array
        K(t); |K(t)| itself says little, it crosses zero.
    rest : float
        Share that may be left [-].

    Returns
    -------
    (m,) array
        [s]; 0 for a column of zeros.
    """
    size = np.abs(kernel)
    left = np.cumsum(size[::-1], axis=0)[::-1]
    over = left > rest * left[0]
    return np.asarray(time[np.maximum(over.sum(axis=0) - 1, 0)], dtype=float)


def memory_length(database: Tables) -> float:
    """Length [s] of the radiation memory of the coordinates that radiate (diagonal of K).

    At most what the grid resolves (`resolved_time`), beyond which the table says nothing.
    """
    time, kernel = diagonal_kernels(database)
    if kernel.shape[1] == 0:
        return float(time[-1])
    return float(envelope_length(time, kernel).max())


def diagonal_kernels(database: Tables) -> tuple[Array, Array]:
    """Times (nt,) [s] up to what the grid resolves, and K_ii (nt, m) of what radiates."""
    w = database.omega
    used = np.flatnonzero(scales(database) > 0.0)
    b = database.radiation_damping[:, used, used]
    end = min(resolved_time(database), 200.0)
    count = int(np.clip(np.ceil(end * w[-1]), 200, 2000)) + 1
    time = np.linspace(0.0, end, count)
    if used.size == 0:
        return time, np.zeros((count, 0))
    return time, irf.radiation_kernel(w, b, time, extrapolate=True)


def resolved_time(database: Tables) -> float:
    """Longest memory [s] that the grid resolves: pi over its largest step (first one from 0)."""
    return float(np.pi / np.diff(np.r_[0.0, database.omega]).max())


def excitation_kernel(database: Tables, time: ArrayLike) -> Array:
    """Excitation kernel K_ex(t) = 1/pi int_0^inf Re(F e^{iwt}) dw, trapezoid on a fine spline.

    F(0) is the static limit: the heave stiffness where hydrostatics are known, else the first
    value of F; zero for the other coordinates. Nothing is added beyond the last frequency.

    Parameters
    ----------
    database : HydroDatabase
    time : (nt,) array
        [s], negative times too: the kernel is not causal.

    Returns
    -------
    (nt, nh, n) array
        [N/m/s, N m/m/s].
    """
    t = np.asarray(time, dtype=float)
    start = np.zeros(database.excitation.shape[1:], dtype=complex)
    for i, label in enumerate(database.coordinates):
        body, dof = split_label(label)
        hs = database.bodies[body].hydrostatics
        if dof == 2:
            known = None if hs is None else database.rho * database.gravity * hs.waterplane_area
            start[:, i] = database.excitation[0, :, i].real if known is None else known
    knots = np.r_[0.0, database.omega]
    spline = CubicSpline(knots, np.concatenate([start[None], database.excitation]))
    longest = max(np.abs(t).max(initial=1.0), 1.0)
    count = int(np.clip(np.ceil(knots[-1] * longest / 0.4), 400, 8000)) + 1
    w = np.linspace(0.0, knots[-1], count)
    weight = np.full(count, w[1])
    weight[[0, -1]] *= 0.5
    table = (spline(w) * weight[:, None, None]).reshape(count, -1)
    result = np.empty((t.size, table.shape[1]))
    for rows in np.array_split(np.arange(t.size), max(1, t.size // 200)):
        phase = np.outer(t[rows], w)
        result[rows] = np.cos(phase) @ table.real - np.sin(phase) @ table.imag
    return (result / np.pi).reshape(t.shape + start.shape)
