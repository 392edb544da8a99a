"""The best values of a few parameters of a case, by their gradients."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from hydrodae.case import Case
from hydrodae.case.callbacks.files import function_file
from hydrodae.errors import CaseError, HydrodaeError
from hydrodae.study.gradient import Objective
from hydrodae.study.gradient.parameters import read_parameter, started, values_of
from hydrodae.study.sweep.journal import Journal, Row
from hydrodae.study.sweep.plan import point_key
from hydrodae.study.sweep.problem import METHODS, Problem, read_problem
from hydrodae.study.sweep.rungs import check_runs, open_case
from hydrodae.study.sweep.table import claim, texts_of, write
from hydrodae.support.arrays import Array
from hydrodae.support.version import version

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Optimum:
    """What an optimiser found.

    Attributes
    ----------
    values : dict
        Best values of the parameters by name, and of the keys of the case by dotted key.
    keys : dict
    value : float
    unit : str
    evaluations : int
        Of value and gradient.
    calls : int
        Linearisations or runs of the case.
    message : str
        Why the optimiser stopped.
    dataset : xarray.Dataset
        Every evaluation in its order.
    """

    values: dict[str, float]
    keys: dict[str, Any]
    value: float
    unit: str
    evaluations: int
    calls: int
    message: str
    dataset: xarray.Dataset


def optimise(
    study: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    set: Mapping[str, Any] | None = None,
    functions: str | os.PathLike[str] | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> Optimum:
    """Find the best values of the parameters of a study, by gradients, within their bounds.

    Every evaluation is kept at once in ``X.runs.jsonl`` beside ``X.nc``: an optimisation that was
    killed goes on from there, and evaluates nothing twice.

    Parameters
    ----------
    study : path
        A study file with the table [optimise] (docs/sweeps.md).
    output : path
        ``X.nc``, replaced when all is done.
    set : mapping from str, optional
        Values that replace those of the case.
    functions : path, optional
        As in `hydrodae.sweep`.
    progress : callable, optional
        Called with the numbers of evaluations so far and at most.

    Raises
    ------
    CaseError
        The study, its case or the functions cannot be used, at a point that the optimiser asks for
        as well.
    SolverError
        A run failed.
    """
    problem = read_problem(study)
    if functions is not None:
        check_runs(functions, (problem.rung,), problem.path)
        problem = replace(problem, functions=function_file(functions))
    case = open_case(problem.case, set or {}, (problem.rung,))
    objective = _objective(problem, case)
    target = claim(output)
    record = target.with_name(target.stem + ".runs.jsonl")
    with Journal(record, problem.identity(objective.case)) as journal:
        path = _Path(problem, objective, journal, progress)
        found = path.run()
    dataset = _dataset(problem, path.rows, objective.case, _ending(found.message))
    write(target, dataset)
    best = path.rows[int(dataset["best"])]
    point = best["point"]
    keys = values_of(objective.parameters, list(point.values()))
    return Optimum(
        point, keys, best["value"], best["unit"], len(path.rows),
        sum(row["calls"] for row in path.rows), _ending(found.message), dataset,
    )  # fmt: skip


def _ending(message: str) -> str:
    """Why scipy ended the search, in plain words where it has none."""
    words = {
        "CONVERGENCE: RELATIVE": "converged: the value changes by less than the tolerance",
        "CONVERGENCE: NORM": "converged: no slope is left within the bounds",
        "Optimization terminated": "converged: the value changes by less than the tolerance",
    }
    return next((plain for start, plain in words.items() if message.startswith(start)), message)


def _objective(problem: Problem, case: Case) -> Objective:
    """The objective of a problem, started where the problem says, else in the case."""
    parameters = []
    for bound in problem.parameters:
        if bound.start is not None:
            case = started(case, bound.keys, bound.start)
        parameter = read_parameter(case, bound.keys, bound.name)
        low, high = bound.bounds
        if not low <= parameter.value <= high:
            raise CaseError(
                f"{problem.path}: [optimise.parameter.{bound.name}]: the case has "
                f"{parameter.value:g}, outside the bounds {low:g} to {high:g}: give 'start'"
            )
        parameters.append(parameter)
    sign = -1.0 if problem.maximise else 1.0
    return Objective(case, problem.quantity, parameters, problem.rung, sign, problem.functions)


class _Path:
    """The way of an optimiser through the parameters, each scaled to 0..1 between its bounds."""

    def __init__(
        self,
        problem: Problem,
        objective: Objective,
        journal: Journal,
        progress: Callable[[float, float], None] | None,
    ) -> None:
        self.problem, self.objective = problem, objective
        self.journal, self.progress = journal, progress
        self.rows: list[Row] = []
        self._low = np.array([p.bounds[0] for p in problem.parameters])
        self._width = np.array([p.bounds[1] for p in problem.parameters]) - self._low
        self._size = 1.0  # of the objective at the start

    def run(self) -> OptimizeResult:
        """Minimise from the start of the objective."""
        start = (self.objective.start - self._low) / self._width
        first = self._row(self._low + self._width * start)
        self._size = abs(first["value"]) or 1.0
        options: dict[str, Any] = {"maxiter": self.problem.most}
        options["ftol"] = self.problem.tolerance
        own = METHODS[self.problem.method]
        options |= {name: getattr(self.problem, limit) for name, limit in own.items()}
        return minimize(
            self._value,
            start,
            jac=True,
            bounds=[(0.0, 1.0)] * len(start),
            method=self.problem.method,
            options=options,
        )

    def _value(self, scaled: Array) -> tuple[float, Array]:
        row = self._row(self._low + self._width * np.clip(scaled, 0.0, 1.0))
        sign = self.objective.sign / self._size
        return sign * row["value"], sign * self._width * np.array(row["gradient"])

    def _row(self, x: Array) -> Row:
        names = [p.name for p in self.problem.parameters]
        point = {name: float(value) for name, value in zip(names, x, strict=True)}
        key = point_key(point)
        row = self.journal.rows.get(key)
        if row is None:
            row = self._evaluate(key, point)
            self.journal.add(row)
        if all(known["key"] != key for known in self.rows):
            self.rows.append(row)
            if self.progress is not None:
                self.progress(len(self.rows), max(self.problem.most, len(self.rows)))
        return row

    def _evaluate(self, key: str, point: dict[str, float]) -> Row:
        try:
            found = self.objective.at(list(point.values()))
        except HydrodaeError as error:
            where = ", ".join(f"{name} = {value:g}" for name, value in point.items())
            raise type(error)(f"at {where}: {error}") from None
        return {
            "key": key,
            "point": point,
            "value": found.value,
            "unit": found.unit,
            "gradient": [float(slope) for slope in found.gradient],
            "calls": found.calls,
        }


def _dataset(problem: Problem, rows: list[Row], case: Case, message: str) -> xarray.Dataset:
    import xarray as xr

    values = np.array([row["value"] for row in rows])
    best = int(np.argmax(values) if problem.maximise else np.argmin(values))
    along = "evaluation"
    units = {"units": rows[0]["unit"]}
    out: dict[str, Any] = {problem.name: (along, values, units), "best": ((), best)}
    for n, parameter in enumerate(problem.parameters):
        low, high = parameter.bounds
        told = {"key": ", ".join(parameter.keys), "least": low, "most": high}
        out[parameter.name] = (along, [row["point"][parameter.name] for row in rows], told)
        out[f"gradient_{parameter.name}"] = (along, [row["gradient"][n] for row in rows])
    out["calls"] = (along, [row["calls"] for row in rows])
    attributes = {
        **texts_of(case),
        "study": problem.text,
        "hydrodae": version(),
        "quantity": problem.name,
        "goal": "maximise" if problem.maximise else "minimise",
        "rung": problem.rung,
        "method": problem.method,
        "message": message,
    }
    return xr.Dataset(out, attrs=attributes)


def text(found: Optimum) -> str:
    """The best values and what they took, for people."""
    names = [name for name in found.dataset.data_vars if found.dataset[name].dims]
    first = float(found.dataset[names[0]][0])
    work = f"{found.evaluations} evaluations, {found.calls} linearisations or runs of the case"
    lines = [f"{found.message}; {work}"]
    lines.append(f"{names[0]} = {found.value:.6g} {found.unit} (at the start {first:.6g})")
    lines += [f"  {name} = {value:.6g}" for name, value in found.values.items()]
    return "\n".join(lines)
