r"""Long waves: what hydrostatics and added mass make of force and damping, and what is stored.

For a body small against the wavelength, with the phase e^{-ik x'} of its place removed, per wave of
elevation cos(wt - k x') along the axis of the motion, heading beta:

    F_1 -> i k g (rho V D + sum_j A_1,1j),   of which the diffraction is the part of A,
    F_3 -> K33 - w^2 (rho V + sum_j A_3,3j),
    B_ii = k / (8 rho g c_g) s |F_i|^2,      s = 2 in heave, 1 in the others (Haskind, `energy`),

the sums over the bodies near each other; D = cosh k(z + h) / cosh kh the decay of the water's
acceleration down to the centre of buoyancy. Forces across the axes follow cos beta or sin beta.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.shapes import decay, extent, length, phase, together, width
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.labels import Label
from hydrodae.hdb.relations.dispersion import damping_of_waves
from hydrodae.hdb.relations.noise import scatter
from hydrodae.support.arrays import Array, Complex

#: Longest k L of a wave whose force is the limit within some per cent, and within a factor of two.
LONG, LONGEST = 0.3, 1.0
#: Fewest frequencies that a ratio rests on.
FEWEST = 2
#: Distance from the middle over the width of a body from which bodies count one by one.
APART = 3.0
#: Inertia over stiffness up to which a floating body's heave force is that of its waterplane.
FOLLOWS = 0.5
#: Force over its noise from which it is judged: the least tolerance here is 5 %.
CLEAR = 20.0
#: Least cosine of the angle between a heading and the axis along which it pushes.
ALONG = 0.7


@dataclass(frozen=True)
class Motion:
    """Long waves and one motion of a body: columns over the frequencies (nw,).

    Attributes
    ----------
    label : Label
        Of a rigid motion but yaw.
    near : list of str
        The bodies that move with this one in long waves, itself among them.
    k, length : (nw,) array, float
        Wavenumbers [rad/m] and length of the body [m].
    added : (nw,) array
        Added mass of the motion of all bodies near [kg, kg m].
    column : int
        Of the tables of `db`.
    """

    db: HydroDatabase
    label: Label
    column: int
    near: list[str]
    k: Array
    haskind: Array
    length: float
    added: Array

    @property
    def body(self) -> Body:
        """The body that moves."""
        return self.db.bodies[self.label.body]

    @cached_property
    def along(self) -> Array:
        """Share (nh,) of a wave along the axis of the motion: cos beta, sin beta, or 1 in heave."""
        beta, dof = self.db.heading, self.label.dof
        return np.ones(beta.size) if dof == 2 else np.cos(beta) if dof in (0, 4) else np.sin(beta)

    @cached_property
    def heading(self) -> int | None:
        """The heading that pushes most along the axis of the motion, None where none does."""
        share = np.abs(self.along)
        return int(share.argmax()) if share.max(initial=0.0) > ALONG else None

    def local(self, table: Complex) -> Complex:
        """Forces (nw, nh) of a table without the phase of the place of the body."""
        return table[:, :, self.column] * phase(self.db, self.label.body, self.k)

    def force(self, table: Complex) -> Complex:
        """Forces (nw,) of a table in waves along the axis, complex."""
        h = self.heading
        return np.asarray(self.local(table)[:, h] / self.along[h])

    @cached_property
    def hull(self) -> Array | None:
        """Size (nw,) of the force expected of hull and added mass; the latter where no hull is."""
        db, statics, dof = self.db, self.body.hydrostatics, self.label.dof
        if dof == 2 and statics is not None:
            return db.rho * db.gravity * statics.waterplane_area - self.inertia
        if dof > 1:
            return None
        water = np.full(self.k.size, np.median(self.added[:3]))
        if statics is not None and statics.displaced_volume > 0.0:
            fade = decay(self.k, db.water_depth, float(statics.center_of_buoyancy[2]))
            water = db.rho * statics.displaced_volume * fade
        return self.k * db.gravity * (water + self.added)

    @cached_property
    def inertia(self) -> Array:
        """w^2 (rho V + A), (nw,) [N/m]; of a body with hydrostatics."""
        assert self.body.hydrostatics is not None
        volume = self.body.hydrostatics.displaced_volume
        return np.asarray(self.db.omega**2 * (self.db.rho * volume + self.added))

    @property
    def follows(self) -> NDArray[np.bool_]:
        """Where (nw,) the heave force is that of the waterplane; nowhere where no hull is known."""
        if self.hull is None or self.body.hydrostatics is None:
            return np.zeros(self.k.size, bool)
        return np.asarray(self.inertia < FOLLOWS * (self.hull + self.inertia))

    def damping(self, force: Array | Complex) -> Array:
        """Damping (nw,) that a force along the axis implies [N s/m, N m s]."""
        share = 2.0 if self.label.dof == 2 else 1.0
        return np.asarray(self.haskind * share * np.abs(force) ** 2)

    @property
    def stored(self) -> Array:
        """Damping (nw,) of the table."""
        return self.db.radiation_damping[:, self.column, self.column]

    def as_one(self, longest: float = LONGEST) -> NDArray[np.bool_]:
        """Where (nw,) waves are long, and the bodies near, which all have this motion, are one."""
        moving = {c.body for c in self.db.labels if c.motion == self.label.motion}
        size = extent(self.db, self.near) if moving.issuperset(self.near) else np.inf
        return np.asarray(self.k * max(self.length, size) < longest)

    def clear(self, row: int) -> int | None:
        """First row from `row` on where waves are long and the force is `CLEAR` times its noise.

        Where no long wave makes it so large, `row` itself, or None if the force there is noise.
        """
        if self.heading is None:
            return None
        force = pushing(self.db)[:, self.heading, self.column]
        size, noise = np.abs(force), float(scatter(self.db.omega, force))
        clear = np.flatnonzero((size > CLEAR * noise) & (self.k * self.length < LONG))
        clear = clear[clear >= row]
        return int(clear[0]) if clear.size else row if size[row] > noise else None


def motions(db: HydroDatabase) -> list[Motion]:
    """Return the motions of all bodies in long waves, but yaw, in the order of the labels."""
    k, haskind = damping_of_waves(db.omega, db.water_depth, db.gravity, db.rho)
    bodies = list(db.bodies)
    # bodies far from each other are alone in long waves, those near move together
    apart = extent(db, bodies) > APART * width(db, *bodies)
    lengths = {name: length(db, name, k) for name in bodies}
    found = []
    for i, label in enumerate(db.labels):
        if label.dof < 5:
            near = [label.body] if apart else bodies
            added = together(db, str(label), near)
            found.append(Motion(db, label, i, near, k, haskind, lengths[label.body], added))
    return found


def pushing(db: HydroDatabase) -> Complex:
    """Return the forces (nw, nh, n) that have no added mass, where the database has them apart."""
    return db.froude_krylov if db.excitation_split else db.excitation
