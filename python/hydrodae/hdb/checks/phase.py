"""Excitation without the phase of the waves at the bodies: smooth in frequency and heading."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex


def without_phase(database: HydroDatabase) -> Complex:
    """F e^{i k.x}, (nw, nh, n) [N/m, N m/m], x where each body floats (the origin if unknown)."""
    points = np.array([_place(database, label.body) for label in database.labels])
    heading = database.heading
    along = np.outer(np.cos(heading), points[:, 0]) + np.outer(np.sin(heading), points[:, 1])
    k = wavenumber(database.omega, database.water_depth, database.gravity)[:, None, None]
    return np.asarray(database.excitation * np.exp(1j * k * along))


def _place(database: HydroDatabase, body: str) -> Array:
    held = database.bodies[body]
    known = held.hydrostatics is not None or held.reference_point is not None
    return database.phase_point(body) if known else np.zeros(3)
