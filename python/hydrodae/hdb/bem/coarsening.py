"""Meshes of hulls with fewer panels, by fast-simplification (extra `bem`)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.bem.cutting import immersed
from hydrodae.hdb.bem.lids import lid
from hydrodae.hdb.bem.run import WettedBody
from hydrodae.hdb.bem.shapes import hydrostatics
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.support.arrays import Array
from hydrodae.support.extras import install_command

#: Of the volume under water: what coarser panels may change.
MOST_CHANGE = 0.01
_TRIES = 8  #: the simplification and the lid meet a number of panels only nearly


def coarsened(panels: Array, count: int) -> Array:
    """Return a wetted surface with about `count` panels.

    Edges are collapsed in the order of their quadric errors (Garland and Heckbert, Surface
    simplification using quadric error metrics, SIGGRAPH 1997).

    Parameters
    ----------
    panels : (n, 4, 3) array
        Wetted surface [m], its water line at z = 0.
    count : int
        Triangles to be left.

    Returns
    -------
    (m, 4, 3) array
        Triangles with their last corner repeated [m].

    Raises
    ------
    DatabaseError
        fast-simplification is missing, or nothing that encloses water is left.
    """
    simplify = _simplification().simplify
    # double body: its water line is no border, whose corners would move inwards
    triangles = triangles_of(np.concatenate([panels, _reflected(panels)]))
    points, corner = np.unique(triangles.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    # single precision inside: the middle of the hull is the origin, so that no place is lost
    middle = np.append(points[:, :2].mean(axis=0), 0.0)
    places, faces = simplify(
        np.ascontiguousarray(points - middle),
        np.ascontiguousarray(corner.reshape(-1, 3)),
        target_count=2 * max(count, 4),
    )[:2]
    fewer = np.asarray(places, dtype=float)[np.asarray(faces)] + middle
    return immersed(np.concatenate([fewer, fewer[:, 2:]], axis=1))


def _reflected(panels: Array) -> Array:
    """Mirror image across z = 0, its normals out of the body."""
    return np.asarray(panels[:, [0, 3, 2, 1]] * np.array([1.0, 1.0, -1.0]))


def panel_count(body: WettedBody, with_lid: bool) -> int:
    """Return the number of panels of a body, its lid included if there is one."""
    return len(body.panels) + (len(lid(body.panels)) if with_lid else 0)


def fitted(
    bodies: list[WettedBody], meshed: set[str], most: int, with_lid: bool
) -> list[WettedBody]:
    """Return the bodies with coarser meshes, so that all panels and lids are at most `most`.

    Parameters
    ----------
    bodies : list of WettedBody
    meshed : set of str
        Names of the bodies whose panels may be changed.
    most : int
        Panels of all bodies and lids.
    with_lid : bool
        Lids are counted.

    Returns
    -------
    list of WettedBody
        The bodies themselves where they are few enough, or where no mesh may be changed.

    Raises
    ------
    DatabaseError
        fast-simplification is missing, or a mesh cannot be made so coarse.
    """
    hulls = sum(len(body.panels) for body in bodies)
    total = hulls if hulls > most else sum(panel_count(body, with_lid) for body in bodies)
    share, now = 1.0, bodies
    for _ in range(_TRIES):
        if total <= most or not meshed:
            return now
        share *= 0.97 * most / total
        now = [
            replace(
                body, panels=coarsened(body.panels, int(share * len(triangles_of(body.panels))))
            )
            if body.name in meshed
            else body
            for body in bodies
        ]
        total = sum(panel_count(body, with_lid) for body in now)
    raise DatabaseError(
        f"the meshes cannot be coarsened to {most} panels with their lids; {total} are left"
    ).about("mesh", "panels")


def volume_change(before: WettedBody, after: WettedBody) -> float:
    """Return by which share of it the volume under water differs, > 0 where it is larger."""
    old, new = (hydrostatics(b.panels, np.zeros(3)).displaced_volume for b in (before, after))
    return new / old - 1.0


def _simplification() -> Any:
    try:
        import fast_simplification
    except ImportError as error:
        raise DatabaseError(
            f"coarser panels need fast-simplification: {install_command('bem')}; or give a mesh "
            "with fewer panels"
        ).about("software") from error
    return fast_simplification
