"""Hulls that bend: the shapes of the modes of a body at the corners of what is drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import RBFInterpolator

from hydrodae.hdb.database.tables import Body as HydroBody
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.support.arrays import Array
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Body

#: Corners of the wetted surface from which a shape is interpolated above the water.
NEIGHBOURS = 24
#: Times that the sides of triangles above the water are halved, so that decks bend.
HALVINGS = 2


def bend(
    body: Body,
    hydro: HydroBody | None,
    known: Sequence[str],
    modes: Sequence[Mapping[str, Any]],
    source: Source,
) -> Body:
    """Return a body whose surface its modes move: x + sum q_k phi_k(x), in its axes.

    Above the water line shapes are those of the water line beneath; on decks they are interpolated
    between corners of the wetted surface.

    Parameters
    ----------
    body : Body
    hydro : HydroBody or None
        The database of which the surface of the body is drawn; None if it is drawn from elsewhere.
    known : sequence of str
        Names of the modes in the database.
    modes : sequence of mappings
        Entries of the case for the modes of the body.
    source : Source
    """
    if not modes:
        return body
    if hydro is None or hydro.mesh is None:
        reason = "the shapes of its modes are not known on what is drawn"
        return replace(body, origin=f"{body.origin}; rigid: {reason}")
    names = {mode["name"]: mode.get("hydro", mode["name"]) for mode in modes}
    kept = [] if hydro.mode_shapes is None else [n for n in names if names[n] in known]
    dry = [name for name in names if name not in kept]
    text = f"{body.origin}; bent by {', '.join(kept)}" if kept else f"{body.origin}; rigid"
    if dry:
        text += f": the database holds no shape of {', '.join(dry)}"
    if not kept:
        return replace(body, origin=text)
    assert hydro.mode_shapes is not None
    shapes = hydro.mode_shapes[[list(known).index(names[name]) for name in kept]]
    above = body.above
    for _ in range(HALVINGS):
        above = _halved(above)
    joined = triangles_of(np.concatenate([hydro.mesh, *shapes], axis=-1))
    below = np.stack(np.split(joined[..., 3:], len(kept), axis=-1))
    return replace(
        body,
        above=above,
        origin=text,
        amplitudes=np.stack([source.values(f"modes/{body.name}.{n}/amplitude") for n in kept], 1),
        shapes=np.concatenate([below, _interpolated(body.surface, below, above)], axis=1),
    )


def _interpolated(surface: Array, shapes: Array, above: Array) -> Array:
    """Shapes (j, k, 3, 3) at triangles (k, 3, 3) above a surface (m, 3, 3) from those on it."""
    if not len(above):
        return np.empty((len(shapes), 0, 3, 3))
    corners = surface.reshape(-1, 3)
    size = float(np.ptp(corners, axis=0).max())
    _, first = np.unique((corners / (1e-5 * size)).round(), axis=0, return_index=True)
    values = shapes.reshape(len(shapes), -1, 3)[:, first].transpose(1, 0, 2)
    places = np.minimum(above.reshape(-1, 3), [np.inf, np.inf, corners[:, 2].max()])
    # linear radial functions without a polynomial: never singular, also on a flat bottom
    field = RBFInterpolator(
        corners[first],
        values.reshape(len(first), -1),
        neighbors=min(NEIGHBOURS, len(first)),
        kernel="linear",
        degree=0,
    )
    found = np.asarray(field(places)).reshape(*above.shape[:2], len(shapes), 3)
    return np.moveaxis(found, 2, 0)


def _halved(triangles: Array) -> Array:
    """Each triangle (3, 3) as four."""
    a, b, c = triangles.transpose(1, 0, 2)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.concatenate([np.stack(part, axis=1) for part in parts])
