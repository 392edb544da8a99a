r"""The frequencies that a device feels: outside of them errors of a table do not matter.

A body follows a wave of unit amplitude by about

    R_i(w) = |F_i| / max(K_ii, w^2 (M_ii + A_ii)),

1 in long waves, and falling fast in short ones (rotations: times the radius of gyration of the
added mass). The shortest sea worth having peaks at the last frequency w_h where R > 1/2, and the
amplitudes of a wind sea fall beyond its peak as w^{-5/2}. Frequencies are felt up to the last one
with R (w_h/w)^{5/2} > 5 %.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.scales import scales
from hydrodae.support.arrays import Array

Band = tuple[float, float]
#: Motion in a wind sea, over that of a float in long waves, below which nothing is felt.
LEAST_MOTION = 0.05
#: Wind makes no waves longer than 30 s [rad/s].
LONGEST = 0.2
#: A sea that peaks where the device moves by this share of the wave is the shortest one.
HALF = 0.5
#: Ratio of frequencies that count as neighbours.
NEIGHBOURS = 1.12
#: B below this share of w A damps nothing: the sign of its noise does not matter.
LEAST_DAMPING = 0.02


def felt_band(database: HydroDatabase) -> Band:
    """Return the lowest frequency and the highest one that the device feels [rad/s].

    Returns
    -------
    low, high : float
        The whole table where there is no excitation.
    """
    w = database.omega
    motion = _motion(database)
    start = float(w[0]) if w[-1] < 2.0 * LONGEST else max(float(w[0]), LONGEST)
    if motion.shape[1] == 0:
        return start, float(w[-1])
    # spikes of irregular frequencies are no motion: the median over neighbours within 12 %
    low = np.searchsorted(w, w / NEIGHBOURS)
    high = np.searchsorted(w, w * NEIGHBOURS, side="right")
    felt = np.array([np.median(motion[a:b], axis=0).max() for a, b in zip(low, high, strict=True)])
    half = np.flatnonzero(felt > HALF)
    if not half.size:
        return start, float(w[-1])
    fall = np.minimum(1.0, (w[half[-1]] / w) ** 2.5)
    return start, float(w[np.flatnonzero(felt * fall > LEAST_MOTION)[-1]])


def inside(omega: Array, band: Band) -> NDArray[np.bool_]:
    """Frequencies within the band, its ends included."""
    return np.asarray((omega >= band[0] - 1e-9) & (omega <= band[1] + 1e-9))


def largest_of_kind(database: HydroDatabase, sizes: Array) -> Array:
    """Return the largest of sizes (..., n) among translations or rotations, of each; (..., n)."""
    turns = np.array([label.is_rotation for label in database.labels])
    kinds = [sizes[..., turns == kind].max(axis=-1, initial=0.0) for kind in (False, True)]
    return np.asarray(np.where(turns, kinds[1][..., None], kinds[0][..., None]))


def damping_sizes(database: HydroDatabase) -> Array:
    """Size of the damping of each coordinate: its peak, at least 2 % of w A_inf; (nw, n).

    Zero where B is negligible among its kind (`hydrodae.hdb.database.scales`).
    """
    peak = scales(database) ** 2
    inertia = np.outer(database.omega, np.abs(np.diag(database.added_mass_inf)))
    return np.asarray(np.where(peak > 0.0, np.maximum(peak, LEAST_DAMPING * inertia), 0.0))


def _motion(db: HydroDatabase) -> Array:
    """R_i(w) of the coordinates that radiate, rotations times a length; (nw, m)."""
    force = np.abs(db.excitation).max(axis=1, initial=0.0)
    added = np.abs(np.diag(db.added_mass_inf))
    columns = []
    active = scales(db) > 0.0
    for i, label in enumerate(db.labels):
        if label.is_mode or not active[i] or added[i] <= 0.0 or not force[:, i].any():
            continue
        hs = db.bodies[label.body].hydrostatics
        known = hs is not None and label.is_translation
        mass = db.rho * hs.displaced_volume if known and hs is not None else added[i]
        stiffness = 0.0
        if label.motion == "heave":
            stiffness = float(force[0, i])  # K33 is its long-wave limit
            if hs is not None:
                stiffness = db.rho * db.gravity * max(hs.waterplane_area, 0.0)
        length = 1.0
        if label.is_rotation:
            moving = [
                added[j]
                for j, other in enumerate(db.labels)
                if other.body == label.body and other.is_translation
            ]
            length = float(np.sqrt(added[i] / max(moving))) if moving and max(moving) > 0 else 1.0
        motion = length * force[:, i] / np.maximum(stiffness, db.omega**2 * (mass + added[i]))
        # a body follows long waves: what exceeds them there is a mass taken too small
        columns.append(motion / (max(1.0, motion[0]) if label.is_translation else 1.0))
    return np.stack(columns, axis=1) if columns else np.zeros((db.omega.size, 0))
