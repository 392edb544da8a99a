"""Friction that the impulse of an impact presses, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import hydrodae

METHODS = {
    "ida": 'method = "ida"\nrtol = 1e-8',
    "radau": 'method = "radau"\nrtol = 1e-8',
    "explicit_rk": 'method = "explicit_rk"\nrtol = 1e-8',
    "generalized_alpha": 'method = "generalized_alpha"\nstep = 0.001',
}
KINDS = {
    "dry": 'type = "dry_friction"',
    "stribeck": 'type = "friction_stribeck"\ncreep_rate = 1e-6',
    "lugre": 'type = "friction_lugre"\nstribeck_rate = 1e-3\nbristle_stiffness = 1e5\n'
    "bristle_damping = 600.0",
}

# A carriage on rails carries a load that falls on a stop of it.
CARRIAGE = """
[environment]
gravity = 0.0
[[body]]
name = "carriage"
motion = ["surge", "heave"]
mass = 3.0
center_of_gravity = [0.0, 0.0, 0.0]
initial = { velocity = [SPEED, 0.0, 0.0] }
[[body]]
name = "load"
motion = ["surge", "heave"]
mass = 2.0
center_of_gravity = [0.0, 0.0, 1.0]
initial = { velocity = [SPEED, 0.0, -4.0] }
[[joint]]
name = "rails"
type = "prismatic"
body_a = "ground"
body_b = "carriage"
point = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[joint]]
name = "lift"
type = "prismatic"
body_a = "carriage"
body_b = "load"
point = [0.0, 0.0, 1.0]
axis = [0.0, 0.0, 1.0]
[[constraint]]
name = "buffer"
type = "stop"
joint = "lift"
lower = -0.2
restitution = RESTITUTION
[[force]]
name = "shoes"
joint = "rails"
small_force = 1e-9
static_coefficient = MU
KIND
[solver]
end_time = 0.1
SOLVER
[output]
step = 0.01
"""


def carriage(mu: float, e: float, speed: float, kind: str, solver: str) -> hydrodae.Results:
    text = CARRIAGE.replace("MU", str(mu)).replace("RESTITUTION", str(e))
    text = text.replace("SPEED", str(speed)).replace("KIND", kind).replace("SOLVER", solver)
    return hydrodae.run(hydrodae.Case.from_text(text))


def speeds(run: hydrodae.Results) -> tuple[float, float]:
    """Of the carriage along its rails, and of the load up."""
    return (
        float(run["bodies/carriage/velocity"].values[-1, 0]),
        float(run["bodies/load/velocity"].values[-1, 2]),
    )


@pytest.mark.parametrize("method", METHODS)
def test_the_impulse_on_a_buffer_brakes_the_carriage(method: str) -> None:
    """J = m (1 + e) w presses the rails: the speed falls by mu J / (M + m), or to zero."""
    for mu, e, speed in ((0.1, 0.5, 2.0), (0.4, 0.0, -5.0), (0.3, 0.5, 0.5)):
        run = carriage(mu, e, speed, KINDS["dry"], METHODS[method])
        impulse = 2.0 * (1.0 + e) * 4.0
        left = max(0.0, abs(speed) - mu * impulse / 5.0) * np.sign(speed)
        along, up = speeds(run)
        assert along == pytest.approx(left, abs=1e-6)
        assert up == pytest.approx(4.0 * e, abs=1e-6)
        hit = run.impacts["buffer"] if isinstance(run.impacts, dict) else run.impacts
        assert hit is not None
        assert not any("impacts" in note for note in run.notes)


@pytest.mark.parametrize("kind", ["stribeck", "lugre"])
def test_other_kinds_of_friction_take_part_likewise(kind: str) -> None:
    run = carriage(0.1, 0.5, 2.0, KINDS[kind], METHODS["radau"])
    assert speeds(run)[0] == pytest.approx(2.0 - 0.1 * 12.0 / 5.0, abs=1e-4)


def arm(angle: float, mu: float, e: float, spin: float) -> hydrodae.Results:
    """An arm turns on a thick pin and strikes with the slide on it."""
    c, s = np.cos(angle), np.sin(angle)
    text = f"""
[environment]
gravity = 0.0
[[body]]
name = "arm"
motion = ["surge", "heave", "pitch"]
mass = 2.0
center_of_gravity = [1.0, 0.0, 0.0]
inertia = [0.5, 0.5, 0.5]
initial = {{ velocity = [0.0, 0.0, {-spin}], angular_velocity = [0.0, {spin}, 0.0] }}
[[body]]
name = "slide"
motion = ["surge", "heave", "pitch"]
mass = 3.0
center_of_gravity = [2.0, 0.0, 0.0]
inertia = [0.2, 0.2, 0.2]
[body.initial]
velocity = [{3.0 * c}, 0.0, {3.0 * s - 2.0 * spin}]
angular_velocity = [0.0, {spin}, 0.0]
[[joint]]
name = "pin"
type = "revolute"
body_a = "ground"
body_b = "arm"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[[joint]]
name = "guide"
type = "prismatic"
body_a = "arm"
body_b = "slide"
point = [2.0, 0.0, 0.0]
axis = [{c}, 0.0, {s}]
[[constraint]]
name = "end"
type = "stop"
joint = "guide"
upper = 0.05
restitution = {e}
[[force]]
type = "dry_friction"
name = "bush"
joint = "pin"
static_coefficient = {mu}
radius = 0.3
radius_axial = 0.0
length = 1.0
small_force = 1e-9
[solver]
end_time = 0.05
method = "radau"
rtol = 1e-9
[output]
step = 0.0005
"""
    return hydrodae.run(hydrodae.Case.from_text(text))


@pytest.mark.parametrize("e", [0.0, 0.7, 1.0])
def test_impacts_with_friction_never_give_energy(e: float) -> None:
    """Whatever the direction in which the impact turns the pin, and whether it stops it."""
    for angle in (-1.2, -0.4, 0.4, 1.2):
        for spin in (-2.0, 0.0, 0.3, 2.0):
            run = arm(angle, 0.8, e, spin)
            kinetic = run["energy/kinetic"].values
            assert np.diff(kinetic).max() < 1e-7 * kinetic[0]
            assert not any("energy" in note for note in run.notes)
