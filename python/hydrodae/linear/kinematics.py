"""Motion of the undisturbed water in waves of unit amplitude, as in sea/kinematics.h."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex


def water_motion(w: Array, heading: float, points: Array, depth: float, gravity: float) -> Complex:
    """Velocity [1/s], acceleration [1/s2] and elevation [-] per metre of wave amplitude.

    Parameters
    ----------
    w : (nw,) array
        Frequencies [rad/s].
    heading : float
        Direction of travel [rad].
    points : (n, 3) array
        World axes [m]; above z = 0 the water moves as at z = 0, below the bed it does not.
    depth, gravity : float
        [m], may be infinite; [m/s2].

    Returns
    -------
    (nw, n, 7) complex array
        Three of each, world axes, and the elevation; its phase is zero at the origin.
    """
    k = wavenumber(w, depth, gravity)[:, None]
    z = np.minimum(points[:, 2], 0.0)
    wet = np.exp(k * z) * (z >= -depth) / (1.0 - np.exp(-2.0 * k * depth))
    back = np.exp(-2.0 * k * (np.maximum(z, -depth) + depth))
    c, s = np.cos(heading), np.sin(heading)
    eta = np.exp(-1j * k * (points[:, 0] * c + points[:, 1] * s))
    along, up = w[:, None] * wet * (1 + back) * eta, 1j * w[:, None] * wet * (1 - back) * eta
    velocity = np.stack([along * c, along * s, up], axis=2)
    return np.concatenate([velocity, 1j * w[:, None, None] * velocity, eta[:, :, None]], axis=2)
