"""What axes that follow the yaw cost: time inside the method against mean axes, same case.

    .venv/bin/python tests/benchmark/yaw_axes.py

Cylinders that float upright, each on a soft spring, with tables of the interaction theory and a
memory that is made up as in hexagonal_arrays.py. Times are those of the kernel, the least of some
runs, without the second run that estimates the error. The last column is the ratio of the processor
time of the whole run, with preparation, samples and file.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, Literal

import numpy as np

import hydrodae
from hydrodae import hdb
from hydrodae.commands.cli import guarded

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.benchmark.hexagonal_arrays import with_bank  # noqa: E402

RADIUS, DRAFT, CENTER, DEPTH, SPACING = 2.0, 2.0, -1.2, 30.0, 12.0  # m
DENSITY = 1025.0
MASS = DENSITY * np.pi * RADIUS**2 * DRAFT  # kg
BANK = np.array([0.8, 1.2, 1.6, 2.1, 2.7])  # rad/s, of the memory's resonators
HEADINGS = {"all round": np.arange(0.0, 346.0, 15.0), "a fan": np.arange(-120.0, 121.0, 15.0)}
SEAS: dict[str, tuple[str, dict[str, Any]]] = {
    "regular wave": ("regular", {"height": 0.6, "period": 6.0}),
    "irregular sea": (
        "jonswap",
        {"significant_height": 0.6, "peak_period": 6.0, "components": 200, "seed": 1},
    ),
    "spreading sea": (
        "jonswap",
        {
            "significant_height": 0.6,
            "peak_period": 6.0,
            "components": 200,
            "seed": 1,
            "spreading": 20.0,
        },
    ),
}


def places(count: int) -> dict[str, tuple[float, float]]:
    """Of bodies in a row [m]."""
    return {f"buoy{i}": (SPACING * i, 0.0) for i in range(count)}


def water(count: int, headings: str) -> hdb.HydroDatabase:
    """Tables with a memory."""
    sea = hdb.Water(np.linspace(0.2, 3.2, 31), DEPTH, np.radians(HEADINGS[headings]), DENSITY)
    tables = hdb.cylinders(
        places(count), hdb.Cylinder(RADIUS, DRAFT, CENTER), sea, orders=3, modes=40
    )[0]
    return with_bank(tables, [list(tables.coordinates)], BANK)


def scene(
    directory: Path,
    count: int,
    sea: str,
    phase: Literal["fixed", "moving"],
    axes: Literal["mean", "yaw"],
    end: float,
) -> hydrodae.Scene:
    """Buoys on springs in a sea."""
    made = hydrodae.Scene("Buoys", directory=directory)
    made.hydro(database="hydro.h5", axes=axes)
    for name, (x, y) in places(count).items():
        made.body(
            name,
            hydro=name,
            mass=MASS,
            center_of_gravity=[x, y, CENTER],
            inertia=[3e4, 3e4, 5e4],
            initial={"rotation_deg": [0.0, 0.0, 5.0]},
        )
        made.force.mooring_matrix(
            f"spring_{name}", body=name, stiffness=[2e3, 2e3, 0.0, 0.0, 0.0, 5e4]
        )
        made.force.viscous_damping(f"drag_{name}", body=name, linear=[0.0] * 5 + [5e3])
    kind, keys = SEAS[sea]
    getattr(made.wave, kind)("sea", heading_deg=10.0, **keys)
    made.sea(ramp=20.0, phase=phase)
    made.solver(end_time=end, accuracy="none")
    made.output(step=0.1)
    return made


def measure(case: hydrodae.Case, path: Path, repeats: int) -> tuple[float, float, int]:
    """Least time of the method, and of the whole run [s], and steps."""
    inside, whole, steps = np.inf, np.inf, 0
    for _ in range(repeats):
        before = time.process_time()
        results = hydrodae.run(case, path)
        whole = min(whole, time.process_time() - before)
        inside = min(inside, float(results.statistics["solver_time"]))
        steps = int(results.statistics["steps"])
    return inside, whole, steps


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--end", type=float, default=300.0, help="of the runs, s")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--counts", type=int, nargs="+", default=(1, 3))
    parser.add_argument("--phase", choices=("fixed", "moving"), default="fixed", help="of waves")
    given = parser.parse_args()
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    for count in given.counts:
        for headings in HEADINGS:
            with tempfile.TemporaryDirectory() as folder:
                water(count, headings).write(Path(folder) / "hydro.h5")
                for sea in SEAS:
                    both: tuple[Literal["mean", "yaw"], ...] = ("mean", "yaw")
                    cost = {
                        axes: measure(
                            scene(Path(folder), count, sea, given.phase, axes, given.end).case(),
                            Path(folder) / "results.h5",
                            given.repeats,
                        )
                        for axes in both
                    }
                    (mean, mean_whole, n), (yaw, yaw_whole, m) = cost["mean"], cost["yaw"]
                    print(
                        f"{count} bodies, headings {headings}, {sea}: mean {mean:.3f} s "
                        f"({n} steps), yaw {yaw:.3f} s ({m} steps), {yaw / mean:.2f} times; "
                        f"whole run {mean_whole:.3f} and {yaw_whole:.3f} s, "
                        f"{yaw_whole / mean_whole:.2f} times",
                        flush=True,
                    )


if __name__ == "__main__":
    sys.exit(guarded(main))
