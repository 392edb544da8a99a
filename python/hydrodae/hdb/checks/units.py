"""Units of frequency and damping: A and B must belong to each other."""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.causality import causal_line
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.findings import Finding
from hydrodae.hdb.scales import scales

#: Correlation that a line must have, and factor that is no longer noise.
CORRELATION, FACTOR = 0.98, 2.0
TURN = 2.0 * np.pi


def unit_findings(db: HydroDatabase) -> list[Finding]:
    """Tell if A and B agree only after the frequencies or B are multiplied by a factor.

    Parameters
    ----------
    db : HydroDatabase
        Judged by the coordinates that radiate and whose damping falls within the table, two at
        least.
    """
    used = np.flatnonzero(scales(db) > 0.0)
    tables = (getattr(db, t)[:, used, used] for t in ("added_mass", "radiation_damping"))
    slope, correlation = causal_line(db.omega, *tables)
    clear = correlation > CORRELATION
    if clear.sum() < max(2, 0.4 * slope.size):
        return []
    factor = float(np.median(slope[clear]))
    if 1.0 / FACTOR < factor < FACTOR:
        return []
    text = (
        f"A and B fit each other if B is {factor:.3g} times as large, or the frequencies "
        f"{1.0 / factor:.3g} times: another unit"
    )
    if abs(factor / TURN - 1.0) < 0.15:
        text += " (rad/s taken for Hz?)"
    elif abs(factor * TURN - 1.0) < 0.15:
        text += " (Hz taken for rad/s?)"
    return [Finding("error", "units of frequency", text, factor)]
