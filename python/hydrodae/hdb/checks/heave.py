r"""Damping in heave from a single heading, roughly: A, B and F must have units of one system.

Waves longer than a body lift it alike from all sides, so that Haskind's relation (`energy`) needs
one heading only:

    B_33 = k / (4 rho g c_g) |F_3|^2      within a factor of two or so.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.dispersion import group_velocity, wavenumber
from hydrodae.hdb.findings import Finding

#: Fewest frequencies that a verdict rests on.
FEWEST = 3
#: Longest k times the side of the waterplane, and least share of the largest force.
LONGEST, LEAST_FORCE = 1.5, 0.2
#: Factors that neither the shape nor bodies beside it explain: 20 tables of six codes are within
#: 0.77 and 1.07, but for a body that stands on the ground.
DOUBTFUL, WRONG = 2.0, 10.0


def heave_findings(database: HydroDatabase) -> list[Finding]:
    """Compare the damping in heave of each body with what one heading implies.

    Parameters
    ----------
    database : HydroDatabase

    Returns
    -------
    list of Finding
        One for the body that is farthest off: an error beyond ten times, a warning beyond twice.
    """
    db = database
    if not db.heading.size:
        return []
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    speed = group_velocity(db.omega, db.water_depth, db.gravity)
    factor = k / (4.0 * db.rho * db.gravity * speed)
    clean = ~suspect_rows(db)
    worst = (0.0, "", 0.0)
    for i, label in enumerate(db.coordinates):
        force = np.abs(db.excitation[:, :, i]).mean(axis=1)
        b = db.radiation_damping[:, i, i]
        if not label.endswith(".heave") or force.max() <= 0.0:
            continue
        side = np.sqrt(force.max() / (db.rho * db.gravity))
        used = clean & (k * side < LONGEST) & (force > LEAST_FORCE * force.max())
        used &= b > 0.05 * b[used].max(initial=0.0)
        if used.sum() < FEWEST:
            continue
        ratio = float(np.median(factor[used] * force[used] ** 2 / b[used]))
        if abs(np.log(ratio)) > abs(worst[0]):
            worst = (float(np.log(ratio)), label, ratio)
    if abs(worst[0]) <= np.log(DOUBTFUL):
        return []
    text = (
        f"the force of {worst[1]} in long waves implies {worst[2]:.3g} times its B: are units of A "
        f"and B, or of F, or the density or the frequencies others?"
    )
    severity = "error" if abs(worst[0]) > np.log(WRONG) else "warning"
    return [Finding(severity, "damping from heave force", text, worst[2])]
