"""`method = "auto"`: where it begins, when another method takes over, what is never retried."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack import suite
from tests.errors import wrong
from tests.scenes import cart
from tests.stability import Method, Scene, grid
from tests.stability.grid import PASS, run_cell

import hydrodae
from hydrodae import Simulation

ROOT = Path(__file__).resolve().parents[2]
MAP, ATTACK = grid.all_scenes(), suite.all_scenes()
CART = cart("stiffness = 200.0", solver="end_time = 2.0")


def outcome(scene: Scene, method: str, folder: Path, **solver: Any) -> grid.Cell:
    keys = {"method": method, "rtol": 1e-6, **solver}
    return run_cell(scene, Method(method, keys), folder, 20.0)


def short_of(name: str, end: float, folder: Path) -> hydrodae.Case:
    """Return a scene of the map for another time, at a loose tolerance."""
    tables = {**MAP[name].tables, "solver": {"end_time": end}}
    return replace(MAP[name], tables=tables).case({"rtol": 1e-3}, folder)


def methods_of(case: hydrodae.Case) -> list[str]:
    return str(hydrodae.run(case).statistics["methods"]).split()


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("pendulum", "explicit_rk"),  # nothing is stiff
        ("four_bar", "explicit_rk"),
        ("heavy_top", "explicit_rk"),  # fast, but so is its motion
        ("memory", "explicit_rk"),
        ("stiff_1e9", "radau"),
        ("stiff_1e12", "radau"),
        ("light_joint", "radau"),
        ("long_pendulum", "radau"),  # errors pile up
    ],
)
def test_the_first_method_suits_the_scene(name: str, first: str, tmp_path: Path) -> None:
    case = MAP[name].case({"method": "auto"}, tmp_path)
    assert f"auto begins with {first}, as " in case.examine()
    assert methods_of(case)[0] == first


def test_what_is_dear_to_evaluate_is_evaluated_seldom(tmp_path: Path) -> None:
    text = CART.replace("pto_linear", "python_load").replace("stiffness = 200.0\n", "")
    told = hydrodae.check(hydrodae.Case.from_text(text), forces={"pto": lambda t, x, v: -x})
    assert "auto begins with radau, as a force of Python is expensive to evaluate" in told
    told = ATTACK["path_bump_1"].case({}, tmp_path).examine()
    assert "auto begins with radau, as a path is expensive to evaluate" in told


@pytest.mark.parametrize("name", ["door", "memory", "snap", "stick_slip", "late_damper"])
def test_where_nothing_fails_the_run_is_that_of_the_method(name: str, tmp_path: Path) -> None:
    """Bit for bit: the choice costs nothing, and changes nothing."""
    scene = MAP[name]
    runs = [hydrodae.run(scene.case({"method": m}, tmp_path)) for m in ("auto", "explicit_rk")]
    auto, named = runs
    assert auto.statistics["steps"] == named.statistics["steps"]
    assert auto.statistics["method"] == "auto"
    assert auto.statistics["method_in_use"] == named.statistics["method_in_use"] == "explicit_rk"
    for channel in named.channels("*"):
        np.testing.assert_array_equal(auto[channel].values, named[channel].values, channel)


def test_a_stiff_scene_is_made_by_radau(tmp_path: Path) -> None:
    scene = MAP["stiff_1e9"]
    assert outcome(scene, "auto", tmp_path).outcome == PASS
    results = hydrodae.run(scene.case({"method": "auto"}, tmp_path))
    assert results.statistics["method_in_use"] == "radau"


def test_where_explicit_rk_loses_energy_another_method_goes_on(tmp_path: Path) -> None:
    """The guard ends explicit_rk by itself; `auto` leaves it before. The summary has the reason."""
    scene = suite.all_scenes((303,))["oscillator_s303"]
    loose = {"rtol": 1e-2}
    assert "energy_guard" in outcome(scene, "explicit_rk", tmp_path, **loose).reason
    assert outcome(scene, "auto", tmp_path, **loose).outcome == PASS
    results = hydrodae.run(scene.case({"method": "auto", **loose}, tmp_path))
    assert str(results.statistics["methods"]).split()[-2:] == ["explicit_rk", "radau"]
    since = float(str(results.statistics["method_from"]).split()[-1])
    assert 0.0 < since < results.end_time
    assert results.statistics["method_in_use"] == "radau"
    line = next(row for row in results.summary().splitlines() if "method auto" in row)
    assert f"radau from t = {since:.9g} s because" in line


HANGING = """
[[body]]
name = "bob"
motion = "planar"
mass = 0.7
center_of_gravity = [0.1, 0.3, -0.727]
inertia = [1e-6, 1e-6, 1e-6]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "bob"
point = [0.1, 0.3, -0.7]
axis = [0.0, 1.0, 0.0]
[solver]
method = "explicit_rk"
end_time = 1e4
[output]
step = 100.0
"""


def test_an_explicit_step_at_rest_stays_stable() -> None:
    """Steps of many periods (0.33 s) made a motion from the rounding of a pendulum that hangs."""
    results = hydrodae.run(hydrodae.Case.from_text(HANGING))
    assert results.end_time == 1e4
    assert int(results.statistics["steps"]) > 1e4 / 0.33
    assert np.abs(results["bodies/bob/velocity"].values).max() < 1e-9


def labouring() -> Simulation:
    """A cart whose damper becomes stiff at t = 0.5 s."""
    simulation = Simulation(hydrodae.Case.from_text(CART))
    while simulation.time < 0.5:
        simulation.advance(0.5)
    simulation.write("forces/pto/damping", 1e6)
    return simulation


def test_a_scene_that_becomes_stiff_is_left_to_radau() -> None:
    """The cart stops, and creeps by exp(-k t / c)."""
    simulation, steps = labouring(), 0
    x = float(simulation.read("joints/slide/displacement"))
    while not simulation.finished:
        simulation.advance()
        steps += 1
    assert steps < 500  # 1.2e5 of explicit_rk
    slow = np.exp(-200.0 / 1e6 * 1.5)
    assert simulation.read("joints/slide/displacement") == pytest.approx(x * slow, abs=2e-4)
    assert simulation.read("solver/order") in (5.0, 9.0, 13.0)


def test_states_before_and_after_a_change_of_method(tmp_path: Path) -> None:
    """Going back over the change and on again is the same run, also in another process."""
    simulation = labouring()
    before = simulation.state()
    ways = []
    for _ in range(2):
        times = [simulation.advance() for _ in range(70)]
        ways.append((times, simulation.state()))
        simulation.restore(pickle.loads(pickle.dumps(before)))
    assert ways[0] == ways[1]
    after = ways[0][1]
    other = Simulation(hydrodae.Case.from_text(CART))
    other.restore(after)
    simulation.restore(after)
    assert [other.advance() for _ in range(20)] == [simulation.advance() for _ in range(20)]
    assert other.state() == simulation.state()
    other.restore(before)
    assert [other.advance() for _ in range(70)] == ways[0][0]


def test_a_lock_stops_every_method_and_the_message_names_them(tmp_path: Path) -> None:
    """Without the guards that would end the run before any method gives up."""
    unguarded = {"branch_guard": False, "energy_guard": 0.0}
    with pytest.raises(hydrodae.SolverError, match="no method") as caught:
        hydrodae.run(MAP["lock"].case({"method": "auto", **unguarded}, tmp_path))
    line = str(caught.value).splitlines()[0]
    for name in ("explicit_rk", "radau", "ida"):
        assert line.count(f"{name} at t = 0.523") == 1
    assert caught.value.results is not None
    assert caught.value.results.statistics["method_in_use"] == "ida"


@pytest.mark.parametrize(
    ("key", "value"),
    [("order", 8), ("step", 0.01), ("formulation", "index_2"), ("max_order", 3)],
)
def test_keys_that_ask_for_a_method_by_name(key: str, value: Any) -> None:
    with wrong(f"solver.{key}"):
        hydrodae.run(hydrodae.Case.from_text(CART), set={f"solver.{key}": value})
