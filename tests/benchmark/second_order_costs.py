"""What loads of pairs of waves cost: processor time of runs with them against the linear run.

    .venv/bin/python tests/benchmark/second_order_costs.py

A moored cylinder with a fitted memory moves in surge, heave and pitch in 200 components, with the
tables of the OC4 semisubmersible (reference data) scaled to its size. Times are the least of some
runs, without the second run that estimates the error: inside the method, and of the whole run with
preparation, samples and file. Aims, in runs of 3 h: 1.2 with differences, 1.3 with sums
as well. The preparation does not depend on the length, so that ratios of short runs are larger.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np

import hydrodae
from hydrodae import hdb
from hydrodae.commands.cli import guarded
from hydrodae.hdb.database.second_order import SecondOrderTable

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests import reference_data  # noqa: E402
from tests.benchmark.hexagonal_arrays import with_bank  # noqa: E402
from tests.benchmark.ratios import print_ratios  # noqa: E402

RADIUS, DRAFT, CENTER, DEPTH, DENSITY = 5.0, 5.0, -2.5, 60.0, 1025.0
#: Frequencies of the memory's resonators [rad/s], about as many states as a fit has.
BANK = np.array([0.5, 0.8, 1.1, 1.5, 2.0])
Load = Literal["mean", "newman", "difference", "sum"]
#: Load of the cylinder over that of the semisubmersible.
SIZE = 0.1
LOADS: dict[str, list[Load]] = {
    "linear": [],
    "mean": ["mean"],
    "newman": ["newman"],
    "difference": ["difference"],
    "difference, sum": ["difference", "sum"],
}
AIMS = {"difference": 1.2, "difference, sum": 1.3}


def tables() -> dict[str, SecondOrderTable]:
    """Tables of differences and sums in surge, heave and pitch."""
    folder = reference_data.required("second_order", "qtf_oc4_wamit")
    source, _ = hdb.import_database(folder / "marin_semi.1", depth=200.0, rho=1025.0, gravity=9.81)
    found = {}
    for kind, table in source.second_order.items():
        kept = table.selected([f"marin_semi.{motion}" for motion in ("surge", "heave", "pitch")])
        assert kept is not None
        labels = tuple(label.replace("marin_semi", "buoy") for label in kept.coordinates)
        found[kind] = replace(kept, coordinates=labels, values=SIZE * kept.values)
    return found


def write_database(path: Path) -> None:
    """A cylinder with a memory that is made up as in hexagonal_arrays.py."""
    sea = hdb.Water(np.linspace(0.2, 3.0, 31), DEPTH, np.zeros(1), DENSITY)
    cylinder = hdb.Cylinder(RADIUS, DRAFT, CENTER)
    water = hdb.cylinders({"buoy": (0.0, 0.0)}, cylinder, sea, orders=3, modes=40)[0]
    made = with_bank(water, [list(water.coordinates)], BANK)
    made.with_second_order(tables()).write(path)


def case(folder: Path, loads: Sequence[Load], end: float) -> hydrodae.Case:
    """The cylinder in the sea."""
    made = hydrodae.Scene("Moored cylinder", directory=folder)
    made.hydro(database="hydro.h5")
    made.body(
        "buoy",
        hydro="buoy",
        motion="planar",
        mass=DENSITY * np.pi * RADIUS**2 * DRAFT,
        center_of_gravity=[0.0, 0.0, CENTER],
        inertia=[5e6, 5e6, 5e6],
    )
    made.force.mooring_matrix(
        "mooring",
        body="buoy",
        stiffness=[2e4, 0.0, 0.0, 0.0, 0.0, 0.0],
        damping=[2e4, 0.0, 0.0, 0.0, 2e7, 0.0],
    )
    made.wave.jonswap(
        "sea",
        significant_height=2.0,
        peak_period=8.0,
        components=200,
        seed=1,
        frequency_range=[0.5, 2.0],
    )
    if loads:
        made.second_order(loads=loads)
    made.solver(start="equilibrium", end_time=end, accuracy="none")
    made.output(step=0.5)
    return made.case()


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--end", type=float, default=1800.0, help="of the runs, s")
    parser.add_argument("--repeats", type=int, default=5)
    given = parser.parse_args()
    print(f"{given.end:g} s, 200 components")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_database(folder / "hydro.h5")
        scenes = {key: case(folder, loads, given.end) for key, loads in LOADS.items()}
        print_ratios(scenes, folder / "results.h5", given.repeats, AIMS)


if __name__ == "__main__":
    sys.exit(guarded(main))
