"""Scatter tables: how often sea states come."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.study.sweep.points import read_csv
from hydrodae.support.arrays import Array

COLUMNS = ("height", "period", "hours")


@dataclass(frozen=True)
class ScatterTable:
    """Sea states that occur.

    Attributes
    ----------
    height, period : (n,) arrays
        Significant height [m] and peak period [s].
    hours : (n,) array
        A year, > 0.
    """

    height: Array
    period: Array
    hours: Array


def read_scatter(path: str | os.PathLike[str]) -> ScatterTable:
    """Read a CSV file with the columns height [m], period [s] and hours a year.

    Rows without hours, and those without height, are left out.

    Raises
    ------
    CaseError
        It cannot be read, or a value is no number or negative.
    """
    file = Path(path)
    rows = read_csv(file, "scatter", file.name)
    try:
        values = np.array([[float(row[name]) for name in COLUMNS] for row in rows])
    except (KeyError, ValueError) as error:
        raise CaseError(
            f"{file}: expected numbers in columns height, period, hours; {error}", key="scatter"
        ) from None
    if not np.isfinite(values).all() or (values < 0.0).any():
        raise CaseError(f"{file}: a height, period or number of hours is negative or not finite")
    values = values[(values[:, 2] > 0.0) & (values[:, 0] > 0.0)]
    if not len(values) or not (values[:, 1] > 0.0).all():
        raise CaseError(f"{file}: no sea state has height, period and hours > 0")
    return ScatterTable(*values.T)
