"""Drift of a scene as a table of second order, and what the table says it was made for."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

import numpy as np

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.second_order import OF_SCENE, SecondOrderTable
from hydrodae.linear import LinearModel
from hydrodae.study.drift.far_field import Drift
from hydrodae.support import outputs

#: Motions that the far field has loads of.
MOTIONS = ("surge", "sway", "yaw")
#: Tables of a case that do not change its motion in regular waves. Of `hydro` only `axes` counts:
#: the run of a table has another file, and may have another fit.
APART = ("title", "wave", "gauge", "solver", "output", "second_order", "missing")


def scene_digest(case: Case) -> str:
    """Return 16 hexadecimal digits of what decides the drift of a case.

    They are of its tables, without waves, gauges, solver and output, and without the names of
    database and fit. Keys that are not written, and files that the case names, do not count.
    """
    tables = {key: value for key, value in case_tables(case).items() if key not in APART}
    tables["hydro"] = {"axes": tables.get("hydro", {}).get("axes")}
    if "sea" in tables:
        tables["sea"] = {key: v for key, v in tables["sea"].items() if key not in ("ramp", "phase")}
    text = json.dumps(tables, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def source_of(model: LinearModel, carrier: str) -> str:
    """Return what a table of this case is of: scene, power take-offs, place of the loads."""
    parts = []
    for d in model.dampers:
        parts.append(f"{d.name} c={d.damping:.6g} k={d.stiffness:.6g}")
    for each in model.rotary:
        parts.append(f"{each.name} c={','.join(f'{c:.6g}' for c in each.damping)}")
    name = "" if model.case.path is None else f" {model.case.path.name}"
    return (
        f"{OF_SCENE} of case{name}, scene {scene_digest(model.case)}, dampers "
        f"[{'; '.join(parts)}], loads of all bodies on {carrier}"
    )


def second_order_table(found: Drift, model: LinearModel) -> SecondOrderTable:
    """Return the drift as a table of kind "mean": of each body, all of it on the carrier.

    Raises
    ------
    DatabaseError
        The database has neither surge, sway nor yaw of the carrier.
    """
    database = model.database
    assert database is not None  # a drift has one
    known = database.coordinates
    labels = [f"{body}.{m}" for body in database.bodies for m in MOTIONS]
    labels = [label for label in labels if label in known]
    if not any(label.startswith(f"{found.carrier.hydro}.") for label in labels):
        raise DatabaseError(
            f"the database has neither surge, sway nor yaw of {found.carrier.hydro}: compute it "
            f"with all six motions"
        ).about("missing", found.carrier.hydro)
    values = np.zeros((found.omega.size, len(found.pairs), len(labels)), dtype=complex)
    for column, motion in enumerate(MOTIONS):
        label = f"{found.carrier.hydro}.{motion}"
        if label in labels:
            values[:, :, labels.index(label)] = found.load[:, :, column]
    first, second = (found.heading[column] for column in found.pairs.T)
    return SecondOrderTable(
        kind="mean",
        coordinates=tuple(labels),
        method=("momentum",) * len(labels),
        omega=found.omega,
        heading1=first,
        heading2=second,
        values=values,
        computed=np.ones(values.shape, dtype=bool),
        source=source_of(model, found.carrier.hydro),
    )


def write_database(path: str | os.PathLike[str], found: Drift, model: LinearModel) -> Path:
    """Write a copy of the database of a case with this drift as its table of kind "mean".

    Raises
    ------
    CaseError
        The path is that of the database itself, or of a file of another kind.
    DatabaseError
        The database lacks the coordinates of the table.
    """
    source = model.case.scene.database_path
    target = outputs.claim(path, outputs.DATABASE)
    if Path(source).resolve() == target.resolve():
        raise CaseError(f"{target}: is the database of the case; name another file")
    table = second_order_table(found, model)
    HydroDatabase.read(source).with_second_order({"mean": table}).write(target)
    return target
