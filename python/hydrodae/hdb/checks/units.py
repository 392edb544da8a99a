"""Units of frequency and damping: A and B must belong to each other."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.relations.causality import causal_line, causal_slope
from hydrodae.support.arrays import Array

#: Correlation that a line must have, and factor that is no longer noise.
CORRELATION, FACTOR = 0.98, 2.0
#: Standard error of a slope over it, and the slope that no noise makes, where the tail is free.
SURE, GROSS = 0.05, 4.0
TURN = 2.0 * np.pi


def unit_findings(db: HydroDatabase) -> list[Finding]:
    """Return whether A and B agree only with other frequencies, or with B multiplied by a factor.

    Parameters
    ----------
    db : HydroDatabase
        Judged by the coordinates that radiate and whose damping falls within the table, two at
        least.
    """
    used = np.flatnonzero(scales(db) > 0.0)
    a, b = (getattr(db, t)[:, used, used] for t in ("added_mass", "radiation_damping"))
    slope, correlation = causal_line(db.omega, a, b)
    clear = correlation > CORRELATION
    turned = [(turn / db.omega[::-1], a[::-1], b[::-1]) for turn in (TURN, TURN**2)]
    if not clear.any() and any(_agree(*tables) for tables in turned):
        text = "A and B do not belong to each other in this order of the frequencies"
        return [Finding("error", "units of frequency", text)]
    if clear.sum() < max(2, 0.4 * slope.size):
        # tables that end before B falls, or of one coordinate
        slope, error = causal_slope(db.omega, a, b)
        clear = error < SURE * np.abs(slope)
        wrong = clear & ((np.abs(slope) > GROSS) | (np.abs(slope) < 1.0 / GROSS))
        if not wrong.any() or wrong.sum() < 0.6 * used.size:
            return []
    factor = float(np.median(slope[clear]))
    text = f"A and B fit each other if B is {factor:.3g} times as large"
    severity = "info" if 1.0 / FACTOR < factor < FACTOR else "error"
    return [Finding(severity, "units of frequency", text, factor)]


def _agree(omega: Array, a: Array, b: Array) -> bool:
    """Return whether at least two coordinates have A and B that belong to each other."""
    slope, correlation = causal_line(omega, a, b)
    right = (correlation > CORRELATION) & (1.0 / FACTOR < slope) & (slope < FACTOR)
    return bool(right.sum() >= 2)
