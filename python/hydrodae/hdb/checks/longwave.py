"""Checks of the excitation at the lowest frequency, within some per cent of its long-wave limits.

The limits are those of `hydrodae.hdb.checks.motions`, and of the moment FK_5 -> i k cos(beta) K55.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.checks.motions import FOLLOWS, LONG, LONGEST, Motion, motions, pushing
from hydrodae.hdb.checks.shapes import decay
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding

#: Cosine of three degrees: so near an axis added mass turns no force by 60 degrees.
NEAR_AXIS = float(np.cos(np.radians(3.0)))


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
    table = motions(db)
    found = _merged(_at_row(table, 0))
    first = 0 if band is None else int(np.searchsorted(db.omega, band[0] - 1e-9))
    if not 0 < first < db.omega.size or all(f.severity != "error" for f in found):
        return found
    later = _at_row(table, first)
    right = {f.check for f in later} - {f.check for f in later if f.severity == "error"}
    text = f"; not so from {db.omega[first]:.3g} rad/s on, longer waves are not felt"
    return [
        replace(f, severity="warning", message=f.message + text)
        if f.severity == "error" and f.check in right
        else f
        for f in found
    ]


def _at_row(table: list[Motion], row: int) -> list[Finding]:
    """All checks at one frequency, body by body; or at the next one above its noise."""
    found: list[Finding] = []
    for body in dict.fromkeys(m.label.body for m in table):
        own = [m for m in table if m.label.body == body]
        for m in own:
            if m.heading is None:
                continue
            at = m.clear(row)
            if m.label.dof == 2:
                found += _heave(m, row)
            elif m.label.dof == 4 and at is not None:
                found += _pitch(m, at)
        level = [m for m in own if m.label.dof < 2]
        if not level:
            continue
        m = max(level, key=lambda m: np.abs(m.along).max())
        at = m.clear(row)
        if m.heading is not None and at is not None:
            found += [*_phase(m, at), *_directions(level, at), *_displacement(m, at)]
    return found


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


def _finding(
    m: Motion, row: int, check: str, text: str, error: float, limits: tuple[float, float]
) -> list[Finding]:
    """Return a finding of a body at one frequency: a warning, an error beyond the limits."""
    severity = "error" if error > limits[1] else "warning" if error > limits[0] else "info"
    text = f"{m.label.body}: {text}"
    return [Finding(severity, check, text, float(error), float(m.db.omega[row]))]


def _phase(m: Motion, row: int) -> list[Finding]:
    """Surge (or sway) must lead the elevation by a quarter period in the project convention."""
    force = m.force(pushing(m.db))[row]
    if force == 0.0:
        return []
    angle = float(np.angle(force))
    text = f"{m.label.motion} force leads the elevation by {angle:+.3f} rad (+1.571 expected)"
    return _finding(m, row, "phase convention", text, abs(angle - 0.5 * np.pi), (0.2, 1.0))


def _directions(level: list[Motion], row: int) -> list[Finding]:
    """Waves along an axis must push along it: headings in radians, or axes turned, do not.

    Off the axes, and of a body whose own axes are turned, added mass turns the force.
    """
    m, beta = level[0], level[0].db.heading
    if len(level) < 2 or m.k[row] * m.length > LONGEST:
        return []
    force = np.stack([m.local(pushing(m.db))[row].imag for m in level], axis=1)
    size = np.hypot(*force.T)
    along = np.stack([np.cos(beta), np.sin(beta)], axis=1)
    on_axis = (np.abs(along).max(axis=1) > NEAR_AXIS) & (size > 0.1 * size.max(initial=0.0))
    cosine = np.abs((force * along).sum(axis=1)) / np.where(size > 0.0, size, np.inf)
    wrong = np.flatnonzero(on_axis & (cosine < 0.5))
    if not on_axis.any():
        return []
    h = int(wrong[0]) if wrong.size else int(on_axis.argmax())
    angle = np.degrees(np.arctan2(force[h, 1], force[h, 0]))
    text = f"long waves of heading {np.degrees(beta[h]):.4g} deg push towards {angle:.4g} deg"
    return _finding(m, row, "heading", text, float(wrong.size), (0.0, 0.0))


def _heave(m: Motion, row: int) -> list[Finding]:
    db, hs = m.db, m.body.hydrostatics
    if hs is None:
        return []
    force, inertia = complex(m.force(db.excitation)[row]), float(m.inertia[row])
    k33 = db.rho * db.gravity * hs.waterplane_area
    # the area may be what is wrong: the force shows long waves, too
    if FOLLOWS * max(k33, abs(force)) < inertia or m.k[row] * m.length > LONG:
        return []
    # the water's vertical acceleration falls towards the keel, in shallow water to nothing
    keel = 2.0 * float(hs.center_of_buoyancy[2])
    most = k33 - inertia * float(decay(m.k[row], db.water_depth, keel, vertical=True))
    error = abs(force - np.clip(force.real, k33 - inertia, most)) / max(k33, 1e-9 * abs(force))
    text = (
        f"long-wave heave force {abs(force):.4g} N/m, rho g A_w - w^2 (rho V + A) = "
        f"{k33 - inertia:.4g} N/m"
    )
    return _finding(m, row, "heave force against stiffness", text, error, (0.05, 0.15))


def _displacement(m: Motion, row: int) -> list[Finding]:
    db, hs = m.db, m.body.hydrostatics
    if hs is None:
        return []
    height = float(hs.center_of_buoyancy[2])
    if m.k[row] * max(m.length, 2.0 * abs(height)) > LONG:
        return []  # a deep body feels more than the acceleration at one height
    fade = float(decay(m.k[row], db.water_depth, height))
    added = 0.0 if db.excitation_split else m.added[row]
    moved = abs(m.force(pushing(db))[row]) / (m.k[row] * db.gravity) - added
    volume, stated = float(moved / (db.rho * fade)), hs.displaced_volume
    error = abs(volume / stated - 1.0) if stated > 0.0 else np.inf
    text = (
        f"{stated:.5g} m3 by hydrostatics, {volume:.5g} m3 by the long-wave {m.label.motion} force"
    )
    return _finding(m, row, "displacement", text, error, (0.05, 0.3))


def _pitch(m: Motion, row: int) -> list[Finding]:
    db, hs, point = m.db, m.body.hydrostatics, m.body.reference_point
    if hs is None or point is None or not db.excitation_split:
        return []
    lever = hs.center_of_buoyancy[2] - point[2]
    parts = hs.waterplane_moments[2] + abs(hs.displaced_volume * lever)
    if parts <= 0.0 or m.k[row] * max(abs(point[2]), m.length) > 0.1:
        return []
    k55 = db.hydrostatic_stiffness(m.label.body)[4, 4]
    found = float(m.force(db.froude_krylov)[row].imag / m.k[row])
    text = (
        f"K55 = {k55:.4g} N m by hydrostatics, {found:.4g} by the long-wave moment (differs if "
        f"the moments are about another point)"
    )
    error = abs(found - k55) / (db.rho * db.gravity * parts)
    return _finding(m, row, "pitch moment against stiffness", text, error, (0.1, np.inf))
