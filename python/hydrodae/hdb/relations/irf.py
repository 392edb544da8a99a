r"""Radiation kernel K(t) and added mass at infinite frequency from tables of A(w) and B(w).

Ogilvie's relations (J. F. Ogilvie, 5th Symp. Naval Hydrodynamics, 1964) for e^{+iwt}:

    K(t)  = 2/pi  int_0^inf B(w) cos(w t) dw
    A_inf = A(w) + 1/w int_0^inf K(t) sin(w t) dt
          = A(w) + 2/pi PV int_0^inf B(s) / (w^2 - s^2) ds

B is taken as the cubic spline through B(0) = 0 and the given points, integrated exactly, plus a
tail c w^-n beyond the last frequency wherever the last points follow one. The second form of A_inf
needs no time grid; because PV int ds/(w^2 - s^2) = 0 it is evaluated without a singularity as
2/pi int (B(s) - B(w)) / (w^2 - s^2) ds.

All functions take tables with the frequency first and any shape behind it, e.g. (nw, n, n).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline, PchipInterpolator

from hydrodae.errors import DatabaseError
from hydrodae.hdb.relations.tails import (
    fit_tail,
    leggauss,
    no_tail,
    tail_cosine,
    tail_kramers_kronig,
)
from hydrodae.support.arrays import Array, Complex

BAND_FROM = 0.3  # A_inf: least squares over w > BAND_FROM w_max
#: Terms of a series for |z| < 1: z^17 / 17! is below rounding.
SERIES = 17
LOW_AREA = 0.005  # smallest share of int B dw below w_min that matters [-]
LOW_GAP = 0.1  # w_min above LOW_GAP w_peak: the gap down to w = 0 is extrapolation


def radiation_kernel(
    omega: ArrayLike,
    damping: ArrayLike,
    time: ArrayLike,
    *,
    tail: bool = True,
    extrapolate: bool = False,
) -> Array:
    """Radiation kernel K(t) by exact quadrature of a cubic spline plus a power-law tail.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies [rad/s], ascending, > 0; at least 4.
    damping : (nw, ...) array
        Radiation damping B(w) [N s/m, N s, N m s].
    time : (nt,) array
        Times [s], >= 0.
    tail : bool
        Add c w^-n beyond the last frequency for the pairs that follow one (`fit_tail`).
    extrapolate : bool
        Accept a table that begins above a tenth of the peak frequency of B.

    Returns
    -------
    (nt, ...) array
        K(t) [N/m, N, N m].

    Raises
    ------
    DatabaseError
        Bad table, or the first frequency is too high (`low_frequency_gap`).
    """
    w, b, shape = _table(omega, damping)
    t = np.asarray(time, dtype=float)
    if t.ndim != 1 or t.size == 0 or t.min() < 0.0:
        raise DatabaseError(
            "the times of a radiation kernel must be a list of numbers >= 0 [s]"
        ).about("option", "time")
    if not extrapolate:
        _refuse_gap(w, b)
    spline = _spline(w, b)
    fitted = fit_tail(w, b) if tail else no_tail(b.shape[1])
    kernel = np.empty((t.size, b.shape[1]))
    for rows in _chunks(t.size, 4 * w.size):
        kernel[rows] = spline_fourier(spline, t[rows]).real + tail_cosine(fitted, w[-1], t[rows])
    return (2.0 / np.pi * kernel).reshape(t.shape + shape)


def kramers_kronig(omega: ArrayLike, damping: ArrayLike, *, tail: bool = True) -> Array:
    """Return 1/w int K(t) sin(wt) dt = A_inf - A(w) at the frequencies of the table.

    Parameters
    ----------
    omega, damping, tail
        As in `radiation_kernel`. For a pair without tail the table is cut off at w_max, and values
        close to w_max (within a few per cent) mean little.

    Returns
    -------
    (nw, ...) array
        In the units of added mass.

    Notes
    -----
    The range 0..w_max is integrated by 6 Gauss points per interval of the spline, the tail in
    closed form with u = w_max/s: int_0^1 (u^n - 1)/(1 - x^2 u^2) du and artanh(x)/x, x = w/w_max.
    """
    w, b, shape = _table(omega, damping)
    spline = _spline(w, b)
    fitted = fit_tail(w, b) if tail else no_tail(b.shape[1])
    knots = spline.x
    nodes, weights = leggauss(6)
    half = 0.5 * np.diff(knots)
    s = (knots[:-1, None] + half[:, None] * (1.0 + nodes)).ravel()
    ds = (half[:, None] * weights).ravel()
    bs = spline(s)
    result = np.empty_like(b)
    for rows in _chunks(w.size, s.size):
        green = ds / (w[rows, None] ** 2 - s**2)
        result[rows] = green @ bs - green.sum(axis=1)[:, None] * b[rows]
    # the last point of a pair without tail is singular (a jump of B): take it a quarter step inside
    x = np.minimum(w / w[-1], 1.0 - 0.25 * (w[-1] - w[-2]) / w[-1])
    jump = b - fitted.amplitude
    jump[-1] = np.where(fitted.used, 0.0, jump[-1])
    result += jump * (np.arctanh(x) / x)[:, None] / w[-1]
    result -= tail_kramers_kronig(fitted, w)
    return (2.0 / np.pi * result).reshape(w.shape + shape)


def added_mass_inf_estimates(
    omega: ArrayLike, added_mass: ArrayLike, damping: ArrayLike, *, tail: bool = True
) -> Array:
    """A_inf estimated at every single frequency; its scatter shows bad frequencies.

    Parameters
    ----------
    omega, damping, tail
        As in `radiation_kernel`.
    added_mass : (nw, ...) array
        A(w).

    Returns
    -------
    (nw, ...) array
        A(w) + 1/w int K sin(wt) dt.
    """
    a = np.asarray(added_mass, dtype=float)
    b = np.asarray(damping, dtype=float)
    if a.shape != b.shape:
        raise DatabaseError(
            f"added mass {a.shape} and radiation damping {b.shape} differ in shape"
        ).about("shape")
    return a + kramers_kronig(omega, b, tail=tail)


def added_mass_inf(
    omega: ArrayLike,
    added_mass: ArrayLike,
    damping: ArrayLike,
) -> tuple[Array, Array]:
    """Added mass at infinite frequency by least squares on Ogilvie's relation.

    Minimises sum over w > 0.3 w_max of [w A_inf - (w A(w) + int K sin(wt) dt)]^2, that is the mean
    of the per-frequency estimates with weights w^2. Estimates further than 5 robust standard
    deviations from their median (irregular frequencies) are left out.

    Parameters
    ----------
    omega, added_mass, damping
        As in `added_mass_inf_estimates`.

    Returns
    -------
    value : (...) array
        A_inf.
    std : (...) array
        Weighted standard deviation of all estimates in the band, outliers included: the
        uncertainty of A_inf as far as the table itself shows it.
    """
    w = np.asarray(omega, dtype=float)
    estimate = added_mass_inf_estimates(w, added_mass, damping)
    shape = estimate.shape[1:]
    # the last two points depend on how the table goes on beyond its end
    band = np.flatnonzero(w > BAND_FROM * w[-1])[:-2]
    if band.size < 3:
        band = np.arange(w.size)
    e = estimate.reshape(w.size, -1)[band]
    weight = np.broadcast_to(w[band, None] ** 2, e.shape)
    middle = np.median(e, axis=0)
    spread = 1.4826 * np.median(np.abs(e - middle), axis=0)
    kept = np.abs(e - middle) <= 5.0 * spread
    value = (weight * kept * e).sum(axis=0) / (weight * kept).sum(axis=0)
    std = np.sqrt((weight * (e - value) ** 2).sum(axis=0) / weight.sum(axis=0))
    return value.reshape(shape), std.reshape(shape)


def low_frequency_gap(omega: ArrayLike, damping: ArrayLike) -> float:
    """First frequency of the table over the frequency of the largest B.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    damping : (nw, ...) array
        B(w); the worst pair counts. Pairs whose area below the first frequency, at most
        w_min B(w_min), is under 0.5 % of the whole are left out, and so are negligible pairs.

    Returns
    -------
    float
        w_min / w_peak [-], 0 if no pair counts; above 0.1, K(t) rests on a guess below w_min.
    """
    w, b, _ = _table(omega, damping)
    size = np.abs(b)
    area = np.trapezoid(size, w, axis=0)
    # a table that starts where B is already negligible leaves nothing to guess
    guessed = (w[0] * size[0] > LOW_AREA * area) & (area > 1e-6 * area.max(initial=0.0))
    if not np.any(guessed):
        return 0.0
    return float(np.max(w[0] / w[size.argmax(axis=0)][guessed]))


def _refuse_gap(w: Array, b: Array) -> None:
    gap = low_frequency_gap(w, b)
    if gap > LOW_GAP:
        raise DatabaseError(
            f"the table begins at w = {w[0]:.4g} rad/s, {gap:.2g} times the peak frequency of the "
            f"radiation damping: K(t) would rest on a guess below it; compute lower frequencies "
            f"(or pass extrapolate=True)"
        ).about("frequencies", "gap")


def _table(omega: ArrayLike, values: ArrayLike) -> tuple[Array, Array, tuple[int, ...]]:
    w = np.asarray(omega, dtype=float)
    b = np.asarray(values, dtype=float)
    if w.ndim != 1 or b.shape[:1] != w.shape:
        raise DatabaseError(f"{w.shape} frequencies do not fit a table of shape {b.shape}").about(
            "shape"
        )
    if w.size < 4 or w[0] <= 0.0 or not np.all(np.diff(w) > 0.0) or not np.isfinite(w[-1]):
        raise DatabaseError(
            "need at least 4 finite frequencies > 0 in ascending order [rad/s]"
        ).about("frequencies")
    if not np.all(np.isfinite(b)):
        raise DatabaseError("the table holds values that are not finite").about("not_finite")
    return w, b.reshape(w.size, -1), b.shape[1:]


def _spline(w: Array, b: Array) -> CubicSpline:
    # not-a-knot at w = 0 too: in finite depth B is linear in |w| there, so no zero slope is imposed
    return CubicSpline(np.r_[0.0, w], np.vstack([np.zeros(b.shape[1]), b]))


def _chunks(rows: int, columns: int, limit: int = 4_000_000) -> list[slice]:
    step = max(1, limit // max(columns, 1))
    return [slice(i, min(i + step, rows)) for i in range(0, rows, step)]


def _moments(theta: Array) -> list[Complex]:
    """Return int_0^1 u^k e^{i theta u} du, k = 0..3.

    The recursion k M_{k-1} = e^z - z M_k, z = i theta, runs forward from M_0 where |theta| > 1.
    Elsewhere it runs backward from M_3 = sum_j z^j / (j! (j + 4)). No error grows in either.
    """
    z = 1j * theta
    e = np.exp(z)
    moments = [np.empty_like(z) for _ in range(4)]
    small = np.abs(theta) < 1.0
    y, large = z[small], ~small
    series = np.full_like(y, 1.0 / (SERIES + 4))
    for j in range(SERIES, 0, -1):
        series *= y / j
        series += 1.0 / (j + 3)
    moments[3][small] = series
    for k in (3, 2, 1):
        series = (e[small] - y * series) / k
        moments[k - 1][small] = series
    y, power = 1.0 / z[large], e[large]
    forward = (power - 1.0) * y
    moments[0][large] = forward
    for k in (1, 2, 3):
        forward = (power - k * forward) * y
        moments[k][large] = forward
    return moments


def spline_fourier(spline: CubicSpline, t: Array) -> Complex:
    """Return int s(w) e^{iwt} dw over the knots, exact for the piecewise cubic; (nt, m).

    Parameters
    ----------
    spline : CubicSpline
        Real, (m,) values at each w [rad/s].
    t : (nt,) array
        [s].
    """
    start, h = spline.x[:-1], np.diff(spline.x)
    rotation = np.exp(1j * t[:, None] * start)
    result = np.zeros((t.size, spline.c.shape[2]), dtype=complex)
    for k, moment in enumerate(_moments(t[:, None] * h)):
        phase, table = rotation * moment, h[:, None] ** (k + 1) * spline.c[3 - k]
        result.real += phase.real @ table
        result.imag += phase.imag @ table
    return result


def between(omega: ArrayLike, damping: ArrayLike, at: Array) -> Array:
    """Return by how much B between the frequencies depends on who interpolates; (na, ...).

    The cubic spline, which is what K(t) is made of, less the monotone piecewise cubic.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    damping : (nw, ...) array
        B(w).
    at : (na,) array
        Frequencies from 0 to the last one [rad/s].
    """
    w, b, shape = _table(omega, damping)
    spline = _spline(w, b)
    monotone = PchipInterpolator(spline.x, np.vstack([np.zeros(b.shape[1]), b]))
    return np.asarray((spline(at) - monotone(at)).reshape(at.shape + shape))
