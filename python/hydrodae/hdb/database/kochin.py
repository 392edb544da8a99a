"""Kochin functions of a database by its labels, read from the tables of its source."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.tables import Tables
from hydrodae.support.arrays import Array, Complex

#: Names of the tables, as Capytaine has them.
DIFFRACTION, RADIATION = "kochin_diffraction", "kochin_radiation"
#: Fewest angles around the circle: |H|^2 cos(theta) of a small body holds e^{3 i theta}, whose sum
#: over N angles is exact for N > 3; twice that for bodies that are not small.
FEWEST = 8


@dataclass(frozen=True)
class Kochin:
    """Waves that leave bodies, e^{-iwt}, in the normalisation of Capytaine [m2/s].

    Attributes
    ----------
    omega : (nw,) array
        Those frequencies of the database that have all functions [rad/s].
    heading : (nh,) array
        Directions of travel [rad].
    diffraction : (nw, nh, nt) complex array
        Per metre of wave amplitude, at equal steps of the angle from 0.
    labels : tuple of str
        n labels `<body>.<motion>` of the database.
    radiation : (nw, n, nt) complex array
        Per metre or radian of motion.
    """

    omega: Array
    heading: Array
    diffraction: Complex
    labels: tuple[str, ...]
    radiation: Complex


def kochin_of(database: Tables) -> Kochin:
    """Return the Kochin functions of a database.

    Raises
    ------
    DatabaseError
        A table is missing, does not go all round in equal steps from 0, or is of other bodies.
    """
    heading, diffraction = diffraction_of(database)
    labels, radiation = radiation_of(database)
    there = np.isfinite(diffraction).all(axis=(1, 2)) & np.isfinite(radiation).all(axis=(1, 2))
    if there.sum() < 4:
        raise DatabaseError(
            f"{there.sum()} frequencies have Kochin functions, expected at least 4"
        ).about("frequencies")
    if diffraction.shape[-1] != radiation.shape[-1]:
        raise DatabaseError(
            f"{DIFFRACTION} and {RADIATION} have different numbers of angles"
        ).about("shape", RADIATION)
    return Kochin(database.omega[there], heading, diffraction[there], labels, radiation[there])


def diffraction_of(database: Tables) -> tuple[Array, Complex]:
    """Return headings (nh,) [rad] and H (nw, nh, nt) of fixed bodies; NaN where it is missing.

    Raises
    ------
    DatabaseError
        As `kochin_of`.
    """
    table = _table(database, DIFFRACTION, "wave_direction")
    return np.asarray(table.axes["wave_direction"], dtype=float), _values(database, table)


def radiation_of(database: Tables) -> tuple[tuple[str, ...], Complex]:
    """Return labels and H (nw, n, nt) per unit of motion; NaN where it is missing.

    Raises
    ------
    DatabaseError
        As `kochin_of`.
    """
    table = _table(database, RADIATION, "radiating_dof")
    names = [str(name) for name in table.axes["radiating_dof"]]
    places = {
        label: place
        for label in database.coordinates
        if (place := _place(label, names, len(database.bodies))) is not None
    }
    if not places:
        raise DatabaseError(
            f"the Kochin functions are of {', '.join(names)}, the database is of "
            f"{', '.join(database.bodies)}: use the names of the computation"
        ).about("label", RADIATION)
    return tuple(places), _values(database, table)[:, list(places.values())]


def _place(label: str, names: list[str], bodies: int) -> int | None:
    """Return where a coordinate stands among the motions of the source."""
    body, _, motion = label.rpartition(".")
    for place, name in enumerate(names):
        owner, _, word = name.rpartition("__")
        if word.lower() == motion and (owner == body or bodies == 1):
            return place
    return None


def _table(database: Tables, name: str, middle: str) -> SourceTable:
    """Return a table over frequency, `middle` and the angle, which goes all round."""
    table = database.extra.get(name)
    if table is None:
        raise DatabaseError(
            f"the database has no {name}: make it with the option --kochin 72 of hydrodae hdb "
            f"compute or hdb array"
        ).about("missing", name)
    dims = ("omega", middle, "theta")
    if sorted(table.dims) != sorted(dims) or any(dim not in table.axes for dim in dims):
        raise DatabaseError(f"{name} is over {table.dims}, expected {dims}").about("shape", name)
    theta = np.asarray(table.axes["theta"], dtype=float)
    even = 2.0 * np.pi * np.arange(theta.size) / max(theta.size, 1)
    if theta.size < FEWEST or not np.allclose(theta, even, atol=1e-6):
        raise DatabaseError(
            f"{name}: expected at least {FEWEST} angles in equal steps from 0 to 2 pi, without 2 pi"
        ).about("value", name)
    return table


def _values(database: Tables, table: SourceTable) -> Complex:
    """Return a table at the frequencies of the database, axes as in `_table`."""
    (middle,) = set(table.dims) - {"omega", "theta"}
    order = [table.dims.index(dim) for dim in ("omega", middle, "theta")]
    values = np.asarray(table.values, dtype=complex).transpose(order)
    known = np.asarray(table.axes["omega"], dtype=float)
    rows = _rows(known, database.omega)
    return np.where(rows[:, None, None] >= 0, values[rows], np.nan)


def _rows(known: Array, wanted: Array) -> NDArray[np.intp]:
    """Return the places of the wanted frequencies among those known; -1 where one is missing."""
    place = np.abs(known[:, None] - wanted).argmin(axis=0)
    return np.where(np.isclose(known[place], wanted, rtol=1e-6), place, -1)
