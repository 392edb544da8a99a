r"""Energy identity: the waves that a moving body radiates carry what its damping takes out.

By Haskind's relation the excitation of all headings gives the damping of one coordinate,

    B_ii = k / (8 pi rho g c_g) int_0^{2 pi} |F_i(beta)|^2 d beta,    c_g the group velocity,

(J. N. Newman, The exciting forces on fixed bodies in waves, J. Ship Res. 1962). For a body of
revolution one heading is enough: |F_3| is constant, |F_1| and |F_5| follow |cos beta|.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.band import LEAST_DAMPING, Band, inside
from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.checks.motions import motions
from hydrodae.hdb.checks.shapes import extent, gyration
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.relations.depth import circle, depth_of_bodies
from hydrodae.hdb.relations.dispersion import damping_of_waves
from hydrodae.hdb.relations.entries import entry_scale
from hydrodae.support.arrays import Array

#: Fewest frequencies with enough damping that a verdict rests on.
FEWEST = 3
#: Largest step between headings that the integral over them bears.
LARGEST_STEP = np.radians(50.0)


@dataclass(frozen=True)
class EnergyIdentity:
    """Damping that the excitation implies.

    Attributes
    ----------
    columns : (m,) array of int
        The coordinates that could be checked.
    damping : (nw, m) array
        B_ii from the excitation [N s/m, N m s].
    valid : (nw,) array of bool
        Where the headings resolve the scattered field.
    method : str
        How the integral over the headings was taken.
    """

    columns: NDArray[np.intp]
    damping: Array
    valid: NDArray[np.bool_]
    method: str


def energy_identity(database: HydroDatabase) -> EnergyIdentity | None:
    """Return the damping that the excitation implies, or None if the headings do not suffice.

    Parameters
    ----------
    database : HydroDatabase
        With headings around the circle; or from 0 to 180 degrees and a plane of symmetry y = 0;
        or any heading and a body of revolution (or several on one axis).
    """
    db = database
    if db.heading.size == 0:
        return None
    k, half_mean = damping_of_waves(db.omega, db.water_depth, db.gravity, db.rho)
    square = np.abs(db.excitation) ** 2
    everything = np.arange(len(db.coordinates))
    weight, step, half = circle(db.heading) or (np.zeros(0), np.inf, False)
    if step <= LARGEST_STEP and (not half or _symmetric_about_y(db)):
        mean = np.einsum("whi,h->wi", square, weight)
        valid = k * _radius(db) <= np.pi / step - 3.0
        damping = 2.0 * half_mean[:, None] * mean
        return EnergyIdentity(everything, damping, valid, "sum over the headings")
    if not _axisymmetric(db):
        return None
    own = [m for m in motions(db) if m.heading is not None]
    if not own:
        return None
    implied = np.stack([m.damping(m.force(db.excitation)) for m in own], axis=1)
    valid = np.ones(k.size, dtype=bool)
    return EnergyIdentity(np.array([m.column for m in own]), implied, valid, "body of revolution")


def energy_findings(database: HydroDatabase, band: Band | None = None) -> list[Finding]:
    """Compare the damping with what the excitation implies; the worst coordinate is reported.

    Parameters
    ----------
    database : HydroDatabase
    band : (low, high), optional
        Frequencies [rad/s] that count; default: all.

    Returns
    -------
    list of Finding
        One; "error" beyond 50 % (median over the frequencies where B exceeds a tenth of its peak
        in the band, and 2 % of w A_inf).
    """
    found = energy_identity(database)
    if found is None:
        return []
    active = scales(database) > 0.0
    worst: tuple[float, float, str, float, float] | None = None
    clean = ~suspect_rows(database)
    usable = found.valid & clean
    least = LEAST_DAMPING * database.omega
    if band is not None:
        usable &= inside(database.omega, band)
    off = 0
    for column, implied in zip(found.columns, found.damping.T, strict=True):
        b = database.radiation_damping[:, column, column]
        matters = usable & (b > 0.1 * b[usable].max(initial=0.0))
        matters &= b > least * abs(database.added_mass_inf[column, column])
        if not active[column] or matters.sum() < FEWEST:
            continue
        ratio = implied[matters] / b[matters]
        middle = float(np.median(ratio))
        at = int(np.abs(ratio - 1.0).argmax())
        off += abs(middle - 1.0) > 0.05
        if worst is None or abs(middle - 1.0) > abs(worst[0] - 1.0):
            label = database.coordinates[column]
            omega = float(database.omega[matters][at])
            worst = (middle, float(ratio[at]), label, omega, abs(middle - 1.0))
    if worst is None:
        return []
    middle, extreme, label, omega, error = worst
    severity = "error" if error > 0.5 else "warning" if error > 0.05 else "info"
    text = (
        f"excitation implies {middle:.3f} of B at {label} (median; {extreme:.3f} at worst), "
        f"by the {found.method}" + (f"; {off} coordinates beyond 5 %" if off > 1 else "")
    )
    return [Finding(severity, "damping from excitation", text, error, omega)]


def unchecked_energy(database: HydroDatabase) -> list[Finding]:
    """Say where the headings do not suffice: no finding of the law, which does not judge there."""
    if database.heading.size == 0 or energy_identity(database) is not None:
        return []
    text = (
        "not checked: needs headings around the circle (or 0..180 deg with symmetry about "
        "y = 0), or a body of revolution"
    )
    return [Finding("info", "damping from excitation", text)]


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


def _radius(db: HydroDatabase) -> float:
    """Radius [m] around the middle of the bodies, by their places and radii of gyration of A_inf.

    |F(beta)|^2 has harmonics up to about 2 k R + 4, which the sum over n headings must resolve.
    """
    places = extent(db, list(db.bodies))
    turning = max(gyration(db, name) for name in db.bodies)
    return (places if np.isfinite(places) else 0.0) + 1.5 * turning


def _symmetric_about_y(db: HydroDatabase) -> bool:
    points = [b.reference_point for b in db.bodies.values()]
    if any(p is None or abs(p[1]) > 1e-9 for p in points):
        return False
    lateral = np.array([label.dof in (1, 3, 5) for label in db.labels])
    return _coupling(db, lateral[:, None] != lateral) < 1e-3


def _coupling(db: HydroDatabase, pairs: NDArray[np.bool_]) -> float:
    """Largest |A_ij| of the given pairs over sqrt(A_ii A_jj)."""
    return float(np.abs(db.added_mass / entry_scale(db.added_mass))[:, pairs].max(initial=0.0))


def _axisymmetric(db: HydroDatabase) -> bool:
    """Bodies of revolution on one vertical axis.

    Surge and sway, roll and pitch are alike and yaw makes no waves (it does for three columns).
    """
    if any(scales(db)[[c.endswith(".yaw") for c in db.coordinates]] > 0.0):
        return False
    points = [b.reference_point for b in db.bodies.values()]
    if any(p is None for p in points):
        return False
    place = np.array(points)[:, :2]
    if np.abs(place - place[0]).max() > 1e-6:
        return False
    position = {label: i for i, label in enumerate(db.coordinates)}
    for body in db.bodies:
        if f"{body}.yaw" not in position:
            return False
        for one, other in (("surge", "sway"), ("pitch", "roll")):
            i, j = position.get(f"{body}.{one}"), position.get(f"{body}.{other}")
            if i is None or j is None:
                return False
            a = db.added_mass[:, [i, j], [i, j]]
            if np.median(np.abs(a[:, 0] - a[:, 1])) > 0.02 * np.abs(a).max():
                return False
    return True
