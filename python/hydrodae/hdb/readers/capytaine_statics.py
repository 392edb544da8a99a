"""Bodies in netCDF files of Capytaine: reference points and hydrostatics."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from hydrodae.hdb.database.extra import label_text
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import DOFS, bodies_of
from hydrodae.hdb.readers import nemoh_hydrostatics as nh
from hydrodae.hdb.readers.reference import assume_by_statics
from hydrodae.hdb.readers.source import SourceData, without_hydrostatics
from hydrodae.support.arrays import Array


def attach_bodies(data: SourceData, ds: xr.Dataset, raw: list[str], path: Path) -> None:
    """Reference points and hydrostatics, from the file or from Nemoh-like files beside it."""
    names = bodies_of(data.coordinates)
    beside: list[nh.FileHydrostatics | None] = [None] * len(names)
    if "center_of_buoyancy" not in ds:
        beside, findings = nh.read_all(path.parent, len(names), data.rho, data.gravity)
        data.findings += findings
    for i, name in enumerate(names):
        own = zip(raw, data.labels, strict=True)
        prefix = next(dof for dof, label in own if label.body == name).rpartition("__")[0]
        point = _vector(ds, "rotation_center", prefix, i)
        data.reference_points[name] = point
        rigid = [d for d in raw if is_rigid(d)]
        if len(rigid) < len(raw):
            _add_modes(data, ds, raw, prefix, name)
        turns = any(label.body == name and label.is_rotation for label in data.labels)
        about = point if point is not None or turns else np.zeros(3)  # forces know no point
        statics = partial(_hydrostatics, data, ds, rigid, prefix, i)
        hs = _lacking(ds, prefix, i) if about is None else statics(about)
        near = beside[i]
        if isinstance(hs, Hydrostatics) and about is not None:
            data.hydrostatics[name] = (hs, about)
        elif not hs:
            data.statics_about[name] = statics  # its point is stated later, or the import ends
        elif near is not None:
            data.hydrostatics[name] = (near.hydrostatics, near.center_of_gravity)
            data.files += near.files
            said = f"{name}: taken from {near.files[0].name} beside it"
            data.findings.append(Finding("info", "hydrostatics", said))
            if point is None:
                assume_by_statics(data, name, near)
        else:
            text = f"{name}: the file lacks its {hs}"
            data.findings.append(without_hydrostatics(text, [name]))


def is_rigid(dof: str) -> bool:
    """Return whether a degree of freedom of a file is a rigid motion."""
    return dof.rpartition("__")[2].lower() in DOFS


def mode_name(word: str) -> str:
    """Name of the mode that an own degree of freedom becomes: letters, digits, _ and - only."""
    return re.sub(r"[^A-Za-z0-9_-]", "_", word)


def with_stiffness(ds: xr.Dataset, rigid: list[str]) -> list[str]:
    """Return the degrees of freedom, not rigid, of bodies of the file, with their stiffness.

    A file's bodies are those that move as rigid ones, those it lists, or without a list all.
    """
    name = "hydrostatic_stiffness"
    if name not in ds or set(ds[name].dims) != {"influenced_dof", "radiating_dof"}:
        return []
    own = [d for d in map(label_text, ds[name]["influenced_dof"].values) if not is_rigid(d)]
    if "body" in ds.dims:
        bodies = {d.rpartition("__")[0] for d in rigid} | set(map(label_text, ds["body"].values))
        own = [d for d in own if d.rpartition("__")[0] in bodies]
    loads = {d: ds[name].sel(influenced_dof=d, radiating_dof=d).values for d in own}
    return [d for d, value in loads.items() if np.isfinite(value)]


def _add_modes(data: SourceData, ds: xr.Dataset, raw: list[str], prefix: str, name: str) -> None:
    """Stiffness (6 + m, 6 + m) over the rigid motions and the m modes of a body; rows are loads."""
    mine = [d for d in raw if d.rpartition("__")[0] == prefix]
    modes = [d for d in mine if not is_rigid(d)]
    if not modes:
        return
    going = [d for d in mine if is_rigid(d)]
    index = [DOFS.index(d.rpartition("__")[2].lower()) for d in going]
    index += range(6, 6 + len(modes))
    order = [*going, *modes]
    block = ds["hydrostatic_stiffness"].sel(influenced_dof=order, radiating_dof=order)
    k = np.zeros((6 + len(modes), 6 + len(modes)))
    k[np.ix_(index, index)] = np.nan_to_num(
        block.transpose("influenced_dof", "radiating_dof").values
    )
    data.mode_stiffness[name] = k


def _hydrostatics(
    data: SourceData, ds: xr.Dataset, raw: list[str], prefix: str, i: int, point: Array
) -> Hydrostatics | str:
    """Waterplane from hydrostatic_stiffness about a point, the rotation centre, [m].

    Capytaine's rotational terms hold the weight too: - m g (z_G - z_c) in K44 and K55, with
    m = rho V unless the body was given another mass (then it is inertia_matrix[surge, surge]).
    Those of motions that it does not know as rigid do not; nor has it an inertia of these.

    Returns
    -------
    Hydrostatics or str
        Else what the file lacks.
    """
    buoyancy = _vector(ds, "center_of_buoyancy", prefix, i)
    if (lost := _lacking(ds, prefix, i)) or buoyancy is None:
        return lost
    volume = float(_pick(ds["disp_mass"], prefix, i, vector=False)) / data.rho
    present = [d for d in raw if d.rpartition("__")[0] == prefix]
    index = [DOFS.index(d.rpartition("__")[2].lower()) for d in present]
    block = ds["hydrostatic_stiffness"].sel(influenced_dof=present, radiating_dof=present)
    if set(block.dims) != {"influenced_dof", "radiating_dof"} or not np.isfinite(volume):
        return "hydrostatic_stiffness and disp_mass of one case"
    k = np.zeros((6, 6))
    k[np.ix_(index, index)] = block.transpose("influenced_dof", "radiating_dof").values
    k[[0, 1, 5]], k[:, [0, 1, 5]] = 0.0, 0.0  # still water is the same everywhere
    turning = [d for d in (3, 4) if d in index]
    center = _vector(ds, "center_of_mass", prefix, i)
    labels = dict(zip(index, present, strict=True))
    heavy = [d for d in turning if "inertia_matrix" not in ds or has_inertia(ds, labels[d])]
    if heavy and center is not None and not np.allclose(center, point):
        mass = _mass(data, ds, labels, prefix, volume)
        k[heavy, heavy] += mass * data.gravity * (center[2] - point[2])
    # of motions that are not in the file the waterplane has no moments, the volume has its lever
    for other in {3, 4} - set(turning):
        k[other, other] = data.rho * data.gravity * volume * (buoyancy[2] - point[2])
    if not np.all(np.isfinite(k)):
        bad = [d for d, at in zip(present, index, strict=True) if not np.isfinite(k[at]).all()]
        return f"hydrostatic_stiffness of {', '.join(bad)} (NaN)"
    left = [DOFS[other] for other in (2, 3, 4) if other not in index]
    if left:
        said = f"of {prefix or 'the body'} without {', '.join(left)}, which the file does not hold"
        data.findings.append(Finding("info", "hydrostatics", said))
    return Hydrostatics.from_stiffness(k, point, volume, buoyancy, data.rho, data.gravity)


def _lacking(ds: xr.Dataset, prefix: str, i: int) -> str:
    """Name what a file lacks of the hydrostatics of a body; "" where it has all."""
    needed = ("hydrostatic_stiffness", "center_of_buoyancy", "disp_mass")
    lost = [name for name in needed if name not in ds]
    if not lost and _vector(ds, "center_of_buoyancy", prefix, i) is None:
        lost = ["center_of_buoyancy"]
    return ", ".join(lost)


def _inertia(ds: xr.Dataset, dof: str) -> float:
    return float(ds["inertia_matrix"].sel(influenced_dof=dof, radiating_dof=dof))


def has_inertia(ds: xr.Dataset, dof: str) -> bool:
    """Return whether the file has the inertia of a motion: of itself Capytaine has rigid ones."""
    return "inertia_matrix" in ds and bool(np.isfinite(_inertia(ds, dof)))


def _mass(
    data: SourceData, ds: xr.Dataset, labels: dict[int, str], prefix: str, volume: float
) -> float:
    """Mass of a body [kg] in its stiffness: its inertia along a motion of `labels`.

    Where the file has none it is that of the displaced water, which Capytaine takes by itself.
    """
    displaced = data.rho * volume
    if "inertia_matrix" not in ds:
        return displaced
    for label in (labels[i] for i in range(3) if i in labels):
        mass = _inertia(ds, label)
        if np.isfinite(mass):
            return mass
    said = (
        f"{prefix or 'the body'}: no mass in the file; its hydrostatic_stiffness is taken to hold "
        f"the weight of the displaced water, {displaced:.4g} kg, as Capytaine does by itself"
    )
    data.findings.append(Finding("info", "assumption", said))
    return displaced


def _pick(variable: xr.DataArray, prefix: str, i: int, *, vector: bool) -> Any:
    """Entry of a body in a variable; all dimensions but the last one of vectors are over bodies."""
    for dim in variable.dims[:-1] if vector else variable.dims:
        labels = [label_text(v) for v in variable[dim].values] if dim in variable.coords else []
        variable = variable.isel({dim: labels.index(prefix) if prefix in labels else i})
    return variable.values


def _vector(ds: xr.Dataset, name: str, prefix: str, i: int) -> Array | None:
    if name not in ds:
        return None
    value = np.asarray(_pick(ds[name], prefix, i, vector=True), dtype=float)
    return value if value.shape == (3,) and np.all(np.isfinite(value)) else None
