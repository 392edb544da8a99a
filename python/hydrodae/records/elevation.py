"""Measured surface elevations at equal steps of time."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records import clock
from hydrodae.records.quantities import find
from hydrodae.records.table import Table, read_table
from hydrodae.records.units import bracketed
from hydrodae.support import outputs
from hydrodae.support.arrays import Array

#: Fewest samples, as in a run.
FEWEST = 8


@dataclass(frozen=True)
class Elevation:
    """Surface elevation at a gauge.

    Attributes
    ----------
    time : (n,) array
        Since the first sample, at equal steps [s].
    elevation : (n,) array
        [m]
    notes : tuple of str
        What was done to the record.
    """

    time: Array
    elevation: Array
    notes: tuple[str, ...] = ()

    @property
    def length(self) -> float:
        """Time from the first to the last sample [s]."""
        return float(self.time[-1])

    @property
    def significant_height(self) -> float:
        """4 standard deviations [m]."""
        return 4.0 * float(np.std(self.elevation))

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write the file that `file` of a measured [[wave]] names.

        Raises
        ------
        CaseError
            The name does not end in .csv, or a file of another kind is there.
        """
        target = Path(path)
        if target.suffix.lower() != ".csv":
            raise CaseError(f"{target}: a record for a case needs a name that ends in .csv")
        rows = (f"{t:.9g},{z:.9g}" for t, z in zip(self.time, self.elevation, strict=True))
        text = "time [s],elevation [m]\n" + "\n".join(rows) + "\n"
        outputs.write_text(outputs.claim(target, outputs.CSV), text)
        return target


def read_elevation(
    source: str | os.PathLike[str] | Table,
    *,
    column: str = "",
    time: str = "",
    rate: float | None = None,
    columns: Sequence[str] | None = None,
) -> Elevation:
    """Read a measured elevation.

    Parameters
    ----------
    source : path or Table
        As `read_table`.
    column : str
        Column of the elevation, "COLUMN" or "COLUMN:UNIT"; by default the one with such a name, or
        the only one beside the time. Metres where neither this nor its name states a unit.
    time : str
        Column of the time, likewise; by default the one with such a name, or the first of two.
        Seconds where no unit is stated.
    rate : float, optional
        Samples a second [Hz] of a file without a column of time.
    columns : sequence of str, optional
        Names of all columns, in place of those of the file.

    Returns
    -------
    Elevation

    Raises
    ------
    CaseError
        The table cannot be read, a column is not found, or the clock has gaps.
    """
    table = source if isinstance(source, Table) else read_table(source, columns)
    where = str(table.path)
    if rate is not None:
        if time or not 0.0 < rate < np.inf:
            raise CaseError(f"{where}: give a rate > 0 Hz, or a column of time; not both")
        t, taken = np.arange(len(table.values)) / rate, -1
    else:
        t, taken = _time(table, time)
    asked = column or _elevation(table, taken)
    values, unit = table.column(asked)
    unit = unit or bracketed(table.names[table.index(asked)])
    if unit not in ("", "m"):
        raise CaseError(
            f"{where}: column {asked!r} is in {unit}; expected a unit of length for the elevation, "
            f'such as --column "{asked}:m"'
        )
    t, values, notes = clock.even(where, t, values)
    if len(t) < FEWEST:
        raise CaseError(f"{where}: {len(t)} samples; at least {FEWEST} are needed")
    return Elevation(t - t[0], values, (*table.notes, *notes))


def _time(table: Table, asked: str) -> tuple[Array, int]:
    place = find(table, "time")
    if not asked:
        if place is None and len(table.names) != 2:
            raise CaseError(
                f"{table.path}: which column is the time? There are {table.listed()}: give "
                "--time COLUMN, or --rate HZ if no column is the time"
            )
        asked = str((place or 0) + 1) if not table.named else table.names[place or 0]
    values, unit = table.column(asked)
    if unit not in ("", "s"):
        raise CaseError(f"{table.path}: column {asked!r}: expected a unit of time, not {unit}")
    name = asked if asked in table.names else asked.rpartition(":")[0] or asked
    return values, table.index(name)


def _elevation(table: Table, time: int) -> str:
    others = [k for k in range(len(table.names)) if k != time]
    place = others[0] if len(others) == 1 else find(table, "elevation")
    if place is None:
        raise CaseError(
            f"{table.path}: which column is the elevation? There are {table.listed()}: give "
            "--column COLUMN"
        )
    return table.names[place]
