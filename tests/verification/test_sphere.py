"""The sphere of IEA OES Task 10: heave decay and response in regular waves against other codes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong

import hydrodae

DRAFT = 2.0  # of the centre of gravity below the water line [m]
# Heave RAO of InWaveH [m/m] (reference data, kept here so that it is always tested).
RAO = {3.0: 0.11664, 4.4: 1.87423, 6.0: 1.14966, 10.0: 1.01519}


def decay(repository: Path) -> tuple[np.ndarray, np.ndarray]:
    results = hydrodae.run(repository / "cases" / "sphere" / "decay.toml")
    return results.time, results["bodies/sphere/position"].values[:, 2] + DRAFT


def regular_wave(repository: Path, period: float) -> hydrodae.Results:
    """Steepness 0.01, twenty periods after the ramp; 40 samples a period."""
    return hydrodae.run(
        repository / "cases" / "sphere" / "wave.toml",
        set={
            "wave.swell.period": period,
            "wave.swell.height": 0.01 * 9.81 * period**2 / (2.0 * np.pi),
            "solver.end_time": 40.0 + 20.0 * period,
            "output.step": period / 40.0,
        },
    )


def amplitude(results: hydrodae.Results, values: np.ndarray, period: float) -> complex:
    """Complex amplitude over the last five periods."""
    time = results.time[-200:]
    mean = values[-200:] - values[-200:].mean()
    return complex(2.0 * np.mean(mean * np.exp(-2j * np.pi * time / period)))


def rao(results: hydrodae.Results, period: float) -> float:
    heave = amplitude(results, results["bodies/sphere/position"].values[:, 2], period)
    return abs(heave / amplitude(results, results["sea/elevation"].values, period))


def test_decay_period(repository: Path) -> None:
    time, z = decay(repository)
    k = np.flatnonzero((z[:-1] > 0) & (z[1:] <= 0))
    falls = time[k] + z[k] / (z[k] - z[k + 1]) * (time[k + 1] - time[k])
    assert 4.32 <= np.diff(falls)[1:5].mean() <= 4.36


def test_decay_against_inwaveh(repository: Path, reference: Path) -> None:
    table = np.genfromtxt(reference / "sphere" / "decay_1m.csv", delimiter=",", names=True)
    early = table["t_s"] <= 20.0
    time, z = decay(repository)
    ours = np.interp(table["t_s"][early], time, z)
    assert np.sqrt(np.mean((ours - table["InWaveH_m"][early]) ** 2)) <= 0.006


@pytest.mark.parametrize("period", RAO)
def test_heave_in_regular_waves(repository: Path, period: float) -> None:
    results = regular_wave(repository, period)
    assert rao(results, period) == pytest.approx(RAO[period], rel=0.015)
    assert results.statistics["relative_balance_error"] <= 1e-3


def test_heave_at_all_ten_periods(repository: Path, reference: Path) -> None:
    table = np.genfromtxt(reference / "sphere" / "rao_no_pto.csv", delimiter=",", names=True)
    assert len(table) == 10
    for period, theirs in zip(table["period_s"], table["InWaveH"], strict=True):
        ours = rao(regular_wave(repository, float(period)), float(period))
        assert ours == pytest.approx(theirs, rel=0.015)


def test_long_waves_carry_the_sphere_and_phases_follow(repository: Path) -> None:
    """In a long wave the heave follows the surface: amplitude and phase."""
    results = regular_wave(repository, 25.0)
    heave = amplitude(results, results["bodies/sphere/position"].values[:, 2], 25.0)
    wave = amplitude(results, results["sea/elevation"].values, 25.0)
    assert abs(heave / wave - 1.0) <= 0.01


def test_irregular_sea_has_the_energy_and_response_of_its_spectrum(repository: Path) -> None:
    """Variance of the elevation over half an hour, and the same sea from the same seed."""
    wave = {
        "name": "wind",
        "type": "jonswap",
        "significant_height": 0.5,
        "peak_period": 8.0,
        "frequency_range": [0.4, 3.0],
    }
    values = {"wave": [wave], "sea.ramp": 0.0, "solver.end_time": 1800.0, "output.step": 0.5}
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml").with_values(values)
    results = hydrodae.run(case)
    elevation = results["sea/elevation"].values
    assert 4.0 * elevation.std() == pytest.approx(0.5, rel=0.05)
    assert results.statistics["relative_balance_error"] <= 1e-3
    again = hydrodae.run(case, set={"solver.end_time": 20.0})["sea/elevation"].values
    np.testing.assert_allclose(again, elevation[: len(again)], atol=1e-7)


def test_waves_outside_the_database_are_refused(repository: Path) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    with wrong("wave.swell.heading_deg"):
        hydrodae.run(case, set={"wave.swell.heading_deg": 90.0})
    with wrong("wave.swell.period"):
        hydrodae.run(case, set={"wave.swell.period": 1.0})


def test_constant_radiation_is_exact_at_its_frequency(repository: Path) -> None:
    """In a regular wave A(w) and B(w) at its own frequency give the same steady state."""
    case = repository / "cases" / "sphere" / "wave.toml"
    values = {
        "wave.swell.period": 5.0,
        "wave.swell.height": 0.39,
        "solver.end_time": 140.0,
        "output.step": 5.0 / 40.0,
    }
    memory = hydrodae.run(case, set=values)
    constant = hydrodae.run(
        case, set={**values, "hydro.radiation": "constant", "hydro.frequency": 2.0 * np.pi / 5.0}
    )
    assert rao(constant, 5.0) == pytest.approx(rao(memory, 5.0), rel=1e-3)
