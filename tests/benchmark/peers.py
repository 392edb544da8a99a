"""Time at equal error: hydrodae beside Exudyn on four multibody benchmark cases.

    .venv/bin/python tests/benchmark/peers.py [--repeats 3] [NAME ...]

Error: largest distance of one point of the mechanism from the reference solution over all output
times, the same point and times for both. Time, best of the repeats: for hydrodae the wall time of
the integrator with residuals and Jacobians (statistics solver_time); for Exudyn the processor time
of SolveDynamic with nothing written to files. On an idle machine these compare; on a busy one the
comparison is to Exudyn's favour. Reading, building and assembling the models is in neither.

Exudyn runs with its fast build and with what was fastest of its correct settings here: full Newton
for simple_pendulum and n_four_bar_2, modified Newton otherwise, and the other of the two where it
stops; its own dense solver, and the
sparse one for bricard with the redundant row of the last hinge left out by hand. hydrodae runs the
case as it is. The ratio of a row is Exudyn's time over that of the fastest run of hydrodae with an
error no larger. Needs the reference solutions ($HYDRODAE_REFERENCE or shared/reference beside the
repository). Gates nothing.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.verification.multibody import PROBLEMS, columns, largest  # noqa: E402

import hydrodae  # noqa: E402

GOAL = 10.0
LADDER = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8)
METHODS: tuple[tuple[dict[str, Any], tuple[float, ...]], ...] = (
    ({"method": "explicit_rk", "order": 8}, LADDER),
    ({"method": "explicit_rk", "order": 5}, (1e-3, 1e-4, 1e-5)),
    ({"method": "radau", "order": 5}, (1e-4, 1e-6, 1e-8)),
    ({"method": "ida"}, (1e-4, 1e-6, 1e-8)),
)
ALPHA, TRAPEZOIDAL = "GeneralizedAlpha", "TrapezoidalIndex2"


@dataclass(frozen=True)
class Problem:
    """What is compared, and the ladder of Exudyn."""

    columns: tuple[str, ...]
    criterion: float  # error at which the problem counts as solved, m
    steps: tuple[float, ...]
    solvers: tuple[str, ...] = (ALPHA, TRAPEZOIDAL)
    modified_newton: bool = True


FOUR = {
    "simple_pendulum": Problem(("x", "y"), 1e-3, (1e-2, 2e-3, 1e-3, 1e-4), modified_newton=False),
    # the trapezoidal rule stops at the singular poses, generalized alpha too at h = 1e-4
    "n_four_bar_2": Problem(
        ("B0x", "B0y"), 1e-3, (1e-2, 2e-3, 1e-3, 2e-4), (ALPHA,), modified_newton=False
    ),
    "andrews": Problem(("Fx", "Fy"), 1e-5, (1e-4, 2e-5, 1e-5, 2e-6)),
    "bricard": Problem(("P3z", "P3x", "P3y"), 1e-3, (1e-2, 5e-3, 1e-3)),
}


@dataclass(frozen=True)
class Row:
    """One rung of a ladder."""

    label: str
    error: float
    seconds: float


def case_of(name: str) -> Path:
    return ROOT / "cases" / "benchmarks" / f"{name}.toml"


def ours(name: str, reference: dict[str, Any], repeats: int) -> list[Row]:
    rows = []
    for method, tolerances in METHODS:
        label = " ".join(str(value) for value in method.values())
        for rtol in tolerances:
            values = {f"solver.{key}": value for key, value in (method | {"rtol": rtol}).items()}
            try:
                runs = [hydrodae.run(case_of(name), set=values) for _ in range(repeats)]
            except hydrodae.SolverError as stop:
                print(f"  hydrodae {label} {rtol:.0e}: {str(stop).splitlines()[0]}")
                continue
            error = PROBLEMS[name](runs[0], reference)["position"]
            seconds = min(float(run.statistics["solver_time"]) for run in runs)
            rows.append(Row(f"{label}, rtol {rtol:.0e}", error, seconds))
    return rows


def theirs(name: str, reference: dict[str, Any], repeats: int) -> list[Row]:
    from tests.benchmark.exudyn_models import Model

    problem, rows = FOUR[name], []
    exact = columns(reference, *problem.columns)
    for solver in problem.solvers:
        for step in problem.steps:
            for modified in (problem.modified_newton, not problem.modified_newton):
                try:
                    runs = [
                        Model(case_of(name)).run(step, solver, modified) for _ in range(repeats)
                    ]
                except RuntimeError as stop:  # the solver stopped
                    newton = "modified" if modified else "full"
                    print(f"  Exudyn {solver}, h {step:.0e}, {newton} Newton: {stop}")
                    continue
                seconds = min(seconds for _, seconds in runs)
                rows.append(Row(f"{solver}, h {step:.0e}", largest(runs[0][0], exact), seconds))
                break
    return rows


def told(row: Row) -> str:
    return f"{row.label:<28}{row.error:9.1e} m{1e3 * row.seconds:10.2f} ms"


def compare(mine: list[Row], peers: list[Row], criterion: float) -> list[float]:
    """Print the ratio at every rung of Exudyn; return those where it meets the criterion."""
    ratios = []
    for peer in peers:
        meets = peer.error <= criterion
        able = [row for row in mine if row.error <= peer.error]
        if not able:
            print(f"  Exudyn   {told(peer)}   no run of hydrodae is as exact")
            continue
        best = min(able, key=lambda row: row.seconds)
        ratio = peer.seconds / best.seconds
        note = "" if meets else ", misses the criterion"
        print(f"  Exudyn   {told(peer)}{ratio:8.1f} x ({best.label}, {best.error:.1e} m){note}")
        if meets:
            ratios.append(ratio)
    return ratios


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(FOUR)}")
    parser.add_argument("--repeats", type=int, default=3, help="runs of which the best counts")
    options = parser.parse_args()
    folder = Path(os.environ.get("HYDRODAE_REFERENCE", ROOT.parent / "shared" / "reference"))
    folder = folder.resolve()
    try:
        from tests.benchmark import exudyn_models
    except ModuleNotFoundError as missing:
        if missing.name != "exudyn":
            raise
        print("exudyn is not installed: pip install hydrodae[peers]")
        with_peer = False
    else:
        print(f"Exudyn {exudyn_models.VERSION}")
        exudyn_models.settle()
        with_peer = True
    summary = []
    for name in options.names or FOUR:
        reference = json.loads((folder / "multibody" / f"{name}.json").read_text())
        criterion = FOUR[name].criterion
        print(f"\n{name}: criterion {criterion:.0e} m")
        mine = ours(name, reference, options.repeats)
        for row in mine:
            print(f"  hydrodae {told(row)}", flush=True)
        if with_peer:
            peers = theirs(name, reference, options.repeats)
            ratios = compare(mine, peers, criterion)
            told_ratios = f"{min(ratios):6.1f} to {max(ratios):5.1f} x" if ratios else "     -"
            summary.append(f"  {name:<18}{told_ratios}")
    if summary:
        print(f"\nRatios where Exudyn meets the criterion (goal: {GOAL:.0f} x)")
        print("\n".join(summary))


if __name__ == "__main__":
    main()
