"""Friction whose normal force is the reaction of its joint, against closed forms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.attack.parts import ORIGIN, Table, Vector, X, Y, body, case, joint
from tests.verification.blocks import run_tables

import hydrodae
from hydrodae.errors import CaseError, SolverError

G = 9.81
METHODS: dict[str, dict[str, Any]] = {
    "ida": {"rtol": 1e-8},
    "radau": {"rtol": 1e-8},
    "generalized_alpha": {"step": 0.001},
    "gauss": {"step": 0.002},
    "lobatto_iiic": {"step": 0.002},
    "explicit_rk": {"rtol": 1e-8},
    "auto": {"rtol": 1e-8},
}
# From rest the rate of creep is 1e4 1/s and more: beyond the fixed steps above, which refuse it.
ADAPTIVE = ["ida", "radau", "explicit_rk", "auto"]
ADJUST = dict(length=0.5, radius=0.1)
STRIBECK = dict(type="friction_stribeck", creep_rate=1e-4, **ADJUST)
LUGRE = dict(type="friction_lugre", stribeck_rate=1e-3, **ADJUST)
LUGRE |= dict(bristle_stiffness=1e5, bristle_damping=600.0)
DRY = dict(type="dry_friction", **ADJUST)


def run(tables: Table, method: str, **solver: Any) -> hydrodae.Results:
    return run_tables(tables, method=method, **(METHODS[method] | solver))


def slide(
    friction: Table,
    end: float = 1.0,
    *,
    axis: Vector = X,
    motion: str = "rigid",
    speed: float = 0.0,
    point: Vector = ORIGIN,
    gravity: float = G,
    loads: Sequence[Table] = (),
    step: float = 0.01,
) -> Table:
    """Return a block on a straight guide; `axis` points along the motion."""
    start = {"velocity": speed * np.asarray(axis)}
    return case(
        [body("block", motion, 2.0, inertia=[0.1, 0.2, 0.15], **start)],
        end,
        gravity=gravity,
        joints=[joint("guide", "prismatic", "ground", "block", point, axis)],
        forces=[{"name": "pads", "joint": "guide", **friction}, *loads],
        output={"step": step},
    )


def down(angle: float) -> np.ndarray:
    return np.array([np.cos(angle), 0.0, -np.sin(angle)])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motion", ["rigid", "planar"])
def test_a_block_slides_down_an_incline(method: str, motion: str) -> None:
    """A normal force m g cos(alpha) that nobody gave: s'' = g (sin(alpha) - mu cos(alpha))."""
    angle, mu, speed = 0.6, 0.3, 0.5
    friction = STRIBECK | {"static_coefficient": mu}
    results = run(slide(friction, axis=down(angle), motion=motion, speed=speed), method)
    t = results.time
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    acceleration = G * (np.sin(angle) - mu * np.cos(angle))
    # Creep takes (s'_0 / s')^2 / 2 of the friction: 2e-8 at 0.5 m/s.
    np.testing.assert_allclose(rate, speed + acceleration * t, rtol=1e-6)
    normal = np.asarray(results["forces/pads/normal_force"].values)
    np.testing.assert_allclose(normal, 2.0 * G * np.cos(angle), rtol=1e-6)
    power = np.asarray(results["forces/pads/power"].values)
    force = np.asarray(results["forces/pads/force"].values)
    assert power.max() < 0.0
    np.testing.assert_allclose(power, force * rate, rtol=1e-12)
    np.testing.assert_allclose(force, -mu * normal, rtol=1e-6)
    assert np.abs(results["energy/balance_error"].values).max() < 1e-5


@pytest.mark.parametrize("method", ADAPTIVE)
def test_a_block_stays_on_an_incline_below_the_angle_of_friction(method: str) -> None:
    """Where tan(alpha) < mu it creeps at s'_0 x / sqrt(1 - x^2), x = tan(alpha) / mu."""
    angle, mu = 0.25, 0.3
    rough = {"rtol": 1e-6} if method == "explicit_rk" else {}  # stiff: mu N / (m s'_0) = 3e4 1/s
    friction = STRIBECK | {"static_coefficient": mu}
    results = run(slide(friction, 0.3, axis=down(angle)), method, **rough)
    part = np.tan(angle) / mu
    creep = 1e-4 * part / np.sqrt(1.0 - part**2)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    assert rate[-1] == pytest.approx(creep, rel=1e-4)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(("angle", "slips"), [(0.28, False), (0.31, True)])
def test_dry_friction_takes_the_reaction(method: str, angle: float, slips: bool) -> None:
    """It sticks while tan(alpha) < mu_s = 0.3 (16.7 deg), and slips by mu_k beyond."""
    friction = DRY | dict(static_coefficient=0.3, kinetic_coefficient=0.25)
    results = run(slide(friction, 0.5, axis=down(angle)), method)
    place = np.asarray(results["joints/guide/displacement"].values)
    if slips:
        fall = 0.5 * G * (np.sin(angle) - 0.25 * np.cos(angle)) * results.time**2
        np.testing.assert_allclose(place, fall, atol=1e-8)
    else:
        assert np.abs(place).max() < 1e-12
        held = np.asarray(results["constraints/pads/reaction"].values)
        assert held[-1] == pytest.approx(-2.0 * G * np.sin(angle), rel=1e-8)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_dry_friction_stops_by_the_reaction(method: str) -> None:
    """On a level guide it stops after v / (mu g) and stays there."""
    results = run(slide(DRY | {"static_coefficient": 0.3}, speed=1.5), method)
    stop = 1.5 / (0.3 * G)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    rests = results.time > stop
    # The small force 1e-4 m g adds less than 2e-8 of the load.
    np.testing.assert_allclose(rate[~rests], 1.5 - 0.3 * G * results.time[~rests], atol=1e-7)
    assert np.abs(rate[rests]).max() < 1e-10


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_bristles_take_the_reaction(method: str) -> None:
    """They hold below mu_s N by m g sin(alpha) / sigma_0, and slide by mu_k N."""
    friction = LUGRE | dict(static_coefficient=0.4, kinetic_coefficient=0.3)
    held = run(slide(friction, axis=down(0.25)), method)
    deflection = np.asarray(held["forces/pads/deflection"].values)
    assert deflection[-1] == pytest.approx(2.0 * G * np.sin(0.25) / 1e5, rel=1e-5)
    slides = run(slide(friction, axis=down(0.6), speed=0.5), method)
    rate = np.asarray(slides["joints/guide/displacement_rate"].values)
    slope = (rate[-1] - rate[20]) / (slides.time[-1] - slides.time[20])
    assert slope == pytest.approx(G * (np.sin(0.6) - 0.3 * np.cos(0.6)), rel=1e-5)


def push(force: float, moment: float) -> list[Table]:
    vectors = dict(force=[force, 0.0, 0.0], moment=[0.0, 0.0, moment])
    return [{"type": "constant_load", "name": "push", "body": "block", **vectors}]


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize("part", [0.9, 0.99, 1.01, 1.2])
def test_a_push_off_the_guide_locks_it(method: str, part: float) -> None:
    """Pushed at a distance e from the guide, N = 2 F e / L: no push moves it from mu = L / 2e."""
    offset, length, load = 0.4, 0.5, 300.0
    mu = part * length / (2.0 * offset)
    creep = 1e-4 if part < 1.0 else 1e-2  # so that it creeps steadily before long
    friction = STRIBECK | dict(static_coefficient=mu, small_force=0.001, creep_rate=creep)
    off_guide = push(load, -offset * load)
    results = run(slide(friction, 0.3, gravity=0.0, loads=off_guide), method)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    if part < 1.0:
        assert rate[-1] == pytest.approx(load / 2.0 * (1.0 - part) * 0.3, rel=5e-3)
    else:
        assert rate[-1] == pytest.approx(creep / np.sqrt(part**2 - 1.0), rel=1e-3)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("kind", ["stribeck", "dry"])
@pytest.mark.parametrize("pushed", [-20.0, 20.0])
@pytest.mark.parametrize("part", [0.98, 1.02])
def test_a_centre_off_the_guide_jams_it(method: str, kind: str, pushed: float, part: float) -> None:
    """The inertia of a centre e off the guide presses by 2 m |s''| e / L.

    With mu 2 e / L = k < 1, m s'' = F / (1 + k sign(s' s'')); from k = 1 on there is no solution
    against the motion, and there are two along it (Painleve).
    """
    offset, length, speed = 0.4, 0.5, 3.0
    mu = part * length / (2.0 * offset)
    law = (DRY if kind == "dry" else STRIBECK) | dict(static_coefficient=mu, small_force=0.001)
    # The load acts on the line of the guide: a moment about the centre of gravity.
    tables = slide(
        law,
        0.005,
        speed=speed,
        point=[0.0, -offset, 0.0],
        gravity=0.0,
        loads=push(pushed, offset * pushed),
        step=0.001,
    )
    fine = {"step": 0.0005} if METHODS[method].get("step") == 0.002 else {}
    if part > 1.0:
        with pytest.raises(
            SolverError, match=r"friction 'pads' jams joint 'guide'.*not below 0\.625"
        ):
            run(tables, method, **fine)
        return
    results = run(tables, method, **fine)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    slope = pushed / 2.0 / (1.0 + part * np.sign(pushed))
    expected = speed + slope * results.time
    np.testing.assert_allclose(rate[expected > 0.5], expected[expected > 0.5], rtol=2e-4)


def arm(motion: str = "planar", *joints: Table, **keys: Any) -> Table:
    """Return a pendulum that rubs in its bearing; keys that are None are left out."""
    law = dict(type="friction_stribeck", name="bearing", joint="hinge", static_coefficient=0.2)
    law |= dict(radius=0.05, creep_rate=0.02, viscous=0.01, preload=4.0)
    if motion == "rigid":
        law |= dict(length=0.1, radius_axial=0.05)
    law = {key: value for key, value in (law | keys).items() if value is not None}
    bar = body("arm", motion, 3.0, [0.8, 0.0, 0.0], [0.1, 0.3, 0.25])
    hinge = joint("hinge", "revolute", "ground", "arm", axis=Y)
    return case([bar], 3.0, joints=[hinge, *joints], forces=[law], samples=150)


def pendulum(time: np.ndarray) -> np.ndarray:
    """Angle (nt,) from the horizontal, positive downwards, of the reduced equation.

    I th'' = m g l cos(th) - M(N, th'), N the size of the force of the bearing, which depends on
    th'' itself: fixed points, as mu r N is a small part of the weight's moment.
    """
    mass, arm, inertia, mu, radius = 3.0, 0.8, 0.3 + 3.0 * 0.64, 0.2, 0.05
    small = 2.0 * 1e-5 * mass * G  # of both bearings

    def rates(_: float, y: np.ndarray) -> list[float]:
        angle, rate = y
        acceleration = 0.0
        for _ in range(60):
            tangential = mass * (arm * acceleration - G * np.cos(angle))
            radial = -mass * (arm * rate**2 + G * np.sin(angle))
            normal = 4.0 + np.sqrt(tangential**2 + radial**2 + small**2)
            moment = radius * mu * normal * rate / np.hypot(rate, 0.02) + 0.01 * rate
            acceleration = (mass * G * arm * np.cos(angle) - moment) / inertia
        return [rate, acceleration]

    solution = solve_ivp(
        rates, (0.0, time[-1]), [0.0, 0.0], method="DOP853", t_eval=time, rtol=1e-11, atol=1e-12
    )
    return np.asarray(solution.y[0])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motion", ["planar", "rigid"])
def test_a_pendulum_rubs_in_its_bearing(method: str, motion: str) -> None:
    results = run(arm(motion), method)
    angle = np.asarray(results["joints/hinge/angle"].values)
    tolerance = 5e-5 if method == "generalized_alpha" else 2e-6
    np.testing.assert_allclose(angle, pendulum(results.time), atol=tolerance)
    assert np.asarray(results["forces/bearing/power"].values).max() <= 0.0


@pytest.mark.parametrize(
    ("method", "order"), [("gauss", 2), ("lobatto_iiic", 2), ("explicit_rk", 5)]
)
def test_the_error_falls_with_the_step(method: str, order: int) -> None:
    tables = arm(creep_rate=0.5)
    reference = run(tables, "radau", rtol=1e-11)["joints/hinge/angle"].values
    more: Table = {"order": 5} if method == "explicit_rk" else {}
    errors = []
    for step in (0.02, 0.01):
        angle = run_tables(tables, method=method, step=step, **more)["joints/hinge/angle"].values
        errors.append(np.abs(angle - reference).max())
    assert np.log2(errors[0] / errors[1]) > order - 0.5


@pytest.mark.parametrize("formulation", ["stabilised", "index_2", "index_1"])
def test_formulations_press_alike(formulation: str) -> None:
    results = run(arm(), "radau", rtol=1e-9, formulation=formulation)
    angle = np.asarray(results["joints/hinge/angle"].values)
    np.testing.assert_allclose(angle, pendulum(results.time), atol=1e-5)


@pytest.mark.parametrize(
    ("keys", "kind", "message"),
    [
        ({"static_coefficient": None, "static": 1.0}, "revolute", "go with 'static_coefficient'"),
        ({"radius": None}, "revolute", "needs the key 'radius'"),
        ({"length": None}, "revolute", "needs the key 'length'"),
        ({"static_coefficient": None}, "revolute", "either 'static'"),
        ({"kinetic_coefficient": 0.3}, "revolute", "must not be above"),
        ({"coordinate": "angle"}, "universal", "prismatic, revolute, cylindrical or sliding"),
    ],
)
def test_friction_that_lacks_something_is_refused(keys: Table, kind: str, message: str) -> None:
    tables = arm("rigid", **{"radius_axial": 0.0, **keys})
    tables["joint"][0]["type"] = kind
    with pytest.raises(CaseError, match=message):
        run_tables(tables)


def test_a_reaction_shared_with_redundant_rows_is_refused() -> None:
    second = joint("second", "revolute", "ground", "arm", [0.0, 0.4, 0.0], Y)
    with pytest.raises(CaseError, match=r"joint 'hinge' is not known.*redundant.*'second'"):
        run_tables(arm("rigid", second, radius_axial=0.0))
