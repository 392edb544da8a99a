"""Equilibrium and frequency domain against hand values, the time domain and other codes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares

import hydrodae
from hydrodae.hdb.database import HydroDatabase
from hydrodae.linear import LinearModel
from hydrodae.study.rao.regular_waves import time_domain

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


def without(database: HydroDatabase, keep: np.ndarray) -> HydroDatabase:
    """Tables at part of the frequencies."""
    names = ("omega", "added_mass", "radiation_damping", "froude_krylov", "diffraction")
    return replace(database, **{name: getattr(database, name)[keep] for name in names})


def test_mode_below_the_table_against_its_decay(repository: Path) -> None:
    """Surge of F3OF, 47.5 s, with tables that begin at 31.4 s; A at low frequencies is flat."""
    path = repository / "cases" / "f3of" / "surge_decay.toml"
    model = LinearModel(path)
    assert model.database is not None
    cut = model.with_database(without(model.database, model.database.omega >= 0.2))
    surge, heave = cut.modes()[:2]
    assert surge.extrapolated
    assert not heave.extrapolated
    decay = hydrodae.run(path, set={"solver.end_time": 150.0})
    x, t = decay["bodies/base/position"].values[:, 0], decay.time
    k = np.flatnonzero((x[:-1] > 0) & (x[1:] <= 0))
    falls = t[k] + x[k] / (x[k] - x[k + 1]) * (t[k + 1] - t[k])
    assert surge.period == pytest.approx(np.diff(falls).mean(), rel=0.01)
    assert surge.damping_ratio < 1e-3
    assert not model.modes()[0].extrapolated


def test_mode_above_the_table(sphere: LinearModel) -> None:
    """Heave at 4.36 s with tables that end at 6.28 s: between A there and A at infinity."""
    assert sphere.database is not None
    cut = sphere.with_database(without(sphere.database, sphere.database.omega <= 1.0))
    (mode,) = cut.modes()
    assert mode.extrapolated
    assert mode.period == pytest.approx(sphere.modes()[0].period, rel=0.05)


def test_damping_ratio_against_a_decay(sphere: LinearModel, repository: Path) -> None:
    """Slopes of A and B matter: at fixed tables the ratio would be 0.084."""
    decay = hydrodae.run(
        repository / "cases" / "sphere" / "decay.toml",
        set={
            "body.sphere.initial.displacement": [0.0, 0.0, 0.01],
            "solver.rtol": 1e-8,
            "solver.end_time": 25.0,
        },
    )
    late = decay.time > 5.0
    t, z = decay.time[late], decay["bodies/sphere/position"].values[late, 2]

    def misfit(p: np.ndarray) -> np.ndarray:
        swing = np.exp(-p[0] * t) * (p[1] * np.cos(p[2] * t) + p[3] * np.sin(p[2] * t))
        return np.asarray((z + 2.0) / 0.01 - p[4] - swing)

    rate, _, frequency, _, _ = least_squares(misfit, [0.1, 1.0, 1.44, 0.0, 0.0]).x
    (mode,) = sphere.modes()
    ratio = rate / np.hypot(rate, frequency)
    assert mode.damping_ratio == pytest.approx(ratio, rel=0.01)


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
    added, radiation = f3of.added(w)
    z = z - w[0] ** 2 * added[0] + 1j * w[0] * radiation[0]
    residual = (z @ response.values[0, :9] - f3of.excitation(w, 0.0)[0])[base]
    force = sum(response[f"joints/hinge{k}/reaction_force.x"][0] for k in (1, 2))
    assert -force == pytest.approx(residual[0], rel=1e-6)


@pytest.mark.parametrize("period", BASE_PITCH)
def test_base_pitch_of_f3of_against_inwave(f3of: LinearModel, period: float) -> None:
    ours = f3of.response([2 * np.pi / period])["bodies/base/pitch"]
    assert np.degrees(abs(ours[0])) == pytest.approx(BASE_PITCH[period], rel=0.05)


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
    from hydrodae.commands.cli import main

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
