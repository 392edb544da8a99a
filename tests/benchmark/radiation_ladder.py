"""Cost and error of each model of radiation: sphere, F3OF, RM3, four nodes of 4N3LA.

    .venv/bin/python tests/benchmark/radiation_ladder.py

RM3 and 4N3LA need the reference data ($HYDRODAE_REFERENCE or ../shared/reference) and are left out,
which is told, without it. Databases are prepared in a temporary folder. For each device: the ladder
of `hydrodae ladder`, and the solver's time per simulated second of every rung.
"""

from __future__ import annotations

import argparse
import os
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import hydrodae
from hydrodae.hdb.read import import_database
from hydrodae.ladder import ladder
from hydrodae.memory import fit_memory

ROOT = Path(__file__).resolve().parents[2]

RM3_BODY = """
[[body]]
name = "{name}"
hydro = "{name}"
motion = "planar"
mass = {mass}
center_of_gravity = [0.0, 0.0, {z}]
inertia = [{inertia}, {inertia}, {inertia}]
"""
RM3 = (
    """
title = "RM3, float released 0.1 m up"
[hydro]
database = "rm3.h5"
[[joint]]
name = "guide"
type = "prismatic"
body_a = "spar"
body_b = "float"
point = [0.0, 0.0, -0.72]
axis = [0.0, 0.0, 1.0]
initial.displacement = 0.1
[solver]
end_time = 100.0
"""
    + RM3_BODY.format(name="float", mass=725834.0, z=-0.72, inertia=21306090.66)
    + RM3_BODY.format(name="spar", mass=886691.0, z=-21.29, inertia=94407091.24)
)
NODES = {"S3": (0.0, 0.0), "C1": (0.7, -1.21), "S1": (0.0, -2.42), "S2": (2.1, -1.21)}
NODE = """
[[body]]
name = "{name}"
hydro = "{name}"
motion = "heave"
mass = 173.9
center_of_gravity = [{x}, {y}, -0.3]
initial.displacement = [0.0, 0.0, {start}]
"""
FOUR_NODES = 'title = "Four nodes of 4N3LA, heave, one released"\n[hydro]\ndatabase = "4n3la.h5"\n'
FOUR_NODES += "[solver]\nend_time = 20.0\n" + "".join(
    NODE.format(name=name, x=x, y=y, start=0.1 if name == "S3" else 0.0)
    for name, (x, y) in NODES.items()
)


def reference() -> Path | None:
    """Folder of the reference data, None where there is none."""
    folder = Path(os.environ.get("HYDRODAE_REFERENCE", ROOT.parent / "shared" / "reference"))
    return folder if folder.is_dir() else None


def prepare(
    source: Path,
    target: Path,
    moving: Sequence[str],
    points: dict[str, list[float]],
    band: tuple[float, float],
    names: Sequence[str] | None = None,
    rho: float | None = None,
) -> None:
    """Import a database, fit what moves, and make its kernel."""
    database, _ = import_database(source, names=names, reference_points=points, rho=rho)
    database.memory["moving"] = fit_memory(database, inputs=moving, band=band, name="moving")
    database.with_kernel(moving, band=band).write(target)


def cases(folder: Path) -> list[hydrodae.Case]:
    """All devices that can be run here."""
    found = [hydrodae.Case.read(ROOT / "cases" / "sphere" / "decay.toml")]
    shutil.copy(ROOT / "cases" / "f3of" / "flap_decay.toml", folder)
    database = hydrodae.hdb.read(ROOT / "cases" / "f3of" / "hydro.h5")
    planar = ("surge", "heave", "pitch")
    flaps = [f"{body}.{dof}" for body in ("flap1", "flap2") for dof in planar]
    database.with_kernel(flaps).write(folder / "hydro.h5")
    f3of = hydrodae.Case.read(folder / "flap_decay.toml")
    found.append(f3of.with_values({"solver.end_time": 100.0}))
    data = reference()
    if data is None:
        print("no reference data: RM3 and 4N3LA are left out")
        return found
    points = {"float": [0.0, 0.0, -0.72], "spar": [0.0, 0.0, -21.29]}
    moving = [f"{body}.{dof}" for body in points for dof in planar]
    wamit = data / "hdb" / "rm3_wamit"
    prepare(wamit, folder / "rm3.h5", moving, points, (0.2, 3.0), list(points), 1000.0)
    found.append(hydrodae.Case.from_text(RM3, folder))
    nodes = {name: [x, y, -0.3] for name, (x, y) in NODES.items()}
    heave = [f"{name}.heave" for name in NODES]
    prepare(data / "hdb" / "own" / "4n3la.nc", folder / "4n3la.h5", heave, nodes, (1.0, 6.0))
    found.append(hydrodae.Case.from_text(FOUR_NODES, folder))
    return found


def main() -> None:
    """Print ladders and costs per simulated second."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeat", type=int, default=5, help="time is the best of N runs")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for case in cases(Path(folder)):
            made = ladder(case, repeat=arguments.repeat)
            print(f"{made}\n  solver time per simulated second:", end="")
            for rung in made.rungs:
                cost = 1e6 * rung.time / case.end_time
                print(f"  {rung.name} {'-' if np.isnan(cost) else f'{cost:.0f} us'}", end="")
            print("\n")


if __name__ == "__main__":
    main()
