"""Single values that no neighbour bears out: garbled rows, failed solutions, irregular frequencies.

H = B + iw (A - A_inf) is smooth in frequency, and so are forces without the phase of the waves at
the bodies. A value is held against the cubic through the two neighbours on either side; it is alone
in being wrong if these, by cubics that leave it out, are right. A resonance narrower than the step
is no such case: by causality a peak b of B at one frequency goes with w A of about b/pi and -b/pi
at its neighbours.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.band import Band, inside, largest_of_kind
from hydrodae.hdb.checks.shapes import phase
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.hdb.relations.noise import last_digit, miss
from hydrodae.support.arrays import Array, Complex

#: A value is off by so many times what its neighbours are.
ALONE = 6.0
#: Neighbours on either side that are judged without it.
AROUND = 3
#: Least share of H that counts, and of a force: tables of forces have coarser steps for their
#: phase than H has.
SHARE, SHARE_OF_FORCE = 0.01, 0.1
#: Forces below this share of the largest of their kind vanish by symmetry.
NONE = 1e-3
#: A force is scrambled if half of its values are off by this share of those around them, and if it
#: is this share of the largest of its kind. In tables of five codes the most is 0.16.
SCRAMBLED, COUNTS = 0.4, 0.02
#: Frequencies in the band that it takes to judge that.
ENOUGH = 8
#: Share of the frequencies in the band that may be left out of a fit.
MOST = 0.05


def without_phase(database: HydroDatabase) -> Complex:
    """F e^{i k.x}, (nw, nh, n) [N/m, N m/m], x where each body floats (the origin if unknown)."""
    k = wavenumber(database.omega, database.water_depth, database.gravity)
    turns = {name: phase(database, name, k) for name in database.bodies}
    return database.excitation * np.stack([turns[c.body] for c in database.labels], axis=-1)


def alone(
    omega: Array, values: Complex, size: Array, digit: Array, share: float, beside: int = 0
) -> Array:
    """Distances of values (nw, m) from the cubic through their neighbours, where they are alone.

    Parameters
    ----------
    omega : (nw,) array
    values, size, digit : (nw, m) arrays
        The values, what distances are divided by, and the last digit that each has.
    share : float
        Distances of less are none.
    beside : int
        Values on either side that may be off with it: an irregular frequency of the forces reaches
        those. Those of H have a partner there by causality, and are held to more.

    Returns
    -------
    (nw, m) array
        0 where nothing is wrong, and for the first and last two frequencies, which have too few
        neighbours.
    """
    found = np.zeros(values.shape)
    if omega.size < 4 * AROUND or not values.size:
        return found
    distance, weights = miss(omega, values, 4)
    # four neighbours and the value itself, each off by half of the last digit
    floor = 0.5 * digit[2:-2] * (1.0 + np.abs(weights).sum(axis=1))[:, None]
    off = np.zeros(values.shape)
    off[2:-2] = np.maximum(np.abs(distance) - floor, 0.0) / size[2:-2]
    worst = off.max(axis=1)
    kept = np.ones(omega.size, dtype=bool)
    for at in np.argsort(worst)[::-1]:
        if worst[at] <= share:
            break
        if not kept[max(at - 2, 0) : at + 3].all():
            continue  # its distance is that of the one beside it; several together are not alone
        column = int(off[at].argmax())
        out = slice(max(at - beside, 0), at + beside + 1)
        if _is_alone(omega, values[:, column], kept, out, abs(distance[at - 2, column])):
            found[at] = off[at]
            kept[at] = False
    return found


def _is_alone(w: Array, values: Complex, kept: NDArray[np.bool_], out: slice, off: float) -> bool:
    """Return whether the neighbours of values, one of them `off`, are right without these."""
    used = kept.copy()
    used[out] = False
    others = np.flatnonzero(used)
    place = int(np.searchsorted(others, out.start))
    near = others[max(place - AROUND - 2, 0) : place + AROUND + 2]
    if near.size < 2 * AROUND:
        return False
    return off > ALONE * float(np.abs(miss(w[near], values[near], 4)[0]).max())


def lone_rows(database: HydroDatabase) -> Array:
    """Distance of H from the cubic through its neighbours, over H, where that frequency is alone.

    Returns
    -------
    (nw, m, m) array
        Of the m coordinates that radiate; see `alone`.
    """
    w, used = database.omega, np.flatnonzero(scales(database) > 0.0)
    square = np.ix_(np.arange(w.size), used, used)
    turn = w[:, None, None]
    b, a = database.radiation_damping[square], database.added_mass[square]
    h = b + 1j * turn * (a - database.added_mass_inf[np.ix_(used, used)])
    own = np.abs(np.einsum("wii->wi", h))
    local = np.median(np.stack([np.roll(own, s, axis=0) for s in range(-3, 4)]), axis=0)
    size = np.sqrt(local[:, :, None] * local[:, None, :])
    size[size <= 0.0] = np.inf
    digit = last_digit(b) + turn * last_digit(a)
    flat = (w.size, used.size**2)
    found = alone(w, h.reshape(flat), size.reshape(flat), digit.reshape(flat), SHARE)
    return found.reshape(h.shape)


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


def spike_findings(database: HydroDatabase, band: Band) -> list[Finding]:
    """Name the largest spike of the excitation; outside the band it is a note.

    A force whose values follow no curve at all is named in its place: columns that are no amplitude
    and phase.
    """
    w, force = database.omega, without_phase(database)
    if not force.size:
        return []
    size = np.quantile(np.abs(force), 0.9, axis=0)
    largest = largest_of_kind(database, size.max(axis=0))
    scrambled = _scrambled(database, band, force, size > COUNTS * largest)
    if scrambled:
        return scrambled
    shown = size > NONE * largest
    whole = np.broadcast_to(np.where(shown, size, np.inf), force.shape).reshape(w.size, -1)
    digit = last_digit(database.excitation.real) + last_digit(database.excitation.imag)
    digits = np.broadcast_to(digit, force.shape).reshape(w.size, -1)
    found = alone(w, force.reshape(w.size, -1), whole, digits, SHARE_OF_FORCE, beside=1)
    found = found.reshape(force.shape)
    found[found <= SHARE_OF_FORCE] = 0.0
    if not found.any():
        return []
    judged = found * inside(w, band)[:, None, None]
    severity = "warning" if judged.any() else "info"
    if judged.any():
        found = judged
    at, h, c = (int(i) for i in np.unravel_index(found.argmax(), found.shape))
    text = (
        f"{np.count_nonzero(found)} values of the excitation are off the curve through their "
        f"neighbours; most {database.coordinates[c]} at heading "
        f"{np.degrees(database.heading[h]):.4g} deg, by {found[at, h, c]:.2g} of the force: a "
        f"garbled row, or an irregular frequency"
    )
    return [Finding(severity, "excitation smooth", text, float(found[at, h, c]), float(w[at]))]


def _scrambled(
    database: HydroDatabase, band: Band, force: Complex, counts: NDArray[np.bool_]
) -> list[Finding]:
    """Name the force that is off the line through both neighbours from frequency to frequency."""
    judged = inside(database.omega, band)[1:-1]
    if judged.sum() < ENOUGH:
        return []
    around = np.abs(np.stack([force[:-2], force[1:-1], force[2:]])).max(axis=0)
    off = np.abs(miss(database.omega, force, 2)[0]) / np.maximum(around, 1e-300)
    typical = np.where(counts, np.median(off[judged], axis=0), 0.0)
    h, c = (int(i) for i in np.unravel_index(typical.argmax(), typical.shape))
    if typical[h, c] <= SCRAMBLED:
        return []
    text = (
        f"{database.coordinates[c]} at heading {np.degrees(database.heading[h]):.4g} deg jumps "
        f"from frequency to frequency, half of its values by more than {typical[h, c]:.2g} of "
        f"those around them: no amplitude and phase of a force, or far too few frequencies"
    )
    return [Finding("warning", "excitation smooth", text, float(typical[h, c]))]
