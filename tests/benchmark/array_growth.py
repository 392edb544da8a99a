"""Growth of cost with the number of bodies that the water couples: surge, heave and pitch each.

    .venv/bin/python tests/benchmark/array_growth.py -o tests/benchmark/array_growth.png

Builds tests/benchmark/array_growth.cpp (release, in build/benchmark) and runs it for several n
with 10 n memory states. Up to --whole bodies the whole sparse matrix, memory and all, is factorised
by KLU for comparison; with 100 it has 0.8 million nonzeros.
"""

from __future__ import annotations

import argparse
import subprocess
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from hydrodae.pictures.plot import save

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "benchmark"
BODIES = (1, 3, 10, 30, 100)


def build() -> Path:
    """Compile the benchmark; return its path."""
    configure = ["cmake", "-S", str(ROOT), "-B", str(BUILD), "-G", "Ninja"]
    options = [
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_UNITY_BUILD=ON",
        "-DHYDRODAE_BUILD_BENCHMARKS=ON",
    ]
    subprocess.run([*configure, *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD, "--target", "hydrodae-array-growth"], check=True)
    return BUILD / "tests" / "benchmark" / "hydrodae-array-growth"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--bodies", type=int, nargs="+", default=BODIES)
    parser.add_argument("--whole", type=int, default=100, help="most bodies for the whole matrix")
    parser.add_argument("--program", type=Path, help="the benchmark, where it is built already")
    parser.add_argument("-o", "--output", type=Path, default=Path("build/array_growth.png"))
    arguments = parser.parse_args()
    program = arguments.program or build()
    rows = []
    print(
        "bodies  unknowns  nonzeros (whole, condensed)  Jacobian ms  factorise again ms (whole, "
        "condensed)  s per simulated s (ida, radau)     MiB"
    )
    for n in sorted(arguments.bodies):
        command = [str(program), str(n), *(["whole"] if n <= arguments.whole else [])]
        output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        row = np.array(output.split(), dtype=float)
        rows.append(row)
        _, unknowns, whole, less, jacobian, _, sparse, _, own, ida, radau, memory = row
        print(
            f"{n:6d}  {unknowns:8.0f}  {whole:12.0f} {less:12.0f}   {1e3 * jacobian:11.3f}"
            f"  {1e3 * sparse:16.3f} {1e3 * own:12.3f}      {ida:12.5f} {radau:12.5f}"
            f"       {memory:7.0f}"
        )
    table = np.array(rows)
    figure = Figure(figsize=(7.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for name, column in (
        ("factorise, memory in the sparse matrix", 6),
        ("factorise, memory eliminated", 8),
        ("run per simulated second, ida", 9),
        ("run per simulated second, radau", 10),
    ):
        known = table[:, column] > 0.0
        axes.loglog(table[known, 0], table[known, column], "o-", label=name)
    axes.set_xlabel("bodies, with 10 memory states each [-]")
    axes.set_ylabel("time [s]")
    axes.set_title("Bodies in surge, heave and pitch, all coupled by the water")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    save(figure, arguments.output)
    print(f"picture: {arguments.output}")


if __name__ == "__main__":
    main()
