"""The reference point of moments, where a source leaves it out but hydrostatics stand beside it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.database.coordinates import bodies_of, split_label
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.nemoh_hydrostatics import FileHydrostatics
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.relations.dispersion import wavenumber

Array = NDArray[np.float64]
#: Largest k times size of a body for which the long-wave moment is taken.
LONGEST = 0.1
#: Difference of K55, over the size of its parts, that the point found may leave.
AGREE = 0.03


def without_moments(data: SourceData) -> list[str]:
    """Bodies of which a source holds translations only: their forces do not know a point."""
    turning = {body for body, dof in map(split_label, data.coordinates) if dof >= 3}
    return [name for name in bodies_of(data.coordinates) if name not in turning]


def settle_points(data: SourceData) -> None:
    """Take the origin as the point of bodies without moments whose point no file says."""
    for name in without_moments(data):
        if data.reference_points.get(name) is not None:
            continue
        data.reference_points[name] = np.zeros(3)
        data.assumed_points.add(name)
        text = (
            f"{name}: the forces hold no moments and are the same about any point; the origin is "
            f"taken (--cog {name}=x,y,z: another one)"
        )
        data.findings.append(Finding("info", "assumption", text))


def reference_by_statics(data: SourceData, body: str, found: FileHydrostatics) -> Array | None:
    """Return the centre of gravity of the hydrostatics or the origin, by the long-wave moment.

    About a point p the Froude-Krylov moment in long waves is FK_5 = i k cos(beta) K_55(p) - ...,
    with the buoyancy stiffness K_55(p): that tells the height of p.

    Parameters
    ----------
    data : SourceData
        With its forces; what was assumed is added to the findings.
    body : str
        Name of the body.
    found : FileHydrostatics
        From the files beside the source.

    Returns
    -------
    (3,) array or None
        [m]; None if neither point fits.
    """
    candidates = {
        f"the centre of gravity in {found.files[0].name}": found.center_of_gravity,
        "the origin": np.zeros(3),
    }
    moment = _moment_over_k(data, body, found)
    if moment is None:
        name, point = next(iter(candidates.items()))
        text = f"{body}: moments taken about {name}, {point.tolist()}: nothing could check it"
        data.findings.append(Finding("warning", "assumption", text))
        return np.asarray(point)
    statics, center = found.hydrostatics, found.center_of_gravity
    errors = {}
    for name, point in candidates.items():
        about = statics.moved(center, point)
        k55 = about.stiffness(point, data.rho, data.gravity)[4, 4]
        lever = statics.displaced_volume * abs(statics.center_of_buoyancy[2] - point[2])
        size = data.rho * data.gravity * (about.waterplane_moments[2] + lever)
        errors[name] = abs(moment - k55) / size
    best = min(errors, key=lambda name: errors[name])
    if errors[best] > AGREE:
        return None
    text = (
        f"{body}: the file does not say about which point its moments are; taken about {best}, "
        f"{candidates[best].tolist()}, with which the long-wave pitch moment gives K55 to "
        f"{errors[best]:.1g}"
    )
    data.findings.append(Finding("info", "assumption", text))
    return np.asarray(candidates[best])


def _moment_over_k(data: SourceData, body: str, found: FileHydrostatics) -> float | None:
    """Im FK_5 / (k cos beta) in the longest wave, [N m]; None if there is none long enough."""
    label, force = f"{body}.pitch", data.froude_krylov
    if force is None and data.excitation is not None and data.diffraction is not None:
        force = data.excitation - data.diffraction
    if force is None or label not in data.coordinates or not data.heading.size:
        return None
    h = int(np.abs(np.cos(data.heading)).argmax())
    values = force[:, h, data.coordinates.index(label)]
    known = np.flatnonzero(np.isfinite(values))
    statics = found.hydrostatics
    if not known.size or abs(np.cos(data.heading[h])) < 0.9:
        return None
    at = int(known[0])
    k = float(wavenumber(data.omega[at : at + 1], data.water_depth, data.gravity)[0])
    size = np.sqrt(max(statics.waterplane_area, 0.0)) + 2.0 * abs(statics.center_of_buoyancy[2])
    if k * size > LONGEST:
        return None
    x = statics.center_of_buoyancy[0]
    turned = values[at] * np.exp(1j * k * x * np.cos(data.heading[h]))
    return float(turned.imag / (k * np.cos(data.heading[h])))
