r"""Checks of the excitation in long waves, where it follows from statics and the added mass.

For a body small against the wavelength, at its reference point p, with the phase e^{-ik x'} of its
place removed, elevation cos(wt - k x'), heading beta:

    F_3 -> K33 - w^2 (rho V + sum_j A_3,3j)
    F_1 -> i k g cos(beta) (rho V D + sum_j A_1,1j),  D = decay of the acceleration at zB
    FK_5 -> i k cos(beta) K55 - S_x rho g
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.checks.shapes import decay, together, width
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.hdb.relations.noise import scatter

#: Cosine of three degrees: so near an axis added mass turns no force by 60 degrees.
NEAR_AXIS = float(np.cos(np.radians(3.0)))
#: Force over its noise from which it is judged: the least tolerance here is 5 %.
CLEAR = 20.0
#: Longest k times the width of a body of a wave that is taken in place of the longest.
LONG = 0.5
#: Width of a body, on the large side, over the cube root of its added volume.
WIDE = 3.0


@dataclass(frozen=True)
class _Wave:
    """A long wave of the database: its row, number [rad/m], frequency [rad/s], heading."""

    row: int
    k: float
    omega: float
    heading: int
    cosine: float
    sine: float


def long_wave_findings(db: HydroDatabase, band: Band | None = None) -> list[Finding]:
    """Compare the excitation at the lowest frequency with its long-wave limits, body by body.

    Parameters
    ----------
    db : HydroDatabase
    band : (low, high), optional
        Frequencies [rad/s] that the device feels. What is wrong below them only is a warning.

    Returns
    -------
    list of Finding
        Phase convention (error if wrong), heave against stiffness, surge against displacement,
        pitch against stiffness. Checks whose limit the grid does not reach are left out.
    """
    if db.heading.size == 0:
        return []
    found = _merged(_at_row(db, 0))
    first = 0 if band is None else int(np.searchsorted(db.omega, band[0] - 1e-9))
    if not 0 < first < db.omega.size or all(f.severity != "error" for f in found):
        return found
    later = _at_row(db, first)
    right = {f.check for f in later} - {f.check for f in later if f.severity == "error"}
    text = f"; not so from {db.omega[first]:.3g} rad/s on, longer waves are not felt"
    return [
        replace(f, severity="warning", message=f.message + text)
        if f.severity == "error" and f.check in right
        else f
        for f in found
    ]


def _at_row(db: HydroDatabase, row: int) -> list[Finding]:
    """All checks at one frequency, body by body; or at the next one above its noise."""
    found: list[Finding] = []
    for body in db.bodies.values():
        wave = _wave(db, row)
        if body.hydrostatics is not None and body.reference_point is not None:
            found += _heave(db, body, wave)
            moment = _clear(db, body, row, ("pitch",))
            found += [] if moment is None else _pitch(db, body, _wave(db, moment))
        clear = _clear(db, body, row, ("surge", "sway"))
        if clear is None:
            continue
        wave = _wave(db, clear)
        found += _phase(db, body, wave)
        found += _directions(db, body, clear, wave.k)
        if body.hydrostatics is not None and body.reference_point is not None:
            found += _displacement(db, body, wave)
    return found


def _wave(db: HydroDatabase, row: int) -> _Wave:
    """The wave of one frequency whose heading is most nearly along x or y."""
    along = np.maximum(np.abs(np.cos(db.heading)), np.abs(np.sin(db.heading)))
    h, omega = int(along.argmax()), db.omega[row : row + 1]
    k = float(wavenumber(omega, db.water_depth, db.gravity)[0])
    return _Wave(row, k, float(omega[0]), h, np.cos(db.heading[h]), np.sin(db.heading[h]))


def _clear(db: HydroDatabase, body: Body, row: int, dofs: tuple[str, ...]) -> int | None:
    """First row from `row` on where waves are long and a force is `CLEAR` times its noise.

    Where no long wave makes it so large, `row` itself, or None if the force there is noise.
    """
    i = [n for n, label in enumerate(db.coordinates) if label in {f"{body.name}.{d}" for d in dofs}]
    if not i:
        return None
    table = (db.froude_krylov if db.excitation_split else db.excitation)[:, :, i]
    largest, noise = np.abs(table).max(axis=(1, 2)), float(scatter(db.omega, table).max())
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    clear = np.flatnonzero((largest > CLEAR * noise) & (k * WIDE * width(db, body.name) < LONG))
    clear = clear[clear >= row]
    return int(clear[0]) if clear.size else row if largest[row] > noise else None


def _merged(found: list[Finding]) -> list[Finding]:
    """Keep warnings and errors; of each check that passed, only the body with the largest error."""
    passed: dict[str, list[Finding]] = {}
    for f in found:
        if f.severity == "info":
            passed.setdefault(f.check, []).append(f)
    merged = [f for f in found if f.severity != "info"]
    for group in passed.values():
        worst = max(group, key=lambda f: f.value)
        more = f"; {len(group) - 1} more no worse" if len(group) > 1 else ""
        merged.append(replace(worst, message=worst.message + more))
    return merged


def _local(db: HydroDatabase, body: Body, wave: _Wave, dof: str, *, fk: bool) -> complex | None:
    label = f"{body.name}.{dof}"
    if label not in db.coordinates:
        return None
    table = db.froude_krylov if fk else db.excitation
    # forces have the phase of where the water pushes, moments that of their point
    point = np.zeros(3) if body.reference_point is None else body.reference_point
    if body.hydrostatics is not None and dof not in ("roll", "pitch", "yaw"):
        point = body.hydrostatics.center_of_buoyancy
    shift = np.exp(1j * wave.k * (point[0] * wave.cosine + point[1] * wave.sine))
    return complex(table[wave.row, wave.heading, db.coordinates.index(label)] * shift)


def _phase(db: HydroDatabase, body: Body, wave: _Wave) -> list[Finding]:
    """Surge (or sway) must lead the elevation by a quarter period in the project convention."""
    dof, factor = ("surge", wave.cosine) if abs(wave.cosine) > 0.5 else ("sway", wave.sine)
    force = _local(db, body, wave, dof, fk=db.excitation_split)
    if force is None or force == 0.0:
        return []
    angle = float(np.angle(force * np.sign(factor)))
    off = abs(angle - 0.5 * np.pi)
    severity = "error" if off > 1.0 else "warning" if off > 0.2 else "info"
    text = f"{body.name}: {dof} force leads the elevation by {angle:+.3f} rad (+1.571 expected)"
    return [Finding(severity, "phase convention", text, off, wave.omega)]


def _directions(db: HydroDatabase, body: Body, row: int, k: float) -> list[Finding]:
    """Waves along an axis must push along it: headings in radians, or axes turned, do not.

    Off the axes, and of a body whose own axes are turned, added mass turns the force.
    """
    labels = [f"{body.name}.{dof}" for dof in ("surge", "sway")]
    if any(label not in db.coordinates for label in labels):
        return []
    i, beta = db.index(labels), db.heading
    length = float(np.cbrt(np.abs(db.added_mass[row, i, i]).max() / db.rho))
    if k * length > 0.5:
        return []
    point = np.zeros(3) if body.reference_point is None else np.asarray(body.reference_point)
    if body.hydrostatics is not None:
        point = body.hydrostatics.center_of_buoyancy
    lag = k * (point[0] * np.cos(beta) + point[1] * np.sin(beta))
    table = db.froude_krylov if db.excitation_split else db.excitation
    force = (table[row][:, i] * np.exp(1j * lag)[:, None]).imag
    size = np.hypot(*force.T)
    along = np.stack([np.cos(beta), np.sin(beta)], axis=1)
    on_axis = (np.abs(along).max(axis=1) > NEAR_AXIS) & (size > 0.1 * size.max(initial=0.0))
    cosine = np.abs((force * along).sum(axis=1)) / np.where(size > 0.0, size, np.inf)
    wrong = np.flatnonzero(on_axis & (cosine < 0.5))
    if not on_axis.any():
        return []
    h = int(wrong[0]) if wrong.size else int(on_axis.argmax())
    angle = np.degrees(np.arctan2(force[h, 1], force[h, 0]))
    text = (
        f"{body.name}: long waves of heading {np.degrees(beta[h]):.4g} deg push towards "
        f"{angle:.4g} deg"
    )
    severity = "error" if wrong.size else "info"
    return [Finding(severity, "heading", text, omega=float(db.omega[row]))]


def _heave(db: HydroDatabase, body: Body, wave: _Wave) -> list[Finding]:
    hs = body.hydrostatics
    force = _local(db, body, wave, "heave", fk=False)
    if hs is None or force is None:
        return []
    k33 = db.rho * db.gravity * hs.waterplane_area
    inertia = wave.omega**2 * (
        db.rho * hs.displaced_volume + together(db, f"{body.name}.heave", list(db.bodies))[wave.row]
    )
    area = max(hs.waterplane_area, 0.0)
    # the area may be what is wrong: the force and the added mass show long waves, too
    if (
        max(k33, abs(force)) < 2.0 * inertia
        or wave.k * min(np.sqrt(area), WIDE * width(db, body.name)) > 0.5
    ):
        return []
    # the water's vertical acceleration falls towards the keel, in shallow water to nothing
    keel = 2.0 * float(hs.center_of_buoyancy[2])
    least = k33 - inertia
    most = k33 - inertia * float(decay(wave.k, db.water_depth, keel, vertical=True))
    error = float(abs(force - np.clip(force.real, least, most)) / max(k33, 1e-9 * abs(force)))
    level = "error" if error > 0.15 else "warning" if error > 0.05 else "info"
    text = (
        f"{body.name}: long-wave heave force {abs(force):.4g} N/m, "
        f"rho g A_w - w^2 (rho V + A) = {k33 - inertia:.4g} N/m"
    )
    return [Finding(level, "heave force against stiffness", text, error, wave.omega)]


def _displacement(db: HydroDatabase, body: Body, wave: _Wave) -> list[Finding]:
    hs = body.hydrostatics
    dof, factor = ("surge", wave.cosine) if abs(wave.cosine) > 0.5 else ("sway", wave.sine)
    split = db.excitation_split
    force = _local(db, body, wave, dof, fk=split)
    if hs is None or force is None:
        return []
    z = float(hs.center_of_buoyancy[2])
    wide = min(np.sqrt(max(hs.waterplane_area, 0.0)), WIDE * width(db, body.name))
    if wave.k * max(abs(z) * 2.0, wide) > 0.3:
        return []
    added = 0.0 if split else together(db, f"{body.name}.{dof}", list(db.bodies))[wave.row]

    moved = abs(force) / (wave.k * db.gravity * abs(factor)) - added
    volume, stated = float(moved / (db.rho * decay(wave.k, db.water_depth, z))), hs.displaced_volume
    error = abs(volume / stated - 1.0) if stated > 0.0 else np.inf
    level = "error" if error > 0.3 else "warning" if error > 0.05 else "info"
    text = (
        f"{body.name}: {hs.displaced_volume:.5g} m3 by hydrostatics, {volume:.5g} m3 by the "
        f"long-wave {dof} force"
    )
    return [Finding(level, "displacement", text, error, wave.omega)]


def _pitch(db: HydroDatabase, body: Body, wave: _Wave) -> list[Finding]:
    hs = body.hydrostatics
    if hs is None or body.reference_point is None or not db.excitation_split:
        return []
    if abs(wave.cosine) < 0.9:
        return []
    force = _local(db, body, wave, "pitch", fk=True)
    lever = hs.center_of_buoyancy[2] - body.reference_point[2]
    parts = hs.waterplane_moments[2] + abs(hs.displaced_volume * lever)
    size = max(abs(body.reference_point[2]), 2.0 * abs(hs.center_of_buoyancy[2]))
    if (
        force is None
        or parts <= 0.0
        or wave.k * max(size, np.sqrt(max(hs.waterplane_area, 0.0))) > 0.1
    ):
        return []
    k55 = db.hydrostatic_stiffness(body.name)[4, 4]
    found = force.imag / (wave.k * wave.cosine)
    error = abs(found - k55) / (db.rho * db.gravity * parts)
    text = (
        f"{body.name}: K55 = {k55:.4g} N m by hydrostatics, {found:.4g} by the long-wave "
        f"moment (differs if the moments are about another point)"
    )
    level = "warning" if error > 0.1 else "info"
    return [Finding(level, "pitch moment against stiffness", text, error, wave.omega)]
