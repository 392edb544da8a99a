"""Numeric files of WAMIT and others: the columns of each, their lines, and what these mean.

Every line of WAMIT holds numbers only, but for one title line that the option NUMHDR writes first.
The first column of all but `.hst` is the period, or a frequency or wavenumber (option IPEROUT);
zero and negative values there stand for w = inf and w = 0, or the other way round.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import numbers, read_lines
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.naming import names_file


@dataclass(frozen=True)
class Columns:
    """Columns of a file of numbers: the keys of a line, in this order, then its values.

    Attributes
    ----------
    meaning : str
        What a line holds, for messages.
    waves, headings, modes, values : int
        Columns of periods (or frequencies), headings [deg], modes from 1, and values.
    optional : int
        Values at the end of a line that it may lack.
    length : float
        Values are over rho L^length, and over another L for each rotation among their modes.
    weight : bool
        Values are over g, too.
    """

    meaning: str
    waves: int
    headings: int
    modes: int
    values: int
    optional: int = 0
    length: float = 0.0
    weight: bool = True


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


@dataclass(frozen=True)
class Rows:
    """Lines of a file of numbers.

    Attributes
    ----------
    path : Path
    columns : Columns
    table : (m, n) array
        Numbers that a line lacks at its end are NaN.
    lines : (m,) array of int
        Line number of each, from 1.
    """

    path: Path
    columns: Columns
    table: Array
    lines: NDArray[np.int_]

    def where(self, kept: NDArray[np.bool_]) -> Rows:
        """Return the lines (m,) that are kept."""
        return replace(self, table=self.table[kept], lines=self.lines[kept])

    def of_modes(self, modes: Array) -> Rows:
        """Return the lines of which all modes are among these."""
        return self.where(np.asarray(np.isin(self.modes, modes).all(axis=1)))

    @property
    def waves(self) -> Array:
        """(m, waves) periods or frequencies."""
        return self.table[:, : self.columns.waves]

    @property
    def headings(self) -> Array:
        """(m, headings) [deg]."""
        c = self.columns
        return self.table[:, c.waves : c.waves + c.headings]

    @property
    def modes(self) -> Array:
        """(m, modes) numbers of modes, from 1."""
        c = self.columns
        return self.table[:, c.waves + c.headings :][:, : c.modes]

    def labels(self, setting: Setting) -> NDArray[np.str_]:
        """Return the coordinate (m,) of the first mode of each line."""
        modes = zip(self.modes[:, 0], self.lines, strict=True)
        return np.array([setting.label_of(mode, self.path, int(line)) for mode, line in modes])

    @property
    def values(self) -> Array:
        """(m, values) numbers that belong to the keys."""
        return self.table[:, self.table.shape[1] - self.columns.values :]

    @property
    def loads(self) -> Complex:
        """(m,) values of which the last two columns are real and imaginary part."""
        return np.asarray(self.table[:, -2] + 1j * self.table[:, -1])


@names_file
def read_rows(path: Path, columns: Columns, text: list[str] | None = None) -> Rows:
    """Read a file, or its lines, which hold these columns; the first line may be a title.

    Raises
    ------
    DatabaseError
        The file has no line, or a line after the first is not of that form.
    """
    most = columns.waves + columns.headings + columns.modes + columns.values
    least, meaning = most - columns.optional, columns.meaning
    rows, lines = [], []
    for count, line in enumerate(read_lines(path) if text is None else text, start=1):
        if not line.strip():
            continue
        try:
            values = [float(word) for word in line.split()]  # the usual case
        except ValueError:
            try:
                values = numbers(line, count, meaning)
            except DatabaseError:
                if count == 1:
                    continue  # the title line
                raise
        if not all(map(math.isfinite, values[:2])):  # period or mode; tables may hold NaN
            keys = " ".join(line.split()[:2])
            raise DatabaseError(f"{keys}: expected {meaning}").about("format", line=count)
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
    return Rows(path, columns, np.array(rows), np.array(lines))


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
