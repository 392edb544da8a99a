"""hydro.h5 of the section, from the two-dimensional table of the reference data.

    python cases/tank_section/make_database.py REFERENCE/tank_section

The table holds A, B and F of the whole model (a strip as wide as the model, 0.586 m) as phasors
e^{-iwt}; sway, heave and roll across the flume become surge, heave and pitch along +x.
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
from hydrodae.hdb.bem.shapes import box
from hydrodae.hdb.database.tables import Body

RHO, GRAVITY = 1000.0, 9.81  # fresh water [kg/m3], [m/s2]
COORDINATES = ("section.surge", "section.heave", "section.pitch")
#: What moves in the waves of the tank [rad/s]: heave, pitch and the waves from 0.63 to 1.52 s.
BAND = (2.0, 14.0)


def hydrostatics(model: dict[str, Any], center: float) -> hdb.Hydrostatics:
    """Waterplane of the box; the volume carries the mass, the buoyancy centre gives the GM."""
    width, beam = model["width_model"], model["beam"]
    volume, across = model["mass"] / RHO, width * beam**3 / 12.0
    height = center + model["GM"] - across / volume  # zB = zG + GM - I/V
    along = beam * width**3 / 12.0
    return hdb.Hydrostatics(
        displaced_volume=volume,
        center_of_buoyancy=np.array([0.0, 0.0, height]),
        waterplane_area=width * beam,
        waterplane_moments=np.array([0.0, 0.0, across, along, 0.0]),
    )


def make(folder: Path) -> hdb.HydroDatabase:
    """Database of the section with the fit "planar" of its radiation memory.

    Parameters
    ----------
    folder : path
        With hdb_2d.csv and model.json.
    """
    model = json.loads((folder / "model.json").read_text())
    table = np.genfromtxt(folder / "hdb_2d.csv", delimiter=",", names=True)
    pairs = [(i, j) for i in range(1, 4) for j in range(1, 4)]
    # a panel method keeps A and B symmetric to 1e-3: the mean of both halves
    a, b = (
        np.stack([table[f"{kind}{i}{j}"] for i, j in pairs], axis=1).reshape(-1, 3, 3)
        for kind in "AB"
    )
    at_inf = np.array(model["A_inf"])
    force = np.stack([table[f"reF{k}"] - 1j * table[f"imF{k}"] for k in (1, 2, 3)], axis=1)
    center = model["cog_above_keel"] - model["draft"]
    database = hdb.HydroDatabase(
        coordinates=COORDINATES,
        omega=table["omega"],
        added_mass=0.5 * (a + a.swapaxes(1, 2)),
        radiation_damping=0.5 * (b + b.swapaxes(1, 2)),
        added_mass_inf=0.5 * (at_inf + at_inf.T),
        added_mass_inf_std=1e-3 * np.abs(at_inf),
        heading=np.array([0.0]),
        froude_krylov=np.zeros((len(force), 1, 3), dtype=complex),
        diffraction=force[:, None, :],
        bodies={
            "section": Body(
                "section",
                np.array([0.0, 0.0, center]),
                hydrostatics(model, center),
                box(0.1, length=model["beam"], width=model["width_model"], draft=model["draft"]),
            )
        },
        rho=RHO,
        gravity=GRAVITY,
        water_depth=model["depth_water"],
        excitation_split=False,
        source="hdb_2d.csv, two-dimensional panel method times the width of the model",
        title="Section in the flume",
    )
    return hdb.fit(database, list(COORDINATES), name="planar", band=BAND, target=2e-3)


def main() -> None:
    """Write hydro.h5 beside this file."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("reference", type=Path, help="folder with hdb_2d.csv and model.json")
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).parent / "hydro.h5")
    arguments = parser.parse_args()
    database = make(arguments.reference)
    print(hdb.check(database))
    database.write(arguments.output)
    print(f"written: {arguments.output} ({arguments.output.stat().st_size / 1024:.0f} kB)")
    error = database.memory["planar"].report["h_error_band"]
    print(f"error of H in {BAND[0]:g} to {BAND[1]:g} rad/s: {error:.1e}")


if __name__ == "__main__":
    sys.exit(guarded(main))
