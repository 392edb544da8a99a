"""Far-field drift of the bodies of a database: held fixed, and free to surge, sway and heave.

A database holds no inertia, so the free bodies have the masses that they displace and are held in
rotation. Their drift needs the Kochin functions that `hdb compute --kochin` or Capytaine kept.
"""

from __future__ import annotations

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.kochin import diffraction_of, radiation_of
from hydrodae.hdb.database.second_order import SAME_HEADING
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
    radiated = _radiated(database)
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
    try:
        heading, values = diffraction_of(database)
    except DatabaseError:
        return None
    apart = np.abs(np.exp(1j * heading)[:, None] - np.exp(1j * database.heading))
    if not np.isfinite(values).all() or not apart.size or apart.min(axis=0).max() > SAME_HEADING:
        return None
    return database.omega, database.heading, values[:, apart.argmin(axis=0)]


def _radiated(database: HydroDatabase) -> Complex | None:
    """Return H (nw, nh, nt) of the waves that the free motions radiate."""
    found = free_motions(database)
    if found is None:
        return None
    try:
        known, values = radiation_of(database)
    except DatabaseError:
        return None
    labels, motions = found
    if any(label not in known for label in labels):
        return None
    own = values[:, [known.index(label) for label in labels]]
    if not np.isfinite(own).all():
        return None
    return np.asarray(np.einsum("whi,wit->wht", motions.conj(), own))  # e^{-iwt}, as H is
