"""hydro.h5 of the float, from the panel method's tables of the competition.

    python cases/wecccomp/make_database.py REFERENCE/wecccomp

The tables (WAMIT, about the centre of gravity of the float) hold A and B of surge, heave and pitch,
and the loads of the waves as phasors e^{+iwt}.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae import hdb
from hydrodae.commands.cli import guarded
from hydrodae.hdb.database.tables import Body

COORDINATES = ("float.surge", "float.heave", "float.pitch")
#: What moves in the six sea states [rad/s].
BAND = (2.0, 16.0)
#: Above it the tables are noisy [rad/s].
HIGHEST = 40.0


def hydrostatics(model: dict[str, Any], center: np.ndarray) -> hdb.Hydrostatics:
    """Waterplane from the stiffness: K33 = rho g A, K35 = -rho g S_x, K55 = rho g (S_xx + V zB)."""
    weight = model["rho"] * model["g"]
    stiffness = np.array(model["K_hydrostatic"]) / weight
    volume, buoyancy = model["displaced_volume"], np.array(model["cb"]) * [1.0, 0.0, 1.0]
    along = stiffness[4, 4] - volume * (buoyancy[2] - center[2])
    across = max(stiffness[3, 3] - volume * (buoyancy[2] - center[2]), 0.0)
    return hdb.Hydrostatics(
        displaced_volume=volume,
        center_of_buoyancy=buoyancy,
        waterplane_area=stiffness[2, 2],
        waterplane_moments=np.array([-stiffness[2, 4], 0.0, along, across, 0.0]),
    )


def make(folder: Path) -> hdb.HydroDatabase:
    """Database of the float with the fit "planar" of its radiation memory.

    Parameters
    ----------
    folder : path
        With bem.csv and model.json.
    """
    model = json.loads((folder / "model.json").read_text())
    table = np.genfromtxt(folder / "bem.csv", delimiter=",", names=True)
    table = table[table["omega"] <= HIGHEST]
    modes = (1, 3, 5)

    names = table.dtype.names or ()

    def matrix(kind: str) -> np.ndarray:
        rows = [[table[f"{kind}{i}{j}" if f"{kind}{i}{j}" in names else f"{kind}{j}{i}"]
                 for j in modes] for i in modes]  # fmt: skip
        full = np.moveaxis(np.array(rows), 2, 0)
        return np.asarray(0.5 * (full + full.swapaxes(1, 2)))

    at = np.ix_([0, 2, 4], [0, 2, 4])
    at_inf = np.array(model["A_inf"])[at]
    force = np.stack([table[f"reF{k}"] + 1j * table[f"imF{k}"] for k in modes], axis=1)
    center = np.array(model["bem_cg"])
    database = hdb.HydroDatabase(
        coordinates=COORDINATES,
        omega=table["omega"],
        added_mass=matrix("A"),
        radiation_damping=matrix("B"),
        added_mass_inf=0.5 * (at_inf + at_inf.T),
        added_mass_inf_std=1e-2 * np.abs(at_inf),
        heading=np.array([0.0]),
        froude_krylov=np.zeros((len(force), 1, 3), dtype=complex),
        diffraction=force[:, None, :],
        bodies={"float": Body("float", center, hydrostatics(model, center))},
        rho=model["rho"],
        gravity=model["g"],
        water_depth=model["water_depth"],
        excitation_split=False,
        source="bem.csv, WAMIT by BEMIO, of WEC-Sim/WECCCOMP 147b785",
        title="Float of the Wavestar arm at 1:20",
    )
    return hdb.fit(database, list(COORDINATES), name="planar", band=BAND, target=5e-3)


def main() -> None:
    """Write hydro.h5 beside this file."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("reference", type=Path, help="folder with bem.csv and model.json")
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).parent / "hydro.h5")
    arguments = parser.parse_args()
    database = make(arguments.reference)
    print(hdb.check(database))
    database.write(arguments.output)
    error = database.memory["planar"].report["h_error_band"]
    print(
        f"written: {arguments.output}; error of H in {BAND[0]:g} to {BAND[1]:g} rad/s {error:.1e}"
    )


if __name__ == "__main__":
    sys.exit(guarded(main))
