r"""Hydrostatics of a wetted hull from its panels, by the divergence theorem.

With the normal n out of the body, over the hull below z = 0 (the waterplane adds nothing):

    V = int z n_z dS,  V zB = 1/2 int z^2 n_z dS,  V xB = int x z n_z dS,
    A_w = - int n_z dS,  S_x = - int x n_z dS,  S_xx = - int x^2 n_z dS.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.support.arrays import Array


def mesh_statics(panels: ArrayLike, point: ArrayLike) -> Hydrostatics:
    """Return the hydrostatics of the panels below z = 0.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Corners [m], triangles with their last corner repeated, all turned alike.
    point : (3,) array
        Reference point of the waterplane moments [m].

    Returns
    -------
    Hydrostatics
        Integrals over the flat triangles of the panels, exact.

    Raises
    ------
    DatabaseError
        No panel, none below z = 0, one that crosses it, or no volume.
    """
    corners = np.asarray(panels, dtype=float)
    if not len(corners):
        raise DatabaseError("a mesh without panels").about("mesh", "panels")
    size = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    heights = corners[..., 2]
    if np.any((heights.min(axis=1) < -1e-4 * size) & (heights.max(axis=1) > 1e-4 * size)):
        raise DatabaseError("panels cross the still water z = 0: cut the mesh there").about(
            "mesh", "water line"
        )
    corners = corners[heights.max(axis=1) <= 1e-4 * size]
    corners = corners[corners[..., 2].min(axis=1) < -1e-9 * size]  # no lid
    if not len(corners):
        raise DatabaseError("no panels below the still water z = 0").about("mesh", "water")
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    normal = 0.5 * np.cross(
        triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    )  # times the area
    # three midpoints of sides: exact for polynomials of degree 2
    middle = 0.5 * (triangles + np.roll(triangles, -1, axis=1))
    x, y, z = np.moveaxis(middle, 2, 0)
    weight = normal[:, 2:] / 3.0

    def over(values: Array) -> float:
        return float((values * weight).sum())

    volume = over(z)
    sign = 1.0 if volume > 0.0 else -1.0
    volume *= sign
    if volume <= 0.0:
        raise DatabaseError("the panels enclose no volume below z = 0").about("mesh", "volume")
    center = sign * np.array([over(x * z), over(y * z), 0.5 * over(z**2)]) / volume
    px, py, _ = np.asarray(point, dtype=float)
    u, v = x - px, y - py
    moments = [-sign * over(f) for f in (u, v, u**2, v**2, u * v)]
    area = -sign * over(np.ones_like(z))
    return Hydrostatics(volume, center, area, np.array(moments))
