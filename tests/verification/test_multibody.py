"""Multibody benchmark cases (cases/benchmarks) against exact motions (tests/verification/truths).

At the default tolerance each problem meets its criterion, at rtol 1e-11 (one
tolerance for all, no other option) the tighter figure. Problems with singular poses either meet
theirs or stop with a SolverError. A run that completes with a wrong motion always fails.
One-step methods pass the singular poses.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.scenes import four_bar_windows
from tests.verification import multibody
from tests.verification.truths import make as truths

import hydrodae

TIGHT = 1e-11

# Largest error at the default tolerance, in m unless the quantity has another unit.
CRITERIA: dict[str, dict[str, float]] = {
    "bricard": {"energy": 1e-3},
    "door": {"angle": 1e-4},
    "tumbling_body": {"rates": 1e-3},
    "fast_rotor": {"position": 1e-4},
    "chain_10": {"position": 1e-3},
    "light_joint": {"position": 1e-4},
    "mass_ratio": {"position": 1e-4},
    "heavy_top": {"position": 1e-3},
    "flyball_governor": {"slider": 1e-3},
}

# Figures at rtol 1e-11: of their own where there is one, else a tenth of the criterion.
TIGHT_CRITERIA: dict[str, dict[str, float]] = {
    "simple_pendulum": {"position": 1e-6},
    "pendulum_1000s": {"position": 1e-3},
    "andrews": {"position": 1e-7},
    "bricard": {"position": 1e-5},
    **{
        name: {what: 0.1 * bound for what, bound in criterion.items()}
        for name, criterion in CRITERIA.items()
        if name != "bricard"
    },
}

# Singular poses: a SolverError is an honest answer, a wrong motion is not.
SINGULAR: dict[str, dict[str, float]] = {
    "n_four_bar_2": {"energy": 0.1},
    "slider_crank_equal": {"position": 1e-3, "energy": 1e-2},
}
SINGULAR_TIGHT: dict[str, dict[str, float]] = {
    "n_four_bar_2": {"position": 1e-4, "energy": 1e-3},
    "slider_crank_equal": {"position": 1e-4, "energy": 1e-3},
}


@pytest.fixture(scope="session")
def cases(repository: Path) -> Path:
    return repository / "cases" / "benchmarks"


def errors(
    cases: Path, name: str, rtol: float | None = None, method: str = "auto"
) -> dict[str, float]:
    """Errors of one run; without `rtol` at the default tolerance."""
    document = truths.read(name) if name in truths.PROBLEMS else {}  # the others are solved here
    values: dict[str, Any] = {"solver.method": method}
    if rtol is not None:
        values["solver.rtol"] = rtol
    results = hydrodae.run(cases / f"{name}.toml", set=values)
    return multibody.PROBLEMS[name](results, document)


def beyond(found: Mapping[str, float], bounds: Mapping[str, float]) -> dict[str, float]:
    """Errors above their bound (or not a number)."""
    return {what: found[what] for what, bound in bounds.items() if not found[what] < bound}


@pytest.mark.parametrize("name", CRITERIA)
def test_default_tolerance_meets_the_criterion(cases: Path, name: str) -> None:
    assert not beyond(errors(cases, name), CRITERIA[name])


@pytest.mark.parametrize("name", TIGHT_CRITERIA)
def test_one_tight_tolerance_for_all(cases: Path, name: str) -> None:
    assert not beyond(errors(cases, name, TIGHT), TIGHT_CRITERIA[name])


@pytest.mark.parametrize(
    "name",
    [
        # 100,000 explicit steps on its stiff springs: a minute
        pytest.param(name, marks=pytest.mark.long if name == "flyball_governor" else ())
        for name in (*TIGHT_CRITERIA, *SINGULAR_TIGHT)
    ],
)
def test_explicit_runge_kutta_with_one_tight_tolerance_for_all(cases: Path, name: str) -> None:
    found = errors(cases, name, TIGHT, "explicit_rk")
    assert not beyond(found, {**TIGHT_CRITERIA, **SINGULAR_TIGHT}[name])


@pytest.mark.parametrize(
    ("name", "method", "bounds"),
    [
        ("n_four_bar_2", "radau", {"position": 1e-4, "energy": 1e-4}),
        ("n_four_bar_2", "explicit_rk", {"position": 1e-5, "energy": 1e-4}),
        ("slider_crank_equal", "radau", {"position": 1e-4, "energy": 1e-3}),
        ("slider_crank_equal", "explicit_rk", {"position": 1e-4, "energy": 1e-3}),
    ],
)
def test_one_step_methods_pass_singular_poses(
    cases: Path, name: str, method: str, bounds: dict[str, float]
) -> None:
    assert not beyond(errors(cases, name, 1e-7, method), bounds)


@pytest.mark.parametrize(
    ("name", "rtol"),
    [
        ("n_four_bar_2", None),
        ("n_four_bar_2", TIGHT),
        ("slider_crank_equal", None),
        ("slider_crank_equal", TIGHT),
    ],
)
def test_singular_poses_are_passed_or_refused(cases: Path, name: str, rtol: float | None) -> None:
    bounds = (SINGULAR if rtol is None else SINGULAR_TIGHT)[name]
    try:
        found = errors(cases, name, rtol)
    except hydrodae.SolverError as error:
        reason = str(error)
    else:
        assert not beyond(found, bounds)
        return
    assert "stopped at t = " in reason


def locked(cases: Path, rtol: float) -> hydrodae.SolverError:
    with pytest.raises(hydrodae.SolverError) as stop:
        hydrodae.run(cases / "kinematic_lock.toml", set={"solver.rtol": rtol})
    return stop.value


@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-6, 1e-8])
def test_kinematic_lock_stops_in_time(cases: Path, rtol: float) -> None:
    """Crank of 1 m at 1 rad/s, rod of 0.5 m: the loop closes until sin t = 0.5."""
    stop = locked(cases, rtol)
    assert abs(stop.time - np.arcsin(0.5)) < 0.01
    assert stop.results is not None
    time = stop.results.time
    slider = stop.results["bodies/slider/position"].sel(component="x").values
    exact = np.cos(time) + np.sqrt(0.25 - np.sin(time) ** 2)
    assert np.isfinite(slider).all()
    assert abs(slider - exact).max() < 1e-3


def test_kinematic_lock_names_a_joint(cases: Path) -> None:
    assert "joint" in str(locked(cases, 1e-5))


def test_hinges_of_the_door_carry_it_together(cases: Path) -> None:
    """Two hinges share the forces by some rule; their sum is m (a - g)."""
    results = hydrodae.run(cases / "door.toml", set={"solver.rtol": 1e-8})
    upper, lower = (results[f"joints/{k}/reaction_force"].values for k in ("upper", "lower"))
    both = upper + lower
    gravity = np.array([0.0, 0.0, -multibody.GRAVITY])
    load = 20.0 * (results["bodies/door/acceleration"].values - gravity)
    lean = np.radians(20.0)
    axis = np.array([np.sin(lean), 0.0, np.cos(lean)])
    # both markers have the same axes, of which z is the hinge axis
    assert np.allclose(both[:, 2], load @ axis, atol=0.01)
    held, needed = (np.linalg.norm(v, axis=1) for v in (both, load))
    assert np.allclose(held, needed, atol=0.01)


def test_forty_windows_converge() -> None:
    """IFToMM A02 as published, by its own convergence: B0 within 1e-3 m, energy within 0.1 J."""
    runs = [
        hydrodae.run(
            hydrodae.Case.from_text(four_bar_windows(40)),
            set={"solver.method": "explicit_rk", "solver.rtol": rtol},
        )
        for rtol in (1e-6, 1e-8)
    ]
    ends = [2.0 * multibody.in_plane(results, "up0") for results in runs]
    assert multibody.largest(*ends) < 1e-3
    assert all(multibody.energy(results) < 0.1 for results in runs)
