r"""How A and B belong to each other, whatever A at infinite frequency is.

Ogilvie's relation A(w) = A_inf - I(w), I = 1/w int K(t) sin(wt) dt, is a line of slope 1 through
the points (-I, A). Where w is stated c times too large, or B c times too small, its slope is c.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array

#: Fewest frequencies, and largest B at the end of the table over its peak, that a verdict needs.
FEWEST, UNFINISHED = 16, 0.3
#: Share of the table, and fewest frequencies there, that a slope with a free tail rests on.
INNER, FEWEST_INNER = 0.75, 9


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
        Of the k entries whose damping falls within the table. None of a short table.
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


def causal_slope(omega: Array, a: Array, b: Array) -> tuple[Array, Array]:
    """Slope of A against -I with what lies beyond the table free, and its standard error.

    B beyond the table adds to I(w) a smooth function, sum_k m_k w^{2k}: four of its terms are
    unknowns beside the slope. So tables that end before B falls can be judged, too.

    Parameters
    ----------
    omega, a, b
        As in `causal_line`.

    Returns
    -------
    slope, error : (m,) arrays
        None of a table of fewer than 12 frequencies.
    """
    inner = omega < INNER * omega[-1]
    if np.count_nonzero(inner) < FEWEST_INNER:
        return np.zeros(0), np.zeros(0)
    integral = irf.added_mass_inf_estimates(omega, a, b, tail=False) - a
    u = (omega[inner] / omega[-1]) ** 2
    slopes, errors = [], []
    for column, values in zip(integral[inner].T, a[inner].T, strict=True):
        size = np.abs(column).max(initial=0.0)
        if size <= 0.0:
            continue
        design = np.stack([-column / size, np.ones_like(u), u, u**2, u**3], axis=1)
        found, _, rank, _ = np.linalg.lstsq(design, values, rcond=None)
        if rank < design.shape[1]:
            continue
        rest = values - design @ found
        variance = float(rest @ rest) / (u.size - design.shape[1])
        variance *= float(np.linalg.inv(design.T @ design)[0, 0])
        slopes.append(found[0] / size)
        errors.append(np.sqrt(max(variance, 0.0)) / size)
    return np.array(slopes), np.array(errors)
