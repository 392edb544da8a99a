"""Variants of a database: a coarser or shorter table, a cut or fitted memory, no coupling."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.kernels import memory_length
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array, Complex

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory

STEPS, RANGES, LENGTHS = (2, 4), (0.75, 0.5), (1.0, 0.5, 0.25, 0.125)


def every(database: HydroDatabase, step: int) -> HydroDatabase:
    """Keep every `step`-th frequency, and the last."""
    keep = np.arange(database.omega.size) % step == 0
    keep[-1] = True
    return _kept(database, keep)


def up_to(database: HydroDatabase, share: float) -> HydroDatabase:
    """Keep the frequencies up to `share` of the highest; K(t) and A_inf come from these alone.

    A = A_inf - (1/w) int K sin(wt) dt with both of the shorter table (Ogilvie's relation).
    """
    part = _kept(database, database.omega <= share * database.omega[-1] * (1.0 + 1e-9))
    w, b = part.omega, part.radiation_damping
    infinite, _ = irf.added_mass_inf(w, part.added_mass, b)
    return replace(part, added_mass=infinite - irf.kramers_kronig(w, b), added_mass_inf=infinite)


def cut_memory(database: HydroDatabase, length: float) -> HydroDatabase:
    """Return A and B without what K(t) holds after `length` [s], at the same frequencies."""
    w, n = database.omega, len(database.coordinates)
    count = 2 * int(np.ceil(length * w[-1] / 0.25)) + 1
    time = np.linspace(0.0, length, max(count, 101))
    kernel = database.radiation_kernel(time, extrapolate=True).reshape(time.size, -1)
    kept = _fourier(time, kernel, w).reshape(w.size, n, n)
    # (1/w) int_0^inf K sin(wt) dt = A_inf - A
    whole = irf.kramers_kronig(w, database.radiation_damping)
    added = database.added_mass + whole + kept.imag / w[:, None, None]
    return replace(database, radiation_damping=kept.real, added_mass=added)


def fitted(database: HydroDatabase, fit: ExponentialMemory) -> HydroDatabase:
    """Return A and B of a fit, on the coordinates that it moves."""
    part = database.select(fit.inputs)
    rows = [fit.outputs.index(label) for label in fit.inputs]
    h = fit.transfer(part.omega)[:, rows]
    added = fit.added_mass_inf[rows] + h.imag / part.omega[:, None, None]
    return replace(part, radiation_damping=h.real, added_mass=added)


def variants(
    database: HydroDatabase, moving: Sequence[str], states: Sequence[int], band: Array | None
) -> Iterator[tuple[str, HydroDatabase]]:
    """Yield name and database of each variant; `moving` are the coordinates that move."""
    from hydrodae.hdb.memory import MemoryFitWarning, fit_memory

    yield "base: tables as stored", database
    for step in STEPS:
        yield f"every {step}. frequency", every(database, step)
    for share in RANGES:
        yield f"up to {share:g} w_max", up_to(database, share)
    part = database.select(moving)
    longest = memory_length(part)
    for share in LENGTHS:
        yield f"memory cut at {share * longest:.3g} s", cut_memory(part, share * longest)
    for name, fit in database.memory.items():
        if set(moving) <= set(fit.inputs):
            yield f"fit '{name}', {fit.n_states} states", fitted(database, fit)
    for count in states:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", MemoryFitWarning)
            fit = fit_memory(
                database,
                moving,
                band=None if band is None else (float(band[0]), float(band[1])),
                max_states=count,
            )
        passive = "" if fit.report["passive"] else ", NOT passive"
        yield f"fit, {fit.n_states} states{passive}", fitted(database, fit)
    if len(database.bodies) > 1:
        yield "no coupling of bodies", database.without_coupling()


def _fourier(time: Array, values: Array, omega: Array) -> Complex:
    """Return int_0^T f(t) e^{-iwt} dt, (nw, m), of the cubic spline of f, integrated exactly."""
    spline = CubicSpline(time, values)
    z = -1j * omega
    result = np.zeros((omega.size, values.shape[1]), dtype=complex)
    # by parts: sum over the ends of [f/z - f'/z2 + f''/z3] e^{zt} and the jumps of f'''
    for order in range(3):
        ends = spline(time[[0, -1]], order)
        factor = (-1.0) ** order / z[:, None] ** (order + 1)
        result += factor * (np.exp(z * time[-1])[:, None] * ends[1] - ends[0])
    third = 6.0 * spline.c[0]
    growth = np.exp(z[:, None] * time)
    result -= (growth[:, 1:] - growth[:, :-1]) @ third / z[:, None] ** 4
    return result


def _kept(database: HydroDatabase, keep: NDArray[np.bool_]) -> HydroDatabase:
    if keep.sum() < 4:
        raise DatabaseError("fewer than 4 frequencies would be left").about("frequencies")
    return database.at_frequencies(keep)
