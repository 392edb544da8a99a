"""Compare two databases, or one with coarser and shorter versions of itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.kernels import diagonal_kernels
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.relations import infinity, irf
from hydrodae.hdb.relations.entries import entry_scale, worst
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Difference:
    """Largest difference of one table.

    Attributes
    ----------
    table : str
    value : float
        Over the largest value of the entry in the second database (couplings: of the roots of the
        two diagonals) [-].
    entry : str
        Where it is.
    at : str
        Frequency or time.
    """

    table: str
    value: float
    entry: str
    at: str

    def __str__(self) -> str:
        """One line of a table."""
        return f"{self.table:20s} {self.value:8.2%}   {self.entry}{self.at}"


def compare(a: HydroDatabase, b: HydroDatabase) -> list[Difference]:
    """Differences of A, B, |F|, added_mass_inf and K(t) on what both have.

    Parameters
    ----------
    a, b : HydroDatabase
        With the same labels and reference points; tables are compared at the frequencies of `a`
        that lie in the range of `b`, at equal headings, coordinates that do not radiate left out.

    Returns
    -------
    list of Difference

    Raises
    ------
    DatabaseError
        Nothing in common, or moments about different points.
    """
    active = {c for c, s in zip(b.coordinates, scales(b), strict=True) if s > 0.0}
    labels = [c for c in a.coordinates if c in active]
    if not labels:
        raise DatabaseError(
            f"no coordinates in common: {', '.join(a.coordinates[:4])} ... and "
            f"{', '.join(b.coordinates[:4])} ... (rename bodies with hdb import --bodies)"
        ).about("label")
    for body in bodies_of(labels):
        p, q = a.bodies[body].reference_point, b.bodies[body].reference_point
        if p is not None and q is not None and not np.allclose(p, q, atol=1e-3):
            raise DatabaseError(
                f"the moments of {body!r} are about {p} and {q}: move one (--cog)"
            ).about("point", body)
    a, b = a.select(labels), b.select(labels)
    inside = (a.omega >= b.omega[0] - 1e-9) & (a.omega <= b.omega[-1] + 1e-9)
    if inside.sum() < 4:
        raise DatabaseError("the frequencies have no range in common").about("frequencies")
    w = a.omega[inside]
    found = []
    for name in ("added_mass", "radiation_damping"):
        x, y = getattr(a, name)[inside], CubicSpline(b.omega, getattr(b, name))(w)
        found.append(_matrix(name, np.abs(x - y) / entry_scale(y, -1.0), labels, w))
    found += _excitation(a, b, inside, labels)
    error = np.abs(a.added_mass_inf - b.added_mass_inf) / entry_scale(b.added_mass_inf, -1.0)
    found.append(_matrix("added_mass_inf", error[None], labels, None))
    found.append(_kernels(a, b, labels))
    return found


def other_water(a: HydroDatabase, b: HydroDatabase) -> list[str]:
    """Say in which of depth, density and gravity two databases differ: they are no twins then."""
    pairs = (
        ("water depth", a.water_depth, b.water_depth, "m"),
        ("density", a.rho, b.rho, "kg/m3"),
        ("gravity", a.gravity, b.gravity, "m/s2"),
    )
    return [
        f"{name}: {x:g} {unit} and {y:g} {unit}"
        for name, x, y, unit in pairs
        if not (x == y or np.isclose(x, y, rtol=1e-6))
    ]


def grid_sensitivity(database: HydroDatabase) -> list[tuple[str, float, float]]:
    """How K(t) and added_mass_inf answer to a coarser, narrower or shorter database.

    Returns
    -------
    list of (str, float, float)
        What was changed; the largest change of K_ii(t) over its peak; the largest change of
        added_mass_inf_ii over itself (estimated by Ogilvie's relation in both) [-]. NaN where a
        change cannot touch the quantity, or the rest of the table is too short to say.

    Notes
    -----
    For a shorter memory the first number is int_T^inf |K| dt over int |K| dt, a bound of the error
    of H(iw) relative to its largest possible value.
    """
    used = np.flatnonzero(scales(database) > 0.0)
    if used.size == 0:
        raise DatabaseError("nothing in this database radiates").about(
            "missing", "radiation_damping"
        )
    w = database.omega
    time, kernel = diagonal_kernels(database)
    value = _infinity(database, used)
    peak = np.abs(kernel).max(axis=0)
    rows = []
    for text, keep in (
        ("every second frequency", np.arange(w.size) % 2 == 0),
        ("every fourth frequency", np.arange(w.size) % 4 == 0),
        ("up to 0.75 w_max", w <= 0.75 * w[-1]),
        ("up to 0.5 w_max", w <= 0.5 * w[-1]),
        ("from 2 w_min", w >= 2.0 * w[0]),
    ):
        if keep.sum() < 8:
            rows.append((text, np.nan, np.nan))
            continue
        part = database.at_frequencies(keep)
        b = part.radiation_damping[:, used, used]
        other = irf.radiation_kernel(part.omega, b, time, extrapolate=True)
        change = float((np.abs(other - kernel).max(axis=0) / peak).max())
        shift = float((np.abs(_infinity(part, used) - value) / np.abs(value)).max())
        rows.append((text, change, shift))
    area = np.cumsum(np.abs(kernel), axis=0)
    for share in (0.25, 0.5, 0.75):
        at = int(share * (time.size - 1))
        rest = float((1.0 - area[at] / area[-1]).max())
        rows.append((f"memory up to {time[at]:.3g} s", rest, np.nan))
    return rows


def _infinity(database: HydroDatabase, used: NDArray[np.intp]) -> Array:
    a, b = (t[:, used, used] for t in (database.added_mass, database.radiation_damping))
    return infinity.added_mass_inf(database.omega, a, b)[0]


def _matrix(name: str, error: Array, labels: list[str], w: Array | None) -> Difference:
    value, (k, i, j) = worst(error)
    entry = labels[i] if i == j else f"{labels[i]} from {labels[j]}"
    return Difference(name, value, entry, "" if w is None else _at(float(w[k])))


def _excitation(
    a: HydroDatabase, b: HydroDatabase, inside: NDArray[np.bool_], labels: list[str]
) -> list[Difference]:
    pairs = [
        (i, j)
        for i, x in enumerate(a.heading)
        for j, y in enumerate(b.heading)
        if abs(np.exp(1j * x) - np.exp(1j * y)) < 1e-3
    ]
    if not pairs:
        return []
    w = a.omega[inside]
    x = a.excitation[inside][:, [i for i, _ in pairs]]
    y = CubicSpline(b.omega, b.excitation)(w)[:, [j for _, j in pairs]]
    size = np.abs(y).max(axis=(0, 1))
    size[size < 1e-4 * size.max()] = np.inf
    value, (k, h, i) = worst(np.abs(x - y) / size)
    heading = np.degrees(a.heading[pairs[h][0]])
    return [Difference("excitation", value, labels[i], f", {heading:.4g} deg{_at(float(w[k]))}")]


def _kernels(a: HydroDatabase, b: HydroDatabase, labels: list[str]) -> Difference:
    time, kernel = diagonal_kernels(b)
    columns = [labels.index(c) for c, s in zip(labels, scales(b), strict=True) if s > 0.0]
    other = irf.radiation_kernel(
        a.omega, a.radiation_damping[:, columns, columns], time, extrapolate=True
    )
    value, (t, i) = worst(np.abs(other - kernel) / np.abs(kernel).max(axis=0))
    return Difference("K(t)", value, labels[columns[i]], f" [t = {time[t]:.3g} s]")


def _at(omega: float) -> str:
    return f" [w = {omega:.4g} rad/s]"
