"""Numeric output files of WAMIT: `.1`, `.2`, `.3`, `.3fk`, `.3sc`, `.hst`.

Every line holds numbers only, but for one title line that the option NUMHDR writes first. The first
column of all but `.hst` is the period, or a frequency or wavenumber (option IPEROUT); zero and
negative values there stand for w = inf and w = 0, or the other way round.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.text import number, read_lines
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file


@names_file
def read_rows(path: Path, least: int, most: int, meaning: str) -> tuple[Array, list[int]]:
    """Read the lines of a file.

    Parameters
    ----------
    path : Path
    least, most : int
        Numbers that a line may hold.
    meaning : str
        What they are, for the error message.

    Returns
    -------
    rows : (lines, most) array
        Missing numbers at the end of a line are NaN.
    lines : list of int
        Line number of each row, from 1.

    Raises
    ------
    DatabaseError
        A line other than the first is not of that form, or there is none.
    """
    rows, lines = [], []
    for count, line in enumerate(read_lines(path), start=1):
        words = line.split()
        if not words:
            continue
        try:
            values = [number(w) for w in words]
        except ValueError:
            if count == 1:
                continue  # the title line
            raise DatabaseError(f"not numbers: {line.strip()[:60]!r}; expected {meaning}").about(
                "format", line=count
            ) from None
        if not all(map(math.isfinite, values[:2])):  # period or mode; tables may hold NaN
            raise DatabaseError(f"{' '.join(words[:2])}: expected {meaning}").about(
                "format", line=count
            )
        if not least <= len(values) <= most:
            wanted = f"{least}" if least == most else f"{least} or {most}"
            raise DatabaseError(f"{len(values)} numbers, expected {wanted}: {meaning}").about(
                "shape", line=count
            )
        rows.append(values + [np.nan] * (most - len(values)))
        lines.append(count)
    if not rows:
        raise DatabaseError(f"no numbers in it; expected lines of {meaning}").about(
            "missing", "numbers"
        )
    return np.array(rows), lines


def to_omega(
    path: Path, first: Array, option: int, length: float, depth: float, gravity: float
) -> Array:
    """Turn the first column into frequencies.

    Parameters
    ----------
    path : Path
        For the error message.
    first : (m,) array
        The column.
    option : int
        IPEROUT: 1 period [s], 2 frequency [rad/s], 3 wavenumber K L = w^2 L/g in deep water,
        4 wavenumber times L in the given depth.
    length, depth, gravity : float
        L = ULEN [m], [m], [m/s2].

    Returns
    -------
    (m,) array
        [rad/s]; w = 0 and w = inf as such.

    Raises
    ------
    DatabaseError
        Another option.
    """
    omega = np.empty_like(first)
    usual = first > 0.0
    if option == 1:
        omega[usual] = 2.0 * np.pi / first[usual]
        omega[~usual] = np.where(first[~usual] == 0.0, np.inf, 0.0)
        return omega
    if option == 2:
        omega[usual] = first[usual]
    elif option in (3, 4):
        omega[usual] = frequency(first[usual] / length, depth if option == 4 else np.inf, gravity)
    else:
        raise DatabaseError(f"IPEROUT = {option} in the .cfg beside it: expected 1 to 4").about(
            "format", "IPEROUT", file=path
        )
    omega[~usual] = np.where(first[~usual] == 0.0, 0.0, np.inf)
    return omega


def check_indices(
    path: Path, rows: Array, lines: list[int], columns: tuple[int, ...], known: Array
) -> None:
    """Refuse modes that the run does not have: another column, or a garbled number."""
    for column in columns:
        wrong = np.flatnonzero(~np.isin(rows[:, column], known))
        if wrong.size:
            raise DatabaseError(
                f"{rows[wrong[0], column]:g} in column {column + 1} is "
                f"no mode of the run (1 to {known.max():g})"
            ).about("label", "modes", file=path, line=lines[wrong[0]])


def check_parts(path: Path, rows: Array, lines: list[int], findings: list[Finding]) -> None:
    """Hold modulus and phase of forces (m, 7) against their real and imaginary parts.

    Raises
    ------
    DatabaseError
        A modulus is another; the message names the line.
    """
    modulus, phase, parts = rows[:, 3], np.radians(rows[:, 4]), rows[:, 5] + 1j * rows[:, 6]
    least = 1e-5 * float(np.nanmax(np.abs(parts), initial=0.0))
    wrong = np.flatnonzero(np.abs(np.abs(parts) - modulus) > 5e-3 * np.abs(parts) + least)
    if wrong.size:
        at = wrong[0]
        raise DatabaseError(
            f"the modulus {modulus[at]:g} is not that of the real and imaginary part "
            f"{rows[at, 5]:g} {rows[at, 6]:g}: columns in another order, or a garbled number"
        ).about("conflict", "modulus", file=path, line=lines[at])
    turned = np.abs(modulus * np.exp(1j * phase) - parts) > 0.02 * np.abs(parts) + least
    if turned.any():
        at = int(np.flatnonzero(turned)[0])
        text = (
            f"{path.name}:{lines[at]}: phase {rows[at, 4]:g} deg is not that of the real and "
            f"imaginary part, which are used ({turned.sum()} of {turned.size} lines)"
        )
        findings.append(Finding("warning", "excitation", text, float(turned.mean())))


def without_mate(pairs: Array, modes: Array) -> NDArray[np.bool_]:
    """Report which pairs I, J of modes stand in a file that holds no J, I.

    Parameters
    ----------
    pairs : (m, 2) array
        I and J of the rows.
    modes : (n,) array
        All modes, ascending.

    Returns
    -------
    (n, n) array of bool
    """
    there = np.zeros((modes.size, modes.size), dtype=bool)
    there[np.searchsorted(modes, pairs[:, 0]), np.searchsorted(modes, pairs[:, 1])] = True
    return np.asarray(there & ~there.T)


def scatter(
    path: Path,
    rows: Array,
    lines: list[int],
    columns: tuple[int, ...],
    axes: tuple[Array, ...],
    values: NDArray[np.generic],
) -> NDArray[np.generic]:
    """Put one value a row into a table; entries that the file leaves out are zero.

    WAMIT leaves out pairs that vanish by symmetry; a pair that is there at some frequencies only is
    an error.

    Parameters
    ----------
    path, rows, lines
        As from `read_rows`.
    columns : tuple of int
        Columns of `rows` that hold the place of the value.
    axes : tuple of arrays
        All values of these columns, ascending: the axes of the table; the first one counts
        frequencies.
    values : (lines,) array

    Returns
    -------
    array
        Shape of `axes`.
    """
    table = np.zeros([a.size for a in axes], dtype=values.dtype)
    filled = np.zeros(table.shape, dtype=bool)
    place = tuple(np.searchsorted(a, rows[:, c]) for a, c in zip(axes, columns, strict=True))
    flat = np.ravel_multi_index(place, table.shape)
    _, once = np.unique(flat, return_index=True)
    if once.size < flat.size:
        again = min(set(range(flat.size)) - set(once.tolist()))
        raise DatabaseError("this entry stands in the file twice").about(
            "conflict", "entry", file=path, line=lines[again]
        )
    table.flat[flat] = values
    filled.flat[flat] = True
    partly = filled.any(axis=0) & ~filled.all(axis=0)
    if partly.any():
        where = np.argwhere(partly)[0]
        entry = [f"{a[i]:g}" for a, i in zip(axes[1:], where, strict=True)]
        raise DatabaseError(
            f"the entry {' '.join(entry)} is missing at "
            f"{(~filled[(slice(None), *where)]).sum()} of {axes[0].size} frequencies"
        ).about("missing", "entry", file=path)
    return table
