"""netCDF files of Capytaine 1 to 3.

Capytaine's phasors are e^{-iwt}: forces are conjugated here. Everything is taken by the name of the
dimension and by the label of the degree of freedom, never by position: the order of influenced_dof
and radiating_dof changed between versions.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.extra import kept_tables, label_text, shallow_findings
from hydrodae.hdb.database.files import damaged
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.capytaine_dofs import coordinates_of, with_motions
from hydrodae.hdb.readers.capytaine_statics import attach_bodies
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.damaged import apart, guarded
from hydrodae.support.naming import names_file

FREQUENCY_AXES = ("omega", "period", "freq", "wavenumber", "wavelength")
#: Deflate, which netCDF-4 packs with, makes data smaller by 1032 times at most.
MOST_PACKED = 1032
UNREADABLE = "not a readable netCDF file"
FORCES = {
    "froude_krylov": "Froude_Krylov_force",
    "diffraction": "diffraction_force",
    "excitation": "excitation_force",
}


@names_file
def read_capytaine(path: Path, motions: Mapping[str, str] | None = None) -> SourceData:
    """Read a netCDF file of Capytaine (NETCDF3 or NETCDF4).

    Parameters
    ----------
    path : Path
        The file.
    motions : dict of str, optional
        Own degrees of freedom that are rigid motions of their bodies, as {"Hinge": "pitch"}.

    Returns
    -------
    SourceData
        The row at w = 0 is left out; the row at w = inf becomes `added_mass_inf`.

    Raises
    ------
    DatabaseError
        Not such a file, something missing, or dimensions that cannot be one database.
    """
    with guarded(path, damaged, UNREADABLE):
        return _read(path, load_dataset(path), motions or {})


def _read(path: Path, ds: xr.Dataset, motions: Mapping[str, str]) -> SourceData:
    ds = _one_case(ds)
    for name in ("added_mass", "radiation_damping"):
        if name not in ds:
            raise DatabaseError(f"no variable {name!r} in it").about("missing", name)
    ds, omega = _frequencies(ds)
    if np.any(np.isnan(omega) | (omega < 0.0)):
        at = int(np.flatnonzero(np.isnan(omega) | (omega < 0.0))[0])
        raise DatabaseError(f"frequency {at + 1} is {omega[at]:g} rad/s; expected all >= 0").about(
            "frequencies"
        )
    findings: list[Finding] = []
    with_motions(ds, motions, findings)
    raw, coordinates = coordinates_of(path, ds, findings)
    a = _matrix(ds, "added_mass", raw)
    b = _matrix(ds, "radiation_damping", raw)
    usual = np.isfinite(omega) & (omega > 0.0)
    order = np.flatnonzero(usual)[np.argsort(omega[usual])]
    forces = {key: _force(ds, name, raw, order) for key, name in FORCES.items()}
    heading = np.zeros(0)
    if any(v is not None for v in forces.values()):
        heading = _headings(ds)
    if np.any(omega == 0.0):
        findings.append(Finding("info", "w = 0", "row at zero frequency set aside"))
    at_infinity = a[np.isinf(omega)]
    a_inf = at_infinity[0] if len(at_infinity) and np.all(np.isfinite(at_infinity[0])) else None
    data = SourceData(
        coordinates=coordinates,
        omega=omega[order],
        added_mass=a[order],
        radiation_damping=b[order],
        heading=heading,
        froude_krylov=forces["froude_krylov"],
        diffraction=forces["diffraction"],
        excitation=forces["excitation"],
        rho=_number(ds, "rho"),
        gravity=_number(ds, "g"),
        water_depth=_depth(ds),
        name=path.name,
        title=f"Capytaine {ds.attrs.get('capytaine_version', '?')}, {path.name}",
        added_mass_inf=a_inf,
        files=[path],
        findings=findings,
        extra=kept_tables(ds),
    )
    findings += shallow_findings(ds)
    attach_bodies(data, ds, raw, path)
    return data


def load_dataset(path: Path) -> xr.Dataset:
    """Load a netCDF file: netCDF-3 with scipy, netCDF-4 with netCDF4.

    netCDF4 reads netCDF-3 as well, but fills what is missing of a file that is cut short with zeros
    and reports no error. scipy refuses such a file.
    """
    with open(path, "rb") as f:
        magic = f.read(4)
    if magic[:3] == b"CDF":
        return _load(path, "scipy")
    # the child alone reads: it waits for no lock that another thread had as it was made
    return apart(path, damaged, UNREADABLE, lambda: _load(path, "netcdf4", lock=False))


def _load(path: Path, engine: Literal["scipy", "netcdf4"], **how: Any) -> xr.Dataset:
    try:
        opened = xr.open_dataset(path, engine=engine, **how)
    except (OSError, ValueError, TypeError, LookupError, AttributeError, RuntimeError) as error:
        raise damaged(path, f"{UNREADABLE} ({error})") from error
    with opened:
        if opened.nbytes > MOST_PACKED * path.stat().st_size:
            raise damaged(path, f"it cannot hold the {opened.nbytes:.3g} bytes that it states")
        return opened.load()


def _headings(ds: xr.Dataset) -> Array:
    """Directions of travel, which Capytaine writes in radians."""
    heading = np.atleast_1d(ds["wave_direction"].values).astype(float)
    if np.abs(heading).max() > 2.0 * np.pi + 1e-6:
        raise DatabaseError(
            f"wave_direction {np.abs(heading).max():g}: expected radians, at most 2 pi; "
            f"are these degrees?"
        ).about("units", "wave_direction")
    return heading


def _one_case(ds: xr.Dataset) -> xr.Dataset:
    """Drop dimensions of length one that parametrise a study; refuse longer ones."""
    known = {"influenced_dof", "radiating_dof", "complex", "wave_direction", *FREQUENCY_AXES}
    for name in ds["added_mass"].dims if "added_mass" in ds else ():
        if name in known:
            continue
        if ds.sizes[name] != 1:
            raise DatabaseError(
                f"{ds.sizes[name]} values of {name!r}; select one before exporting "
                f"(dataset.isel({name}=0))"
            ).about("ambiguous", str(name))
        ds = ds.isel({name: 0})
    speed = float(np.max(np.abs(ds["forward_speed"].values))) if "forward_speed" in ds else 0.0
    if speed > 0.0:
        raise DatabaseError(
            f"forward_speed {speed:g} m/s: only tables of bodies without forward speed "
            f"are supported"
        ).about("unsupported", "forward_speed")
    return ds


def _frequencies(ds: xr.Dataset) -> tuple[xr.Dataset, Array]:
    """Rename the frequency dimension to `omega` and return its values [rad/s]."""
    axes = [d for d in ds["added_mass"].dims if d in FREQUENCY_AXES]
    if not axes:
        if "omega" not in ds.coords:
            raise DatabaseError(f"no frequency dimension ({', '.join(FREQUENCY_AXES)})").about(
                "missing", "frequency"
            )
        return ds.expand_dims("omega"), np.atleast_1d(ds["omega"].values).astype(float)
    axis = str(axes[0])
    if "omega" in ds.coords:
        values = np.atleast_1d(ds["omega"].values).astype(float)
    else:
        given = np.atleast_1d(ds[axis].values).astype(float)
        with np.errstate(divide="ignore"):
            values = _to_omega(ds, axis, given)
    if axis != "omega":
        ds = ds.drop_vars("omega", errors="ignore").rename({axis: "omega"})
    return ds, values


def _to_omega(ds: xr.Dataset, axis: str, given: Array) -> Array:
    if axis == "period":
        return 2.0 * np.pi / given
    if axis == "freq":
        return 2.0 * np.pi * given
    k = given if axis == "wavenumber" else 2.0 * np.pi / given
    return frequency(k, _depth(ds), _number(ds, "g"))


def _matrix(ds: xr.Dataset, name: str, dofs: list[str]) -> Array:
    """Return a variable as (nw, force, motion)."""
    variable = ds[name].sel(influenced_dof=dofs, radiating_dof=dofs)
    dims = "omega", "influenced_dof", "radiating_dof"
    return np.asarray(_ordered(variable, name, dims), dtype=float)


def _ordered(variable: xr.DataArray, name: str, dims: tuple[str, ...]) -> NDArray[Any]:
    """Return the values of a variable along these dimensions; refuse others."""
    try:
        return np.asarray(variable.transpose(*dims).values)
    except ValueError as error:
        raise DatabaseError(f"dimensions of {name!r}: {variable.dims}").about(
            "shape", name
        ) from error


def _force(ds: xr.Dataset, name: str, dofs: list[str], order: NDArray[np.intp]) -> Complex | None:
    """Return a force as (nw, nh, n) in the project convention."""
    if name not in ds:
        return None
    variable = ds[name].sel(influenced_dof=dofs)
    if "complex" in variable.dims:
        labels = [label_text(c) for c in variable["complex"].values]
        if sorted(labels) != ["im", "re"]:
            raise DatabaseError(f"dimension 'complex' of {name!r} is labelled {labels}").about(
                "format", name
            )
        variable = variable.assign_coords(complex=labels)
        variable = variable.sel(complex="re") + 1j * variable.sel(complex="im")
    if "wave_direction" not in variable.dims:
        variable = variable.expand_dims("wave_direction")
    values = _ordered(variable, name, ("omega", "wave_direction", "influenced_dof"))
    return np.asarray(np.conj(values[order]), dtype=complex)


def _number(ds: xr.Dataset, name: str) -> float:
    if name not in ds or ds[name].size != 1:
        raise DatabaseError(f"needs one value of {name!r}").about("missing", name)
    return float(ds[name].values.item())


def _depth(ds: xr.Dataset) -> float:
    """Water depth; versions before 1.5 state the height of the sea bottom instead."""
    if "water_depth" not in ds and "sea_bottom" in ds:
        return -_number(ds, "sea_bottom")
    return _number(ds, "water_depth")
