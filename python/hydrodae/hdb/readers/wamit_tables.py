"""Numeric files of WAMIT: the columns of each, and what their keys and values mean.

Every line holds numbers only, but for one title line that the option NUMHDR writes first. The first
column of all but `.hst` is the period, or a frequency or wavenumber (option IPEROUT); zero and
negative values there stand for w = inf and w = 0, or the other way round.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import Columns, Rows
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array

LOAD = "mode, modulus, phase, real and imaginary part"
FORCE = Columns(f"period, heading, {LOAD}", 1, 1, 1, 4, length=2.0)
DRIFT = Columns(f"period, two headings, {LOAD}", 1, 2, 1, 4, length=1.0)
PAIRS = Columns(f"two periods, two headings, {LOAD}", 2, 2, 1, 4, length=1.0)
#: What a line holds, by the suffix of the file.
COLUMNS = {
    ".1": Columns("period, I, J, A [, B]", 1, 0, 2, 2, 1, length=3.0, weight=False),
    **dict.fromkeys((".2", ".3", ".3fk", ".3sc"), FORCE),
    ".hst": Columns("I, J, C(I,J)", 0, 0, 2, 1, length=2.0),
    **dict.fromkeys((".7", ".8", ".9"), DRIFT),
    **dict.fromkeys((".10d", ".11d", ".12d", ".10s", ".11s", ".12s"), PAIRS),
}
#: What the first column may hold, by IPEROUT: w^2/g L in deep water and k L in the given depth.
FIRST = {1: "period", 2: "frequency", 3: "wavenumber of deep water", 4: "wavenumber"}


def to_omega(first: Array, setting: Setting) -> Array:
    """Turn what stands in the first column of a file (m,) into frequencies [rad/s].

    Parameters
    ----------
    first : (m,) array
    setting : Setting
        What the column holds, of `FIRST`, the length scale and the water.
    """
    option, omega, usual = setting.first_column, np.empty_like(first), first > 0.0
    if option == 1:
        omega[usual] = 2.0 * np.pi / first[usual]
        omega[~usual] = np.where(first[~usual] == 0.0, np.inf, 0.0)
        return omega
    omega[usual] = first[usual]
    if option > 2:
        depth = setting.depth if option == 4 else np.inf
        omega[usual] = frequency(first[usual] / setting.length, depth, setting.gravity)
    omega[~usual] = np.where(first[~usual] == 0.0, 0.0, np.inf)
    return omega


def unit(columns: Columns, setting: Setting, turns: Array) -> Array:
    """Unit of values of modes of which so many are rotations."""
    weight = setting.rho * setting.gravity if columns.weight else setting.rho
    return np.asarray(weight * setting.length ** (columns.length + turns))


def check_modes(rows: Rows, known: Array) -> None:
    """Refuse modes that the run does not have: another column, or a garbled number."""
    for i, column in enumerate(rows.modes.T):
        wrong = np.flatnonzero(~np.isin(column, known))
        if wrong.size:
            place = rows.columns.waves + rows.columns.headings + i + 1
            raise DatabaseError(
                f"{column[wrong[0]]:g} in column {place} is no mode of the run "
                f"(1 to {known.max():g})"
            ).about("label", "modes", file=rows.path, line=int(rows.lines[wrong[0]]))


def check_parts(rows: Rows, findings: list[Finding]) -> None:
    """Hold modulus and phase of forces against their real and imaginary parts.

    Raises
    ------
    DatabaseError
        A modulus is another; the message names the line.
    """
    modulus, degrees, real, imaginary = rows.values.T
    phase, parts = np.radians(degrees), rows.loads
    least = 1e-5 * float(np.nanmax(np.abs(parts), initial=0.0))
    wrong = np.flatnonzero(np.abs(np.abs(parts) - modulus) > 5e-3 * np.abs(parts) + least)
    if wrong.size:
        at = wrong[0]
        raise DatabaseError(
            f"the modulus {modulus[at]:g} is not that of the real and imaginary part "
            f"{real[at]:g} {imaginary[at]:g}: columns in another order, or a garbled number"
        ).about("conflict", "modulus", file=rows.path, line=int(rows.lines[at]))
    turned = np.abs(modulus * np.exp(1j * phase) - parts) > 0.02 * np.abs(parts) + least
    if turned.any():
        at = int(np.flatnonzero(turned)[0])
        text = (
            f"{rows.path.name}:{rows.lines[at]}: phase {degrees[at]:g} deg is not that of the real "
            f"and imaginary part, which are used ({turned.sum()} of {turned.size} lines)"
        )
        findings.append(Finding("warning", "excitation", text, float(turned.mean())))


def tabulate(
    rows: Rows, keys: tuple[Array, ...], axes: tuple[Array, ...], values: NDArray[np.generic]
) -> NDArray[np.generic]:
    """Put one value a row into a table; entries that the file leaves out are zero.

    WAMIT leaves out pairs that vanish by symmetry; a pair that is there at some frequencies only is
    an error.

    Parameters
    ----------
    rows : Rows
        For the messages.
    keys : tuple of (m,) arrays
        Place of each value along the axes.
    axes : tuple of arrays
        All keys, ascending: the axes of the table; the first one counts frequencies.
    values : (m,) array
    """
    table = np.zeros([a.size for a in axes], dtype=values.dtype)
    filled = np.zeros(table.shape, dtype=bool)
    place = tuple(np.searchsorted(a, key) for a, key in zip(axes, keys, strict=True))
    flat = np.ravel_multi_index(place, table.shape)
    _, once = np.unique(flat, return_index=True)
    if once.size < flat.size:
        again = np.setdiff1d(np.arange(flat.size), once)[0]
        raise DatabaseError("this entry stands in the file twice").about(
            "conflict", "entry", file=rows.path, line=int(rows.lines[again])
        )
    table.flat[flat] = values
    filled.flat[flat] = True
    partly = filled.any(axis=0) & ~filled.all(axis=0)
    if partly.any():
        where = np.argwhere(partly)[0]
        entry = " ".join(f"{a[i]:g}" for a, i in zip(axes[1:], where, strict=True))
        lost, every = (~filled[(slice(None), *where)]).sum(), axes[0].size
        raise DatabaseError(f"the entry {entry} is missing at {lost} of {every} frequencies").about(
            "missing", "entry", file=rows.path
        )
    return table
