"""Hydrodynamic axes against linear theory at second order: drift, growth of pitch, power."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.linear import LinearModel

PERIOD = 7.7  # of the wave on the point absorber [s]
TAKE_OFF = 1.2e6  # [N s/m]


def sphere_in_waves(repository: Path, axes: str | None, height: float) -> hydrodae.Results:
    """A sphere, free in the plane, in a regular wave of 5 s."""
    values = {
        "body.sphere.motion": "planar",
        "body.sphere.inertia": [2.5e6, 2.5e6, 2.5e6],
        "hydro.radiation": "constant",
        "hydro.frequency": 2 * np.pi / 5.0,
        "wave.swell.period": 5.0,
        "wave.swell.height": height,
        "sea.ramp": 40.0,
        "solver.end_time": 300.0,
        "solver.rtol": 1e-8,
        "output.step": 0.25,
    }
    if axes:
        values["hydro.axes"] = axes
    return hydrodae.run(repository / "cases" / "sphere" / "wave.toml", set=values)


def drift(results: hydrodae.Results, period: float) -> float:
    """Mean speed along x over the last 20 periods [m/s]."""
    late = results.time >= results.time[-1] - 20.0 * period
    t = results.time[late] - results.time[-1]
    w = 2.0 * np.pi / period
    basis = [np.ones_like(t), t, *(f(k * w * t) for k in (1, 2) for f in (np.cos, np.sin))]
    x = results["bodies/sphere/position"].values[late, 0]
    return float(np.linalg.lstsq(np.column_stack(basis), x, rcond=None)[0][1])


def test_a_free_sphere_does_not_drift(repository: Path) -> None:
    """Linear theory has no mean drift; the default keeps to it, `body` does not and says so."""
    assert abs(drift(sphere_in_waves(repository, None, 1.0), 5.0)) < 1e-5
    carried = sphere_in_waves(repository, "body", 1.0)
    assert drift(carried, 5.0) > 0.1
    assert any("incomplete at second order" in note for note in carried.notes)


@pytest.fixture(scope="module")
def absorber(reference: Path, repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """cases/rm3/wave.toml beside the planar database, without a fit."""
    folder = tmp_path_factory.mktemp("rm3")
    text = (repository / "cases" / "rm3" / "wave.toml").read_text()
    (folder / "wave.toml").write_text(text)
    source, output = str(reference / "hdb" / "rm3_wamit"), str(folder / "hydro.h5")
    keep = ["--keep", "float.planar,spar.planar"]
    assert main(["hdb", "import", source, "-o", output, "--rho", "1000", *keep]) == 0
    return folder / "wave.toml"


def absorbed_power(results: hydrodae.Results, start: float, end: float) -> float:
    rate = results["joints/slide/displacement_rate"].sel(time=slice(start, end)).values
    return float(TAKE_OFF * np.mean(rate[:-1] ** 2))


def test_point_absorber_keeps_its_pitch_and_its_power(absorber: Path) -> None:
    """1 m at 7.7 s for 700 s: pitch and power stay those of linear theory."""
    values = {
        "hydro.radiation": "constant",
        "hydro.frequency": 2 * np.pi / PERIOD,
        "wave.swell.period": PERIOD,
        "wave.swell.height": 1.0,
        "sea.ramp": 50.0,
        "solver.start": "equilibrium",
        "solver.end_time": 700.0,
        "output.step": PERIOD / 20,
    }
    results = hydrodae.run(absorber, set=values)
    model = LinearModel(hydrodae.Case(path=absorber, values={"hydro.radiation": "none"}))
    linear = model.response([2 * np.pi / PERIOD])
    power = 0.25 * float(linear.power["pto"][0])
    pitch = 0.5 * float(abs(linear["bodies/float/pitch"][0]))
    late = results.time > 300.0
    measured = np.abs(results["bodies/float/rotation"].values[late, 1])
    assert measured.max() == pytest.approx(pitch, rel=0.03)
    for start in (200.0, 600.0):
        found = absorbed_power(results, start, start + 10.0 * PERIOD)
        assert found == pytest.approx(power, rel=0.005)


def growth(path: Path, axes: str, period: float, height: float) -> float:
    """Rate [1/s] of the pitch at twice the wave's period, released at 0.2 degrees."""
    tilt = np.radians(0.2)
    arm = 21.29 - 0.72
    values = {
        "hydro.axes": axes,
        "hydro.radiation": "none",
        "wave.swell.period": period,
        "wave.swell.height": height,
        "sea.ramp": 50.0,
        "body.float.initial.rotation_deg": [0.0, 0.2, 0.0],
        "body.spar.initial.rotation_deg": [0.0, 0.2, 0.0],
        "body.spar.initial.displacement": [-arm * np.sin(tilt), 0.0, arm * (1.0 - np.cos(tilt))],
        "solver.end_time": 400.0,
        "solver.rtol": 1e-6,
        "output.step": period / 20,
    }
    results = hydrodae.run(path, set=values)
    pitch = results["bodies/float/rotation"].values[:, 1]
    count = 80  # samples of two periods of the pitch
    carrier = np.exp(-1j * np.pi / period * results.time)
    starts = [k for k in range(0, len(pitch) - count, count) if results.time[k] > 80.0]
    size = [abs(np.mean((pitch * carrier)[k : k + count])) for k in starts]
    return float(np.polyfit(results.time[starts], np.log(size), 1)[0])


@pytest.mark.long
def test_parametric_resonance_is_of_the_mechanism_and_doubled_by_body_axes(absorber: Path) -> None:
    """At half the period of pitch (15.0 s without radiation), in proportion to the height."""
    low, high = (growth(absorber, "mean", 7.5, height) for height in (0.5, 1.0))
    assert high == pytest.approx(0.0050, rel=0.15)
    assert low == pytest.approx(0.5 * high, rel=0.25)
    assert growth(absorber, "body", 7.5, 1.0) > 1.7 * high
    assert abs(growth(absorber, "mean", 7.0, 1.0)) < 5e-4


def test_limits_of_linear_theory_are_told(repository: Path) -> None:
    """Once for each body and measure, with the time and the value."""
    case = repository / "cases" / "f3of" / "flap_decay.toml"
    near = hydrodae.run(case, set={"solver.end_time": 8.0})
    assert not any("beyond linear theory" in note for note in near.notes)
    far = hydrodae.run(case, set={"solver.end_time": 8.0, "joint.hinge1.initial.angle_deg": -25.0})
    (note,) = [note for note in far.notes if "beyond linear theory" in note]
    assert "'flap1' turns by 25 deg at t = 0 s, at most 25 deg (limit 15 deg)" in note
    heave = hydrodae.run(
        repository / "cases" / "sphere" / "decay.toml",
        set={"body.sphere.initial.displacement": [0.0, 0.0, 3.5], "solver.end_time": 5.0},
    )
    (note,) = [note for note in heave.notes if "beyond linear theory" in note]
    assert "'sphere' rises or sinks by 3.5 m at t = 0 s" in note


def test_drift_through_the_waves_is_told_unless_their_phase_follows(repository: Path) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    values = {
        "body.sphere.motion": "planar",
        "body.sphere.inertia": [2.5e6, 2.5e6, 2.5e6],
        "body.sphere.initial.velocity": [1.0, 0.0, 0.0],
        "hydro.radiation": "none",
        "solver.end_time": 10.0,
    }
    length = 9.81 * 5.0**2 / (2.0 * np.pi)
    results = hydrodae.run(case, set=values)
    (note,) = [note for note in results.notes if "beyond linear theory" in note]
    assert "'sphere' moves off its place in the waves" in note
    assert f"a tenth of the wave length: {0.1 * length:.1f} m" in note
    moving = hydrodae.run(case, set={**values, "sea.phase": "moving"})
    assert not any("beyond linear theory" in note for note in moving.notes)
