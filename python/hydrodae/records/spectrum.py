"""Spectra of the sea from files: density over frequency, and over direction."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import trapezoid

from hydrodae.errors import CaseError
from hydrodae.records.quantities import find, in_unit
from hydrodae.records.table import Table, read_table
from hydrodae.records.units import bracketed, stated_unit
from hydrodae.support.arrays import Array

#: Directions with less than this part of the energy are left out.
_NOTHING = 1e-6
#: Components of all directions together, and of one at least.
_COMPONENTS, _FEWEST = 400, 10


@dataclass(frozen=True)
class Spectrum:
    """Spectral density of a sea by direction.

    Attributes
    ----------
    omega : (n,) array
        Ascending [rad/s].
    heading : (m,) array or None
        Directions of travel, 0 = +x [rad]; None where the file has none.
    density : (m, n) array
        Of what travels in each direction [m2 s/rad]; one row without directions.
    notes : tuple of str
    """

    omega: Array
    heading: Array | None
    density: Array
    notes: tuple[str, ...] = ()

    @property
    def variance(self) -> Array:
        """Of each direction, straight lines between the frequencies: (m,) array [m2]."""
        return np.asarray(trapezoid(self.density, self.omega, axis=1))

    @property
    def significant_height(self) -> float:
        """4 sqrt(m0) [m]."""
        return 4.0 * math.sqrt(float(self.variance.sum()))

    @property
    def peak_period(self) -> float:
        """Period of the frequency at which the density of all directions is highest [s]."""
        return float(2.0 * math.pi / self.omega[np.argmax(self.density.sum(axis=0))])

    def waves(
        self, name: str = "sea", heading_deg: float = 0.0, seed: int = 1
    ) -> list[dict[str, Any]]:
        """Keys of [[wave]], one for each direction.

        Parameters
        ----------
        name : str
        heading_deg : float
            Direction of a spectrum without any.
        seed : int
            Of the first direction.
        """
        if self.heading is None:
            return [_keys(name, heading_deg, self.omega, self.density[0]) | {"seed": seed}]
        share = self.variance / self.variance.sum()
        tables: list[dict[str, Any]] = []
        for k in np.flatnonzero(share > _NOTHING):
            degrees = (math.degrees(self.heading[k]) + 180.0) % 360.0 - 180.0
            keys = _keys(f"{name}_{len(tables) + 1}", degrees, self.omega, self.density[k])
            count = max(_FEWEST, round(_COMPONENTS * float(share[k])))
            tables.append(keys | {"components": count, "seed": seed + len(tables)})
        return tables


def _keys(name: str, heading_deg: float, omega: Array, density: Array) -> dict[str, Any]:
    return {
        "name": name,
        "type": "table",
        "heading_deg": heading_deg,
        "frequency": omega,
        "density": density,
    }


def read_spectrum(
    source: str | os.PathLike[str] | Table, columns: Sequence[str] | None = None
) -> Spectrum:
    """Read a spectrum.

    Parameters
    ----------
    source : path or Table
        As `read_table`. Columns frequency [Hz] or [rad/s] (or period [s]) and density; with
        directions: a third column (a mean direction of each frequency, or a row for each pair of
        frequency and direction), or a column for each direction with its degrees as name.
        The unit of the density is that in its name, such as [m2/Hz], [m2 s/rad], [m2/Hz/deg];
        without one it is per unit of the frequency and of the direction as they stand in the file.
    columns : sequence of str, optional
        Names of all columns, in place of those of the file.

    Returns
    -------
    Spectrum

    Raises
    ------
    CaseError
        A column or its unit is not known, or the values are no spectrum.
    """
    table = source if isinstance(source, Table) else read_table(source, columns)
    where = str(table.path)
    omega, slope, place = _frequency(table)
    headings = _degrees_of(table, place)
    if headings is not None:
        order = np.argsort(headings)
        density = table.values[:, np.flatnonzero(np.arange(len(table.names)) != place)][:, order]
        heading = np.radians(headings[order])
        widths = _widths(where, heading, 180.0 / math.pi)
        return _made(table, omega, heading, (density * slope[:, None] * widths).T)
    s = find(table, "density")
    if s is None:
        raise CaseError(
            f"{where}: which column is the spectral density? There are {table.listed()}: give "
            '--columns "frequency [Hz],density [m2/Hz]", with "direction [deg]" where there is one'
        )
    factor, per_angle = _density_unit(table, s)
    values = table.values[:, s] * (slope if factor is None else factor)
    d = find(table, "direction")
    if d is None:
        return _made(table, omega, None, values[None, :])
    heading = in_unit(table, d, "rad", "deg")
    if len(np.unique(omega)) == len(omega):
        return _by_mean_direction(table, omega, heading, values)
    return _by_pairs(table, omega, heading, values, per_angle or _angle(table, d))


def _frequency(table: Table) -> tuple[Array, Array, int]:
    """Frequencies [rad/s], the change of frequency in the file's unit with them, their column."""
    for quantity in ("omega", "frequency", "period"):
        place = find(table, quantity)
        if place is None:
            continue
        if quantity == "period":
            period = in_unit(table, place, "s", "s")
            if not (period > 0.0).all():
                raise CaseError(f"{table.path}: column {table.names[place]!r}: periods must be > 0")
            return 2.0 * math.pi / period, period**2 / (2.0 * math.pi), place  # |dT/dw|
        default = "rad/s" if quantity == "omega" else None
        omega = in_unit(table, place, "rad/s", default)
        factor = stated_unit(table.names[place])[0]
        return omega, np.full(len(omega), 1.0 / factor), place
    raise CaseError(
        f"{table.path}: which column is the frequency? There are {table.listed()}: give "
        '--columns "frequency [Hz],density [m2/Hz]"'
    )


def _degrees_of(table: Table, place: int) -> Array | None:
    """Directions that are the names of all columns but that of the frequency [deg]."""
    names = [name for k, name in enumerate(table.names) if k != place]
    try:
        degrees = [float(re.sub(r"\s*(deg|°|\[deg\])$", "", name)) for name in names]
    except ValueError:
        return None
    return np.array(degrees) if table.named and len(degrees) > 1 else None


def _density_unit(table: Table, place: int) -> tuple[float | None, str]:
    """Factor to m2 s/rad by the unit of a density, None without one; its unit of angle."""
    unit = bracketed(table.names[place]).replace("^", "").replace("²", "2")
    if not unit:
        return None, ""
    parts = [part for part in re.split(r"[\s*/.()]+", unit) if part]
    length = {"m2": 1.0, "cm2": 1e-4, "mm2": 1e-6}.get(parts[0])
    angle = parts[-1] if len(parts) > 2 and parts[-1] in ("deg", "rad") else ""
    rest = parts[1:-1] if angle and parts[1:] != ["s", "rad"] else parts[1:]
    if rest == ["s", "rad"] or rest == ["rad", "s"]:
        per, angle = 1.0, angle if rest != parts[1:] else ""
    elif rest in (["Hz"], ["s"]):
        per = 1.0 / (2.0 * math.pi)
    else:
        per = 0.0
    if length is None or not per:
        raise CaseError(
            f"{table.path}: column {table.names[place]!r}: unknown unit; known are m2/Hz, m2 s, "
            "m2 s/rad, and these by deg or rad, as m2/Hz/deg"
        )
    return length * per, angle


def _angle(table: Table, place: int) -> str:
    return "rad" if bracketed(table.names[place]) == "rad" else "deg"


def _widths(where: str, heading: Array, unit: float) -> Array:
    """Angle that each direction stands for, in radians times `unit`: (m,) array.

    Half of the distance of its neighbours; all round where the last gap is like the others.
    """
    if len(heading) < 2 or not (np.diff(heading) > 0.0).all():
        raise CaseError(f"{where}: expected two directions or more, each once")
    around = heading[0] + 2.0 * math.pi - heading[-1]
    if around < -1e-9:
        raise CaseError(f"{where}: directions over more than a full turn")
    if around < 1e-9:
        raise CaseError(f"{where}: the first direction stands there again after a full turn")
    closed = around < 1.5 * float(np.diff(heading).max())
    first, last = (heading[-1] - 2.0 * math.pi, heading[0] + 2.0 * math.pi)
    ends = [first, *heading, last] if closed else [heading[0], *heading, heading[-1]]
    return np.asarray(0.5 * (np.array(ends[2:]) - np.array(ends[:-2])) * unit)


def _by_mean_direction(table: Table, omega: Array, heading: Array, values: Array) -> Spectrum:
    """Each direction has the density at its frequencies, and 0 at others: they add up to it."""
    found = np.unique(heading)
    density = np.where(heading[None, :] == found[:, None], values[None, :], 0.0)
    return _made(table, omega, found, density)


def _by_pairs(table: Table, omega: Array, heading: Array, values: Array, angle: str) -> Spectrum:
    w, row = np.unique(omega, return_inverse=True)
    directions, column = np.unique(heading, return_inverse=True)
    if len(w) * len(directions) != len(values):
        raise CaseError(
            f"{table.path}: {len(values)} rows for {len(w)} frequencies and {len(directions)} "
            "directions: expected one row for each pair"
        )
    if len(np.unique(row * len(directions) + column)) != len(values):
        raise CaseError(f"{table.path}: a pair of frequency and direction stands there twice")
    density = np.empty((len(directions), len(w)))
    density[column, row] = values
    widths = _widths(str(table.path), directions, 180.0 / math.pi if angle == "deg" else 1.0)
    return _made(table, w, directions, density * widths[:, None])


def _made(table: Table, omega: Array, heading: Array | None, density: Array) -> Spectrum:
    """The spectrum in the order of the frequencies, without the frequency 0."""
    where = str(table.path)
    order = np.argsort(omega)
    w, s = omega[order], density[:, order]
    notes = list(table.notes)
    if len(w) and w[0] == 0.0:
        w, s = w[1:], s[:, 1:]
        notes.append("the frequency 0 left out")
    if len(w) < 2 or not w[0] > 0.0 or not (np.diff(w) > 0.0).all():
        raise CaseError(f"{where}: expected two frequencies > 0 or more, each once")
    if not np.isfinite(s).all() or (s < 0.0).any():
        raise CaseError(f"{where}: a spectral density is missing or negative")
    if not (s > 0.0).any():
        raise CaseError(f"{where}: the spectrum is zero")
    return Spectrum(w, heading, s, tuple(notes))
