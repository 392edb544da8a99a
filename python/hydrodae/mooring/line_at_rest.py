"""One elastic mooring line at rest, by the same equations as forces of type `catenary`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydrodae import _core
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Catenary:
    """A line at rest between an anchor and a fairlead, in one vertical plane.

    Attributes
    ----------
    horizontal, vertical : float
        Pull of the line on the fairlead, towards the anchor and downwards [N].
    tension, tension_anchor : float
        Tension at the fairlead and at the anchor [N].
    on_seabed : float
        Unstretched length that lies on the seabed [m].
    stiffness : array (2, 2)
        d(horizontal, vertical) / d(x, z) of the fairlead [N/m].
    out_of_plane : float
        Stiffness across the plane of the line, horizontal / x [N/m].
    s, x, z, tension_along : array (n,)
        Unstretched length from the anchor, place from there [m] and tension [N] along the line.
    """

    horizontal: float
    vertical: float
    tension: float
    tension_anchor: float
    on_seabed: float
    stiffness: Array
    out_of_plane: float
    s: Array
    x: Array
    z: Array
    tension_along: Array

    @property
    def stiffness_xyz(self) -> Array:
        """Stiffness (3, 3) of the fairlead: away from the anchor, across, upwards [N/m]."""
        out = np.zeros((3, 3))
        out[np.ix_([0, 2], [0, 2])] = self.stiffness
        out[1, 1] = self.out_of_plane
        return out


def catenary(
    x: float,
    z: float,
    length: float | Sequence[float],
    weight: float | Sequence[float],
    stiffness: float | Sequence[float],
    *,
    loads: Sequence[float] = (),
    dry_weight: float | Sequence[float] | None = None,
    dry_loads: Sequence[float] = (),
    surface: float = math.inf,
    seabed: bool = True,
    friction: float = 0.0,
    n: int = 101,
) -> Catenary:
    """Find the forces and the shape of an elastic line at rest.

    Parameters
    ----------
    x, z : float
        Place of the fairlead from the anchor, horizontally and upwards [m].
    length, weight, stiffness : float or sequence
        Unstretched length [m], weight in water per unstretched length [N/m] and axial stiffness EA
        [N] of each part, from the anchor up.
    loads : sequence, optional
        Weights in water of what hangs between the parts [N]; negative: buoys.
    dry_weight, dry_loads : float or sequence, optional
        Weights out of the water of the parts [N/m], and of what hangs between them [N], which are
        spheres at the surface. By default as in water, zero where they float.
    surface : float
        Height of the surface of the water over the anchor [m]; by default all is deep in the water.
    seabed : bool
        Whether a flat seabed at the height of the anchor carries the line.
    friction : float
        Friction coefficient of the seabed.
    n : int
        Number of points of the profile, evenly along the line.

    Raises
    ------
    CaseError
        If the numbers make no line.

    Notes
    -----
    Closed forms of Irvine, Cable Structures (1981), with seabed friction after Jonkman,
    NREL/TP-500-41958 (2007).
    """
    lengths, weights, stiffnesses, dry = (
        np.atleast_1d(np.asarray(v, dtype=float)).tolist()
        for v in (length, weight, stiffness, () if dry_weight is None else dry_weight)
    )
    s = np.linspace(0.0, sum(lengths), n)
    held, shape = _core.catenary(
        x,
        z,
        lengths,
        weights,
        stiffnesses,
        list(loads),
        dry,
        list(dry_loads),
        surface,
        seabed,
        friction,
        s.tolist(),
    )
    return Catenary(
        horizontal=held.horizontal,
        vertical=held.vertical,
        tension=held.tension,
        tension_anchor=float(np.hypot(held.anchor_horizontal, held.anchor_vertical)),
        on_seabed=held.on_seabed,
        stiffness=held.stiffness,
        out_of_plane=held.out_of_plane,
        s=shape[0],
        x=shape[1],
        z=shape[2],
        tension_along=shape[3],
    )
