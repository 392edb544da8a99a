"""Single values of the excitation that no neighbour bears out: garbled rows, irregular frequencies.

Ogilvie's relation judges A and B; the excitation has no such partner at one heading. It is smooth
in frequency, however: a value is held against the line through its two neighbours.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.band import Band, inside
from hydrodae.hdb.checks.phase import without_phase
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.support.arrays import Array

#: A spike is off its neighbours' line by this share of the force ...
SHARE = 0.1
#: ... and by so many times what the values around it are off theirs.
ALONE = 5.0
#: Values on either side that it is compared with.
AROUND = 6
#: Forces below this share of the largest of their kind vanish by symmetry.
NONE = 1e-3
#: A force is scrambled if half of its values are off by this share of those around them, and if it
#: is this share of the largest of its kind. In tables of five codes the most is 0.16.
SCRAMBLED, COUNTS = 0.4, 0.02
#: Frequencies in the band that it takes to judge that.
ENOUGH = 8


def spikes(database: HydroDatabase) -> Array:
    """Distance from the line through both neighbours, over the force, where that is a spike.

    Returns
    -------
    (nw, nh, n) array
        0 where there is none.
    """
    w, force = database.omega, database.excitation
    off = np.zeros(force.shape)
    if w.size < 2 * AROUND or not force.size:
        return off
    share = ((w[1:-1] - w[:-2]) / (w[2:] - w[:-2]))[:, None, None]
    off[1:-1] = np.abs(force[1:-1] - (1.0 - share) * force[:-2] - share * force[2:])
    size = np.quantile(np.abs(force), 0.9, axis=0)
    turning = np.array([c.endswith(("roll", "pitch", "yaw")) for c in database.coordinates])
    largest = np.where(turning, size[:, turning].max(initial=0), size[:, ~turning].max(initial=0))
    off = np.where(size > NONE * largest, off / np.maximum(size, 1e-300), 0.0)
    others = np.zeros(off.shape)
    for shift in range(2, AROUND + 1):  # neighbours carry half of a spike themselves
        others[shift:] = np.maximum(others[shift:], off[:-shift])
        others[:-shift] = np.maximum(others[:-shift], off[shift:])
    return np.where((off > SHARE) & (off > ALONE * others), off, 0.0)


def spike_findings(database: HydroDatabase, band: Band) -> list[Finding]:
    """Name the largest spike of the excitation; outside the band it is a note."""
    scrambled = _scrambled(database, band)
    found = spikes(database)
    if scrambled or not found.any():
        return scrambled
    judged = found * inside(database.omega, band)[:, None, None]
    severity = "warning" if judged.any() else "info"
    if judged.any():
        found = judged
    at, h, c = (int(i) for i in np.unravel_index(found.argmax(), found.shape))
    text = (
        f"{np.count_nonzero(found)} values of the excitation are off the line through their "
        f"neighbours; most {database.coordinates[c]} at heading "
        f"{np.degrees(database.heading[h]):.4g} deg, by {found[at, h, c]:.2g} of the force: a "
        f"garbled row, or an irregular frequency"
    )
    value = float(found[at, h, c])
    return [Finding(severity, "excitation smooth", text, value, float(database.omega[at]))]


def _scrambled(database: HydroDatabase, band: Band) -> list[Finding]:
    """Name the force whose values follow no line at all: columns that are no amplitude and phase.

    The phase at the body is taken off first: far from the origin it turns fast.
    """
    w, heading = database.omega, database.heading
    judged = inside(w, band)[1:-1]
    if judged.sum() < ENOUGH or not heading.size:
        return []
    force = without_phase(database)
    share = ((w[1:-1] - w[:-2]) / (w[2:] - w[:-2]))[:, None, None]
    off = np.abs(force[1:-1] - (1.0 - share) * force[:-2] - share * force[2:])
    around = np.abs(np.stack([force[:-2], force[1:-1], force[2:]])).max(axis=0)
    typical = np.median((off / np.maximum(around, 1e-300))[judged], axis=0)
    size = np.quantile(np.abs(force), 0.9, axis=0)
    turning = np.array([c.endswith(("roll", "pitch", "yaw")) for c in database.coordinates])
    largest = np.where(turning, size[:, turning].max(initial=0), size[:, ~turning].max(initial=0))
    typical = np.where(size > COUNTS * largest, typical, 0.0)
    h, c = (int(i) for i in np.unravel_index(typical.argmax(), typical.shape))
    if typical[h, c] <= SCRAMBLED:
        return []
    text = (
        f"{database.coordinates[c]} at heading {np.degrees(heading[h]):.4g} deg jumps from "
        f"frequency to frequency, half of its values by more than {typical[h, c]:.2g} of those "
        f"around them: no amplitude and phase of a force, or far too few frequencies"
    )
    return [Finding("warning", "excitation smooth", text, float(typical[h, c]))]
