"""What a short run costs beside its solver, in processor time: programs and `hydrodae.run`.

    python tests/benchmark/fixed_costs.py [REPEATS]

The case is the decay of a sphere. Each figure is a median of REPEATS (7); a command is a process of
its own, and its time that of the processor, with the start of Python.
"""

from __future__ import annotations

import argparse
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

CASE = Path(__file__).resolve().parents[2] / "cases" / "sphere" / "decay.toml"
SCRIPTS = Path(sys.executable).parent


def commands(folder: str) -> dict[str, list[str]]:
    """Arguments of each command by what is printed of it."""
    solve = [str(SCRIPTS / "hydrodae-solve"), str(CASE), "-o", f"{folder}/solve.h5", "--quiet"]
    hydrodae = str(SCRIPTS / "hydrodae")
    return {
        "python -c pass": [sys.executable, "-c", "pass"],
        "python -c 'import numpy'": [sys.executable, "-c", "import numpy"],
        "hydrodae-solve decay.toml": solve,
        "hydrodae run decay.toml": [hydrodae, "run", str(CASE), "-o", f"{folder}/run.h5"],
        "hydrodae --help": [hydrodae, "--help"],
    }


def processor_time(command: list[str]) -> float:
    """Return the time of a process on the processor [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)


def beyond_solver(case: Any, repeats: int) -> list[float]:
    """Return what `hydrodae.run` takes beside the call of the kernel [s of processor], each time.

    `case` is a path or a `Case`. The first runs load what later ones share, and are left out.
    """
    import hydrodae
    from hydrodae import _core

    kernel: Callable[..., Any] = _core.simulate
    inside = 0.0

    def timed(*arguments: Any) -> Any:
        nonlocal inside
        start = time.process_time()
        found = kernel(*arguments)
        inside = time.process_time() - start
        return found

    setattr(_core, "simulate", timed)  # noqa: B010
    spent = []
    for _ in range(repeats + 3):
        start = time.process_time()
        hydrodae.run(case)
        spent.append(time.process_time() - start - inside)
    setattr(_core, "simulate", kernel)  # noqa: B010
    return spent[3:]


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("repeats", nargs="?", type=int, default=7, metavar="REPEATS")
    repeats = parser.parse_args().repeats
    with tempfile.TemporaryDirectory() as folder:
        for name, command in commands(folder).items():
            median = statistics.median(processor_time(command) for _ in range(repeats))
            print(f"{1e3 * median:7.1f} ms  {name}")
    from hydrodae.case import Case

    for name, case in (("path", CASE), ("Case", Case.read(CASE))):
        # short times: more of them
        median = statistics.median(beyond_solver(case, 10 * repeats))
        print(f"{1e3 * median:7.2f} ms  hydrodae.run({name}) beside its solver")


if __name__ == "__main__":
    main()
