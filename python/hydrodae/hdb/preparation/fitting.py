"""Add to a database what a simulation needs: fits of the radiation memory, the kernel K(t)."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import body_name, expand
from hydrodae.hdb.database.radiation_kernel import LIMIT
from hydrodae.hdb.preparation.left_out import (
    OUTSIDE,
    at,
    cure,
    rows_left_out,
    without_lone_rows,
)

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory

#: Weighted error of H in the band of a fit without a target of its own.
USUAL = 0.01
#: Then A_inf of the fit must be that of the tables, to this share of the largest A, and |H| nowhere
#: beyond so many times its largest in the tables.
INERTIA, RINGS = 0.05, 1.5


def fit(
    database: HydroDatabase,
    inputs: str | Sequence[str],
    *,
    name: str = "default",
    loads: str | Sequence[str] | None = None,
    band: tuple[float, float] | None = None,
    states: int | None = None,
    target: float | None = None,
    uniform: float | None = None,
    method: str | None = None,
    time_limit: float | None = None,
    accept: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> HydroDatabase:
    """Fit the radiation memory of some coordinates; the command `hydrodae hdb fit`.

    Where no smooth function follows the whole table, frequencies outside the band that break
    causality or energy (irregular frequencies) are left out, and then those above the band. The
    report states how many (`left_out`); A_inf must be that of the tables, and H not larger.
    Single frequencies off the curve through their neighbours are left out before, and reported.
    Without a target, a fit that misses the usual one is kept within 1 % of H in the band; its
    report states the error and the noise of the tables (`noisy`).

    Parameters
    ----------
    database : HydroDatabase
    inputs : str or sequence of str
        Coordinates that move: labels, or a text as `hydrodae.hdb.expand` reads it, such as
        "base.planar,flap1.pitch".
    name : str
        Of the fit in the database; one of that name is replaced.
    loads : str or sequence of str, optional
        Coordinates whose loads the fit gives, likewise; default: those that move.
    band : (float, float), optional
        Frequencies that the fit must match [rad/s], for example those of
        `hydrodae.working_band`; default: from the damping of the tables
        (`hydrodae.hdb.memory.band`), with `uniform` up to the last frequency that the device feels
        (`hydrodae.hdb.checks.band.felt_band`).
    states : int, optional
        Largest number of states.
    target : float, optional
        Relative error of H in the band, weighted by |H|^-1/2 [-]; default: 4.5e-4.
    uniform : float, optional
        Target in place of that: largest error of H in the band over its largest value [-].
    method : str, optional
        "modes", "hankel" or "auto" (default: by the number of coordinates).
    time_limit : float, optional
        Seconds [s]; default: 300. The search ends there, and the best passive fit so far is taken.
    accept : sequence of str
        What the fit may miss: "target" (implied by `states`, which asks for the best of so many)
        and "passive".
    progress : callable, optional
        Called with a line of text now and then.

    Returns
    -------
    HydroDatabase
        A copy whose `memory` holds the fit; how good it is stands in `memory[name].report`.

    Raises
    ------
    CaseError
        The name or the target is not one.
    DatabaseError
        Unknown coordinates, no radiation, fewer than 4 frequencies in the band, or a fit that is
        not passive or misses its target and is not accepted.

    Warns
    -----
    hydrodae.hdb.memory.MemoryFitWarning
        What the fit missed and was accepted; coordinates that do not radiate.
    """
    from hydrodae.hdb.memory import MemoryFitWarning, fit_memory
    from hydrodae.hdb.memory.fit import table_band
    from hydrodae.hdb.memory.verdict import CHECKS, missed

    if not is_fit_name(name):
        raise CaseError(f"fit {name!r}: a name has letters, digits, _ and - only")
    if target is not None and not target > 0.0:
        raise CaseError(f"target {target:g}: expected a number > 0")
    if unknown := [check for check in accept if check not in CHECKS]:
        raise CaseError(f"accept {unknown[0]!r}: expected one of {', '.join(CHECKS)}")
    if time_limit is not None and not time_limit > 0.0:
        raise CaseError(f"time limit {time_limit:g}: expected seconds > 0")
    if band is None and uniform is not None:
        band = table_band(database)[0], felt_band(database)[1]
    allowed = {*accept, *(() if states is None else ("target",))}
    given = {
        "band": band,
        "max_states": states,
        "target": target,
        "uniform": uniform,
        "method": method,
        "time_limit": time_limit,
        "progress": progress,
    }
    options: dict[str, Any] = {key: value for key, value in given.items() if value is not None}
    moving = _labels(inputs, database)
    options["outputs"] = None if loads is None else _labels(loads, database)

    judged = band or table_band(database)
    tables, garbled = without_lone_rows(database, moving, judged)
    whole = np.zeros(tables.omega.size, bool)
    bad, text = whole, ""
    if states is None and method in (None, "auto"):
        options["searches"] = {}  # of the look, for the fit
        keys = "target", "uniform", "searches"
        looked = {key: options[key] for key in keys if key in options}
        bad, text = rows_left_out(tables, moving, judged, looked)
    left_out = "; ".join(part for part in (garbled, text) if part)
    if text and progress is not None:
        progress(text)
    if bad.any():
        options |= {"band": judged, "target_outside": OUTSIDE}
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always", MemoryFitWarning)
        made = fit_memory(at(tables, ~bad), inputs=moving, name=name, **options)
    if left_out:
        made = replace(made, report={**made.report, "left_out": left_out})
    refused = {key: why for key, why in missed(made.report).items() if key not in allowed}
    if list(refused) == ["target"] and target is None and _near_enough(made, tables):
        made, refused, warned = _as_near(made), {}, []
    if bad.any() and not goes_on(made, tables):
        refused["limit"] = "goes to another added mass, or rings, beyond the frequencies it matches"
    if refused:
        raise DatabaseError(f"fit '{name}' {_refusal(refused, cure(database, moving, judged))}")
    for warning in warned:
        warnings.warn(warning.message, stacklevel=2)
    return replace(database, memory={**database.memory, name: made})


def _near_enough(fit: ExponentialMemory, tables: HydroDatabase) -> bool:
    """Return whether a fit without a target of its own is kept, its error stated."""
    report = fit.report
    if "uniform" in report:
        return False
    if report["as_near_as_noise"]:
        return True
    beyond = report["weighted_error_outside"] <= OUTSIDE or goes_on(fit, tables)
    return bool(report["weighted_error_band"] <= USUAL and beyond)


def _as_near(fit: ExponentialMemory) -> ExponentialMemory:
    """Return a fit that misses the usual target, with a note of it."""
    report = fit.report
    cause = "no fit reaches"
    if report["time_limited"]:
        cause = "the time limit ended the search before it reached"
    text = (
        f"the tables carry noise of {report['noise']:.1e} of H in the band (weighted); {cause} "
        f"the usual target {report['target']:g}, this one {report['weighted_error_band']:.1e}"
    )
    return replace(fit, report={**report, "noisy": text, "target_met": True})


def goes_on(fit: ExponentialMemory, database: HydroDatabase) -> bool:
    """Return whether a fit goes to the right limit beyond the frequencies that it matches.

    It is passive, its A_inf is that of the tables within their uncertainty, and |H| nowhere is far
    beyond what it is at the frequencies of the tables that break no law.
    """
    i = database.index(fit.inputs)
    moving = [fit.outputs.index(label) for label in fit.inputs]
    own = np.diag(fit.added_mass_inf[moving])
    off = own - np.diag(database.added_mass_inf)[i]
    size = np.abs(database.added_mass[:, i, i]).max(axis=0)
    allowed = np.maximum(INERTIA * size, 3.0 * np.diag(database.added_mass_inf_std)[i])
    good = ~suspect_rows(database)
    w = database.omega[good, None]
    stored = database.radiation_damping[:, i, i][good] + 1j * w * (
        database.added_mass[:, i, i][good] - own
    )
    fine = np.geomspace(database.omega[0], 2.0 * database.omega[-1], 2000)
    made = np.einsum("wii->wi", fit.transfer(fine)[:, moving])
    largest = np.abs(stored).max(axis=0)
    return bool(np.all(np.abs(off) <= allowed) and np.all(np.abs(made) <= RINGS * largest))


def _refusal(refused: dict[str, str], cured_by: str) -> str:
    """Return why a fit is refused, and what can be done."""
    ways = []
    if "target" in refused:
        ways.append("a larger --target, a narrower --band or --states N, the best of so many")
    if "passive" in refused:
        ways.append("more states or another --method")
    names = " ".join(f"--accept {check}" for check in refused)
    first = f" {cured_by}." if cured_by else ""
    return (
        f"{', and '.join(refused.values())}.{first} Not kept: give {', or '.join(ways)}, or {names}"
    )


def kernel(
    database: HydroDatabase,
    inputs: str | Sequence[str],
    *,
    loads: str | Sequence[str] | None = None,
    length: float | None = None,
    band: tuple[float, float] | None = None,
    limit: float = LIMIT,
) -> HydroDatabase:
    """Store the radiation kernel K(t) for the convolution; the command `hydrodae hdb kernel`.

    Parameters
    ----------
    database : HydroDatabase
    inputs : str or sequence of str
        Coordinates that move: labels, or a text as `hydrodae.hdb.expand` reads it.
    loads : str or sequence of str, optional
        Coordinates whose loads it gives, likewise; default: those that move.
    length : float, optional
        Memory [s]; default: until a thousandth of int |K| is left, or H in the band no better.
    band : (float, float), optional
        Frequencies that must match [rad/s].
    limit : float
        Largest error of H in the band [-].

    Returns
    -------
    HydroDatabase
        A copy whose `kernel` is the new one.

    Raises
    ------
    DatabaseError
        Unknown coordinates, a memory too short for the grid, too few frequencies in the band, or an
        error of H above the limit.
    """
    return database.with_kernel(
        _labels(inputs, database),
        None if loads is None else _labels(loads, database),
        length=length,
        band=band,
        limit=limit,
    )


def is_fit_name(name: str) -> bool:
    """Return whether a fit can have this name in a file: letters, digits, _ and - only."""
    return body_name(name) == name


def _labels(given: str | Sequence[str], database: HydroDatabase) -> list[str]:
    return expand(given if isinstance(given, str) else ",".join(given), database.coordinates)
