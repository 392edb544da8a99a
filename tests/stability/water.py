"""Hard scenes in water: a float in heave whose hydrodynamic data are sound, or not.

The float has one pair of memory states: z' = p z + b v, radiation force -Re(c z). With c b > 0 and
Im p = 0 the memory is passive; with c b < 0 it has a negative B(w), and feeds the motion.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
from tests.stability import truths
from tests.stability.scene import Scene

from hydrodae.results import Results
from hydrodae.support.arrays import Array

MASS, ADDED_MASS, STIFFNESS, POLE = 1000.0, 500.0, 6000.0, -1.0
LABEL = "float.heave"


def write(path: Path, residue: float, added_mass: float) -> None:
    """Write a database with one real pole, of kernel `residue` exp(POLE t) [N/m]."""
    with h5py.File(path, "w") as file:
        file.attrs.update(format="hydrodae-hydro", format_version=1, rho=1000.0, gravity=9.81)
        file.attrs["water_depth"] = np.inf
        labels = np.array([LABEL], dtype="S32")
        file["coordinates"] = labels
        file["added_mass_inf"] = [[added_mass]]
        body = file.create_group("bodies/float")
        body.attrs.update(index=0, reference_point=np.zeros(3), displaced_volume=MASS / 1000.0)
        body.attrs["center_of_buoyancy"] = np.zeros(3)
        stiffness = np.zeros((6, 6))
        stiffness[2, 2] = STIFFNESS
        body["hydrostatic_stiffness"] = stiffness
        fit = file.create_group("memory/heave")
        fit.attrs.update(n_states=1, passive=residue >= 0.0)
        fit["inputs"], fit["outputs"] = labels, labels
        fit["poles"] = np.array([POLE + 0j])
        fit["input_matrix"] = np.array([[1.0 + 0j]])
        fit["output_matrix"] = np.array([[residue + 0j]])
        fit["added_mass_inf"] = [[added_mass]]


def heave(results: Results) -> Array:
    """Return the heave of the float, (nt, 1), m."""
    return np.asarray(results["bodies/float/position"].values)[:, [2]]


def _grown(results: Results) -> Array:
    """By how much the float rises above where it was let go, m."""
    return np.maximum(np.abs(heave(results)[:, 0]) - 1.0, 0.0)


def float_tables() -> dict[str, Any]:
    """Return the case of the float, let go 1 m above its rest."""
    float_ = {
        "name": "float", "hydro": "float", "motion": "heave", "mass": MASS,
        "center_of_gravity": [0.0, 0.0, 0.0], "initial": {"displacement": [0.0, 0.0, 1.0]},
    }  # fmt: skip
    return {
        "body": [float_],
        "hydro": {"fit": "heave"},
        "solver": {"end_time": 30.0},
        "output": {"step": 0.1},
    }


def _scene(name: str, title: str, residue: float, added_mass: float, **how: Any) -> Scene:
    return Scene(
        name, title, float_tables(), 1.0, 0.5,
        database=lambda path: write(path, residue, added_mass), **how,
    )  # fmt: skip


def scenes() -> list[Scene]:
    """Return the scenes in water."""
    inertia = MASS + ADDED_MASS
    system = np.array([[0, 1, 0], [-STIFFNESS / inertia, 0, -1 / inertia], [0, 800.0, POLE]])
    return [
        _scene("memory", "float with a passive memory (for comparison)", 800.0, ADDED_MASS,
               source="closed form by eigenvectors", measured=heave,
               truth=truths.linear(system, [1.0, 0.0, 0.0], 0)),
        _scene("active_memory", "memory that is not passive: negative B(w)", -800.0, ADDED_MASS,
               source="still water gives no energy: |heave| <= 1 m", measured=_grown,
               impossible="the waves would feed the motion"),
        _scene("negative_mass", "effective mass that is not positive definite", 800.0,
               -2.0 * MASS, source="no motion", measured=heave,
               impossible="mass and added mass are negative"),
    ]  # fmt: skip
