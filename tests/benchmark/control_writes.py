"""What a controller that is sampled fast costs, method by method.

    python tests/benchmark/control_writes.py

The sphere under its PI, 2000 instants 0.01 s apart: CPU time, less that of a run without a write,
for each instant; steps and evaluations of the equations with them. Each write makes accelerations
jump, so that a step ends there and the method goes on from it.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import Any

import hydrodae
from hydrodae.commands.cli import guarded

CASE = Path(__file__).resolve().parents[2] / "cases" / "sphere" / "control.toml"
END, PERIOD, RUNS = 20.0, 0.01, 3


def measure(method: str, period: float) -> tuple[float, dict[str, Any]]:
    """Least CPU time of a run [s], and its statistics."""
    values = {
        "solver.method": method,
        "solver.end_time": END,
        "sea.ramp": 2.0,
        "controller.pi.period": period,
    }
    least = float("inf")
    for _ in range(RUNS):
        start = time.process_time()
        results = hydrodae.run(CASE, set=values)
        least = min(least, time.process_time() - start)
    return least, results.statistics


def main() -> None:
    """Print a table."""
    argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0]).parse_args()
    instants = round(END / PERIOD)
    print(f"{'method':12} us/write  steps/write  residuals/write")
    for method in ("radau", "explicit_rk", "ida", "auto"):
        without, _ = measure(method, 10.0 * END)
        spent, counts = measure(method, PERIOD)
        print(
            f"{method:12} {1e6 * (spent - without) / instants:8.0f} "
            f"{counts['steps'] / instants:12.1f} {counts['residual_calls'] / instants:16.1f}"
        )


if __name__ == "__main__":
    sys.exit(guarded(main))
