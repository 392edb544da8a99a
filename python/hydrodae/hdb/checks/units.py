"""Units: A, B, F and the hull in long waves, and A and B at all frequencies, must fit each other.

The columns of long waves are those of `hydrodae.hdb.checks.motions`; each check compares two of
them within a factor of two or so, more where bodies nearby or a part of heave in pitch matter.
Between the walls of a tank waves go two ways only, and damping is off by a factor that follows k:
that is no unit.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.motions import FEWEST, LONGEST, Motion, motions
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.labels import Label
from hydrodae.hdb.relations.causality import causal_line, causal_slope
from hydrodae.support.arrays import Array

#: Factors that neither the shape nor bodies beside it explain. In 24 tables of six codes A over
#: what diffraction says is 0.97 to 1.14, B from force over B 0.40 to 1.31, B from hull over B 0.83
#: to 2.1, of heave 0.83 to 1.04. `ALL`: all motions of a kind are off by so much, the geometric
#: mean of 2.5 and of the least factor of a unit, 2 pi. `ONE`: one of them. `HEAVE`: of heave by the
#: hull, the mean of 1.2 and 2 pi, rounded up.
DOUBTFUL, ALL, ONE, HEAVE = 2.0, 4.0, 5.0, 3.0
#: Factor of B from added mass alone, where no file gives the volume. Its inverse is how small A
#: may be of the whole force, of which it is 0.14 to 0.91.
UNKNOWN = 60.0
#: Damping of noise: positive at fewer of the long waves, or following k to more than this power.
POSITIVE, NOISE = 0.8, 1.5
#: Least share of the largest damping of long waves, beside forces (both fade there) and the hull.
OF_FORCE, OF_HULL = 0.02, 0.01
#: Between walls the ratio of all motions follows k to the power 1 within this.
WALLS = 0.06
#: Least k L at the first frequency that no table has: the length is that of other units.
SHORT = 10.0
#: Correlation of A and B that certainly belong to each other: 0.99 in 24 tables, 0.88 and less
#: where these are by period. Noise, and tables that begin late, have less without being wrong.
CORRELATION = 0.98
TURN = 2.0 * np.pi
#: Standard error of a slope over it, where the tail is free.
SURE = 0.05


def size_findings(database: HydroDatabase) -> list[Finding]:
    """Compare sizes of A, B and F in long waves with each other and with the hydrostatics.

    Returns
    -------
    list of Finding
        Errors, and what agrees, of each body or of bodies near each other; what cannot be judged
        (no headings, hydrostatics or long waves) is left out.
    """
    table, held, found = motions(database), standing(database), []
    _, walls = _logs(database, table)
    for near in dict.fromkeys(tuple(m.near) for m in table):
        group = [m for m in table if m.label.body in near and m.label.dof < 3]
        found += _added(group)
        moving = [m for m in group if m.label.dof < 2 or m.label.body not in held]
        found += [f for f in _hull_damping(moving) if not (walls and f.severity == "error")]
    return found


def _added(group: Sequence[Motion]) -> list[Finding]:
    """Added mass against the horizontal force, or its diffraction, of long waves."""
    seen: list[tuple[bool, float, str]] = []
    for dof, motion in ((0, "surge"), (1, "sway")):
        moved = [m for m in group if m.label.dof == dof and m.heading is not None]
        if not moved:
            continue
        db, k, what, low = moved[0].db, moved[0].k, "the whole force", 1.0 / UNKNOWN
        table = db.excitation
        if db.excitation_split:
            what, table, low = "the diffraction force", db.diffraction, 1.0 / DOUBTFUL
        force = np.abs(sum(m.force(table) for m in moved)) / (k * db.gravity)
        added = np.sum([m.added for m in moved], axis=0)
        long = np.all([m.as_one() for m in moved], axis=0)
        if np.count_nonzero(long) < FEWEST or not np.all(force[long] > 0.0):
            continue
        ratio = float(np.median(added[long] / force[long]))
        where = str(moved[0].label) if len(moved) == 1 else motion
        seen.append((not low < ratio < DOUBTFUL, ratio, f"{what} of long waves in {where}"))
    if not seen:
        return []
    wrong, ratio, what = min(seen)  # one direction that is right is enough
    text = f"A is {ratio:.3g} of what {what} has of it"
    severity, omega = "error" if wrong else "info", float(group[0].db.omega[0])
    return [Finding(severity, "added mass from force", text, ratio, omega)]


def _hull_damping(group: Sequence[Motion]) -> list[Finding]:
    """Damping of bodies near each other, one by one, against that of their hulls."""
    seen = []
    for m in group:
        statics, rows = m.body.hydrostatics, m.as_one()
        known = statics is not None and statics.displaced_volume > 0.0
        if m.hull is None or (m.label.dof == 2 and not known):
            continue
        if m.label.dof == 2:
            rows &= m.follows
        ratio = _ratios(m, m.damping(m.hull), rows, OF_HULL)
        if ratio is not None:
            limit = UNKNOWN if not known else HEAVE if m.label.dof == 2 else ONE
            seen.append((ratio[0], str(m.label), limit))
    if not seen:
        return []
    worst, label, limit = max(seen, key=lambda item: abs(np.log(item[0])) - np.log(item[2]))
    text = f"the hull and A imply {worst:.3g} times the B of long waves in {label}"
    severity = "error" if abs(np.log(worst)) > np.log(limit) else "info"
    return [Finding(severity, "damping from hull", text, worst)]


def one_heading_findings(database: HydroDatabase) -> list[Finding]:
    """Compare the damping of each motion with what waves of one heading imply.

    Returns
    -------
    list of Finding
        One, none if nothing shows it: an error where all translations or all rotations of a body
        are off, or one motion by far; a warning where one is. Bodies on the ground are left out.
    """
    off, tank = _logs(database, motions(database))
    if not off:
        return []
    groups: dict[tuple[str, bool], list[Label]] = {}
    for c in off:
        groups.setdefault((c.body, c.is_rotation), []).append(c)
    alike = [min(labels, key=lambda c: abs(off[c])) for labels in groups.values()]
    label = max(alike, key=lambda c: abs(off[c]))
    if abs(off[label]) > np.log(ALL):
        severity = "warning" if tank else "error"
    else:
        label = max(off, key=lambda c: abs(off[c]))
        beyond = sum(abs(off[label]) > np.log([DOUBTFUL, ONE]))
        severity = ("info", "warning", "error")[beyond]
    ratio = float(np.exp(off[label]))
    text = f"the force of {label} in long waves implies {ratio:.3g} times its B"
    return [Finding(severity, "damping from one heading", text, ratio)]


def _logs(db: HydroDatabase, table: Sequence[Motion]) -> tuple[dict[Label, float], bool]:
    """Logarithm of the implied damping over B, of motions that show it; whether it is a tank."""
    found: dict[Label, float] = {}
    walls = []
    held, active = standing(db), scales(db) > 0.0
    for m in table:
        if m.heading is None or m.label.body in held or not active[m.column]:
            continue
        far = m.k[0] * m.length > SHORT
        long = np.arange(m.k.size) <= FEWEST if far else m.k * m.length < LONGEST
        ratio = _ratios(m, m.damping(m.force(db.excitation)), long, OF_FORCE)
        if ratio is None or abs(ratio[1]) > NOISE:
            continue
        found[m.label] = float(np.log(ratio[0]))
        walls.append(abs(ratio[1] - 1.0) < WALLS)
    return found, bool(walls) and all(walls)


def _ratios(
    m: Motion, implied: Array, long: NDArray[np.bool_], least: float
) -> tuple[float, float] | None:
    """Implied over stored damping of long waves, and the power of k of that; None of too few."""
    b = m.stored
    if not long.any() or np.mean(b[long] > 0.0) < POSITIVE:
        return None
    used = long & (b > least * b[long].max())
    if np.count_nonzero(used) < FEWEST or not np.all(implied[used] > 0.0):
        return None
    ratio = implied[used] / b[used]
    x = np.log(m.k[used]) - np.log(m.k[used]).mean()
    power = (x * np.log(ratio)).sum() / max((x**2).sum(), 1e-12)
    return float(np.median(ratio)), float(power)


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
    turned = ((turn / db.omega[::-1], a[::-1], b[::-1]) for turn in (TURN, TURN**2))
    if not clear.any() and any(_agree(*tables) for tables in turned):
        text = "A follows from B by causality only if frequencies [rad/s] are periods [s]"
        return [Finding("error", "units of frequency", text)]
    if clear.sum() < max(2, 0.4 * slope.size):
        # tables that end before B falls, or of one coordinate
        slope, error = causal_slope(db.omega, a, b)
        clear = error < SURE * np.abs(slope)
        wrong = clear & ((np.abs(slope) > ONE) | (np.abs(slope) < 1.0 / ONE))
        if not wrong.any() or wrong.sum() < 0.6 * used.size:
            return []
    factor = float(np.median(slope[clear]))
    text = f"A and B fit each other if B is {factor:.3g} times as large"
    severity = "info" if 1.0 / DOUBTFUL < factor < DOUBTFUL else "error"
    return [Finding(severity, "units of frequency", text, factor)]


def _agree(omega: Array, a: Array, b: Array) -> bool:
    """Return whether at least two coordinates have A and B that belong to each other."""
    slope, correlation = causal_line(omega, a, b)
    right = (correlation > CORRELATION) & (slope > 1.0 / DOUBTFUL) & (slope < DOUBTFUL)
    return int(right.sum()) > 1
