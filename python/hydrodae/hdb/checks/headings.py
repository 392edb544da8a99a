"""Forces between the headings of a database: how far interpolation may be off.

The table tests itself: every other heading is left out, and the forces there are interpolated from
the rest, by the rule of runs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.band import Band, inside, largest_of_kind
from hydrodae.hdb.checks.smooth import without_phase
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.relations.headings import Headings
from hydrodae.support.arrays import Array

#: Steps above which headings that cannot test themselves are warned of [rad].
WIDE = np.radians(36.0)
#: Share of the largest force over the headings that is a warning, and that is reported.
MUCH, TOLD = 0.05, 0.01
#: Forces below this share of the largest of their kind vanish by symmetry.
NONE = 0.02


def heading_findings(database: HydroDatabase, band: Band) -> list[Finding]:
    """Report how far forces of waves between the headings may be off, in the band."""
    heading = database.heading
    if heading.size == 0:
        return []
    if heading.size == 1:
        text = f"one heading only, {np.degrees(heading[0]):.4g} deg"
        return [Finding("info", "headings", text)]
    order = np.argsort(heading)
    step = np.diff(heading[order])
    if not np.all(step > 0.0):
        twice = np.degrees(heading[order][int(step.argmin())])
        return [Finding("error", "headings", f"{twice:.4g} deg stands more than once")]
    rule = Headings(heading[order])
    widest = int(step.argmax())
    first, second = np.degrees(heading[order][[widest, widest + 1]])
    between = f"none between {first:.4g} and {second:.4g} deg: forces of waves between them"
    if rule.misses.size == 0:
        least = rule.doubt(0.0)
        if step[widest] <= WIDE and least <= MUCH:
            return []
        known = f", {least:.2g} of their largest off for a body of revolution" if least else ""
        text = f"{between} are interpolated{known}; the headings are too few to judge how well"
        return [Finding("warning", "headings", text, value=float(np.degrees(step[widest])))]
    misses = _misses(database, rule.misses, order)
    judged = np.flatnonzero(inside(database.omega, band))
    if judged.size == 0 or misses.size == 0:
        return []
    row, column = np.unravel_index(misses[judged].argmax(), misses[judged].shape)
    at = int(judged[row])
    share = rule.doubt(float(misses[at, column]))
    if share < TOLD:
        return []
    text = (
        f"{between} may be off by {share:.2g} of their largest ({database.coordinates[column]}), "
        f"as they show where every other heading is left out"
    )
    severity = "warning" if share > MUCH else "info"
    return [Finding(severity, "headings", text, value=share, omega=float(database.omega[at]))]


def _misses(db: HydroDatabase, misses: Array, order: NDArray[np.intp]) -> Array:
    """Largest miss of each force over its largest over the headings, (nw, n)."""
    smooth = without_phase(db)[:, order]
    size = np.abs(smooth).max(axis=1)
    largest = largest_of_kind(db, size)
    missed = np.abs(np.einsum("mh,whc->wmc", misses, smooth)).max(axis=1)
    return np.where(size > NONE * largest, missed / np.maximum(size, 1e-300), 0.0)
