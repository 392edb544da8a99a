"""Kernels in time: how long the memory lasts, and the noncausal excitation kernel."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.database.tables import Tables
from hydrodae.hdb.database.transfer import TransferTables, enough
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array

#: Share of int |K| dt that may be left after the memory length.
REST = 1e-3
#: Longest memory that is looked for [s].
LONGEST = 600.0
#: Times, kernel and length of `decayed_kernel`.
_Decayed = tuple[Array, Array, float]


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


def decayed_kernel(omega: Array, damping: Array, step: float, least: float = 0.0) -> _Decayed:
    """K(t) until well after the memory length (and after `least`), and that length.

    The quadrature is exact, whatever the steps of the frequencies; so no step limits the memory.

    Parameters
    ----------
    omega : (nw,) array
        [rad/s].
    damping : (nw, m) array
        B(w).
    step : float
        Of the time [s].
    least : float
        Time that must be covered one and a half times [s].

    Returns
    -------
    time, kernel : (nt,), (nt, m) arrays
        Up to twice the length; at most `LONGEST`, or one and a half times `least`.
    length : float
        The longest of `envelope_length` [s].
    """
    end = max(60.0, 1.5 * least)
    while True:
        time = np.arange(0.0, end, step)
        kernel = irf.radiation_kernel(omega, damping, time, extrapolate=True)
        length = float(envelope_length(time, kernel).max(initial=0.0))
        if length <= 0.5 * end or end >= LONGEST:
            return time, kernel, length
        end = min(2.5 * end, LONGEST)


def memory_length(database: Tables) -> float:
    """Length [s] of the radiation memory of the coordinates that radiate (diagonal of K).

    Until a thousandth of int |K| dt is left, or H(iw) at the stored frequencies is no better.
    """
    used = np.flatnonzero(scales(database) > 0.0)
    w, (a, b) = database.omega, (database.added_mass, database.radiation_damping)
    time, kernel, found = decayed_kernel(w, b[:, used, used], 0.6 / float(w[-1]))
    size = np.abs(b[:, used, used]).max(axis=0)
    own = TransferTables(w, a[:, used, used], b[:, used, used], size, (0.0, float(w[-1])))
    return enough(own, time, kernel, found) if used.size else float(time[-1])


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
    """Memory [s] within which no image of the grid can be: pi over its largest step (from 0).

    Steps over which no B exceeds a thousandth of its peak do not count: they hold no memory.
    """
    w, b = database.omega, np.abs(np.einsum("wii->wi", database.radiation_damping))
    used = scales(database) > 0.0
    share = np.r_[0.0, (b[:, used] / b[:, used].max(axis=0)).max(axis=1, initial=0.0)]
    steps = np.diff(np.r_[0.0, w])[np.maximum(share[:-1], share[1:]) > REST]
    return float(np.pi / steps.max(initial=w[0]))


def excitation_kernel(database: Tables, time: ArrayLike) -> Array:
    """Excitation kernel K_ex(t) = 1/pi int_0^inf Re(F e^{iwt}) dw, exact for the spline of F.

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
    for i, label in enumerate(database.labels):
        hs = database.bodies[label.body].hydrostatics
        if label.motion == "heave":
            known = None if hs is None else database.rho * database.gravity * hs.waterplane_area
            start[:, i] = database.excitation[0, :, i].real if known is None else known
    knots = np.r_[0.0, database.omega]
    table = np.concatenate([start[None], database.excitation]).reshape(knots.size, -1)
    real, imaginary = (CubicSpline(knots, part) for part in (table.real, table.imag))
    # a few rows at a time: (rows, nw) complex numbers are alive at once
    rows = max(1, 400_000 // knots.size)
    result = np.concatenate(
        [
            irf.spline_fourier(real, part).real - irf.spline_fourier(imaginary, part).imag
            for part in np.split(t, np.arange(rows, t.size, rows))
        ]
    )
    return (result / np.pi).reshape(t.shape + start.shape)
