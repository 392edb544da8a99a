"""Frequencies that a fit must match where none are given: from the table, whatever its scale."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.memory.vector_fitting import Array

ABOVE_CENTRE = 1.25
"""Upper end of the band over the lowest centre of the damping: beyond the resonance of heave."""
WIDTH = 30.0
"""Upper end of the band over its lower end: slow modes of articulated devices lie there."""
NEGLIGIBLE = 1e-3
"""A coordinate whose largest damping is below this share of the largest of its kind is noise."""
LEAST = 4
"""Frequencies that a band must hold."""


def default_band(omega: Array, damping: Array, labels: Sequence[str]) -> tuple[float, float]:
    """Return the band of a table, in proportion to its frequencies: Froude scaling keeps it.

    The centre of B_ii^2 over the frequencies says where coordinate i radiates. The lowest centre of
    all is that of heave, whose natural frequency is near it; lightly damped resonances and swell
    are below. At full scale the band is about 0.04 to 1 rad/s.

    Parameters
    ----------
    omega : (nw,) array
        rad/s, ascending.
    damping : (nw, n) array
        B_ii, SI.
    labels : sequence of str
        "<body>.<dof>" of the coordinates.

    Returns
    -------
    low, high : float
        rad/s; at least 4 frequencies of the table lie between, if it has as many.
    """
    keep = np.isfinite(omega) & (omega > 0.0)
    omega, square = omega[keep], damping[keep] ** 2
    peak = np.abs(damping[keep]).max(axis=0)
    turns = np.array([label.is_rotation for label in read_labels(labels)])
    largest = np.array([peak[turns == kind].max() for kind in turns])
    radiates = (peak > NEGLIGIBLE * largest) & np.isfinite(peak)
    if omega.size < LEAST or not radiates.any():
        return 0.0, float(omega.max(initial=0.0))
    square = square[:, radiates]
    centre = np.trapezoid(omega[:, None] * square, omega, axis=0) / np.trapezoid(
        square, omega, axis=0
    )
    high = ABOVE_CENTRE * float(centre.min())
    low = high / WIDTH
    first = omega[omega >= low]
    enough = first[LEAST - 1] if first.size >= LEAST else omega[-1]
    return low, max(high, float(enough))
