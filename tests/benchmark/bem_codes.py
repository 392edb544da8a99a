"""Runs of one's own with Capytaine (`hydrodae hdb compute`) against tables of other codes.

    python tests/benchmark/bem_codes.py [--work FOLDER] [cylinder] [boxes] [shallow]

cylinder: radius 0.35 m, draught 0.63 m, 3 m of water, against WAMIT (WEC-Sim's example, in the
reference data, $HYDRODAE_REFERENCE).
boxes: two boxes 5 m deep in 20 m of water, sides 10 m and sqrt(50) m, 100 m apart, the smaller one
turned by 45 degrees, waves from 45 degrees, against Aquaplus (Nemoh 2, Verification/2Bodies).
shallow: a cylinder in waves so long that k h < 0.1, against matched eigenfunctions.

Printed are largest differences over the coordinates: of A and B as rms over the frequencies by the
rms, of forces likewise. Finished frequencies are kept in FOLDER.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae import hdb
from hydrodae.commands.cli import guarded
from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests import reference_data  # noqa: E402

#: |F| in surge, sway, heave of the large and of the turned box [N/m], by frequency [rad/s].
AQUAPLUS = {
    0.2: (82594.64, 82607.05, 946274.2, 43353.29, 43584.87, 478373.7),
    0.4: (169483.6, 169350.2, 855714.4, 91034.51, 89214.16, 430806.1),
    0.6: (266976.1, 265439.8, 722302.1, 134091.9, 139818.1, 385691.7),
    0.8: (381466.8, 377417.8, 561543.9, 212520.7, 199831.6, 285466.1),
}


def _rms(ours: NDArray[Any], theirs: NDArray[Any]) -> float:
    """Largest rms difference over the rms of a column; the rows are frequencies."""
    square = np.mean(np.abs(ours - theirs) ** 2, axis=0) / np.mean(np.abs(theirs) ** 2, axis=0)
    return float(np.sqrt(square.max()))


def compare(
    ours: hdb.HydroDatabase,
    theirs: hdb.HydroDatabase,
    labels: tuple[str, ...] = ("surge", "heave", "pitch"),
) -> dict[str, float]:
    """Differences of one body at the frequencies of `ours`, which both hold."""
    at = [int(np.abs(theirs.omega - w).argmin()) for w in ours.omega]
    one = ours.select([f"{next(iter(ours.bodies))}.{d}" for d in labels])
    other = theirs.select([f"{next(iter(theirs.bodies))}.{d}" for d in labels])
    result = {}
    for key, name in (("A", "added_mass"), ("B", "radiation_damping")):
        x, y = (np.einsum("wii->wi", getattr(d, name)) for d in (one, other))
        result[key] = _rms(x, y[at])
    result["F"] = _rms(one.excitation[:, 0], other.excitation[at, 0])
    inf = [np.diag(d.added_mass_inf) for d in (one, other)]
    result["A(inf)"] = float(np.abs(inf[0] / inf[1] - 1.0).max())
    return result


def cylinder(work: Path, count: int = 15) -> dict[str, float]:
    """The cylinder of WEC-Sim's example at `count` of WAMIT's frequencies, 1 to 8 rad/s."""
    theirs = hdb.read(reference_data.required("hdb", "cylinder_wamit_out"), rho=1025.0)
    asked = np.linspace(1.0, 8.0, count)
    omega = theirs.omega[[int(np.abs(theirs.omega - w).argmin()) for w in asked]]
    panels = shapes.cylinder(0.05, radius=0.35, draft=0.63)
    name = next(iter(theirs.bodies))
    body = bem.WettedBody("cylinder", panels, theirs.reference_point(name))
    settings = bem.Settings(omega=omega, rho=1025.0, water_depth=theirs.water_depth)
    return compare(hdb.read(bem.compute([body], settings, work)), theirs)


def boxes(work: Path, count: int = 4) -> dict[str, float]:
    """The two boxes at the first `count` of Aquaplus' frequencies."""
    turn = np.sqrt(0.5) * np.array([[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, np.sqrt(2.0)]])
    side = float(np.sqrt(50.0))
    large = shapes.box(1.0, length=10.0, width=10.0, draft=5.0, x=100.0)
    small = shapes.box(0.9, length=side, width=side, draft=5.0) @ turn.T
    point = np.array([0.0, 0.0, -2.5])
    bodies = [bem.WettedBody("large", large, point), bem.WettedBody("small", small, point)]
    settings = bem.Settings(
        omega=np.array(list(AQUAPLUS)),
        heading=np.array([np.pi / 4.0]),
        rho=1000.0,
        water_depth=20.0,
    )
    ours = hdb.read(bem.compute(bodies, settings, work))
    columns = ours.index(
        [f"{b}.{d}" for b in ("large", "small") for d in ("surge", "sway", "heave")]
    )
    force = np.abs(ours.excitation[:count, 0, columns])
    theirs = np.array(list(AQUAPLUS.values()))[:count]
    return {"F": float(np.abs(force / theirs - 1.0).max())}


def shallow(work: Path) -> dict[str, float]:
    """A cylinder of 1 m radius and draught in 3 m of water at k h from 0.04 to 0.12."""
    omega = np.array([0.07, 0.11, 0.15, 0.19])
    panels = shapes.cylinder(0.25, radius=1.0, draft=1.0)
    body = bem.WettedBody("buoy", panels, np.zeros(3))
    settings = bem.Settings(omega=omega, rho=1000.0, water_depth=3.0)
    ours = hdb.read(bem.compute([body], settings, work))
    water = hdb.Water(omega, depth=3.0, rho=1000.0)
    theirs, _ = hdb.cylinders({"buoy": (0.0, 0.0)}, hdb.Cylinder(1.0, 1.0, 0.0), water)
    return compare(ours, theirs, ("surge", "heave"))


CASES = {"cylinder": cylinder, "boxes": boxes, "shallow": shallow}


def main() -> None:
    """Print the differences of the cases that are named, or of all."""
    assert __doc__ is not None
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", nargs="*", choices=[[], *CASES])
    parser.add_argument("--work", metavar="FOLDER", type=Path)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        for name in args.case or CASES:
            found = CASES[name](args.work or Path(temporary))
            print(f"{name}: " + ", ".join(f"{k} {v:.2%}" for k, v in found.items()), flush=True)


if __name__ == "__main__":
    sys.exit(guarded(main))
