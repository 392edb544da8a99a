"""Power take-offs and friction along joints against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.attack.parts import Table, Z, body, case, driven, joint
from tests.errors import wrong
from tests.verification.blocks import METHODS, block, run_tables

GENERAL = dict(type="pto_general", name="pto", joint="slide", damping=300.0, exponent=2.0)
GENERAL |= dict(constant=20.0, reversal_rate=1e-3, stiffness=50.0, load_limit=150.0)
GENERAL |= dict(power_limit=80.0, efficiency=0.8, motor_efficiency=0.9)


@pytest.mark.parametrize("method", METHODS)
def test_power_take_off_within_its_limits(method: str) -> None:
    moves = [driven("drive", {"amplitude": 0.5, "period": 4.0}, joint="slide")]
    speed = 0.5 * math.pi / 2.0
    run = block(GENERAL, 8.0, method=method, speed=speed, rtol=1e-6, constraint=moves)
    s = run["joints/slide/displacement"].values
    v = run["joints/slide/displacement_rate"].values
    raw = -50.0 * s - 300.0 * abs(v) * v - 20.0 * v / np.sqrt(v**2 + 1e-6)
    limit = np.minimum(150.0, 80.0 / np.maximum(abs(v), 1e-9))
    force = run["forces/pto/force"].values
    assert force == pytest.approx(np.clip(raw, -limit, limit), abs=1e-6)
    power = run["forces/pto/power_absorbed"].values
    assert power == pytest.approx(-force * v, abs=1e-6)
    assert power.max() == pytest.approx(80.0, rel=1e-6)
    assert power.min() < -0.1  # the spring gives some back
    electric = run["forces/pto/electric_power"].values
    assert electric == pytest.approx(np.where(power > 0, 0.8 * power, power / 0.9), abs=1e-6)


def test_rotary_power_take_off_damps_each_axis() -> None:
    """Slow spins of a ball with I = 2 in dampers c: w = w0 exp(-c t / I), each by itself."""
    ball = body("ball", "rigid", 1.0, inertia=[2.0] * 3, angular_velocity=[0.0, 0.3, 0.0])
    pto = dict(type="pto_rotary", name="pto", body_a="ground", body_b="ball")
    pin = joint("ball", "spherical", "ground", "ball")
    forces = [pto | {"damping": [0.5, 1.0, 0.0]}]
    tables = case([ball], 4.0, gravity=0.0, joints=[pin], forces=forces, samples=400)
    run = run_tables(tables, method="radau", rtol=1e-9)
    w = run["bodies/ball/angular_velocity"].values[:, 1]
    assert w == pytest.approx(0.3 * np.exp(-run.time / 2.0), abs=1e-8)
    power = run["forces/pto/power_absorbed"].values
    assert power == pytest.approx(1.0 * w**2, abs=1e-9)
    assert "power_absorbed" in str(run.summary()) or run.statistics is not None


def test_a_force_acts_on_the_coordinate_that_it_names() -> None:
    start = dict(velocity=[0.0, 0.0, 1.0], angular_velocity=[0.0, 0.0, 1.0])
    brake = dict(type="pto_linear", name="brake", joint="rod", damping=3.0)
    nut = body("nut", "rigid", 2.0, inertia=[2.0, 2.0, 3.0], **start)
    rod = joint("rod", "cylindrical", "ground", "nut", axis=Z)

    def tables(**keys: str) -> Table:
        return case([nut], 2.0, gravity=0.0, joints=[rod], forces=[brake | keys])

    run = run_tables(tables(coordinate="angle"), method="radau", rtol=1e-9)
    assert run["joints/rod/displacement_rate"].values[-1] == pytest.approx(1.0, abs=1e-8)
    assert run["joints/rod/angle_rate"].values[-1] == pytest.approx(math.exp(-2.0), abs=1e-7)
    assert run["forces/brake/torque"].attrs["unit"] == "N m"
    with wrong("force.brake.joint"):
        run_tables(tables())
    with wrong("force.brake.coordinate"):
        run_tables(tables(coordinate="angel"))


def test_a_power_take_off_along_a_distance() -> None:
    """Between a ball joint and the ground a telescope turns and gets longer: c s' along it."""
    at = [3.0, 0.0, 4.0]
    mass = body("mass", ["surge", "sway", "heave"], 2.0, at, velocity=[1.0, 2.0, 0.5])
    ram = joint("ram", "telescope", "ground", "mass", point_b=at)
    pto = dict(type="pto_linear", name="pto", joint="ram", damping=4.0, stiffness=3.0, neutral=5.0)
    tables = case([mass], 5.0, gravity=0.0, joints=[ram], forces=[pto], samples=500)
    run = run_tables(tables, method="radau", rtol=1e-9)
    place, velocity = run["bodies/mass/position"].values, run["bodies/mass/velocity"].values
    distance = np.linalg.norm(place, axis=1)
    rate = np.sum(place * velocity, axis=1) / distance
    assert run["joints/ram/displacement"].values == pytest.approx(distance, abs=1e-9)
    force = run["forces/pto/force"].values
    assert force == pytest.approx(-3.0 * (distance - 5.0) - 4.0 * rate, abs=1e-6)
    assert run["forces/pto/power_absorbed"].values == pytest.approx(-force * rate, abs=1e-6)
    momentum = 2.0 * np.cross(place, velocity)
    assert np.ptp(momentum, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-7)


# Friction


@pytest.mark.parametrize("method", METHODS)
def test_smooth_friction_slides_by_its_curve_and_creeps(method: str) -> None:
    rail = dict(type="friction_stribeck", name="rail", joint="slide", static=12.0, kinetic=8.0)
    rail |= dict(stribeck_rate=0.05, creep_rate=1e-4, viscous=3.0)
    for rate in (0.01, 0.1):
        moves = [driven("drive", {"rate": rate}, joint="slide")]
        run = block(rail, 1.0, speed=rate, method=method, constraint=moves)
        curve = (8.0 + 4.0 * math.exp(-((rate / 0.05) ** 2))) * rate / math.hypot(rate, 1e-4)
        assert run["forces/rail/force"].values[-1] == pytest.approx(-curve - 3.0 * rate, rel=1e-6)
    push = dict(type="constant_load", name="push", body="block", force=[6.0, 0, 0])
    run = block([rail, push], 5.0, method=method, rtol=1e-6)
    creep = run["joints/slide/displacement_rate"].values[-1]
    assert creep == pytest.approx(1e-4 * 0.5 / math.sqrt(0.75), rel=1e-2)
