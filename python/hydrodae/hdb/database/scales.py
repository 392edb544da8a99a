"""Size of each coordinate by its radiation damping: what the checks divide by."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database.tables import Tables
from hydrodae.support.arrays import Array


def scales(database: Tables) -> Array:
    """Size of each coordinate, sqrt(max_w B_ii); 0 where B is negligible among its kind.

    Returns
    -------
    (n,) array
        Zero for coordinates that hardly radiate (yaw of an axisymmetric body, mesh noise).
    """
    peak = np.maximum(np.einsum("wii->wi", database.radiation_damping).max(axis=0), 0.0)
    rotation = np.array([label.is_rotation for label in database.labels])
    for kind in (rotation, ~rotation):
        if kind.any():
            peak[kind & (peak < 1e-5 * peak[kind].max())] = 0.0
    size: Array = np.sqrt(peak)
    return size


def scaled_damping_eigenvalues(database: Tables, sizes: Array | None = None) -> Array:
    """Smallest eigenvalue of B(w)_ij / (s_i s_j) at every frequency; (nw,) [-].

    Parameters
    ----------
    database : HydroDatabase
    sizes : (nw, n) array, optional
        s^2; coordinates with zeros are left out. Default: that of `scales`.
    """
    square = scales(database)[None] ** 2 if sizes is None else sizes
    used = np.all(square > 0.0, axis=0)
    if not used.any():
        return np.zeros(database.omega.size)
    s = np.sqrt(square[:, used])
    b = database.radiation_damping[:, used][:, :, used] / (s[:, :, None] * s[:, None, :])
    return np.asarray(np.linalg.eigvalsh(b)[:, 0], dtype=float)
