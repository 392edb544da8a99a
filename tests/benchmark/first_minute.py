"""How long a newcomer's way takes, from an empty folder: new, check, run, plot, view, report.

    python tests/benchmark/first_minute.py [KIND]

Each step is a process of its own, as in a terminal. Exit code 1 if they take more than a minute.
"""

from __future__ import annotations

import argparse
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

LIMIT = 60.0  # s


def steps(kind: str) -> list[list[str]]:
    """Arguments of `hydrodae`, one list a step."""
    case, results = f"{kind}/case.toml", f"{kind}/case.h5"
    return [
        ["new", kind],
        ["check", case],
        ["run", case, "-q"],
        ["plot", results],
        ["view", results],
        ["report", results],
    ]


def processor_time() -> float:
    """Of the steps so far [s]."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def main() -> int:
    """Go the way and print the time of each step; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("kind", nargs="?", default="point_absorber", help="of `hydrodae new`")
    kind = parser.parse_args().kind
    total, work = 0.0, 0.0
    with tempfile.TemporaryDirectory() as folder:
        for arguments in steps(kind):
            start, before = perf_counter(), processor_time()
            subprocess.run(
                [sys.executable, "-m", "hydrodae", *arguments],
                cwd=folder,
                check=True,
                stdout=subprocess.DEVNULL,
            )
            spent = perf_counter() - start
            worked = processor_time() - before
            total, work = total + spent, work + worked
            print(f"{spent:6.1f} s ({worked:4.1f} s of processor)  hydrodae {' '.join(arguments)}")
        made = sorted(path.name for path in (Path(folder) / kind).iterdir())
    print(
        f"{total:6.1f} s ({work:4.1f} s of processor)  in all, of at most {LIMIT:g} s; "
        f"made: {', '.join(made)}"
    )
    return 0 if total <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
