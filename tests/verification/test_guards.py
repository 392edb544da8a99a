"""The guards of a run: energy lost at singular poses, gaps that change the branch."""

from __future__ import annotations

from pathlib import Path

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


@pytest.mark.parametrize("rtol", [1e-2, 1e-3])
def test_what_stays_at_rest_is_not_off_by_a_part_of_its_motion(rtol: float) -> None:
    """A weight on a spring, which rounding alone moves by 4e-14 m."""
    fixed = ROOT / "cases" / "tank_section" / "fixed.toml"
    results = hydrodae.run(fixed, set={"solver.rtol": rtol, "solver.end_time": 60.0})
    assert results.status == "completed"
    assert results.statistics["at_rest"] == 1


def test_long_runs_of_fixed_steps_in_water_go_on() -> None:
    values = {"solver.method": "generalized_alpha", "solver.step": 0.2, "solver.end_time": 400.0}
    assert hydrodae.run(FLAPS, set=values).end_time == 400.0


@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
@pytest.mark.parametrize("name", ["door", "bricard"])
def test_rows_that_always_follow_from_others_are_no_singular_pose(name: str, rtol: float) -> None:
    hydrodae.run(BENCHMARKS / f"{name}.toml", set={"solver.rtol": rtol})


@pytest.mark.parametrize("rtol", [1e-6, 1e-5])
def test_a_multi_step_method_that_passes_singular_poses_goes_on(rtol: float) -> None:
    """It loses a hundred-thousandth of the energy there, and tells how far off it is."""
    scene = BENCHMARKS / "n_four_bar_2.toml"
    found = hydrodae.run(scene, set={"solver.method": "ida", "solver.rtol": rtol})
    truth = hydrodae.run(scene, set={"solver.method": "radau", "solver.rtol": 1e-11})
    place = "bodies/top0/position"
    error = np.abs(found[place].values - truth[place].values).max()
    estimate = found.accuracy()["top0"].error.max()
    assert 0.1 < estimate / error < 10.0


@pytest.mark.parametrize(("formulation", "rtol"), [("index_1", 7.7e-4), ("index_2", 2.5e-3)])
def test_gaps_end_a_run_where_they_would_change_its_branch(formulation: str, rtol: float) -> None:
    """Without the guard the slider stays at the dead point, and crank and rod turn on as one."""
    values = {"solver.method": "radau", "solver.formulation": formulation, "solver.rtol": rtol}
    with pytest.raises(hydrodae.SolverError, match=r"have drifted: joints/.* at a singular pose"):
        hydrodae.run(BENCHMARKS / "slider_crank_equal.toml", set=values)
