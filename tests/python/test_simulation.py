"""`hydrodae.Simulation`: steps, limits, reading and writing by name."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest
from tests import scenes
from tests.errors import stopped

import hydrodae
from hydrodae import CaseError, Simulation

CART = scenes.cart(
    "stiffness = 200.0",
    more='[[force]]\nname = "push"\ntype = "constant_load"\nbody = "cart"',
    solver="end_time = 2.0\nrtol = 1e-9",
)
METHODS: dict[str, dict[str, Any]] = {
    "auto": {},
    "ida": {},
    "radau": {},
    "explicit_rk": {},
    "gauss": {"solver.step": 0.007},
}


def cart(method: str = "radau", **values: object) -> Simulation:
    case = hydrodae.Case.from_text(CART)
    return Simulation(case, set={"solver.method": method, **METHODS[method], **values})


def to_the_end(simulation: Simulation) -> None:
    while not simulation.finished:
        simulation.advance()


@pytest.mark.parametrize("method", METHODS)
def test_steps_end_at_their_limit(method: str) -> None:
    simulation = cart(method)
    assert simulation.time == 0.0
    for k in range(1, 41):
        limit = 0.05 * k
        while simulation.time < limit:
            assert simulation.time < simulation.advance(limit) <= limit
        assert simulation.time == min(limit, 2.0)
        x = simulation.read("joints/slide/displacement")
        assert x == pytest.approx(0.5 * np.cos(10.0 * limit), abs=1e-6)
    assert simulation.finished
    assert simulation.advance() == simulation.end_time == 2.0


@pytest.mark.parametrize("method", METHODS)
def test_the_steps_are_those_of_a_run(method: str) -> None:
    """Rows of a results file between two steps equal what a simulation reads at their ends."""
    case = hydrodae.Case.from_text(CART)
    values = {"solver.method": method, **METHODS[method]}
    simulation = Simulation(case, set=values)
    steps = 0
    while not simulation.finished:
        simulation.advance()
        steps += 1
    results = hydrodae.run(case, set=values)
    assert results.statistics["steps"] == steps
    for name in simulation.channels:
        np.testing.assert_array_equal(simulation.read(name), results[name].values[-1], name)


def test_reading_changes_nothing() -> None:
    a, b = cart(), cart()
    while not a.finished:
        assert a.advance() == b.advance()
        for name in a.channels:
            a.read(name)
    assert a.state() == b.state()
    position = a.read("bodies/cart/position")
    assert isinstance(position, np.ndarray)
    assert position.shape == (3,)
    assert a.channels["bodies/cart/position"] == "m"
    with pytest.raises(CaseError, match="did you mean 'bodies/cart/position'"):
        a.read("bodies/cart/positon")


@pytest.mark.parametrize("method", METHODS)
def test_a_force_is_held_from_a_write_on(method: str) -> None:
    """Over the first half the load -k x0 more holds the cart where it starts; then it swings."""
    simulation = cart(method)
    assert simulation.inputs["forces/pto/stiffness"] == 200.0
    simulation.write("forces/push/force.x", 100.0)
    while simulation.time < 1.0:
        simulation.advance(1.0)
        assert simulation.read("joints/slide/displacement") == pytest.approx(0.5, abs=1e-12)
    simulation.write("forces/push/force.x", 0.0)
    assert simulation.read("bodies/cart/acceleration")[0] == pytest.approx(-50.0)  # type: ignore[index]
    while not simulation.finished:
        simulation.advance()
        exact = 0.5 * np.cos(10.0 * (simulation.time - 1.0))
        assert simulation.read("joints/slide/displacement") == pytest.approx(exact, abs=1e-5)
    assert simulation.read("energy/balance_error") == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize("method", METHODS)
def test_a_motor_takes_another_rate_at_once(method: str) -> None:
    """The cart follows the rate; what its mass and the spring take is the work of the motor."""
    motor = """
[[constraint]]
name = "motor"
type = "coordinate"
joint = "slide"
level = "velocity"
drive = { constant = 0.0 }
"""
    case = hydrodae.Case.from_text(CART.replace("[solver]", motor + "[solver]"))
    values = {"solver.method": method, **METHODS[method], "solver.time_scale": 0.1}  # at rest first
    simulation = Simulation(case, set=values)
    x, time = 0.5, 0.0
    for rate in (0.3, -0.5, 0.0, 1.0):
        simulation.write("constraints/motor/rate", rate)
        assert simulation.read("joints/slide/displacement_rate") == pytest.approx(rate, abs=1e-12)
        time += 0.25
        while simulation.time < time:
            simulation.advance(time)
        x += 0.25 * rate
        assert simulation.read("joints/slide/displacement") == pytest.approx(x, abs=1e-9)
        stored = 0.5 * 2.0 * rate**2 + 100.0 * (x**2 - 0.25)
        assert simulation.read("energy/work/constraints") == pytest.approx(stored, abs=1e-6)
        assert simulation.read("energy/balance_error") == pytest.approx(0.0, abs=1e-7)


def test_writing_what_holds_changes_nothing() -> None:
    a, b = cart(), cart()
    while not a.finished:
        a.write("forces/pto/damping", 0.0)
        assert a.advance() == b.advance()
    assert a.state() == b.state()


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("forces/pto/dampng", 1.0, "did you mean 'forces/pto/damping'"),
        ("forces/pto/damping", -1.0, "at least 0, got -1"),
        ("forces/pto/neutral", float("nan"), "expected a finite number"),
    ],
)
def test_refused_inputs(name: str, value: float, message: str) -> None:
    with pytest.raises(CaseError, match=message):
        cart().write(name, value)


def test_states_are_values_of_their_case() -> None:
    simulation = cart()
    simulation.advance(0.3)
    simulation.write("forces/pto/damping", 5.0)
    state = simulation.state()
    assert state.time == simulation.time
    assert state.y.shape == state.yp.shape
    for same in (copy.copy(state), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
        assert same == state
    simulation.advance()
    assert simulation.state() != state
    other = cart()
    other.restore(state)
    assert other.inputs["forces/pto/damping"] == 5.0
    with pytest.raises(CaseError, match="another case"):
        cart("ida").restore(state)
    kind: Any = type(state)
    with pytest.raises(hydrodae.HydrodaeError, match="no state"):
        kind.__setstate__(kind.__new__(kind), b"something")


def test_a_failed_step_can_be_taken_back() -> None:
    """A guard that stops a run with steps too long, and shorter ones instead."""
    loses = {"solver.step": 0.1, "solver.energy_guard": 1e-6, "solver.method": "generalized_alpha"}
    simulation = Simulation(hydrodae.Case.from_text(CART), set=loses)
    state = simulation.state()
    with stopped("energy"):
        to_the_end(simulation)
    for way_on in (simulation.advance, simulation.state):
        with stopped("state"):
            way_on()
    simulation.restore(state)
    assert simulation.time == 0.0
    assert simulation.advance(1e-4) == 1e-4
