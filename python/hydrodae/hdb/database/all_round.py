"""Headings all round: the first again, a full turn on, closes the circle for runs.

Runs look up headings between the first and the last, turned by full turns; without the closing
heading a wave of 355 degrees falls into the gap after 350.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from hydrodae.hdb.database.findings import Finding
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    from hydrodae.hdb.database.database import HydroDatabase

TURN = 2.0 * np.pi
#: Widest gap that is closed [rad]: cos(beta) needs four values around the circle.
WIDEST = 0.5 * np.pi
#: Steps that differ by less are equal (files round degrees), relative.
EQUAL = 1e-2


def goes_round(heading: Array) -> bool:
    """Return whether ascending headings (nh,) [rad] lack just the last step of the circle.

    The gap from the last to the first is at most the largest step between the others, and that at
    most 90 degrees.
    """
    if heading.size < 4:
        return False
    step = float(np.diff(heading).max())
    gap = float(heading[0] + TURN - heading[-1])
    return EQUAL * step < gap <= step * (1.0 + EQUAL) and step <= WIDEST * (1.0 + EQUAL)


def closing_finding(heading: Array) -> Finding:
    """Report which heading was added to headings (nh,) [rad] that go round."""
    first, last, added = np.degrees([heading[0], heading[-1], heading[0] + TURN])
    text = (
        f"{first:.6g} to {last:.6g} deg go all round: {added:.6g} deg, with the forces of "
        f"{first:.6g} deg, closes them"
    )
    return Finding("info", "headings", text)


def closed(database: HydroDatabase) -> HydroDatabase:
    """Return a database whose headings, if they go round, end where they begin."""
    if not goes_round(database.heading):
        return database
    index = np.r_[np.arange(database.heading.size), 0]
    return replace(
        database,
        heading=np.append(database.heading, database.heading[0] + TURN),
        froude_krylov=database.froude_krylov[:, index],
        diffraction=database.diffraction[:, index],
    )
