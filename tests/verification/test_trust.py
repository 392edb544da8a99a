"""How far a run says that it can be trusted: the estimate of every run, and the second run."""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack import suite
from tests.attack.family import FAMILIES

import hydrodae
from hydrodae.cli import main
from hydrodae.study.stability import Method
from hydrodae.study.stability.grid import PASS, STOPPED, run_cell

SCENES = suite.all_scenes()
PENDULUM = """
title = "a pendulum of 1 m"
[[body]]
name = "bob"
motion = "point"
mass = 1.0
center_of_gravity = [{x}, 0.0, {z}]
[[joint]]
name = "rod"
type = "distance"
body_a = "ground"
body_b = "bob"
point = [0.0, 0.0, 0.0]
point_b = [{x}, 0.0, {z}]
[output]
step = 0.05
"""


def pendulum(angle: float, end: float, **solver: Any) -> hydrodae.Case:
    """Return the case of a pendulum released at an angle [rad]."""
    text = PENDULUM.format(x=np.sin(angle), z=-np.cos(angle))
    return hydrodae.Case(
        text=text, values={f"solver.{k}": v for k, v in {"end_time": end, **solver}.items()}
    )


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize(("scene", "allowed"), [("long_pendulum_1", 10.0), ("oscillator_1", 30.0)])
def test_slow_errors_of_long_runs_are_foreseen(
    scene: str, allowed: float, method: str, tmp_path: Path
) -> None:
    """Loss of energy puts a pendulum out of step, a linear oscillator not."""
    cell = run_cell(SCENES[scene], Method(method, {"method": method, "rtol": 2e-7}), tmp_path, 60.0)
    assert cell.outcome == PASS
    known = suite.ratio(cell)
    assert known is not None
    assert 1.0 / allowed < known < 10.0 or (cell.estimate or 1.0) < 1e-5


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        # errors of one kind, which swings must not seem to take away
        ("oscillator_1", {"method": "generalized_alpha", "step": 0.006}),
        ("oscillator_1", {"method": "ida", "rtol": 1e-6}),
        # next to the upright: the frequency depends much on the amplitude
        ("long_pendulum_3", {"method": "radau", "rtol": 1e-6}),
    ],
)
def test_estimates_of_long_runs_are_right_to_a_factor(
    name: str, keys: dict[str, Any], tmp_path: Path
) -> None:
    method = Method("method", {"rtol": 1e-6, **keys})
    scene = SCENES[name]
    # not only at the extremes, where the phase does not show
    changed = {"solver": {**scene.tables["solver"], "end_time": 400.0}, "output": {"step": 0.37}}
    scene = replace(scene, tables={**scene.tables, **changed})
    cell = run_cell(scene, method, tmp_path, 60.0)
    assert cell.outcome == PASS, cell.reason
    known = suite.ratio(cell)
    assert known is not None
    assert 0.1 < known < 8.0


BOUNCING = """
[[body]]
name = "bob"
motion = "planar"
mass = 1.0
center_of_gravity = [0.0, 0.0, -1.0]
inertia = [0.1, 0.1, 0.1]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "bob"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
initial = { angle_rate = 3.0 }
[[constraint]]
name = "buffer"
type = "stop"
joint = "hinge"
lower_deg = -20.0
upper_deg = 20.0
restitution = 1.0
[solver]
end_time = 40.0
[output]
step = 0.1
"""


BAR = """
[[body]]
name = "bar"
motion = "planar"
mass = 1.0
center_of_gravity = [{x}, 0.0, {z}]
inertia = [0.0833333333333, 0.0833333333333, 0.0833333333333]
[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "bar"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
[output]
step = 0.05
"""
HARDENING = """
[[body]]
name = "block"
motion = "surge"
mass = 1.0
center_of_gravity = [10.0, 0.0, 0.0]
initial = {displacement = [1.0, 0.0, 0.0]}
[[force]]
name = "spring"
type = "spring_damper"
body_a = "ground"
body_b = "block"
point_a = [0.0, 0.0, 0.0]
point_b = [10.0, 0.0, 0.0]
stiffness = 1.0
damping = 0.0
hardening = [0.0, 1.0]
[output]
step = 1.0
"""


MOORED = """
title = "a float, and a light buoy between damped ropes"
[environment]
gravity = 0.0
[[body]]
name = "float"
motion = "point"
mass = 300.0
center_of_gravity = [0.0, 0.0, 0.0]
[body.initial]
velocity = [2.5, 0.3, 1.8]
[[body]]
name = "buoy"
motion = "point"
mass = 1.0
center_of_gravity = [3.0, 0.0, 0.0]
[[force]]
name = "spring"
type = "mooring_matrix"
body = "float"
stiffness = [1200.0, 1500.0, 1900.0, 0.0, 0.0, 0.0]
damping = [20.0, 20.0, 20.0, 0.0, 0.0, 0.0]
[[force]]
name = "near"
type = "rope"
bodies = ["float", "buoy"]
points = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]
stiffness = 300.0
damping = 30.0
pretension = 5.0
[[force]]
name = "far"
type = "rope"
bodies = ["buoy", "ground"]
points = [[3.0, 0.0, 0.0], [6.0, 0.0, 0.0]]
stiffness = 300.0
damping = 30.0
pretension = 5.0
[output]
step = 0.1
"""


def known_ratio(text: str, body: str, **solver: Any) -> float | None:
    """Return the true error over the estimate, or nothing where the run stops."""
    case = hydrodae.Case(text=text, values={f"solver.{k}": v for k, v in solver.items()})
    exact = {"solver.method": "explicit_rk", "solver.rtol": 1e-13, "solver.error_guard": 0.0}
    name = f"bodies/{body}/position"
    truth = np.asarray(hydrodae.run(case, set=exact)[name])
    try:
        results = hydrodae.run(case)
    except hydrodae.SolverError:
        return None
    error = np.abs(np.asarray(results[name]) - truth).max() / np.ptp(truth, axis=0).max()
    return float(error / results.statistics["estimated_error"])


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
@pytest.mark.parametrize("rtol", [1e-5, 1e-6])
def test_a_bar_beside_upright_stops_or_tells_its_error(rtol: float, method: str) -> None:
    """Released 1 mrad beside upright: each fall and return doubles errors ten times over."""
    text = BAR.format(x=0.5 * np.sin(1e-3), z=0.5 * np.cos(1e-3))
    ratio = known_ratio(text, "bar", end_time=12.0, method=method, rtol=rtol)
    assert ratio is None or ratio < 10.0


@pytest.mark.parametrize("method", ["radau", "explicit_rk"])
def test_a_wide_swing_is_not_stopped_and_its_error_is_known(method: str) -> None:
    """2.8 rad from hanging: the growth beside upright comes back in each swing."""
    text = PENDULUM.format(x=np.sin(2.8), z=-np.cos(2.8))
    ratio = known_ratio(text, "bob", end_time=40.0, method=method)
    assert ratio is not None
    assert 0.1 < ratio < 10.0


@pytest.mark.parametrize("rtol", [1e-6, 1e-7])
def test_slow_growth_of_an_undamped_swing_is_not_lost_in_doubts(rtol: float) -> None:
    """A hardening spring, 500 periods: errors of the energy put it out of step."""
    ratio = known_ratio(HARDENING, "block", end_time=2000.0, method="ida", rtol=rtol)
    assert ratio is not None
    assert 0.1 < ratio < 5.0  # 47 where the work of the spring counts as spent


def test_what_ropes_damp_between_mechanisms_is_forgotten() -> None:
    """A light buoy whose ropes go slack: their damping, on no body alone, takes its errors."""
    ratio = known_ratio(MOORED, "buoy", end_time=60.0, method="explicit_rk", rtol=1e-5)
    assert ratio is not None
    assert 0.05 < ratio < 10.0  # 0.03 where only what the buoy itself loses counts


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_errors_are_followed_through_many_impacts(method: str) -> None:
    """A part of the speed that is off puts what bounces off by that part of its way."""
    case = hydrodae.Case(text=BOUNCING)
    exact = hydrodae.run(case, set={"solver.method": "explicit_rk", "solver.rtol": 1e-11})
    results = hydrodae.run(case, set={"solver.method": method, "solver.rtol": 1e-6})
    assert results.statistics["events"] > 150
    difference = np.abs(results["bodies/bob/position"] - exact["bodies/bob/position"])
    error = float(difference.max()) / np.sin(np.deg2rad(20.0))
    assert error / 10.0 < results.statistics["estimated_error"] < 50.0 * error + 1e-5


@pytest.mark.parametrize(
    ("family", "seed", "method"),
    [
        ("slack_pair", 100, Method("radau", {"rtol": 1e-6})),
        ("slack_pair", 103, Method("explicit_rk", {"rtol": 1e-6})),
        ("knocking_pair", 101, Method("explicit_rk", {"rtol": 1e-6})),
        ("knocking_pair", 105, Method("ida", {"rtol": 1e-6})),
        ("knocking_pair", 105, Method("lobatto_iiic", {"order": 6}, 10.0)),
    ],
    ids=lambda value: value.name if isinstance(value, Method) else str(value),
)
def test_growth_at_the_kinks_of_forces_is_seen(
    family: str, seed: int, method: Method, tmp_path: Path
) -> None:
    """Ropes snap, masses knock: the run stops, or its estimate tells the error."""
    cell = run_cell(FAMILIES[family].drawn(seed), method, tmp_path, 30.0)
    assert cell.outcome in (PASS, STOPPED), cell.reason
    if cell.outcome == PASS:
        known = suite.ratio(cell)
        assert known is not None
        assert known < 10.0


def test_a_float_that_topples_tells_its_error(tmp_path: Path) -> None:
    """A squeezed spring holds the sphere upright where steps of radau are 2 rad of the wave."""
    scene = FAMILIES["bistable_float"].make(
        height=0.917, period=7.502, length=5.94, squeeze=1.2947, stiff=5.1, end=200.0
    )
    cell = run_cell(scene, Method("radau", {"rtol": 1e-3}), tmp_path, 30.0)
    assert cell.outcome == STOPPED, cell


def test_a_run_stops_where_it_has_lost_step_with_the_truth() -> None:
    with pytest.raises(hydrodae.SolverError, match="put 'bob' off by about 0"):
        hydrodae.run(pendulum(2.5, 400.0, rtol=1e-4, energy_guard=0.0))


CABLE = """
[environment]
gravity = 9.81
[[body]]
name = "top"
motion = ["surge"]
mass = 10.0
center_of_gravity = [8.0, 0.0, 0.0]
[[constraint]]
type = "coordinate"
name = "hand"
body = "top"
coordinate = "surge"
drive = { amplitude = 1.0, period = 1.5, ramp = 3.0 }
[[force]]
type = "line"
name = "cable"
body_b = "top"
point_a = [0.0, 0.0, 0.0]
point_b = [8.0, 0.0, 0.0]
length = [10.0]
segments = [6]
mass = [1.0]
stiffness = [1e4]
[solver]
end_time = 20.0
"""


def test_lines_are_judged_where_all_bodies_are_driven() -> None:
    """Shaken until it slackens and snaps, a line without damping goes its own way."""
    case = hydrodae.Case(text=CABLE)
    with pytest.raises(hydrodae.SolverError, match="put 'forces/cable' off by about 0"):
        hydrodae.run(case, set={"solver.method": "gauss", "solver.step": 0.01})


def test_the_second_run_sees_lines() -> None:
    settings = {"solver.end_time": 3.0, "solver.rtol": 1e-3}
    results = hydrodae.run(hydrodae.Case(text=CABLE), set=settings, verify=True)
    exact = hydrodae.run(hydrodae.Case(text=CABLE), set=settings | {"solver.rtol": 1e-8})
    places, truth = (r["forces/cable/position"].values for r in (results, exact))
    size = np.linalg.norm((truth - truth[0]).reshape(len(truth), -1, 3), axis=2).max()
    off = np.linalg.norm((places - truth).reshape(len(truth), -1, 3), axis=2).max() / size
    assert results.statistics["verified_error_of"] == "forces/cable"
    assert 0.3 * off < results.statistics["verified_error"] < 3.0 * off


@pytest.mark.parametrize(
    ("name", "method"),
    [
        ("braked_wheel_2", "radau"),  # turns in long steps
        ("gears_3", "radau"),
        ("driven_crank_2", "radau"),  # drives of a constant rate
        ("universal_shaft_2", "radau"),
        ("universal_shaft_3", "ida"),  # starts at rest but for rounding
        ("universal_shaft_4", "ida"),  # guided altogether: its energy is that of the reactions
        ("sleeping_top_2", "ida"),  # spins much more than it nods
        ("shaken_table_2", "ida"),  # comes off the table more slowly than its error
    ],
)
def test_scenes_that_were_wrong_or_stopped_pass(name: str, method: str, tmp_path: Path) -> None:
    cell = run_cell(SCENES[name], Method(method, {"method": method, "rtol": 1e-6}), tmp_path, 20.0)
    assert cell.outcome == PASS, cell.reason


def test_the_second_run_tells_the_error_of_the_first() -> None:
    case = pendulum(1.0, 20.0, rtol=1e-5)
    results = hydrodae.run(case, verify=True)
    exact = hydrodae.run(case, set={"solver.rtol": 1e-11})
    off = np.abs(results["bodies/bob/position"] - exact["bodies/bob/position"]).max()
    size = np.linalg.norm(
        exact["bodies/bob/position"].values - exact["bodies/bob/position"].values[0], axis=1
    ).max()
    verified = results.statistics["verified_error"]
    assert verified == pytest.approx(float(off) / size, rel=0.3)
    assert results.statistics["verified_error_of"] == "bob"
    assert 0.0 < results.statistics["verified_error_time"] <= 20.0
    assert results.statistics["estimated_error"] < 30.0 * verified
    assert f"verified error {verified:.1g} of the motion (bob" in results.summary()
    assert "verified_error" not in hydrodae.run(case).statistics


def test_the_second_run_of_a_fixed_step_has_half_of_it() -> None:
    case = pendulum(1.0, 10.0, method="generalized_alpha", step=0.01)
    halved = hydrodae.run(case, set={"solver.step": 0.005})
    results = hydrodae.run(case, verify=True)
    off = np.abs(results["bodies/bob/position"] - halved["bodies/bob/position"]).max()
    assert results.statistics["verified_error"] == pytest.approx(float(off) / 1.7, rel=0.3)


def test_a_motion_that_is_not_confirmed_is_no_success() -> None:
    """A drive that is another one in the second run."""
    text = """
[[body]]
name = "cart"
motion = "surge"
mass = 1.0
center_of_gravity = [0.0, 0.0, 0.0]
[[constraint]]
type = "coordinate"
name = "motor"
body = "cart"
coordinate = "surge"
drive = { python = true }
[solver]
end_time = 2.0
"""
    runs: list[float] = []

    def drive(t: float) -> tuple[float, float, float]:
        size = 1.0 + 0.5 * len(runs)
        return size * np.sin(t), size * np.cos(t), -size * np.sin(t)

    def progress(time: float, end: float) -> None:
        if time == end:
            runs.append(time)

    case = hydrodae.Case(text=text)
    with pytest.raises(
        hydrodae.SolverError, match=r"not verified: a second run, with rtol"
    ) as stop:
        hydrodae.run(case, verify=True, drives={"motor": drive}, progress=progress)
    assert stop.value.results is not None
    assert stop.value.results.status == "failed"
    assert stop.value.results.end_time == 2.0


def test_both_commands_verify(
    executable: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = tmp_path / "pendulum.toml"
    case.write_text(pendulum(1.0, 5.0).scene.text + "\n[solver]\nend_time = 5.0\n")
    assert main(["run", str(case), "--verify", "-o", str(tmp_path / "a.h5")]) == 0
    assert "verified error" in capsys.readouterr().out
    done = subprocess.run(
        [executable, case, "--verify", "-o", tmp_path / "b.h5"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert ", verified " in done.stdout
