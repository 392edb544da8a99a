"""Runs that are measured in turn, and what each costs over the first one."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

import hydrodae


def print_ratios(
    cases: Mapping[str, hydrodae.Case], path: Path, repeats: int, aims: Mapping[str, float]
) -> None:
    """Print the least processor times [s] inside the method and of whole runs, with their ratios.

    `path` takes the results of each run; `aims` are ratios of the whole run.
    """
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    least = {name: (np.inf, np.inf) for name in cases}
    steps = dict.fromkeys(cases, 0)
    for _ in range(repeats):  # in turn, so that other work meets all alike
        for name, case in cases.items():
            before = time.process_time()
            results = hydrodae.run(case, path)
            whole = time.process_time() - before
            inside = float(results.statistics["solver_time"])
            least[name] = (min(least[name][0], inside), min(least[name][1], whole))
            steps[name] = int(results.statistics["steps"])
    first = next(iter(least.values()))
    for name, own in least.items():
        texts = [f"{s:.3f} s ({s / one:.2f})" for s, one in zip(own, first, strict=True)]
        aim = f", aim {aims[name]:g}" if name in aims else ""
        line = f"{name:24} method {texts[0]}, whole run {texts[1]}{aim}, {steps[name]} steps"
        print(line, flush=True)
