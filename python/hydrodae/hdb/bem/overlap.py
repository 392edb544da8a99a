"""Bodies that stand in each other: no water flows through what a panel method solves there."""

from __future__ import annotations

from itertools import permutations

import numpy as np

from hydrodae.support.arrays import Array

#: Points are taken so many at a time.
CHUNK = 100
#: Share of the full sphere that a hull fills around a point inside: 1; on the hull: 1/2.
INSIDE = 0.75


def overlapping(hulls: dict[str, Array]) -> tuple[str, str] | None:
    """Return two bodies of which a panel of one, or a corner of it, is inside the other, or None.

    Parameters
    ----------
    hulls : dict of (n, 4, 3) array
        Wetted surfaces below z = 0 by name [m]; the water plane closes them.
    """
    for one, other in permutations(hulls, 2):
        panels, middles = hulls[one], hulls[other].mean(axis=1)
        corners = panels.reshape(-1, 3)
        points = np.concatenate([middles, np.unique(hulls[other].reshape(-1, 3), axis=0)])
        near = np.all((points > corners.min(axis=0)) & (points < corners.max(axis=0)), axis=1)
        if np.any(np.abs(_winding(panels, points[near])) > INSIDE):
            return one, other
    return None


def _winding(panels: Array, points: Array) -> Array:
    """Solid angle over 4 pi (m,) of a hull and its image above the water plane from points (m, 3).

    Triangles: tan(Omega/2) = a.(b x c) / (abc + (a.b)c + (b.c)a + (c.a)b)  (Van Oosterom, Strackee
    1983).
    """
    image = panels[:, ::-1] * np.array([1.0, 1.0, -1.0])
    closed = np.concatenate([panels, image])
    triangles = np.concatenate([closed[:, [0, 1, 2]], closed[:, [0, 2, 3]]])
    found = np.zeros(len(points))
    for start in range(0, len(points), CHUNK):
        seen = triangles[None] - points[start : start + CHUNK, None, None]
        a, b, c = seen[:, :, 0], seen[:, :, 1], seen[:, :, 2]
        la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
        above = np.einsum("pti,pti->pt", a, np.cross(b, c))
        below = la * lb * lc
        for x, y, length in ((a, b, lc), (b, c, la), (c, a, lb)):
            below += np.einsum("pti,pti->pt", x, y) * length
        angle = 2.0 * np.arctan2(above, below)
        found[start : start + CHUNK] = angle.sum(axis=1) / (4.0 * np.pi)
    return found
