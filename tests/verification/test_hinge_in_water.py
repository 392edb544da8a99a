"""Two floats on a hinge in waves: two bodies on a joint, and one body with the hinge as mode."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.hdb import Body, HydroDatabase, Hydrostatics
from hydrodae.linear import LinearModel
from hydrodae.starters import create

#: Floats of the starter `attenuator`: mass [kg], moment of inertia [kg m2], centres [m].
MASS, INERTIA, HALF, DEPTH = 246e3, 8.5e6, 11.0, 1.0
#: Displacements of both floats (surge, heave, pitch each) by surge, heave, pitch of the middle at
#: their depth and by the hinge: both turn up by 1/2 rad for 1 m, the hinge sinks by 5.5 m.
FLOATS = np.array(
    [
        [1.0, 0.0, 0.0, -0.5 * DEPTH],
        [0.0, 1.0, HALF, 0.0],
        [0.0, 0.0, 1.0, 0.5],
        [1.0, 0.0, 0.0, 0.5 * DEPTH],
        [0.0, 1.0, -HALF, 0.0],
        [0.0, 0.0, 1.0, -0.5],
    ]
)
DAMPING, STIFFNESS = 10e6, 4e6


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Databases of both floats, `two.h5`, and of the coordinates of one body, `one.h5`."""
    home = tmp_path_factory.mktemp("hinge")
    create("attenuator", home / "starter")
    two = HydroDatabase.read(home / "starter" / "hydro.h5")
    motions = ("surge", "heave", "pitch")
    two = two.select([f"{body}.{motion}" for body in ("bow", "middle") for motion in motions])
    two.write(home / "two.h5")
    statics = two.bodies["middle"].hydrostatics
    assert statics is not None
    area, volume = statics.waterplane_area, statics.displaced_volume
    second = statics.waterplane_moments[2]
    weight = two.rho * two.gravity
    rows = weight * np.diag(
        [0.0, area, second + volume * (statics.center_of_buoyancy[2] + DEPTH)] * 2
    )
    stiffness = np.zeros((7, 7))
    at = np.ix_([0, 2, 4, 6], [0, 2, 4, 6])
    stiffness[at] = FLOATS.T @ rows @ FLOATS
    middle = np.array([-HALF, 0.0, -DEPTH])
    moments = np.array([0.0, 0.0, 2.0 * (second + area * HALF**2), 0.0, 0.0])
    centre = middle + np.array([0.0, 0.0, statics.center_of_buoyancy[2] + DEPTH])
    whole = Hydrostatics(2.0 * volume, centre, 2.0 * area, moments)
    HydroDatabase(
        tuple(f"barge.{motion}" for motion in (*motions, "hinge")),
        two.omega,
        FLOATS.T @ two.added_mass @ FLOATS,
        FLOATS.T @ two.radiation_damping @ FLOATS,
        FLOATS.T @ two.added_mass_inf @ FLOATS,
        np.zeros((4, 4)),
        two.heading,
        two.froude_krylov @ FLOATS,
        two.diffraction @ FLOATS,
        {"barge": Body("barge", middle, whole, mode_stiffness=stiffness)},
        two.rho,
        two.gravity,
    ).write(home / "one.h5")
    return home


def joined(folder: Path, omega: float) -> hydrodae.Scene:
    """Return both floats on a revolute joint with a spring and a damper."""
    scene = hydrodae.Scene("joint", directory=folder)
    scene.hydro(database="two.h5", radiation="constant", frequency=omega)
    for name, x in (("bow", -2.0 * HALF), ("middle", 0.0)):
        scene.body(
            name, hydro=name, motion="planar", mass=MASS, inertia=[INERTIA] * 3,
            center_of_gravity=[x, 0.0, -DEPTH],
        )  # fmt: skip
    pin: Any = {"body_a": "bow", "body_b": "middle", "point": [-HALF, 0.0, 0.0]}
    scene.joint.revolute("hinge", **pin, axis=[0.0, 1.0, 0.0])
    scene.force.pto_linear("pto", joint="hinge", damping=DAMPING, stiffness=STIFFNESS)
    scene.solver(end_time=40.0, rtol=1e-8, accuracy="none")
    return scene


def bent(folder: Path, omega: float) -> hydrodae.Scene:
    """Return one body; its mode opens the hinge by 1 rad per metre."""
    scene = hydrodae.Scene("mode", directory=folder)
    scene.hydro(database="one.h5", radiation="constant", frequency=omega)
    own = 2.0 * (INERTIA + MASS * HALF**2)
    scene.body(
        "barge", hydro="barge", motion="planar", mass=2.0 * MASS, inertia=[own] * 3,
        center_of_gravity=[-HALF, 0.0, -DEPTH],
    )  # fmt: skip
    mass = 0.5 * INERTIA + 0.5 * MASS * DEPTH**2
    scene.mode("hinge", body="barge", mass=mass, stiffness=STIFFNESS, damping=DAMPING)
    scene.solver(end_time=40.0, rtol=1e-8, accuracy="none")
    return scene


@pytest.mark.parametrize("frequency", [0.7, 1.0, 1.4])
def test_motions_in_regular_waves(folder: Path, frequency: float) -> None:
    """Heave and pitch of the whole and the angle of the hinge agree within 0.1 %.

    At frequencies of the tables [rad/s]: between them the excitation is joined by size and phase,
    which does not commute with a sum over coordinates.
    """
    omega = np.array([frequency])
    two = LinearModel(joined(folder, omega[0])).response(omega)
    one = LinearModel(bent(folder, omega[0])).response(omega)
    bow, middle = (two[f"bodies/{name}/heave"][0] for name in ("bow", "middle"))
    turns = [two[f"bodies/{name}/pitch"][0] for name in ("bow", "middle")]
    pairs = {
        "bodies/barge/heave": 0.5 * (bow + middle),
        "bodies/barge/pitch": 0.5 * (turns[0] + turns[1]),
        "modes/barge.hinge/amplitude": turns[0] - turns[1],
    }
    for name, expected in pairs.items():
        assert abs(one[name][0] - expected) < 1e-3 * abs(expected), name


def test_motions_in_time(folder: Path) -> None:
    """Waves of 1 cm by runs: the difference stays below 0.1 % of the largest motion."""
    runs = []
    for make in (joined, bent):
        scene = make(folder, 1.0)
        scene.wave.regular("sea", height=0.02, period=2.0 * np.pi)
        scene.sea(ramp=12.0)
        scene.output(step=0.1)
        runs.append(hydrodae.run(scene))
    two, one = runs
    places = [two[f"bodies/{name}/position"].values[:, 2] for name in ("bow", "middle")]
    pairs = {
        "heave": (one["bodies/barge/position"].values[:, 2], 0.5 * (places[0] + places[1])),
        "hinge": (
            one["modes/barge.hinge/amplitude"].values.ravel(),
            -two["joints/hinge/angle"].values.ravel(),
        ),
    }
    for name, (found, expected) in pairs.items():
        assert np.abs(found - expected).max() < 1e-3 * np.ptp(expected), name
