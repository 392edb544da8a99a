"""The depth that a database states, against what damping and force of heave show."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.relations.depth import depth_of_bodies


def depth_findings(db: HydroDatabase) -> list[Finding]:
    """Warn where damping and force of heave agree in water of another depth only.

    Parameters
    ----------
    db : HydroDatabase
        With headings all round, or from 0 to 180 degrees.
    """
    told = depth_of_bodies(
        db.coordinates,
        db.omega,
        db.radiation_damping,
        db.heading,
        db.excitation,
        db.rho,
        db.gravity,
    )
    if told is None or told.agrees(db.water_depth):
        return []
    best = f"{told.depth:.4g} m" if np.isfinite(told.depth) else f"more than {told.low:.3g} m"
    text = (
        f"stated as {db.water_depth:g} m, but damping and force of heave agree in {best}: "
        f"state the depth of the computation (--depth)"
    )
    return [Finding("warning", "water depth", text, omega=float(db.omega[0]))]
