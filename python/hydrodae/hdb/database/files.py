"""`hydro.h5`: what preparation made, read by the solver and by Python."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.convolution import RadiationKernel
from hydrodae.hdb.database.extra import label_text, read_extra, write_extra
from hydrodae.hdb.database.layout import (
    BODY,
    BODY_NUMBERS,
    FIT,
    KERNEL,
    REAL,
    TABLES,
    Entry,
    read_group,
    read_numbers,
    refused,
    write_dataset,
)
from hydrodae.hdb.database.second_order_file import read_second_order, write_second_order
from hydrodae.hdb.database.tables import Body, Tables
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import bodies_of, modes_of
from hydrodae.support import outputs
from hydrodae.support.damaged import reading

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory

FORMAT = "hydrodae-hydro"
FORMAT_VERSION = 1
#: More than any table of a database holds; as in cpp/hydrodae/io/hdf5_input.cpp.
MOST_NUMBERS = 50_000_000
#: Attributes of fits and kernels that are shown, and how many numbers each has.
SHOWN = {
    "band": 2,
    "h_error_band": 1,
    "h_error_between": 1,
    "rest": 1,
    "min_eig_relative": 1,
    "n_states": 1,
}
DAMAGED = "incomplete or damaged"
ROOT_TEXT = ("source", "source_sha256", "generator", "title")


def damaged(path: Path, fault: str) -> DatabaseError:
    """Return the error about a file that the HDF5 library cannot read."""
    return DatabaseError(fault).about("damaged", file=path)


def holds_format(f: h5py.File) -> bool:
    """Return whether an open file is a `hydro.h5`."""
    return label_text(f.attrs.get("format", "")) == FORMAT


def is_single(path: str | Path) -> bool:
    """Return whether a `hydro.h5` stores its tables in single precision."""
    return reading(
        Path(path), damaged, DAMAGED, lambda f: bool(f["added_mass"].dtype == np.float32)
    )


def partial_file(target: Path, kind: str) -> Path:
    """Return the file that becomes `target` when it is complete; refuse one of another kind."""
    outputs.spare(target, kind)
    if not target.parent.is_dir():
        raise DatabaseError(f"cannot write {target}: no folder {target.parent}").about(
            "missing", "folder"
        )
    return target.with_name(target.name + ".part")


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
    partial = partial_file(target, outputs.DATABASE)
    with h5py.File(partial, "w") as f:
        _write_tables(f, database, kernel=kernel, single=single)
        _write_bodies(f, database)
        for name, fit in database.memory.items():
            _write_group(f.create_group(f"memory/{name}"), FIT, fit, {})
        if database.extra:
            write_extra(f.create_group("extra"), database.extra)
        if database.second_order:
            write_second_order(f.create_group("second_order"), database.second_order)
    os.replace(partial, target)


def read(path: str | Path) -> dict[str, Any]:
    """Read `hydro.h5`: the fields of `hydrodae.hdb.database.tables.Tables` by name.

    Raises
    ------
    DatabaseError
        Missing file, another format or a newer version, or something the format demands is absent.
    """
    source = Path(path)
    if not source.is_file():
        raise DatabaseError("no such file").about("missing", file=source)
    if not h5py.is_hdf5(source):
        raise DatabaseError("not an HDF5 file").about("format", file=source)
    return reading(source, damaged, DAMAGED, lambda f: _read_whole(source, f), search=True)


def _read_whole(source: Path, f: h5py.File) -> dict[str, Any]:
    if not holds_format(f):
        raise DatabaseError(f"not a {FORMAT} file; make one with 'hydrodae hdb import'").about(
            "format", file=source
        )
    if int(f.attrs.get("format_version", 0)) > FORMAT_VERSION:
        raise DatabaseError("written by a newer hydrodae (format_version)").about(
            "unsupported", "format_version", file=source
        )
    _refuse_oversized(source, f)
    return _read(f)


def _refuse_oversized(source: Path, f: h5py.File) -> None:
    """Before memory is asked for: a file may claim more than it holds."""

    def check(name: str, node: h5py.Group | h5py.Dataset) -> None:
        if isinstance(node, h5py.Dataset) and node.shape is not None and node.size > MOST_NUMBERS:
            raise DatabaseError(
                f"{name}: expected at most {MOST_NUMBERS:,} numbers, found shape {node.shape}"
            ).about("shape", name, file=source)

    f.visititems(check)


def _write_tables(f: h5py.File, db: Tables, *, kernel: bool, single: bool) -> None:
    f.attrs["format"] = FORMAT
    f.attrs["format_version"] = FORMAT_VERSION
    for name in ("rho", "gravity", "water_depth"):
        f.attrs[name] = float(getattr(db, name))
    for name in ROOT_TEXT:
        f.attrs[name] = str(getattr(db, name))
    f.attrs["repairs"] = "\n".join(db.repairs)
    for name, entry in TABLES.items():
        value = getattr(db, name.rpartition("/")[2])
        if not entry.kind.is_text and len(entry.dims) == 3:
            value = value.astype(entry.kind.number(single))
        write_dataset(f, name, entry, value)
    f["added_mass_inf"].attrs["origin"] = db.added_mass_inf_origin
    split = "froude_krylov + diffraction" if db.excitation_split else "total only"
    f["excitation"].attrs["split"] = split
    if kernel and db.kernel is not None:
        values: dict[str, Any] = {"kernel": db.kernel.values.astype(REAL.number(single))}
        _write_group(f.create_group("radiation_kernel"), KERNEL, db.kernel, values)


def _write_group(
    group: h5py.Group,
    layout: Mapping[str, Entry],
    source: RadiationKernel | ExponentialMemory,
    values: Mapping[str, Any],
) -> None:
    """Write a kernel or a fit: its datasets, `values` in place of those of its own, its report."""
    for name, entry in layout.items():
        write_dataset(group, name, entry, values[name] if name in values else getattr(source, name))
    for key, value in source.report.items():
        group.attrs[key] = value


def _write_bodies(f: h5py.File, db: Tables) -> None:
    for i, body in enumerate(db.bodies.values()):
        group = f.create_group(f"bodies/{body.name}")
        group.attrs["index"] = i
        group.attrs["reference_point"] = body.reference_point
        if body.column:
            group.attrs["column"] = True
        hs = body.hydrostatics
        if hs is not None:
            for name in Hydrostatics.__dataclass_fields__:
                group.attrs[name] = getattr(hs, name)
            stiffness = db.hydrostatic_stiffness(body.name)
            write_dataset(group, "hydrostatic_stiffness", BODY["hydrostatic_stiffness"], stiffness)
        if body.mode_stiffness is not None:
            write_dataset(group, "mode_stiffness", BODY["mode_stiffness"], body.mode_stiffness)
        if body.mesh is not None:  # to be looked at: seven digits will do
            write_dataset(group, "mesh", BODY["mesh"], body.mesh.astype(np.float32))
        if body.mode_shapes is not None:
            shapes = body.mode_shapes.astype(np.float32)
            write_dataset(group, "mode_shapes", BODY["mode_shapes"], shapes)


def _read(f: h5py.File) -> dict[str, Any]:
    values = read_group(f, TABLES)
    if missing := [name for name in TABLES if name not in values]:
        raise refused(f, missing[0], "missing", "missing dataset")
    values = {name.rpartition("/")[2]: value for name, value in values.items()}
    stored = f["radiation_kernel"] if "radiation_kernel" in f else None
    fits = f["memory"] if "memory" in f else {}
    texts: dict[str, Any] = {name: label_text(f.attrs.get(name, "")) for name in ROOT_TEXT}
    water = {name: read_numbers(f, name, ()) for name in ("rho", "gravity", "water_depth")}
    return dict(
        excitation_split=label_text(f["excitation"].attrs.get("split", "")) != "total only",
        bodies=_read_bodies(f, values["coordinates"]),
        added_mass_inf_origin=label_text(f["added_mass_inf"].attrs.get("origin", "")),
        kernel=None if stored is None else _read_kernel(stored),
        memory={name: _read_fit(name, fits[name]) for name in fits},
        extra=read_extra(f["extra"]) if "extra" in f else {},
        second_order=read_second_order(f["second_order"]) if "second_order" in f else {},
        repairs=tuple(label_text(f.attrs.get("repairs", "")).splitlines()),
        **texts,
        **water,
        **values,
    )


def _read_bodies(f: h5py.File, labels: Iterable[str]) -> dict[str, Body]:
    bodies = {}
    for name in sorted(
        bodies_of(labels), key=lambda b: int(read_numbers(f[f"bodies/{b}"], "index", ()))
    ):
        group = f[f"bodies/{name}"]
        known = "displaced_volume" in group.attrs
        numbers = {
            key: read_numbers(group, key, shape)
            for key, shape in BODY_NUMBERS.items()
            if known or key == "reference_point"
        }
        point = numbers.pop("reference_point")
        tables = read_group(group, BODY)
        shapes, modes = tables.get("mode_shapes"), len(modes_of(name, labels))
        if shapes is not None and (len(shapes) != modes or "mesh" not in tables):
            fault = f"expected {modes} modes at the corners of a mesh, found {len(shapes)} modes"
            raise refused(group, "mode_shapes", "shape", fault)
        bodies[name] = Body(
            name,
            point,
            Hydrostatics(**numbers) if known else None,
            tables.get("mesh"),
            tables.get("mode_stiffness"),
            bool(group.attrs.get("column", False)),
            shapes,
        )
    return bodies


def _whole(group: h5py.Group, layout: Mapping[str, Entry]) -> dict[str, Any]:
    """All datasets of a kernel or a fit, and its report."""
    values = read_group(group, layout)
    if missing := [name for name in layout if name not in values]:
        raise refused(group, missing[0], "missing", "missing dataset")
    return {**values, "report": _report(group)}


def _read_kernel(group: h5py.Group) -> RadiationKernel:
    values = _whole(group, KERNEL)
    time = values["time"]
    if time.size < 8 or not np.allclose(time, np.linspace(0.0, time[-1], time.size), atol=1e-9):
        raise refused(group, "time", "shape", "expected 8 times or more, equally spaced from 0 s")
    return RadiationKernel(values=values.pop("kernel"), **values)


def _read_fit(name: str, group: h5py.Group) -> ExponentialMemory:
    from hydrodae.hdb.memory import ExponentialMemory

    return ExponentialMemory(name=name, **_whole(group, FIT))


def _report(group: h5py.Group) -> dict[str, Any]:
    """How a fit or a kernel was made; what is shown as numbers must be numbers."""
    report = {key: _plain(value) for key, value in group.attrs.items()}
    for key, count in SHOWN.items():
        value = report.get(key, (0.0,) * count)
        values = value if isinstance(value, tuple) else (value,)
        if len(values) != count or not all(isinstance(v, int | float) for v in values):
            raise DatabaseError(
                f"{group.name}: attribute {key} is {value!r}, expected "
                f"{count} number{'s' if count > 1 else ''}"
            ).about("shape", key, file=group.file.filename)
    return report


def _plain(value: Any) -> Any:
    """Python value of an attribute: scalars, and tuples for arrays."""
    if isinstance(value, h5py.Empty):
        return ()
    if isinstance(value, np.ndarray):
        return tuple(_plain(v) for v in value.tolist())
    if isinstance(value, bytes):
        return value.decode()
    return value.item() if isinstance(value, np.generic) else value
