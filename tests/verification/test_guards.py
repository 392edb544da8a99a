"""The guards of a run: energy lost at singular poses, gaps that change the branch."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.attack.parts import body, case, spring
from tests.verification.blocks import run_tables

import hydrodae

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / "cases" / "benchmarks"
FLAPS = ROOT / "cases" / "f3of" / "flap_decay.toml"
RATE = 2.0  # rad/s


@pytest.mark.parametrize("method", ["lobatto_iiic", "gauss"])
def test_stiff_springs_that_hardly_move_do_not_stop_an_implicit_method(method: str) -> None:
    """A second mass on a spring of 1e6 N/m swings by 1e-5 m at 1000 rad/s: 50 rad a step."""
    at = [1.0, 0.0, 0.0]
    lever = dict(type="mooring_matrix", name="spring", body="mass")
    tables = case(
        [
            body(n, "surge", 2.0, x, displacement=at)
            for n, x in (("mass", [0.0] * 3), ("second", at))
        ],
        3.0,
        forces=[
            lever | {"stiffness": [2.0 * RATE**2, 0.0, 0.0, 0.0, 0.0, 0.0]},
            spring("stiff", "mass", "second", [0.0] * 3, at, 1.0e6),
        ],
        samples=30,
    )
    results = run_tables(tables, method=method, step=0.05)
    both = RATE / np.sqrt(2.0)
    place = results["bodies/second/position"].values[:, 0]
    assert np.abs(place - 1.0 - np.cos(both * results.time)).max() < 1e-4


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


def hang(stiffness: float, load: float, stretch: float) -> hydrodae.Results:
    """Three seconds of 3 t on 10 m of undamped rope, pushed from the side, at rtol 1e-3."""
    low, weight = [0.0, 0.0, -10.0], 3000.0 * 9.81
    rope = spring("rope", "ground", "weight", [0.0] * 3, low, stiffness)
    push = dict(type="constant_load", name="push", body="weight", force=[load, 0.0, 0.0])
    tables = case(
        [body("weight", "point", 3000.0, low)],
        3.0,
        gravity=9.81,
        forces=[rope | {"length": 10.0 - weight / stiffness - stretch}, push],
    )
    return run_tables(tables, method="explicit_rk", rtol=1e-3)


@pytest.mark.parametrize(("stiffness", "load", "stretch"), [(2e7, 1.0, 0.0), (2e9, 1000.0, 1e-4)])
def test_errors_within_the_tolerance_may_stretch_a_stiff_rope(
    stiffness: float, load: float, stretch: float
) -> None:
    """The stretch is a thousandth of the way to the side, and holds more energy than the swing."""
    results = hang(stiffness, load, stretch)
    swing = 10.0 * load / (3000.0 * 9.81) * (1.0 - np.cos(np.sqrt(0.981) * results.time))
    place = results["bodies/weight/position"].values[:, 0]
    assert np.abs(place - swing).max() < 2e-2 * swing.max()


def test_a_vibration_that_the_method_damps_is_stopped() -> None:
    """Hardly pushed, the weight only vibrates, by 0.1 mm, and a tenth of the energy is lost."""
    with pytest.raises(hydrodae.SolverError, match="energy balance"):
        hang(2e9, 0.1, 1e-4)
