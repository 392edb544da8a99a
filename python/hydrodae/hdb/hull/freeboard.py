"""What stands above the water line of a wetted surface, which ends there."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.support.arrays import Array

#: Height of what is drawn, over the draught.
PART = 0.15


def freeboard(panels: ArrayLike, height: float | None = None) -> Array:
    """Extend a wetted surface straight up from its water line, and close it.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface [m], open at z = 0.
    height : float, optional
        Of the extension [m]; by default 0.15 of the draught.

    Returns
    -------
    (m, 3, 3) array
        Walls, and decks where a water line encloses no other one; empty for a submerged body.
    """
    p = np.asarray(panels, dtype=float)
    walls, loops = _extended(p, -PART * float(p[..., 2].min()) if height is None else height)
    decks = [_deck(loop) for loop in loops if not _encloses(loop, loops)]
    return np.concatenate([walls, *(_upwards(deck) for deck in decks)])


def walls_and_decks(panels: ArrayLike, height: float) -> Array:
    """Extend a wetted surface and close it, for integrals over the surface.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface [m], open at z = 0.
    height : float
        Of the extension [m].

    Returns
    -------
    (m, 3, 3) array
        Walls, and a deck for each water line. The deck of an inner one (a moonpool) faces down and
        takes back what the deck of the outer one covers too much.
    """
    walls, loops = _extended(np.asarray(panels, dtype=float), height)
    return np.concatenate([walls, *map(_deck, loops)])


def _extended(panels: Array, height: float) -> tuple[Array, list[Array]]:
    """Walls (m, 3, 3) above the water line, and its loops (k, 3) at their top."""
    draught = -float(panels[..., 2].min())
    edges = _water_line(panels, 1e-6 * max(draught, 1e-300))
    if len(edges) == 0 or height <= 0.0:
        return np.empty((0, 3, 3)), []
    top = edges + np.array([0.0, 0.0, height])
    # the panel below runs along the edge; its neighbour above runs the other way
    walls = np.stack([edges[:, 1], edges[:, 0], top[:, 0], top[:, 1]], axis=1)
    return triangles_of(walls), _loops(top)


def _water_line(panels: Array, tolerance: float) -> Array:
    """Edges (m, 2, 3) at z = 0 that belong to one panel only, in its direction."""
    start, end = panels.reshape(-1, 3), np.roll(panels, -1, axis=1).reshape(-1, 3)
    flat = (np.abs(start[:, 2]) < tolerance) & (np.abs(end[:, 2]) < tolerance)
    flat &= np.linalg.norm(end - start, axis=1) > tolerance
    edges = np.stack([start[flat], end[flat]], axis=1)
    ends = [frozenset(map(tuple, np.round(e[:, :2] / tolerance / 10.0))) for e in edges]
    counts: dict[frozenset[tuple[float, ...]], int] = {}
    for pair in ends:
        counts[pair] = counts.get(pair, 0) + 1
    return edges[[counts[pair] == 1 for pair in ends]]


def _loops(edges: Array) -> list[Array]:
    """Closed polygons (k, 3) of edges (m, 2, 3); what does not close is left out."""
    size = float(np.ptp(edges.reshape(-1, 3), axis=0).max())

    def key(point: Array) -> tuple[float, ...]:
        return tuple(np.round(point / (1e-6 * size)))

    following = {key(edge[0]): edge for edge in edges}
    loops = []
    while following:
        first, edge = following.popitem()
        loop = [edge[0]]
        while key(edge[1]) in following:
            edge = following.pop(key(edge[1]))
            loop.append(edge[0])
        if key(edge[1]) == first and len(loop) > 2:
            loops.append(np.array(loop))
    return loops


def _deck(loop: Array) -> Array:
    """Fan of triangles about the middle of a polygon, which runs along it against the walls."""
    middle = np.broadcast_to(loop.mean(axis=0), loop.shape)
    return np.stack([np.roll(loop, -1, axis=0), loop, middle], axis=1)


def _upwards(fan: Array) -> Array:
    turn = np.cross(fan[:, 1] - fan[:, 0], fan[:, 2] - fan[:, 0])[:, 2].sum()
    return np.asarray(fan if turn > 0.0 else fan[:, ::-1], dtype=float)


def _encloses(loop: Array, loops: list[Array]) -> bool:
    """Whether another polygon lies inside this one, or around it: a ring has no plain deck."""
    low, high = loop.min(axis=0)[:2], loop.max(axis=0)[:2]
    for other in loops:
        if other is loop:
            continue
        least, most = other.min(axis=0)[:2], other.max(axis=0)[:2]
        if np.all(low <= least) and np.all(most <= high):
            return True
        if np.all(least <= low) and np.all(high <= most):
            return True
    return False
