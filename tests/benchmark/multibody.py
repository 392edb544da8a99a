"""Error and cost of the multibody benchmark cases over a ladder of tolerances.

    .venv/bin/python tests/benchmark/multibody.py [--method METHOD] [NAME ...]

Makes the figures of cases/benchmarks/README.md.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.verification.multibody import PROBLEMS  # noqa: E402
from tests.verification.truths import make as truths  # noqa: E402

import hydrodae  # noqa: E402
from hydrodae.commands.cli import guarded  # noqa: E402

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11)


def main() -> None:
    parser = argparse.ArgumentParser(description="Errors and times over a ladder of tolerances.")
    parser.add_argument("--method", default="auto")
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_args()
    for name in arguments.names or PROBLEMS:
        document = truths.read(name) if name in truths.PROBLEMS else {}  # others are solved here
        print(name)
        for rtol in TOLERANCES:
            case = ROOT / "cases" / "benchmarks" / f"{name}.toml"
            try:
                results = hydrodae.run(
                    case, set={"solver.rtol": rtol, "solver.method": arguments.method}
                )
            except hydrodae.SolverError as stop:
                print(f"  {rtol:.0e}  {str(stop).splitlines()[0]}")
                continue
            errors = PROBLEMS[name](results, document)
            told = ", ".join(f"{what} {error:.1e}" for what, error in errors.items())
            steps, seconds = results.statistics["steps"], results.statistics["solver_time"]
            print(f"  {rtol:.0e}  {told}; {steps} steps, {1e3 * float(seconds):.1f} ms")


if __name__ == "__main__":
    sys.exit(guarded(main))
