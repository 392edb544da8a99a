"""Frequencies that a memory fit leaves out, as no smooth function follows the whole table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.band import inside
from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.checks.repair import irregular
from hydrodae.hdb.checks.smooth import MOST, lone_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.scales import scaled_damping_eigenvalues

#: Weighted error of H outside the band, where frequencies there had to be left out: those beside
#: them, which share what is wrong, remain.
OUTSIDE = 0.3
#: Frequencies above so many times the band may be left out, if so many rows remain.
ABOVE, LEAST_ROWS = (2.0, 1.2), 12
#: Eigenvalue of B below that of the largest, near the band, which no passive fit goes with.
NEGATIVE = -1e-3
#: Vector fits within this share of the target show that a fit can meet it; another choice of
#: frequencies must come nearer by this factor.
REACHED, NEARER = 1.0, 0.85


def rows_left_out(
    database: HydroDatabase,
    moving: Sequence[str],
    band: tuple[float, float],
    options: dict[str, Any],
) -> tuple[NDArray[np.bool_], str]:
    """Return the frequencies (nw,) that a fit leaves out, and a text: none if the table can be met.

    Vector fits of few poles show how near smooth functions come to each choice of `ways_out`. A
    fit of the table as it stands comes first, then the choice that leaves out least; a later one
    must be nearer by 15 %.
    """
    from hydrodae.hdb.memory.reach import reach

    chosen = np.zeros(database.omega.size, bool), ""
    best = reach(database, moving, band=band, **options)
    ways = ways_out(database.select(moving), band)
    if best is None:  # too many coordinates to look at: leave out what breaks a law, no more
        beyond = database.omega > ABOVE[0] * band[1]
        return ways[0] if ways and np.any(beyond & ~ways[0][0]) else chosen
    for bad, text in ways:
        if best <= REACHED:
            break
        tables = database.at_frequencies(~bad)
        found = reach(
            tables, moving, band=band, target_outside=OUTSIDE, worst=NEARER * best, **options
        )
        if found is not None and found < NEARER * best:
            best, chosen = found, (bad, text)
    return chosen


def without_lone_rows(
    database: HydroDatabase, moving: Sequence[str], band: tuple[float, float]
) -> tuple[HydroDatabase, str]:
    """Return the tables without garbled frequencies (`hydrodae.hdb.checks.smooth`), and a text.

    A fit would follow each by a narrow mode that rings.

    Raises
    ------
    DatabaseError
        They are too many in the band.
    """
    bad = np.asarray(lone_rows(database.select(moving)).any(axis=(1, 2)))
    if not bad.any():
        return database, ""
    w, judged = database.omega, inside(database.omega, band)
    where = ", ".join(f"{x:.4g}" for x in w[bad][:6]) + (" ..." if bad.sum() > 6 else "")
    text = (
        f"{bad.sum()} of {bad.size} frequencies ({where} rad/s) off the curve through their "
        f"neighbours"
    )
    if np.count_nonzero(bad & judged) > max(1.0, MOST * np.count_nonzero(judged)):
        raise DatabaseError(
            f"memory fit: {text}: more than {MOST:.0%} of those in the band; what wrote the tables "
            f"failed there: compute them again"
        ).about("frequencies", "lone")
    return database.at_frequencies(~bad), f"{text}: left out"


def ways_out(
    database: HydroDatabase, band: tuple[float, float]
) -> list[tuple[NDArray[np.bool_], str]]:
    """Return frequencies (nw,) that a fit may leave out where it would be refused, and a text.

    First those outside the band that break causality or energy; then also all above twice the band,
    and all above it but a margin: panels may be too coarse there, and A and B, each smooth, need
    not belong to each other.
    """
    w = database.omega
    bad = suspect_rows(database)
    near = w <= ABOVE[0] * band[1]
    if near.sum() >= LEAST_ROWS:
        gives = np.zeros(w.size, bool)
        gives[near] = scaled_damping_eigenvalues(database.at_frequencies(near)) < NEGATIVE
        bad = bad | binary_dilation(gives)
    bad = np.asarray(bad & ~inside(w, band))
    found = []
    if bad.any():
        text = (
            f"{bad.sum()} of {bad.size} frequencies, outside the band, break causality or energy: "
            f"left out"
        )
        found.append((bad, text))
    for ratio in ABOVE:
        gone = bad | (w > ratio * band[1])
        before = found[-1][0] if found else np.zeros(w.size, bool)
        if np.array_equal(gone, before) or np.count_nonzero(~gone & (w >= band[0])) < LEAST_ROWS:
            continue
        text = (
            f"{gone.sum()} of {w.size} frequencies, all above {ratio * band[1]:.3g} rad/s and what "
            f"breaks causality or energy outside the band, do not go with the others: left out"
        )
        found.append((gone, text))
    return found


def cure(database: HydroDatabase, moving: Sequence[str], band: tuple[float, float]) -> str:
    """Return what helps against frequencies in the band that break causality or energy, or "".

    The repair is named only where it leaves fewer than half of them.
    """

    def bad(tables: HydroDatabase) -> int:
        return int((suspect_rows(tables.select(moving)) & inside(tables.omega, band)).sum())

    before = bad(database)
    if not before:
        return ""
    try:
        helps = 2 * bad(irregular(database)[0]) < before
    except DatabaseError:  # too many to interpolate
        helps = False
    repair = "interpolate them (hdb doctor --repair irregular), or " if helps else ""
    return (
        f"{before} of {inside(database.omega, band).sum()} frequencies in the band break causality "
        f"or energy: {repair}compute again with a lid (finer steps where a gap resonates)"
    )
