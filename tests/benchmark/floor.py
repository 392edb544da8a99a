"""The floor: the F3OF flap decay in a program that can do nothing else (floor.cpp).

Writes the numbers of that program from the case and its database, and runs it. `kernel_costs.py`
compares hydrodae with it.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
from tests.benchmark.counting import run

from hydrodae import hdb
from hydrodae.support.arrays import Array

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "cases" / "f3of" / "flap_decay.toml"
FIT = "flaps_planar"
END, STEP = 100.0, 0.1  # of the run, of the samples [s]
AGREE = 1e-7  # of the largest angle, between tight runs of both programs


def write_numbers(path: Path) -> None:
    """Write mass, loads and memory of both hinges, in the order in which floor.cpp reads them."""
    case = tomllib.loads(CASE.read_text())
    database = hdb.HydroDatabase.read(CASE.parent / case["hydro"]["database"])
    fit = database.memory[FIT]
    moving = np.zeros((len(fit.inputs), 2))  # velocities of the flaps by those of the hinges
    numbers: list[float] = []
    inertia = np.zeros(2)
    for i, joint in enumerate(case["joint"]):
        name = joint["body_b"]
        body = next(entry for entry in case["body"] if entry["name"] == name)
        centre = np.array(body["center_of_gravity"])
        lever = centre - np.array(joint["point"])
        for dof, value in (("surge", lever[2]), ("heave", -lever[0]), ("pitch", 1.0)):
            moving[fit.inputs.index(f"{name}.{dof}"), i] = value
        inertia[i] = body["inertia"][1] + body["mass"] * float(lever @ lever)
        statics = database.bodies[name].hydrostatics
        assert statics is not None
        lift = np.array([0.0, 0.0, database.rho * database.gravity * statics.displaced_volume])
        moment = np.cross(statics.center_of_buoyancy - centre, lift)
        weight = body["mass"] * database.gravity
        stiffness = statics.stiffness(centre, database.rho, database.gravity)
        planar = stiffness[np.ix_([0, 2, 4], [0, 2, 4])]
        angle = np.deg2rad(joint.get("initial", {}).get("angle_deg", 0.0))
        numbers += [lever[0], lever[2], angle, lift[0], lift[2] - weight, moment[1], *planar.flat]
    loaded = [fit.outputs.index(label) for label in fit.inputs]
    mass = moving.T @ fit.added_mass_inf[loaded] @ moving + np.diag(inertia)
    inlet, outlet = fit.input_matrix @ moving, (moving.T @ fit.output_matrix[loaded]).T
    order = np.argsort(fit.poles.imag == 0.0, kind="stable")  # complex ones first
    rows = np.column_stack([fit.poles[:, None], inlet, outlet])[order]
    memory = np.stack([rows.real, rows.imag], axis=-1)
    values = [END, STEP, *mass.T.flat, *numbers, *memory.flat]
    path.write_text("\n".join(repr(float(value)) for value in values))


def solve(numbers: Path, method: str, steps: int) -> Array:
    """Run the program; return the angles of both hinges at the samples (n, 2) [rad]."""
    samples = numbers.with_suffix(".samples")
    run("floor", str(numbers), method, str(steps), str(samples))
    return np.fromfile(samples).reshape(-1, 4)[:, :2]
