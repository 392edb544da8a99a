"""Cost and error of each model of radiation: sphere, F3OF, RM3, four nodes of 4N3LA.

    .venv/bin/python tests/benchmark/radiation_ladder.py

RM3 and 4N3LA need the reference data ($HYDRODAE_REFERENCE or ../shared/reference) and are left out,
which is told, without it. Databases are prepared in a temporary folder. For each device: the ladder
of `hydrodae ladder`, and the solver's time per simulated second of every rung.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.hdb.memory import fit_memory
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.study.ladder import ladder

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests import reference_data  # noqa: E402

PLANAR = ("surge", "heave", "pitch")

NODES = {"S3": (0.0, 0.0), "C1": (0.7, -1.21), "S1": (0.0, -2.42), "S2": (2.1, -1.21)}
NODE = """
[[body]]
name = "{name}"
hydro = "{name}"
mass = 173.9
center_of_gravity = [{x}, {y}, -0.3]
inertia = [9.13, 9.13, 7.83]
initial.displacement = [0.0, 0.0, {start}]
"""
FOUR_NODES = (
    'title = "Four nodes of 4N3LA, one released in heave"\n[hydro]\ndatabase = "4n3la.h5"\n'
)
FOUR_NODES += "[solver]\nend_time = 20.0\n" + "".join(
    NODE.format(name=name, x=x, y=y, start=0.1 if name == "S3" else 0.0)
    for name, (x, y) in NODES.items()
)


def sphere(_folder: Path) -> hydrodae.Case:
    """One coordinate."""
    return hydrodae.Case.read(ROOT / "cases" / "sphere" / "decay.toml")


def f3of(folder: Path) -> hydrodae.Case:
    """Six coordinates, narrow peaks: a kernel of ten minutes."""
    shutil.copy(ROOT / "cases" / "f3of" / "flap_decay.toml", folder)
    database = hydrodae.hdb.read(ROOT / "cases" / "f3of" / "hydro.h5")
    moving = [f"{body}.{dof}" for body in ("flap1", "flap2") for dof in PLANAR]
    database.with_kernel(moving).write(folder / "hydro.h5")
    return hydrodae.Case.read(folder / "flap_decay.toml").with_values({"solver.end_time": 100.0})


def rm3(folder: Path) -> hydrodae.Case:
    """Two bodies in the plane, noisy tables; see cases/rm3/README.md."""
    source = reference_data.required("hdb", "rm3_wamit")
    points = {"float": [0.0, 0.0, -0.72], "spar": [0.0, 0.0, -21.29]}
    database, _ = import_database(source, names=list(points), reference_points=points, rho=1000.0)
    moving = [f"{body}.{dof}" for body in points for dof in PLANAR]
    band = (0.1, 1.6)
    database.memory["planar"] = fit_memory(database, inputs=moving, band=band, max_states=40)
    database.with_kernel(moving, band=band).write(folder / "hydro.h5")
    shutil.copy(ROOT / "cases" / "rm3" / "decay.toml", folder)
    return hydrodae.Case.read(folder / "decay.toml").with_values({"solver.end_time": 100.0})


def four_nodes(folder: Path) -> hydrodae.Case:
    """Four free bodies, between which waves travel."""
    points = {name: [x, y, -0.3] for name, (x, y) in NODES.items()}
    table = reference_data.required("hdb", "own", "4n3la.nc")
    database, _ = import_database(table, reference_points=points)
    band, every = (1.0, 8.0), database.coordinates
    database.memory["all"] = fit_memory(database, inputs=every, band=band, uniform=0.01)
    database.with_kernel(every, band=band).write(folder / "4n3la.h5")
    return hydrodae.Case.from_text(FOUR_NODES, folder)


DEVICES = {"sphere": sphere, "f3of": f3of, "rm3": rm3, "4n3la": four_nodes}


def main() -> None:
    """Print ladders and costs per simulated second."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("devices", nargs="*", choices=[[], *DEVICES], help="default: all")
    parser.add_argument("--repeat", type=int, default=5, help="time is the best of N runs")
    arguments = parser.parse_args()
    for name in arguments.devices or DEVICES:
        if name in ("rm3", "4n3la") and not reference_data.folder().is_dir():
            print(f"{name} left out: no reference data in {reference_data.folder()}")
            continue
        with tempfile.TemporaryDirectory() as folder:
            case = DEVICES[name](Path(folder))
            made = ladder(case, repeat=arguments.repeat)
        print(f"{made}\n  solver time per simulated second:", end="")
        for rung in made.rungs:
            cost = 1e6 * rung.time / case.end_time
            print(f"  {rung.name} {'-' if np.isnan(cost) else f'{cost:.0f} us'}", end="")
        print("\n", flush=True)


if __name__ == "__main__":
    sys.exit(guarded(main))
