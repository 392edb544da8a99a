"""Friction whose normal force is the reaction of its joint, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests import scenes

import hydrodae
from hydrodae.errors import CaseError, SolverError

G = 9.81
IMPLICIT = {
    "ida": 'method = "ida"\nrtol = 1e-8',
    "radau": 'method = "radau"\nrtol = 1e-8',
    "generalized_alpha": 'method = "generalized_alpha"\nstep = 0.001',
    "gauss": 'method = "gauss"\nstep = 0.002',
    "lobatto_iiic": 'method = "lobatto_iiic"\nstep = 0.002',
}
METHODS = IMPLICIT | {"explicit_rk": 'method = "explicit_rk"\nrtol = 1e-8', "auto": "rtol = 1e-8"}
# From rest the rate of creep is 1e4 1/s and more: beyond the fixed steps above, which refuse it.
ADAPTIVE = ["ida", "radau", "explicit_rk", "auto"]


STRIBECK = 'type = "friction_stribeck"\nlength = 0.5\nradius = 0.1\ncreep_rate = 1e-4'
LUGRE = (
    'type = "friction_lugre"\nlength = 0.5\nradius = 0.1\nstribeck_rate = 1e-3\n'
    "bristle_stiffness = 1e5\nbristle_damping = 600.0"
)
DRY = 'type = "dry_friction"\nlength = 0.5\nradius = 0.1'


def slide(
    friction: str,
    solver: str,
    end: float = 1.0,
    *,
    axis: np.ndarray | None = None,
    motion: str = "rigid",
    speed: float = 0.0,
    point: list[float] | None = None,
) -> str:
    """Return the case of a block on a straight guide; `axis` points along the motion."""
    along = np.array([1.0, 0.0, 0.0]) if axis is None else axis
    mover = scenes.slide(
        "block",
        joint="guide",
        motion=motion,
        axis=along.tolist(),
        point=point,
        inertia=[0.1, 0.2, 0.15],
        gravity=9.81,
        velocity=(speed * along).tolist(),
    )
    pads = f'[[force]]\nname = "pads"\njoint = "guide"\n{friction}\n'
    return f"{mover}{pads}[solver]\nend_time = {end}\n{solver}\n[output]\nstep = 0.01\n"


def run(text: str) -> hydrodae.Results:
    return hydrodae.run(hydrodae.Case.from_text(text))


def down(angle: float) -> np.ndarray:
    return np.array([np.cos(angle), 0.0, -np.sin(angle)])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("motion", ["rigid", "planar"])
def test_a_block_slides_down_an_incline(method: str, motion: str) -> None:
    """A normal force m g cos(alpha) that nobody gave: s'' = g (sin(alpha) - mu cos(alpha))."""
    angle, mu, speed = 0.6, 0.3, 0.5
    friction = STRIBECK + f"\nstatic_coefficient = {mu}"
    results = run(slide(friction, METHODS[method], axis=down(angle), motion=motion, speed=speed))
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
    solver = METHODS[method]
    if method == "explicit_rk":  # stiff: mu N / (m s'_0) = 3e4 1/s
        solver = 'method = "explicit_rk"\nrtol = 1e-6'
    results = run(slide(STRIBECK + f"\nstatic_coefficient = {mu}", solver, 0.3, axis=down(angle)))
    part = np.tan(angle) / mu
    creep = 1e-4 * part / np.sqrt(1.0 - part**2)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    assert rate[-1] == pytest.approx(creep, rel=1e-4)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(("angle", "slips"), [(0.28, False), (0.31, True)])
def test_dry_friction_takes_the_reaction(method: str, angle: float, slips: bool) -> None:
    """It sticks while tan(alpha) < mu_s = 0.3 (16.7 deg), and slips by mu_k beyond."""
    friction = DRY + "\nstatic_coefficient = 0.3\nkinetic_coefficient = 0.25"
    results = run(slide(friction, METHODS[method], 0.5, axis=down(angle)))
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
    friction = DRY + "\nstatic_coefficient = 0.3"
    results = run(slide(friction, METHODS[method], 1.0, speed=1.5))
    stop = 1.5 / (0.3 * G)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    rests = results.time > stop
    # The small force 1e-4 m g adds less than 2e-8 of the load.
    np.testing.assert_allclose(rate[~rests], 1.5 - 0.3 * G * results.time[~rests], atol=1e-7)
    assert np.abs(rate[rests]).max() < 1e-10


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_bristles_take_the_reaction(method: str) -> None:
    """They hold below mu_s N by m g sin(alpha) / sigma_0, and slide by mu_k N."""
    friction = LUGRE + "\nstatic_coefficient = 0.4\nkinetic_coefficient = 0.3"
    held = run(slide(friction, METHODS[method], 1.0, axis=down(0.25)))
    deflection = np.asarray(held["forces/pads/deflection"].values)
    assert deflection[-1] == pytest.approx(2.0 * G * np.sin(0.25) / 1e5, rel=1e-5)
    slides = run(slide(friction, METHODS[method], 1.0, axis=down(0.6), speed=0.5))
    rate = np.asarray(slides["joints/guide/displacement_rate"].values)
    slope = (rate[-1] - rate[20]) / (slides.time[-1] - slides.time[20])
    assert slope == pytest.approx(G * (np.sin(0.6) - 0.3 * np.cos(0.6)), rel=1e-5)


PUSH = """
[[force]]
type = "constant_load"
name = "push"
body = "block"
force = [{x:.17g}, 0.0, 0.0]
moment = [0.0, 0.0, {m:.17g}]
"""


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize("part", [0.9, 0.99, 1.01, 1.2])
def test_a_push_off_the_guide_locks_it(method: str, part: float) -> None:
    """Pushed at a distance e from the guide, N = 2 F e / L: no push moves it from mu = L / 2e."""
    offset, length, push = 0.4, 0.5, 300.0
    mu = part * length / (2.0 * offset)
    friction = STRIBECK + f"\nstatic_coefficient = {mu}\nsmall_force = 0.001"
    creep = 1e-4 if part < 1.0 else 1e-2  # so that it creeps steadily before long
    friction = friction.replace("1e-4", f"{creep}")
    text = slide(friction, METHODS[method], 0.3).replace("gravity = 9.81", "gravity = 0.0")
    results = run(text.replace("[solver]", PUSH.format(x=push, m=-offset * push) + "[solver]"))
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    if part < 1.0:
        assert rate[-1] == pytest.approx(push / 2.0 * (1.0 - part) * 0.3, rel=5e-3)
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
    law = DRY if kind == "dry" else STRIBECK
    friction = law + f"\nstatic_coefficient = {mu}\nsmall_force = 0.001"
    text = slide(friction, METHODS[method], 0.005, speed=speed, point=[0.0, -offset, 0.0])
    text = text.replace("gravity = 9.81", "gravity = 0.0").replace("step = 0.01", "step = 0.001")
    text = text.replace("0.002", "0.0005")
    # The load acts on the line of the guide: a moment about the centre of gravity.
    push = PUSH.format(x=pushed, m=offset * pushed)
    text = text.replace("[solver]", push + "[solver]")
    if part > 1.0:
        with pytest.raises(
            SolverError, match=r"friction 'pads' jams joint 'guide'.*not below 0\.625"
        ):
            run(text)
        return
    results = run(text)
    rate = np.asarray(results["joints/guide/displacement_rate"].values)
    slope = pushed / 2.0 / (1.0 + part * np.sign(pushed))
    expected = speed + slope * results.time
    np.testing.assert_allclose(rate[expected > 0.5], expected[expected > 0.5], rtol=2e-4)


PENDULUM = (
    scenes.pendulum("arm", motion="MOTION", mass=3.0, at=[0.8, 0.0, 0.0], inertia=[0.1, 0.3, 0.25])
    + """
[[force]]
type = "friction_stribeck"
name = "bearing"
joint = "hinge"
static_coefficient = 0.2
radius = 0.05
LENGTHS
creep_rate = 0.02
viscous = 0.01
preload = 4.0
[solver]
end_time = 3.0
SOLVER
[output]
step = 0.02
"""
)


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
    lengths = "" if motion == "planar" else "length = 0.1\nradius_axial = 0.05"
    text = PENDULUM.replace("MOTION", motion).replace("LENGTHS", lengths)
    results = run(text.replace("SOLVER", METHODS[method]))
    angle = np.asarray(results["joints/hinge/angle"].values)
    tolerance = 5e-5 if method == "generalized_alpha" else 2e-6
    np.testing.assert_allclose(angle, pendulum(results.time), atol=tolerance)
    assert np.asarray(results["forces/bearing/power"].values).max() <= 0.0


@pytest.mark.parametrize(
    ("method", "order"), [("gauss", 2), ("lobatto_iiic", 2), ("explicit_rk", 5)]
)
def test_the_error_falls_with_the_step(method: str, order: int) -> None:
    errors = []
    for step in (0.02, 0.01):
        text = PENDULUM.replace("MOTION", "planar").replace("LENGTHS", "")
        text = text.replace("creep_rate = 0.02", "creep_rate = 0.5").replace("0.02\n", "0.02\n")
        extra = "\norder = 5" if method == "explicit_rk" else ""
        solver = f'method = "{method}"\nstep = {step}{extra}'
        reference = run(text.replace("SOLVER", 'method = "radau"\nrtol = 1e-11'))
        angle = run(text.replace("SOLVER", solver))["joints/hinge/angle"].values
        errors.append(np.abs(angle - reference["joints/hinge/angle"].values).max())
    assert np.log2(errors[0] / errors[1]) > order - 0.5


@pytest.mark.parametrize("formulation", ["stabilised", "index_2", "index_1"])
def test_formulations_press_alike(formulation: str) -> None:
    text = PENDULUM.replace("MOTION", "planar").replace("LENGTHS", "")
    solver = f'method = "radau"\nrtol = 1e-9\nformulation = "{formulation}"'
    results = run(text.replace("SOLVER", solver))
    angle = np.asarray(results["joints/hinge/angle"].values)
    np.testing.assert_allclose(angle, pendulum(results.time), atol=1e-5)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("static_coefficient = 0.2", "static = 1.0", "go with 'static_coefficient'"),
        ("radius = 0.05", "", "needs the key 'radius'"),
        ("LENGTHS", "", "needs the key 'length'"),
        ("static_coefficient = 0.2", "", "either 'static'"),
        (
            "static_coefficient = 0.2",
            "static_coefficient = 0.2\nkinetic_coefficient = 0.3",
            "must not be above",
        ),
        ('"revolute"', '"universal"', "prismatic, revolute, cylindrical or sliding"),
    ],
)
def test_friction_that_lacks_something_is_refused(old: str, new: str, message: str) -> None:
    text = PENDULUM.replace(old, new).replace("MOTION", "rigid").replace("SOLVER", "")
    if '"universal"' in new:
        text = text.replace('joint = "hinge"', 'joint = "hinge"\ncoordinate = "angle"')
    with pytest.raises(CaseError, match=message):
        run(text.replace("LENGTHS", "length = 0.1\nradius_axial = 0.0"))


def test_a_reaction_shared_with_redundant_rows_is_refused() -> None:
    text = PENDULUM.replace("MOTION", "rigid").replace("SOLVER", "")
    text = text.replace("LENGTHS", "length = 0.1\nradius_axial = 0.0")
    second = text[text.index("[[joint]]") : text.index("[[force]]")].replace('"hinge"', '"second"')
    second = second.replace("point = [0.0, 0.0, 0.0]", "point = [0.0, 0.4, 0.0]")
    with pytest.raises(CaseError, match=r"joint 'hinge' is not known.*redundant.*'second'"):
        run(text.replace("[[force]]", second + "[[force]]"))
