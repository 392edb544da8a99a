"""Time at equal error: hydrodae beside Exudyn on the smooth multibody benchmark cases.

    .venv/bin/python tests/benchmark/peers.py [--repeats 3] [NAME ...]

Error: largest deviation of one quantity of the mechanism from its exact motion over all output
times, the same quantity and times for both. Time, best of the repeats: for hydrodae the wall
time of the integrator with residuals and Jacobians (statistics solver_time), in brackets with all
that follows the steps (samples of all channels, energy balance, guards, writing the results); for
Exudyn the processor time of SolveDynamic, which keeps the one quantity in memory and writes no
files. Ratios are of the former. On a busy machine the comparison is to Exudyn's favour. Reading,
building and assembling the models is in neither.

Exudyn runs with its fast build and with the settings of peer_problems.py, hydrodae the case as it
is with a ladder of methods and tolerances. The ratio of a row is Exudyn's time over that of the
fastest run of hydrodae with an error no larger. The table at the end holds, of each problem, the
cheapest run of Exudyn that meets the criterion. Gates nothing.
"""

from __future__ import annotations

import argparse
import math
import sys
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.benchmark.peer_problems import ALPHA, PROBLEMS, TRAPEZOIDAL, Problem, Setting  # noqa: E402
from tests.verification import multibody  # noqa: E402
from tests.verification.truths import make as truths  # noqa: E402

import hydrodae  # noqa: E402
from hydrodae.support.extras import install_command  # noqa: E402

Reference = dict[str, Any]
Timed = Callable[[], tuple[Any, float]]  # a result and the seconds that it took

SHORT = {ALPHA: "generalised alpha", TRAPEZOIDAL: "trapezoidal"}
ENOUGH, MOST = 0.5, 12  # s in all repeats of a run, and their number, beyond those asked for


@dataclass(frozen=True)
class Row:
    """One run."""

    label: str
    error: float
    seconds: float
    whole: float | None = None  # with samples, energy balance and results

    def told(self, unit: str) -> str:
        whole = f" ({1e3 * self.whole:.2f} ms)" if self.whole else ""
        return f"{self.label:<30}{self.error:9.1e} {unit:<6}{1e3 * self.seconds:9.2f} ms{whole}"

    def cell(self) -> str:
        whole = f" ({milliseconds(self.whole)})" if self.whole else ""
        return f"{self.label}: {self.error:.1e}, {milliseconds(self.seconds)} ms{whole}"


@dataclass(frozen=True)
class Pair:
    """A run of Exudyn and the fastest of hydrodae with an error no larger."""

    peer: Row
    own: Row | None

    @property
    def ratio(self) -> float:
        return self.peer.seconds / self.own.seconds if self.own else math.nan

    def told(self, problem: Problem) -> str:
        note = "" if self.peer.error <= problem.criterion else ", misses the criterion"
        if not self.own:
            return f"no run of hydrodae is as exact{note}"
        return f"{self.ratio:6.1f} x ({self.own.label}, {self.own.error:.1e}){note}"


def two_digits(value: float) -> str:
    return f"{value:.{max(0, 1 - math.floor(math.log10(value)))}f}"


def milliseconds(seconds: float) -> str:
    return two_digits(1e3 * seconds)


def case_of(name: str) -> Path:
    return ROOT / "cases" / "benchmarks" / f"{name}.toml"


def reference_of(name: str, end_time: float | None) -> Reference:
    """The document, its rows to the end time; empty where the truth is computed."""
    if name not in truths.PROBLEMS:
        return {}
    reference = truths.read(name)
    if end_time:
        time = reference["columns"].index("t")
        reference["rows"] = [row for row in reference["rows"] if row[time] < end_time + 1e-9]
    return reference


def best_of(run: Timed, repeats: int) -> tuple[Any, float]:
    """The result of the first run and the least time."""
    result, least = run()
    done, spent = 1, least
    while done < repeats or (spent < ENOUGH and done < MOST):
        seconds = run()[1]
        least, spent, done = min(least, seconds), spent + seconds, done + 1
    return result, least


def ours(name: str, problem: Problem, reference: Reference, repeats: int) -> list[Row]:
    times = ("setup", "solver", "wall")
    wholes: list[float] = []

    def run(**solver: Any) -> tuple[Any, float]:
        if problem.end_time:
            solver["end_time"] = problem.end_time
        values = {f"solver.{key}": value for key, value in solver.items()}
        results = hydrodae.run(case_of(name), set=values)
        found = {key: float(results.statistics[f"{key}_time"]) for key in times}
        wholes.append(found["wall"] - found["setup"])
        return results, found["solver"]

    rows = []
    for runs in problem.ours:
        chosen = {"method": runs.method, "order": runs.order, "formulation": runs.formulation}
        method = {key: value for key, value in chosen.items() if value}
        controls = [("rtol", value) for value in runs.tolerances]
        controls += [("step", value) for value in runs.steps]
        for key, value in controls:
            size = f"{value:.0e}" if key == "rtol" else f"h {1e3 * value:.3g} ms"
            label = f"{' '.join(map(str, method.values()))}, {size}"
            wholes.clear()
            try:
                results, seconds = best_of(partial(run, **method, **{key: value}), repeats)
            except hydrodae.SolverError as stop:
                print(f"  hydrodae {label:<30}{str(stop).splitlines()[0][:120]}", flush=True)
                continue
            error = multibody.PROBLEMS[name](results, reference)[problem.error]
            rows.append(Row(label, error, seconds, min(wholes)))
            print(f"  hydrodae {rows[-1].told(problem.unit)}", flush=True)
    return rows


def theirs(
    name: str, problem: Problem, reference: Reference, repeats: int, own: list[Row]
) -> list[Pair]:
    from tests.benchmark import exudyn_models

    def run(setting: Setting, parts: int, verbose: bool = False) -> tuple[Any, float]:
        model = exudyn_models.Model(case_of(name), problem.compared, setting)
        return model.run(parts, problem.end_time, verbose)

    output_step = tomllib.loads(case_of(name).read_text())["output"]["step"]
    pairs = []
    for ladder in problem.ladders:
        setting, coarser = ladder.setting, None
        print(f"  {setting}")
        for parts in ladder.parts:
            solver = SHORT.get(setting.solver, setting.solver)
            label = f"{solver}, h {1e3 * output_step / parts:.3g} ms"
            once = partial(run, setting, parts)
            try:
                path, seconds = best_of(once, repeats)
            except RuntimeError:
                words = exudyn_models.reason(partial(once, verbose=True))
                print(f"  Exudyn   {label:<30}stopped: {words}", flush=True)
                continue
            time = np.arange(len(path), dtype=float) * output_step
            error = multibody.largest(problem.taken(path), problem.exact(reference, time))
            row = Row(label, error, seconds)
            able = [other for other in own if other.error <= error]
            fastest = min(able, key=lambda other: other.seconds) if able else None
            pairs.append(Pair(row, fastest))
            order = f"{'':10}"
            if coarser:
                slope = math.log(coarser[0] / error) / math.log(parts / coarser[1])
                order = f"order {slope:4.1f}"
            print(
                f"  Exudyn   {row.told(problem.unit)} {order} {pairs[-1].told(problem)}", flush=True
            )
            coarser = (error, parts)
    return pairs


def cheapest(pairs: list[Pair], bound: float) -> Pair | None:
    """The fastest run of Exudyn within a bound."""
    able = [pair for pair in pairs if pair.peer.error <= bound]
    return min(able, key=lambda pair: pair.peer.seconds) if able else None


def ratio_text(pair: Pair | None) -> str:
    return two_digits(pair.ratio) if pair and pair.own else "-"


def table(found: dict[str, list[Pair]]) -> str:
    """Markdown: the cheapest runs of Exudyn within the criterion and within a hundredth of it."""
    lines = [
        "| problem | criterion | Exudyn: error, time | hydrodae: error, time (with samples) "
        "| ratio | ratio at 1/100 |",
        "|---|---|---|---|---|---|",
    ]
    for name, pairs in found.items():
        problem = PROBLEMS[name]
        at, fine = cheapest(pairs, problem.criterion), cheapest(pairs, 0.01 * problem.criterion)
        cells = [
            name,
            f"{problem.criterion:.0e} {problem.unit}".replace("e-0", "e-"),
            at.peer.cell() if at else "none",
            at.own.cell() if at and at.own else "none as exact",
            ratio_text(at),
            ratio_text(fine),
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(PROBLEMS)}")
    parser.add_argument(
        "--repeats", type=int, default=3, help="least number of runs of which the best counts"
    )
    options = parser.parse_args()
    if unknown := [name for name in options.names if name not in PROBLEMS]:
        parser.error(f"no problem {', '.join(unknown)}: {', '.join(PROBLEMS)}")
    try:
        from tests.benchmark import exudyn_models
    except ModuleNotFoundError as missing:
        if missing.name != "exudyn":
            raise
        print(f"exudyn is not installed: {install_command('peers')}")
        with_peer = False
    else:
        print(f"Exudyn {exudyn_models.VERSION}")
        exudyn_models.settle()
        with_peer = True
    found: dict[str, list[Pair]] = {}
    for name in options.names or PROBLEMS:
        problem = PROBLEMS[name]
        reference = reference_of(name, problem.end_time)
        print(f"\n{name}: criterion {problem.criterion:.0e} {problem.unit}")
        own = ours(name, problem, reference, options.repeats)
        meet = [row for row in own if row.error <= problem.criterion]
        if meet:
            fastest = min(meet, key=lambda row: row.seconds)
            print(f"  fastest of hydrodae within the criterion: {fastest.cell()}")
        if with_peer:
            found[name] = theirs(name, problem, reference, options.repeats, own)
    if with_peer:
        print(f"\n{table(found)}")


if __name__ == "__main__":
    main()
