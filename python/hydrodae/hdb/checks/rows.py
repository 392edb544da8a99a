"""Rows that no water makes: added masses of zero or less, no damping at all; and what stays open.

A table that lost a row, or a sign, reads as a device that moves without water there.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.motions import FEWEST, LONGEST
from hydrodae.hdb.checks.shapes import length
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array

#: Added mass of a translation over the largest one of its body that is a row left out.
EMPTY = 1e-9
#: Share of the largest added mass of its kind from which a negative one is no noise.
NOISE = 0.05
#: Change of A over the frequencies, as a share of the largest, that takes damping: of some motion,
#: and of a single one, whose B may be too small for the digits of a file.
CHANGES, MAKES_WAVES = 1e-3, 0.01
#: Added masses of surge and sway this near each other are those of a body as long as wide.
ROUND = 0.05


def row_findings(database: HydroDatabase) -> list[Finding]:
    """Judge the diagonals of A and B, and report what cannot be checked without forces of waves.

    Returns
    -------
    list of Finding
        Errors for translations without added mass or damping, for rotations without where another
        one has it, for negative added masses and for tables without damping; a warning where there
        is no excitation.
    """
    return [
        *_empty(database),
        *_turns(database),
        *_signs(database),
        *_damping(database),
        *_open(database),
    ]


def _empty(db: HydroDatabase) -> list[Finding]:
    largest = np.abs(np.einsum("wii->wi", db.added_mass)).max(axis=0)
    held, found = standing(db), []
    for body in db.bodies:
        going = [i for i, c in enumerate(db.labels) if c.body == body and c.is_translation]
        top = max((largest[i] for i in going), default=0.0)
        lost = [db.coordinates[i] for i in going if largest[i] <= EMPTY * top]
        if lost and body not in held:
            text = f"A of {', '.join(lost)} is zero at all frequencies: are rows missing?"
            found.append(Finding("error", "added mass of zero", text))
    return found


def _signs(db: HydroDatabase) -> list[Finding]:
    middle = np.median(np.einsum("wii->wi", db.added_mass), axis=0)
    lowest = np.maximum(middle, np.diag(db.added_mass_inf))
    goes = np.array([label.is_translation for label in db.labels])
    # where B has the wrong sign as well, that is reported of B
    told = np.median(np.einsum("wii->wi", db.radiation_damping), axis=0) < 0.0
    wrong = []
    for kind in (goes, ~goes):
        size = np.abs(middle[kind]).max(initial=0.0)
        wrong += [int(i) for i in np.flatnonzero(kind & ~told & (lowest < -NOISE * size))]
    if not wrong:
        return []
    names = ", ".join(db.coordinates[i] for i in sorted(wrong))
    text = f"A of {names} is negative: water that is moved by a body adds to its mass"
    return [Finding("error", "sign of A", text, float(len(wrong)))]


def _damping(db: HydroDatabase) -> list[Finding]:
    a = np.einsum("wii->wi", db.added_mass)
    size = np.abs(a).max(axis=0)
    if np.any(db.radiation_damping):
        still = ~np.any(np.einsum("wii->wi", db.radiation_damping), axis=0)
        still &= np.ptp(a, axis=0) > MAKES_WAVES * size
        top = {body: max(_sizes(db, size, body), default=0.0) for body in db.bodies}
        names = [
            str(label)
            for i, label in enumerate(db.labels)
            if still[i] and label.is_translation and size[i] > NOISE * top[label.body]
        ]
        if not names:
            return []
        text = (
            f"B of {', '.join(names)} is zero throughout, and A is not the same at all "
            f"frequencies: are rows missing?"
        )
        return [Finding("error", "damping of zero", text)]
    changes = np.ptp(a, axis=0) > CHANGES * size
    severity = "error" if changes.any() else "warning"
    text = "B is zero throughout, and A is not the same at all frequencies: a column is missing"
    if severity == "warning":
        text = "B is zero throughout: nothing here makes waves"
    return [Finding(severity, "damping of zero", text)]


def _sizes(db: HydroDatabase, size: Array, body: str) -> list[float]:
    """Largest added masses of the translations of a body."""
    own = zip(db.labels, size, strict=True)
    return [float(s) for label, s in own if label.body == body and label.is_translation]


def _turns(db: HydroDatabase) -> list[Finding]:
    """Report bodies that roll without water and pitch with it, or the other way round."""
    at = {label: i for i, label in enumerate(db.coordinates)}
    largest = np.abs(np.einsum("wii->wi", db.added_mass)).max(axis=0)
    held, found = standing(db), []
    for body in db.bodies:
        labels = [f"{body}.{motion}" for motion in ("surge", "sway", "roll", "pitch")]
        if body in held or any(label not in at for label in labels):
            continue
        surge, sway, roll, pitch = (float(largest[at[label]]) for label in labels)
        if min(roll, pitch) > EMPTY * max(roll, pitch) or max(roll, pitch) == 0.0:
            continue
        lost, other = ("roll", "pitch") if roll < pitch else ("pitch", "roll")
        text = f"A of {body}.{lost} is zero at all frequencies and that of {body}.{other} is not"
        if abs(surge - sway) < ROUND * max(surge, sway):
            text += ", though surge and sway are alike: are rows missing?"
            found.append(Finding("error", "added mass of zero", text))
        else:
            text += ": right of a body of revolution about that axis only; else rows are missing"
            found.append(Finding("warning", "added mass of zero", text))
    return found


def _open(db: HydroDatabase) -> list[Finding]:
    """Report what A and B alone leave open, so that nobody takes silence for a verdict."""
    if db.heading.size:
        return []
    unseen = ["a factor of A and B together (density, length scale)"]
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    for name, body in db.bodies.items():
        long = k * length(db, name, k) < LONGEST
        if body.hydrostatics is None or np.count_nonzero(long) < FEWEST:
            unseen.append("a factor of all frequencies, or of B (no hull, or no long waves)")
            if any(b.hydrostatics is None for b in db.bodies.values()):
                unseen.append("rows of surge and heave in each other's places (no hull)")
            break
    if len(db.bodies) > 1:
        unseen.append("names of bodies whose hulls are equal or not known")
    names = ", ".join(db.bodies)
    text = (
        f"no forces of waves to check by: {'; '.join(unseen)} cannot be checked and "
        f"{'are' if len(unseen) > 1 else 'is'} taken as the files say (bodies in the order {names})"
    )
    return [Finding("warning", "not checked", text)]
