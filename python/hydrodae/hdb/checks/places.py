r"""Places and motions that A and B alone show: rows of other bodies, or of other motions.

In waves longer than the bodies a body that heaves is a source and one that surges a dipole. Their
waves meet, at a distance d and in the direction alpha from the one that surges, so that

    B_13 = -sqrt(2 B_11 B_33) J_1(k d) cos(alpha),    for sway: sin(alpha)

(from the far field, as in `energy`): where the bodies change places, the sign changes. In pairs of
floating bodies of seven tables the factor is 0.90 to 1.03. Pressures of a surge act about at one
height z, so that A_15 = z A_11 and A_24 = -z A_22 along the main axes of A, and A_14, A_25 are
small; that height is above the ground.
"""

from __future__ import annotations

import numpy as np
from scipy.special import j1

from hydrodae.hdb.checks.motions import motions
from hydrodae.hdb.checks.shapes import away, width
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.support.arrays import Array

#: Longest k times the length of a body, and the distance of bodies whose waves meet in order.
LONG, FARTHEST = 1.7, 3.5
#: Fewest frequencies, correlation that is no chance, least share of the distance along a motion.
FEWEST, SURE, ALONG = 4, 0.9, 0.5
#: A_14 and A_25 over A_15 and A_24 that no hull has, and over the root of A_11 A_44 that matters.
CROSSED, MATTERS = 3.0, 0.02
#: Difference of A_11 and A_22 from which they have main axes.
ROUND = 0.05
#: Share of the depth below the ground where no pressure acts.
BELOW = 0.05
#: Height above the water over the body's width: 0.6 of a float with a heave plate, 5 of a flat cap.
ABOVE = 10.0


def place_findings(database: HydroDatabase) -> list[Finding]:
    """Judge the coupling of bodies by their places, and of motions of a body by each other.

    Returns
    -------
    list of Finding
        At most one of pairs of bodies, and an error of each body whose motions are mixed up.
    """
    found = _sides(database)
    for name in database.bodies:
        text = _crossed(database, name) or _buried(database, name)
        if text:
            found.append(Finding("error", "motions of a body", f"{name}: {text}"))
    return found


def _sides(db: HydroDatabase) -> list[Finding]:
    """Report bodies whose coupling has the sign of the other side."""
    b, table = db.radiation_damping, motions(db)
    wrong: list[tuple[float, str, str]] = []
    judged = 0
    for heave in (m for m in table if m.label.dof == 2):
        for m in (m for m in table if m.label.dof < 2):
            way = away(db, m.label.body, heave.label.body)
            distance = 0.0 if way is None else float(np.hypot(*way))
            if way is None or abs(way[m.label.dof]) < ALONG * distance or distance == 0.0:
                continue
            long = (m.k * max(m.length, heave.length) < LONG) & (m.k * distance < FARTHEST)
            long &= heave.follows
            if np.count_nonzero(long) < FEWEST:
                continue
            own = np.sqrt(np.maximum(m.stored[long] * heave.stored[long], 0.0))
            part = way[m.label.dof] / distance
            expected = -np.sqrt(2.0) * own * j1(m.k[long] * distance) * part
            stored = b[long, m.column, heave.column]
            size = float(np.linalg.norm(expected) * np.linalg.norm(stored))
            judged += size > 0.0
            if size > 0.0 and float(expected @ stored) < -SURE * size:
                wrong.append((distance, str(m.label), str(heave.label)))
    if not wrong:
        text = f"{judged} couplings of bodies have the signs of their places"
        return [Finding("info", "places of bodies", text, float(judged))] if judged else []
    _, motion, by = min(wrong)
    text = f"B of {motion} by {by} has the sign of bodies in each other's places"
    return [Finding("error", "places of bodies", text, float(len(wrong)))]


def _block(db: HydroDatabase, name: str) -> Array | None:
    """A_inf of surge, sway, roll, pitch of a body; None where one of them is missing or zero."""
    at = {label: i for i, label in enumerate(db.coordinates)}
    i = [at.get(f"{name}.{dof}") for dof in ("surge", "sway", "roll", "pitch")]
    if any(place is None for place in i):
        return None
    a = db.added_mass_inf[np.ix_(i, i)]  # type: ignore[arg-type]
    return a if np.diag(a).min() > 0.0 else None


def _crossed(db: HydroDatabase, name: str) -> str:
    """Report a surge that turns a body as sway does."""
    a = _block(db, name)
    if a is None:
        return ""
    mass, coupling = a[:2, :2], a[2:, :2]
    across = np.hypot(2.0 * mass[0, 1], mass[0, 0] - mass[1, 1])
    if across > ROUND * np.trace(mass):
        turn = 0.5 * np.arctan2(2.0 * mass[0, 1], mass[0, 0] - mass[1, 1])
        axes = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        coupling = axes.T @ coupling @ axes
    cross = float(np.hypot(coupling[0, 0], coupling[1, 1]))
    direct = float(np.hypot(coupling[1, 0], coupling[0, 1]))
    own = float(np.sqrt(np.diag(mass).max() * np.diag(a)[2:].max()))
    if cross < CROSSED * direct or cross < MATTERS * own:
        return ""
    return (
        f"its added mass couples surge with roll and sway with pitch, {cross / own:.2g} of their "
        f"own, and hardly surge with pitch"
    )


def _buried(db: HydroDatabase, name: str) -> str:
    """Report pressures that act below the ground, or far above the water."""
    a, point = _block(db, name), db.bodies[name].reference_point
    if a is None or point is None:
        return ""
    level = float(np.asarray(point)[2])
    heights = (level + a[3, 0] / a[0, 0], level - a[2, 1] / a[1, 1])
    if max(heights) > ABOVE * width(db, name):
        where = f"{max(heights):.4g} m, far above the water"
    elif min(heights) < -(1.0 + BELOW) * db.water_depth:
        where = f"{min(heights):.4g} m, below the ground at {-db.water_depth:g} m"
    else:
        return ""
    return f"its added mass of surge or sway acts at z = {where}"
