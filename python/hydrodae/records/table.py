"""Tables of numbers in columns, whatever kind of file they stand in."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py

from hydrodae.errors import CaseError
from hydrodae.records.matlab import read_hdf5, read_matlab
from hydrodae.records.text import read_text
from hydrodae.records.units import split_unit, stated_unit
from hydrodae.support.arrays import Array
from hydrodae.support.nearest import did_you_mean

#: Columns that are listed where one is not found.
_LISTED = 12


@dataclass(frozen=True)
class Table:
    """Columns of equal length.

    Attributes
    ----------
    path : Path
    names : tuple of str
        One a column; "1", "2", ... where the file names none.
    values : (n_row, n_column) array
        As in the file; nan where a value is missing.
    named : bool
        Whether the file names its columns.
    notes : tuple of str
        What a reader of the table should know.
    """

    path: Path
    names: tuple[str, ...]
    values: Array
    named: bool = True
    notes: tuple[str, ...] = ()

    def index(self, name: str) -> int:
        """Place of a column by its name; its number, from 1, where no column has that name.

        Raises
        ------
        CaseError
            There is no such column, or there are two.
        """
        if self.names.count(name) > 1:
            raise CaseError(f"{self.path}: column {name!r} stands there twice; give its number")
        if name in self.names:
            return self.names.index(name)
        if name.isdecimal() and 1 <= int(name) <= len(self.names):
            return int(name) - 1
        hint = did_you_mean(name, self.names, f"; there are {self.listed()}")
        raise CaseError(f"{self.path}: no column {name!r}{hint}")

    def listed(self) -> str:
        """Names of the columns, for a message."""
        more = len(self.names) - _LISTED
        names = ", ".join(self.names[:_LISTED]) + (f" and {more} more" if more > 0 else "")
        return names if self.named else f"columns {names}, which the file does not name"

    def column(self, text: str) -> tuple[Array, str]:
        """Values in SI units of "COLUMN", "COLUMN:UNIT" or "COLUMN:-UNIT".

        Returns
        -------
        values : (n_row,) array
        unit : str
            SI unit, by the text or else by the name of the column, such as "heave [mm]"; empty
            where neither states one.

        Raises
        ------
        CaseError
            As `index`, or the unit is unknown.
        """
        name, factor, unit = split_unit(text, list(self.names))
        k = self.index(name)
        if not unit:
            factor, unit = stated_unit(self.names[k])
        return factor * self.values[:, k], unit

    def renamed(self, names: Sequence[str]) -> Table:
        """The table with other names of its columns.

        Raises
        ------
        CaseError
            There are fewer or more names than columns.
        """
        if len(names) != len(self.names):
            raise CaseError(
                f"{self.path}: {len(names)} names are given and there are {len(self.names)} columns"
            )
        return Table(self.path, tuple(names), self.values, True, self.notes)


def read_table(path: str | os.PathLike[str], names: Sequence[str] | None = None) -> Table:
    """Read a table of numbers.

    Parameters
    ----------
    path : path
        MATLAB's .mat (versions 4 to 7.3), HDF5, or text: columns separated by commas,
        semicolons, tabs or spaces; with or without names above; a decimal comma where commas do
        not separate; dates and times of ISO 8601 as seconds since the first.
    names : sequence of str, optional
        Names of all columns, in place of those of the file.

    Returns
    -------
    Table

    Raises
    ------
    CaseError
        There is no such file, or no table in it.
    """
    file = Path(path)
    if not file.is_file():
        raise CaseError(f"{file}: no such file")
    if h5py.is_hdf5(file):
        found = read_hdf5(file)
    elif file.suffix.lower() == ".mat":
        found = read_matlab(file)
    else:
        found = read_text(file)
    table = Table(file, tuple(found.names), found.values, found.named, tuple(found.notes))
    return table if names is None else table.renamed(names)
