"""Stated hydrostatics against the mesh of the hull, where the database holds one."""

from __future__ import annotations

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.findings import Finding
from hydrodae.hdb.mesh_statics import mesh_statics

#: Flat panels enclose some per cent less than a curved hull.
ALIKE = 0.1


def hull_findings(database: HydroDatabase) -> list[Finding]:
    """Compare displaced volume and centre of buoyancy with those of the panels, body by body.

    Parameters
    ----------
    database : HydroDatabase

    Returns
    -------
    list of Finding
        Warnings; none for bodies without a mesh, or with one of half a hull or a dry part.
    """
    found = []
    for name, body in database.bodies.items():
        statics, point = body.hydrostatics, body.reference_point
        if body.mesh is None or statics is None or point is None:
            continue
        try:
            mesh = mesh_statics(body.mesh, point)
        except DatabaseError:
            continue  # a part above the water: not what the run was made with
        volume = statics.displaced_volume
        share = mesh.displaced_volume / volume
        if any(abs(share * parts - 1.0) < ALIKE for parts in (2.0, 4.0)):
            continue  # completed by symmetry
        size = volume ** (1.0 / 3.0)
        away = float(np.linalg.norm(mesh.center_of_buoyancy - statics.center_of_buoyancy))
        if abs(share - 1.0) > ALIKE:
            text = f"{name}: displaces {volume:.5g} m3, its mesh {mesh.displaced_volume:.5g} m3"
        elif away > ALIKE * size:
            shown = ", ".join(f"{v:.4g}" for v in mesh.center_of_buoyancy)
            stated = ", ".join(f"{v:.4g}" for v in statics.center_of_buoyancy)
            text = f"{name}: its centre of buoyancy is at {stated} m, that of its mesh at {shown} m"
        else:
            continue
        text += ": hydrostatics of another body, or a garbled number"
        found.append(Finding("warning", "hydrostatics of the mesh", text, abs(share - 1.0)))
    return found
