"""Going on from a state equals coming back to it, bit for bit, for each method and kind of past."""

from __future__ import annotations

import copy
import pickle
import random
from pathlib import Path

import numpy as np
import pytest
from tests.scenes import cart, table

import hydrodae
from hydrodae import Simulation

METHODS = {
    "auto": {},
    "ida": {},
    "radau": {},
    "explicit_rk": {},
    "generalized_alpha": {"solver.step": 0.01},
    "gauss": {"solver.step": 0.02},
    "lobatto_iiic": {"solver.step": 0.02},
}

CART = cart(
    "stiffness = 200.0\ndamping = 2.0", name="spring", solver="end_time = 6.0", step=0.1, title=""
)
STOP = table("constraint", name="wall", type="stop", joint="slide", lower=-0.3, restitution=0.7)
FRICTION = table("force", name="dry", type="dry_friction", joint="slide", static=6.0)
DELAY = table("force", name="late", type="pto_linear", joint="slide", damping=3.0, delay=0.3)
STRUCK = """
[[joint]]
name = "guide"
type = "prismatic"
body_a = "ground"
body_b = "sphere"
point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
[[constraint]]
name = "end"
type = "stop"
joint = "guide"
lower = -0.4
restitution = 0.5
"""
ON_CART = {"spring": "", "stop": STOP, "friction": FRICTION, "delay": DELAY}
AT_SEA = ("memory", "convolution", "struck")
SCENES = (*ON_CART, *AT_SEA, "top", "loop", "drift")


def scene(name: str, method: str, repository: Path) -> tuple[hydrodae.Case, dict[str, object]]:
    """A case of what has a past, and the values to run it with."""
    values: dict[str, object] = {"solver.method": method, **METHODS[method]}
    if name in AT_SEA:
        if name != "memory":
            values["hydro.radiation"] = "convolution"
        values["solver.end_time"] = 6.0
        if "solver.step" in values:
            values["solver.step"] = 0.04
        text = (repository / "cases" / "sphere" / "decay.toml").read_text()
        more = STRUCK if name == "struck" else ""
        return hydrodae.Case.from_text(text + more, repository / "cases" / "sphere"), values
    if name in ("top", "loop", "drift"):
        file = "heavy_top" if name == "top" else "n_four_bar_2"
        if name == "drift":
            values["solver.formulation"] = "index_1"
        case = hydrodae.Case.read(repository / "cases" / "benchmarks" / f"{file}.toml")
        if "solver.step" in values:
            values["solver.step"] = 0.002
        return case, {**values, "solver.end_time": 1.0}
    return hydrodae.Case.from_text(CART + ON_CART[name]), values


def follow(simulation: Simulation, steps: int) -> list[tuple[float, bytes]]:
    """Times and results of some steps."""
    out = []
    for _ in range(steps):
        time = simulation.advance()
        values = [np.atleast_1d(simulation.read(name)) for name in simulation.channels]
        out.append((time, np.concatenate(values).tobytes()))
    return out


def combinations() -> list[tuple[str, str]]:
    """Scenes and methods; three methods have a formulation of their own."""
    own = {"auto", "generalized_alpha", "explicit_rk"}
    return [(n, m) for n in SCENES for m in METHODS if n != "drift" or m not in own]


@pytest.mark.parametrize(("name", "method"), combinations())
def test_going_on_equals_coming_back(name: str, method: str, repository: Path) -> None:
    case, values = scene(name, method, repository)
    simulation = Simulation(case, set=values)
    other = Simulation(case, set=values)
    for steps in (0, 7, 30):
        for _ in range(steps):
            simulation.advance()
        state = simulation.state()
        again = simulation.state()
        assert state.y.tobytes() == again.y.tobytes()
        assert state.yp.tobytes() == again.yp.tobytes()
        simulation.restore(state)
        went_on = follow(simulation, 25)
        after = simulation.state()
        simulation.restore(state)
        assert follow(simulation, 25) == went_on
        assert simulation.state() == after
        other.restore(pickle.loads(pickle.dumps(state)))
        assert follow(other, 25) == went_on
        assert other.state() == after


def shipped() -> list[str]:
    """Cases of the repository, by their path below cases/."""
    folder = Path(__file__).resolve().parents[2] / "cases"
    return sorted(str(file.relative_to(folder)) for file in folder.rglob("*.toml"))


@pytest.mark.parametrize("name", shipped())
def test_a_copy_of_a_state_goes_on_in_every_case(name: str, repository: Path) -> None:
    """A copy from the middle of a run goes on in it, and in another run of the same case."""
    file = repository / "cases" / name
    text = file.read_text()
    try:
        case = hydrodae.Case.read(file)
        if "body" not in text or "tcp" in text:
            pytest.skip("no run of its own")
        one, other = Simulation(case), Simulation(case)
    except hydrodae.CaseError as error:
        pytest.skip(str(error))  # its database is made first, or it is a part of others
    for _ in range(20):
        one.advance()
    state = copy.copy(one.state())
    went_on = follow(one, 10)
    after = one.state()
    other.advance()
    other.restore(state)
    assert follow(other, 10) == went_on
    assert other.state() == after
    one.restore(state)
    assert follow(one, 10) == went_on


@pytest.mark.parametrize("method", METHODS)
def test_a_thousand_rollbacks_leave_no_trace(method: str, repository: Path) -> None:
    name = {"ida": "stop", "radau": "friction", "explicit_rk": "delay"}.get(method, "stop")
    case, values = scene(name, method, repository)
    values["solver.end_time"] = 0.8 if method == "ida" else 2.0  # which restarts with small steps
    undisturbed = Simulation(case, set=values)
    states, gap = [undisturbed.state()], 3
    while not undisturbed.finished:
        for _ in range(gap):
            undisturbed.advance()
        states.append(undisturbed.state())
    simulation = Simulation(case, set=values)
    chance = random.Random(1)
    for _ in range(1000):
        at = chance.randrange(len(states) - 1)
        simulation.restore(states[at])
        for _ in range(chance.randint(0, gap)):  # go on some steps, and leave them
            simulation.advance()
    for at in (0, len(states) // 2):
        simulation.restore(states[at])
        for state in states[at + 1 :]:
            for _ in range(gap):
                simulation.advance()
            assert simulation.state() == state
    assert simulation.finished


@pytest.mark.parametrize("method", METHODS)
def test_states_leave_the_motion_within_the_tolerance(method: str, repository: Path) -> None:
    """A swing of the undamped cart through many states, against the closed form."""
    case, values = scene("spring", method, repository)
    values |= {"force.spring.damping": 0.0, "solver.end_time": 3.0, "solver.rtol": 1e-8}
    if "solver.step" in values:
        values["solver.step"] = 0.002
    simulation = Simulation(case, set=values)
    while not simulation.finished:
        for _ in range(10):
            simulation.advance()
        simulation.state()
        exact = 0.5 * np.cos(10.0 * simulation.time)
        tolerance = 1e-3 if method == "generalized_alpha" else 1e-5
        assert simulation.read("joints/slide/displacement") == pytest.approx(exact, abs=tolerance)
