"""What the readers of AQWA's `.AH1` and `.LIS` share."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import six_of_each
from hydrodae.hdb.readers.setting import Setting
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


def unique_headings(degrees: Array) -> tuple[Array, NDArray[np.intp]]:
    """Headings [rad] without the second of -180 and 180 degrees, and their places in the file."""
    _, kept = np.unique(np.round(np.mod(degrees, 360.0), 6), return_index=True)
    kept = np.sort(kept)
    return np.radians(degrees[kept]), kept


def aqwa_data(
    path: Path,
    omega: Array,
    tables: tuple[Array, Array, Array | None],
    heading_deg: Array,
    forces: dict[str, Complex],
    centers: list[Array],
    water: tuple[float, float, float],
) -> SourceData:
    """Return the tables of n structures in SI units, without hydrostatics.

    A, B, added_mass_inf and `forces` (nw, nh, 6 n), with their phase zero at the centres of gravity
    [m], are in the unit of mass of the file; `water` are its density, gravity and depth.
    """
    unit, findings = unit_of_mass(water[0], water[1]), list[Finding]()
    if tables[2] is not None:
        text = "AQWA's at 100 rad/s stands for infinite frequency"
        findings.append(Finding("info", "added_mass_inf of the source", text))
    count = len(centers)
    names = unique_names([f"structure{i + 1}" if count > 1 else path.stem for i in range(count)])
    heading, kept = unique_headings(heading_deg)
    data = SourceData(
        coordinates=six_of_each(names),
        omega=omega,
        added_mass=unit * tables[0],
        radiation_damping=unit * tables[1],
        heading=heading,
        reference_points=dict(zip(names, centers, strict=True)),
        rho=float(unit * water[0]),
        gravity=float(water[1]),
        water_depth=float(water[2]),
        name=path.name,
        title=f"AQWA {path.stem}",
        added_mass_inf=None if tables[2] is None else unit * tables[2],
        files=[path],
        findings=findings,
        setting=Setting(unit=unit),
        **{name: unit * force[:, kept] for name, force in forces.items()},  # type: ignore[arg-type]
    )
    data.to_origin(dict(zip(names, centers, strict=True)))
    return data
