"""Write a database for other programs: BEMIO `.h5` (WEC-Sim and its peers) and Capytaine netCDF.

Both are read back by our own readers to the same numbers.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray as xr

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database.database import HydroDatabase
from hydrodae.hdb.database.files import partial_file
from hydrodae.hdb.database.kernels import excitation_kernel, memory_length
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import six_of_each
from hydrodae.support import outputs
from hydrodae.support.arrays import Array

#: Times of the kernels in a BEMIO file.
KERNEL_TIMES = 1001
#: Longest step of the time of a kernel times the highest frequency: 10 points a period.
RESOLUTION = 0.6


def write_bemio(database: HydroDatabase, path: str | Path) -> None:
    """Write a BEMIO `.h5` file, with the kernels K(t) and K_ex(t) that WEC-Sim convolves.

    Parameters
    ----------
    database : HydroDatabase
        With all six coordinates, hydrostatics and reference point of every body: the format has
        no place for less. Moments are about the reference points, which become `cg`.
    path : path
        The file; an existing one is replaced only by a complete one.

    Raises
    ------
    DatabaseError
        Something of the above is missing.

    Notes
    -----
    `scaled` = 0: A/rho, B/(rho w), F/(rho g), C/(rho g), K/rho, K_ex/(rho g). Where the source
    gave the total excitation only, scattering and froude-krylov hold NaN, as BEMIO does.
    """
    db = database.reordered(_six_of_each(database))
    statics = {name: db.hydrostatics(name) for name in db.bodies}
    target = Path(path)
    partial = partial_file(target, outputs.BEMIO)
    end = 1.25 * memory_length(db)
    count = max(KERNEL_TIMES, int(np.ceil(end * db.omega[-1] / RESOLUTION)) + 1)
    time = np.linspace(0.0, end, count)
    both = np.linspace(-end, end, 2 * count - 1)
    kernel = db.radiation_kernel(time, extrapolate=True) / db.rho
    excitation = excitation_kernel(db, both) / (db.rho * db.gravity)
    with h5py.File(partial, "w") as f:
        f["bem_data/code"] = np.bytes_("hydrodae")
        f["bem_data/source"] = np.bytes_(f"{db.source}, sha256 {db.source_sha256}")
        _simulation_parameters(f, db)
        for i, (name, hs) in enumerate(statics.items()):
            rows = slice(6 * i, 6 * i + 6)
            g = f.create_group(f"body{i + 1}")
            _properties(g, db, i, name, hs)
            k = db.hydrostatic_stiffness(name) / (db.rho * db.gravity)
            _put(g, "hydro_coeffs/linear_restoring_stiffness", k, "C/(rho g)", "N/m")
            _radiation(g, db, rows, kernel, time)
            _excitation(g, db, rows, excitation, both)
    os.replace(partial, target)


def _simulation_parameters(f: h5py.File, db: HydroDatabase) -> None:
    g = f.create_group("simulation_parameters")
    _put(g, "scaled", 0.0, "", "")
    _put(g, "rho", db.rho, "Water density", "kg/m^3")
    _put(g, "g", db.gravity, "Gravitational acceleration", "m/s^2")
    _put(g, "w", db.omega[:, None], "Wave frequencies", "rad/s")
    _put(g, "T", 2.0 * np.pi / db.omega[:, None], "Wave periods", "s")
    _put(g, "wave_dir", np.degrees(db.heading)[:, None], "Wave direction", "deg")
    if np.isfinite(db.water_depth):
        _put(g, "water_depth", db.water_depth, "Water depth", "m")
    else:
        g["water_depth"] = np.bytes_("infinite")


def _properties(g: h5py.Group, db: HydroDatabase, i: int, name: str, hs: Hydrostatics) -> None:
    g["properties/name"] = np.bytes_(name)
    _put(g, "properties/body_number", i + 1.0, "Number of the body", "")
    _put(g, "properties/cg", db.reference_point(name)[:, None], "Reference point", "m")
    _put(g, "properties/cb", hs.center_of_buoyancy[:, None], "Center of buoyancy", "m")
    _put(g, "properties/disp_vol", hs.displaced_volume, "Displaced volume", "m^3")
    _put(g, "properties/dof", 6.0, "Degrees of freedom", "")
    _put(g, "properties/dof_start", 6.0 * i + 1.0, "Degrees of freedom", "")
    _put(g, "properties/dof_end", 6.0 * i + 6.0, "Degrees of freedom", "")


def _radiation(g: h5py.Group, db: HydroDatabase, rows: slice, kernel: Array, time: Array) -> None:
    a = db.added_mass[:, rows].transpose(1, 2, 0) / db.rho
    _put(g, "hydro_coeffs/added_mass/all", a, "A/rho", "kg")
    _put(g, "hydro_coeffs/added_mass/inf_freq", db.added_mass_inf[rows] / db.rho, "A/rho", "kg")
    b = (db.radiation_damping[:, rows] / db.omega[:, None, None]).transpose(1, 2, 0) / db.rho
    _put(g, "hydro_coeffs/radiation_damping/all", b, "B/(rho w)", "N-s/m")
    place = "hydro_coeffs/radiation_damping/impulse_response_fun"
    _put(g, f"{place}/K", kernel[:, rows].transpose(1, 2, 0), "K/rho", "")
    _put(g, f"{place}/t", time[:, None], "Times", "s")
    _put(g, f"{place}/w", db.omega[:, None], "Frequencies of B", "rad/s")


def _excitation(g: h5py.Group, db: HydroDatabase, rows: slice, kernel: Array, time: Array) -> None:
    parts = {"": db.excitation, "froude-krylov/": db.froude_krylov, "scattering/": db.diffraction}
    for key, table in parts.items():
        value = table[:, :, rows].transpose(2, 1, 0) / (db.rho * db.gravity)
        if key and not db.excitation_split:
            value = np.full_like(value, np.nan + 1j * np.nan)
        place = f"hydro_coeffs/excitation/{key}"
        for name, part in (
            ("re", value.real),
            ("im", value.imag),
            ("mag", np.abs(value)),
            ("phase", np.angle(value)),
        ):
            _put(g, place + name, part, "F/(rho g)", "rad" if name == "phase" else "N")
    place = "hydro_coeffs/excitation/impulse_response_fun"
    _put(g, f"{place}/f", kernel[:, :, rows].transpose(2, 1, 0), "K_ex/(rho g)", "")
    _put(g, f"{place}/t", time[:, None], "Times", "s")
    _put(g, f"{place}/w", db.omega[:, None], "Frequencies of F", "rad/s")


def write_capytaine(database: HydroDatabase, path: str | Path) -> None:
    """Write a netCDF file as Capytaine 3 exports them (e^{-iwt}, complex as re and im).

    Parameters
    ----------
    database : HydroDatabase
        Any coordinates; those of one body need not be six.
    path : path
        The file; an existing one is replaced only by a complete one.

    Raises
    ------
    DatabaseError
        A body has no reference point.

    Notes
    -----
    Added mass at infinite frequency is the row w = inf, where B and the forces are NaN.
    `center_of_mass` is set to the rotation centre: with it `hydrostatic_stiffness` holds buoyancy
    only. Where the source gave the total excitation only, the file has `excitation_force` alone.
    """
    db, target = database, Path(path)
    if any(label.is_mode for label in db.labels):
        raise DatabaseError(
            "this format has no modes of bodies: select the rigid coordinates"
        ).about("unsupported", "modes")
    dofs = [f"{label.body}__{label.motion.capitalize()}" for label in db.labels]
    n, nh = len(dofs), db.heading.size
    square = ("omega", "influenced_dof", "radiating_dof")
    force = ("complex", "omega", "wave_direction", "influenced_dof")
    data: dict[str, Any] = {
        "added_mass": (square, np.concatenate([db.added_mass, db.added_mass_inf[None]])),
        "radiation_damping": (
            square,
            np.concatenate([db.radiation_damping, np.full((1, n, n), np.nan)]),
        ),
    }
    forces = {"excitation_force": db.excitation}
    if db.excitation_split:
        forces["Froude_Krylov_force"] = db.froude_krylov
        forces["diffraction_force"] = db.diffraction
    for name, table in forces.items() if nh else ():
        parts = np.full((2, db.omega.size + 1, nh, n), np.nan)
        parts[0, :-1], parts[1, :-1] = table.real, -table.imag
        data[name] = (force, parts)
    points = np.array([db.reference_point(name) for name in db.bodies])
    data["rotation_center"] = (("body", "space_coordinate"), points)
    coords: dict[str, Any] = {
        "omega": np.append(db.omega, np.inf),
        "influenced_dof": dofs,
        "radiating_dof": dofs,
        "complex": ["re", "im"],
        "wave_direction": db.heading,
        "body": list(db.bodies),
        "rho": db.rho,
        "g": db.gravity,
        "water_depth": db.water_depth,
    }
    if all(b.hydrostatics is not None for b in db.bodies.values()):
        data.update(_capytaine_hydrostatics(db, points))
    attrs = {
        "title": db.title,
        "history": f"written by {db.generator}; source {db.source}, sha256 {db.source_sha256}",
        "capytaine_version": "written by hydrodae in the layout of 3.0",
    }
    partial = partial_file(target, outputs.NETCDF)
    xr.Dataset(data, coords=coords, attrs=attrs).to_netcdf(partial, engine="netcdf4")
    os.replace(partial, target)


def _capytaine_hydrostatics(db: HydroDatabase, points: Array) -> dict[str, Any]:
    n = len(db.coordinates)
    stiffness = np.zeros((n, n))
    for name in db.bodies:
        mine = [(i, label.dof) for i, label in enumerate(db.labels) if label.body == name]
        rows, six = [i for i, _ in mine], [dof for _, dof in mine]
        stiffness[np.ix_(rows, rows)] = db.hydrostatic_stiffness(name)[np.ix_(six, six)]
    statics = [db.hydrostatics(name) for name in db.bodies]
    vector = ("body", "space_coordinate")
    return {
        "hydrostatic_stiffness": (("influenced_dof", "radiating_dof"), stiffness),
        "center_of_buoyancy": (vector, np.array([h.center_of_buoyancy for h in statics])),
        "center_of_mass": (vector, points),
        "disp_mass": (("body",), np.array([db.rho * h.displaced_volume for h in statics])),
    }


def _six_of_each(db: HydroDatabase) -> tuple[str, ...]:
    wanted = six_of_each(db.bodies)
    missing = [c for c in wanted if c not in db.coordinates]
    if missing:
        raise DatabaseError(
            f"a BEMIO file holds all six coordinates of every body; missing: {', '.join(missing)} "
            f"(write a Capytaine netCDF instead)"
        ).about("missing", missing[0])
    return wanted


def _put(group: h5py.Group, name: str, value: Any, description: str, units: str) -> None:
    """One dataset; scalars as (1, 1), as MATLAB writes them."""
    value = np.asarray(value, dtype=float)
    dataset = group.create_dataset(name, data=value.reshape(1, 1) if value.ndim == 0 else value)
    dataset.attrs["description"], dataset.attrs["units"] = description, units


#: What writes a file, by the ending of its name.
WRITERS = {".h5": write_bemio, ".nc": write_capytaine}


def export(database: HydroDatabase, path: str | Path) -> None:
    """Write a database for other programs; the command `hydrodae hdb export`.

    Parameters
    ----------
    database : HydroDatabase
        As the format asks for; see `write_bemio` and `write_capytaine`.
    path : path
        Ends in .h5 (BEMIO, for WEC-Sim) or .nc (netCDF as Capytaine makes it); an existing file is
        replaced only by a complete one.

    Raises
    ------
    CaseError
        Another ending.
    DatabaseError
        The database lacks what the format demands.
    """
    ending = Path(path).suffix.lower()
    if ending not in WRITERS:
        raise CaseError(f"{path}: expected a name that ends in .h5 (BEMIO) or .nc")
    WRITERS[ending](database, path)
