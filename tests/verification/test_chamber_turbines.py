"""Turbines with rotors: another integration, balances of power, measured points, bad data."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.verification import chambers
from tests.verification.chambers import TIGHT, integral

import hydrodae

#: A smooth hill: 0.75 at Psi = 0.3.
AT = np.concatenate([np.linspace(0.0, 2.0, 4001), np.linspace(2.0, 40.0, 2001)[1:]])
HILL: dict[str, Any] = {
    "efficiency_at": AT,
    "efficiency": 0.75 * 2.0 * (AT / 0.3) / (1.0 + (AT / 0.3) ** 2),
}
ROTOR: dict[str, Any] = {"speed": 150.0, "inertia": 5.0, "torque": 2e-3, **HILL}
METHODS = ["ida", "radau", "explicit_rk"]


@pytest.mark.parametrize("method", METHODS)
def test_a_biradial_turbine_that_turns_freely(reference: Path, method: str) -> None:
    file = reference / "owc" / "driven_chamber" / "pressures.csv"
    table = np.genfromtxt(file, delimiter=",", names=True)
    scene = chambers.plant()
    scene.outlet.biradial("turbine", chamber="air", diameter=0.5, **ROTOR)
    scene.output(step=0.5)
    run = chambers.run_driven(scene, chambers.column(0.3), 120.0, method=method)
    for channel, column in (
        ("chambers/air/pressure", "p_biradial_03m_Pa"),
        ("outlets/turbine/rotor_speed", "speed_biradial_03m_rad_s"),
    ):
        error = np.abs(run[channel].values - table[column]).max()
        assert error < 1e-6 * np.ptp(table[column]), channel


def test_power_of_the_rotor_is_shaft_windage_and_stored() -> None:
    scene = chambers.plant()
    keys: Any = {**ROTOR, "windage": 1e-3, "generator_efficiency": 0.9}
    scene.outlet.wells("turbine", chamber="air", diameter=0.75, flow_slope=0.775, **keys)
    scene.output(step=0.01)
    run = chambers.run_driven(scene, chambers.column(0.3), 60.0)
    work = {
        name: integral(run, run[f"outlets/turbine/{name}"].values)
        for name in ("power", "power_pneumatic", "power_turbine", "power_shaft", "power_electric")
    }
    speed = run["outlets/turbine/rotor_speed"].values
    windage = integral(run, 1e-3 * speed**3)
    energy = run["outlets/turbine/rotor_energy"].values
    change = energy[-1] - energy[0]
    assert work["power_turbine"] - work["power_shaft"] - windage == pytest.approx(
        change, abs=1e-6 * work["power_turbine"]
    )
    assert 0.0 < work["power_turbine"] < work["power_pneumatic"] < work["power"]
    assert work["power_electric"] == pytest.approx(0.9 * work["power_shaft"])
    assert np.ptp(speed) > 10.0


def test_measured_points_of_a_wells_turbine_are_that_turbine() -> None:
    pressures = []
    for measured in (False, True):
        scene = chambers.plant()
        keys: dict[str, Any] = {"chamber": "air", "diameter": 0.75, "speed": 100.0}
        if measured:
            scene.outlet.turbine("out", flow_at=[0.0, 1.0, 3.0], flow=[0.0, 0.775, 2.325], **keys)
        else:
            scene.outlet.wells("out", flow_slope=0.775, **keys)
        run = chambers.run_driven(scene, chambers.column(0.3), 20.0)
        pressures.append(run["chambers/air/pressure"].values)
    one, other = pressures
    np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-8 * np.abs(one).max())


def test_an_impulse_turbine_of_power_one_is_a_wells_turbine() -> None:
    pressures = []
    for kind, keys in (
        ("impulse", {"coefficient": 0.775, "exponent": 1.0}),
        ("wells", {"flow_slope": 0.775}),
    ):
        scene = chambers.plant()
        common: Any = {"chamber": "air", "diameter": 0.75, "speed": 100.0, **keys}
        getattr(scene.outlet, kind)("out", **common)
        run = chambers.run_driven(scene, chambers.column(0.3), 20.0)
        pressures.append(run["chambers/air/pressure"].values)
    one, other = pressures
    np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-8 * np.abs(one).max())


def test_a_controller_holds_the_speed() -> None:
    scene = chambers.plant()
    keys: Any = {**ROTOR, "torque": 0.0}
    scene.outlet.biradial("turbine", chamber="air", diameter=0.5, **keys)
    channels: Any = {
        "inputs": ["outlets/turbine/rotor_speed"],
        "outputs": ["outlets/turbine/torque"],
    }
    scene.controller.pid("speed", target=150.0, gain_p=-200.0, period=0.02, **channels)
    scene.output(step=0.1)
    run = chambers.run_driven(scene, chambers.column(0.3), 60.0, rtol=1e-7)
    assert np.abs(run["outlets/turbine/rotor_speed"].values - 150.0).max() < 2.0
    assert run["outlets/turbine/power_shaft"].values.max() > 1e3


def test_a_run_that_leaves_the_data_ends() -> None:
    scene = chambers.plant()
    short: Any = {**ROTOR, "efficiency_at": [0.0, 0.1, 0.2], "efficiency": [0.0, 0.5, 0.6]}
    scene.outlet.biradial("turbine", chamber="air", diameter=0.5, **short)
    with pytest.raises(hydrodae.SolverError, match="outlet 'turbine' is beyond its data"):
        chambers.run_driven(scene, chambers.column(1.0), 60.0)


def attempt(kind: str, **keys: Any) -> None:
    """Build and run a scene with such a turbine."""
    scene = chambers.plant()
    scene.solver(end_time=1.0, **TIGHT)
    getattr(scene.outlet, kind)("turbine", chamber="air", diameter=0.5, **keys)
    hydrodae.run(scene)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"efficiency": [0.0, 1.2, 0.5], "efficiency_at": [0.0, 0.1, 0.2]}, "efficiency"),
        ({"efficiency": [0.0, 0.5], "efficiency_at": [0.0, 0.1, 0.2]}, "not as many numbers"),
        ({"efficiency": [0.1, 0.5], "efficiency_at": [0.1, 0.2]}, "must begin with 0"),
        ({"inertia": None}, "needs 'inertia'"),
        ({"speed": 0.0}, "speed"),
        ({"efficiency": None, "efficiency_at": None}, "which drive the rotor"),
    ],
)
def test_data_that_are_refused(keys: dict[str, Any], message: str) -> None:
    chosen = {k: v for k, v in {**ROTOR, **keys}.items() if v is not None}
    with pytest.raises(hydrodae.CaseError, match=message):
        attempt("biradial", **chosen)


@pytest.mark.parametrize(
    ("at", "flow", "message"),
    [
        ([0.0, 0.1, 0.2], [0.0, 0.2, 0.1], "must ascend with the pressure"),
        ([0.0, 0.1], [0.1, 0.2], "begin with 0"),
        ([0.0, 0.1], [0.0, -0.2], "flow"),
    ],
)
def test_flows_that_are_refused(at: list[float], flow: list[float], message: str) -> None:
    with pytest.raises(hydrodae.CaseError, match=message):
        attempt("turbine", speed=100.0, flow_at=at, flow=flow)


def test_a_measured_speed_of_rotation_is_a_table_over_time() -> None:
    times, period = np.arange(0.0, 6.0, 0.1), 0.1
    speeds = 100.0 + 40.0 * np.sin(0.9 * times)
    scene = chambers.plant()
    scene.outlet.wells("turbine", chamber="air", diameter=0.75, speed=speeds[0], flow_slope=0.775)
    scene.controller.table(
        "record",
        inputs="time",
        outputs="outlets/turbine/speed",
        period=period,
        at=times.tolist(),
        value=speeds.tolist(),
    )
    scene.output(step=period)
    motion = chambers.column(0.3)
    run = chambers.run_driven(scene, motion, 5.0)

    def pressure(t: float, mass: float) -> float:
        density = mass / (chambers.VOLUME - chambers.AREA * motion(t)[0])
        return float(chambers.OUTSIDE * ((density / chambers.DENSITY) ** chambers.EXPONENT - 1.0))

    mass, found = chambers.DENSITY * chambers.VOLUME, [0.0]
    for t, speed in zip(times[:50], speeds[:50], strict=True):
        slope = -0.775 * 0.75 / speed
        held = solve_ivp(
            lambda s, m, k=slope: [k * pressure(s, m[0])],
            (t, t + period),
            [mass],
            rtol=1e-11,
            atol=1e-11,
        )
        mass = held.y[0, -1]
        found.append(pressure(t + period, mass))
    error = np.abs(run["chambers/air/pressure"].values - found).max()
    assert error < 1e-6 * np.ptp(found)
