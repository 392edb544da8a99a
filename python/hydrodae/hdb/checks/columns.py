"""Checks of water columns: bodies that are a piston of water inside a hull, not hulls themselves.

A piston of area S has the stiffness rho g S. In waves much longer than the device its force is
rho g S per metre, less the inertia w^2 sum_j A_3,3j of the water that moves with all bodies.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.motions import LONG
from hydrodae.hdb.checks.shapes import together
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.relations.dispersion import wavenumber

#: Difference of force and stiffness that diffraction and decay with depth do not explain there.
ALIKE = 0.1


def columns(database: HydroDatabase) -> list[str]:
    """Names of the bodies that are water columns."""
    return [name for name, body in database.bodies.items() if body.column]


def as_columns(database: HydroDatabase, names: list[str]) -> HydroDatabase:
    """Return the database with these bodies as water columns, of which only the heave is kept.

    Raises
    ------
    DatabaseError
        There is no such body, or it has no heave.
    """
    for name in names:
        if name not in database.bodies:
            known = ", ".join(database.bodies)
            raise DatabaseError(f"column {name!r}: no such body; there are: {known}").about(
                "label", name
            )
        if f"{name}.heave" not in database.coordinates:
            raise DatabaseError(f"column {name!r} has no heave").about("label", name)
    kept = [c for c in database.labels if c.body not in names or c.motion == "heave"]
    found = database.select([str(c) for c in kept])
    bodies = {
        name: replace(body, column=body.column or name in names)
        for name, body in found.bodies.items()
    }
    return replace(found, bodies=bodies)


def hulls_alone(database: HydroDatabase) -> HydroDatabase | None:
    """Return the database without water columns; None where nothing is left."""
    pistons = columns(database)
    labels = [str(c) for c in database.labels if c.body not in pistons]
    return database.select(labels) if labels else None


def open_hulls(database: HydroDatabase) -> HydroDatabase:
    """Return a database whose hulls have no hydrostatics: a column closes their surface."""
    bodies = {n: replace(body, hydrostatics=None) for n, body in database.bodies.items()}
    return replace(database, bodies=bodies)


def column_findings(database: HydroDatabase) -> list[Finding]:
    """Judge stiffness and long-wave force of each water column.

    Returns
    -------
    list of Finding
        A warning where they are not those of one area.
    """
    found = []
    for name in columns(database):
        statics = database.bodies[name].hydrostatics
        if statics is None or not database.heading.size:
            continue
        area = float(statics.waterplane_area)
        k = float(wavenumber(database.omega[:1], database.water_depth, database.gravity)[0])
        if not area > 0.0:
            text = f"{name}: its stiffness is not above zero: a piston of water has rho g S"
            found.append(Finding("error", "water column", text))
            continue
        if k * np.sqrt(area) > LONG:
            continue
        label = f"{name}.heave"
        i = database.coordinates.index(label)
        inertia = database.omega[0] ** 2 * together(database, label, list(database.bodies))[0]
        force = float(np.abs(database.excitation[0, :, i]).max() + inertia)
        seen = force / (database.rho * database.gravity)
        error = abs(seen / area - 1.0)
        text = f"{name}: stiffness of {area:.4g} m2 of water, long-wave force of {seen:.4g} m2"
        if error > ALIKE:
            text += ": not one piston; the areas at its top and bottom differ, or a number is wrong"
        severity = "warning" if error > ALIKE else "info"
        found.append(Finding(severity, "water column", text, error, float(database.omega[0])))
    return found
