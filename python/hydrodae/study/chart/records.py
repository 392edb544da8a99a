"""The runs of a chart, and what they say about its methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from hydrodae.study.chart.methods import parse_method


@dataclass(frozen=True)
class Run:
    """One rung of one method's ladder.

    Attributes
    ----------
    method : str
        Such as "radau:13".
    knob : str
        "rtol" [-] or "step" [s].
    setting : float
        Value of the knob.
    outcome : str
        "ok", or the class of what went wrong: "no convergence", "energy guard", "refused", ...
    reason : str
        First line of the solver's message; empty if it went well.
    error : float or None
        Largest difference relative to the largest excursion, -; None without one to show.
    reference : str
        What the error was measured against.
    time : float or None
        Solver time, best of `repeats`, s; None if it failed.
    wall_time : float or None
        The same with start-up, output and energy balance, s.
    repeats : int
    reached : float
        Simulated time that the run came to, s.
    statistics : dict
        Counts of the solver.
    """

    method: str
    knob: str
    setting: float
    outcome: str
    reason: str = ""
    error: float | None = None
    reference: str = ""
    time: float | None = None
    wall_time: float | None = None
    repeats: int = 0
    reached: float = 0.0
    statistics: dict[str, Any] = field(default_factory=dict)

    @property
    def measured(self) -> bool:
        """Whether the run came to its end and its error is known."""
        return self.outcome == "ok" and self.error is not None and self.time is not None


@dataclass(frozen=True)
class Chart:
    """The runs of a chart, and what they were measured against.

    Attributes
    ----------
    title : str
    case : str
        Path of the case; empty for a case from a string.
    overrides : dict of str
        Replaced values as TOML, by dotted key.
    end_time : float, s
    channels : list of str
        What the error was taken over.
    references : list of str
        In the order of trust, the file or the tight solutions.
    agreement : float or None
        Error of the second reference against the first, -; smaller errors mean nothing.
    runs : list of Run
        By method, from loose to tight.
    machine : dict
        Processor, cores, versions and date.
    """

    title: str
    case: str
    overrides: dict[str, str]
    end_time: float
    channels: list[str]
    references: list[str]
    agreement: float | None
    runs: list[Run]
    machine: dict[str, Any]

    def methods(self) -> list[str]:
        """Labels of the methods, in the order of the chart."""
        return list(dict.fromkeys(run.method for run in self.runs))

    def front(self) -> list[Run]:
        """The Pareto front: runs that no other beats in both error and time, fastest first."""
        return pareto(self.runs)

    def best(self, error: float) -> Run | None:
        """The fastest run whose error is at most `error` [-]; None if no run meets it."""
        return next(iter(self.meeting(error)), None)

    def meeting(self, error: float) -> list[Run]:
        """Every run whose error is at most `error` [-], fastest first."""
        found = [run for run in self.runs if run.measured and (run.error or 0.0) <= error]
        return sorted(found, key=lambda run: run.time or 0.0)


@dataclass(frozen=True)
class Recommendation:
    """What `recommend` found.

    Attributes
    ----------
    run : Run
        The cheapest run that meets the error.
    runner_up : Run or None
        The cheapest one of another method.
    chart : Chart
        All that was measured.
    """

    run: Run
    runner_up: Run | None
    chart: Chart

    def toml(self) -> str:
        """Lines to paste into a case."""
        keys = parse_method(self.run.method).solver(self.run.setting)
        quoted = {key: f'"{v}"' if isinstance(v, str) else f"{v:g}" for key, v in keys.items()}
        return "\n".join(["[solver]", *(f"{key} = {value}" for key, value in quoted.items())])


def pareto(runs: Sequence[Run]) -> list[Run]:
    """Of the measured runs those that no other beats in both error and time, fastest first."""
    front: list[Run] = []
    for run in sorted((r for r in runs if r.measured), key=lambda r: (r.time, r.error)):
        if not front or (run.error or 0.0) < (front[-1].error or 0.0):
            front.append(run)
    return front
