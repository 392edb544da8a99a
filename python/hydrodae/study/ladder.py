"""The ladder of models of a case: what each rung costs, and what it gets wrong."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.case import CaseLike, read_case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError, SolverError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.linear import LinearModel
from hydrodae.simulation import run
from hydrodae.study.motion_rungs import MotionRung, motion_rungs
from hydrodae.study.motion_rungs import lines as motion_lines
from hydrodae.study.reference import Solution, default_channels, pick
from hydrodae.support.arrays import Array

RUNGS = ("none", "constant", "exponential", "convolution")
#: Keys of [hydro] that belong to one model only.
_OWN_KEYS = {"constant": "frequency", "exponential": "fit", "convolution": "memory_length"}


@dataclass(frozen=True)
class Rung:
    """One model of radiation on a case.

    Attributes
    ----------
    name : str
        Of `RUNGS`.
    memory : str
        What it carries: states, or the length of the kernel.
    time : float
        Solver time, best of the repetitions [s]; nan if it did not come to its end.
    steps : int
        Of the integrator.
    kernel_error : float
        Rms difference of its kernel from K(t) over the rms of K [-]; nan where it has no meaning.
    transfer_error : float
        Rms error of H(iw) = B + iw (A - A_inf) in the band that it was made for, as the database
        shows it [-]: that is what a motion feels. A fit may miss K and have H right.
    motion_error : float
        Rms difference of the channel from the next higher rung that ran, over the rms of that
        about its mean [-]; nan for the highest.
    reason : str
        Why it did not run.
    """

    name: str
    memory: str
    time: float = np.nan
    steps: int = 0
    kernel_error: float = np.nan
    transfer_error: float = np.nan
    motion_error: float = np.nan
    reason: str = ""


@dataclass(frozen=True)
class Ladder:
    """All rungs of a case; `frequency` [rad/s] is that of the constant one.

    `motion`: linear response and statistical linearisation beside the run, on a case with waves.
    """

    title: str
    channel: str
    frequency: float
    rungs: tuple[Rung, ...]
    motion: tuple[MotionRung, ...] = ()

    def __str__(self) -> str:
        lines = [
            f"{self.title}: {self.channel}, constant radiation at {self.frequency:.4g} rad/s",
            f"{'radiation':12} {'memory':>28} {'solver time':>12} {'steps':>7} "
            f"{'error of K':>11} {'error of H':>11} {'error of motion':>16}",
        ]
        for rung in self.rungs:
            if rung.reason:
                lines.append(f"{rung.name:12} {rung.memory:>28} did not run (see below)")
                continue
            lines.append(
                f"{rung.name:12} {rung.memory:>28} {1e3 * rung.time:9.2f} ms {rung.steps:7d} "
                f"{_figure(rung.kernel_error):>11} {_figure(rung.transfer_error):>11} "
                f"{_figure(rung.motion_error):>16}"
            )
        lines += [f"{rung.name}: {rung.reason}" for rung in self.rungs if rung.reason]
        return "\n".join(lines + motion_lines(self.motion))


def ladder(
    case: CaseLike,
    *,
    frequency: float | None = None,
    channel: str | None = None,
    repeat: int = 3,
    set: Mapping[str, Any] | None = None,
) -> Ladder:
    """Run a case with every radiation model and measure cost and error.

    Parameters
    ----------
    case : Case, Scene or path
        With a database; rungs that it cannot run (no fit, no kernel) are reported with the reason.
    frequency : float, optional
        Of constant radiation [rad/s]; default: that of the largest wave, else of the least damped
        natural mode of the linearised case.
    channel : str, optional
        Whose error is reported, one series such as "joints/hinge1/angle"; default: the joint
        coordinate (else position) that moves most.
    repeat : int
        Solver times are the best of so many runs.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Returns
    -------
    Ladder
        Printed, it is what the command `hydrodae ladder` says.

    Raises
    ------
    CaseError
        No database, no channel, no frequency to be found, or no rung ran.
    """
    case = read_case(case, set)
    path = case.scene.database_path
    if not path:
        raise CaseError("the case has no [hydro]: there is no radiation to model")
    if repeat < 1:
        raise CaseError(f"repeat = {repeat}: at least one run is needed")
    database = HydroDatabase.read(path)
    omega = dominant_frequency(case) if frequency is None else frequency
    found = [_run(case, name, omega, repeat) for name in RUNGS]
    solutions = [solution for solution, _, _ in found]
    done = [s for s in solutions if s is not None]
    if not done:
        raise CaseError(f"no rung ran: {found[-1][2]}")
    names = done[-1][0]
    row = _chosen(done[-1], channel)
    rungs = []
    for i, name in enumerate(RUNGS):
        solution, statistics, reason = found[i]
        higher = next((s for s in solutions[i + 1 :] if s is not None), None)
        memory, kernel_error, transfer_error = _memory(case, database, name, omega)
        error = np.nan
        if solution is not None and higher is not None:
            top = higher[1].values[row]
            mine = solution[1].at(higher[1].time).values[row]
            error = _rms(mine - top) / _rms(top - top.mean())
        rungs.append(
            Rung(
                name,
                memory,
                float(statistics.get("solver_time", np.nan)),
                int(statistics.get("steps", 0)),
                kernel_error,
                transfer_error,
                error,
                reason,
            )
        )
    last = max(i for i, solution in enumerate(solutions) if solution is not None)
    motion = motion_rungs(case, names[row], done[-1][1], row, found[last][1])
    return Ladder(case.title, names[row], omega, tuple(rungs), tuple(motion))


def dominant_frequency(case: Case) -> float:
    """Frequency [rad/s] of the largest wave component, else of the least damped natural mode.

    Raises
    ------
    CaseError
        No waves, and no mode within the frequencies of the database.
    """
    from hydrodae import _core

    waves = np.asarray(_core.wave_components(case.scene))
    if len(waves):
        return float(waves[np.argmax(waves[:, 2]), 0])
    modes = [mode for mode in LinearModel(case).modes() if not mode.extrapolated]
    if not modes:
        raise CaseError("no natural mode within the database: give --frequency [rad/s]")
    return 2.0 * np.pi / min(modes, key=lambda mode: mode.damping_ratio).period


_Named = tuple[list[str], Solution]


def _run(
    case: Case, name: str, omega: float, repeat: int
) -> tuple[_Named | None, dict[str, Any], str]:
    """All default channels of a run, its statistics with the best time, or the reason."""
    try:
        rung = _rung(case, name, omega)
        runs = [run(rung, set={"solver.accuracy": "none"}) for _ in range(repeat)]
    except (CaseError, SolverError) as problem:
        return None, {}, str(problem).split("\n", 1)[0]
    statistics = dict(runs[0].statistics)
    statistics["solver_time"] = min(float(r.statistics["solver_time"]) for r in runs)
    names, solution = pick(runs[0], default_channels(runs[0]))
    return (names, solution), statistics, ""


def _hydro_table(case: Case) -> dict[str, Any]:
    """Table [hydro] of the case, with the values that were replaced."""
    return dict(case_tables(case).get("hydro", {}))


def _rung(case: Case, name: str, omega: float) -> Case:
    """The case with another model of radiation, without the keys that belong to the others."""
    table = _hydro_table(case)
    for model, key in _OWN_KEYS.items():
        if model != name:
            table.pop(key, None)
    table["radiation"] = name
    if name == "constant":
        table["frequency"] = omega
    values = {
        key: tomllib.loads(f"x = {text}")["x"]
        for key, text in case.overrides.items()
        if key.partition(".")[0] != "hydro"
    }
    values["hydro"] = table
    if case.path is not None:
        return Case(path=case.path, values=values)
    return Case(case.text, directory=case.directory, values=values)


def _chosen(found: _Named, channel: str | None) -> int:
    names, solution = found
    if channel is None:
        return int(np.argmax([_rms(row - row.mean()) for row in solution.values]))
    if channel not in names:
        raise CaseError(f"no channel {channel!r} among {', '.join(names)}")
    return names.index(channel)


def _memory(
    case: Case, database: HydroDatabase, name: str, omega: float
) -> tuple[str, float, float]:
    """What a rung carries, and its errors of K and of H."""
    kernel = database.kernel
    if name == "none":
        return "-", np.nan if kernel is None else 1.0, np.nan
    if name == "constant":
        return f"A, B at {omega:.4g} rad/s", np.nan, np.nan
    if name == "convolution":
        if kernel is None:
            return "no kernel", np.nan, np.nan
        length = _hydro_table(case).get("memory_length")
        error = kernel.report.get("h_error_band", np.nan) if length is None else np.nan
        return f"{length or kernel.length:.4g} s", 0.0, error
    moving = LinearModel(case).hydro_labels
    named = _hydro_table(case).get("fit")
    fits = [
        f
        for f in database.memory.values()
        if set(moving) <= set(f.inputs) and named in (None, f.name)
    ]
    if not fits:
        return "no fit", np.nan, np.nan
    fit = min(fits, key=lambda f: f.n_states)
    error = fit.report.get("h_error_band", np.nan)
    return f"{fit.n_states} states", _kernel_error(fit, database, moving), error


def _kernel_error(
    fit: ExponentialMemory, database: HydroDatabase, moving: tuple[str, ...]
) -> float:
    """Rms difference of the fit's kernel over the rms of K, scaled by the roots of the diagonal."""
    kernel = database.kernel
    if kernel is None or not set(moving) <= set(kernel.inputs):
        return np.nan
    own = kernel.selected(moving)
    assert own is not None
    rows = [fit.outputs.index(label) for label in own.outputs]
    columns = [fit.inputs.index(label) for label in own.inputs]
    theirs = fit.kernel(own.time)[:, rows][:, :, columns]
    k = [own.outputs.index(label) for label in own.inputs]
    size = np.abs(np.einsum("tii->ti", own.values[:, k])).max(axis=0)
    root = np.sqrt(np.where(size > 1e-9 * size.max(), size, np.inf))
    scale = np.outer(root, root)
    return _rms((theirs - own.values)[:, k] / scale) / _rms(own.values[:, k] / scale)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _figure(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.1e}"
