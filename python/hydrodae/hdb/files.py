"""`hydro.h5`: what preparation made, read by the solver and by Python."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from hydrodae import outputs
from hydrodae.damaged import opened
from hydrodae.errors import DatabaseError
from hydrodae.hdb import coordinates as co
from hydrodae.hdb.convolution import RadiationKernel
from hydrodae.hdb.extra import read_extra, write_extra
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.tables import Body, Tables

if TYPE_CHECKING:
    from hydrodae.memory import ExponentialMemory

FORMAT = "hydrodae-hydro"
FORMAT_VERSION = 1
#: More than any table of a database holds; as in cpp/hydrodae/io/hdf5_input.cpp.
MOST_NUMBERS = 50_000_000
UNITS = {
    "omega": "rad/s",
    "added_mass": "kg, kg m, kg m2",
    "radiation_damping": "N s/m, N s, N m s",
    "added_mass_inf": "kg, kg m, kg m2",
    "added_mass_inf_std": "kg, kg m, kg m2",
    "heading": "rad",
}
#: Attributes of fits and kernels that are shown, and how many numbers each has.
SHOWN = {"band": 2, "h_error_band": 1, "rest": 1, "min_eig_relative": 1, "n_states": 1}
DAMAGED = "incomplete or damaged"
ROOT_TEXT = ("source", "source_sha256", "generator", "title")


def is_hydro_file(path: Path) -> bool:
    """Tell whether a file is a `hydro.h5` (by its root attribute)."""
    if not h5py.is_hdf5(path):
        return False
    with opened(path, DatabaseError, DAMAGED, search=True) as f:
        return bool(_text(f.attrs.get("format", "")) == FORMAT)


def is_single(path: str | Path) -> bool:
    """Tell whether a `hydro.h5` stores its tables in single precision."""
    with opened(Path(path), DatabaseError, DAMAGED) as f:
        return bool(f["added_mass"].dtype == np.float32)


def write(database: Tables, path: str | Path, *, kernel: bool = True, single: bool = False) -> None:
    """Write a database to `hydro.h5`; an existing file is replaced only by a complete one.

    Parameters
    ----------
    database : Tables
        What to write.
    path : path
        Target file.
    kernel : bool
        Also write the radiation kernel, if there is one (large).
    single : bool
        Store the tables of A, B, F and K in single precision (7 digits; half the size). Added mass
        at infinity, hydrostatics and fits always stay in double precision.

    Raises
    ------
    DatabaseError
        A body has no reference point (the file format demands it).
    CaseError
        A file of another kind is there.
    """
    for name in database.bodies:
        database.reference_point(name)
    target = Path(path)
    outputs.spare(target, outputs.DATABASE)
    if not target.parent.is_dir():
        raise DatabaseError(f"cannot write {target}: no folder {target.parent}")
    partial = target.with_name(target.name + ".part")
    with h5py.File(partial, "w") as f:
        _write_tables(f, database, kernel=kernel, single=single)
        _write_bodies(f, database)
        for name, fit in database.memory.items():
            _write_fit(f.create_group(f"memory/{name}"), fit)
        if database.extra:
            write_extra(f.create_group("extra"), database.extra)
    os.replace(partial, target)


def read(path: str | Path) -> dict[str, Any]:
    """Read `hydro.h5`: the fields of `hydrodae.hdb.tables.Tables` by name.

    Raises
    ------
    DatabaseError
        Missing file, another format or a newer version, or something the format demands is absent.
    """
    source = Path(path)
    if not source.is_file():
        raise DatabaseError(f"{source}: no such file")
    if not h5py.is_hdf5(source):
        raise DatabaseError(f"{source}: not an HDF5 file")
    with opened(source, DatabaseError, DAMAGED, search=True) as f:
        if _text(f.attrs.get("format", "")) != FORMAT:
            raise DatabaseError(
                f"{source}: not a {FORMAT} file; make one with 'hydrodae hdb import'"
            )
        if int(f.attrs.get("format_version", 0)) > FORMAT_VERSION:
            raise DatabaseError(f"{source}: written by a newer hydrodae (format_version)")
        _refuse_oversized(source, f)
        return _read(f)


def _refuse_oversized(source: Path, f: h5py.File) -> None:
    """Before memory is asked for: a file may claim more than it holds."""

    def check(name: str, node: h5py.Group | h5py.Dataset) -> None:
        if isinstance(node, h5py.Dataset) and node.shape is not None and node.size > MOST_NUMBERS:
            raise DatabaseError(
                f"{source}: {name}: expected at most {MOST_NUMBERS:,} numbers, found shape "
                f"{node.shape}"
            )

    f.visititems(check)


def _write_tables(f: h5py.File, db: Tables, *, kernel: bool, single: bool) -> None:
    f.attrs["format"] = FORMAT
    f.attrs["format_version"] = FORMAT_VERSION
    for name in ("rho", "gravity", "water_depth"):
        f.attrs[name] = float(getattr(db, name))
    for name in ROOT_TEXT:
        f.attrs[name] = str(getattr(db, name))
    f.attrs["repairs"] = "\n".join(db.repairs)
    f.create_dataset("coordinates", data=_labels(db.coordinates))
    real, cplx = (np.float32, np.complex64) if single else (np.float64, np.complex128)
    for name, unit in UNITS.items():
        table = name in ("added_mass", "radiation_damping")
        value = getattr(db, name).astype(real) if table else getattr(db, name)
        _dataset(f, name, value, unit)
    f["added_mass_inf"].attrs["origin"] = db.added_mass_inf_origin
    group = f.create_group("excitation")
    group.attrs["split"] = "froude_krylov + diffraction" if db.excitation_split else "total only"
    for name in ("froude_krylov", "diffraction"):
        _dataset(group, name, getattr(db, name).astype(cplx), "N/m, N m/m")
    if kernel and db.kernel is not None:
        _write_kernel(f.create_group("radiation_kernel"), db.kernel, real)


def _write_kernel(group: h5py.Group, kernel: RadiationKernel, real: type) -> None:
    group.create_dataset("inputs", data=_labels(kernel.inputs))
    group.create_dataset("outputs", data=_labels(kernel.outputs))
    _dataset(group, "time", kernel.time, "s")
    _dataset(group, "kernel", kernel.values.astype(real), "N/m, N, N m")
    _dataset(group, "added_mass_inf", kernel.added_mass_inf, "kg, kg m, kg m2")
    for key, value in kernel.report.items():
        group.attrs[key] = value


def _read_kernel(group: h5py.Group) -> RadiationKernel:
    return RadiationKernel(
        time=_numbers(group, "time"),
        values=_numbers(group, "kernel"),
        inputs=_read_labels(group["inputs"]),
        outputs=_read_labels(group["outputs"]),
        added_mass_inf=_numbers(group, "added_mass_inf"),
        report=_report(group),
    )


def _write_bodies(f: h5py.File, db: Tables) -> None:
    for i, body in enumerate(db.bodies.values()):
        group = f.create_group(f"bodies/{body.name}")
        group.attrs["index"] = i
        group.attrs["reference_point"] = body.reference_point
        hs = body.hydrostatics
        if hs is not None:
            for name in Hydrostatics.__dataclass_fields__:
                group.attrs[name] = getattr(hs, name)
            stiffness = db.hydrostatic_stiffness(body.name)
            _dataset(group, "hydrostatic_stiffness", stiffness, "N/m, N, N m")
        if body.mesh is not None:  # to be looked at: seven digits will do
            _dataset(group, "mesh", body.mesh.astype(np.float32), "m")


def _write_fit(group: h5py.Group, fit: ExponentialMemory) -> None:
    group.create_dataset("inputs", data=_labels(fit.inputs))
    group.create_dataset("outputs", data=_labels(fit.outputs))
    for name in ("poles", "input_matrix", "output_matrix"):
        group.create_dataset(name, data=np.asarray(getattr(fit, name), dtype=np.complex128))
    _dataset(group, "added_mass_inf", np.asarray(fit.added_mass_inf, float), "kg, kg m, kg m2")
    for key, value in fit.report.items():
        group.attrs[key] = value


def _read(f: h5py.File) -> dict[str, Any]:
    coordinates = _read_labels(f["coordinates"])
    stored = f["radiation_kernel"] if "radiation_kernel" in f else None
    fits = f["memory"] if "memory" in f else {}
    texts: dict[str, Any] = {name: _text(f.attrs.get(name, "")) for name in ROOT_TEXT}
    values: dict[str, Any] = {name: _numbers(f, name) for name in UNITS}
    return dict(
        coordinates=coordinates,
        froude_krylov=_numbers(f, "excitation/froude_krylov", complex),
        diffraction=_numbers(f, "excitation/diffraction", complex),
        excitation_split=_text(f["excitation"].attrs.get("split", "")) != "total only",
        bodies=_read_bodies(f, co.bodies_of(coordinates)),
        rho=float(f.attrs["rho"]),
        gravity=float(f.attrs["gravity"]),
        water_depth=float(f.attrs["water_depth"]),
        added_mass_inf_origin=_text(f["added_mass_inf"].attrs.get("origin", "")),
        kernel=None if stored is None else _read_kernel(stored),
        memory={name: _read_fit(name, fits[name]) for name in fits},
        extra=read_extra(f["extra"]) if "extra" in f else {},
        repairs=tuple(_text(f.attrs.get("repairs", "")).splitlines()),
        **texts,
        **values,
    )


def _read_bodies(f: h5py.File, names: Iterable[str]) -> dict[str, Body]:
    bodies = {}
    for name in sorted(names, key=lambda b: int(f[f"bodies/{b}"].attrs["index"])):
        attrs = f[f"bodies/{name}"].attrs
        hydrostatics = None
        if "displaced_volume" in attrs:
            hydrostatics = Hydrostatics(
                float(attrs["displaced_volume"]),
                attrs["center_of_buoyancy"],
                float(attrs["waterplane_area"]),
                attrs["waterplane_moments"],
            )
        mesh = f"bodies/{name}/mesh"
        panels = _numbers(f, mesh) if mesh in f else None
        bodies[name] = Body(name, attrs["reference_point"], hydrostatics, panels)
    return bodies


def _read_fit(name: str, group: h5py.Group) -> ExponentialMemory:
    from hydrodae.memory import ExponentialMemory

    return ExponentialMemory(
        name=name,
        inputs=_read_labels(group["inputs"]),
        outputs=_read_labels(group["outputs"]),
        poles=_numbers(group, "poles", complex),
        input_matrix=_numbers(group, "input_matrix", complex),
        output_matrix=_numbers(group, "output_matrix", complex),
        added_mass_inf=_numbers(group, "added_mass_inf"),
        report=_report(group),
    )


def _dataset(group: h5py.Group, name: str, value: Any, unit: str) -> None:
    options = {"compression": "gzip", "shuffle": True} if np.size(value) > 64 else {}
    group.create_dataset(name, data=value, **options).attrs["unit"] = unit


def _labels(labels: Iterable[str]) -> np.ndarray[Any, Any]:
    labels = list(labels)
    long = [label for label in labels if len(label.encode("ascii", "replace")) > 32]
    if long:
        raise DatabaseError(f"label {long[0]!r} is longer than 32 characters: rename the body")
    return np.array(labels, dtype="S32")


def _numbers(group: h5py.Group, name: str, kind: type = float) -> np.ndarray[Any, Any]:
    """Finite numbers of a dataset, as float or complex."""
    values = np.asarray(group[name][()])
    where = f"{group.file.filename}: {group.name.rstrip('/')}/{name}"
    if values.dtype.kind not in ("fiu" if kind is float else "fiuc"):
        raise DatabaseError(f"{where}: expected numbers, found {values.dtype}")
    if not np.all(np.isfinite(values)):
        raise DatabaseError(f"{where}: holds values that are not finite")
    return values.astype(kind)


def _report(group: h5py.Group) -> dict[str, Any]:
    """How a fit or a kernel was made; what is shown as numbers must be numbers."""
    report = {key: _plain(value) for key, value in group.attrs.items()}
    for key, count in SHOWN.items():
        value = report.get(key, (0.0,) * count)
        values = value if isinstance(value, tuple) else (value,)
        if len(values) != count or not all(isinstance(v, int | float) for v in values):
            raise DatabaseError(
                f"{group.file.filename}: {group.name}: attribute {key} is {value!r}, expected "
                f"{count} number{'s' if count > 1 else ''}"
            )
    return report


def _read_labels(dataset: h5py.Dataset) -> tuple[str, ...]:
    return tuple(label.decode("ascii") for label in dataset[()])


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _plain(value: Any) -> Any:
    """Python value of an attribute: scalars, and tuples for arrays."""
    if isinstance(value, h5py.Empty):
        return ()
    if isinstance(value, np.ndarray):
        return tuple(_plain(v) for v in value.tolist())
    if isinstance(value, bytes):
        return value.decode()
    return value.item() if isinstance(value, np.generic) else value
