"""The same case in the time domain with several seeds of its sea."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.hdb.labels import DOFS
from hydrodae.results import Results
from hydrodae.simulation import run
from hydrodae.study.rao.text import name_of_power
from hydrodae.support import processes
from hydrodae.support.units import displayed


@dataclass(frozen=True)
class Seeds:
    """Runs of a case with several seeds.

    Attributes
    ----------
    names : tuple of str
        Coordinates of bodies and joints.
    units : tuple of str
        [m, rad].
    motion, rate : (n_seeds, n) arrays
        Standard deviations about the mean of each run.
    power : dict of (n_seeds,) arrays
        Mean power of each power take-off, chamber and outlet by the names of `Spectral.power` [W].
    solver_time : (n_seeds,) array
        [s].
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    motion: np.ndarray
    rate: np.ndarray
    power: dict[str, np.ndarray]
    solver_time: np.ndarray

    def mean(self, name: str) -> float:
        """Root of the mean variance of a coordinate."""
        return float(np.sqrt(np.mean(self.motion[:, self.names.index(name)] ** 2)))

    def scatter(self, name: str) -> float:
        """Standard error of the mean of a coordinate's standard deviation, relative."""
        values = self.motion[:, self.names.index(name)]
        return float(values.std(ddof=1) / np.sqrt(len(values)) / values.mean())


def time_domain(
    case: Case, names: Mapping[str, str], seeds: Sequence[int], settle: float, jobs: int = 1
) -> Seeds:
    """Run a case with these seeds of all its irregular waves.

    Parameters
    ----------
    case : Case
        Its ramp and its end are kept.
    names : mapping from str to str
        Coordinates such as "bodies/float/heave" or "joints/slide/displacement", and their units.
    seeds : sequence of int
    settle : float
        Time from the start that is left out [s].
    jobs : int
        Runs at a time.

    Raises
    ------
    CaseError
        Nothing in the sea is random, fewer than two seeds, or the runs are no longer than `settle`.
    SolverError
        A run failed.
    """
    waves = [wave["name"] for wave in case_tables(case).get("wave", []) if _random(wave)]
    if not waves:
        raise CaseError("the case has no irregular wave: seeds make no difference to it")
    if len(seeds) < 2:
        raise CaseError(f"{len(seeds)} seeds: at least two are needed for a scatter")
    if not 0.0 <= settle < case.end_time:
        raise CaseError(f"settle = {settle:g} s: expected 0 to end_time = {case.end_time:g} s")
    values = {key: tomllib.loads(f"x = {text}")["x"] for key, text in case.overrides.items()}
    work = partial(
        _run_one, case.text, str(case.directory), values, tuple(waves), tuple(names), settle
    )
    if jobs == 1:
        runs = [work(seed) for seed in seeds]
    else:
        with ProcessPoolExecutor(jobs, processes.context(anew=False)) as pool:
            runs = list(pool.map(work, seeds))
    return Seeds(
        names=tuple(names),
        units=tuple(names.values()),
        motion=np.array([one["motion"] for one in runs]),
        rate=np.array([one["rate"] for one in runs]),
        power={name: np.array([one["power"][name] for one in runs]) for name in runs[0]["power"]},
        solver_time=np.array([one["time"] for one in runs]),
    )


def _random(wave: Mapping[str, Any]) -> bool:
    return wave["type"] not in ("regular", "measured", "new_wave", "components")


def _run_one(
    text: str,
    folder: str,
    values: dict[str, Any],
    waves: tuple[str, ...],
    names: tuple[str, ...],
    settle: float,
    seed: int,
) -> dict[str, Any]:
    case = Case(text, directory=folder, values=values)
    seeds = {f"wave.{wave}.seed": seed for wave in waves}
    results = run(case, set={**seeds, "solver.accuracy": "none"})
    late = results.time >= settle
    series = [_series(results, name) for name in names]
    powers = {
        name.split("/")[1]: name
        for group in ("forces", "chambers")
        for name in results.channels(f"{group}/*/power_absorbed")
    }
    powers |= {name: name for name in results.channels("outlets/*/power*")}
    return {
        "motion": [float(np.std(x[late])) for x, _ in series],
        "rate": [float(np.std(v[late])) for _, v in series],
        "power": {
            name: float(np.mean(results[channel].values[late])) for name, channel in powers.items()
        },
        "time": float(results.statistics["solver_time"]),
    }


def _series(results: Results, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Coordinate and rate over time."""
    head, _, last = name.rpartition("/")
    if name.startswith("modes/"):
        return results[name].values, results[f"{head}/rate"].values
    if not name.startswith("bodies/"):
        return results[name].values, results[f"{name}_rate"].values
    k = DOFS.index(last)
    pair = ("position", "velocity") if k < 3 else ("rotation", "angular_velocity")
    place, rate = (results[f"{head}/{channel}"].values[:, k % 3] for channel in pair)
    return place, rate


def comparison(found: Any, seeds: Seeds) -> str:
    """Standard deviations and mean powers beside those of the runs, and what both cost."""
    lines = [f"{'against ' + str(len(seeds.motion)) + ' runs':34} {'here':>11} {'runs':>11} "
             f"{'difference':>11} {'scatter':>9}"]  # fmt: skip
    for name, unit in zip(seeds.names, seeds.units, strict=True):
        factor, shown = displayed(unit)
        here, there = found.standard_deviation[name], seeds.mean(name)
        if there > 0.0:
            lines.append(
                f"  {name:32} {factor * here:11.4g} {factor * there:11.4g} "
                f"{100 * (here / there - 1):+10.1f}% {100 * seeds.scatter(name):8.1f}%  {shown}"
            )
    for name, values in seeds.power.items():
        if name in found.power and values.mean() != 0.0:
            here = found.power[name]
            lines.append(
                f"  {'power of ' + name_of_power(name):32} {here:11.4g} {values.mean():11.4g} "
                f"{100 * (here / values.mean() - 1):+10.1f}% {'':9}  W"
            )
    total = float(seeds.solver_time.sum())
    ratio = total / found.time
    lines.append(
        f"time: {1e3 * found.time:.2f} ms here, {total:.2f} s for the runs: {ratio:.0f} times, "
        f"{ratio / len(seeds.solver_time):.0f} times for one of them"
    )
    return "\n".join(lines)
