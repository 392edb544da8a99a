"""Closed surfaces of bodies from panels, for the key `mesh` of a case."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.hull.freeboard import walls_and_decks
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.support.arrays import Array

#: Of the size of a surface: corners that are nearer to each other are one.
SAME_PLACE = 1e-6


def closed_surface(panels: ArrayLike, freeboard: float | None = None) -> tuple[Array, list[str]]:
    """Triangles of a closed surface from the panels of a hull.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Whole hull [m], or its wetted part, which is open at z = 0; world axes, reference pose.
    freeboard : float, optional
        Height [m] by which a wetted part is extended straight up. A lid at z = 0 (panels against
        irregular frequencies) is left out before.

    Returns
    -------
    triangles : (m, 3, 3) array
        Normals outwards.
    notes : list of str
        What was changed.

    Raises
    ------
    DatabaseError
        The surface is not closed; the message names a place. Or it encloses nothing.
    """
    p = np.asarray(panels, dtype=float)
    near = SAME_PLACE * float(np.abs(p).max())
    notes = []
    if freeboard is not None:
        lid = np.all(np.abs(p[..., 2]) < near, axis=1)
        if lid.any():
            notes.append(f"left out a lid of {int(lid.sum())} panels at z = 0")
        if lid.all():
            far = p.reshape(-1, 3)[np.abs(p).max(axis=2).argmax()]
            raise DatabaseError(
                "nothing but a lid at z = 0 is left of the surface beside its farthest corner, "
                "({:.6g}, {:.6g}, {:.6g}); is that misplaced?".format(*far)
            ).about("mesh", "places")
        p = p[~lid]
    triangles = triangles_of(p)
    if freeboard is not None:
        more = walls_and_decks(p, freeboard)
        if len(more) == 0:
            raise DatabaseError("the surface has no open water line at z = 0 to extend").about(
                "mesh", "water line"
            )
        triangles = np.concatenate([triangles, more])
        notes.append(f"extended by {freeboard:g} m above z = 0 and closed by a deck")
    _check_closed(triangles, near)
    volume = enclosed_volume(triangles)
    if volume < 0.0:
        triangles = triangles[:, ::-1]
        notes.append("reversed: the normals pointed inwards")
    elif volume == 0.0:
        raise DatabaseError("the surface encloses no volume").about("mesh", "volume")
    return np.asarray(triangles, dtype=float), notes


def enclosed_volume(triangles: Array) -> float:
    """Volume [m3] of a closed surface of (n, 3, 3) triangles; negative with normals inwards."""
    middle = triangles.reshape(-1, 3).mean(axis=0)
    a, b, c = np.moveaxis(triangles - middle, 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def _check_closed(triangles: Array, near: float) -> None:
    """Each edge is passed once in each direction."""
    places = np.round(triangles.reshape(-1, 3) / near)
    _, corner = np.unique(places, axis=0, return_inverse=True)
    corners = corner.reshape(-1, 3)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    count = int(corners.max()) + 1
    there, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    alone = np.setdiff1d(there, back)
    if not alone.size:
        return
    ends = [int(alone[0]) // count, int(alone[0]) % count]
    at = [triangles.reshape(-1, 3)[np.flatnonzero(corner.ravel() == end)[0]] for end in ends]
    text = " and ".join("({:.6g}, {:.6g}, {:.6g})".format(*place) for place in at)
    flat = all(abs(place[2]) < near for place in at)
    advice = (
        "it ends at the water line: extend it by a freeboard"
        if flat
        else "add the missing panels, or turn those whose normals disagree"
    )
    raise DatabaseError(
        f"the surface is not closed: {alone.size} edges lack a neighbour, one of them between "
        f"{text}; {advice}"
    ).about("mesh", "freeboard" if flat else "holes")


def write_stl(triangles: Array, file: Path) -> None:
    """Write (n, 3, 3) triangles [m] as binary STL."""
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    records = np.zeros(len(triangles), dtype=kind)
    records["corners"] = triangles
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    records["normal"] = normal / np.where(size > 0.0, size, 1.0)
    header = b"binary STL".ljust(80) + np.uint32(len(triangles)).tobytes()
    file.write_bytes(header + records.tobytes())
