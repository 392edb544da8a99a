"""Places and sizes of bodies, as hydrostatics, added mass and forces show them, and decay of waves.

What the laws of long waves share: a wave is long against a length L where k L is small.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.support.arrays import Array, Complex

#: Length of a body over the cube root of its added mass over rho: a hemisphere's waterplane.
LENGTH = 1.7


def place(db: HydroDatabase, name: str) -> Array | None:
    """Return where a body is (3,) [m]: its centre of buoyancy, or its reference point; or None."""
    body = db.bodies[name]
    point = body.hydrostatics.center_of_buoyancy if body.hydrostatics else body.reference_point
    return None if point is None else np.asarray(point, dtype=float)


def away(db: HydroDatabase, one: str, other: str) -> Array | None:
    """Return the horizontal way (2,) from one body to another [m]; None where not known."""
    start, end = place(db, one), place(db, other)
    return None if start is None or end is None or one == other else (end - start)[:2]


def phase(db: HydroDatabase, name: str, k: Array) -> Complex:
    """Return e^{i k.x} (nw, nh), x where a body is (the origin if unknown): forces lose it."""
    point = place(db, name)
    x, y = (0.0, 0.0) if point is None else point[:2]
    along = x * np.cos(db.heading) + y * np.sin(db.heading)
    return np.asarray(np.exp(1j * np.outer(k, along)))


def extent(db: HydroDatabase, names: Sequence[str]) -> float:
    """Largest distance of a body from the middle of some [m]; infinite where that is not known."""
    points = [place(db, name) for name in names]
    known = np.array([p for p in points if p is not None])
    if len(points) == 1:
        return 0.0
    if len(known) < len(points):
        return np.inf
    return float(np.hypot(*(known - known.mean(axis=0))[:, :2].T).max())


def width(db: HydroDatabase, *names: str) -> float:
    """Cube root of the largest added volume of some bodies [m]; infinite where there is none."""
    own = np.abs(np.diag(db.added_mass_inf)) / db.rho
    sizes = [
        size for size, c in zip(own, db.labels, strict=True) if c.body in names and c.is_translation
    ]
    return float(np.cbrt(max(sizes, default=np.inf)))


def length(db: HydroDatabase, name: str, k: Array) -> float:
    """Length of a body [m], the least of those by added masses, by forces and by hydrostatics.

    One of them may be in other units. `k` (nw,) are the wavenumbers [rad/m].
    """
    added, forces = [], []
    statics = db.bodies[name].hydrostatics
    for i, label in enumerate(db.labels):
        if label.body != name:
            continue
        mass = float(np.abs(db.added_mass_inf[i, i])) / db.rho
        added.append(LENGTH * mass ** (0.2 if label.is_rotation else 1.0 / 3.0))
        force = np.abs(db.excitation[:, :, i]).max(axis=1, initial=0.0) / (db.rho * db.gravity)
        if label.is_translation and db.heading.size:
            heave = label.motion == "heave"
            size = np.sqrt(force.max()) if heave else LENGTH * np.cbrt((force / k).max())
            forces.append(float(size))
    hull = []
    if statics is not None:
        volume, area = np.abs([statics.displaced_volume, statics.waterplane_area])
        hull = [LENGTH * float(np.cbrt(volume)), float(np.sqrt(area))]
    return min(max(values) for values in (added, forces, hull) if values)


def gyration(db: HydroDatabase, name: str) -> float:
    """Radius of gyration of the added mass in pitch or roll [m]; 0 if unknown.

    The larger of the two, each the least over all points.
    """
    at, found = {c.dof: i for i, c in enumerate(db.labels) if c.body == name}, [0.0]
    for motions in ((0, 2, 4), (1, 2, 3)):
        i = [at[dof] for dof in motions if dof in at]
        a = db.added_mass_inf[np.ix_(i, i)]
        if len(i) == 3 and min(a[0, 0], a[1, 1]) > 0.0:
            rest = a[2, 2] - a[2, 0] ** 2 / a[0, 0] - a[2, 1] ** 2 / a[1, 1]
            found.append(float(np.sqrt(max(rest, 0.0) / max(a[0, 0], a[1, 1]))))
    return max(found)


def together(db: HydroDatabase, label: str, names: Sequence[str]) -> Array:
    """Return the added mass (nw,) of a coordinate when some bodies move together in its motion.

    So the water around them moves in long waves. Bodies without that motion count nothing.
    """
    motion = label.rpartition(".")[2]
    columns = [j for j, c in enumerate(db.labels) if c.motion == motion and c.body in names]
    return np.asarray(db.added_mass[:, db.coordinates.index(label), columns].sum(axis=1))


def decay(k: Array | float, depth: float, height: float, *, vertical: bool = False) -> Array:
    """Acceleration of the water at a height z over that at the surface, as k [rad/m].

    cosh k(z + h) / cosh kh of the horizontal one, sinh of the vertical one.
    """
    if not np.isfinite(depth):
        return np.asarray(np.exp(k * height))
    deep = np.minimum(k * depth, 300.0)
    shape = np.sinh if vertical else np.cosh
    return np.asarray(shape(np.maximum(deep + k * height, 0.0)) / shape(deep))
