"""Far-field drift of the bodies of a database: held fixed, and free to surge, sway and heave.

A database holds no inertia, so the free bodies have the masses that they displace and are held in
rotation. Their drift needs the Kochin functions that `hdb compute --kochin` or Capytaine kept.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.relations.far_field import horizontal_drift
from hydrodae.support.arrays import Array, Complex

#: Frequencies [rad/s], headings [rad], drift (nw, nh, 2) [N/m2].
FarField = tuple[Array, Array, Array]
GOING = ("surge", "sway", "heave")


def far_fields(database: HydroDatabase) -> dict[str, FarField | None]:
    """Return the drift of the "fixed" and the "free" bodies; None where it cannot be made."""
    waves = _diffracted(database)
    if waves is None:
        return {"fixed": None, "free": None}
    omega, heading, kochin = waves
    water = (database.rho, database.gravity, database.water_depth)
    fixed = omega, heading, horizontal_drift(kochin, heading, omega, *water)
    radiated = _radiated(database, omega, heading)
    if radiated is None:
        return {"fixed": fixed, "free": None}
    free = omega, heading, horizontal_drift(kochin + radiated, heading, omega, *water)
    return {"fixed": fixed, "free": free}


def free_motions(database: HydroDatabase) -> tuple[list[str], Complex] | None:
    """Return coordinates and motions (nw, nh, n) [m/m], e^{+iwt}, of free bodies that do not turn.

    None if a body lacks hydrostatics.
    """
    labels = [c for c in database.coordinates if c.rpartition(".")[2] in GOING]
    statics = [database.bodies[c.rpartition(".")[0]].hydrostatics for c in labels]
    if not labels or any(s is None for s in statics):
        return None
    part = database.select(labels)
    mass = np.diag([database.rho * s.displaced_volume for s in statics if s is not None])
    stiffness = np.diag(
        [
            database.rho * database.gravity * s.waterplane_area if c.endswith("heave") else 0.0
            for c, s in zip(labels, statics, strict=True)
            if s is not None
        ]
    )
    w = part.omega[:, None, None]
    dynamic = stiffness - w**2 * (mass + part.added_mass) + 1j * w * part.radiation_damping
    motions = np.linalg.solve(dynamic, part.excitation.transpose(0, 2, 1))
    return labels, np.asarray(motions.transpose(0, 2, 1), dtype=complex)


def _diffracted(database: HydroDatabase) -> tuple[Array, Array, Complex] | None:
    """Return frequencies, headings and H (nw, nh, nt) of the fixed bodies, as far as F goes."""
    table = database.extra.get("kochin_diffraction")
    if table is None or not _all_round(table):
        return None
    if any(name not in table.axes for name in ("omega", "wave_direction")):
        return None
    values = _ordered(table, ("omega", "wave_direction", "theta"))
    omega, heading = (np.asarray(table.axes[n], float) for n in ("omega", "wave_direction"))
    rows = _rows(omega, database.omega)
    if values is None or rows is None:
        return None
    usable = np.isfinite(values[rows]).all(axis=(1, 2))
    if not usable.all() or heading.shape != database.heading.shape:
        return None
    return (
        (database.omega, heading, values[rows]) if np.allclose(heading, database.heading) else None
    )


def _radiated(database: HydroDatabase, omega: Array, heading: Array) -> Complex | None:
    """Return H (nw, nh, nt) of the waves that the free motions radiate."""
    table, found = database.extra.get("kochin_radiation"), free_motions(database)
    if table is None or found is None or not _all_round(table):
        return None
    values = _ordered(table, ("omega", "radiating_dof", "theta"))
    rows = _rows(np.asarray(table.axes.get("omega", ()), float), omega)
    if values is None or rows is None:
        return None
    labels, motions = found
    names = [str(name) for name in table.axes["radiating_dof"]]
    places = [_place(label, names, len(database.bodies)) for label in labels]
    if any(place is None for place in places):
        return None
    own = values[rows][:, [p for p in places if p is not None]]
    if not np.isfinite(own).all():
        return None
    return np.asarray(np.einsum("whi,wit->wht", motions.conj(), own))  # e^{-iwt}, as H is


def _place(label: str, names: list[str], bodies: int) -> int | None:
    """Return where a coordinate stands among the motions of the source."""
    body, _, motion = label.rpartition(".")
    for place, name in enumerate(names):
        owner, _, word = name.rpartition("__")
        if word.lower() == motion and (owner == body or bodies == 1):
            return place
    return None


def _all_round(table: SourceTable) -> bool:
    """Whether H goes all round in equal steps from 0, without the end."""
    theta = np.asarray(table.axes.get("theta", ()), dtype=float)
    return theta.size >= 8 and bool(
        np.allclose(theta, 2.0 * np.pi * np.arange(theta.size) / theta.size, atol=1e-6)
    )


def _ordered(table: SourceTable, dims: tuple[str, ...]) -> Complex | None:
    if sorted(table.dims) != sorted(dims):
        return None
    order = [table.dims.index(dim) for dim in dims]
    return np.asarray(table.values, dtype=complex).transpose(order)


def _rows(known: Array, wanted: Array) -> np.ndarray | None:
    """Return the places of the wanted frequencies among those known; None if one is not there."""
    if not known.size:
        return None
    place = np.abs(known[:, None] - wanted).argmin(axis=0)
    return place if np.allclose(known[place], wanted, rtol=1e-6) else None
