"""Many seas of one device: how many times real time a core makes, alone and side by side.

    python tests/benchmark/many_seas.py [CASE] [--seeds 64] [--end 600] [--channel NAME]

The case (that of F3OF in waves) runs so many seconds with so many seeds of its first wave: some by
`hydrodae.run`, all in the marches of `hydrodae sweep`. Starts, reading and tables are counted, the
start of Python is not. The largest difference of the mean powers is printed. With a channel of one
number its turning points are measured in the marches as well.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from time import process_time

import hydrodae
from hydrodae import _core

ROOT = Path(__file__).resolve().parents[2]
ALONE = 4  # runs by themselves


def main(case: str, seeds: int, end: float, channel: str) -> None:
    """Print the figures of a case."""
    base = hydrodae.Case(path=case, values={"solver.end_time": end, "solver.accuracy": "none"})
    key = f"wave.{base.scene.wave_names[0]}.seed"
    signals = [([(channel, "", 1.0, 1)], -1.0, True, -1.0)] if channel else []
    started = process_time()
    answers = []
    for first in range(1, seeds + 1, _core.lanes):
        group = range(first, min(first + _core.lanes, seeds + 1))
        scenes = [base.with_values({key: k}).scene for k in group]
        answers += _core.simulate_together(scenes, signals)
    side_by_side = (process_time() - started) / seeds
    reasons = {answer for answer in answers if isinstance(answer, str)}
    for reason in reasons:
        print(f"not side by side: {reason}")
    started = process_time()
    worst = 0.0
    for k in range(ALONE):
        power = hydrodae.run(base.with_values({key: k + 1})).statistics["mean_power_absorbed"]
        if not isinstance(answer := answers[k], str):
            worst = max(worst, abs(answer["mean_power_absorbed"] / power - 1.0))
    alone = (process_time() - started) / ALONE
    print(f"alone        {1e3 * alone:8.1f} ms a sea, {end / alone:8.0f} times real time")
    print(f"side by side {1e3 * side_by_side:8.1f} ms, {end / side_by_side:13.0f} times real time")
    print(f"largest difference of a mean power: {worst:.1e}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    default = str(ROOT / "cases" / "f3of" / "waves.toml")
    parser.add_argument("case", nargs="?", default=default, help="a case with waves")
    parser.add_argument("--seeds", type=int, default=64)
    parser.add_argument("--end", type=float, default=600.0, help="s")
    parser.add_argument("--channel", default="", help="such as joints/hinge1/angle")
    given = parser.parse_args()
    main(given.case, given.seeds, given.end, given.channel)
