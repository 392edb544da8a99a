r"""Sizes of A, B, F and the hull against each other: tables in other units, garbled hydrostatics.

Bodies near each other together, others one by one, in waves longer than they and their distances:

    F_1 = i k g (rho V D + A_11),   of which the diffraction is i k g A_11,
    B_33 = k / (4 rho g c_g) (rho g A_w - w^2 (rho V + A_33))^2,
    B_11 = k / (8 rho g c_g) (k g (rho V D + A_11))^2,

D the decay of the water's acceleration at the centre of buoyancy, cosh k(z + h) / cosh kh. And for
each body at infinite frequency: the added masses of surge, sway and heave add up to 1.05 rho V for
a hemisphere, and to more for other hulls; a hull of length R (of its volume, its waterplane or the
radius of gyration of its added mass) carries up to 55 rho R^3, a thin disc.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.one_heading import clean_rows, in_a_tank
from hydrodae.hdb.coordinates import split_label
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.dispersion import group_velocity, wavenumber
from hydrodae.hdb.findings import Finding
from hydrodae.hdb.hydrostatics import Hydrostatics

Array = NDArray[np.float64]
#: Fewest frequencies, and longest k times a length, of a verdict on forces and on damping.
FEWEST, LONG, LONGER = 2, 0.3, 0.8
#: A_11 over what diffraction says: 0.97 to 1.14 in 24 tables; over the whole force: 0.14 to 0.91.
DIFFRACTION, FORCE = 2.0, (0.004, 1.5)
#: Damping over that of the hull: 0.9 to 2.3 in 24 tables.
DAMPING = 5.0
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
UNITS = "another unit, density, or a garbled number"


def size_findings(database: HydroDatabase) -> list[Finding]:
    """Compare sizes of A, B and F with each other and with the hydrostatics.

    Parameters
    ----------
    database : HydroDatabase

    Returns
    -------
    list of Finding
        Errors only; what cannot be told (no headings, hydrostatics or long waves) is left out.
    """
    bodies = list(database.bodies)
    # bodies far from each other are alone in long waves, those near move together
    apart = _extent(database, bodies) > APART * _width(database)
    found = _of_hulls(database)
    for names in [[name] for name in bodies] if apart else [bodies]:
        found += [f for f in (_of_force(database, names), _of_damping(database, names)) if f]
    return found


def _width(db: HydroDatabase) -> float:
    """Cube root of the volume of the largest body [m]; 0 where none is known."""
    volumes = [b.hydrostatics.displaced_volume for b in db.bodies.values() if b.hydrostatics]
    return float(np.cbrt(max(volumes, default=0.0)))


def _together(db: HydroDatabase, names: Sequence[str], dof: int) -> NDArray[np.intp]:
    """Return the indices of one motion of some bodies; none unless all have it."""
    split = [split_label(label) for label in db.coordinates]
    at = [i for i, (name, own) in enumerate(split) if name in names and own == dof]
    return np.array(at if len(at) == len(names) else [], dtype=np.intp)


def _extent(db: HydroDatabase, names: Sequence[str]) -> float:
    """Largest distance of a body from the middle of some [m]; infinite where that is not known."""
    points = [
        body.hydrostatics.center_of_buoyancy if body.hydrostatics else body.reference_point
        for body in (db.bodies[name] for name in names)
    ]
    known = np.array([p for p in points if p is not None])
    if len(points) == 1:
        return 0.0
    if len(known) < len(points):
        return np.inf
    return float(np.hypot(*(known - known.mean(axis=0))[:, :2].T).max())


def _of_force(db: HydroDatabase, names: Sequence[str]) -> Finding | None:
    """Added mass against the horizontal force, or its diffraction, of long waves."""
    if not db.heading.size:
        return None
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    seen: list[tuple[float, str]] = []
    for dof, along in ((0, np.cos(db.heading)), (1, np.sin(db.heading))):
        i, h = _together(db, names, dof), int(np.abs(along).argmax())
        if not i.size or abs(along[h]) < 0.7:
            continue
        added = db.added_mass[:, i][:, :, i].sum(axis=(1, 2))
        unit = k * db.gravity * abs(along[h])
        whole = np.abs(db.excitation[:, h, i].sum(axis=1)) / unit
        lengths = [np.cbrt(np.median(np.abs(m)[:3]) / db.rho) for m in (whole, added)]
        long = (k * min(lengths) < LONG) & (k * _extent(db, names) < LONG)
        if np.count_nonzero(long) < FEWEST or not np.all(whole[long] > 0.0):
            continue
        what, low, high = "the whole force", *FORCE
        if db.excitation_split:
            what, low, high = "the diffraction force", 1.0 / DIFFRACTION, DIFFRACTION
            whole = np.abs(db.diffraction[:, h, i].sum(axis=1)) / unit
        if not np.all(whole[long] > 0.0):
            continue
        ratio = float(np.median(added[long] / whole[long]))
        if low < ratio < high:
            return None
        seen.append((ratio, f"{what} of long waves in {('surge', 'sway')[dof]}"))
    if not seen:
        return None
    ratio, what = seen[0]
    text = f"A is {ratio:.3g} of what {what} has of it: {UNITS}"
    return Finding("error", "added mass from force", text, ratio, float(db.omega[0]))


def _of_hulls(db: HydroDatabase) -> list[Finding]:
    """Added masses of each body against its volume and lengths."""
    found = []
    for name, body in db.bodies.items():
        statics = body.hydrostatics
        if statics is None:
            continue
        text = _impossible(db, name, statics)
        if text:
            found.append(Finding("error", "size of the hull", f"{name}: {text}: {UNITS}"))
    return found


def _impossible(db: HydroDatabase, name: str, statics: Hydrostatics) -> str:
    """Tell what does not go together, or nothing."""
    at = {dof: i for i, c in enumerate(db.coordinates) for b, dof in [split_label(c)] if b == name}
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
    gyration = _gyration(db, at)
    length = max(gyration, float(np.cbrt(volume)), float(np.sqrt(max(area, 0.0))))
    if added.max() > LARGEST_MASS * length**3:
        return (
            f"its added mass is that of {added.max():.3g} m3 of water, far more than one of "
            f"{length:.3g} m length moves"
        )
    if gyration > GYRATION * max(float(np.cbrt(volume)), float(np.sqrt(max(area, 0.0)))):
        return (
            f"moments of its added mass are those of a body of {gyration:.3g} m, its volume is "
            f"{volume:.3g} m3"
        )
    return ""


def _gyration(db: HydroDatabase, at: dict[int, int]) -> float:
    """Least radius of gyration of the added mass in pitch, over all points [m]."""
    if any(dof not in at for dof in (0, 2, 4)):
        return 0.0
    i = np.array([at[0], at[2], at[4]])
    a = db.added_mass_inf[np.ix_(i, i)]
    if min(a[0, 0], a[1, 1]) <= 0.0:
        return 0.0
    rest = a[2, 2] - a[2, 0] ** 2 / a[0, 0] - a[2, 1] ** 2 / a[1, 1]
    return float(np.sqrt(max(rest, 0.0) / max(a[0, 0], a[1, 1])))


def _of_damping(db: HydroDatabase, names: Sequence[str]) -> Finding | None:
    """Damping of bodies together against that of their hulls."""
    held = standing(db)
    known = [s for s in (db.bodies[name].hydrostatics for name in names) if s is not None]
    volume = sum(s.displaced_volume for s in known)
    if len(known) < len(names) or volume <= 0.0:
        return None
    height = sum(s.displaced_volume * float(s.center_of_buoyancy[2]) for s in known) / volume
    area = sum(s.waterplane_area for s in known)
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    speed = group_velocity(db.omega, db.water_depth, db.gravity)
    factor = k / (8.0 * db.rho * db.gravity * speed)
    decay = np.exp(k * height)
    if np.isfinite(db.water_depth):
        deep = np.minimum(k * db.water_depth, 300.0)
        decay = np.cosh(np.maximum(deep + k * height, 0.0)) / np.cosh(deep)
    long = (k * np.cbrt(volume) < LONGER) & (k * _extent(db, names) < 1.0)
    clean = long & clean_rows(db, held)
    long = clean if np.count_nonzero(clean) >= FEWEST else long
    seen: list[tuple[float, str]] = []
    for dof, name in enumerate(("surge", "sway", "heave")):
        i = _together(db, names, dof)
        if not i.size or (dof == 2 and (area <= 0.0 or any(name in held for name in names))):
            continue
        added = db.added_mass[:, i][:, :, i].sum(axis=(1, 2))
        b = db.radiation_damping[:, i][:, :, i].sum(axis=(1, 2))
        mass = db.rho * volume + added
        force, used = k * db.gravity * (db.rho * volume * decay + added), long
        if dof == 2:
            stiffness = db.rho * db.gravity * area
            force, used = (
                stiffness - db.omega**2 * mass,
                long & (db.omega**2 * mass < FOLLOWS * stiffness),
            )
        if not used.any() or np.mean(b[used] > 0.0) < 0.8:
            continue
        used = used & (b > 0.01 * b[used].max())
        if np.count_nonzero(used) < FEWEST:
            continue
        implied = factor * force**2 * (2.0 if dof == 2 else 1.0)
        seen.append((float(np.median(implied[used] / b[used])), name))
    wrong = [pair for pair in seen if not 1.0 / DAMPING < pair[0] < DAMPING]
    if not wrong or in_a_tank(db):
        return None
    ratio, name = max(wrong, key=lambda pair: abs(np.log(pair[0])))
    text = f"displacement and waterplane imply {ratio:.3g} times the B of long waves in {name}"
    return Finding("error", "damping from hull", f"{text}: {UNITS}", ratio)
