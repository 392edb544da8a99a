"""The height at which a surface displaces a given volume."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from hydrodae.errors import DatabaseError
from hydrodae.hdb.bem.cutting import immersed
from hydrodae.hdb.bem.shapes import hydrostatics
from hydrodae.support.arrays import Array


def volume_below(panels: Array, shift: float = 0.0) -> float:
    """Volume [m3] under z = 0 of a surface (n, 4, 3) [m] that is raised by `shift` [m].

    Raises
    ------
    DatabaseError
        It has holes below z = 0.
    """
    moved = panels + np.array([0.0, 0.0, shift])
    if moved[..., 2].min() >= -1e-9 * np.ptp(panels[..., 2]):
        return 0.0
    return hydrostatics(immersed(moved), np.zeros(3)).displaced_volume


def shift_to_float(panels: Array, volume: float) -> float:
    """Vertical shift [m] at which a surface displaces a volume.

    Parameters
    ----------
    panels : (n, 4, 3) array
        Closed, or open at or above z = 0 [m].
    volume : float
        [m3].

    Returns
    -------
    float
        The volume under z = 0 grows with the depth: there is one such shift.

    Raises
    ------
    DatabaseError
        It is flat, even the whole surface displaces less, or it has holes and would have to sink.
    """
    low, high = float(panels[..., 2].min()), float(panels[..., 2].max())
    if low == high:
        raise DatabaseError("the mesh is flat: it encloses no volume").about("mesh", "mass")
    deepest = -high
    try:
        most = volume_below(panels, deepest)
    except DatabaseError:  # open at its upper end, which has to stay where it is
        deepest = 0.0
        most = volume_below(panels)
        if most < volume:
            raise
    if most < volume:
        raise DatabaseError(
            f"the whole mesh displaces {most:.5g} m3 only, {volume:.5g} m3 are needed: are its "
            "unit (:scale=0.001 is for millimetres) and the mass right?"
        ).about("mesh", "mass")
    return float(
        brentq(lambda d: volume_below(panels, d) - volume, deepest, -low, xtol=1e-7 * (high - low))
    )
