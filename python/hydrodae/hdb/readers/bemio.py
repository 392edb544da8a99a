"""BEMIO `.h5` files, which WEC-Sim and its peers read.

Phasors are e^{+iwt} as here. With `scaled` = 0 the tables are A/rho, B/(rho w), F/(rho g),
C/(rho g). Rows are those of the body that owns the group, columns of all bodies. Kernels and
state-space models in the file are not read: they follow from B.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.files import DAMAGED, damaged
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import six_of_each
from hydrodae.hdb.readers.source import SourceData, without_hydrostatics
from hydrodae.support.arrays import Array
from hydrodae.support.damaged import reading
from hydrodae.support.naming import names_file

#: Codes whose A_inf is an estimate of BEMIO: the mean over the lower part of its own grid.
ESTIMATED_BY_BEMIO = ("NEMOH", "CAPYTAINE")


def is_bemio_file(f: h5py.File) -> bool:
    """Return whether an open HDF5 file has the layout of BEMIO."""
    return "simulation_parameters" in f and "body1" in f


@names_file
def read_bemio(path: Path) -> SourceData:
    """Read a BEMIO file.

    Returns
    -------
    SourceData
        Moments are about `cg`, as WEC-Sim takes them.

    Raises
    ------
    DatabaseError
        Something is missing or has an unexpected shape; the message names file and dataset.
    """
    return reading(path, damaged, DAMAGED, lambda f: _read(path, f))


def _read(path: Path, f: h5py.File) -> SourceData:
    rho, gravity = _number(f, "rho"), _number(f, "g")
    omega = _array(f, "simulation_parameters/w").ravel()
    heading = np.radians(_array(f, "simulation_parameters/wave_dir").ravel())
    scaled = _number(f, "scaled") != 0.0
    groups = [f[name] for name in _bodies(f)]
    findings: list[Finding] = []
    counts = [int(_dof(g)) for g in groups]
    for g, n in zip(groups, counts, strict=True):
        if n < 6:
            raise DatabaseError(
                f"{g.name}/properties/dof is {n}; expected 6 or more, the rigid ones first"
            ).about("shape", "dof")
    total = sum(counts)
    raw = [_text(g["properties/name"][()]) if "properties/name" in g else g.name for g in groups]
    names = unique_names(raw)
    coordinates = [c for name, n in zip(names, counts, strict=True) for c in _coordinates(name, n)]
    if total > 6 * len(counts):
        text = f"{total - 6 * len(counts)} generalised modes: mode7 and so on of their bodies"
        findings.append(Finding("info", "coordinates", text))
    a, b, a_inf = [], [], []
    forces: dict[str, list[Array]] = {"": [], "froude-krylov/": [], "scattering/": []}
    for g, count in zip(groups, counts, strict=True):
        full = (count, total, omega.size)
        a.append(_table(g, "added_mass/all", full))
        b.append(_table(g, "radiation_damping/all", full))
        a_inf.append(_table(g, "added_mass/inf_freq", full[:2]))
        for key, found in forces.items():
            if f"hydro_coeffs/excitation/{key}re" not in g:
                continue
            parts = [
                _table(g, f"excitation/{key}{p}", (count, heading.size, omega.size))
                for p in ("re", "im")
            ]
            found.append(parts[0] + 1j * parts[1])
    order = np.argsort(omega)
    omega = omega[order]
    factor = 1.0 if scaled else rho
    code = _text(f["bem_data/code"][()]) if "bem_data/code" in f else "not stated"
    data = SourceData(
        coordinates=tuple(coordinates),
        omega=omega,
        added_mass=factor * np.concatenate(a).transpose(2, 0, 1)[order],
        radiation_damping=np.concatenate(b).transpose(2, 0, 1)[order],
        heading=heading,
        rho=rho,
        gravity=gravity,
        water_depth=_depth(f),
        name=path.name,
        title=f"BEMIO file {path.name}, computed by {code}",
        added_mass_inf=_added_mass_inf(factor * np.concatenate(a_inf), code, findings),
        files=[path],
        findings=findings,
    )
    if not scaled:
        data.radiation_damping *= rho * omega[:, None, None]
    force_scale = 1.0 if scaled else rho * gravity
    for key, field in (
        ("", "excitation"),
        ("froude-krylov/", "froude_krylov"),
        ("scattering/", "diffraction"),
    ):
        if len(forces[key]) == len(groups):
            value = force_scale * np.concatenate(forces[key]).transpose(2, 1, 0)[order]
            # BEMIO fills what the code behind it did not give with NaN
            setattr(data, field, None if np.isnan(value).all() else value)
    starts = np.r_[0, np.cumsum(counts)]
    for name, g, first, last in zip(names, groups, starts[:-1], starts[1:], strict=True):
        own = slice(int(first), int(last))
        _attach_body(data, name, g, 1.0 if scaled else rho * gravity, own, total)
    return data


def _coordinates(body: str, count: int) -> tuple[str, ...]:
    """Labels of a body with `count` degrees of freedom: the modes follow its rigid motions."""
    return (*six_of_each([body]), *(f"{body}.mode{m}" for m in range(7, count + 1)))


def _bodies(f: h5py.File) -> list[str]:
    found = sorted(
        (n for n in f if n.startswith("body") and n[4:].isdigit()), key=lambda n: int(n[4:])
    )
    if found != [f"body{i + 1}" for i in range(len(found))]:
        raise DatabaseError(f"expected groups body1, body2, ..., got {found}").about(
            "label", "bodies"
        )
    return found


def _added_mass_inf(value: Array, code: str, findings: list[Finding]) -> Array | None:
    """The value in the file, unless it is an estimate of BEMIO or absent (NaN)."""
    if not np.all(np.isfinite(value)):
        return None
    if code.upper().startswith(ESTIMATED_BY_BEMIO):
        text = f"inf_freq is BEMIO's own estimate for {code} and is not used"
        findings.append(Finding("info", "added_mass_inf of the source", text))
        return None
    return value


def _attach_body(
    data: SourceData, name: str, g: h5py.Group, scale: float, own: slice, total: int
) -> None:
    point = _vector(g, "properties/cg")
    data.reference_points[name] = point
    stiffness = "hydro_coeffs/linear_restoring_stiffness"
    k = None if stiffness not in g else scale * _stiffness(g, own, total)
    if own.stop - own.start > 6:
        if k is None or not np.all(np.isfinite(np.r_[k[6:].ravel(), k[:, 6:].ravel()])):
            raise DatabaseError(f"{g.name}/{stiffness} has no numbers for the modes").about(
                "missing", "linear_restoring_stiffness"
            )
        data.mode_stiffness[name] = np.nan_to_num(k)
    buoyancy = _vector(g, "properties/cb")
    volume = g["properties/disp_vol"][()].ravel() if "properties/disp_vol" in g else []
    if point is None or buoyancy is None or len(volume) != 1 or k is None:
        text = f"{name}: cg, cb, disp_vol or linear_restoring_stiffness is missing"
        data.findings.append(without_hydrostatics(text, [name]))
        return
    if not np.all(np.isfinite(k[:6, :6])) or not np.isfinite(volume[0]):
        data.findings.append(without_hydrostatics(f"{name}: holds NaN; left out", [name]))
        return
    data.add_statics(name, k[:6, :6], point, float(volume[0]), buoyancy)


def _stiffness(g: h5py.Group, own: slice, total: int) -> Array:
    """C of a body (n, n): of rigid bodies 6 rows and columns, with modes the columns of all."""
    count = own.stop - own.start
    if count == 6:
        return _array(g, "hydro_coeffs/linear_restoring_stiffness")[:6, :6]
    return _table(g, "linear_restoring_stiffness", (count, total))[:, own]


def _dof(g: h5py.Group) -> float:
    return float(g["properties/dof"][()].ravel()[0]) if "properties/dof" in g else 6.0


def _depth(f: h5py.File) -> float:
    """Water depth; a text ("infinite") stands for deep water."""
    name = "simulation_parameters/water_depth"
    value = f[name][()] if name in f else None
    if isinstance(value, bytes | str):
        if _text(value).strip().lower().startswith("inf"):
            return np.inf
        raise DatabaseError(f"water_depth {_text(value)!r}: expected metres or 'infinite'").about(
            "value", "depth"
        )
    return _number(f, "water_depth")


def _number(f: h5py.File, name: str) -> float:
    value = _array(f, f"simulation_parameters/{name}")
    if value.size != 1:
        raise DatabaseError(f"simulation_parameters/{name}: expected one number").about(
            "format", name
        )
    return float(value.ravel()[0])


def _array(group: h5py.Group, name: str) -> Array:
    if name not in group:
        raise DatabaseError(f"no dataset {group.name.rstrip('/')}/{name}").about("missing", name)
    try:
        return np.asarray(group[name][()], dtype=float)
    except (TypeError, ValueError) as error:
        raise DatabaseError(f"{group.name}/{name} does not hold numbers").about(
            "format", name
        ) from error


def _table(group: h5py.Group, name: str, shape: tuple[int, ...]) -> Array:
    value = _array(group, f"hydro_coeffs/{name}")
    if value.shape != shape:
        raise DatabaseError(
            f"{group.name}/hydro_coeffs/{name} has shape {value.shape}, expected {shape}"
        ).about("shape", name)
    return value


def _vector(group: h5py.Group, name: str) -> Array | None:
    if name not in group:
        return None
    value = _array(group, name).ravel()
    return value if value.shape == (3,) and np.all(np.isfinite(value)) else None


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        value = value.ravel()[0]
    return value.decode() if isinstance(value, bytes) else str(value)
