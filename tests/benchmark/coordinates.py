"""Multipliers against joint coordinates: time at equal error on four mechanisms.

    .venv/bin/python tests/benchmark/coordinates.py -o docs/coordinates.png

Runs F3OF afloat, a chain of 40 bars, 4N3LA and 9N9LA in the coordinates of all bodies with
multipliers and in those of the joints, at several tolerances. 4N3LA and 9N9LA need their databases
(`python cases/4n3la/four_nodes.py database`, `python cases/9n9la/nine_nodes.py database`); without
them they are left out, saying so. Times are those of the processor, the least of --repeats: other
programs on the machine disturb them less than the clock's.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.pictures.plot import save

ROOT = Path(__file__).resolve().parents[2]
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7)
TRUTH = {"solver.method": "explicit_rk", "solver.rtol": 1e-11}
LINKS = 40
WAYS = {
    "bodies, explicit_rk": {"solver.method": "explicit_rk"},
    "reduced, explicit_rk": {"solver.method": "explicit_rk", "solver.coordinates": "reduced"},
    "bodies, radau": {"solver.method": "radau"},
}


@dataclass
class Point:
    """One run: its processor time, output and guards included, s; its error beside the motion."""

    rtol: float
    time: float
    error: float
    steps: int
    calls: int


def chain() -> hydrodae.Case:
    """A chain of bars of 0.1 m and 0.1 kg, in one plane, released level."""
    text = f'title = "Chain of {LINKS} bars"\n'
    for k in range(LINKS):
        x = 0.1 * k
        text += (
            f'[[body]]\nname = "bar{k}"\nmotion = "planar"\nmass = 0.1\n'
            f"center_of_gravity = [{x + 0.05}, 0.0, 0.0]\n"
            f'inertia = [1e-4, 1e-4, 1e-4]\n[[joint]]\nname = "pin{k}"\ntype = "revolute"\n'
            f'body_a = "{f"bar{k - 1}" if k else "ground"}"\nbody_b = "bar{k}"\n'
            f"point = [{x}, 0.0, 0.0]\naxis = [0.0, 1.0, 0.0]\n"
        )
    return hydrodae.Case.from_text(text + "[solver]\nend_time = 1.5\n[output]\nstep = 0.05\n")


def cases(four: Path, nine: Path) -> dict[str, hydrodae.Case]:
    """The four scenes; those without a database are left out."""
    ends = {"solver.end_time": 40.0, "output.step": 0.25, "sea.ramp": 10.0}
    found = {
        "F3OF": hydrodae.Case.read(ROOT / "cases" / "f3of" / "rao.toml").with_values(ends),
        f"chain of {LINKS}": chain(),
    }
    for name, folder in (("4N3LA", four), ("9N9LA", nine)):
        if (folder / "hydro.h5").exists():
            ends = {"solver.end_time": 12.0, "output.step": 0.1}
            found[name] = hydrodae.Case.read(folder / "regular.toml").with_values(ends)
        else:
            print(f"{name} is left out: no {folder / 'hydro.h5'}")
    return found


def motion(results: hydrodae.Results) -> NDArray[np.float64]:
    """Positions of all bodies, (n_time, 3 n_bodies), m."""
    return np.hstack([np.asarray(results[n]) for n in results.channels("bodies/*/position")])


def error(results: hydrodae.Results, truth: NDArray[np.float64]) -> float:
    """Largest error of a position beside the largest way of any body."""
    return float(np.abs(motion(results) - truth).max() / np.ptp(truth, axis=0).max())


def start_time(case: hydrodae.Case, way: dict[str, str], repeats: int) -> float:
    """Processor time until the first step can be made, s."""
    times = []
    for _ in range(repeats):
        before = time.process_time()
        hydrodae.Simulation(case.with_values(way))
        times.append(time.process_time() - before)
    return min(times)


def measure(
    case: hydrodae.Case, way: dict[str, str], truth: NDArray[np.float64], repeats: int
) -> list[Point]:
    """One point for each tolerance; methods that stop have none there."""
    points = []
    for rtol in TOLERANCES:
        times = []
        try:
            for _ in range(repeats):
                before = time.process_time()
                results = hydrodae.run(case, set={**way, "solver.rtol": rtol})
                times.append(time.process_time() - before)
        except hydrodae.SolverError as stopped:
            print(f"    rtol {rtol:g}: {str(stopped).splitlines()[0]}")
            continue
        counts = results.statistics
        points.append(
            Point(
                rtol,
                min(times),
                error(results, truth),
                int(counts["steps"]),
                int(counts["residual_calls"]),
            )
        )
    return points


def time_at(points: list[Point], wanted: float) -> float:
    """Time at an error, between two points on the chart's axes; nan outside of them, s."""
    if not points:
        return float("nan")
    errors = np.log([max(p.error, 1e-16) for p in points])[::-1]
    times = np.log([p.time for p in points])[::-1]
    if not np.all(np.diff(errors) > 0) or not errors[0] <= np.log(wanted) <= errors[-1]:
        better = [p.time for p in points if p.error <= wanted]
        return min(better) if better else float("nan")
    return float(np.exp(np.interp(np.log(wanted), errors, times)))


def draw(charts: dict[str, dict[str, list[Point]]], path: Path) -> None:
    """One panel a scene: processor time over error."""
    figure = Figure(figsize=(10, 2.9), layout="constrained")
    axes = figure.subplots(1, len(charts), squeeze=False)[0]
    marks = dict(zip(WAYS, ("o-", "s-", "^--"), strict=True))
    for axis, (name, ways) in zip(axes, charts.items(), strict=True):
        for way, points in ways.items():
            shown = [p for p in points if p.error > 0.0]
            axis.loglog([p.error for p in shown], [p.time for p in shown], marks[way], label=way)
        axis.set_title(name)
        axis.set_xlabel("error / motion [-]")
        axis.invert_xaxis()
        times = [p.time for points in ways.values() for p in points]
        middle = float(np.exp(np.mean(np.log(times))))
        axis.set_ylim(middle / 3.0, middle * 3.0)  # else noise would look like a difference
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("processor time [s]")
    axes[0].legend(fontsize=7)
    save(figure, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--four", type=Path, default=ROOT / "cases" / "4n3la", help="with hydro.h5")
    parser.add_argument("--nine", type=Path, default=ROOT / "cases" / "9n9la", help="with hydro.h5")
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--error", type=float, default=1e-5, help="at which times are compared")
    parser.add_argument("-o", "--output", type=Path, default=Path("build/coordinates.png"))
    arguments = parser.parse_args()
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    charts: dict[str, dict[str, list[Point]]] = {}
    for name, case in cases(arguments.four, arguments.nine).items():
        truth = motion(hydrodae.run(case, set=TRUTH))
        reduced = hydrodae.run(case, set={**WAYS["reduced, explicit_rk"], "solver.end_time": 0.5})
        print(f"{name}: {reduced.notes[-1]}")
        charts[name] = {}
        for way, values in WAYS.items():
            points = charts[name][way] = measure(case, values, truth, arguments.repeats)
            start = start_time(case, values, arguments.repeats)
            each = [1e6 * (p.time - start) / p.calls for p in points]
            print(
                f"  {way:22s} start {1e3 * start:7.1f} ms, "
                f"{time_at(points, arguments.error):8.3f} s at {arguments.error:g}, "
                f"{min(each, default=float('nan')):7.1f} us a call; error, s, steps "
                + "; ".join(f"{p.error:.1e}, {p.time:.3f}, {p.steps}" for p in points),
                flush=True,
            )
        draw(charts, arguments.output)
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f}; wrote {arguments.output}")


if __name__ == "__main__":
    sys.exit(guarded(main))
