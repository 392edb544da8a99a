"""Orders of convergence of the integrators, the scenes where methods fail, and what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.scenes import four_bar_windows

import hydrodae

ROOT = Path(__file__).resolve().parents[2]
PENDULUM = ROOT / "cases" / "benchmarks" / "simple_pendulum.toml"
FOUR_BAR = ROOT / "cases" / "benchmarks" / "n_four_bar_2.toml"
FLAPS = ROOT / "cases" / "f3of" / "flap_decay.toml"
BOB = ("bodies/bob/position", "bodies/bob/velocity")
HINGES = ("joints/hinge1/angle", "joints/hinge2/angle")


def at_end(
    case: Path | hydrodae.Case, channels: tuple[str, ...], end_time: float, **solver: Any
) -> NDArray:
    """Values of the channels at the end of a run."""
    values = {f"solver.{key}": value for key, value in solver.items()}
    values |= {"solver.end_time": end_time, "output.step": end_time}
    results = hydrodae.run(case, set=values)
    return np.concatenate([np.ravel(results[name].values[-1]) for name in channels])


def order(
    case: Path,
    channels: tuple[str, ...],
    end_time: float,
    steps: tuple[float, float],
    reference: NDArray,
    **solver: Any,
) -> float:
    """Observed order from the errors at the end for two steps."""
    errors = [
        abs(at_end(case, channels, end_time, step=h, rtol=1e-13, **solver) - reference).max()
        for h in steps
    ]
    return float(np.log(errors[0] / errors[1]) / np.log(steps[0] / steps[1]))


@pytest.fixture(scope="module")
def pendulum_end() -> NDArray:
    return at_end(PENDULUM, BOB, 5.0, method="explicit_rk", rtol=1e-13)


@pytest.fixture(scope="module")
def flaps_end() -> NDArray:
    return at_end(FLAPS, HINGES, 40.0, method="radau", order=13, rtol=1e-13)


@pytest.mark.parametrize(
    ("solver", "steps", "theory", "band"),
    [
        ({"method": "radau", "order": 3}, (0.02, 0.01), 3, 0.3),
        ({"method": "radau", "order": 5}, (0.025, 0.0125), 5, 0.3),
        ({"method": "radau", "order": 9}, (0.125, 0.1), 9, 0.3),
        ({"method": "radau", "order": 13}, (0.25, 0.2), 13, 1.0),
        ({"method": "gauss", "order": 4}, (0.025, 0.0125), 4, 0.3),
        ({"method": "gauss", "order": 6}, (0.05, 0.025), 6, 0.3),
        ({"method": "lobatto_iiic", "order": 4}, (0.025, 0.0125), 4, 0.3),
        ({"method": "explicit_rk", "order": 5}, (0.04, 0.02), 5, 0.3),
        ({"method": "generalized_alpha"}, (0.005, 0.0025), 2, 0.1),
        ({"method": "radau", "order": 5, "formulation": "index_2"}, (0.025, 0.0125), 5, 0.3),
        # On index 3 the velocities of an s-stage method are of order s only (Hairer, Lubich and
        # Roche, The Numerical Solution of DAE Systems by Runge-Kutta Methods (1989), table 2.3).
        ({"method": "radau", "order": 5, "formulation": "index_3"}, (0.025, 0.0125), 3, 0.3),
    ],
    ids=str,
)
def test_order_on_the_pendulum(
    solver: dict[str, Any],
    steps: tuple[float, float],
    theory: int,
    band: float,
    pendulum_end: NDArray,
) -> None:
    measured = order(PENDULUM, BOB, 5.0, steps, pendulum_end, **solver)
    assert measured == pytest.approx(theory, abs=band)


def test_explicit_order_8_on_the_pendulum_is_at_least_8(pendulum_end: NDArray) -> None:
    """The leading error term happens to be small here: the observed order is above 8."""
    method = {"method": "explicit_rk", "order": 8}
    assert order(PENDULUM, BOB, 5.0, (0.1, 0.05), pendulum_end, **method) > 7.7


@pytest.mark.parametrize(
    ("solver", "steps", "theory", "band"),
    [
        ({"method": "radau", "order": 3}, (0.1, 0.05), 3, 0.3),
        ({"method": "radau", "order": 5}, (0.25, 0.125), 5, 0.3),
        ({"method": "radau", "order": 9}, (0.8, 0.5), 9, 0.3),
        ({"method": "radau", "order": 13}, (1.6, 1.25), 13, 1.0),
        ({"method": "explicit_rk", "order": 8}, (0.8, 0.4), 8, 0.7),
        ({"method": "generalized_alpha"}, (0.05, 0.025), 2, 0.1),
    ],
    ids=str,
)
def test_order_on_the_flaps_with_memory(
    solver: dict[str, Any], steps: tuple[float, float], theory: int, band: float, flaps_end: NDArray
) -> None:
    measured = order(FLAPS, HINGES, 40.0, steps, flaps_end, **solver)
    assert measured == pytest.approx(theory, abs=band)


def test_radau_of_order_13_reaches_1e_9_in_200_steps() -> None:
    exact = at_end(PENDULUM, BOB, 10.0, method="explicit_rk", rtol=1e-13)
    values = {"solver.method": "radau", "solver.order": 13, "solver.step": 0.05}
    results = hydrodae.run(PENDULUM, set=values | {"solver.rtol": 1e-11})
    end = np.concatenate([np.ravel(results[name].values[-1]) for name in BOB])
    assert results.statistics["steps"] <= 200
    assert abs(end - exact).max() <= 1e-9


@pytest.mark.parametrize("order", [0, 13])
@pytest.mark.parametrize("case", ["bricard", "andrews"])
def test_radau_keeps_to_simplified_newton_in_loops(case: str, order: int) -> None:
    """One Jacobian a step, not one a stage and iteration: shorter steps cost less than full Newton
    where no pose is singular (Bricard's linkage has a redundant row in all of them)."""
    values = {"solver.method": "radau", "solver.order": order, "solver.rtol": 1e-6}
    statistics = hydrodae.run(FOUR_BAR.with_name(f"{case}.toml"), set=values).statistics
    assert statistics["jacobian_calls"] <= 2 * statistics["steps"]
    assert statistics["steps"] <= 200


@pytest.mark.parametrize("loops", [10, pytest.param(40, marks=pytest.mark.slow)])
def test_radau_passes_the_singular_pose_of_many_loops(loops: int) -> None:
    """Level uprights at 0.72 s: full Newton steps over them."""
    case = hydrodae.Case.from_text(four_bar_windows(loops))
    channels = ("bodies/up0/position", f"bodies/up{loops}/position")
    exact = at_end(case, channels, 1.0, method="explicit_rk", rtol=1e-10)
    values = at_end(case, channels, 1.0, method="radau", rtol=1e-9)
    assert abs(values - exact).max() < 1e-7


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"method": "gauss"}, "gauss has a fixed step: give solver.step"),
        ({"method": "gauss", "step": 0.1, "formulation": "index_3"}, "Gauss methods diverge"),
        ({"method": "ida", "formulation": "index_3"}, "BDF on index 3 loses two to three digits"),
        ({"method": "radau", "order": 4}, "radau has order 1, 3, .. 19"),
        ({"method": "explicit_rk", "order": 4}, "explicit_rk has order 5 or 8"),
        ({"method": "ida", "order": 3}, "ida varies its order"),
        ({"method": "ida", "step": 0.1}, "ida chooses its steps by rtol"),
        ({"method": "explicit_rk", "formulation": "index_2"}, "has its own"),
        ({"baumgarte_time": 1.0}, 'belongs to formulation "index_1"'),
        ({"method": "radau", "max_order": 3}, "belongs to ida; radau takes solver.order"),
        ({"method": "radau", "spectral_radius": 0.5}, "belongs to generalized_alpha; leave it out"),
        ({"spectral_radius": 0.5}, "belongs to generalized_alpha; name the method"),
    ],
    ids=str,
)
def test_pairs_known_to_fail_are_refused_with_the_reason(
    change: dict[str, Any], message: str
) -> None:
    with pytest.raises(hydrodae.CaseError, match=message.replace("(", r"\(")):
        hydrodae.run(PENDULUM, set={f"solver.{key}": value for key, value in change.items()})


def test_force_runs_a_refused_pair() -> None:
    values: dict[str, Any] = {"solver.method": "ida", "solver.formulation": "index_3"}
    values |= {"solver.force": True, "solver.end_time": 1.0}
    assert hydrodae.run(PENDULUM, set=values).statistics["steps"] > 10


@pytest.mark.parametrize("formulation", ["index_2", "index_1"])
@pytest.mark.parametrize("method", ["ida", "radau"])
def test_formulations_agree(formulation: str, method: str) -> None:
    exact = at_end(PENDULUM, BOB, 5.0, method="explicit_rk", rtol=1e-13)
    solver = {"method": method, "formulation": formulation, "rtol": 1e-9}
    assert abs(at_end(PENDULUM, BOB, 5.0, **solver) - exact).max() < 3e-6


@pytest.mark.parametrize(
    "solver",
    [
        {"method": "radau"},
        {"method": "ida"},
        {"method": "explicit_rk"},
        {"method": "generalized_alpha", "step": 0.01},
    ],
    ids=lambda solver: solver["method"],
)
def test_joints_are_closed_at_samples_between_steps(solver: dict[str, Any]) -> None:
    """Where interpolants of long steps part it by up to 1e-4 m. The steps know nothing of it."""
    values = {f"solver.{key}": value for key, value in solver.items()}
    values |= {"solver.end_time": 2.0, "solver.rtol": 1e-3}
    statistics = []
    for every in (0.013, 2.0):
        results = hydrodae.run(PENDULUM, set=values | {"output.step": every})
        statistics.append([results.statistics[k] for k in ("steps", "newton_iterations")])
        lengths = np.linalg.norm(results["bodies/bob/position"].values, axis=1)
        assert np.abs(lengths - 1.0).max() <= 1e-10
    assert statistics[0] == statistics[1]


def test_baumgarte_takes_back_the_drift_of_index_1() -> None:
    """Length of the rod after 10 s, with and without the feedback."""
    drift = []
    for time in (0.0, 0.05):
        solver = {"method": "ida", "formulation": "index_1", "baumgarte_time": time, "rtol": 1e-6}
        bob = at_end(PENDULUM, ("bodies/bob/position",), 10.0, **solver)
        drift.append(abs(np.linalg.norm(bob) - 1.0))
    assert drift[1] < 0.1 * drift[0]


def test_the_energy_guard_stops_a_run_that_lost_its_branch() -> None:
    """Loose explicit steps through the dead points of a slider crank with equal rods."""
    case = ROOT / "cases" / "benchmarks" / "slider_crank_equal.toml"
    with pytest.raises(
        hydrodae.SolverError, match=r"energy balance is off by .*\n.*reactions"
    ) as e:
        hydrodae.run(case, set={"solver.method": "generalized_alpha", "solver.step": 0.05})
    assert e.value.reason == "energy"
    numbers = e.value.numbers
    assert abs(numbers["error"]) > numbers["allowed_part"] * numbers["exchanged"]
    assert e.value.advice.startswith("a smaller tolerance")


def test_the_energy_guard_looks_inside_steps() -> None:
    """Long steps of order 5 through a linkage lose energy on the way."""
    long = {"solver.method": "explicit_rk", "solver.order": 5, "solver.step": 0.2}
    with pytest.raises(hydrodae.SolverError, match="energy"):
        hydrodae.run(
            ROOT / "cases" / "benchmarks" / "bricard.toml",
            set={**long, "solver.energy_guard": 1e-6},
        )
