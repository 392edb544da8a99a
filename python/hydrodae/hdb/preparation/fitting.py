"""Add to a database what a simulation needs: fits of the radiation memory, the kernel K(t)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import body_name, expand
from hydrodae.hdb.database.radiation_kernel import LIMIT
from hydrodae.hdb.preparation import pipeline
from hydrodae.hdb.preparation.fit_stages import Fit


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
    time_limit: float | None = None,
    accept: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> HydroDatabase:
    """Fit the radiation memory of some coordinates; the command `hydrodae hdb fit`.

    The stages are listed in `hydrodae.hdb.preparation.pipeline`.

    Where no smooth function follows the whole table, frequencies outside the band that break
    causality or energy (irregular frequencies) are left out, and then those above the band. The
    report states how many (`left_out`); A_inf must be that of the tables, and H not larger.
    Single frequencies off the curve through their neighbours are left out before, and reported.
    Without a target, a fit that misses the usual one is kept within 1 % of H in the band, or
    within 1.5 times the noise of the tables; its report states the error and the noise (`noisy`).
    Where the band of the damping gives none, that which the device feels is tried.

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
    time_limit : float, optional
        Seconds [s]; default: 300. The search ends there, and the best passive fit so far is taken;
        an error where no fit is passive by then, whatever is accepted.
    accept : sequence of str
        What the fit may miss: "target" (implied by `states`, which asks for the best of so many)
        and "passive".
    progress : callable, optional
        Called with the name of each stage, and with a line of text now and then.

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
    if not is_fit_name(name):
        raise CaseError(f"fit {name!r}: a name has letters, digits, _ and - only", key="name")
    if target is not None and not target > 0.0:
        raise CaseError(f"target {target:g}: expected a number > 0", key="target")
    if time_limit is not None and not time_limit > 0.0:
        raise CaseError(f"time limit {time_limit:g}: expected seconds > 0", key="time_limit")
    state = Fit(
        database,
        _labels(inputs, database),
        None if loads is None else _labels(loads, database),
        name=name,
        band=band,
        asked_band=band,
        states=states,
        target=target,
        uniform=uniform,
        time_limit=time_limit,
        accept=accept,
        progress=progress,
    )
    try:
        return pipeline.run(pipeline.FIT, state, progress).database
    except DatabaseError as error:
        again = _in_the_felt_band(state)
        if again is None or error.reason != "target":
            raise
        if progress is not None:
            progress(again.left_out[0])
        try:
            return pipeline.run(pipeline.FIT, again, progress).database
        except DatabaseError:
            raise error from None


def _in_the_felt_band(state: Fit) -> Fit | None:
    """Return the same fit for the band that the device feels; None where a user says how it is.

    The band of the damping may end below it, where the fit then rings.
    """
    said = (state.asked_band, state.target, state.uniform, state.states)
    if any(value is not None for value in said) or not state.database.heading.size:
        return None
    band = felt_band(state.database)
    low, high = state.judged
    text = (
        f"no good fit in {low:.3g}..{high:.3g} rad/s, where the damping is; this one is for "
        f"{band[0]:.3g}..{band[1]:.3g} rad/s, what the device feels"
    )
    return replace(state, band=band, asked_band=band, left_out=[text])


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
