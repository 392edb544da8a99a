"""Measures of runs side by side, against splines through the samples of a run alone."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import hydrodae
from hydrodae import _core
from hydrodae.study.sweep.fatigue import damage_equivalent_load
from hydrodae.study.sweep.lanes import TURNING, measure_lane, signals_of
from hydrodae.study.sweep.measures import Measure, Term, measure

RAMP, END = 20.0, 70.0  # s
CHANNELS = [
    ("joints/hinge1/angle", None),
    ("joints/hinge2/angle_rate", None),
    ("joints/hinge1/reaction_force", "x"),
    ("joints/hinge1/reaction_force", "y"),
    ("bodies/flap1/position", "x"),
    ("bodies/flap2/velocity", "x"),
    ("bodies/flap1/rotation", "y"),
    ("bodies/flap1/angular_velocity", "y"),
    ("bodies/flap2/acceleration", "x"),
    ("bodies/flap1/angular_acceleration", "y"),
    ("forces/pto1/torque", None),
    ("forces/pto2/power_absorbed", None),
    ("sea/elevation", None),
]
STATISTICS: dict[str, dict[str, float]] = {
    "mean": {},
    "std": {},
    "rms": {},
    "max": {},
    "min": {},
    "range": {},
    "last": {},
    "mean_period": {},
    "amplitude": {"frequency": 0.11},
    "damage_equivalent_load": {"exponent": 4.0},
}
MEASURES = tuple(
    Measure(f"m{i}_{name}", channel, name, component, **more)  # type: ignore[arg-type]
    for i, (channel, component) in enumerate(CHANNELS)
    for name, more in STATISTICS.items()
)


def flaps(repository: Path, **values: Any) -> hydrodae.Case:
    """Return F3OF in waves of 70 s, 20 s of which are its ramp."""
    own = {"solver.end_time": END, "sea.ramp": RAMP, "solver.accuracy": "none"}
    case = repository / "cases" / "f3of" / "waves.toml"
    return hydrodae.Case(path=case, values=own | values)


def lane(case: hydrodae.Case, measures: tuple[Measure, ...] = MEASURES) -> dict[str, float]:
    other = case.with_values({"wave.sea.seed": 9})
    answers = _core.simulate_together([other.scene, case.scene], signals_of(measures))
    answer = answers[1]
    assert isinstance(answer, dict), answer
    return {name: value for name, (value, _) in measure_lane(answer, measures).items()}


@pytest.fixture(scope="module")
def alone(repository: Path) -> hydrodae.Results:
    """Return a run by itself with 1e-10, and a sample each 0.02 s."""
    return hydrodae.run(flaps(repository, **{"solver.rtol": 1e-10, "output.step": 0.02}))


def truth(results: hydrodae.Results, channel: str, component: str | None) -> dict[str, float]:
    """Statistics of a cubic spline through the samples, whose error is about 1e-8 of the range."""
    found = results.channel(channel)
    x = found.values
    if component is not None:
        x = x[:, found.components.index(component)]
    after = results.time >= RAMP
    t, x = results.time[after], x[after]
    spline, length = CubicSpline(t, x), END - RAMP
    mean = float(spline.integrate(RAMP, END)) / length
    square = float(CubicSpline(t, x**2).integrate(RAMP, END)) / length
    turns = [r for r in spline.derivative().roots(extrapolate=False) if RAMP < r < END]
    series = spline(np.array([RAMP, *turns, END]))
    w = 2.0 * math.pi * STATISTICS["amplitude"]["frequency"]
    wave = [CubicSpline(t, (x - mean) * f(w * t)).integrate(RAMP, END) for f in (np.cos, np.sin)]
    return {
        "mean": mean,
        "std": math.sqrt(square - mean**2),
        "rms": math.sqrt(square),
        "max": float(series.max()),
        "min": float(series.min()),
        "range": float(np.ptp(series)),
        "last": float(x[-1]),
        "mean_period": length / np.count_nonzero((x[:-1] <= mean) & (x[1:] > mean)),
        "amplitude": 2.0 * math.hypot(*wave) / length,
        "damage_equivalent_load": damage_equivalent_load(series, length, 4.0, 1.0),
    }


def errors(found: dict[str, float], results: hydrodae.Results) -> dict[str, float]:
    """Errors of the measures over the range of their channel; of periods, relative."""
    out = {}
    for i, (channel, component) in enumerate(CHANNELS):
        right = truth(results, channel, component)
        for name, value in right.items():
            scale = value if name == "mean_period" else right["range"]
            out[f"m{i}_{name}"] = abs(found[f"m{i}_{name}"] - value) / scale
    return out


def test_measures_of_a_lane_are_those_of_the_run_alone(
    repository: Path, alone: hydrodae.Results
) -> None:
    found = errors(lane(flaps(repository, **{"solver.rtol": 1e-9})), alone)
    assert {name: error for name, error in found.items() if not error < 1e-7} == {}


def test_measures_err_by_less_than_the_tolerance(repository: Path, alone: hydrodae.Results) -> None:
    """Extremes lie on a polynomial of order 6, which falls behind the steps where rtol is small."""
    for rtol, more in ((1e-3, 1.0), (1e-5, 10.0)):
        found = errors(lane(flaps(repository, **{"solver.rtol": rtol})), alone)
        for name, error in found.items():
            turning = name.partition("_")[2] in TURNING
            assert error < rtol * (more if turning else 1.0), name


def test_measures_do_not_change_the_steps(repository: Path) -> None:
    case = flaps(repository)
    plain = _core.simulate_together([case.scene])[0]
    watched = _core.simulate_together([case.scene], signals_of(MEASURES))[0]
    assert isinstance(plain, dict)
    assert isinstance(watched, dict)
    assert watched["mean_power_absorbed"] == plain["mean_power_absorbed"]
    assert watched["steps"] == plain["steps"]


def test_samples_give_the_same_measures_up_to_their_step(
    repository: Path, alone: hydrodae.Results
) -> None:
    """With the intervals of the sea; a mean of samples counts both ends whole."""
    sampled = measure(alone, MEASURES)
    found = lane(flaps(repository, **{"solver.rtol": 1e-9}))
    assert set(found) == set(sampled) - {"estimated_error"}
    for m in MEASURES:
        size = abs(sampled[m.name][0]) + sampled[m.name.partition("_")[0] + "_range"][0]
        assert found[m.name] == pytest.approx(sampled[m.name][0], abs=1e-3 * size), m


def test_terms_ratios_and_starts(repository: Path, alone: hydrodae.Results) -> None:
    power = "forces/pto1/power_absorbed"
    measures = (
        Measure("both", "", "mean", None, 30.0, terms=(Term(power, 0.9), Term("", 5.0)), unit="W"),
        Measure(
            "square", "", "mean", None, 30.0, terms=(Term("joints/hinge1/angle_rate", 4e7, 2),)
        ),
        Measure("part", power, "mean", None, 30.0, over="both"),
    )
    found = lane(flaps(repository, **{"solver.rtol": 1e-9}), measures)
    t, x = alone.time, alone.channel(power).values
    mean = CubicSpline(t, x).integrate(30.0, END) / (END - 30.0)
    assert found["both"] == pytest.approx(0.9 * mean + 5.0, rel=1e-7)
    assert found["square"] == pytest.approx(mean, rel=1e-7)  # P = c w^2
    assert found["part"] == pytest.approx(mean / (0.9 * mean + 5.0), rel=1e-7)


def test_a_channel_that_lanes_do_not_know_is_named(repository: Path) -> None:
    wanted = (Measure("stored", "energy/kinetic", "mean", None),)
    answer = _core.simulate_together([flaps(repository).scene], signals_of(wanted))[0]
    assert answer == "a march does not know the channel energy/kinetic"
