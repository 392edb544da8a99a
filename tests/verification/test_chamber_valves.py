"""Valves of chambers: located events with hysteresis, pumps, a valve that a controller writes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.verification import chambers
from tests.verification.chambers import DENSITY, TIGHT

import hydrodae

HOLE: dict[str, Any] = {"chamber": "air", "coefficient": 0.62, "area": 0.02}
METHODS = ["radau", "explicit_rk", "ida"]


def tank(pressure: float) -> hydrodae.Scene:
    """Return a scene with a tank of 10 m3 at this pressure."""
    scene = hydrodae.Scene("a tank")
    scene.environment(gravity=0.0, air_density=DENSITY)
    chambers.add_column(scene, "column", velocity=0.1)
    scene.chamber("air", volume=10.0, pressure=pressure)
    return scene


def run(scene: hydrodae.Scene, end: float, **solver: Any) -> Any:
    scene.solver(end_time=end, **{**TIGHT, **solver})
    scene.output(step=end / 500.0)
    return hydrodae.run(scene)


@pytest.mark.parametrize("method", METHODS)
def test_a_relief_valve_shuts_below_where_it_opens(method: str) -> None:
    scene = tank(2e4)
    scene.outlet.valve("relief", opens_at=1.5e4, shuts_at=5e3, **HOLE)
    found = run(scene, 4.0, method=method)
    pressure = found["chambers/air/pressure"].values
    flow = found["outlets/relief/mass_flow"].values
    np.testing.assert_allclose(pressure[-1], 5e3, rtol=1e-7)
    assert np.all(flow[pressure > 5001.0] > 0.0)
    assert np.all(flow[pressure < 5000.001] == 0.0)
    free = tank(2e4)
    free.outlet.orifice("relief", **HOLE)
    other = run(free, 4.0, method=method)["chambers/air/pressure"].values
    np.testing.assert_allclose(pressure[other > 5e3], other[other > 5e3], rtol=1e-6)


def test_a_relief_valve_holds_below_where_it_opens() -> None:
    scene = tank(1e4)
    scene.outlet.valve("relief", opens_at=1.5e4, shuts_at=5e3, **HOLE)
    np.testing.assert_allclose(run(scene, 1.0)["chambers/air/pressure"], 1e4, rtol=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_check_valves_make_a_pump(method: str) -> None:
    """In from the atmosphere, out to a tank, which fills up; its air came in by the first valve."""
    scene = chambers.plant()
    scene.chamber("tank", volume=100.0)
    hole: dict[str, Any] = {**HOLE, "area": 0.3}
    scene.outlet.valve("inlet", direction="in", **hole)
    scene.outlet.valve("outlet", to="tank", **hole)
    chambers.drive(scene, amplitude=1.0, period=6.0, ramp=3.0)
    found = run(scene, 30.0, method=method, rtol=1e-9)
    pressure = found["chambers/tank/pressure"].values
    assert np.diff(pressure).min() > -1e-4
    assert pressure[-1] > 5e3
    assert found["outlets/inlet/mass_flow"].values.max() <= 0.0
    assert found["outlets/outlet/mass_flow"].values.min() >= 0.0
    assert found["outlets/inlet/power"].values.min() >= 0.0


def test_a_controller_opens_an_orifice() -> None:
    scene = tank(2e4)
    scene.outlet.orifice("gate", opening=0.0, **HOLE)
    keys: Any = {
        "inputs": ["chambers/air/pressure"],
        "outputs": ["outlets/gate/opening"],
        "period": 0.1,
    }
    scene.controller.python("gate", **keys)
    scene.solver(end_time=2.0, **TIGHT)
    scene.output(step=0.1)
    found = hydrodae.run(scene, controllers={"gate": lambda t, inputs: [1.0 if t >= 1.0 else 0.0]})
    pressure = found["chambers/air/pressure"].values
    np.testing.assert_allclose(pressure[:11], 2e4, rtol=1e-12)
    free = tank(2e4)
    free.outlet.orifice("gate", **HOLE)
    free.solver(end_time=1.0, **TIGHT)
    free.output(step=0.1)
    other = hydrodae.run(free)["chambers/air/pressure"].values
    np.testing.assert_allclose(pressure[10:], other, rtol=1e-6)


def test_a_valve_without_hysteresis_is_refused() -> None:
    scene = tank(0.0)
    scene.outlet.valve("relief", opens_at=1e4, shuts_at=1e4, **HOLE)
    with pytest.raises(hydrodae.CaseError, match="open and shut without end"):
        run(scene, 1.0)
