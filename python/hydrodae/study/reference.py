"""What a chart measures errors against: channels, a solution of them, and the error's norm."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.pictures.curve import read_curve
from hydrodae.pictures.panels import Line, select
from hydrodae.results import Results
from hydrodae.support.arrays import Array
from hydrodae.support.nearest import did_you_mean

#: Motion below this part of the largest coordinate is rounding.
_AT_REST = 1e-12


@dataclass(frozen=True)
class Solution:
    """Channels of one run over time.

    Attributes
    ----------
    time : (n_time,) array, s
    values : (n_channel, n_time) array
        In the units of `units`.
    units : tuple of str
        One a channel: m, deg, ...
    """

    time: Array
    values: Array
    units: tuple[str, ...]

    def excursions(self) -> dict[str, float]:
        """Largest excursion from the start among the channels of each unit; zero if at rest."""
        largest: dict[str, float] = {}
        for unit, row in zip(self.units, self.values, strict=True):
            reach = float(np.abs(row - row[0]).max())
            if reach <= _AT_REST * float(np.abs(row).max()):
                reach = 0.0
            largest[unit] = max(largest.get(unit, 0.0), reach)
        return largest

    def at(self, time: Array) -> Solution:
        """The solution at other times within its own [s]; by cubic spline where they differ."""
        if len(time) == len(self.time) and np.allclose(time, self.time, rtol=1e-12, atol=1e-12):
            return self
        from scipy.interpolate import CubicSpline

        if len(self.time) < 4:
            raise CaseError("a reference needs four samples at least")
        return Solution(time, CubicSpline(self.time, self.values, axis=1)(time), self.units)


def default_channels(results: Results) -> list[str]:
    """All joint coordinates; without any the bodies' positions, without these the tensions."""
    joints = [
        name
        for pattern in ("joints/*/angle*", "joints/*/displacement*")
        for name in results.channels(pattern)
        if not name.endswith("_rate")
    ]
    return joints or results.channels("bodies/*/position") or results.channels("forces/*/tension")


def pick(results: Results, channels: Sequence[str]) -> tuple[list[str], Solution]:
    """Names and series of `channels`, vectors by component, angles in degrees.

    Raises
    ------
    ChannelError, CaseError
        There is no such channel or component, or there is none at all.
    """
    names: list[str] = []
    lines: list[Line] = []
    for channel in channels:
        for name in results.channels(channel) if any(c in channel for c in "*?[") else [channel]:
            found = select(results, name)
            vector = len(found) > 1
            names += [f"{name}.{f.label.split()[-1]}" if vector else name for f in found]
            lines += found
    if not lines:
        raise CaseError(f"no channel matches {', '.join(channels) or 'an empty list'}")
    values = np.array([line.values for line in lines], dtype=float)
    return names, Solution(results.time, values, tuple(line.unit for line in lines))


def error(solution: Solution, reference: Solution) -> float:
    """Largest difference over time and channels, relative to the excursion of the unit [-].

    For the channels of one unit (all angles, all lengths) the scale is the largest excursion from
    the start that the reference has in any of them; a channel at rest beside moving ones so counts
    by what it adds to the motion of the scene. Units in which nothing moves are left out.

    Parameters
    ----------
    solution, reference : Solution
        Of the same channels. Compared at the times of `solution` that lie within the reference.

    Returns
    -------
    float
        infinity if a value is not finite.

    Raises
    ------
    CaseError
        Nothing moves in the reference, or the two have no time in common.

    Examples
    --------
    >>> t = np.linspace(0.0, 1.0, 5)
    >>> truth = Solution(t, np.array([4.0 * t, 0.0 * t]), ("m", "m"))
    >>> round(error(Solution(t, truth.values + 0.1, ("m", "m")), truth), 6)
    0.025
    """
    start, end = reference.time[0], reference.time[-1]
    slack = 1e-9 * (end - start)
    keep = (solution.time >= start - slack) & (solution.time <= end + slack)
    if np.count_nonzero(keep) < 2:
        raise CaseError(
            f"the reference from {start:g} to {end:g} s and the run have no time in common"
        )
    other = reference.at(solution.time[keep])
    scales = reference.excursions()
    if not any(scales.values()):
        raise CaseError("nothing moves in the chosen channels: there is no scale for the error")
    difference = np.abs(solution.values[:, keep] - other.values)
    if not np.isfinite(difference).all():
        return float("inf")
    parts = [
        float(row.max()) / scales[unit]
        for unit, row in zip(reference.units, difference, strict=True)
        if scales[unit] > 0
    ]
    return max(parts)


def read_file(
    path: str | os.PathLike[str], names: Sequence[str], units: Sequence[str], columns: Mapping
) -> Solution:
    """Read channels from a results file, a CSV or a JSON table with named columns.

    Parameters
    ----------
    path : path
        ``.h5`` as hydrodae writes it; ``.csv`` with a header line; ``.json`` as ``{"columns":
        ["t", ...], "rows": [[...], ...]}``. The first column is the time [s].
    names, units : sequence of str
        The channels, and their units. Tables hold SI values (rad), results files say their own.
    columns : mapping from str to str
        Column of a channel in the table; by default its own name.

    Raises
    ------
    CaseError
        No such file or column, or something is not a number.
    """
    path = Path(path)
    if not path.is_file():
        raise CaseError(f"{path}: no such reference file")
    if path.suffix in (".h5", ".hdf5"):
        return pick(Results.read(path), [columns.get(name, name) for name in names])[1]
    wanted = [columns.get(name, name) for name in names]
    if path.suffix == ".csv":
        curves = [read_curve(path, column) for column in wanted]
        time, series = curves[0].time, [curve.values for curve in curves]
        if any(len(curve.time) != len(time) for curve in curves):
            raise CaseError(f"{path}: the columns {', '.join(wanted)} have empty values")
    elif path.suffix == ".json":
        time, series = _read_json(path, wanted)
    else:
        raise CaseError(f"{path}: a reference is a .h5, .csv or .json file")
    factors = [np.degrees(1.0) if unit.startswith("deg") else 1.0 for unit in units]
    values = np.array([f * np.asarray(s) for f, s in zip(factors, series, strict=True)])
    if len(time) < 4 or np.any(np.diff(time) <= 0) or not np.isfinite(values).all():
        raise CaseError(f"{path}: a reference needs four samples, ascending times, finite values")
    return Solution(np.asarray(time), values, tuple(units))


def _read_json(path: Path, wanted: Sequence[str]) -> tuple[Array, list[Array]]:
    try:
        document = json.loads(path.read_text())
        header = [str(name) for name in document["columns"]]
        rows = np.array(document["rows"], dtype=float).reshape(-1, len(header))
    except (ValueError, TypeError, KeyError) as problem:
        raise CaseError(
            f'{path}: expected {{"columns": [names], "rows": [[numbers]]}} ({problem})'
        ) from None
    for name in wanted:
        if name not in header[1:]:
            hint = did_you_mean(name, header[1:], f"; there are {', '.join(header[1:])}")
            raise CaseError(f"{path}: no column {name!r}{hint}")
    return rows[:, 0], [rows[:, header.index(name)] for name in wanted]
