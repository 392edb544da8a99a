"""Where the tables break causality or energy: irregular frequencies, gap resonances, bad rows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, median_filter

from hydrodae.hdb.checks.band import Band, damping_sizes, inside
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scaled_damping_eigenvalues, scales
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array

#: A spike is more than this many robust standard deviations of the residual ...
SPREADS = 5.0
#: ... and more than this share of the added mass.
LEAST = 0.01
#: What A may be off by in the band, over its size.
GROSS = 0.5
#: Eigenvalue of the scaled damping below which a row is bad whatever its neighbours say.
NEGATIVE = -0.1
#: Width of the running median that the residual is compared with [frequencies].
WINDOW = 15


def ogilvie_residual(database: HydroDatabase) -> Array:
    """|A(w) + 1/w int K sin(wt) dt - A_inf| over the largest |A|, by coordinate.

    Returns
    -------
    (nw, m) array
        For the m coordinates that radiate (`hydrodae.hdb.database.scales`) [-].
    """
    used = np.flatnonzero(scales(database) > 0.0)
    a = database.added_mass[:, used, used]
    b = database.radiation_damping[:, used, used]
    estimates = irf.added_mass_inf_estimates(database.omega, a, b)
    residual = np.abs(estimates - database.added_mass_inf[used, used])
    return np.asarray(residual / np.abs(a).max(axis=0), dtype=float)


def suspect_rows(database: HydroDatabase) -> NDArray[np.bool_]:
    """Frequencies whose A or B cannot be right: narrow spikes of the Ogilvie residual, B < 0.

    Returns
    -------
    (nw,) array of bool
        Each spike with a neighbour on either side. The last two rows, which depend on what lies
        beyond the table, count only when B is negative there.
    """
    worst = ogilvie_residual(database).max(axis=1, initial=0.0)
    smooth = median_filter(worst, size=min(WINDOW, worst.size), mode="nearest")
    # narrow: above both sides, not the rise towards the end of the table
    at, half = np.arange(worst.size), WINDOW // 2
    left, right = worst[np.maximum(at - half, 0)], worst[np.minimum(at + half, at[-1])]
    spike = worst - np.maximum(smooth, np.maximum(left, right))
    middle = np.median(spike)
    spread = 1.4826 * float(np.median(np.abs(spike - middle)))
    found = spike - middle > max(SPREADS * spread, LEAST)
    found[-2:] = False
    # noise of what hardly damps the device is no reason to drop a frequency
    found |= scaled_damping_eigenvalues(database, damping_sizes(database)) < NEGATIVE
    return np.asarray(binary_dilation(found), dtype=bool)


def bands(omega: Array, mask: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """First and last frequency [rad/s] of every run of True."""
    edges = np.flatnonzero(np.diff(np.r_[False, mask, False].astype(int)))
    return [
        (float(omega[a]), float(omega[b - 1])) for a, b in zip(edges[::2], edges[1::2], strict=True)
    ]


def irregular_findings(database: HydroDatabase, band: Band | None = None) -> list[Finding]:
    """Name the bands of suspect frequencies.

    Parameters
    ----------
    database : HydroDatabase
    band : (low, high), optional
        Frequencies [rad/s] that the device feels: those outside are notes, those inside an error
        where A is off by half of its size, else a warning. Default: all.

    Returns
    -------
    list of Finding
        Empty where no row is suspect.
    """
    mask = suspect_rows(database)
    if not mask.any():
        return []
    found = bands(database.omega, mask)
    shown = ", ".join(f"{a:.3g}..{b:.3g}" for a, b in found[:6])
    text = (
        f"{mask.sum()} of {mask.size} frequencies break causality or energy: {shown}"
        f"{' ...' if len(found) > 6 else ''} rad/s (irregular frequencies or gap resonances; "
        f"a lid removes the former at the source)"
    )
    judged = mask if band is None else mask & inside(database.omega, band)
    if not judged.any():
        text += "; the device does not feel them"
        return [Finding("info", "irregular frequencies", text, float(mask.mean()), found[0][0])]
    residual = ogilvie_residual(database).max(axis=1, initial=0.0)[judged].max()
    first = float(database.omega[judged][0])
    severity = "error" if residual > GROSS else "warning"
    if severity == "error":
        text += "; leave them out (hdb doctor --repair irregular), or --cut below them"
    return [Finding(severity, "irregular frequencies", text, float(mask.mean()), first)]
