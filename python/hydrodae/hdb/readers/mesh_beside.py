"""Hydrostatics of a body from the mesh beside its tables, if the long waves agree with it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.readers.nemoh_hydrostatics import mesh_file
from hydrodae.hdb.readers.reference import origin_by_moments
from hydrodae.hdb.readers.source import SourceData, without_hydrostatics
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array

#: What flat panels, and the slope of the waves, may leave of the long-wave force.
ALIKE = 0.1


def statics_of_mesh(data: SourceData, root: Path, name: str, mesh: str) -> None:
    """Take the hydrostatics of a body from its mesh in Nemoh.cal; report it, or what is needed."""
    missing = f"{name}: no pair of Hydrostatics and KH files"
    path = mesh_file(root, mesh)
    if path is None or data.reference_points.get(name) is None:
        why = f", nor {mesh}.dat" if path is None else ""
        data.findings.append(without_hydrostatics(missing + why, [name]))
        return
    statics_of_file(data, name, path, missing)


def statics_of_file(
    data: SourceData,
    name: str,
    path: Path,
    missing: str,
    *,
    shift: Array | None = None,
    area: float | None = None,
) -> None:
    """Take the hydrostatics of a body from one mesh file; as `statics_of_mesh`.

    `missing` is what the source lacks, for the messages, `shift` (3,) the place of the axes of the
    mesh [m], `area` the waterplane by a stiffness of the source [m2], which the mesh must have.
    """
    point = data.reference_points[name]
    try:
        panels = read_mesh(path)
        panels = panels if shift is None else panels + shift
        statics = mesh_statics(panels, np.zeros(3) if point is None else point)
    except DatabaseError as error:
        data.findings.append(without_hydrostatics(f"{missing}; {path.name}: {error}", [name]))
        return
    shown = f"{statics.displaced_volume:.5g} m3, {statics.waterplane_area:.5g} m2 of waterplane"
    wrong = None
    share = long_wave_share(data, name, statics)
    if area is not None and abs(statics.waterplane_area - area) > ALIKE * abs(area):
        wrong = f"its stiffness in heave is that of {area:.5g} m2"
    elif share is not None and abs(share - 1.0) > ALIKE:
        wrong = f"their long-wave heave force is {share:.2f} of that"
    if wrong is None and point is None:
        miss = origin_by_moments(data, name, statics)
        if miss is not None and miss < ALIKE:
            point = np.zeros(3)
            said = (
                f"{name}: the files do not say about which point moments are: taken about the "
                f"origin, as those of long waves agree to {miss:.2g} (--origin)"
            )
            data.assume_point(name, point, Finding("info", "assumption", said))
    if wrong is not None or point is None:
        text = f"{missing}, and its mesh {path.name} ({shown}) is not the hull of the tables: "
        text = missing if wrong is None else text + wrong
        data.findings.append(without_hydrostatics(text, [name]))
        return
    proof = (
        "no long wave to check that by"
        if share is None
        else f"the long-wave heave force is {share:.3f} of what follows"
    )
    text = f"{missing}; taken from its mesh {path.name}: {shown}; {proof}"
    data.hydrostatics[name] = (statics, point)
    data.meshes[name] = panels
    data.files.append(path)
    data.findings.append(Finding("info" if share is not None else "warning", "assumption", text))


def long_wave_share(data: SourceData, name: str, statics: Hydrostatics) -> float | None:
    """Heave force at the lowest frequency over rho g A_w - w^2 (rho V + A); None in short waves."""
    label, force = f"{name}.heave", data.excitation
    if force is None and data.froude_krylov is not None and data.diffraction is not None:
        force = data.froude_krylov + data.diffraction
    if force is None or label not in data.coordinates or not data.heading.size:
        return None
    i = data.coordinates.index(label)
    known = np.flatnonzero(np.isfinite(force[:, :, i]).all(axis=1))
    if not known.size:
        return None
    row = int(known[0])
    omega = float(data.omega[row])
    together = [j for j, c in enumerate(data.coordinates) if c.endswith(".heave")]
    mass = data.rho * statics.displaced_volume + data.added_mass[row, i, together].sum()
    stiffness = data.rho * data.gravity * statics.waterplane_area
    k = float(wavenumber(np.array([omega]), data.water_depth, data.gravity)[0])
    if not stiffness > 2.0 * omega**2 * mass or k * np.sqrt(statics.waterplane_area) > 0.5:
        return None
    return float(np.abs(force[row, 0, i]) / (stiffness - omega**2 * mass))
