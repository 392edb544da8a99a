"""Sweeps of many sea states: runs a second, what the second core brings, memory.

    python tests/benchmark/sweeps.py sphere 1000
    python tests/benchmark/sweeps.py f3of 200

A quarter of the points by one process, then all by two. Efficiency is the rate of two over twice
that of one; on a machine that is busy with other work it tells of that work, and the processor time
of a run tells more.
"""

from __future__ import annotations

import argparse
import os
import resource
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Any

import hydrodae

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


def measured(folder: Path, name: str, count: int, jobs: int) -> tuple[float, float]:
    """Sweep; returns runs a second, and processor seconds of a run."""
    study = write_study(folder, name, count)
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = perf_counter()
    found = hydrodae.sweep(study, study.with_suffix(".nc"), set=SCENES[name][1], jobs=jobs)
    passed = perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - spent.ru_utime - spent.ru_stime
    done = int((found["status"] == "completed").sum())
    points = int(found["status"].size)
    memory = [resource.getrusage(who).ru_maxrss / 1024 for who in (0, resource.RUSAGE_CHILDREN)]
    print(
        f"{name}: {points} sea states, {done} completed, {jobs} at a time: {points / passed:.2f} "
        f"runs a second, {processor / points:.3f} s of processor a run; memory at most "
        f"{memory[0]:.0f} MB here, {memory[1]:.0f} MB a worker; load {os.getloadavg()[0]:.1f}",
        flush=True,
    )
    return points / passed, processor / points


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
    main()
