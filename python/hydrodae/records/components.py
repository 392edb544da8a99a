"""Components of a sea with their phases, from files."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.quantities import find, in_unit
from hydrodae.records.spectrum import read_spectrum
from hydrodae.records.table import Table, read_table

_ADVICE = 'give --columns "amplitude [m],period [s],direction [deg],phase [deg]"'


@dataclass(frozen=True)
class Component:
    """amplitude cos(omega t - k (x cos heading + y sin heading) + phase).

    Attributes
    ----------
    amplitude : float
        [m]
    omega : float
        [rad/s]
    heading, phase : float
        [rad]
    """

    amplitude: float
    omega: float
    heading: float
    phase: float

    def wave(self, name: str) -> dict[str, Any]:
        """Keys of a regular [[wave]]."""
        return {
            "name": name,
            "type": "regular",
            "height": 2.0 * self.amplitude,
            "period": 2.0 * math.pi / self.omega,
            "heading_deg": _turned(math.degrees(self.heading)),
            "phase_deg": _turned(math.degrees(self.phase)),
        }


def read_components(
    source: str | os.PathLike[str] | Table,
    columns: Sequence[str] | None = None,
    heading_deg: float = 0.0,
) -> list[Component]:
    """Read a table of components, one a row.

    Parameters
    ----------
    source : path or Table
        As `read_table`. Columns amplitude or height [m], period [s] or frequency [Hz] or [rad/s],
        phase [deg] or [rad], and direction [deg] of travel if there are several. In place of an
        amplitude, a spectral density S as `read_spectrum` takes it: amplitudes sqrt(2 S dw).
    columns : sequence of str, optional
        Names of all columns, in place of those of the file.
    heading_deg : float
        Direction of all, where there is no such column.

    Returns
    -------
    list of Component
        Rows without amplitude are left out.

    Raises
    ------
    CaseError
        A column or its unit is not known, or a value cannot be used.
    """
    table = source if isinstance(source, Table) else read_table(source, columns)
    phase = find(table, "phase")
    if phase is None:
        raise CaseError(
            f"{table.path}: which column is the phase? There are {table.listed()}: {_ADVICE}"
        )
    amplitudes, omegas = _amplitudes(table)
    direction = find(table, "direction")
    headings = (
        np.full(len(omegas), math.radians(heading_deg))
        if direction is None
        else in_unit(table, direction, "rad", "deg")
    )
    phases = in_unit(table, phase, "rad")
    rows = zip(amplitudes, omegas, headings, phases, strict=True)
    found = [Component(*map(float, row)) for row in rows if row[0] > 0.0]
    if not found:
        raise CaseError(f"{table.path}: all amplitudes are zero")
    return found


def _amplitudes(table: Table) -> tuple[np.ndarray, np.ndarray]:
    """Amplitudes [m] and frequencies [rad/s]."""
    size, height = find(table, "amplitude"), find(table, "height")
    if size is None and height is None:
        if find(table, "density") is None:
            raise CaseError(
                f"{table.path}: which column is the amplitude? There are {table.listed()}: "
                f"{_ADVICE}"
            )
        return _of_density(table)
    if size is not None:
        amplitudes = in_unit(table, size, "m", "m")
    else:
        assert height is not None
        amplitudes = 0.5 * in_unit(table, height, "m", "m")
    omegas = _frequencies(table)
    if (amplitudes < 0.0).any() or not (omegas > 0.0).all():
        raise CaseError(f"{table.path}: amplitudes must be >= 0, periods and frequencies > 0")
    return amplitudes, omegas


def _of_density(table: Table) -> tuple[np.ndarray, np.ndarray]:
    """As of a spectrum, whose rows each stand for half of the way to their neighbours."""
    directions = find(table, "direction")
    kept = [k for k in range(len(table.names)) if k != directions]
    names = tuple(table.names[k] for k in kept)
    rows = _frequencies(table)
    if not (np.diff(rows) > 0.0).all() or not rows[0] > 0.0:
        raise CaseError(f"{table.path}: frequencies of a density must be > 0 and ascend")
    spectrum = read_spectrum(Table(table.path, names, table.values[:, kept]))
    ends = np.concatenate([rows[:1], rows, rows[-1:]])
    return np.sqrt(spectrum.density[0] * (ends[2:] - ends[:-2])), rows  # 2 S dw, dw half of it


def _frequencies(table: Table) -> np.ndarray:
    for quantity in ("period", "omega", "frequency"):
        place = find(table, quantity)
        if place is None:
            continue
        if quantity == "period":
            periods = in_unit(table, place, "s", "s")
            if not (periods > 0.0).all():
                raise CaseError(f"{table.path}: periods must be > 0")
            return np.asarray(2.0 * math.pi / periods)
        return in_unit(table, place, "rad/s", "rad/s" if quantity == "omega" else None)
    raise CaseError(
        f"{table.path}: which column is the period or frequency? There are {table.listed()}: "
        f"{_ADVICE}"
    )


def _turned(degrees: float) -> float:
    return (degrees + 180.0) % 360.0 - 180.0
