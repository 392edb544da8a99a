"""What waves cost that are summed at places: runs with drag or a mesh against the linear runs.

    .venv/bin/python tests/benchmark/wave_loads.py

RM3 in heave with the drag of its discs (cases/rm3/sea.toml, the database from reference data) for
600 s, and a cylinder with a mesh (yaw_axes.py) in a long-crested and in a spreading sea of 200
components. Times are processor seconds of whole runs, the least of some runs in turn, without the
second run that estimates the error. Aims: drag 1.3, spreading sea on the mesh 15. What
one evaluation of a mesh costs is printed by hydrodae-hull-loads.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.commands.cli import main as command

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests import reference_data  # noqa: E402
from tests.benchmark.ratios import print_ratios  # noqa: E402
from tests.benchmark.yaw_axes import CENTER, DRAFT, MASS, RADIUS, SEAS, water  # noqa: E402

AIMS = {"RM3 with drag": 1.3, "mesh, spreading sea": 15.0}


def rm3(folder: Path, end: float) -> dict[str, hydrodae.Case]:
    """RM3 without and with drag."""
    source = reference_data.required("hdb", "rm3_wamit")
    both = "float.heave,spar.heave"
    keep = ["--rho", "1000", "--keep", both, "--states", "16"]
    fit = ["--fit", f"heave={both}", "--band", "0.1,1.6"]
    command(["hdb", "import", str(source), "-o", str(folder / "rm3.h5"), *keep, *fit])
    text = (ROOT / "cases/rm3/sea.toml").read_text().replace("hydro.h5", "rm3.h5")
    start, stop = text.index("[[morison]]"), text.index("[solver]")
    (folder / "drag.toml").write_text(text)
    (folder / "linear.toml").write_text(text[:start] + text[stop:])
    values = {"solver.end_time": end, "solver.accuracy": "none"}
    names = {"RM3": "linear.toml", "RM3 with drag": "drag.toml"}
    return {name: hydrodae.Case(path=folder / file, values=values) for name, file in names.items()}


def write_mesh(path: Path, around: int = 48, rings: int = 20) -> None:
    """The cylinder from its bottom to as far above the water, in ASCII STL."""
    z = np.linspace(-DRAFT, DRAFT, rings + 1)
    angle = np.linspace(0.0, 2.0 * np.pi, around + 1)
    circle = RADIUS * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    circle[-1] = circle[0]
    with path.open("w") as file:

        def facet(*corners: tuple[float, float, float]) -> None:
            lines = "".join(f"vertex {x:.17g} {y:.17g} {h:.17g}\n" for x, y, h in corners)
            file.write(f"facet normal 0 0 0\nouter loop\n{lines}endloop\nendfacet\n")

        file.write("solid cylinder\n")
        for a, b in itertools.pairwise(circle):
            facet((0.0, 0.0, z[0]), (*b, z[0]), (*a, z[0]))
            facet((0.0, 0.0, z[-1]), (*a, z[-1]), (*b, z[-1]))
            for low, high in itertools.pairwise(z):
                facet((*a, low), (*b, low), (*b, high))
                facet((*a, low), (*b, high), (*a, high))
        file.write("endsolid cylinder\n")


def cylinder(folder: Path, sea: str, meshed: bool, end: float) -> hydrodae.Case:
    """A cylinder on a soft spring, linear or with the pressure on its wetted surface."""
    made = hydrodae.Scene("Cylinder", directory=folder)
    made.hydro(database="cylinder.h5")
    mesh: dict[str, Any] = {"mesh": "cylinder.stl", "hydrostatics": "mesh", "froude_krylov": "mesh"}
    made.body(
        "buoy0",
        hydro="buoy0",
        mass=MASS,
        center_of_gravity=[0.0, 0.0, CENTER],
        inertia=[3e4, 3e4, 5e4],
        **(mesh if meshed else {}),
    )
    stiffness = [2e3, 2e3, 0.0, 0.0, 0.0, 5e4]
    made.force.mooring_matrix("spring", body="buoy0", stiffness=stiffness)
    made.force.viscous_damping("drag", body="buoy0", linear=[0.0] * 5 + [5e3])
    kind, keys = SEAS[sea]
    getattr(made.wave, kind)("sea", heading_deg=10.0, **keys)
    made.sea(ramp=20.0)
    made.solver(end_time=end, accuracy="none")
    made.output(step=0.1)
    return made.case()


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--end", type=float, default=600.0, help="of RM3, s")
    parser.add_argument("--mesh-end", type=float, default=60.0, help="of the cylinder, s")
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print_ratios(rm3(folder, given.end), folder / "results.h5", given.repeats, AIMS)
        water(1, "all round").write(folder / "cylinder.h5")
        write_mesh(folder / "cylinder.stl")
        for sea in ("irregular sea", "spreading sea"):
            cases = {
                f"{'mesh' if meshed else 'linear'}, {sea}": cylinder(
                    folder, sea, meshed, given.mesh_end
                )
                for meshed in (False, True)
            }
            print_ratios(cases, folder / "results.h5", given.repeats, AIMS)


if __name__ == "__main__":
    sys.exit(guarded(main))
