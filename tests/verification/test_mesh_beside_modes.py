"""A mesh with hydrostatics and Froude-Krylov loads of the rigid motion, beside linear modes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification import hulls
from tests.verification.test_meshes_in_seas import (
    CENTER,
    DRAUGHT,
    MESH,
    RADIUS,
    SIDES,
    database,
)

import hydrodae

AMPLITUDE = "modes/float.belly/amplitude"


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Float whose bottom moves: a part of heave in the water, without a stiffness of the water."""
    folder = tmp_path_factory.mktemp("belly")
    profile = np.array([0.0, RADIUS, RADIUS, 0.0]), np.array([-DRAUGHT, -DRAUGHT, 2.0, 2.0])
    hulls.write_obj(folder / "float.obj", hulls.revolved(*profile, SIDES))
    rigid = database({"float": (0.0, 0.0)})
    heave = rigid.coordinates.index("float.heave")
    add = np.eye(len(rigid.coordinates) + 1)[:-1]
    add[heave, -1] = 0.4  # the mode is loaded as 0.4 of the heave
    tables = {
        k: add.T @ getattr(rigid, k) @ add
        for k in ("added_mass", "radiation_damping", "added_mass_inf")
    }
    tables["added_mass_inf_std"] = np.zeros_like(tables["added_mass_inf"])
    loads = {k: getattr(rigid, k) @ add for k in ("froude_krylov", "diffraction")}
    body = replace(rigid.bodies["float"], mode_stiffness=np.zeros((7, 7)))
    labels = (*rigid.coordinates, "float.belly")
    both = replace(rigid, coordinates=labels, **tables, **loads, bodies={"float": body})
    both.write(folder / "hydro.h5")
    moved = np.zeros((7, 7))
    moved[2, 6] = moved[6, 2] = 1e4  # 1 m2 of the 28 m2 of the water line
    replace(both, bodies={"float": replace(body, mode_stiffness=moved)}).write(folder / "line.h5")
    return folder


def scene(device: Path, height: float, more: dict[str, Any], name: str = "hydro.h5") -> Any:
    out = hydrodae.Scene("float with a belly", directory=device)
    out.hydro(database=name, radiation="constant", frequency=1.25)
    out.body(
        "float", hydro="float", mass="equilibrium", center_of_gravity=[0.0, 0.0, CENTER],
        radii_of_gyration=[1.6, 1.6, 2.0], **more,
    )  # fmt: skip
    out.mode("belly", body="float", mass=2e4, stiffness=3e5, damping=2e4)
    out.force.mooring_matrix(
        "mooring", body="float", stiffness=[2e4, 2e4, 0.0, 0.0, 0.0, 1e5],
        damping=[1e4, 1e4, 0.0, 0.0, 0.0, 1e5],
    )  # fmt: skip
    out.wave.regular("waves", height=height, period=5.0)
    out.sea(ramp=10.0)
    out.solver(end_time=40.0, rtol=1e-7)
    return out


def test_small_waves_move_body_and_mode_as_the_database_says(device: Path) -> None:
    linear, mesh = (hydrodae.run(scene(device, 0.01, more)) for more in ({}, MESH))
    for channel in (AMPLITUDE, "bodies/float/position", "bodies/float/rotation"):
        one, other = linear[channel].values, mesh[channel].values
        motion = np.abs(one - one.mean(axis=0)).max()
        assert motion > 1e-5
        np.testing.assert_allclose(other, one, atol=5e-3 * motion)


def test_a_mode_that_moves_the_water_line_is_refused(device: Path) -> None:
    hydrodae.check(scene(device, 0.01, {}, "line.h5"))
    with pytest.raises(hydrodae.CaseError, match="moves the water line") as caught:
        hydrodae.check(scene(device, 0.01, MESH, "line.h5"))
    assert caught.value.key == "body.float.hydrostatics"
