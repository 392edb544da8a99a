"""The guards of a run: estimated errors of fixed steps, energy lost at singular poses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / "cases" / "benchmarks"
FLAPS = ROOT / "cases" / "f3of" / "flap_decay.toml"
RATE = 2.0  # rad/s
OSCILLATOR = f"""
title = "Mass on a spring, whose lever is 1 m"

[[body]]
name = "mass"
motion = "surge"
mass = 2.0
center_of_gravity = [0.0, 0.0, 0.0]
initial.displacement = [1.0, 0.0, 0.0]

[[force]]
type = "mooring_matrix"
name = "spring"
body = "mass"
stiffness = [{2.0 * RATE**2}, 0.0, 0.0, 0.0, 0.0, 0.0]

[solver]
end_time = 3.0

[output]
step = 0.1
"""


@pytest.mark.parametrize(
    ("solver", "step"),
    [
        ({"method": "generalized_alpha"}, 0.02),
        ({"method": "generalized_alpha", "spectral_radius": 0.3}, 0.02),
        ({"method": "radau", "order": 1}, 0.01),
        ({"method": "radau", "order": 3}, 0.1),
        ({"method": "radau", "order": 5}, 0.25),
        ({"method": "radau", "order": 9}, 0.5),
        ({"method": "gauss", "order": 2}, 0.05),
        ({"method": "gauss", "order": 4}, 0.25),
        ({"method": "gauss", "order": 6}, 0.25),
        ({"method": "lobatto_iiic", "order": 2}, 0.05),
        ({"method": "lobatto_iiic", "order": 4}, 0.25),
        ({"method": "lobatto_iiic", "order": 6}, 0.25),
        ({"method": "explicit_rk", "order": 8}, 0.75),
    ],
    ids=str,
)
def test_the_estimated_error_of_fixed_steps_is_the_true_one_within_a_factor(
    solver: dict[str, Any], step: float
) -> None:
    case = hydrodae.Case.from_text(OSCILLATOR)
    values = {f"solver.{key}": value for key, value in {**solver, "step": step}.items()}
    values |= {"solver.rtol": 1e-10, "solver.energy_guard": 0.0, "output.step": step}
    values["solver.error_guard"] = 0.0
    results = hydrodae.run(case, set={**values, "solver.step_guard": 0.0})
    true = abs(results["bodies/mass/position"].values[:, 0] - np.cos(RATE * results.time)).max()
    hydrodae.run(case, set={**values, "solver.step_guard": 8.0 * true})
    with pytest.raises(hydrodae.SolverError, match="too long for the motion of 'mass'"):
        hydrodae.run(case, set={**values, "solver.step_guard": true / 8.0})


def test_the_step_that_a_stopped_run_names_will_do() -> None:
    case = hydrodae.Case.read(BENCHMARKS / "heavy_top.toml")
    values = {"solver.method": "generalized_alpha", "solver.end_time": 2.0, "output.step": 0.02}
    with pytest.raises(hydrodae.SolverError, match=r"solver\.step_guard = 0\.02") as stop:
        hydrodae.run(case, set={**values, "solver.step": 2e-3, "solver.error_guard": 0.0})
    named = float(str(stop.value).split(" s may do")[0].split()[-1])
    assert 1e-4 < named < 2e-3
    hydrodae.run(case, set={**values, "solver.step": named})


@pytest.mark.parametrize("method", ["lobatto_iiic", "gauss"])
def test_stiff_springs_that_hardly_move_do_not_stop_an_implicit_method(method: str) -> None:
    """A second mass on a spring of 1e6 N/m swings by 1e-5 m at 1000 rad/s: 50 rad a step."""
    second = OSCILLATOR.split("[solver]")[0].split("[[body]]")[1].replace('mass"', 'second"')
    spring = (
        '\n[[force]]\ntype = "spring_damper"\nname = "stiff"\nbody_a = "mass"\nbody_b = "second"\n'
        "point_a = [0.0, 0.0, 0.0]\npoint_b = [1.0, 0.0, 0.0]\nstiffness = 1.0e6\n"
    )
    body = "[[body]]" + second.split("[[force]]")[0].replace(
        "[0.0, 0.0, 0.0]", "[1.0, 0.0, 0.0]", 1
    )
    case = hydrodae.Case.from_text(OSCILLATOR.replace("[[force]]", f"{body}\n[[force]]") + spring)
    values = {"solver.method": method, "solver.step": 0.05}
    results = hydrodae.run(case, set=values)
    both = RATE / np.sqrt(2.0)
    assert (
        np.abs(
            results["bodies/second/position"].values[:, 0] - 1.0 - np.cos(both * results.time)
        ).max()
        < 1e-4
    )


def test_an_error_that_shows_after_the_last_looks_ends_the_run() -> None:
    """Runs of few fixed steps end before three looks have seen what piles up."""
    case = hydrodae.Case.from_text(OSCILLATOR)
    values = {"solver.method": "generalized_alpha", "solver.step": 0.1, "solver.step_guard": 0.0}
    assert hydrodae.run(case, set={**values, "solver.end_time": 3.0}).status == "completed"
    with pytest.raises(hydrodae.SolverError, match=r"'mass' off by .* at the end of the run"):
        hydrodae.run(case, set={**values, "solver.end_time": 10.0})


@pytest.mark.parametrize("rtol", [1e-2, 1e-3])
def test_what_stays_at_rest_is_not_off_by_a_part_of_its_motion(rtol: float) -> None:
    """A weight on a spring, which rounding alone moves by 4e-14 m."""
    fixed = ROOT / "cases" / "tank_section" / "fixed.toml"
    results = hydrodae.run(fixed, set={"solver.rtol": rtol, "solver.end_time": 60.0})
    assert results.status == "completed"
    assert results.statistics["at_rest"] == 1


TOP = """
title = "An upright top that spins by 123 rad/s, and leans by 0.002 rad"
[[body]]
name = "top"
mass = 1.0
center_of_gravity = [0.0002, 0.0, 0.0999998]
principal_axes_deg = [0.0, 0.114591559, 0.0]
inertia = [0.004, 0.004, 0.002]
initial.angular_velocity = [0.246, 0.0, 122.999754]
[[joint]]
name = "tip"
type = "spherical"
body_a = "ground"
body_b = "top"
point = [0.0, 0.0, 0.0]
[solver]
end_time = 3.0
[output]
step = 0.05
"""


@pytest.mark.parametrize("method", ["lobatto_iiic", "gauss"])
def test_errors_of_fixed_steps_follow_the_turns_within_them(method: str) -> None:
    """Stages with normalised quaternions hide the coefficient that tells of them."""
    case = hydrodae.Case.from_text(TOP)
    keys: dict[str, Any] = {"solver.method": method, "solver.order": 6, "solver.step_guard": 0.0}
    keys["solver.error_guard"] = 0.0
    long, short = (hydrodae.run(case, set={**keys, "solver.step": h}) for h in (0.012, 0.003))
    places = [run["bodies/top/position"].values[:, :2] for run in (long, short)]
    true = np.linalg.norm(places[0] - places[1], axis=1).max()
    moved = np.linalg.norm(places[1] - places[1][0], axis=1).max()
    assert true > 1e-4 * moved
    assert float(long.statistics["estimated_error"]) > 0.05 * true / moved


def test_estimated_errors_fade_so_that_long_runs_in_water_go_on() -> None:
    values = {"solver.method": "generalized_alpha", "solver.step": 0.2, "solver.end_time": 400.0}
    assert hydrodae.run(FLAPS, set=values).end_time == 400.0


@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
@pytest.mark.parametrize("name", ["door", "bricard"])
def test_rows_that_always_follow_from_others_are_no_singular_pose(name: str, rtol: float) -> None:
    hydrodae.run(BENCHMARKS / f"{name}.toml", set={"solver.rtol": rtol})


@pytest.mark.parametrize("name", ["n_four_bar_2", "slider_crank_equal"])
def test_little_energy_lost_at_a_singular_pose_stops_a_multi_step_method(name: str) -> None:
    with pytest.raises(hydrodae.SolverError, match=r"J exchanged, at a singular pose") as stop:
        hydrodae.run(BENCHMARKS / f"{name}.toml", set={"solver.method": "ida", "solver.rtol": 1e-4})
    lost = abs(float(str(stop.value).split("is off by ")[1].split()[0]))
    assert lost < 0.1  # J, of 30 to 70


@pytest.mark.parametrize(("formulation", "rtol"), [("index_1", 7.7e-4), ("index_2", 2.5e-3)])
def test_gaps_end_a_run_where_they_would_change_its_branch(formulation: str, rtol: float) -> None:
    """Without the guard the slider stays at the dead point, and crank and rod turn on as one."""
    values = {"solver.method": "radau", "solver.formulation": formulation, "solver.rtol": rtol}
    with pytest.raises(hydrodae.SolverError, match=r"have drifted: joints/.* at a singular pose"):
        hydrodae.run(BENCHMARKS / "slider_crank_equal.toml", set=values)


def test_the_guard_of_fixed_steps_is_refused_without_one() -> None:
    with pytest.raises(hydrodae.CaseError, match="belongs to fixed steps"):
        hydrodae.run(BENCHMARKS / "simple_pendulum.toml", set={"solver.step_guard": 0.1})
