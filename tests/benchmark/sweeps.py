"""Sweeps of many sea states: runs a second, what the second core brings, memory.

    python tests/benchmark/sweeps.py sphere 1000
    python tests/benchmark/sweeps.py f3of 200

A quarter of the points by one process, then all by two. The clock of both begins when each process
has finished four runs and ends with the last run: start-up (imports, the case and its database,
some seconds of each process once) and the table at the end are told apart and not counted.
Efficiency is the rate of two over twice that of one; on a machine that is busy with other work it
tells of that work, and the processor time of a run, start-up included, tells more.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Any

import hydrodae
from hydrodae.commands.cli import guarded

ROOT = Path(__file__).resolve().parents[2]
SEA = [{"name": "sea", "type": "jonswap", "significant_height": 1.0, "peak_period": 8.0, "seed": 1}]
#: Case, values, and how many heights and periods there are; the rest are seeds.
SCENES: dict[str, tuple[str, dict[str, Any], int, int]] = {
    "sphere": ("cases/sphere/wave.toml", {"wave": SEA, "output.step": 0.1}, 10, 10),
    "f3of": ("cases/f3of/waves.toml", {"wave": SEA}, 4, 5),
}


def write_study(folder: Path, name: str, count: int) -> Path:
    """Write a grid of `count` sea states."""
    case, _, heights, periods = SCENES[name]
    seeds = list(range(1, max(1, count // (heights * periods)) + 1))
    study = folder / f"{name}_{count}.toml"
    study.write_text(
        f'case = "{ROOT / case}"\n[grid]\n'
        f'"wave.sea.significant_height" = {{ from = 0.5, to = 2.0, count = {heights} }}\n'
        f'"wave.sea.peak_period" = {{ from = 6.0, to = 10.0, count = {periods} }}\n'
        f'"wave.sea.seed" = {seeds}\n'
    )
    return study


class Clock:
    """Times of finished runs."""

    def __init__(self) -> None:
        self.start = perf_counter()
        self.times: list[float] = []

    def __call__(self, done: float, _total: float) -> None:
        """Take the time of a run."""
        self.times.append(perf_counter())

    def rate(self, warm: int) -> float:
        """Runs a second after the first ones."""
        return (len(self.times) - warm) / (self.times[-1] - self.times[warm - 1])


def measured(folder: Path, name: str, count: int, jobs: int) -> tuple[float, float]:
    """Sweep; returns runs a second, and processor seconds of a run."""
    study = write_study(folder, name, count)
    output = study.with_name(f"{study.stem}_{jobs}.nc")
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    clock = Clock()
    found = hydrodae.sweep(study, output, set=SCENES[name][1], jobs=jobs, progress=clock)
    whole = perf_counter() - clock.start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - spent.ru_utime - spent.ru_stime
    done = int((found["status"] == "completed").sum())
    points = int(found["status"].size)
    warm = min(4 * jobs, points - 1)
    rate = clock.rate(warm)
    memory = [resource.getrusage(who).ru_maxrss / 1024 for who in (0, resource.RUSAGE_CHILDREN)]
    begun = clock.times[warm - 1] - clock.start
    print(
        f"{name}: {points} sea states, {done} completed, {jobs} at a time: {rate:.2f} runs a "
        f"second (all in {whole:.1f} s, the first {warm} after {begun:.1f} s), "
        f"{processor / points:.3f} s of processor a run; memory at most "
        f"{memory[0]:.0f} MB here, {memory[1]:.0f} MB a worker; load {os.getloadavg()[0]:.1f}",
        flush=True,
    )
    return rate, processor / points


def main() -> None:
    """Print two lines and the efficiency."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scene", choices=SCENES)
    parser.add_argument("count", type=int)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        one, alone = measured(Path(folder), arguments.scene, arguments.count // 4, 1)
        two, beside = measured(Path(folder), arguments.scene, arguments.count, 2)
    print(
        f"efficiency {two / (2.0 * one):.2f} by the clock, {alone / beside:.2f} by processor time"
    )


if __name__ == "__main__":
    sys.exit(guarded(main))
