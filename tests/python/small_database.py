"""A buoy with a made-up database of three coordinates."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.memory import ExponentialMemory

CASE = """title = "buoy"

[hydro]
database = "hydro.h5"

[[body]]
name = "buoy"
motion = "heave"
mass = 1000.0
center_of_gravity = [0.0, 0.0, -1.0]
hydro = "float"

[solver]
end_time = 1.0
"""


def make_database(names: tuple[str, ...] = ("float.surge", "float.heave", "float.pitch")):
    """A body with made-up but admissible coefficients and one fit for heave."""
    n, omega = len(names), np.array([0.5, 1.0, 2.0])
    heave = ("float.heave",)
    fit = ExponentialMemory(
        "heave",
        heave,
        heave,
        poles=np.array([-1.0 + 0.0j, -0.5 + 2.0j]),
        input_matrix=np.array([[1.0 + 0.0j], [1.0 + 0.5j]]),
        output_matrix=np.array([[10.0 + 0.0j, 20.0 - 3.0j]]),
        added_mass_inf=np.array([[300.0]]),
        report={"n_states": 3, "passive": True},
    )
    return HydroDatabase(
        coordinates=names,
        omega=omega,
        added_mass=np.tile(400.0 * np.eye(n), (3, 1, 1)),
        radiation_damping=np.tile(50.0 * np.eye(n), (3, 1, 1)),
        added_mass_inf=300.0 * np.eye(n),
        added_mass_inf_std=np.zeros((n, n)),
        heading=np.array([0.0]),
        froude_krylov=np.zeros((3, 1, n), complex),
        diffraction=np.zeros((3, 1, n), complex),
        bodies={
            "float": Body(
                "float",
                np.array([0.0, 0.0, -1.0]),
                Hydrostatics(1.0, np.array([0.0, 0.0, -1.2]), 2.0, np.zeros(5)),
            )
        },
        rho=1000.0,
        gravity=9.81,
        memory={"heave": fit},
    )


def write_case(folder: Path) -> Path:
    """The case with its database."""
    make_database().write(folder / "hydro.h5")
    path = folder / "case.toml"
    path.write_text(CASE)
    return path
