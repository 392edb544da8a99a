"""Stops, one-sided distances and dry friction: located events, for every method."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import DOWN_Y, Table, X, Y, Z, body, case, joint, stop
from tests.errors import wrong
from tests.stability import switching
from tests.verification.blocks import run_tables

import hydrodae
from hydrodae.errors import SolverError

METHODS: dict[str, dict[str, Any]] = {
    "ida": {},
    "radau": {"method": "radau"},
    "explicit_rk": {"method": "explicit_rk"},
    "generalized_alpha": {"method": "generalized_alpha", "step": 0.002},
    "gauss": {"method": "gauss", "step": 0.01},
    "lobatto_iiic": {"method": "lobatto_iiic", "step": 0.01},
}
GRAVITY = 9.81


def ball(end: float, restitution: float = 0.8, lower: float = -1.0, **bounds: float) -> Table:
    """Return a ball of 2 kg on a guide, `lower` above a floor."""
    at = [0.0, 0.0, 1.0]
    return case(
        [body("ball", "heave", 2.0, at)],
        end,
        joints=[joint("guide", "prismatic", "ground", "ball", at, Z)],
        constraints=[stop("floor", "guide", restitution, lower=lower, **bounds)],
        output={"step": 0.01},
    )


def block(end: float, **friction: float) -> Table:
    """Return a mass on a spring that rubs."""
    spring = dict(type="pto_linear", name="spring", joint="slide", stiffness=200.0)
    dry = {"type": "dry_friction", "name": "dry", "joint": "slide", "static": 6.0, **friction}
    return case(
        [body("block", "surge", 2.0, displacement=[0.5, 0.0, 0.0])],
        end,
        gravity=0.0,
        joints=[joint("slide", "prismatic", "ground", "block", axis=X)],
        forces=[spring, dry],
        output={"step": 0.01},
    )


def bounces(time: np.ndarray, restitution: float) -> np.ndarray:
    """Height of a ball that falls 1 m and bounces until it rests, after Newton's law."""
    z = np.zeros_like(time)
    start, speed = -np.sqrt(2.0 / GRAVITY), np.sqrt(2.0 * GRAVITY)
    while speed > 1e-9:
        length = 2.0 * speed / GRAVITY
        t = time - start
        flight = (t >= 0.0) & (t <= length)
        z[flight] = (speed * t - 0.5 * GRAVITY * t**2)[flight]
        start, speed = start + length, restitution * speed
    return z


@pytest.mark.parametrize("method", METHODS)
def test_a_ball_bounces_until_it_rests(method: str) -> None:
    results = run_tables(ball(5.0), rtol=1e-8, **METHODS[method])
    z = np.asarray(results["bodies/ball/position"].values)[:, 2]
    np.testing.assert_allclose(z, bounces(results.time, 0.8), atol=2e-6)
    floor = np.asarray(results["constraints/floor/reaction"].values)
    assert floor[-1] == pytest.approx(2.0 * GRAVITY, rel=1e-9)  # at rest it carries the weight
    assert floor.min() >= 0.0
    assert results.statistics["events"] > 30
    lost = np.asarray(results["energy/work/constraints"].values)[-1]
    assert lost == pytest.approx(-2.0 * GRAVITY, rel=1e-6)  # all that it fell
    assert np.abs(results["energy/balance_error"].values).max() < 1e-6


@pytest.mark.parametrize("method", METHODS)
def test_dry_friction_stops_an_oscillator(method: str) -> None:
    """Turning points fall by 2 F / k each half period; it rests where the spring cannot move it."""
    half_period, held = np.pi * np.sqrt(2.0 / 200.0), 6.0 / 200.0  # s, m
    turns = [0.5]
    while abs(turns[-1]) > held:
        turns.append(-turns[-1] + np.copysign(2.0 * held, turns[-1]))
    assert turns[-1] == pytest.approx(0.02)
    results = run_tables(block(4.0), rtol=1e-8, **METHODS[method])
    x = np.asarray(results["bodies/block/position"].values)[:, 0]
    for k, turn in enumerate(turns):
        near = np.abs(results.time - k * half_period) < 0.006
        assert x[near][0] == pytest.approx(turn, abs=2e-3)  # the sample is up to 5 ms off
    assert x[-1] == pytest.approx(turns[-1], abs=1e-5)
    rate = np.asarray(results["bodies/block/velocity"].values)[:, 0]
    rests = results.time > (len(turns) - 1) * half_period + 1e-3
    assert np.abs(rate[rests]).max() < 1e-12
    power = np.diff(np.asarray(results["energy/work/dry"].values))
    assert power.max() <= 1e-12
    load = np.asarray(results["constraints/dry/reaction"].values)
    assert load[-1] == pytest.approx(200.0 * x[-1], rel=1e-6)  # the spring is held


@pytest.mark.parametrize("method", METHODS)
def test_a_bob_on_a_rope_goes_slack_and_taut(method: str, tmp_path: Path) -> None:
    scene = next(s for s in switching.scenes() if s.name == "snap")
    steps = {"generalized_alpha": 0.0005, "gauss": 0.01, "lobatto_iiic": 0.005}
    control = {"step": steps[method]} if method in steps else {"rtol": 1e-9}
    solver = {"method": method, **control}
    results = hydrodae.run(scene.case(solver, tmp_path))
    assert scene.error(results) < (1e-4 if method == "generalized_alpha" else 1e-6)
    length = np.asarray(results["joints/rope/displacement"].values)
    pull = np.asarray(results["constraints/rope/reaction"].values)
    assert length.max() <= 1.0 + 1e-7  # between the steps it is interpolated
    assert pull.max() <= 1e-6  # a rope never pushes
    assert (pull[length < 1.0 - 1e-6] == 0.0).all()


def limit_cycle(mass: float, k: float, static: float, kinetic: float, speed: float) -> tuple:
    """Period and largest deflection of a block on a spring that a belt carries until it slips.

    It slips at static / k with the speed of the belt, swings about kinetic / k with the amplitude
    A, and sticks again when it has that speed once more, as far on the other side.
    """
    rate, ahead = np.sqrt(k / mass), (static - kinetic) / k
    amplitude = np.hypot(ahead, speed / rate)
    slips = 2.0 * (np.pi - np.arctan(ahead * rate / speed)) / rate
    return slips + 2.0 * ahead / speed, kinetic / k + amplitude


BELT = next(s for s in switching.scenes() if s.name == "stick_slip")


@pytest.mark.parametrize("speed", [0.05, 0.2, 1.0])
def test_stick_slip_on_a_belt(speed: float) -> None:
    """Period and largest deflection of the limit cycle, for three speeds of the belt."""
    period, deflection = limit_cycle(1.0, 50.0, 10.0, 6.0, speed)
    tables = copy.deepcopy(dict(BELT.tables))
    tables["constraint"][0]["drive"]["rate"] = speed
    for table in tables["body"]:
        table["initial"]["velocity"][0] = speed
    tables["solver"]["end_time"] = 0.2 / speed + 2.2 * period
    tables["output"]["step"] = period / 4000.0
    results = run_tables(tables, rtol=1e-9)
    x = np.asarray(results["bodies/block/position"].values)[:, 0]
    assert x.max() == pytest.approx(deflection, rel=1e-5)
    peaks = results.time[1:-1][(x[1:-1] > x[:-2]) & (x[1:-1] >= x[2:])]
    assert np.diff(peaks).mean() == pytest.approx(period, rel=5e-3)


def test_methods_agree_on_stick_slip(tmp_path: Path) -> None:
    for solver in ({"rtol": 1e-9}, {"method": "radau"}, {"method": "explicit_rk"}):
        assert BELT.error(hydrodae.run(BELT.case(solver, tmp_path))) < 1e-6


def test_an_arm_strikes_a_stop_through_its_hinge() -> None:
    """A rod that falls onto a stop of its hinge: energy falls by the square of the restitution."""
    tables = case(
        [body("rod", "rigid", 3.0, [0.5, 0.0, 0.0], [0.01, 0.25, 0.25])],
        1.5,
        joints=[joint("hinge", "revolute", "ground", "rod", axis=Y)],
        constraints=[stop("stop", "hinge", 0.5, lower_deg=-10.0, upper_deg=40.0)],
        output={"step": 0.005},
    )
    results = run_tables(tables, rtol=1e-8)
    angle = np.asarray(results["joints/hinge/angle"].values)
    assert np.degrees(angle.max()) == pytest.approx(40.0, abs=1e-6)
    # From rest, level, it falls by L/2 sin(40 deg); after the first impact it rises by a quarter.
    near = np.degrees(angle) > 39.0
    first = int(np.argmax(near))
    left = first + int(np.argmin(near[first:]))
    back = left + int(np.argmax(near[left:]))
    fell = np.sin(np.radians(40.0))
    rise = np.sin(np.radians(40.0)) - np.sin(angle[left:back].min())
    assert rise == pytest.approx(0.25 * fell, rel=2e-3)


def test_two_blocks_strike_one_after_the_other() -> None:
    """Two masses on one line with a one-sided link of 1 m: momentum is kept at the snap."""
    at = [0.5, 0.0, 0.0]
    more: Table = dict(point_b=at, length=1.0, one_sided=True, restitution=0.5)
    tables = case(
        [body("a", "surge", 3.0), body("b", "surge", 1.0, at, velocity=[2.0, 0.0, 0.0])],
        1.0,
        gravity=0.0,
        joints=[joint("link", "distance", "a", "b", **more)],
        samples=100,
    )
    results = run_tables(tables, rtol=1e-8)
    va = np.asarray(results["bodies/a/velocity"].values)[-1, 0]
    vb = np.asarray(results["bodies/b/velocity"].values)[-1, 0]
    assert 3.0 * va + vb == pytest.approx(2.0, rel=1e-9)
    assert vb - va == pytest.approx(-0.5 * 2.0, rel=1e-6)
    assert results.statistics["events"] == 1


def test_a_stop_holds_in_the_equilibrium() -> None:
    tables = ball(1.0, lower=-0.05)
    spring = dict(type="pto_linear", name="spring", joint="guide", stiffness=100.0)
    results = run_tables(tables | {"force": [spring]}, start="equilibrium")
    z = np.asarray(results["bodies/ball/position"].values)[:, 2]
    np.testing.assert_allclose(z, 1.0 - 0.05, atol=1e-9)
    floor = np.asarray(results["constraints/floor/reaction"].values)
    np.testing.assert_allclose(floor, 2.0 * GRAVITY - 5.0, rtol=1e-9)


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"lower": None, "upper": -0.5}, ""),  # the start is beyond it
        ({"lower": None}, ""),  # no bound at all
        ({"lower": None, "lower_deg": -1.0}, ".lower_deg"),
        ({"lower": 1.0, "upper": 0.5}, ".upper"),
        ({"restitution": 1.2}, ".restitution"),
        ({"type": "coordinate"}, ".lower"),
    ],
)
def test_a_stop_that_makes_no_sense_is_refused(change: Table, key: str) -> None:
    tables = ball(1.0)
    floor = tables["constraint"][0] | change
    tables["constraint"] = [{k: value for k, value in floor.items() if value is not None}]
    with wrong(f"constraint.floor{key}"):
        run_tables(tables)


def test_friction_that_makes_no_sense_is_refused() -> None:
    with wrong("force.dry.kinetic"):
        run_tables(block(1.0, kinetic=7.0))


def test_events_without_end_are_told() -> None:
    """A perfect rebound between bounds that close in on nothing cannot go on for ever."""
    tables = ball(1.0, 1.0, upper=-0.9999999)
    tables["joint"][0]["initial"] = {"displacement": -1.0, "displacement_rate": 1.0}
    with pytest.raises(SolverError, match="events of stops or dry friction brought only"):
        run_tables(tables, rtol=1e-8)


def test_an_impact_at_a_pose_that_is_a_little_off_is_one_event() -> None:
    """The interpolant leaves the joints open; closing them moves the stop beyond its bound."""
    ends = [(0.46601954298361314, -0.1811788772383368), (1.0015733517454977, -0.7053810567211082)]
    hinge = [0.9320390859672263, 0.0, -0.3623577544766736]
    (x, z), (x_1, z_1) = ends
    spin = dict(velocity=[0.1715, 0.0, 0.0348], angular_velocity=[0.0, -0.5, 0.0])
    bounds = dict(lower_deg=-22.918311805232932, upper_deg=28.64788975654116)
    tables = case(
        [
            body("bar0", "planar", 2.0, [x, 0.0, z], [0.1, 0.1667, 0.1]),
            body("bar1", "planar", 1.0, [x_1, 0.0, z_1], [0.1, 0.1667 / 4, 0.1], **spin),
        ],
        2.0,
        joints=[
            joint("hinge0", "revolute", "ground", "bar0", axis=DOWN_Y),
            joint("hinge1", "revolute", "bar0", "bar1", hinge, DOWN_Y),
        ],
        constraints=[stop("stop", "hinge1", 0.5, **bounds)],
    )
    del tables["output"]
    results = run_tables(tables, method="explicit_rk", rtol=1e-3)
    assert 1 <= len(results.impacts["stop"]["time"]) < 20


def test_impacts_report_their_impulses_and_the_energy_they_take() -> None:
    """A ball falls 1 m: v = e^n sqrt(2 g), impulse m (1 + e) v, energy (1 - e^2) m v^2 / 2."""
    results = run_tables(ball(2.5), rtol=1e-8)
    mass, e, speed = 2.0, 0.8, np.sqrt(2.0 * GRAVITY)
    table = results.impacts["floor"]
    fall = np.sqrt(2.0 / GRAVITY)
    flights = [fall * (1.0 + 2.0 * sum(e**k for k in range(1, n + 1))) for n in range(4)]
    times = [t for t in flights if t < 2.5]
    assert table.sizes["impact"] == len(times)
    before = speed * e ** np.arange(len(times))
    np.testing.assert_allclose(table["time"], times, rtol=1e-5)
    np.testing.assert_allclose(table["impulse"], mass * (1 + e) * before, rtol=1e-5)
    lost = 0.5 * mass * (1 - e**2) * before**2
    np.testing.assert_allclose(table["energy_lost"], lost, rtol=1e-5)
    assert table["impulse"].attrs["unit"] == "N s"
    sums = results["constraints/floor/impulse"]
    assert float(sums[0]) == 0.0
    assert float(sums[-1]) == pytest.approx(float(table["impulse"].sum()))
    assert float(results["constraints/floor/energy_lost"][-1]) == pytest.approx(float(lost.sum()))
    line = f"floor: struck {len(times)} times, largest impulse {mass * (1 + e) * speed:.4g} N s"
    assert line in results.summary()
    assert not [name for name in results if name.startswith("impacts/")]


def test_a_contact_time_tells_the_peak_force() -> None:
    """Half a sine of the length T and the impulse J: pi J / 2 T. The motion stays the same."""
    results = run_tables(ball(1.0, contact_time=0.02), rtol=1e-8)
    table = results.impacts["floor"]
    largest = 2.0 * 1.8 * np.sqrt(2.0 * GRAVITY)  # N s
    np.testing.assert_allclose(table["impulse"][0], largest, rtol=1e-5)
    np.testing.assert_allclose(table["peak_force"], np.pi * table["impulse"] / 0.04, rtol=1e-12)
    assert table["peak_force"].attrs["unit"] == "N"
    assert f"peak force {np.pi * largest / 0.04:.4g} N" in results.summary()
    plain = run_tables(ball(1.0), rtol=1e-8)
    assert "peak_force" not in plain.impacts["floor"]
    np.testing.assert_array_equal(
        plain["bodies/ball/position"].values, results["bodies/ball/position"].values
    )


@pytest.mark.parametrize("method", ["gauss", "lobatto_iiic"])
def test_low_orders_locate_impacts_on_a_parabola(method: str) -> None:
    """Of order 2 the velocities are a line in each step, and a fall is exact."""
    results = run_tables(ball(2.0), method=method, order=2, step=0.05)
    z = np.asarray(results["bodies/ball/position"].values)[:, 2]
    np.testing.assert_allclose(z, bounces(results.time, 0.8), atol=1e-6)
