r"""How A and B belong to each other, whatever A at infinite frequency is.

Ogilvie's relation A(w) = A_inf - I(w), I = 1/w int K(t) sin(wt) dt, is a line of slope 1 through
the points (-I, A). Where w is stated c times too large, or B c times too small, its slope is c.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae import irf

Array = NDArray[np.float64]
#: Fewest frequencies, and largest B at the end of the table over its peak, that a verdict needs.
FEWEST, UNFINISHED = 16, 0.3


def causal_line(omega: Array, a: Array, b: Array) -> tuple[Array, Array]:
    """Slope of A against -I, and the correlation of the two.

    Parameters
    ----------
    omega : (nw,) array
        Frequencies > 0, ascending [rad/s].
    a, b : (nw, m) arrays
        Diagonal entries, in units that belong together.

    Returns
    -------
    slope, correlation : (k,) arrays
        Of the k entries that tell: their damping falls within the table. None of a short table.
    """
    empty = np.zeros(0)
    if omega.size < FEWEST:
        return empty, empty
    falls = np.abs(b[-1]) < UNFINISHED * np.abs(b).max(axis=0)
    falls &= np.abs(b).max(axis=0) > 0.0
    if not falls.any():
        return empty, empty
    a, b = a[:, falls], b[:, falls]
    inner = omega < 0.7 * omega[-1]
    integral = (irf.added_mass_inf_estimates(omega, a, b) - a)[inner]
    x, y = integral - integral.mean(axis=0), a[inner] - a[inner].mean(axis=0)
    product, square = -(x * y).sum(axis=0), (x**2).sum(axis=0)
    size = np.sqrt(square * (y**2).sum(axis=0))
    square[square <= 0.0] = size[size <= 0.0] = np.inf
    return product / square, product / size
