"""Mean drift that a file of Capytaine 3 holds beside A, B and F.

Far field: `drift_force_surge`, `_sway`, `_yaw` of all bodies together, moments about the origin of
the world, or `drift_force` over `influenced_dof`. Near field: `near_field_mean_drift_force`. Both
are over amplitudes, complex for pairs of headings, with phasors e^{-iwt}: conjugated here.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import OF_ALL_BODIES
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.quadratic import Entries, of_coordinates
from hydrodae.hdb.readers.setting import Setting
from hydrodae.support.arrays import Array, Complex

#: Words of a name that say how the load was computed.
METHODS = {"near_field": "pressure", "drift_force": "momentum"}
FIRST, SECOND = ("wave_direction", "wave_direction_k"), "wave_direction_l"


def read(
    path: Path, extra: Mapping[str, SourceTable], setting: Setting, findings: list[Finding]
) -> list[Entries]:
    """Return what the tables of a file say of mean drift.

    Raises
    ------
    DatabaseError
        Dimensions that are unknown.
    """
    found = []
    for name, table in extra.items():
        method = next((m for word, m in METHODS.items() if word in name), None)
        if method is None:
            continue
        if method in OF_ALL_BODIES and len(setting.bodies) > 1:
            text = f"{name} is the sum over {len(setting.bodies)} bodies: kept as the source has it"
            findings.append(Finding("info", "second order", text))
            continue
        found.append(_entries(path, name, method, table, setting))
    return found


def _entries(path: Path, name: str, method: str, table: SourceTable, setting: Setting) -> Entries:
    omega, first, second, dofs, values = _ordered(path, name, table)
    labels = [_label(path, name, dof, setting) for dof in dofs]
    w, k, m = np.indices(values.shape[:3]).reshape(3, -1)
    kept = np.isfinite(omega[w]) & (omega[w] > 0.0)
    heading = np.column_stack([first[k], first[k] if second is None else second[m]])
    loads = values.conj().reshape(-1, len(labels))[kept]
    return of_coordinates(
        path,
        ("mean", method),
        (omega[w[kept]], heading[kept]),
        labels,
        loads,
        about_origin=method in OF_ALL_BODIES,
    )


def _ordered(
    path: Path, name: str, table: SourceTable
) -> tuple[Array, Array, Array | None, list[str], Complex]:
    """Return frequencies, headings of both waves, motions, and loads (w, k, l, dof)."""
    dims = list(table.dims)
    one = next((d for d in FIRST if d in dims), "")
    known = ["omega", one, SECOND, "influenced_dof"]
    if "omega" not in dims or not one or set(dims) - set(known):
        raise DatabaseError(
            f"{name}: dimensions {', '.join(dims)}; expected omega, wave_direction or "
            f"wave_direction_k and _l, influenced_dof"
        ).about("shape", name, file=path)
    wanted = [d for d in known if d in dims]
    values = np.asarray(table.values, dtype=complex).transpose([dims.index(d) for d in wanted])
    for place, dim in enumerate(known):
        if dim not in dims:
            values = np.expand_dims(values, place)
    dofs = table.axes.get("influenced_dof", (name.rpartition("_")[2],))
    second = np.asarray(table.axes[SECOND]) if SECOND in dims else None
    return (
        np.asarray(table.axes["omega"], dtype=float),
        np.asarray(table.axes[one], dtype=float),
        second,
        [str(d) for d in dofs],
        values,
    )


def _label(path: Path, name: str, dof: str, setting: Setting) -> str:
    body, _, motion = dof.rpartition("__")
    owner = body if body in setting.bodies else setting.bodies[0]
    if motion.lower() not in DOFS or (body not in setting.bodies and len(setting.bodies) > 1):
        raise DatabaseError(f"{name}: {dof!r} is no motion of {', '.join(setting.bodies)}").about(
            "label", name, file=path
        )
    return f"{owner}.{motion.lower()}"
