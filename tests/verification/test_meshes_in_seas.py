"""A mesh in small waves of every kind moves as the database says, wherever it stands.

The float is an upright cylinder, its database from eigenfunctions, its mesh a prism of the same
section. Waves are 1e-3 of its size, so what is left are terms of second order.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification import hulls

import hydrodae
from hydrodae import arrays, hdb

SIDES, RADIUS, DRAUGHT, CENTER, DEPTH = 48, 3.0, 4.0, -2.5, 25.0
ROUND = RADIUS * float(np.sqrt(0.5 * SIDES * np.sin(2.0 * np.pi / SIDES) / np.pi))  # same section
MESH = {"mesh": "float.obj", "hydrostatics": "mesh", "froude_krylov": "mesh"}
RANGE = [0.7, 2.2]


def _record() -> dict[str, Any]:
    time = np.arange(0.0, 120.0, 0.25)
    crests = [(0.003, 1.1, 0.3), (0.002, 1.6, 2.0), (0.0015, 0.9, -1.0)]
    elevation = sum(a * np.cos(w * time + phase) for a, w, phase in crests)
    return {"time": time.tolist(), "elevation": np.asarray(elevation).tolist(), "taper": 10.0}


SEAS: dict[str, tuple[str, dict[str, Any]]] = {
    "regular": ("regular", {"height": 0.01, "period": 5.0, "heading_deg": 30.0}),
    "long crests": ("jonswap", {"significant_height": 0.01, "peak_period": 5.0}),
    "short crests": (
        "jonswap",
        {"significant_height": 0.01, "peak_period": 5.0, "spreading": 4.0, "heading_deg": 70.0},
    ),
    "measured": ("measured", {**_record(), "point": [-20.0, 5.0], "heading_deg": 45.0}),
}


def database(places: dict[str, tuple[float, float]]) -> hdb.HydroDatabase:
    headings = np.radians(np.arange(0.0, 360.0, 30.0))
    water = hdb.Water(np.linspace(0.4, 2.6, 23), DEPTH, headings, rho=1025.0)
    return hdb.cylinders(places, hdb.Cylinder(ROUND, DRAUGHT, CENTER), water, modes=50)[0]


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("meshes")
    profile = np.array([0.0, RADIUS, RADIUS, 0.0]), np.array([-DRAUGHT, -DRAUGHT, 2.0, 2.0])
    hulls.write_obj(folder / "float.obj", hulls.revolved(*profile, SIDES))
    database({"float": (0.0, 0.0)}).write(folder / "hydro.h5")
    return folder


def _scene(device: Path, sea: str, more: dict[str, Any]) -> hydrodae.Scene:
    kind, keys = SEAS[sea]
    scene = hydrodae.Scene("float", directory=device)
    scene.hydro(database="hydro.h5", radiation="constant", frequency=1.25)
    scene.body(
        "float", hydro="float", mass="equilibrium", center_of_gravity=[0.0, 0.0, CENTER],
        radii_of_gyration=[1.6, 1.6, 2.0], **more,
    )  # fmt: skip
    scene.force.mooring_matrix(
        "mooring", body="float", stiffness=[2e4, 2e4, 0.0, 0.0, 0.0, 1e5],
        damping=[1e4, 1e4, 0.0, 0.0, 0.0, 1e5],
    )  # fmt: skip
    if kind not in ("regular", "measured"):
        keys = {"components": 30, "frequency_range": RANGE, "lost_variance": 0.5, **keys}
    getattr(scene.wave, kind)("waves", **keys)
    scene.sea(ramp=10.0)
    scene.solver(end_time=60.0, rtol=1e-7)
    return scene


@pytest.mark.parametrize("sea", list(SEAS))
def test_small_waves_move_a_mesh_as_the_database_says(device: Path, sea: str) -> None:
    linear, mesh = (hydrodae.run(_scene(device, sea, more)) for more in ({}, MESH))
    for channel in ("position", "rotation"):
        one, other = (r[f"bodies/float/{channel}"].values for r in (linear, mesh))
        motion = np.abs(one - one.mean(axis=0)).max()
        assert motion > 1e-4
        np.testing.assert_allclose(other, one, atol=5e-3 * motion)


def test_a_mesh_feels_the_waves_where_it_stands(device: Path, tmp_path: Path) -> None:
    """Units of an array, each against its own linear twin."""
    places = {"a": (0.0, 0.0), "b": (31.0, -17.0)}
    folder, twins = tmp_path, []
    shutil.copy(device / "float.obj", folder)
    database(arrays.places_of({"float": (0.0, 0.0)}, places)).write(folder / "hydro.h5")
    for more in ({}, MESH):
        scene = _scene(device, "short crests", more)
        twins.append(hydrodae.run(arrays.place(scene, places, folder)))
    for unit in places:
        one, other = (r[f"bodies/{unit}_float/position"].values for r in twins)
        motion = np.abs(one - one.mean(axis=0)).max()
        np.testing.assert_allclose(other, one, atol=5e-3 * motion)
