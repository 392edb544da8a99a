"""Stages of a fit of the radiation memory: from tables to a fit that is kept, in this order."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.preparation.left_out import OUTSIDE, cure, rows_left_out, without_lone_rows

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory

#: Weighted error of H in the band of a fit without a target of its own.
USUAL = 0.01
#: Then A_inf of the fit must be that of the tables, to this share of the largest A, and |H| nowhere
#: beyond so many times its largest in the tables.
INERTIA, RINGS = 0.05, 1.5
#: Weighted error over the noise of the tables up to which a fit is kept, and how far the added mass
#: of noisy tables may be off with it.
NOISE_TIMES, NOISY_INERTIA = 1.5, 0.1


@dataclass
class Fit:
    """A fit on its way into a database: what is asked, and what the stages have made so far.

    Attributes
    ----------
    database ... progress
        As in `hydrodae.hdb.fit`, with labels in place of specifications; `store` adds the fit.
    judged : (float, float)
        Band that the tables and the fit are judged in [rad/s].
    tables : HydroDatabase
        Those of the database, without single wrong frequencies.
    bad : (nw,) array of bool
        Frequencies of `tables` that the search leaves out, too.
    left_out : list of str
        What was left out, in words.
    searches : dict or None
        Searches of poles of the look, which serve the search.
    made : ExponentialMemory
        The fit.
    warned : list
        Warnings of the search.
    """

    database: HydroDatabase
    moving: list[str]
    loads: list[str] | None
    name: str
    band: tuple[float, float] | None
    states: int | None
    target: float | None
    uniform: float | None
    time_limit: float | None
    accept: Sequence[str]
    progress: Callable[[str], None] | None
    asked_band: tuple[float, float] | None = None
    judged: tuple[float, float] = (0.0, 0.0)
    tables: HydroDatabase = field(init=False)
    bad: NDArray[np.bool_] = field(init=False)
    left_out: list[str] = field(default_factory=list)
    searches: dict[Any, Any] | None = None
    made: ExponentialMemory = field(init=False)
    warned: list[warnings.WarningMessage] = field(default_factory=list)


def choose_band(state: Fit) -> None:
    """Take the tables; add `judged` [rad/s]: the band asked for, or that of the damping.

    With a uniform target the band goes up to the last frequency that the device feels.
    """
    from hydrodae.hdb.memory.fit import table_band
    from hydrodae.hdb.memory.verdict import CHECKS

    if unknown := [check for check in state.accept if check not in CHECKS]:
        raise CaseError(f"accept {unknown[0]!r}: expected one of {', '.join(CHECKS)}")
    if state.band is None and state.uniform is not None:
        state.band = table_band(state.database)[0], felt_band(state.database)[1]
    state.judged = state.band or table_band(state.database)


def leave_out_lone(state: Fit) -> None:
    """Take the database; add `tables`, those without frequencies off the curve of the others."""
    state.tables, text = without_lone_rows(state.database, state.moving, state.judged)
    state.left_out += [text] if text else []


def look(state: Fit) -> None:
    """Take `tables`; add `bad` (nw,): what no smooth function follows together with the rest.

    Not where a number of states is asked for.
    """
    state.bad = np.zeros(state.tables.omega.size, bool)
    if state.states is not None:
        return
    state.searches = {}
    options = _given(target=state.target, uniform=state.uniform, searches=state.searches)
    state.bad, text = rows_left_out(state.tables, state.moving, state.judged, options)
    if text:
        state.left_out.append(text)
        if state.progress is not None:
            state.progress(text)
    if state.bad.any():
        state.band = state.judged


def search(state: Fit) -> None:
    """Take `tables` without `bad`; add `made`, the best fit that the time allows."""
    from hydrodae.hdb.memory import MemoryFitWarning, fit_memory

    options = _given(
        band=state.band,
        max_states=state.states,
        target=state.target,
        target_outside=OUTSIDE if state.bad.any() else None,
        uniform=state.uniform,
        time_limit=state.time_limit,
        progress=state.progress,
        searches=state.searches,
    )
    with warnings.catch_warnings(record=True) as state.warned:
        warnings.simplefilter("always", MemoryFitWarning)
        state.made = fit_memory(
            state.tables.at_frequencies(~state.bad),
            inputs=state.moving,
            outputs=state.loads,
            name=state.name,
            **options,
        )


def judge(state: Fit) -> None:
    """Take `made`; add to its report what was left out, and refuse it where it is not good enough.

    Without a target of its own, a fit that misses the usual one is kept within the noise of the
    tables. Where frequencies were left out, it must go on to their limit.
    """
    from hydrodae.hdb.memory.verdict import missed

    if state.left_out:
        left_out = "; ".join(state.left_out)
        state.made = replace(state.made, report={**state.made.report, "left_out": left_out})
    allowed = {*state.accept, *(() if state.states is None else ("target",))}
    missing = missed(state.made.report).items()
    refused = {key: why for key, why in missing if key not in allowed}
    if list(refused) == ["target"] and state.target is None and _near_enough(state):
        state.made, refused, state.warned = _as_near(state.made), {}, []
    if state.bad.any() and not goes_on(state.made, state.tables):
        refused["limit"] = "goes to another added mass, or rings, beyond the frequencies it matches"
    if refused:
        cured_by = cure(state.database, state.moving, state.judged)
        raise DatabaseError(f"fit '{state.name}' {_refusal(refused, cured_by)}").about(
            "target", state.name
        )


def store(state: Fit) -> None:
    """Take `made`; add it to the `database`, and say what it missed and was accepted."""
    for warning in state.warned:
        warnings.warn(warning.message, stacklevel=4)
    memory = {**state.database.memory, state.name: state.made}
    state.database = replace(state.database, memory=memory)


def _given(**options: Any) -> dict[str, Any]:
    """Return the options that are not None."""
    return {name: value for name, value in options.items() if value is not None}


def _near_enough(state: Fit) -> bool:
    """Return whether a fit without a target of its own is kept, its error stated."""
    report = state.made.report
    if "uniform" in report:
        return False
    if report["as_near_as_noise"]:
        return True
    noise = report["noise"]
    allowed = max(INERTIA, min(noise, NOISY_INERTIA))
    beyond = report["weighted_error_outside"] <= OUTSIDE or goes_on(
        state.made, state.tables, allowed
    )
    return bool(report["weighted_error_band"] <= max(USUAL, NOISE_TIMES * noise) and beyond)


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
    if report["weighted_error_band"] > USUAL:
        text += f": loads of radiation are known to {report['h_error_band']:.0%} there"
    return replace(fit, report={**report, "noisy": text, "target_met": True})


def goes_on(fit: ExponentialMemory, database: HydroDatabase, inertia: float = INERTIA) -> bool:
    """Return whether a fit goes to the right limit beyond the frequencies that it matches.

    It is passive. Its A_inf is that of the tables within their uncertainty, at least a share
    `inertia` of the largest A.

    |H| nowhere is far beyond what it is at the frequencies of the
    tables that break no law; if all do, at all of them.
    """
    i = database.index(fit.inputs)
    moving = [fit.outputs.index(label) for label in fit.inputs]
    own = np.diag(fit.added_mass_inf[moving])
    off = own - np.diag(database.added_mass_inf)[i]
    size = np.abs(database.added_mass[:, i, i]).max(axis=0)
    allowed = np.maximum(inertia * size, 3.0 * np.diag(database.added_mass_inf_std)[i])
    good = ~suspect_rows(database)
    good |= not good.any()
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
        ways.append("--target E, --band LO,HI or --states N")
    if "passive" in refused:
        ways.append("more states or another --method")
    names = " ".join(f"--accept {check}" for check in refused)
    first = f" {cured_by}." if cured_by else ""
    return (
        f"{', and '.join(refused.values())}.{first} Not kept: give {', or '.join(ways)}, or keep "
        f"this one by {names}"
    )
