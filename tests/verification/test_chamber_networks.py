"""Several pistons on one chamber, modes, ducts and tanks."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.verification import chambers
from tests.verification.chambers import AREA, DENSITY, TIGHT, VOLUME, integral

import hydrodae


def pressure(scene: hydrodae.Scene) -> np.ndarray:
    scene.outlet.orifice("out", chamber="air", coefficient=0.62, area=0.12)
    scene.solver(end_time=10.0, **TIGHT)
    return np.asarray(hydrodae.run(scene)["chambers/air/pressure"])


def test_one_piston_a_mode_and_two_halves_are_one() -> None:
    mass, rate = 2e4, 2.0
    whole = pressure(chambers.plant(mass, rate))
    halves = hydrodae.Scene("two halves")
    halves.environment(gravity=0.0, air_density=DENSITY)
    halves.chamber("air", volume=VOLUME)
    for name in ("left", "right"):
        chambers.add_column(halves, name, mass / 2.0, rate)
        halves.piston(name, chamber="air", joint=name, area=AREA / 2.0)
    mode = hydrodae.Scene("a mode")
    mode.environment(gravity=0.0, air_density=DENSITY)
    mode.body("moonpool", motion="fixed", mass=1.0, center_of_gravity=[0.0, 0.0, 0.0])
    mode.mode("piston", body="moonpool", mass=mass, initial={"rate": rate})
    mode.chamber("air", volume=VOLUME)
    mode.piston("water", chamber="air", mode="piston", area=AREA)
    size = np.abs(whole).max()
    assert size > 1e3
    np.testing.assert_allclose(pressure(halves), whole, rtol=0.0, atol=1e-8 * size)
    np.testing.assert_allclose(pressure(mode), whole, rtol=0.0, atol=1e-8 * size)


def test_reaction_on_the_partner() -> None:
    """Roof on a floating body, column on a slide of it: the momentum of both stays."""
    scene = hydrodae.Scene("a free pair")
    scene.environment(gravity=0.0)
    scene.body("hull", motion="heave", mass=4e4, center_of_gravity=[0.0, 0.0, 0.0])
    chambers.add_column(scene, "water", 1e4, 2.0, carrier="hull")
    scene.chamber("air", volume=VOLUME)
    scene.piston("surface", chamber="air", joint="water", area=AREA)
    scene.solver(end_time=5.0, **TIGHT)
    run = hydrodae.run(scene)
    momentum = 4e4 * run["bodies/hull/velocity"][:, 2] + 1e4 * run["bodies/water/velocity"][:, 2]
    np.testing.assert_allclose(momentum, 2e4, rtol=1e-10)
    assert np.ptp(run["bodies/hull/velocity"][:, 2].values) > 0.5
    total = run["energy/total"].values
    np.testing.assert_allclose(total, total[0], rtol=1e-7)


@pytest.mark.parametrize("method", ["radau", "explicit_rk", "ida"])
def test_three_columns_pump_between_tanks(method: Any) -> None:
    """Ducts between all of them and nothing outside: the air is kept, work is lost or stored."""
    scene = hydrodae.Scene("pumps")
    scene.environment(gravity=0.0)
    names = ["one", "two", "three"]
    for k, name in enumerate(names):
        chambers.add_column(scene, name)
        scene.chamber(name, volume=VOLUME)
        scene.piston(name, chamber=name, joint=name, area=AREA)
        chambers.drive(scene, name, amplitude=1.0, period=6.0 + k, ramp=6.0)
    scene.chamber("low", volume=200.0)
    scene.chamber("high", volume=300.0, pressure=5e3)
    for name in names:
        hole: Any = {"chamber": name, "coefficient": 0.62, "laminar_pressure": 10.0}
        scene.outlet.orifice(f"{name}-low", to="low", area=0.1, **hole)
        scene.outlet.orifice(f"{name}-high", to="high", area=0.05, **hole)
    scene.solver(end_time=30.0, **{**TIGHT, "method": method, "rtol": 1e-9})
    scene.output(step=0.005)
    run = hydrodae.run(scene)
    rooms = [*names, "low", "high"]
    mass = np.sum([run[f"chambers/{name}/mass"].values for name in rooms], axis=0)
    np.testing.assert_allclose(mass, mass[0], rtol=1e-9)
    stored = np.sum([run[f"chambers/{name}/energy"].values for name in rooms], axis=0)
    ducts = [f"{name}-{to}" for name in names for to in ("low", "high")]
    power = np.sum([run[f"outlets/{duct}/power"].values for duct in ducts], axis=0)
    assert power.min() >= 0.0
    lost = integral(run, power)
    put_in = integral(run, run["chambers/one/power_absorbed"].values)
    assert put_in == pytest.approx(lost + stored[-1] - stored[0], rel=1e-6)
    assert lost > 1e5
