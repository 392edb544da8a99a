"""Every method over a ladder of tolerances or steps: the runs that a chart is made of."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError
from hydrodae.simulation.simulate import Progress
from hydrodae.study.chart import methods as methods_of
from hydrodae.study.chart.machine import machine
from hydrodae.study.chart.methods import ADAPTIVE, METHODS, SHORT_METHODS, TOLERANCES, Method
from hydrodae.study.chart.records import Chart, Recommendation, Run
from hydrodae.study.chart.runs import Judge, Runner
from hydrodae.study.reference import error

#: Tolerances that `recommend` compares.
SHORT_TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9)
#: Rungs of a ladder of steps that the scene chooses.
_STEPS, _SHORT_STEPS = 7, 4
#: A mean step is taken from a run at this tolerance.
_SCOUT = 1e-4


def chart(
    case: CaseLike,
    *,
    methods: Sequence[str] = METHODS,
    tolerances: Sequence[float] = TOLERANCES,
    steps: Sequence[float] | None = None,
    channels: Sequence[str] | None = None,
    reference: str | os.PathLike[str] | None = None,
    repeat: int = 3,
    time_limit: float = 60.0,
    set: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Chart:
    """Run every method over a ladder of tolerances or steps, one run after the other.

    Parameters
    ----------
    case : Case, Scene or path
    methods : sequence of str
        "name" or "name:order", such as "radau:13".
    tolerances : sequence of float, -
        `rtol` of auto, ida, radau and explicit_rk.
    steps : sequence of float, s, optional
        Of generalized_alpha, gauss and lobatto_iiic. By default seven, each half the one before,
        from about four times the mean step of ida (else radau, explicit_rk) at rtol 1e-4.
    channels : sequence of str, optional
        Names or shell patterns, "CHANNEL=COLUMN" for another name in the reference file. By default
        all joint coordinates, or the bodies' positions if there are none.
    reference : path or str, optional
        A results file, CSV or JSON table; or the method whose tightest solution is the reference.
        By default radau at rtol 1e-12, and explicit_rk (else ida) to judge radau itself; if a
        method fails there, the tightest tolerance at which it comes to the end.
    repeat : int
        The solver time is the best of so many runs (fewer when a run takes seconds).
    time_limit : float, s
        A run that takes longer is stopped and marked.
    set : mapping from str, optional
        Values of the case by dotted key.
    progress : callable, optional
        Called with the simulated time of all runs so far and in all, s.

    Returns
    -------
    Chart
        A run that fails is marked with its reason, never dropped.

    Raises
    ------
    CaseError
        The case or an argument is wrong, or nothing moves.
    RunInterrupted
        Stopped by `progress` or Ctrl-C.
    """
    chosen = methods_of.parse_methods(methods)
    ladder = methods_of.check_ladder(tolerances, "tolerances", 1e-13, 1e-1)
    if repeat < 1:
        raise CaseError(f"repeat: {repeat} is less than 1")
    if not time_limit > 0:
        raise CaseError(f"time limit: {time_limit:g} s is not positive")
    case = read_case(case, set)
    given = None if steps is None else methods_of.check_ladder(steps, "steps", 1e-12, case.end_time)
    rungs = (
        len(given) if given else (_STEPS if len(ladder) > len(SHORT_TOLERANCES) else _SHORT_STEPS)
    )
    fixed = sum(not method.adaptive for method in chosen)
    total = (len(chosen) - fixed) * len(ladder) + fixed * rungs
    runner = Runner(case, channels, time_limit, progress, total * repeat + 3)
    judge = Judge.prepare(runner, reference)
    by_step = given or (_scene_steps(runner, rungs) if fixed else [])
    runs = [
        _measure(runner, judge, method, setting, repeat)
        for method in chosen
        for setting in (ladder if method.adaptive else by_step)
    ]
    if runs and all(run.outcome == "refused" for run in runs):
        raise CaseError(runs[0].reason)
    return Chart(
        title=case.title,
        case=str(case.path or ""),
        overrides=case.overrides,
        end_time=case.end_time,
        channels=runner.names,
        references=judge.names,
        agreement=judge.agreement,
        runs=runs,
        machine=machine(),
    )


def recommend(
    case: CaseLike, error: float, *, methods: Sequence[str] = SHORT_METHODS, **options: Any
) -> Recommendation:
    """Find the cheapest method and tolerance that meet an error, from a short chart.

    The whole run is simulated, for an error at its end may be another than on the way; short is
    the ladder: four tolerances two decades apart, four steps, best of two runs. The setting that is
    named was run itself; nothing is interpolated.

    Parameters
    ----------
    case : Case, Scene or path
    error : float, -
        As `chart` measures it: 1e-3 is a thousandth of the largest excursion.
    methods : sequence of str
    **options
        Further arguments of `chart`.

    Returns
    -------
    Recommendation

    Raises
    ------
    CaseError
        As `chart`; or no run meets the error, or the references differ by more than it.
    """
    if not 0 < error < 1:
        raise CaseError(f"error: {error:g} is not between 0 and 1")
    short = {"tolerances": SHORT_TOLERANCES, "repeat": 2}
    made = chart(case, methods=methods, **{**short, **options})
    found = made.meeting(error)
    if not found:
        measured = [run for run in made.runs if run.measured]
        least = min(measured, key=lambda run: run.error or 0.0, default=None)
        told = "no run came to its end"
        if least is not None:
            told = f"the least is {least.error:.1e}, {least.method} {least.knob} {least.setting:g}"
        raise CaseError(f"no run meets the error {error:g}: {told}")
    if made.agreement is not None and made.agreement > error:
        raise CaseError(
            f"an error of {error:g} cannot be measured: the references "
            f"({', '.join(made.references)}) differ by {made.agreement:.1e}"
        )
    others = (run for run in found if run.method != found[0].method)
    return Recommendation(found[0], next(others, None), made)


def _scene_steps(runner: Runner, rungs: int) -> list[float]:
    """Ladder of steps from an adaptive run; from the end time if none comes to its end."""
    for name in reversed(ADAPTIVE):
        scout = runner.run(Method(name), _SCOUT)
        if scout.solution is not None:
            mean = runner.case.end_time / max(int(scout.statistics["steps"]), 1)
            output = float(scout.solution.time[1] - scout.solution.time[0])
            return methods_of.step_ladder(mean, min(output, runner.case.end_time), rungs)
    return [runner.case.end_time / 100.0 / 2.0**k for k in range(rungs)]


def _measure(runner: Runner, judge: Judge, method: Method, setting: float, repeat: int) -> Run:
    """One rung: best of `repeat` runs, and the error of the first."""
    first = runner.run(method, setting)
    best, count, spent = first, 1, first.wall_time
    while first.solution is not None and count < repeat and spent < 10.0:
        again = runner.run(method, setting)
        count, spent = count + 1, spent + again.wall_time
        if again.solution is not None and again.time < best.time:
            best = again
    runner.skip(repeat - count)
    mark = Run(
        method.label, method.knob, setting, first.outcome, first.reason, reached=first.reached
    )
    if first.solution is None:
        return mark
    name, truth = judge.of(method)
    return Run(
        **{
            **mark.__dict__,
            "error": None if truth is None else error(first.solution, truth),
            "reference": name,
            "time": best.time,
            "wall_time": best.wall_time,
            "repeats": count,
            "statistics": first.statistics,
        }
    )
