"""Runs of a chart, what became of them, and the solutions that judge them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

from hydrodae.case import Case
from hydrodae.errors import CaseError, RunInterrupted, SolverError
from hydrodae.results import Results
from hydrodae.simulation import run
from hydrodae.simulation.simulate import Progress
from hydrodae.study.chart.methods import ADAPTIVE, Method, parse_method
from hydrodae.study.reference import Solution, default_channels, error, pick, read_file

#: Tolerances of a reference, until one comes to its end.
_TIGHT = (1e-12, 1e-11, 1e-10, 1e-9, 1e-8)
#: Class of a failure by words of the solver's message.
_CLASSES = (
    ("energy_guard", "energy guard"),
    ("velocities jumped", "left its branch"),
    ("have drifted", "constraints drifted"),
    ("no progress", "no progress"),
    ("does not converge", "no convergence"),
    ("local error", "step too short"),
    ("constraints cannot be met", "constraints not met"),
    ("singular", "singular"),
    ("finite", "not finite"),
    ("contradict", "no start"),
    ("CONV_FAIL", "no convergence"),
    ("ERR_FAIL", "step too short"),
)


@dataclass
class Outcome:
    """What became of one run; `solution` is None if it did not come to its end."""

    outcome: str
    reason: str = ""
    solution: Solution | None = None
    time: float = float("nan")
    wall_time: float = 0.0
    reached: float = 0.0
    statistics: dict[str, Any] = field(default_factory=dict)


def classify(message: str) -> str:
    """Short class of a solver's message, such as "no convergence"."""
    first = message.split("\n", 1)[0]
    return next((name for words, name in _CLASSES if words in first), "stopped")


class Runner:
    """Runs a case by one method after the other and keeps the chosen channels.

    Parameters
    ----------
    case : Case
    channels : sequence of str or None
        None for the default ones.
    time_limit : float, s
        Wall time after which a run is stopped.
    progress : callable or None
    expected : int
        Number of runs, for the progress.
    """

    def __init__(
        self,
        case: Case,
        channels: Sequence[str] | None,
        time_limit: float,
        progress: Progress | None,
        expected: int,
    ) -> None:
        self.case = case
        self.names: list[str] = []
        self.units: tuple[str, ...] = ()
        self.columns: dict[str, str] = {}
        self._channels: list[str] | None = None
        if channels is not None:
            pairs = [channel.partition("=") for channel in channels]
            self._channels = [name for name, _, _ in pairs]
            self.columns = {name: column for name, equals, column in pairs if equals}
        self._time_limit = time_limit
        self._progress = progress
        self._expected = expected
        self._done = 0

    def skip(self, runs: int) -> None:
        """Count runs that are not needed as done."""
        self._done += runs

    def run(self, method: Method, setting: float) -> Outcome:
        """Run the case once; failures come back as an outcome.

        Raises
        ------
        CaseError
            A channel does not exist.
        RunInterrupted
            Stopped by the progress callback or by Ctrl-C.
        """
        start = monotonic()
        late = False

        def watch(time: float, end_time: float) -> bool:
            nonlocal late
            late = monotonic() - start > self._time_limit
            go_on = True
            if self._progress is not None:
                whole = max(self._expected, self._done + 1) * end_time
                go_on = self._progress(self._done * end_time + time, whole) is not False
            return go_on and not late

        try:
            results = run(self.case.with_values(method.values(setting)), progress=watch)
        except CaseError as problem:
            return Outcome("refused", str(problem).split("\n", 1)[0])
        except SolverError as problem:
            reached = 0.0 if problem.results is None else problem.results.end_time
            if problem.results is not None:
                self._note(problem.results)
            reason = str(problem).split("\n", 1)[0]
            return Outcome(classify(reason), reason, reached=reached)
        except RunInterrupted as stopped:
            if not late:
                raise
            reached = 0.0 if stopped.results is None else stopped.results.end_time
            reason = f"stopped at t = {reached:g} s: more than {self._time_limit:g} s of wall time"
            return Outcome("too slow", reason, reached=reached)
        finally:
            self._done += 1
        known = results.statistics
        solver, wall = float(known["solver_time"]), float(known["wall_time"])
        return Outcome("ok", "", self._note(results), solver, wall, results.end_time, known)

    def _note(self, results: Results) -> Solution:
        """The chosen channels of a run; their names and units are the same for every run."""
        if self._channels is None:
            self._channels = default_channels(results)
        self.names, solution = pick(results, self._channels)
        self.units = solution.units
        return solution


@dataclass
class Judge:
    """The solutions that errors are measured against.

    Attributes
    ----------
    solutions : list of (str, str, Solution)
        Name, method ("" for a file) and channels; a method is not judged by itself.
    """

    solutions: list[tuple[str, str, Solution]]

    @classmethod
    def prepare(cls, runner: Runner, reference: str | os.PathLike[str] | None) -> Judge:
        """Read the reference file, or solve the case tightly by two methods.

        Raises
        ------
        CaseError
            The file cannot be used; or `reference` is neither a file nor a method.
        """
        first: list[Method] = []
        path = None
        if reference is not None:
            text = os.fspath(reference)
            if Path(text).suffix in (".h5", ".hdf5", ".csv", ".json") or Path(text).exists():
                path = Path(text)
                if not path.is_file():
                    raise CaseError(f"{path}: no such reference file")
            else:
                first = [parse_method(text)]
                if not first[0].adaptive:
                    raise CaseError(f"reference {text!r}: {first[0].name} has no tolerance")
        order = first + [Method(n) for n in ADAPTIVE if n not in [m.name for m in first]]
        wanted = 2 if path is None else 1
        solutions: list[tuple[str, str, Solution]] = []
        for method in order:
            if len(solutions) < wanted and (found := _tightest(runner, method)):
                solutions.append(found)
        if path is not None and runner.names:
            given = read_file(path, runner.names, runner.units, runner.columns)
            solutions.insert(0, (str(path), "", given))
        return cls(solutions)

    @property
    def names(self) -> list[str]:
        """What the solutions are, the most trusted first."""
        return [name for name, _, _ in self.solutions]

    @property
    def agreement(self) -> float | None:
        """Error of the second solution against the first, -; None if there is only one."""
        if len(self.solutions) < 2:
            return None
        return error(self.solutions[1][2], self.solutions[0][2])

    def of(self, method: Method) -> tuple[str, Solution | None]:
        """Name and values of the first solution that is not by `method` itself."""
        for name, judge, solution in self.solutions:
            if judge != method.name:
                return name, solution
        return "", None


def _tightest(runner: Runner, method: Method) -> tuple[str, str, Solution] | None:
    for rtol in _TIGHT:
        found = runner.run(method, rtol)
        if found.solution is not None:
            return f"{method.label} at rtol {rtol:.0e}", method.name, found.solution
        if found.outcome in ("refused", "too slow"):
            return None
    return None
