"""Rungs below the time domain on a case with waves: linear response, statistical linearisation."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.sea import wave_components
from hydrodae.results.sampling import NONE, PERIODS, Interval, mean_interval, std_interval
from hydrodae.study.reference import Solution
from hydrodae.study.spectral import spectral
from hydrodae.support.arrays import Array, Complex

_DOFS = {
    "position.x": "surge", "position.y": "sway", "position.z": "heave",
    "rotation.x": "roll", "rotation.y": "pitch", "rotation.z": "yaw",
}  # fmt: skip


@dataclass(frozen=True)
class MotionRung:
    """One method on a case with waves.

    Attributes
    ----------
    name : str
        "linear", "spectral" or "time domain".
    time : float
        [s]: of a run that of the solver, else of the solution of the linearised case.
    deviation : float
        Standard deviation of the channel [unit of the channel, angles in degrees]: of the rungs
        below the run that of the sea state, of the run that of its record after the ramp and a
        quarter of the rest.
    interval : (float, float)
        95 % interval of the deviation of the sea state, by the run (`hydrodae.results.sampling`);
        nan without an irregular sea, of too short a record, and of the other rungs, which are
        exact.
    error : float
        Relative difference of the deviation from the run (above it: positive) over the same record:
        the same waves with the same phases, the same time [-].
    error_interval : (float, float)
        95 % interval of that difference in other records of the sea state [-]; nan as above.
    reason : str
        Why it gave nothing.
    no_interval : str
        Why an irregular sea gives no interval.
    """

    name: str
    time: float = np.nan
    deviation: float = np.nan
    interval: Interval = NONE
    error: float = np.nan
    error_interval: Interval = NONE
    reason: str = ""
    no_interval: str = ""


@dataclass(frozen=True)
class _Found:
    """A linear rung: of the sea state, and its phasors per metre in each wave (nw,)."""

    deviation: float
    time: float
    phasors: Complex


def motion_rungs(
    case: Case, channel: str, run: Solution, row: int, statistics: Mapping[str, Any]
) -> list[MotionRung]:
    """Linear response, spectral and the run of a case, cheapest first; none without waves.

    Parameters
    ----------
    case : Case
    channel : str
        Of the run, such as "joints/hinge1/angle" or "bodies/float/position.z".
    run : Solution
        The highest rung of radiation; `row` is the channel's.
    row : int
    statistics : mapping
        Of the run: its solver time and the period of its sea [s].
    """
    if not case.scene.wave_names:
        return []
    head, _, last = channel.rpartition("/")
    name = f"{head}/{_DOFS[last]}" if last in _DOFS else channel
    waves = wave_components(case)
    start = _ramp(case) + 0.25 * (run.time[-1] - _ramp(case))
    period = float(statistics.get("sea_period", np.inf))  # a regular wave is no sample
    sampled = run.time[-1] - start >= PERIODS * period
    too_short = (
        f"too short for an interval of the sea state, which needs {PERIODS * period:.3g} s from "
        f"t = {start:.4g} s on"
    )
    kept = run.time >= start
    record = run.values[row][kept]
    truth = float(np.std(record))
    factor = np.degrees(1.0) if run.units[row].startswith("deg") else 1.0

    def rung(title: str, solve: Callable[[Case, str, Array], _Found]) -> MotionRung:
        try:
            found = solve(case, name, waves)
        except (CaseError, DatabaseError) as problem:
            return MotionRung(title, reason=str(problem).split("\n", 1)[0])
        same = factor * record_of(found.phasors, waves, run.time[kept])
        error = float(np.std(same)) / truth - 1.0 if truth else np.nan
        worth = paired_interval(same, record) if sampled and truth else NONE
        return MotionRung(title, found.time, factor * found.deviation, NONE, error, worth)

    interval = std_interval(record) if sampled else NONE
    return [
        rung("linear", _linear),
        rung("spectral", _spectral),
        MotionRung(
            "time domain",
            float(statistics["solver_time"]),
            truth,
            interval,
            no_interval="" if sampled or np.isinf(period) else too_short,
        ),
    ]


def _linear(case: Case, name: str, waves: Array) -> _Found:
    model = LinearModel(case)
    begin = perf_counter()
    deviation = model.irregular()[0][name]
    spent = perf_counter() - begin
    phasors = np.empty(len(waves), dtype=complex)
    for heading in np.unique(waves[:, 1]):
        mine = waves[:, 1] == heading
        phasors[mine] = model.response(waves[mine, 0], float(heading))[name]
    return _Found(deviation, spent, phasors)


def _spectral(case: Case, name: str, _waves: Array) -> _Found:
    found = spectral(case)
    phasors = found.values[:, found.names.index(name)]
    return _Found(found.standard_deviation[name], found.time, phasors)


def paired_interval(values: Array, reference: Array) -> Interval:
    """95 % interval of the relative difference of two standard deviations over one record.

    With q the quotient of the deviations here, d = (x^2 - q^2 y^2) / (2 q s_y^2) has the mean 0 and
    is to first order what each sample adds to the difference: the interval is that of its mean,
    about q - 1. What moves both alike cancels in it.

    Parameters
    ----------
    values, reference : (n,) array
        x and y, whose means are taken off, at the same equal steps.

    Returns
    -------
    (float, float)
        [-]; nan for too few samples.
    """
    x, y = values - values.mean(), reference - reference.mean()
    quotient = float(np.std(x) / np.std(y))
    low, high = mean_interval((x**2 - (quotient * y) ** 2) / (2.0 * quotient * np.var(y)))
    return quotient - 1.0 + low, quotient - 1.0 + high


def record_of(phasors: Complex, waves: Array, time: Array) -> Array:
    """Record of a linear response in these waves, Re sum of a X e^{i (w t + phase)}.

    Parameters
    ----------
    phasors : (nw,) complex array
        X, per metre of wave amplitude.
    waves : (nw, 4) array
        As `wave_components`.
    time : (n,) array, s

    Returns
    -------
    (n,) array
        Unit of `phasors` times m.
    """
    factors = phasors * waves[:, 2] * np.exp(1j * waves[:, 3])
    return np.asarray((np.exp(1j * np.outer(time, waves[:, 0])) @ factors).real)


def _ramp(case: Case) -> float:
    from hydrodae.case.contents import case_tables

    return float(case_tables(case).get("sea", {}).get("ramp", 0.0))


def lines(rungs: tuple[MotionRung, ...]) -> list[str]:
    """One line a rung."""
    if not rungs:
        return []
    out = [
        f"{'motion':12} {'time':>12} {'standard deviation':>19} {'95 %':>17} "
        f"{'error, same record (95 %)':>32}"
    ]
    for rung in rungs:
        if rung.reason:
            out.append(f"{rung.name:12} {rung.reason}")
            continue
        low, high = rung.interval
        ends = "-" if np.isnan(low) else f"{low:.3g} to {high:.3g}"
        error = "-" if np.isnan(rung.error) else f"{100 * rung.error:+.2f} %"
        if not np.isnan(rung.error_interval[0]):
            least, most = (f"{100 * end:+.2f}" for end in rung.error_interval)
            error += f" ({least} to {most})"
        figures = f"{1e3 * rung.time:9.2f} ms {rung.deviation:19.4g}"
        out.append(f"{rung.name:12} {figures} {ends:>17} {error:>32}")
    return out + [f"{rung.name}: {rung.no_interval}" for rung in rungs if rung.no_interval]
