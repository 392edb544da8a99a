"""Joints, drives and couplers against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import hydrodae

GRAVITY = 9.81


def run(text: str, end_time: float, rtol: float = 1e-9) -> hydrodae.Results:
    solver = f"\n[solver]\nend_time = {end_time}\nrtol = {rtol}\n[output]\nstep = 0.02\n"
    return hydrodae.run(hydrodae.Case.from_text(text + solver))


def body(name: str, **keys: object) -> str:
    lines = {"mass": 2.0, "center_of_gravity": [0, 0, 0], "inertia": [0.1, 0.1, 0.1], **keys}
    text = f'[[body]]\nname = "{name}"\n'
    for key, value in lines.items():
        text += f"{key} = " + (f'"{value}"' if isinstance(value, str) else f"{value}") + "\n"
    return text


def joint(name: str, kind: str, a: str, b: str, extra: str = "", point: object = (0, 0, 0)) -> str:
    return (
        f'[[joint]]\nname = "{name}"\ntype = "{kind}"\nbody_a = "{a}"\nbody_b = "{b}"\n'
        f"point = {list(point)}\n{extra}\n"  # type: ignore[call-overload]
    )


def test_nut_on_a_vertical_screw_falls_with_reduced_gravity() -> None:
    """m z'' + I theta'' 2 pi / P = -m g with theta = 2 pi z / P; angle followed over many turns."""
    pitch, mass, inertia = 0.2, 2.0, 0.1
    text = body("nut") + joint("screw", "screw", "ground", "nut", f"axis=[0,0,1]\npitch={pitch}")
    results = run(text, 3.0)
    k = 2 * np.pi / pitch
    acceleration = -GRAVITY / (1.0 + inertia * k**2 / mass)
    z = 0.5 * acceleration * results.time**2
    np.testing.assert_allclose(results["joints/screw/displacement"], z, atol=1e-6)
    np.testing.assert_allclose(results["joints/screw/angle"], k * z, atol=1e-4)
    assert abs(results["joints/screw/angle"].values[-1]) > 2 * np.pi


def test_hookes_joint_turns_unevenly() -> None:
    """tan(theta_2) = tan(theta_1) / cos(beta) between shafts at the angle beta."""
    beta = np.radians(30.0)
    axis = [float(np.cos(beta)), 0.0, float(np.sin(beta))]
    text = (
        "[environment]\ngravity = 0.0\n"
        + body("input", motion=["roll"])
        + body("output")
        + joint("shaft", "revolute", "ground", "input", "axis = [1, 0, 0]\naxis_x = [0, 1, 0]")
        + joint("bearing", "revolute", "ground", "output", f"axis = {axis}\naxis_x = [0, 1, 0]")
        # x of the input's fork along y, y of the output's fork normal to the output's shaft
        + joint("cross", "universal", "input", "output", f"axis = {axis}\naxis_x = [0, 1, 0]")
        + '[[constraint]]\nname = "motor"\ntype = "coordinate"\njoint = "shaft"\n'
        + "drive = { rate = 2.0 }\n"
    )
    results = run(text, 4.0)
    theta1 = results["joints/shaft/angle"].values
    theta2 = results["joints/bearing/angle"].values
    np.testing.assert_allclose(theta1, 2.0 * results.time, atol=1e-8)
    # the fork of the input starts along y, the normal of the plane of the shafts
    expected = np.unwrap(np.arctan2(np.sin(theta1) * np.cos(beta), np.cos(theta1)))
    other = np.unwrap(np.arctan2(np.sin(theta1) / np.cos(beta), np.cos(theta1)))
    error = min(np.abs(theta2 - expected).max(), np.abs(theta2 - other).max())
    assert error < 1e-6
    assert np.abs(theta2 - theta1).max() > 0.05


def test_driven_slider_needs_mass_times_acceleration() -> None:
    """Reaction of a drive: m f'' for a sine that grows over a ramp."""
    text = (
        body("slider", motion=["surge"])
        + '[[constraint]]\nname = "drive"\ntype = "coordinate"\nbody = "slider"\n'
        + 'coordinate = "surge"\ndrive = { amplitude = 0.3, period = 2.0, ramp = 3.0 }\n'
    )
    results = run(text, 6.0)
    t, w, k = results.time, np.pi, np.pi / 3.0
    r = np.where(t < 3.0, 0.5 * (1 - np.cos(k * t)), 1.0)
    r1 = np.where(t < 3.0, 0.5 * k * np.sin(k * t), 0.0)
    r2 = np.where(t < 3.0, 0.5 * k**2 * np.cos(k * t), 0.0)
    x = 0.3 * r * np.sin(w * t)
    a = 0.3 * ((r2 - w**2 * r) * np.sin(w * t) + 2 * r1 * w * np.cos(w * t))
    np.testing.assert_allclose(results["bodies/slider/position"].values[:, 0], x, atol=1e-9)
    inner = np.abs(t - 3.0) > 0.05  # the drive's second derivative jumps where the ramp ends
    np.testing.assert_allclose(
        results["constraints/drive/reaction"].values[inner], 2.0 * a[inner], atol=2e-4
    )
    assert np.abs(results["energy/balance_error"]).max() < 1e-6


def test_gear_divides_the_load() -> None:
    """Moment M on the first of two discs, ratio n: (I + n^2 I) theta'' = M, over many turns."""
    ratio, moment, inertia = -3.0, 0.5, 0.1
    text = (
        body("a", motion=["pitch"])
        + body("b", motion=["pitch"], center_of_gravity=[1, 0, 0])
        + joint("pin_a", "revolute", "ground", "a", "axis = [0, 1, 0]")
        + joint("pin_b", "revolute", "ground", "b", "axis = [0, 1, 0]", (1, 0, 0))
        + '[[constraint]]\nname = "gear"\ntype = "coupler"\njoint = "pin_a"\njoint_b = "pin_b"\n'
        + f"ratio = {ratio}\n"
        + '[[force]]\ntype = "constant_load"\nname = "motor"\nbody = "a"\n'
        + f"moment = [0, {moment}, 0]"
    )
    results = run(text, 6.0)
    theta = 0.5 * moment / (inertia * (1 + ratio**2)) * results.time**2
    np.testing.assert_allclose(results["joints/pin_a/angle"], theta, rtol=1e-6, atol=1e-7)
    np.testing.assert_allclose(results["joints/pin_b/angle"], ratio * theta, rtol=1e-6, atol=1e-6)
    assert abs(results["joints/pin_b/angle"].values[-1]) > 6 * np.pi


def test_spring_between_two_points_swings_at_its_frequency() -> None:
    """Two point masses on a spring in free space: w^2 = k (1/m1 + 1/m2)."""
    text = (
        "[environment]\ngravity = 0.0\n"
        + body("a", motion="point", inertia=[0, 0, 0], mass=1.0)
        + body("b", motion="point", inertia=[0, 0, 0], mass=3.0, center_of_gravity=[0, 1, 0])
        + '[[force]]\ntype = "spring_damper"\nname = "s"\nbody_a = "a"\nbody_b = "b"\n'
        + "point_a = [0, 0, 0]\npoint_b = [0, 1, 0]\nstiffness = 30.0\nlength = 0.9\n"
    )
    results = run(text, 5.0)
    a, b = (results[f"bodies/{name}/position"].values for name in "ab")
    distance = np.linalg.norm(b - a, axis=1)
    w = np.sqrt(30.0 * (1 + 1 / 3))
    np.testing.assert_allclose(distance, 0.9 + 0.1 * np.cos(w * results.time), atol=1e-6)
    np.testing.assert_allclose(1.0 * a + 3.0 * b, np.tile([0, 3.0, 0], (len(a), 1)), atol=1e-8)


def test_bead_slides_on_a_turning_rod() -> None:
    """r'' = w^2 r on a rod that is turned at a constant rate: r = r0 cosh(w t)."""
    text = (
        "[environment]\ngravity = 0.0\n"
        + body("rod", motion=["yaw"])
        + body("bead", motion="point", inertia=[0, 0, 0], center_of_gravity=[0.5, 0, 0])
        + joint("pin", "revolute", "ground", "rod", "axis = [0, 0, 1]")
        + joint("slide", "sliding", "rod", "bead", "axis = [1, 0, 0]", (0.5, 0, 0))
        + '[[constraint]]\nname = "motor"\ntype = "coordinate"\njoint = "pin"\n'
        + "drive = { rate = 1.5 }\n"
    )
    results = run(text, 2.0)
    r = np.linalg.norm(results["bodies/bead/position"].values, axis=1)
    np.testing.assert_allclose(r, 0.5 * np.cosh(1.5 * results.time), rtol=1e-6)
    slide = results["joints/slide/displacement"].values
    np.testing.assert_allclose(slide, r - 0.5, atol=1e-6)


@pytest.mark.parametrize("motion", ["planar", "rigid"])
def test_velocity_level_drive(motion: str) -> None:
    """A rate that is given: s' = f(t)."""
    text = (
        body("slider", motion=motion)
        + joint("guide", "prismatic", "ground", "slider", "axis = [1, 0, 0]")
        + '[[constraint]]\nname = "drive"\ntype = "coordinate"\njoint = "guide"\n'
        + 'level = "velocity"\ndrive = { constant = 0.2, rate = -0.1 }\n'
    )
    results = run(text, 4.0)
    t = results.time
    np.testing.assert_allclose(
        results["joints/guide/displacement"], 0.2 * t - 0.05 * t**2, atol=1e-8
    )
