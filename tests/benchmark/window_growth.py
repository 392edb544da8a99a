"""Growth of cost with the length of a mechanism: chains of N four-bar windows (IFToMM A02).

    .venv/bin/python tests/benchmark/window_growth.py -o tests/benchmark/window_growth.png

Time per step of the integrator and time of the set-up (closing the joints, rank, consistent start)
against N, and their slopes on log-log. Time per step is that between two end times, so that what is
done once (symbolic factorisation) does not count; both are before the first singular pose.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "benchmarks"))

from four_bar import four_bar  # type: ignore[import-not-found]  # noqa: E402

import hydrodae  # noqa: E402
from hydrodae.commands.cli import guarded  # noqa: E402
from hydrodae.pictures.plot import save  # noqa: E402

WINDOWS = (2, 5, 10, 20, 50, 100, 200, 500, 1000)
END_TIMES = (0.1, 0.5)  # s
FITTED_FROM = 20  # windows: below, what does not grow with N counts


def slope(windows: np.ndarray, seconds: np.ndarray) -> float:
    """Slope of a line through the long chains on log-log."""
    long = windows >= FITTED_FROM
    return float(np.polyfit(np.log(windows[long]), np.log(seconds[long]), 1)[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--windows", type=int, nargs="+", default=WINDOWS)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("-o", "--output", type=Path, default=Path("build/window_growth.png"))
    arguments = parser.parse_args()
    windows = np.array(sorted(arguments.windows))
    per_step: list[float] = []
    setup: list[float] = []
    print("windows  unknowns  steps  us/step  us/step/window  set-up ms")
    for n in windows:
        steps: list[int] = []
        seconds: list[float] = []
        for end_time in END_TIMES:
            case = hydrodae.Case.from_text(four_bar(int(n), end_time, end_time))
            runs = [
                hydrodae.run(case, set={"solver.method": "ida"}).statistics
                for _ in range(arguments.repeats)
            ]
            steps.append(int(runs[0]["steps"]))
            seconds.append(min(float(run["solver_time"]) for run in runs))
        per_step.append((seconds[1] - seconds[0]) / (steps[1] - steps[0]))
        setup.append(min(float(run["setup_time"]) for run in runs))
        print(
            f"{n:7d}  {int(runs[0]['unknowns']):8d}  {steps[1]:5d}  {1e6 * per_step[-1]:7.0f}"
            f"  {1e6 * per_step[-1] / n:14.2f}  {1e3 * setup[-1]:9.1f}"
        )
    curves = {"time per step": np.array(per_step), "set-up": np.array(setup)}
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for name, curve in curves.items():
        label = f"{name}, slope {slope(windows, curve):.2f}"
        print(f"{label} (N >= {FITTED_FROM})")
        axes.loglog(windows, curve, "o-", label=label)
    axes.set_xlabel("four-bar windows N [-]")
    axes.set_ylabel("time [s]")
    axes.set_title("Chain of N four-bar windows, default tolerance")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    save(figure, arguments.output)
    print(f"picture: {arguments.output}")


if __name__ == "__main__":
    sys.exit(guarded(main))
