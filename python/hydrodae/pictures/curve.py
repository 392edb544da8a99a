"""Curves of others (other codes, measurements) to compare results with."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.table import read_table
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Curve:
    """A named series in the unit of the picture: degrees for angles.

    Attributes
    ----------
    label : str
    time : (n,) array, s
    values : (n,) array
    points : bool
        Marked points instead of a line.
    spread : (2, n) array, optional
        Lower and upper end of a bar at each point.
    """

    label: str
    time: Array
    values: Array
    points: bool = False
    spread: Array | None = None

    def until(self, end_time: float) -> Curve:
        """Return the part up to `end_time` [s]."""
        keep = self.time <= end_time
        spread = None if self.spread is None else self.spread[:, keep]
        return replace(self, time=self.time[keep], values=self.values[keep], spread=spread)


def parse_curve(spec: str) -> Curve:
    """Read the curve that "file.csv:column[:label[:scale]]" of a command line names.

    Raises
    ------
    CaseError
        As `read_curve`; or the text has another form.
    """
    path, *rest = spec.split(":")
    if not path or not 1 <= len(rest) <= 3:
        raise CaseError(f"{spec}: expected file.csv:column[:label[:scale]]")
    column, label, scale = (*rest, "", "")[:3]
    try:
        factor = float(scale or 1.0)
    except ValueError:
        raise CaseError(f"{spec}: the scale {scale!r} is not a number") from None
    return read_curve(path, column, label=label, scale=factor)


def read_curve(
    path: str | os.PathLike[str], column: str, *, label: str = "", scale: float = 1.0
) -> Curve:
    """Read one column of a table over its first column, the time [s].

    Parameters
    ----------
    path : path
        As `hydrodae.records.read_table`: text or MATLAB's .mat.
    column : str
        Its name, or its number from 1.
    label : str
        Name in the legend; by default that of the column.
    scale : float
        Factor from the file's unit to that of the picture (degrees for angles).

    Returns
    -------
    Curve
        Rows whose value is empty are left out.

    Raises
    ------
    CaseError
        No such file or column, or the table cannot be read.
    """
    table = read_table(path)
    if column in table.names[:1]:
        raise CaseError(f"{table.path}: column {column!r} is the time; name another one")
    time, values = table.values[:, 0], scale * table.values[:, table.index(column)]
    keep = np.isfinite(values)
    if not np.isfinite(time[keep]).all():
        raise CaseError(f"{table.path}: a time is missing")
    return Curve(label or column, time[keep], values[keep])
