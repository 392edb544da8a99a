"""Cost of `method = "auto"` over that of the best method, at equal error.

    .venv/bin/python tests/benchmark/auto_choice.py [CASE ...] [--repeat 3] [--end-time S]

Runs each case (by default those of the repository that need no further data) by auto, radau,
explicit_rk and ida at rtol 1e-2 to 1e-9, as `hydrodae chart` does. The cost of a method at an
error is that of its cheapest run with no larger error; a row lists auto's cost over the lowest of
all, for errors of 1e-2 to 1e-8, with the best method in brackets.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.study.chart import Chart, chart

ROOT = Path(__file__).resolve().parents[2] / "cases"
CASES = (
    *("benchmarks/" + name for name in ("andrews", "bricard", "chain_10", "door", "heavy_top")),
    *("benchmarks/" + name for name in ("flyball_governor", "light_joint", "mass_ratio")),
    *("benchmarks/" + name for name in ("n_four_bar_2", "simple_pendulum", "slider_crank_equal")),
    *("sphere/" + name for name in ("decay", "wave", "control")),
    *("f3of/" + name for name in ("flap_decay", "pitch_decay", "surge_decay", "waves")),
    "pto/case",
)
METHODS = ("auto", "radau", "explicit_rk", "ida")
TOLERANCES = tuple(10.0**-k for k in range(2, 10))
ERRORS = tuple(10.0**-k for k in range(2, 9))


def ratios(made: Chart) -> list[str]:
    """Return for each error auto's cost over the lowest, with the best method."""
    out = []
    for error in ERRORS:
        meeting = made.meeting(error)
        own = next((run for run in meeting if run.method == "auto"), None)
        if not meeting or not own or error < (made.agreement or 0.0):
            out.append("-")
            continue
        best = meeting[0]
        out.append(f"{(own.time or 0.0) / (best.time or 1.0):.2f} ({best.method[:3]})")
    return out


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("case", nargs="*", help="case files; default: those of the repository")
    parser.add_argument("--repeat", type=int, default=3, help="time is the best of N runs")
    parser.add_argument("--end-time", type=float, help="simulated time of each case [s]")
    options = parser.parse_args()
    print(f"{'case':28} " + " ".join(f"{error:>11.0e}" for error in ERRORS))
    for name in options.case or [str(ROOT / f"{case}.toml") for case in CASES]:
        values = {} if options.end_time is None else {"solver.end_time": options.end_time}
        case = hydrodae.Case(path=name, values=values)
        made = chart(case, methods=METHODS, tolerances=TOLERANCES, repeat=options.repeat)
        title = "/".join(Path(name).with_suffix("").parts[-2:])
        print(f"{title:28} " + " ".join(f"{text:>11}" for text in ratios(made)), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(guarded(main))
