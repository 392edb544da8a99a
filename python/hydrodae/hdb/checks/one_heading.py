r"""Damping from a single heading, roughly: A, B and F must have units of one system.

Waves longer than a body push it as a source (heave) and a dipole (surge, and what turns with it)
would, so that Haskind's relation (`energy`) needs one heading only:

    B_ii = k / (8 rho g c_g) s |F_i(beta)|^2,    s = 2 in heave, 1/cos^2 beta in surge and pitch,
                                                 1/sin^2 beta in sway and roll,

within a factor of two or so, also where pitch carries some of heave. Between the walls of a tank
waves go two ways only, and the right side is off by a factor that follows k: that is no unit.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.shapes import length
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.relations.dispersion import damping_of_waves
from hydrodae.support.arrays import Array

#: Fewest frequencies that a verdict rests on.
FEWEST = 2
#: Longest k times the length of the body.
LONGEST = 1.0
#: Least of the same at the first frequency that no table has.
SHORT = 10.0
#: Least share of the largest force, and of the largest damping there, that count.
LEAST_FORCE, LEAST_B = 0.05, 0.02
#: Damping that is positive at fewer of the long waves is noise: there is a check of its sign.
POSITIVE = 0.8
#: Factors that neither the shape nor bodies beside it explain: 24 tables of six codes are within
#: 0.51 and 1.31. `ALL`: all motions of a kind, of one body, are off by so much; `ONE`: one of them.
DOUBTFUL, ALL, ONE = 2.0, 2.5, 10.0
#: Power of k beyond which the ratio is one of noise, not of units.
NOISE = 1.5
#: Between walls the ratio of all motions follows k to the power 1 within this.
WALLS = 0.06


def one_heading_findings(database: HydroDatabase) -> list[Finding]:
    """Compare the damping of each motion with what one heading implies.

    Returns
    -------
    list of Finding
        One, none if nothing shows it: an error where all translations or all rotations of a body
        are off by more than 2.5 times, or one motion by more than 10; a warning where one is by
        more than twice. Bodies on the ground are left out.
    """
    off, tank = _logs(database)
    if not off:
        return []
    groups: dict[tuple[str, bool], list[str]] = {}
    for one in read_labels(off):
        groups.setdefault((one.body, one.is_rotation), []).append(str(one))
    alike = [min(labels, key=lambda c: abs(off[c])) for labels in groups.values()]
    every = max(alike, key=lambda c: abs(off[c]))
    worst = max(off, key=lambda c: abs(off[c]))
    if abs(off[every]) > np.log(ALL):
        label, severity = every, "warning" if tank == set(off) else "error"
    else:
        label, size = worst, abs(off[worst])
        severity = (
            "error" if size > np.log(ONE) else "warning" if size > np.log(DOUBTFUL) else "info"
        )
    ratio = float(np.exp(off[label]))
    text = f"the force of {label} in long waves implies {ratio:.3g} times its B"
    return [Finding(severity, "damping from one heading", text, ratio)]


def in_a_tank(database: HydroDatabase) -> bool:
    """Return whether damping and forces of all motions are those between walls."""
    off, tank = _logs(database)
    return bool(off) and tank == set(off)


def power_of(k: Array, ratio: Array) -> float:
    """Power of k that a ratio follows (least squares of the logarithms)."""
    x = np.log(k) - np.log(k).mean()
    return float((x * np.log(ratio)).sum() / max((x**2).sum(), 1e-12))


def _logs(db: HydroDatabase) -> tuple[dict[str, float], set[str]]:
    """Logarithm of the implied damping over B, of coordinates that show it; those in a tank."""
    found: dict[str, float] = {}
    tank: set[str] = set()
    if not db.heading.size:
        return found, tank
    k, factor = damping_of_waves(db.omega, db.water_depth, db.gravity, db.rho)
    held, active = standing(db), scales(db) > 0.0
    for i, label in enumerate(db.labels):
        body, dof = label.body, label.dof
        if dof == 5 or body in held or not active[i]:
            continue
        share = np.ones(db.heading.size)
        if dof != 2:
            share = np.cos(db.heading) ** 2 if dof in (0, 4) else np.sin(db.heading) ** 2
        h = int(share.argmax())
        force, b = np.abs(db.excitation[:, h, i]), db.radiation_damping[:, i, i]
        waves = k * length(db, body, k)
        long = waves < LONGEST
        if waves[0] > SHORT:  # no table begins there: the length is that of other units
            long = np.arange(k.size) <= FEWEST
        if share[h] < 0.5 or not long.any() or np.mean(b[long] > 0.0) < POSITIVE:
            continue
        used = long & (b > LEAST_B * b[long].max()) & (force > LEAST_FORCE * force.max())
        if np.count_nonzero(used) < FEWEST:
            continue
        implied = factor * force**2 * (2.0 if dof == 2 else 1.0 / share[h])
        power = power_of(k[used], implied[used] / b[used])
        if abs(power) > NOISE:
            continue
        found[str(label)] = float(np.log(np.median(implied[used] / b[used])))
        if abs(power - 1.0) < WALLS:
            tank.add(str(label))
    return found, tank
