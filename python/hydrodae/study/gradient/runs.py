"""Gradients in the time domain: forward sensitivities of runs with fixed steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from hydrodae import _core
from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.simulation import run
from hydrodae.study.gradient.differences import slopes_of
from hydrodae.study.gradient.parameters import Parameter
from hydrodae.study.gradient.quantity import POWER, Found, Quantity

#: Methods whose steps do not follow the solution.
FIXED = tuple(sorted(m["name"] for m in _core.methods() if m["fixes"]))


def run_gradient(
    case: Case,
    what: Quantity,
    parameters: Sequence[Parameter],
    functions: FunctionFile | None = None,
) -> Found:
    """Value and gradient of a quantity of runs of a case.

    Internal numerical differentiation (Bock, 1981): all runs take the same fixed steps, so that
    their differences are those of one smooth map, the discrete solution, without the jumps that a
    choice of steps makes in an adaptive one.

    Raises
    ------
    CaseError
        The case does not ask for fixed steps, or cannot be run nearby.
    SolverError
        A run failed.
    """
    _check_steps(case)
    units: list[str] = []

    def value(there: Case) -> float:
        number, unit = _measured(there, what, functions)
        units.append(unit)
        return number

    found = slopes_of(value, case, parameters, "")
    return replace(found, unit=units[0])


def _check_steps(case: Case) -> None:
    solver = case_tables(case).get("solver", {})
    method, step = solver.get("method", "auto"), float(solver.get("step", 0.0))
    if method not in FIXED or not step > 0.0:
        raise CaseError(
            "gradients of runs need fixed steps: set solver.method to one of "
            f"{', '.join(FIXED)} and solver.step > 0 (here {method!r} and {step:g} s); or take a "
            'linear model of the motion: rungs = ["spectral"] or ["frequency"] in a study, '
            "rung='spectral' or 'frequency' in Python",
            key="solver.method",
        )


def _measured(case: Case, what: Quantity, functions: FunctionFile | None) -> tuple[float, str]:
    """The quantity of a run, and its unit."""
    called = functions.read() if functions else {}
    results = run(case, set={"solver.accuracy": "none"}, **called)
    if what.measure is not None:
        return what.measure(results)
    keys = [f"{POWER}.{name}" for name in what.take_offs(case)]
    if what.name == POWER and POWER in results.statistics:
        keys = [POWER]
    missing = [key for key in keys if key not in results.statistics]
    if missing:
        raise CaseError(
            f"the run has no {missing[0]}: mean powers are taken after the ramp of the waves "
            "(sea.ramp), which the run does not reach"
        )
    return sum(float(results.statistics[key]) for key in keys), "W"
