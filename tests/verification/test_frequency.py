"""Equilibrium and frequency domain against hand values, the time domain and other codes."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.frequency import LinearModel
from hydrodae.rao import time_domain

ANGLES = ("bodies/base/pitch", "joints/hinge1/angle", "joints/hinge2/angle")
# InWave's base pitch in degrees per metre over the period, off resonance (the reference data of the
# code comparison, kept here so that they are always tested).
BASE_PITCH = {15.0: 0.89482, 14.0: 1.0502, 13.0: 1.2507, 11.0: 1.8565, 5.0: 0.96771, 4.0: 1.3822}


@pytest.fixture(scope="module")
def case(repository: Path) -> hydrodae.Case:
    return hydrodae.Case.read(repository / "cases" / "f3of" / "rao.toml")


@pytest.fixture(scope="module")
def f3of(case: hydrodae.Case) -> LinearModel:
    return LinearModel(case)


@pytest.fixture(scope="module")
def sphere(repository: Path) -> LinearModel:
    return LinearModel(repository / "cases" / "sphere" / "wave.toml")


def test_static_heave_of_f3of(f3of: LinearModel) -> None:
    """Weight less than buoyancy of all bodies over the stiffness of all waterplanes."""
    mass, volume, waterplane = 1_448_325.0, 1410.656, 25.456 + 2 * 38.0
    expected = (volume - mass / 1025.0) / waterplane
    for body in ("base", "flap1", "flap2"):
        assert f3of.offsets[body][2] == pytest.approx(expected, abs=2e-4)
        assert f3of.offsets[body][2] == pytest.approx(-0.0231, abs=2e-4)
    # Each flap pulls at its hinge with its net lift less what its sinking adds.
    lift = (1025.0 * 368.870 - 179_250.0) * 9.81 - 1025.0 * 9.81 * 38.0 * f3of.offsets["flap1"][2]
    force = [f3of.reactions[f"joints/hinge1/reaction_force.{a}"] for a in "xyz"]
    assert np.linalg.norm(force) == pytest.approx(lift, rel=1e-3)


def test_run_from_equilibrium_stays_there(case: hydrodae.Case) -> None:
    results = hydrodae.run(
        case, set={"wave.swell.height": 0.0, "solver.end_time": 100.0, "solver.rtol": 1e-8}
    )
    position = results["bodies/base/position"].values
    assert np.abs(position - position[0]).max() <= 1e-6
    assert position[0, 2] + 9.0 == pytest.approx(-0.0231, abs=2e-4)


def test_no_equilibrium_is_an_error(repository: Path) -> None:
    """A steady load along a coordinate that nothing holds; a start that is not at rest."""
    folder = repository / "cases" / "sphere"
    text = (folder / "decay.toml").read_text().replace('motion = "heave"', 'motion = "planar"')
    text = text.replace("[hydro]", '[hydro]\nradiation = "none"')
    text = text.replace("mass = 261.8e3", "mass = 261.8e3\ninertia = [1e6, 1e6, 1e6]")
    text += """
[[force]]
type = "constant_load"
name = "wind"
body = "sphere"
force = [1e4, 0.0, 0.0]
"""
    with pytest.raises(hydrodae.CaseError, match="force x balance is off by 10000 N"):
        LinearModel(hydrodae.Case.from_text(text, folder))
    with pytest.raises(hydrodae.CaseError, match="initial velocities"):
        hydrodae.run(
            repository / "cases" / "sphere" / "decay.toml",
            set={"solver.start": "equilibrium", "body.sphere.initial.velocity": [0.0, 0.0, 1.0]},
        )


def test_sphere_in_closed_form(sphere: LinearModel) -> None:
    """One coordinate: F / (C - w^2 (m + A) + iw B) with the tables at their own frequencies."""
    db = sphere.database
    assert db is not None
    i = db.index("sphere.heave")[0]
    k = np.array([9, 28, 50, 80])
    w = db.omega[k]
    stiffness = db.hydrostatic_stiffness("sphere")[2, 2]
    inertia = 261.8e3 + db.added_mass[k, i, i]
    expected = db.excitation[k, 0, i] / (
        stiffness - w**2 * inertia + 1j * w * db.radiation_damping[k, i, i]
    )
    response = sphere.response(w)
    np.testing.assert_allclose(response["bodies/sphere/heave"], expected, rtol=1e-6)
    mode = sphere.modes()[0]
    at_mode = np.interp(2 * np.pi / mode.period, db.omega, db.added_mass[:, i, i])
    assert mode.period == pytest.approx(
        2 * np.pi * np.sqrt((261.8e3 + at_mode) / stiffness), rel=1e-4
    )


def test_haskind_power_balance(f3of: LinearModel) -> None:
    """What the waves give is radiated or absorbed."""
    response = f3of.response(np.linspace(0.3, 1.6, 50))
    absorbed = np.sum(list(response.power.values()), axis=0)
    np.testing.assert_allclose(
        response.excitation_power, response.radiated_power + absorbed, rtol=1e-6
    )


def test_reactions_balance_the_flap(f3of: LinearModel) -> None:
    """Newton's law of the base: hinge loads and mooring against its inertia and the water."""
    w = np.array([0.5])
    response = f3of.response(w)
    base, free = slice(0, 3), f3of.constraints
    assert free.shape == (4, 9)
    z = f3of.stiffness - w[0] ** 2 * f3of.mass + 1j * w[0] * f3of.damping
    added, radiation = f3of._added(w)
    z = z - w[0] ** 2 * added[0] + 1j * w[0] * radiation[0]
    residual = (z @ response.values[0, :9] - f3of.excitation(w, 0.0)[0])[base]
    force = sum(response[f"joints/hinge{k}/reaction_force.x"][0] for k in (1, 2))
    assert -force == pytest.approx(residual[0], rel=1e-6)


@pytest.mark.parametrize("period", BASE_PITCH)
def test_base_pitch_of_f3of_against_inwave(f3of: LinearModel, period: float) -> None:
    ours = f3of.response([2 * np.pi / period])["bodies/base/pitch"]
    assert np.degrees(abs(ours[0])) == pytest.approx(BASE_PITCH[period], rel=0.05)


def test_two_hundred_frequencies_take_a_moment(f3of: LinearModel) -> None:
    w = np.linspace(0.1, 3.0, 200)
    f3of.response(w)
    started = time.perf_counter()
    f3of.response(w)
    assert time.perf_counter() - started < 0.1


def test_time_domain_of_f3of_agrees(case: hydrodae.Case, f3of: LinearModel) -> None:
    """Regular waves of 1 cm: 0.5 % from 6 s, 3 % below, off resonance."""
    periods = np.array([4.6, 5.0, 7.0, 11.0, 14.0])
    exact = f3of.response(2 * np.pi / periods)
    runs = time_domain(case, exact.omega.tolist(), 0.0, ANGLES, settle=600.0, jobs=2)
    for k, period in enumerate(periods):
        for name in ANGLES:
            error = abs(runs[k].response[name] / exact[name][k] - 1.0)
            assert error <= (0.005 if period >= 6.0 else 0.03), (period, name, error)


def test_power_in_the_time_domain(repository: Path, sphere: LinearModel) -> None:
    """Damper between the sphere and the ground: absorbed = excitation - radiated, mean values."""
    text = (repository / "cases" / "sphere" / "wave.toml").read_text()
    text += """
[[joint]]
name = "guide"
type = "prismatic"
body_a = "ground"
body_b = "sphere"
point = [0.0, 0.0, -2.0]
axis = [0.0, 0.0, 1.0]

[[force]]
type = "pto_linear"
name = "pto"
joint = "guide"
damping = 161048.558
"""
    case = hydrodae.Case.from_text(text, repository / "cases" / "sphere")
    results = hydrodae.run(
        case, set={"solver.end_time": 200.0, "output.step": 0.125, "solver.rtol": 1e-8}
    )
    work = {
        name: results[f"energy/work/{name}"].values[[-1 - 400, -1]]
        for name in ("excitation", "radiation", "pto")
    }
    excitation, radiation, pto = (np.diff(w)[0] for w in work.values())
    assert -pto == pytest.approx(excitation + radiation, rel=1e-3)
    mean = -pto / 50.0 / (0.5 * 0.39) ** 2
    linear = LinearModel(case).response([2 * np.pi / 5.0])
    assert mean == pytest.approx(linear.power["pto"][0], rel=2e-3)
    assert excitation / 50.0 / (0.5 * 0.39) ** 2 == pytest.approx(
        linear.excitation_power[0], rel=2e-3
    )


def test_irregular_sea_in_both_domains(repository: Path) -> None:
    wave = {
        "name": "wind",
        "type": "jonswap",
        "significant_height": 0.1,
        "peak_period": 7.0,
        "frequency_range": [0.4, 3.0],
        "components": 50,
    }
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml").with_values(
        {"wave": [wave], "sea.ramp": 20.0, "solver.end_time": 3700.0, "output.step": 0.5}
    )
    deviation, _ = LinearModel(case).irregular()
    heave = hydrodae.run(case)["bodies/sphere/position"].values[200:, 2]
    assert heave.std() == pytest.approx(deviation["bodies/sphere/heave"], rel=0.03)


def test_commands(repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from hydrodae.cli import main

    path = str(repository / "cases" / "f3of" / "rao.toml")
    assert main(["equilibrium", path]) == 0
    assert "-0.0231" in capsys.readouterr().out
    table = tmp_path / "rao.csv"
    assert main(["rao", path, "--periods", "14,11", "-o", str(table)]) == 0
    out = capsys.readouterr().out
    assert "mode    8.99" in out
    assert "sea/elevation" in out
    head, first, *_ = table.read_text().splitlines()
    column = head.split(",").index("bodies/base/pitch amplitude [rad/m]")
    assert np.degrees(float(first.split(",")[column])) == pytest.approx(1.0502, rel=0.05)
    assert main(["rao", path, "--periods", "1"]) == 2
    assert "outside the database" in capsys.readouterr().err
