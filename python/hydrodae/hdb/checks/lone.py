"""Single frequencies whose A or B no neighbour bears out: garbled rows, failed solutions.

H = B + iw (A - A_inf) is smooth in frequency. A value is held against the cubic through the two
neighbours on either side; it is alone in being wrong if these, by cubics that leave it out, are
right. A resonance narrower than the step is no such case: by causality a peak b of B at one
frequency goes with w A of about b/pi and -b/pi at its neighbours.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.band import Band, inside
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.relations.noise import cubic_miss, last_digit
from hydrodae.support.arrays import Array, Complex

#: A value is off by this share of H around it, and by so many times what its neighbours are.
SHARE, ALONE = 0.01, 6.0
#: Neighbours on either side that are judged without it.
AROUND = 3
#: Largest miss of a cubic by rounding, over the last digit: (1 + 2/6 + 4/3) / 2 for equal steps.
ROUNDING = 1.34
#: Share of the frequencies in the band that may be left out of a fit.
MOST = 0.05


def lone_rows(database: HydroDatabase) -> Array:
    """Distance of H from the cubic through its neighbours, over H, where that frequency is alone.

    Returns
    -------
    (nw, m, m) array
        Of the m coordinates that radiate; 0 where nothing is wrong, and for the first and last two
        frequencies, which have too few neighbours.
    """
    used = np.flatnonzero(scales(database) > 0.0)
    found = np.zeros((database.omega.size, used.size, used.size))
    if database.omega.size < 4 * AROUND or not used.size:
        return found
    square = np.ix_(np.arange(database.omega.size), used, used)
    w = database.omega
    mass = database.added_mass - database.added_mass_inf
    h = database.radiation_damping[square] + 1j * w[:, None, None] * mass[square]
    own = np.abs(np.einsum("wii->wi", h))
    local = np.median(np.stack([np.roll(own, s, axis=0) for s in range(-3, 4)]), axis=0)
    size = np.sqrt(local[:, :, None] * local[:, None, :])
    size[size <= 0.0] = np.inf
    # four neighbours and the value itself, each off by half of the last digit that the table has
    digits = [last_digit(t[square]) for t in (database.radiation_damping, database.added_mass)]
    floor = ROUNDING * (digits[0] + w[:, None, None] * digits[1])
    off = np.zeros(found.shape)
    off[2:-2] = np.maximum(cubic_miss(w, h) - floor[2:-2], 0.0) / size[2:-2]
    worst = off.max(axis=(1, 2))
    kept = np.ones(w.size, dtype=bool)
    for at in np.argsort(worst)[::-1]:
        if worst[at] <= SHARE:
            break
        if not kept[max(at - 2, 0) : at + 3].all():
            continue  # its distance is that of the one beside it; several together are not alone
        i, j = np.unravel_index(off[at].argmax(), off[at].shape)
        if _alone(w, h[:, i, j], kept, int(at), float(_off_at(w, h[:, i, j], int(at)))):
            found[at] = off[at]
            kept[at] = False
    return found


def _off_at(w: Array, h: Complex, at: int) -> float:
    """Distance of one value of h (nw,) from the cubic through its neighbours."""
    near = slice(at - 2, at + 3)
    return float(cubic_miss(w[near], h[near])[0])


def _alone(w: Array, h: Complex, kept: NDArray[np.bool_], at: int, off: float) -> bool:
    """Return whether the neighbours of a value that is `off` are right without it."""
    others = np.flatnonzero(kept)
    others = others[others != at]
    place = int(np.searchsorted(others, at))
    near = others[max(place - AROUND - 2, 0) : place + AROUND + 2]
    if near.size < 2 * AROUND:
        return False
    return off > ALONE * float(cubic_miss(w[near], h[near]).max())


def lone_findings(database: HydroDatabase, band: Band) -> list[Finding]:
    """Name the frequencies whose A or B is off the curve through its neighbours."""
    found = lone_rows(database)
    if not found.any():
        return []
    used = np.flatnonzero(scales(database) > 0.0)
    rows = np.flatnonzero(found.any(axis=(1, 2)))
    judged = rows[inside(database.omega[rows], band)]
    severity = "warning" if judged.size else "info"
    shown = judged if judged.size else rows
    at = int(shown[found[shown].max(axis=(1, 2)).argmax()])
    i, j = np.unravel_index(found[at].argmax(), found[at].shape)
    pair = f"{database.coordinates[used[i]]} by {database.coordinates[used[j]]}"
    where = ", ".join(f"{w:.4g}" for w in database.omega[shown][:6])
    text = (
        f"A or B is off the curve through its neighbours at {shown.size} of "
        f"{database.omega.size} frequencies ({where}{' ...' if shown.size > 6 else ''} rad/s), by "
        f"{found[at, i, j]:.2g} of H, {pair}: a garbled row, or an irregular frequency; "
        f"fits leave them out"
    )
    value = float(found[at, i, j])
    return [Finding(severity, "A and B smooth", text, value, float(database.omega[at]))]
