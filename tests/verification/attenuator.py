"""Three floats in a row, hinged to each other and moored: made from the sphere of cases/sphere.

Each float has the added mass, damping and excitation of a sphere alone, with the phase of where it
stands; what one float radiates or scatters onto the others is left out. The surge of such a device
is soft, and shows what hydrodynamic axes do at second order.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hydrodae
from hydrodae.hdb import read
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.memory import fit_memory
from hydrodae.support.arrays import Complex

PLACES = {"fore": -20.0, "middle": 0.0, "aft": 20.0}  # x [m]
DRAUGHT = 5.0  # [m]
PLANAR = ("surge", "heave", "pitch")
MOORING = 3.0e4  # of the fore float in surge [N/m]: a period of about 40 s
DRAG = 2.0e4  # with the mooring [N s/m]
DAMPING = 5.0e6  # of each hinge [N m s/rad]

FLOAT = """
[[body]]
name = "{name}"
hydro = "{name}"
motion = "planar"
mass = 261.8e3
center_of_gravity = [{x}, 0.0, -2.0]
inertia = [2.5e6, 2.5e6, 2.5e6]
"""
HINGE = """
[[joint]]
name = "{name}"
type = "revolute"
body_a = "{a}"
body_b = "{b}"
point = [{x}, 0.0, 1.0]
axis = [0.0, 1.0, 0.0]

[[force]]
type = "pto_linear"
name = "pto_{name}"
joint = "{name}"
damping = {damping}
"""
CASE = (
    """
title = "Three floats, hinged and moored"

[hydro]
database = "hydro.h5"

[sea]
ramp = 50.0

[[wave]]
name = "sea"
type = "jonswap"
significant_height = 1.0
peak_period = 7.0
"""
    + "".join(FLOAT.format(name=name, x=x) for name, x in PLACES.items())
    + HINGE.format(name="front", a="fore", b="middle", x=-10.0, damping=DAMPING)
    + HINGE.format(name="rear", a="middle", b="aft", x=10.0, damping=DAMPING)
    + f"""
[[force]]
type = "mooring_matrix"
name = "mooring"
body = "fore"
stiffness = [{MOORING}, 0.0, 0.0, 0.0, 0.0, 0.0]
damping = [{DRAG}, 0.0, 0.0, 0.0, 0.0, 0.0]

[solver]
start = "equilibrium"
end_time = 300.0

[output]
step = 0.1
"""
)


def database(sphere: HydroDatabase) -> HydroDatabase:
    """Three spheres, planar, without interaction."""
    labels = [f"sphere.{dof}" for dof in PLANAR]
    one = sphere.select(labels)
    fit = fit_memory(one, labels, band=(0.3, 2.5), max_states=24)
    wave_number = one.omega**2 / one.gravity
    count = len(PLACES)

    def each(values: NDArray[Any]) -> NDArray[Any]:
        return np.asarray(np.kron(np.eye(count), values))

    def rows(values: Complex) -> Complex:
        lags = [np.exp(-1j * wave_number * x)[:, None, None] for x in PLACES.values()]
        return np.concatenate([values * lag for lag in lags], axis=2)

    bodies = {}
    for name, x in PLACES.items():
        moved, aside = one.bodies["sphere"], np.array([x, 0.0, 0.0])
        still = moved.hydrostatics
        assert still is not None
        assert moved.reference_point is not None
        bodies[name] = Body(
            name,
            moved.reference_point + aside,
            replace(still, center_of_buoyancy=still.center_of_buoyancy + aside),
        )
    every = tuple(f"{name}.{dof}" for name in PLACES for dof in PLANAR)
    memory = replace(
        fit,
        inputs=every,
        outputs=every,
        poles=np.tile(fit.poles, count),
        input_matrix=each(fit.input_matrix),
        output_matrix=each(fit.output_matrix),
        added_mass_inf=each(fit.added_mass_inf),
        report={**fit.report, "n_states": count * fit.n_states},
    )
    return replace(
        one,
        coordinates=every,
        added_mass=each(one.added_mass),
        radiation_damping=each(one.radiation_damping),
        added_mass_inf=each(one.added_mass_inf),
        added_mass_inf_std=each(one.added_mass_inf_std),
        froude_krylov=rows(one.froude_krylov),
        diffraction=rows(one.diffraction),
        bodies=bodies,
        memory={"planar": memory},
        kernel=None,
    )


def prepare(repository: Path, folder: Path) -> hydrodae.Case:
    """The case, its database written into `folder`."""
    database(read(repository / "cases" / "sphere" / "hydro.h5")).write(folder / "hydro.h5")
    (folder / "case.toml").write_text(CASE)
    return hydrodae.Case.read(folder / "case.toml")
