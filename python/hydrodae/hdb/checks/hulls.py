"""Hydrostatics that no hull has, or another one than that of the mesh and of the added masses.

At infinite frequency the added masses of surge, sway and heave add up to 1.05 rho V for a
hemisphere, and to more for other hulls; a hull of length R (of its volume, its waterplane or the
radius of gyration of its added mass) carries up to 55 rho R^3, a thin disc.
"""

from __future__ import annotations

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.shapes import gyration
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.support.arrays import Array

#: Flat panels enclose some per cent less than a curved hull.
ALIKE = 0.1
#: Volumes of the mesh, or of a quarter of it, over that of the body that are another unit.
LEAST_SHARE, LARGEST_SHARE = 0.08, 3.0
#: What rounding leaves of areas and moments, over the length V^(1/3) to their power.
ROUNDING = 1e-2
#: Centres of buoyancy of floating bodies lie within so many V^(1/3): a spar's at 2.
DEEP = 20.0
#: Least sum of the added masses over rho V, and largest added mass over rho R^3.
LEAST_MASS, LARGEST_MASS = 0.3, 100.0
#: Least volume over waterplane times depth of the centre of buoyancy: 0.5 and more of usual hulls.
LEAST_VOLUME = 0.005
#: Largest radius of gyration over V^(1/3), or A_w^(1/2): 7 for a pole 100 times its diameter.
GYRATION = 20.0


def hull_findings(database: HydroDatabase) -> list[Finding]:
    """Judge the hydrostatics of each body by themselves and by its mesh.

    Returns
    -------
    list of Finding
        An error for a buoyancy centre above the water or in the ground and for a waterplane of
        negative area, and where the mesh has three times the volume or a third of it; warnings for
        negative moments of the waterplane and other differences from the mesh (not looked at where
        a part of it is dry). An error where volume and added masses are not those of one hull.
    """
    found = []
    for name, body in database.bodies.items():
        statics, point = body.hydrostatics, body.reference_point
        if statics is None:
            continue
        found += [
            Finding(severity, "hydrostatics", f"{name}: {text}: is a number garbled?")
            for severity, text in _impossible(statics, database.water_depth)
        ]
        if body.mesh is not None and point is not None:
            found += _of_mesh(name, statics, body.mesh, np.asarray(point))
        text = _of_sizes(database, name, statics)
        found += [Finding("error", "size of the hull", f"{name}: {text}")] if text else []
    return found


def _impossible(statics: Hydrostatics, depth: float) -> list[tuple[str, str]]:
    """Report what no hull has, with its severity."""
    found, size = [], abs(statics.displaced_volume) ** (1.0 / 3.0)
    height = float(statics.center_of_buoyancy[2])
    center = f"its centre of buoyancy, z = {height:.4g} m, is"
    if height >= 0.0:
        severity = "error" if height > ROUNDING * size else "warning"
        found.append((severity, f"{center} not below the water"))
    elif height < -depth:
        found.append(("error", f"{center} below the ground at {-depth:g} m"))
    elif height < -DEEP * size and statics.waterplane_area > ROUNDING * size**2:
        found.append(("warning", f"{center} very deep for {statics.displaced_volume:.4g} m3"))
    if statics.waterplane_area < -ROUNDING * size**2:
        text = f"its waterplane area is negative, {statics.waterplane_area:.4g} m2"
        found.append(("error", text))
    least = float(statics.waterplane_moments[2:4].min())
    if least < -ROUNDING * (size * size) * (size * size):  # size**4 raises beyond 1e77 m
        text = f"a second moment of its waterplane is negative, {least:.4g} m4"
        found.append(("warning", text))
    return found


def _of_sizes(db: HydroDatabase, name: str, statics: Hydrostatics) -> str:
    """Report sizes of hull and added mass that do not go together, or nothing."""
    i = [n for n, label in enumerate(db.labels) if label.body == name and label.is_translation]
    volume, area = statics.displaced_volume, max(statics.waterplane_area, 0.0)
    height = abs(float(statics.center_of_buoyancy[2]))
    if 0.0 < volume < LEAST_VOLUME * area * height:
        return (
            f"a volume of {volume:.4g} m3 with a waterplane of {area:.4g} m2 has no centre of "
            f"buoyancy {height:.4g} m deep"
        )
    if len(i) < 3 or volume <= 0.0:
        return ""
    added, turning = db.added_mass_inf[i, i] / db.rho, gyration(db, name)
    size = max(float(np.cbrt(volume)), float(np.sqrt(area)))
    if added.sum() < LEAST_MASS * volume:
        return (
            f"its added masses of surge, sway and heave are {added.sum() / volume:.2g} of its "
            f"displacement together, at least {LEAST_MASS:g} expected"
        )
    if added.max() > LARGEST_MASS * max(turning, size) ** 3:
        return (
            f"its added mass is that of {added.max():.3g} m3 of water, far more than one of "
            f"{max(turning, size):.3g} m length moves"
        )
    if turning > GYRATION * size:
        return (
            f"moments of its added mass are those of a body of {turning:.3g} m, its volume is "
            f"{volume:.3g} m3"
        )
    return ""


def _of_mesh(name: str, statics: Hydrostatics, panels: Array, point: Array) -> list[Finding]:
    """Compare displaced volume and centre of buoyancy with those of the panels."""
    try:
        mesh = mesh_statics(panels, point)
    except DatabaseError:
        return []  # a part above the water: not what the run was made with
    volume = statics.displaced_volume
    if volume <= 0.0:
        return []  # nothing to compare with
    share = mesh.displaced_volume / volume
    # halves and quarters are completed by symmetry: their buoyancy is at the same height
    parts = next((n for n in (1.0, 2.0, 4.0) if abs(share * n - 1.0) < ALIKE), 0.0)
    off = np.abs(mesh.center_of_buoyancy - statics.center_of_buoyancy)
    away = float(off[2] if parts > 1.0 else off.max())
    if parts == 0.0:
        text = f"displaces {volume:.5g} m3, its mesh {mesh.displaced_volume:.5g} m3"
    elif away > ALIKE * volume ** (1.0 / 3.0):
        shown = ", ".join(f"{v:.4g}" for v in mesh.center_of_buoyancy)
        stated = ", ".join(f"{v:.4g}" for v in statics.center_of_buoyancy)
        text = f"its centre of buoyancy is at {stated} m, that of its mesh at {shown} m"
    else:
        return []
    text = f"{name}: {text}: hydrostatics of another body, or a garbled number"
    severity = "warning" if LEAST_SHARE < share < LARGEST_SHARE else "error"
    wrong = abs(float(share) * max(parts, 1.0) - 1.0)
    return [Finding(severity, "hydrostatics of the mesh", text, wrong)]
