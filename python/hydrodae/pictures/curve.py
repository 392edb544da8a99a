"""Curves of others (other codes, measurements) to compare results with."""

from __future__ import annotations

import csv
import difflib
import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import CaseError


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
    time: NDArray[np.float64]
    values: NDArray[np.float64]
    points: bool = False
    spread: NDArray[np.float64] | None = None

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
    """Read one column of a CSV file with a header line, over its first column, the time [s].

    Parameters
    ----------
    path : path
    column : str
        Name in the header.
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
        No such file or column, or something is not a number.
    """
    path = Path(path)
    if not path.is_file():
        raise CaseError(f"{path}: no such file")
    time, values = [], []
    with path.open(newline="", encoding="utf-8") as stream:
        rows = csv.reader(stream)
        header = [name.strip() for name in next(rows, [])]
        if column not in header[1:]:
            near = difflib.get_close_matches(column, header[1:], n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(header[1:])}"
            raise CaseError(f"{path}: no column {column!r}; {hint}")
        index = header.index(column)
        for row in rows:
            if len(row) <= index or not row[index].strip():
                continue
            try:
                time.append(float(row[0]))
                values.append(float(row[index]))
            except ValueError as error:
                raise CaseError(f"{path}:{rows.line_num}: {error}") from None
    return Curve(label or column, np.array(time), scale * np.array(values))
