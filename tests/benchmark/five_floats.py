"""Five jointed floats on dynamic lines in a spread sea: how many times faster than real time.

    .venv/bin/python tests/benchmark/five_floats.py

After the attenuator "5SA" of SEA-Stack's demonstrations, which states 8.2 times real time for it:
five segments of 438 t, 36 m apart, universal joints with four spring dampers about each, five
lines of 165 segments in all of which four meet in a weight below the bow, 50 m of water, waves of
3 m and 10 s, spread by cos^24. Masses, inertias, springs, damping, lines and sea are those of the
demonstration, but not the water: in place of long tubes these are wide vertical cylinders of the
same displacement, with a memory that is made up as in hexagonal_arrays.py. So it costs what that
case costs, and answers nothing about it. `--lines catenary` takes quasi-static lines instead.
"""

from __future__ import annotations

import argparse
import itertools
import math
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

import hydrodae
from hydrodae import hdb
from hydrodae.commands.cli import guarded

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.benchmark.hexagonal_arrays import with_bank  # noqa: E402

MASS, INERTIA = 438293.0, [876585.0, 47773884.0, 47773884.0]  # kg, kg m2
SPACING, CENTER, DEPTH = 36.0, -1.8, 50.0  # m
RADIUS, DENSITY = 8.0, 1025.0  # m, kg/m3
DRAFT = MASS / (DENSITY * math.pi * RADIUS**2)  # m
BANK = np.array([0.35, 0.5, 0.7, 0.95, 1.3, 1.7])  # rad/s, of the memory's resonators
NAMES = [f"segment{i}" for i in range(1, 6)]
PLACES = {name: (0.5 * SPACING + i * SPACING, 0.0) for i, name in enumerate(NAMES)}  # m
SIDES = {"top": (0.0, 1.5), "keel": (0.0, -1.5), "left": (1.5, 0.0), "right": (-1.5, 0.0)}  # m
ROPE: dict[str, Any] = dict(
    mass=[10.0],
    diameter=[0.04],
    stiffness=[50e6],
    damping_ratio=[0.8],
    drag=[1.2],
    drag_axial=[0.05],
    added_mass=[0.8],
    seabed_stiffness=3e6,
    seabed_damping=3e5,
    waves=False,
)
WEIGHT = [-10.0, 0.0, -25.0]  # m, where the lines of the bow meet
LINES = {  # body A, point A, body B, point B, length, segments
    "ahead": ("ground", [-150.0, 0.0, -DEPTH], "weight", WEIGHT, 160.0, 40),
    "port": ("ground", [-75.0, 130.0, -DEPTH], "weight", WEIGHT, 160.0, 40),
    "starboard": ("ground", [-75.0, -130.0, -DEPTH], "weight", WEIGHT, 160.0, 40),
    "tether": ("weight", WEIGHT, "segment1", [0.0, 0.0, CENTER], 28.0, 10),
    "astern": ("ground", [230.0, 0.0, -DEPTH], "segment3", [90.0, 0.0, CENTER - 2.0], 165.0, 35),
}


def water() -> hdb.HydroDatabase:
    """Tables of the five cylinders, and a memory that is made up."""
    headings = np.radians(np.arange(-90.0, 91.0, 15.0))
    sea = hdb.Water(np.linspace(0.2, 2.6, 25), DEPTH, headings, DENSITY)
    cylinder = hdb.Cylinder(RADIUS, DRAFT, CENTER)
    tables = hdb.cylinders(PLACES, cylinder, sea, orders=2, modes=120)[0]
    return with_bank(tables, [list(tables.coordinates)], BANK)


def scene(directory: Path, lines: str = "line") -> hydrodae.Scene:
    """Attenuator on lines of this type, whose database is hydro.h5 in the directory."""
    made = hydrodae.Scene("Five floats on five lines", directory=directory)
    made.hydro(database="hydro.h5")
    for name, (x, y) in PLACES.items():
        made.body(name, hydro=name, mass=MASS, center_of_gravity=[x, y, CENTER], inertia=INERTIA)
        made.force.viscous_damping(
            f"drag_{name}",
            body=name,
            linear=[2e4, 8e4, 8e4, 5e5, 2e5, 2e5],
            quadratic=[1e4, 4e4, 4e4, 2.5e5, 1e5, 1e5],
        )
    for i, (fore, aft) in enumerate(itertools.pairwise(NAMES), start=1):
        x = i * SPACING
        made.joint.universal(
            f"joint{i}",
            body_a=fore,
            body_b=aft,
            point=[x, 0.0, CENTER],
            axis=[1.0, 0.0, 0.0],  # not turned about: pitch and yaw are free
            axis_x=[0.0, 1.0, 0.0],
        )
        for side, (y, z) in SIDES.items():
            made.force.spring_damper(
                f"ram{i}_{side}",
                body_a=fore,
                body_b=aft,
                point_a=[x - 1.0, y, CENTER + z],
                point_b=[x + 1.0, y, CENTER + z],
                stiffness=25000.0,
                damping=500000.0,
                length=2.0,
            )
    made.body("weight", motion="point", mass=3000.0, center_of_gravity=WEIGHT, volume=0.5)
    for name, (a, point_a, b, point_b, length, segments) in LINES.items():
        if lines == "catenary":
            (mass,), (diameter,) = ROPE["mass"], ROPE["diameter"]
            made.force.catenary(
                name,
                body_a=a,
                body_b=b,
                point_a=point_a,
                point_b=point_b,
                length=[length],
                weight=[9.81 * (mass - 0.25 * math.pi * diameter**2 * DENSITY)],
                stiffness=ROPE["stiffness"],
                seabed=a == "ground",
            )
            continue
        made.force.line(
            name,
            body_a=a,
            body_b=b,
            point_a=point_a,
            point_b=point_b,
            length=[length],
            segments=[segments],
            **ROPE,
        )
    made.sea(ramp=60.0)
    made.wave.jonswap(
        "sea", significant_height=3.0, peak_period=10.0, spreading=12.0, components=500, seed=42
    )
    made.solver(start="equilibrium", end_time=600.0)
    made.output(step=0.1)
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--end", type=float, default=600.0, help="of the run, s")
    parser.add_argument("--lines", choices=("line", "catenary"), default="line")
    parser.add_argument("--rtol", type=float, nargs="+", default=(1e-3, 1e-4))
    given = parser.parse_args()
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder:
        water().write(Path(folder) / "hydro.h5")
        case = scene(Path(folder), given.lines).case().with_values({"solver.end_time": given.end})
        for rtol in given.rtol:
            before = time.process_time()
            results = hydrodae.run(case, Path(folder) / "results.h5", set={"solver.rtol": rtol})
            used, found = time.process_time() - before, results.statistics
            print(
                f"rtol {rtol:g}: {used:.2f} s for {given.end:g} s, {given.end / used:.0f} times "
                f"real time; {found['method_in_use']}, {found['steps']} steps, "
                f"{found['unknowns']} unknowns, estimated error {found['estimated_error']:.0e}",
                flush=True,
            )


if __name__ == "__main__":
    sys.exit(guarded(main))
