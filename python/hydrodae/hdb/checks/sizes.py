r"""Sizes of A, B, F and the hull against each other: tables in other units, garbled hydrostatics.

Bodies near each other together, others one by one, in waves longer than they and their distances:

    F_1 = i k g (rho V D + A_11),   of which the diffraction is i k g A_11,
    B_33 = k / (4 rho g c_g) (rho g A_w - w^2 (rho V + A_33))^2,
    B_11 = k / (8 rho g c_g) (k g (rho V D + A_11))^2,

the A_ii of damping with the coupling of all bodies beside it; D the decay of the water's
acceleration at the centre of buoyancy, cosh k(z + h) / cosh kh. And for each body at infinite
frequency: the added masses of surge, sway and heave add up to 1.05 rho V for a hemisphere, and to
more for other hulls; a hull of length R (of its volume, its waterplane or the radius of gyration of
its added mass) carries up to 55 rho R^3, a thin disc.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.one_heading import in_a_tank
from hydrodae.hdb.checks.shapes import decay, extent, gyration, together, width
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.relations.dispersion import damping_of_waves, wavenumber
from hydrodae.support.arrays import Array

#: Fewest frequencies, and longest k times a length, of a verdict on forces and on damping.
FEWEST, LONG, LONGER = 2, 0.3, 0.8
#: A_11 over what diffraction says: 0.97 to 1.14 in 24 tables; over the whole force: 0.14 to 0.91.
DIFFRACTION, FORCE = 2.0, (0.004, 1.5)
#: Damping of the hull over that of the table: in 24 tables 1.0 to 2.1 of surge and sway, 0.83 to
#: 1.04 of heave. `UNKNOWN`: where no file gives the volume, and A_11 stands for it.
DAMPING, HEAVE, UNKNOWN = 5.0, 3.0, 60.0
#: Least sum of the added masses over rho V, and largest added mass over rho R^3.
LEAST_MASS, LARGEST_MASS = 0.3, 100.0
#: Least volume over waterplane times depth of the centre of buoyancy: 0.5 and more of usual hulls.
LEAST_VOLUME = 0.005
#: Largest radius of gyration over the cube root of the volume: 7 for a pole 100 times its diameter.
GYRATION = 20.0
#: Distance from the middle over the width of a body from which bodies count one by one.
APART = 3.0
#: Inertia over stiffness up to which a body follows the waves.
FOLLOWS = 0.5


def size_findings(database: HydroDatabase) -> list[Finding]:
    """Compare sizes of A, B and F with each other and with the hydrostatics.

    Returns
    -------
    list of Finding
        Errors, and what agrees; what cannot be judged (no headings, hydrostatics or long waves) is
        left out.
    """
    bodies = list(database.bodies)
    # bodies far from each other are alone in long waves, those near move together
    apart = extent(database, bodies) > APART * width(database, *bodies)
    found = _of_hulls(database)
    for names in [[name] for name in bodies] if apart else [bodies]:
        found += [f for f in (_of_force(database, names), _of_damping(database, names)) if f]
    return found


def _together(db: HydroDatabase, names: Sequence[str], dof: int) -> NDArray[np.intp]:
    """Return the indices of one motion of some bodies; none unless all have it."""
    labels = enumerate(db.labels)
    at = [i for i, label in labels if label.body in names and label.dof == dof]
    return np.array(at if len(at) == len(names) else [], dtype=np.intp)


def _of_force(db: HydroDatabase, names: Sequence[str]) -> Finding | None:
    """Added mass against the horizontal force, or its diffraction, of long waves."""
    if not db.heading.size:
        return None
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    seen: list[tuple[bool, float, str]] = []
    for dof, along in ((0, np.cos(db.heading)), (1, np.sin(db.heading))):
        i, h = _together(db, names, dof), int(np.abs(along).argmax())
        if not i.size or abs(along[h]) < 0.7:
            continue
        added = db.added_mass[:, i][:, :, i].sum(axis=(1, 2))
        unit = k * db.gravity * abs(along[h])
        whole = np.abs(db.excitation[:, h, i].sum(axis=1)) / unit
        lengths = [np.cbrt(np.median(np.abs(m)[:3]) / db.rho) for m in (whole, added)]
        long = (k * min(lengths) < LONG) & (k * extent(db, names) < LONG)
        if np.count_nonzero(long) < FEWEST or not np.all(whole[long] > 0.0):
            continue
        what, low, high = "the whole force", *FORCE
        if db.excitation_split:
            what, low, high = "the diffraction force", 1.0 / DIFFRACTION, DIFFRACTION
            whole = np.abs(db.diffraction[:, h, i].sum(axis=1)) / unit
        if not np.all(whole[long] > 0.0):
            continue
        ratio = float(np.median(added[long] / whole[long]))
        what = f"{what} of long waves in {('surge', 'sway')[dof]}"
        seen.append((not low < ratio < high, ratio, what))
    if not seen:
        return None
    # one direction that is right is enough
    wrong, ratio, what = min(seen)
    text = f"A is {ratio:.3g} of what {what} has of it"
    severity = "error" if wrong else "info"
    return Finding(severity, "added mass from force", text, ratio, float(db.omega[0]))


def _of_hulls(db: HydroDatabase) -> list[Finding]:
    """Added masses of each body against its volume and lengths."""
    found = []
    for name, body in db.bodies.items():
        statics = body.hydrostatics
        if statics is None:
            continue
        text = _impossible(db, name, statics)
        if text:
            found.append(Finding("error", "size of the hull", f"{name}: {text}"))
    return found


def _impossible(db: HydroDatabase, name: str, statics: Hydrostatics) -> str:
    """Report what does not go together, or nothing."""
    at = {label.dof: i for i, label in enumerate(db.labels) if label.body == name}
    volume, area = statics.displaced_volume, statics.waterplane_area
    height = abs(float(statics.center_of_buoyancy[2]))
    if area * height > 0.0 and 0.0 < volume < LEAST_VOLUME * area * height:
        return (
            f"a volume of {volume:.4g} m3 with a waterplane of {area:.4g} m2 has no centre of "
            f"buoyancy {height:.4g} m deep"
        )
    if any(dof not in at for dof in range(3)) or volume <= 0.0:
        return ""
    i = np.array([at[dof] for dof in range(3)])
    added = db.added_mass_inf[i, i] / db.rho
    if added.sum() < LEAST_MASS * volume:
        return (
            f"its added masses of surge, sway and heave are {added.sum() / volume:.2g} of its "
            f"displacement together, at least {LEAST_MASS:g} expected"
        )
    turning = gyration(db, name)
    length = max(turning, float(np.cbrt(volume)), float(np.sqrt(max(area, 0.0))))
    if added.max() > LARGEST_MASS * length**3:
        return (
            f"its added mass is that of {added.max():.3g} m3 of water, far more than one of "
            f"{length:.3g} m length moves"
        )
    if turning > GYRATION * max(float(np.cbrt(volume)), float(np.sqrt(max(area, 0.0)))):
        return (
            f"moments of its added mass are those of a body of {turning:.3g} m, its volume is "
            f"{volume:.3g} m3"
        )
    return ""


def _of_damping(database: HydroDatabase, names: Sequence[str]) -> Finding | None:
    """Damping of bodies near each other, one by one, against that of their hulls."""
    held = standing(database)
    known = [s for s in (database.bodies[name].hydrostatics for name in names) if s is not None]
    volume = sum(s.displaced_volume for s in known)
    k = wavenumber(database.omega, database.water_depth, database.gravity)
    long = k * extent(database, names) < 1.0
    if volume > 0.0:
        long &= k * np.cbrt(volume) < LONGER
    seen = [
        found
        for name in names
        for dof in range(3)
        if not (dof == 2 and name in held)
        for found in [_damping_of(database, name, dof, names, k, long)]
        if found is not None
    ]
    if not seen:
        return None
    ratio, label, limit = max(seen, key=lambda item: abs(np.log(item[0])) - np.log(item[2]))
    text = f"the hull and A imply {ratio:.3g} times the B of long waves in {label}"
    wrong = abs(np.log(ratio)) > np.log(limit)
    if wrong and in_a_tank(database):
        return None
    severity = "error" if wrong else "info"
    return Finding(severity, "damping from hull", text, ratio)


def _damping_of(
    db: HydroDatabase, name: str, dof: int, names: Sequence[str], k: Array, long: NDArray[np.bool_]
) -> tuple[float, str, float] | None:
    """Implied over stored damping of one motion, its label, and the ratio that is an error.

    Waves push a body that others stand around with the added mass of all in that motion.
    """
    position = {label: i for i, label in enumerate(db.coordinates)}
    motion = ("surge", "sway", "heave")[dof]
    label = f"{name}.{motion}"
    if label not in position or any(f"{other}.{motion}" not in position for other in names):
        return None
    i, statics = position[label], db.bodies[name].hydrostatics
    added = together(db, label, names)
    b, used = db.radiation_damping[:, i, i], long
    if statics is None or statics.displaced_volume <= 0.0:
        if dof == 2:
            return None
        volume, limit = float(np.median(added[:3])) / db.rho, UNKNOWN
        used, fade = used & (k * np.cbrt(max(volume, 0.0)) < LONGER), np.ones_like(k)
    else:
        volume, limit = statics.displaced_volume, DAMPING if dof < 2 else HEAVE
        fade = decay(k, db.water_depth, float(statics.center_of_buoyancy[2]))
    force = k * db.gravity * (db.rho * volume * fade + added)
    if dof == 2:
        assert statics is not None
        stiffness = db.rho * db.gravity * statics.waterplane_area
        inertia = db.omega**2 * (db.rho * volume + added)
        force, used = stiffness - inertia, used & (inertia < FOLLOWS * stiffness)
    if not used.any() or np.mean(b[used] > 0.0) < 0.8:
        return None
    used = used & (b > 0.01 * b[used].max())
    if np.count_nonzero(used) < FEWEST:
        return None
    _, factor = damping_of_waves(db.omega, db.water_depth, db.gravity, db.rho)
    implied = factor * force**2 * (2.0 if dof == 2 else 1.0)
    return float(np.median(implied[used] / b[used])), label, limit
