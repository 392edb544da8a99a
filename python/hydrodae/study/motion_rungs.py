"""Rungs below the time domain on a case with waves: linear response, statistical linearisation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from hydrodae.case import Case
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.linear import LinearModel
from hydrodae.study.reference import Solution
from hydrodae.study.spectral import spectral

Array = NDArray[np.float64]

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
        Standard deviation of the channel [m, rad]; of the run after its ramp and a quarter of the
        rest.
    error : float
        Relative difference from the run [-]. The run is one sea, of one length: its own scatter is
        in it (`hydrodae spectral --seeds`).
    reason : str
        Why it gave nothing.
    """

    name: str
    time: float = np.nan
    deviation: float = np.nan
    error: float = np.nan
    reason: str = ""


def motion_rungs(
    case: Case, channel: str, run: Solution, row: int, time: float
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
    time : float
        Solver time of the run [s].
    """
    if not case.scene.wave_names:
        return []
    head, _, last = channel.rpartition("/")
    name = f"{head}/{_DOFS[last]}" if last in _DOFS else channel
    ramp = _ramp(case)
    start = ramp + 0.25 * (run.time[-1] - ramp)
    truth = float(np.std(run.values[row][run.time >= start]))

    def linear() -> tuple[float, float]:
        model = LinearModel(case)
        begin = perf_counter()
        deviation = model.irregular()[0][name]
        return deviation, perf_counter() - begin

    def in_sea() -> tuple[float, float]:
        found = spectral(case)
        return found.standard_deviation[name], found.time

    return [
        _rung("linear", linear, truth),
        _rung("spectral", in_sea, truth),
        MotionRung("time domain", time, truth),
    ]


def _rung(name: str, solve: Callable[[], tuple[float, float]], truth: float) -> MotionRung:
    try:
        deviation, time = solve()
    except (CaseError, DatabaseError) as problem:
        return MotionRung(name, reason=str(problem).split("\n", 1)[0])
    return MotionRung(name, time, deviation, abs(deviation / truth - 1.0) if truth else np.nan)


def _ramp(case: Case) -> float:
    from hydrodae.case.contents import case_tables

    return float(case_tables(case).get("sea", {}).get("ramp", 0.0))


def lines(rungs: tuple[MotionRung, ...]) -> list[str]:
    """One line a rung."""
    if not rungs:
        return []
    out = [f"{'motion':12} {'time':>12} {'standard deviation':>19} {'error':>9}"]
    for rung in rungs:
        if rung.reason:
            out.append(f"{rung.name:12} {rung.reason}")
            continue
        error = "-" if np.isnan(rung.error) else f"{100 * rung.error:.1f} %"
        out.append(f"{rung.name:12} {1e3 * rung.time:9.2f} ms {rung.deviation:19.4g} {error:>9}")
    return out
