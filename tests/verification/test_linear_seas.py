"""Devices in irregular seas: mean axes keep to linear theory of the same waves, body axes drift."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.verification import attenuator
from tests.verification.linear_sea import LinearSea

import hydrodae
from hydrodae.results.post import mean_absorbed_power


def against_linear(
    case: hydrodae.Case, results: hydrodae.Results, channel: str, label: str, start: float
) -> float:
    """Ratio of the standard deviations of a run and of linear theory, from `start` [s] on."""
    late = results.time >= start
    values = results[channel].to_numpy()[late]
    values = values[:, 0] if values.ndim > 1 else values
    expected = LinearSea(case).series(label, results.time[late])
    return float(np.std(values) / np.std(expected))


@pytest.fixture(scope="module")
def three_floats(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> hydrodae.Case:
    return attenuator.prepare(repository, tmp_path_factory.mktemp("attenuator"))


def surge(case: hydrodae.Case, axes: str, height: float) -> float:
    """Largest surge of the middle float in 300 s [m]."""
    values = {"hydro.axes": axes, "wave.sea.significant_height": height}
    return float(abs(hydrodae.run(case, set=values)["bodies/middle/position"][:, 0]).max())


def test_surge_of_a_moored_attenuator_grows_with_the_height(three_floats: hydrodae.Case) -> None:
    """0.11 m at Hs 0.5 m, 0.48 m at 2 m; in body axes 0.15 and 1.87 m, growing with its square."""
    assert surge(three_floats, "mean", 2.0) / surge(three_floats, "mean", 0.5) < 1.15 * 4.0
    assert surge(three_floats, "body", 2.0) / surge(three_floats, "body", 0.5) > 2.5 * 4.0


def test_attenuator_against_linear_theory(three_floats: hydrodae.Case) -> None:
    case = three_floats.with_values({"wave.sea.significant_height": 1.0})
    results = hydrodae.run(case, set={"solver.end_time": 400.0})
    for hinge in ("front", "rear"):
        name = f"joints/{hinge}/angle"
        assert against_linear(case, results, name, name, 100.0) == pytest.approx(1.0, abs=0.02)
    found = against_linear(case, results, "bodies/middle/position", "bodies/middle/surge", 100.0)
    assert found == pytest.approx(1.0, abs=0.05)


def test_flaps_on_a_fixed_base_against_linear_theory(repository: Path) -> None:
    """F3OF in Hs 2 m: flap 2 reaches 10.8 degrees."""
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "waves.toml")
    case = case.with_values({"wave.sea.significant_height": 2.0})
    results = hydrodae.run(case)
    for name in ("joints/hinge1/angle", "joints/hinge2/angle"):
        assert against_linear(case, results, name, name, 100.0) == pytest.approx(1.0, abs=0.01)
    assert np.degrees(abs(results["joints/hinge2/angle"]).max()) == pytest.approx(10.8, abs=0.3)


def floating_flaps(repository: Path, axes: str) -> hydrodae.Case:
    """F3OF on its mooring in Hs 2 m, Tp 9 s for 600 s."""
    wave = {"name": "sea", "type": "jonswap", "significant_height": 2.0, "peak_period": 9.0}
    values = {"wave": [wave], "hydro.axes": axes, "sea.ramp": 50.0, "solver.end_time": 600.0}
    return hydrodae.Case.read(repository / "cases" / "f3of" / "rao.toml").with_values(values)


def test_floating_flaps_against_linear_theory(repository: Path) -> None:
    """Flap 2 reaches 8.1 degrees, the base 1.4 m; in body axes 14.0 degrees and 3.9 m."""
    case = floating_flaps(repository, "mean")
    results = hydrodae.run(case)
    found = [
        against_linear(case, results, name, label, 200.0)
        for name, label in (
            ("joints/hinge1/angle", "joints/hinge1/angle"),
            ("joints/hinge2/angle", "joints/hinge2/angle"),
            ("bodies/base/position", "bodies/base/surge"),
        )
    ]
    assert found == pytest.approx([1.0, 1.0, 1.0], abs=0.04)
    carried = hydrodae.run(floating_flaps(repository, "body"))
    for name, factor in (("joints/hinge2/angle", 1.5), ("bodies/base/position", 2.0)):
        largest = [
            abs(run[name].to_numpy()).reshape(len(run.time), -1)[:, 0].max()
            for run in (results, carried)
        ]
        assert largest[1] > factor * largest[0]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_power_of_a_point_absorber_against_linear_theory(rm3_planar: Path, seed: int) -> None:
    """RM3 in Tp 12 s, Hs 2.5 m for ten minutes: 0 to 3 % above the same waves in linear theory."""
    wave = {
        "name": "sea",
        "type": "jonswap",
        "significant_height": 2.5,
        "peak_period": 12.0,
        "seed": seed,
    }
    case = hydrodae.Case.read(rm3_planar / "wave.toml").with_values({"wave": [wave]})
    results = hydrodae.run(case, set={"sea.ramp": 30.0, "solver.end_time": 660.0})
    late = results.time >= 60.0
    rate = LinearSea(case).series("joints/slide/displacement", results.time[late], rate=True)
    linear = 1.2e6 * float(np.mean(rate**2))
    assert mean_absorbed_power(results, "pto", 60.0) == pytest.approx(linear, rel=0.05)
    assert np.degrees(abs(results["bodies/float/rotation"][:, 1]).max()) < 10.0
