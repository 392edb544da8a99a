"""What the readers of AQWA's `.AH1` and `.LIS` share."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import six_of_each
from hydrodae.hdb.readers.source import SourceData
from hydrodae.support.arrays import Array, Complex


def unit_of_mass(rho: float, gravity: float) -> float:
    """Kilograms in the unit of mass of a file: AQWA works in kg, m, N or in t, m, kN.

    Raises
    ------
    DatabaseError
        Neither, as feet and pounds.
    """
    if 9.0 < gravity < 10.5:
        if 100.0 < rho < 20000.0:
            return 1.0
        if 0.1 < rho < 20.0:
            return 1000.0
    raise DatabaseError(
        f"density {rho:g} and gravity {gravity:g}: neither kg, m, N nor t, m, kN; choose "
        f"metric units in AQWA"
    ).about("units", "density")


def structure_names(path: Path, count: int) -> list[str]:
    """Names of the structures: that of the file if there is one only."""
    return [f"structure{i + 1}" if count > 1 else path.stem for i in range(count)]


def to_world(force: Complex, k: Array, heading: Array, centers: list[Array]) -> Complex:
    """Move the phase zero from the centre of gravity of each structure to the origin.

    Parameters
    ----------
    force : (nw, nh, 6 n) complex array
        Six forces of each structure.
    k : (nw,) array
        Wavenumbers [rad/m].
    heading : (nh,) array
        [rad].
    centers : list of n (3,) arrays
        [m].
    """
    result = force.copy()
    for i, center in enumerate(centers):
        along = center[0] * np.cos(heading) + center[1] * np.sin(heading)
        result[:, :, 6 * i : 6 * i + 6] *= np.exp(-1j * np.outer(k, along))[:, :, None]
    return result


def unique_headings(degrees: Array) -> tuple[Array, NDArray[np.intp]]:
    """Headings [rad] without the second of -180 and 180 degrees, and their places in the file."""
    _, kept = np.unique(np.round(np.mod(degrees, 360.0), 6), return_index=True)
    kept = np.sort(kept)
    return np.radians(degrees[kept]), kept


def aqwa_data(
    path: Path,
    names: list[str],
    omega: Array,
    tables: tuple[Array, Array, Array | None],
    heading: Array,
    centers: list[Array],
    water: tuple[float, float, float],
) -> SourceData:
    """Return the tables (A, B, added_mass_inf) of AQWA without forces and hydrostatics.

    Parameters
    ----------
    path : Path
    names : list of str
        One for each structure.
    omega, tables, heading
        As in `SourceData`.
    centers : list of (3,) arrays
        Centres of gravity [m].
    water : tuple of float
        Density, gravity, depth [kg/m3, m/s2, m].
    """
    findings = []
    if tables[2] is not None:
        text = "AQWA's at 100 rad/s stands for infinite frequency"
        findings.append(Finding("info", "added_mass_inf of the source", text))
    clean = unique_names(names)
    return SourceData(
        coordinates=six_of_each(clean),
        omega=omega,
        added_mass=tables[0],
        radiation_damping=tables[1],
        heading=heading,
        reference_points=dict(zip(clean, centers, strict=True)),
        rho=water[0],
        gravity=water[1],
        water_depth=water[2],
        name=path.name,
        title=f"AQWA {path.stem}",
        added_mass_inf=tables[2],
        files=[path],
        findings=findings,
    )
