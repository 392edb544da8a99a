"""Start of arrays whose neighbours are coupled: time and memory against the number of bodies.

    .venv/bin/python tests/benchmark/array_starts.py

Spheres on a hexagonal grid, in heave or rigid (array_scenes.py). Each mode of the memory feels its
own body and the bodies next to it, so that bodies up to two spacings apart are coupled. Each start
has a process of its own: the case and its database are read (`read`), then a `Simulation` is made
(`start`). Times are those of the processor. Memory is the most that the process has had; in
brackets the part of Python and of the libraries, before it reads.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

import hydrodae  # noqa: E402

BODIES = (27, 81, 243)


def resident() -> float:
    """Return the most memory that this process has had [MiB] (Linux)."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmHWM:"):
            return float(line.split()[1]) / 1024.0
    return float("nan")


def measure(case: Path) -> dict[str, float]:
    """Read a case and make its simulation, in this process."""
    read, start = hydrodae.Case.read, hydrodae.Simulation  # load what they need
    before, began = resident(), time.process_time()
    chosen = read(case)
    middle = time.process_time()
    start(chosen)
    end = time.process_time()
    return {
        "read": middle - began,
        "start": end - middle,
        "memory": resident(),
        "before": before,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--bodies", type=int, nargs="+", default=BODIES)
    parser.add_argument("--repeats", type=int, default=3, help="the least times are taken")
    parser.add_argument("--full", action="store_true", help="couple all bodies with all")
    parser.add_argument("--one", type=Path, help=argparse.SUPPRESS)  # a case, for a process
    given = parser.parse_args()
    if given.one:
        print(json.dumps(measure(given.one)))
        return
    from tests.benchmark.array_scenes import Layout, write_array

    alone = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print("| bodies | coordinates | read, s | start, s | memory, MiB |\n|---|---|---|---|---|")
    for rigid in (False, True):
        for count in sorted(given.bodies):
            layout = Layout(count, neighbours=not given.full, rigid=rigid)
            with tempfile.TemporaryDirectory() as folder:
                case = write_array(Path(folder), layout)
                command = [sys.executable, __file__, "--one", str(case)]
                rows = []
                for _ in range(given.repeats):
                    done = subprocess.run(
                        command, check=True, capture_output=True, text=True, env=alone
                    )
                    rows.append(json.loads(done.stdout))
            least = {key: min(row[key] for row in rows) for key in rows[0]}
            print(
                f"| {count} {'rigid' if rigid else 'in heave'} | {len(layout.labels)}"
                f" | {least['read']:.2f} | {least['start']:.2f}"
                f" | {least['memory']:.0f} ({least['before']:.0f}) |",
                flush=True,
            )


if __name__ == "__main__":
    main()
