"""Surfaces cut off at the still water plane."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from hydrodae.errors import DatabaseError
from hydrodae.hdb.bem.shapes import NoWaterError, hydrostatics
from hydrodae.support.arrays import Array

#: Corners nearer than this share of the surface's length are one.
WELD = 1e-5
_AT_WATER = 1e-9  #: [m]: corners nearer to z = 0 are in it


def cut_at_water(panels: Array) -> Array:
    """Keep what is below z = 0.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Triangles with their last corner repeated.

    Returns
    -------
    (m, 4, 3) array
        Whole panels as they are, and the lower parts of those that cross z = 0, as triangles and
        quadrilaterals of the same sense; none where nothing is below.
    """
    z = np.where(np.abs(panels[..., 2]) <= _AT_WATER, 0.0, panels[..., 2])
    wet = z.max(axis=1) <= 0.0
    crossing = ~wet & (z.min(axis=1) < 0.0)
    parts = [part for panel in panels[crossing] for part in _lower_part(panel)]
    return np.concatenate([panels[wet], np.array(parts, dtype=float).reshape(-1, 4, 3)])


def _lower_part(panel: Array) -> list[Array]:
    """A panel that crosses z = 0, clipped corner by corner (Sutherland and Hodgman, 1974)."""
    corners = panel[:3] if np.allclose(panel[3], panel[2], atol=1e-12) else panel
    kept: list[Array] = []
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        above_a, above_b = a[2] > _AT_WATER, b[2] > _AT_WATER
        if not above_a:
            kept.append(a)
        if above_a != above_b and min(abs(a[2]), abs(b[2])) > _AT_WATER:
            crossing = a + (b - a) * (a[2] / (a[2] - b[2]))
            crossing[2] = 0.0
            kept.append(crossing)
    fan = [np.array([kept[0], kept[1], kept[2], kept[min(3, len(kept) - 1)]])]
    if len(kept) == 5:
        fan.append(np.array([kept[0], kept[3], kept[4], kept[4]]))
    return fan


def _welded(panels: Array) -> Array:
    """Give corners that nearly agree one place, and put those that nearly touch z = 0 there.

    Single precision and meshes whose parts were made apart leave gaps that no water line bears.
    """
    if not len(panels):
        return panels
    points = panels.reshape(-1, 3).copy()
    near = WELD * float(np.ptp(points, axis=0).max())
    points[np.abs(points[:, 2]) <= near, 2] = 0.0
    place, number = np.unique(points, axis=0, return_inverse=True)
    pairs = cKDTree(place).query_pairs(near, output_type="ndarray")
    if len(pairs):
        shape = (len(place), len(place))
        links = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=shape)
        _, group = connected_components(links, directed=False)
        _, first = np.unique(group, return_index=True)
        place = place[first[group]]
    return np.asarray(place[number.ravel()].reshape(panels.shape))


def immersed(panels: Array) -> Array:
    """Cut a surface off at z = 0 and turn its normals into the water.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Closed, or open at or above z = 0.

    Returns
    -------
    (m, 4, 3) array

    Raises
    ------
    DatabaseError
        Nothing of it is in the water, or it has holes.
    """
    panels = _welded(panels)
    below: Array = panels
    if panels[..., 2].max() > 1e-9:
        below = cut_at_water(panels)
        if len(below) == 0:
            raise DatabaseError("the surface is not in the water").about("mesh", "water")
    elif panels[..., 2].min() >= 0.0:
        raise DatabaseError("the surface is not in the water").about("mesh", "water")
    # a lid drawn at the water plane is no part of the hull
    below = np.asarray(below[np.abs(below[..., 2]).max(axis=1) > 1e-9], dtype=float)
    area = np.linalg.norm(np.cross(below[:, 2] - below[:, 0], below[:, 3] - below[:, 1]), axis=1)
    below = below[area > 1e-9 * area.max(initial=0.0)]
    try:
        hydrostatics(below, np.zeros(3))
    except DatabaseError as error:
        below = np.ascontiguousarray(below[:, [1, 0, 3, 2]])
        try:
            hydrostatics(below, np.zeros(3))
        except DatabaseError as other:
            raise (other if isinstance(error, NoWaterError) else error) from None
    return below
