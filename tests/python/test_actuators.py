"""Controllers that switch, machines that lag, and rotary power take-offs as inputs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq
from tests.errors import wrong
from tests.python.controlled import LATCH, PLACE, RATE, Pi, case, sampled_cart
from tests.scenes import controlled_cart, damped_ball

import hydrodae
from hydrodae import Case, CaseError, Simulation

METHODS = ["radau", "ida", "explicit_rk", "auto"]


def test_a_bang_bang_keeps_its_value_within_its_band() -> None:
    results = hydrodae.run(
        case("bang_bang", "target = 0.1\nband = 0.2\nlower = -1.0\nupper = 0.5", PLACE)
    )
    held = 0.0

    def law(_t: float, x: float, _v: float) -> float:
        nonlocal held
        e = 0.1 - x
        if held == 0.0 or abs(e) > 0.2:
            held = 0.5 if e >= 0.0 else -1.0
        return held

    exact = sampled_cart(law)
    np.testing.assert_allclose(results["joints/slide/displacement"].values[::2], exact, atol=3e-8)
    changes = np.flatnonzero(np.diff(results["controllers/pi/output"].values))
    assert len(changes) > 3  # it has switched


def lagging_cart(law: Any, lag: float, period: float = 0.1) -> np.ndarray[Any, Any]:
    """x, v and load at the instants: m x'' + k x = f, T f' = u - f, u held, by the exponential."""
    A = np.zeros((4, 4))
    A[:3] = [[0.0, 1.0, 0.0, 0.0], [-4.0, 0.0, 0.5, 0.0], [0.0, 0.0, -1.0 / lag, 1.0 / lag]]
    step = expm(period * A)
    y, out = np.array([0.5, 0.0, 0.0, 0.0]), [[0.5, 0.0, 0.0]]
    for k in range(50):
        y[3] = law(k * period, y[0], y[1])
        y = step @ y
        out.append(y[:3])
    return np.array(out)


LAGGED = "gain_p = 1.3\ngain_i = 0.7\ngain_d = 0.05\nfilter_time = 0.2\nlower = -0.5\nupper = 0.6\n"


@pytest.mark.parametrize("method", METHODS)
def test_a_machine_follows_its_controller_with_a_lag(method: str) -> None:
    given = case("pid", LAGGED + "lag = 0.3")
    given.set("solver.method", method)
    results = hydrodae.run(given)
    law = Pi()
    exact = lagging_cart(lambda t, x, v: law(t, v), 0.3)
    np.testing.assert_allclose(results["joints/slide/displacement"][::2], exact[:, 0], atol=1e-7)
    np.testing.assert_allclose(results["forces/pto/force"][::2], exact[:, 2], atol=1e-6)


def test_a_lagging_run_goes_on_bit_for_bit() -> None:
    given = case("pid", LAGGED + "lag = 0.3\ndelay = 0.17")
    simulation = Simulation(given)
    while simulation.time < 2.13:
        simulation.advance(2.13)
    saved = simulation.state()

    def rest(run: Simulation) -> list[float]:
        out = []
        while run.time < 3.0:
            run.advance(3.0)
            out += [
                float(run.read("joints/slide/displacement")),
                float(run.read("forces/pto/force")),
            ]
        return out

    went_on = rest(simulation)
    simulation.restore(saved)
    assert rest(simulation) == went_on
    other = Simulation(given)
    other.restore(saved)
    assert rest(other) == went_on


def test_a_state_of_the_equations_lags_as_well() -> None:
    """T f' = -k s - c s' - f of a continuous law, within its limit, against the exponential."""
    text = controlled_cart("pid")
    text = text.split("[[controller]]")[0].replace("pto_general", "pto_lagged") + (
        "lag = 0.4\nstiffness = -1.5\ndamping = 2.0\nload_limit = 50.0\n"
        '[solver]\nmethod = "METHOD"\nend_time = 5.0\nrtol = 1e-9\n[output]\nstep = 0.05\n'
    )
    A = np.array([[0.0, 1.0, 0.0], [-4.0, 0.0, 0.5], [1.5 / 0.4, -2.0 / 0.4, -1.0 / 0.4]])
    for method in ("radau", "ida", "auto"):
        results = hydrodae.run(Case.from_text(text.replace("METHOD", method)))
        exact = np.array([expm(A * t) @ [0.5, 0.0, 0.0] for t in results.time])
        np.testing.assert_allclose(results["joints/slide/displacement"], exact[:, 0], atol=1e-7)
        np.testing.assert_allclose(results["forces/pto/machine_load"], exact[:, 2], atol=1e-6)
    limited = text.replace("METHOD", "radau").replace("load_limit = 50.0", "load_limit = 0.2")
    held = hydrodae.run(Case.from_text(limited))["forces/pto/force"].values
    assert 0.15 < abs(held).max() <= 0.2 + 1e-9
    with wrong("force.pto.load_limit"):
        Case.from_text(text.replace("load_limit = 50.0", ""))


def declutched(end: float, damping: float, free: float) -> Any:
    """x(t) of 2 x'' + c x' + 8 x = 0 from x' = 1 at 0; c = 0 for `free` after each standstill."""

    def motion(c: float, x: float, v: float) -> Any:
        A = np.array([[0.0, 1.0], [-4.0, -c / 2.0]])
        return lambda t: expm(A * t) @ [x, v]

    pieces, t, y = [], 0.0, np.array([0.0, 1.0])
    while t < end:
        working = motion(damping, *y)
        stop = brentq(lambda s, f=working: f(s)[1], 0.05, 1.7, xtol=1e-14)
        pieces.append((t, working))
        t, y = t + stop, working(stop)
        loose = motion(0.0, *y)
        pieces.append((t, loose))
        t, y = t + free, loose(free)

    def place(t: float) -> float:
        start, piece = [p for p in pieces if p[0] <= t][-1]
        return float(piece(t - start)[0])

    return place


@pytest.mark.parametrize("method", METHODS)
def test_declutching_frees_the_machine_from_each_standstill(method: str) -> None:
    text = controlled_cart("declutching", period=0.05, keys="engaged = 3.0\nfree_time = 0.4")
    text = text.replace("forces/pto/load", "forces/pto/damping")
    text = text.replace("displacement = [0.5, 0.0, 0.0]", "velocity = [1.0, 0.0, 0.0]")
    text = text.replace('"radau"', f'"{method}"')
    results = hydrodae.run(Case.from_text(text))
    place = declutched(5.0, 3.0, 0.4)
    exact = [place(t) for t in results.time]
    np.testing.assert_allclose(results["joints/slide/displacement"], exact, atol=3e-8)
    assert set(results["controllers/pi/output"].values[1:]) == {0.0, 3.0}


def test_declutching_goes_on_bit_for_bit() -> None:
    text = controlled_cart(
        "declutching", period=0.05, keys="engaged = 3.0\nfree_time = 0.4"
    ).replace("forces/pto/load", "forces/pto/damping")
    simulation = Simulation(Case.from_text(text))
    while simulation.time < 1.1:
        simulation.advance(1.1)
    saved = simulation.state()
    ends = []
    for _ in range(2):
        simulation.restore(saved)
        while simulation.time < 4.0:
            simulation.advance(4.0)
        ends.append(simulation.read("joints/slide/displacement"))
    assert ends[0] == ends[1]


@pytest.mark.parametrize(
    ("type", "keys", "key"),
    [
        ("bang_bang", "upper = 1.0", "lower"),
        ("bang_bang", "lower = 1.0\nupper = 0.0", "lower"),
        ("bang_bang", "lower = 0.0\nupper = 1.0\nband = -1.0", "band"),
        ("declutching", "engaged = 1.0", "free_time"),
        ("declutching", "engaged = 1.0\nfree_time = 0.0", "free_time"),
        ("declutching", "engaged = 1.0\nfree_time = 1.0\ndelay = 1.0", "delay"),
        ("pid", "lag = -1.0", "lag"),
    ],
)
def test_cases_that_are_refused(type: str, keys: str, key: str) -> None:
    with wrong(f"controller.pi.{key}"):
        case(type, keys, RATE)


def test_what_cannot_be_heard_or_lag_is_told() -> None:
    place = case("declutching", "engaged = 1.0\nfree_time = 0.4", PLACE)
    with pytest.raises(CaseError, match=r"is no rate of a joint.*did you mean 'joints/slide/displ"):
        hydrodae.run(place)
    text = controlled_cart("resistive", keys="damping = 1.0\nlag = 0.1")
    text = text.replace("forces/pto/load", "forces/latch/static")
    text = text.replace("[[controller]]", LATCH + "[[controller]]")
    with wrong("controller.pi.outputs"):
        hydrodae.run(Case.from_text(text))


BALL = damped_ball("damping = [0.0, 1.0, 0.0]") + "[solver]\nend_time = 4.0\nrtol = 1e-9\n"


def test_a_rotary_power_take_off_is_driven() -> None:
    """2 theta'' = -K theta - C theta' + u about y: first C, then u as well, then K alone."""
    run = Simulation(Case.from_text(BALL))

    def to(t: float) -> tuple[float, float]:
        while run.time < t:
            run.advance(t)
        return (
            float(run.read("bodies/ball/angular_velocity.y")),
            float(run.read("forces/pto/power_absorbed")),
        )

    assert to(1.0)[0] == pytest.approx(0.3 * math.exp(-0.5), abs=1e-8)
    run.write("forces/pto/moment.y", 0.4)
    expected = 0.4 + (0.3 * math.exp(-0.5) - 0.4) * math.exp(-0.5)
    w, power = to(2.0)
    assert w == pytest.approx(expected, abs=1e-8)
    assert power == pytest.approx((w - 0.4) * w, abs=1e-8)  # -(u - C w) w
    run.write("forces/pto/moment.y", 0.0)
    run.write("forces/pto/damping.y", 0.0)
    run.write("forces/pto/stiffness.y", 2.0)
    theta = 2.0 * math.asin(float(run.read("bodies/ball/orientation.y")))
    assert to(3.0)[0] == pytest.approx(w * math.cos(1.0) - theta * math.sin(1.0), abs=1e-7)
    with pytest.raises(CaseError, match=r"did you mean 'forces/pto/moment\.y'"):
        run.write("forces/pto/moment_y", 0.0)
    with pytest.raises(CaseError, match="at least 0"):
        run.write("forces/pto/damping.x", -1.0)


def test_a_controller_writes_a_moment() -> None:
    controller = """
[[controller]]
type = "resistive"
name = "brake"
inputs = ["bodies/ball/angular_velocity.y"]
outputs = ["forces/pto/moment.y"]
period = 0.1
damping = 1.0
[solver]"""
    text = BALL.replace("damping = [0.0, 1.0, 0.0]", "").replace("[solver]", controller)
    results = hydrodae.run(Case.from_text(text))
    found = results["bodies/ball/angular_velocity"].values[:, 1]
    assert found[-1] == pytest.approx(0.3 * (1.0 - 0.1 / 2.0) ** 40, abs=1e-9)
