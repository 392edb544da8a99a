"""Speed against accuracy of one case: a ladder of tolerances against the tightest one.

    .venv/bin/python tests/benchmark/work_precision.py cases/f3of/flap_decay.toml

The error is the rms difference of a channel over the rms of the reference (nRMS); the time is that
of the integrator with its residuals and Jacobians, best of a few runs on one core. Start-up of the
executable is timed apart.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

import hydrodae
from hydrodae.plot import save

TOLERANCES = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8)
REFERENCE = 1e-10


@dataclass
class Point:
    """One run of the ladder."""

    rtol: float
    error: dict[str, float]
    seconds: float
    statistics: dict[str, float]


def measure(
    case: Path, channels: list[str], end_time: float, repeats: int, values: dict[str, object]
) -> list[Point]:
    """Run the ladder; the error of every channel is taken against the tightest run."""
    common = {**values, "solver.end_time": end_time}
    reference = hydrodae.run(case, set={**common, "solver.rtol": REFERENCE})
    points = []
    for rtol in TOLERANCES:
        runs = [hydrodae.run(case, set={**common, "solver.rtol": rtol}) for _ in range(repeats)]
        error = {
            name: float(
                np.sqrt(
                    np.mean((runs[0][name].values - reference[name].values) ** 2)
                    / np.mean(reference[name].values ** 2)
                )
            )
            for name in channels
        }
        seconds = min(float(run.statistics["solver_time"]) for run in runs)
        points.append(Point(rtol, error, seconds, dict(runs[0].statistics)))
    return points


def table(points: list[Point], channels: list[str]) -> Table:
    """Tolerance, errors, time, steps, residual and Jacobian calls."""
    out = Table(show_edge=False)
    for heading in ("rtol", *(f"nRMS {name}" for name in channels)):
        out.add_column(heading, justify="right")
    for heading in ("solver ms", "steps", "residuals", "Jacobians", "us/step"):
        out.add_column(heading, justify="right")
    for p in points:
        steps = int(p.statistics["steps"])
        out.add_row(
            f"{p.rtol:.0e}",
            *(f"{p.error[name]:.1e}" for name in channels),
            f"{1e3 * p.seconds:.2f}",
            str(steps),
            str(int(p.statistics["residual_calls"])),
            str(int(p.statistics["jacobian_calls"])),
            f"{1e6 * p.seconds / steps:.1f}",
        )
    return out


def draw(points: list[Point], title: str, path: Path) -> None:
    """Work-precision picture: largest error of the channels against solver time."""
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axes = figure.subplots()
    errors = [max(p.error.values()) for p in points]
    axes.loglog(errors, [1e3 * p.seconds for p in points], "o-", label="ida")
    for p, error in zip(points, errors, strict=True):
        axes.annotate(f"{p.rtol:.0e}", (error, 1e3 * p.seconds), (4, 4), textcoords="offset points")
    axes.set_xlabel("error, nRMS [-] (labels: rtol)")
    axes.set_ylabel("solver time [ms]")
    axes.set_title(title)
    axes.invert_xaxis()
    axes.grid(True, which="both", alpha=0.3)
    save(figure, path)


def startup_seconds(case: Path, repeats: int = 5) -> float:
    """Wall time of `hydrodae-solve --check`: read the case and the database, build nothing else."""
    solve = Path(sys.executable).parent / "hydrodae-solve"
    best = float("inf")
    for _ in range(repeats):
        start = time.perf_counter()
        subprocess.run([solve, "--check", str(case)], check=True, capture_output=True)
        best = min(best, time.perf_counter() - start)
    return best


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--channel", action="append", help="default: all joint angles")
    parser.add_argument("--end-time", type=float, default=100.0, help="[s]")
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("-o", "--output", type=Path, default=Path("build/work_precision.png"))
    arguments = parser.parse_args()
    values = dict(hydrodae.case.parse_assignment(text) for text in arguments.set)
    channels = arguments.channel
    if channels is None:
        probe = hydrodae.run(arguments.case, set={**values, "solver.end_time": 1.0})
        channels = [name for name in probe.channels() if name.endswith("/angle")]
    points = measure(arguments.case, channels, arguments.end_time, arguments.repeats, values)
    title = f"{hydrodae.Case.read(arguments.case).title}, {arguments.end_time:g} s"
    console = Console(width=140)
    console.print(f"{title}; errors against rtol {REFERENCE:.0e}")
    console.print(table(points, channels))
    console.print(f"start-up of hydrodae-solve: {1e3 * startup_seconds(arguments.case):.0f} ms")
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    draw(points, title, arguments.output)
    console.print(f"picture: {arguments.output}")


if __name__ == "__main__":
    main()
