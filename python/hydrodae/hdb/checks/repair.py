"""Repairs that say what they do: nothing else is changed, and the file keeps the list."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.irregular import bands, suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import nearest
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.relations import infinity, irf, tails
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array

#: Share of the frequencies that may be replaced, unless another one is given.
MOST_REPLACED = 0.15
#: The tail reaches this multiple of the last frequency, in steps of this ratio.
TAIL_REACH, TAIL_RATIO = 2.5, 1.05


def repair(
    database: HydroDatabase, what: Sequence[str], share: float = MOST_REPLACED
) -> HydroDatabase:
    """Apply repairs in the given order.

    Parameters
    ----------
    database : HydroDatabase
    what : sequence of str
        Of `symmetrise`, `irregular`, `tail` (see the functions of this module).
    share : float
        Share of the frequencies that `irregular` may replace.

    Returns
    -------
    HydroDatabase
        A copy; `repairs` holds one sentence for each repair that changed something. Stored kernels
        and fits of the memory belong to the old tables and are removed.

    Raises
    ------
    DatabaseError
        Unknown repair, or one that cannot be done honestly.
    """
    for word in what:
        if word not in REPAIRS:
            raise DatabaseError(f"no repair {word!r}{nearest(word, REPAIRS)}").about("option", word)
    result = database
    for word in what:
        changed, text = irregular(result, share) if word == "irregular" else REPAIRS[word](result)
        if text:
            result = replace(changed, repairs=(*result.repairs, f"{word}: {text}"))
    if result is not database and (result.memory or result.kernel is not None):
        text = "removed the stored kernel and memory fits, which belong to the old tables"
        result = replace(result, memory={}, kernel=None, repairs=(*result.repairs, text))
    return result


def symmetrise(db: HydroDatabase) -> tuple[HydroDatabase, str]:
    """Replace A, B and added_mass_inf by the mean of both halves.

    Returns
    -------
    database : HydroDatabase
    text : str
        What was done; empty if they were symmetric.
    """
    a, b, inf = (
        0.5 * (t + np.swapaxes(t, -1, -2))
        for t in (db.added_mass, db.radiation_damping, db.added_mass_inf)
    )
    change = max(
        float(np.abs(new - old).max() / np.abs(old).max())
        for new, old in ((a, db.added_mass), (b, db.radiation_damping), (inf, db.added_mass_inf))
    )
    if change < 1e-12:
        return db, ""
    text = f"A, B and added_mass_inf replaced by the mean of both halves (change {change:.2g})"
    return replace(db, added_mass=a, radiation_damping=b, added_mass_inf=inf), text


def irregular(db: HydroDatabase, share: float = MOST_REPLACED) -> tuple[HydroDatabase, str]:
    """Interpolate where the tables break causality or energy (`suspect_rows`).

    A, B and diffraction at these frequencies come from cubic splines through the others, forces
    without the phase of the wave at the reference points; Froude-Krylov forces stay. Bad
    frequencies at either end of the table are left out. `added_mass_inf` is estimated again unless
    the source gave it.

    Returns
    -------
    database : HydroDatabase
    text : str
        What was done; empty if there is none.

    Raises
    ------
    DatabaseError
        More than `share` of the frequencies are bad.
    """
    mask = suspect_rows(db)
    if not mask.any():
        return db, ""
    shown = ", ".join(f"{a:.4g}..{b:.4g}" for a, b in bands(db.omega, mask))
    if mask.mean() > share or (~mask).sum() < 4:
        raise DatabaseError(
            f"{mask.sum()} of {mask.size} frequencies break causality or energy ({shown} rad/s), "
            f"{mask.mean():.0%} of them and more than {share:.0%}: too many to interpolate; "
            "compute again with a lid"
        ).about("frequencies", "irregular")
    good = np.flatnonzero(~mask)
    inside = np.zeros_like(mask)
    inside[good[0] : good[-1] + 1] = mask[good[0] : good[-1] + 1]
    made = _interpolated(db, ~mask, inside).at_frequencies(~mask | inside)
    text = f"interpolated {inside.sum()} of {mask.size} frequencies ({inside.mean():.1%})"
    if ends := int((mask & ~inside).sum()):
        text += f", left out {ends} at the ends"
    text += f": {shown} rad/s"
    if db.added_mass_inf_origin != "source":
        w, a, b = made.omega, made.added_mass, made.radiation_damping
        value, std = infinity.added_mass_inf(w, a, b)
        made = replace(
            made, added_mass_inf=0.5 * (value + value.T), added_mass_inf_std=0.5 * (std + std.T)
        )
        text += "; added_mass_inf estimated again"
    return made, text


def _interpolated(
    db: HydroDatabase, good: NDArray[np.bool_], bad: NDArray[np.bool_]
) -> HydroDatabase:
    """Replace the rows `bad` by splines through the rows `good`."""
    w = db.omega
    turn = np.exp(1j * wavenumber(w, db.water_depth, db.gravity)[:, None, None] * _along(db))
    total = {
        "added_mass": db.added_mass,
        "radiation_damping": db.radiation_damping,
        "diffraction": db.diffraction * turn,
    }
    made = {}
    for name, table in total.items():
        made[name] = table.copy()
        if table.size:
            made[name][bad] = CubicSpline(w[good], table[good])(w[bad])
    made["diffraction"] = made["diffraction"] / turn
    made["diffraction"][~bad] = db.diffraction[~bad]
    return replace(db, **made)


def _along(db: HydroDatabase) -> Array:
    """Distance (nh, n) of the reference points along each heading [m]; 0 where unknown."""
    points = [db.bodies[label.body].reference_point for label in db.labels]
    places = np.array([np.zeros(3) if p is None else p for p in points])
    return np.asarray(
        np.outer(np.cos(db.heading), places[:, 0]) + np.outer(np.sin(db.heading), places[:, 1])
    )


def tail(db: HydroDatabase) -> tuple[HydroDatabase, str]:
    """Append frequencies up to 2.5 times the last one along the power laws that B_ii follow there.

    With n_i the power of B_ii and d_i = (w/w_max)^{-n_i/2}: B_ij = d_i d_j B_ij(w_max), which keeps
    B positive semidefinite; A from Ogilvie's relation, joined continuously; |F_i| falls as
    w^{-(n_i + 3)/2}, what the energy identity asks for in deep water, with the phase that it has at
    the reference point at w_max.

    Returns
    -------
    database : HydroDatabase
    text : str
        What was done.

    Raises
    ------
    DatabaseError
        A coordinate that radiates follows no power law, or a reference point is unknown.
    """
    w, n = db.omega, len(db.coordinates)
    active = scales(db) > 0.0
    diagonal = np.einsum("wii->wi", db.radiation_damping)
    fitted = tails.fit_tail(w, diagonal)
    bad = [db.coordinates[i] for i in range(n) if active[i] and not fitted.used[i]]
    if bad or not active.any():
        raise DatabaseError(
            f"no tail: B of {', '.join(bad) or 'every coordinate'} follows no power law above "
            f"{tails.TAIL_FROM * w[-1]:.3g} rad/s; compute higher frequencies"
        ).about("frequencies", "tail")
    power = np.where(active, fitted.power, tails.TAIL_POWERS[1])
    count = int(np.ceil(np.log(TAIL_REACH) / np.log(TAIL_RATIO)))
    more = w[-1] * TAIL_RATIO ** np.arange(1, count + 1)
    ratio = more[:, None] / w[-1]
    decay = ratio ** (-0.5 * power)
    b = db.radiation_damping[-1] * decay[:, :, None] * decay[:, None, :]
    omega, damping = np.r_[w, more], np.concatenate([db.radiation_damping, b])
    memory = irf.kramers_kronig(omega, damping)
    rest = db.added_mass[-1] + memory[w.size - 1] - db.added_mass_inf
    a = db.added_mass_inf - memory[w.size :] + rest / ratio[:, :, None] ** 2
    k = wavenumber(omega, db.water_depth, db.gravity)
    for name in db.bodies:
        db.reference_point(name)
    factor = np.exp(-1j * (k[w.size :] - k[w.size - 1])[:, None, None] * _along(db))
    factor = factor * (ratio ** (-0.5 * (power + 3.0)))[:, None, :]
    extended = replace(
        db,
        omega=omega,
        added_mass=np.concatenate([db.added_mass, a]),
        radiation_damping=damping,
        froude_krylov=np.concatenate([db.froude_krylov, db.froude_krylov[-1] * factor]),
        diffraction=np.concatenate([db.diffraction, db.diffraction[-1] * factor]),
    )
    powers = ", ".join(f"{db.coordinates[i]} {power[i]:.2f}" for i in np.flatnonzero(active))
    return extended, (
        f"appended {count} frequencies {more[0]:.4g}..{more[-1]:.4g} rad/s with B ~ w^-n, "
        f"n = {powers}; A by Ogilvie's relation; |F| ~ w^-(n+3)/2"
    )


REPAIRS: dict[str, Callable[[HydroDatabase], tuple[HydroDatabase, str]]] = {
    "symmetrise": symmetrise,
    "irregular": irregular,
    "tail": tail,
}
