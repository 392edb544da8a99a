"""The reference point of moments, where a source leaves it out but hydrostatics stand beside it."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.readers.nemoh_hydrostatics import FileHydrostatics
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.relations.dispersion import wavenumber

#: Largest k times size of a body for which the long-wave moment is taken.
LONGEST = 0.1
#: Difference of K55, over the size of its parts, that the point found may leave.
AGREE = 0.03


def without_moments(data: SourceData) -> list[str]:
    """Bodies of which a source holds translations only: their forces do not know a point."""
    turning = {label.body for label in data.labels if label.is_rotation}
    return [name for name in bodies_of(data.coordinates) if name not in turning]


def settle_points(data: SourceData) -> None:
    """Take the origin as the point of bodies without moments whose point no file says."""
    for name in without_moments(data):
        if data.reference_points.get(name) is not None:
            continue
        text = (
            f"{name}: the forces hold no moments and are the same about any point; the origin is "
            f"taken (--cog {name}=x,y,z: another one)"
        )
        data.assume_point(name, np.zeros(3), Finding("info", "assumption", text))


def origin_by_moments(data: SourceData, body: str, statics: Hydrostatics) -> float | None:
    """Error with which long-wave moments are about the origin, of a hull known by its mesh.

    About the point p of the tables F_5 = i k cos(beta) (K_55(p) + g A_51) - rho g S_x(p), and roll
    likewise: A_51 of the tables shares their point, so that a point dz higher changes the bracket
    by rho g V dz, and one dx ahead S_x by A_w dx. Surge, which leads, shows the time convention.

    It is over the sizes of its parts; None if no wave is long enough, or a motion is lacking.
    Waterplane moments are about the origin.
    """
    at = {dof: f"{body}.{dof}" for dof in ("surge", "heave", "roll", "pitch")}
    if data.excitation is None or any(label not in data.coordinates for label in at.values()):
        return None
    i = {dof: data.coordinates.index(label) for dof, label in at.items()}
    h = int(np.abs(np.cos(data.heading)).argmax())
    cosine = float(np.cos(data.heading[h]))
    k = float(wavenumber(data.omega[:1], data.water_depth, data.gravity)[0])
    depth = 2.0 * abs(statics.center_of_buoyancy[2])
    if abs(cosine) < 0.9 or k * max(np.sqrt(max(statics.waterplane_area, 0.0)), depth) > 0.3:
        return None
    force, rho_g = data.excitation[0, h], data.rho * data.gravity
    sx, sy, sxx, _, _ = statics.waterplane_moments
    lever = statics.displaced_volume * abs(statics.center_of_buoyancy[2])
    k55 = statics.stiffness(np.zeros(3), data.rho, data.gravity)[4, 4]
    bracket = k55 + data.gravity * data.added_mass[0, i["pitch"], i["surge"]]
    leads = np.sign(force[i["surge"]].imag * cosine)
    height = abs(leads * force[i["pitch"]].imag / (k * cosine) - bracket) / (rho_g * (sxx + lever))
    width = abs(force[i["heave"]]) * np.sqrt(max(statics.waterplane_area, 1e-12))
    ahead = abs(force[i["pitch"]].real + rho_g * sx) / width
    aside = abs(force[i["roll"]].real - rho_g * sy) / width
    return float(max(height, ahead, aside))


def assume_by_statics(data: SourceData, body: str, found: FileHydrostatics) -> None:
    """Take the centre of gravity of the hydrostatics or the origin, by the long-wave moment.

    About a point p the Froude-Krylov moment in long waves is FK_5 = i k cos(beta) K_55(p) - ...,
    with the buoyancy stiffness K_55(p): that shows the height of p. Where neither
    point fits none is taken. What was assumed is added to the findings.
    """
    candidates = {
        f"the centre of gravity in {found.files[0].name}": found.center_of_gravity,
        "the origin": np.zeros(3),
    }
    moment = _moment_over_k(data, body, found)
    if moment is None:
        name, point = next(iter(candidates.items()))
        text = f"{body}: moments taken about {name}, {point.tolist()}: nothing could check it"
        data.assume_point(body, np.asarray(point), Finding("warning", "assumption", text))
        return
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
        return
    text = (
        f"{body}: the file does not say about which point its moments are; taken about {best}, "
        f"{candidates[best].tolist()}, with which the long-wave pitch moment gives K55 to "
        f"{errors[best]:.1g}"
    )
    data.assume_point(body, np.asarray(candidates[best]), Finding("info", "assumption", text))


def _moment_over_k(data: SourceData, body: str, found: FileHydrostatics) -> float | None:
    """Im FK_5 / (k cos beta) in the longest wave, [N m]; None without one long enough."""
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
