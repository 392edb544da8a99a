"""Build the programs of `kernel_costs.py`, and count the instructions of what they run."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "benchmark"
PROGRAMS = {
    "solve": BUILD / "cpp" / "hydrodae-solve",
    "costs": BUILD / "tests" / "benchmark" / "hydrodae-kernel-costs",
    "floor": BUILD / "tests" / "benchmark" / "hydrodae-floor",
}
#: One thread for linear algebra, so that counts and times do not depend on the other cores.
ALONE = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def build() -> None:
    """Compile the three programs (release, in build/benchmark)."""
    options = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_UNITY_BUILD": "ON"}
    options["HYDRODAE_BUILD_BENCHMARKS"] = "ON"
    configure = ["cmake", "-S", str(ROOT), "-B", str(BUILD), "-G", "Ninja"]
    configure += [f"-D{key}={value}" for key, value in options.items()]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    targets = [program.name for program in PROGRAMS.values()]
    subprocess.run(["cmake", "--build", str(BUILD), "--target", *targets], check=True)


def compiler() -> str:
    """Return the name and version of the compiler of the build."""
    cache = (BUILD / "CMakeCache.txt").read_text()
    found = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE)
    if not found:
        return "unknown"
    shown = subprocess.run([found[1], "--version"], capture_output=True, text=True, check=True)
    return shown.stdout.splitlines()[0]


def can_count() -> bool:
    """Return whether valgrind is installed."""
    return shutil.which("valgrind") is not None


def run(program: str, *arguments: str) -> str:
    """Run a program; return what it prints. An error of its own is passed on."""
    command = [str(PROGRAMS[program]), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, env=ALONE, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}: {done.stderr}")
    return done.stdout


def seconds(program: str, *arguments: str, repeats: int = 1) -> dict[str, float]:
    """Return the JSON object that a program prints, the least of each figure."""
    found = [json.loads(run(program, *arguments)) for _ in range(repeats)]
    return {name: min(each[name] for each in found) for name in found[0]}


def wall(program: str, *arguments: str, repeats: int = 3) -> float:
    """Return the least wall time of a whole program [s]."""
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        run(program, *arguments)
        times.append(time.perf_counter() - began)
    return min(times)


def count(program: str, *arguments: str) -> dict[str, int]:
    """Return instructions of each named piece of a program, and of the "rest" of it."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "counts"
        command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}"]
        command += [str(PROGRAMS[program]), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, env=ALONE, check=False)
        if done.returncode:
            raise SystemExit(f"{' '.join(command)}: {done.stderr}")
        found: dict[str, int] = {}
        for file in Path(folder).glob("counts*"):
            text = file.read_text(errors="replace")
            total = re.search(r"^totals: (\d+)", text, re.MULTILINE)
            name = re.search(r"^desc: Trigger: Client Request: (.*)$", text, re.MULTILINE)
            if total:
                found[name[1] if name else "rest"] = int(total[1])
        return found


def sets(values: dict[str, Any], flag: str = "") -> list[str]:
    """Return values of a case as arguments."""
    return [part for k, v in values.items() for part in ([flag] if flag else []) + [f"{k}={v}"]]
