"""A fixed cylinder with a moonpool as a water column: WAMIT's tables and answers made from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.linear import LinearModel

AREA, CONDUCTANCE, COEFFICIENT, HOLE = np.pi * 0.25**2, 2e-5, 0.62, np.pi * 0.03**2
AMPLITUDE, PRESSURE = "modes/hull.mode7/amplitude", "chambers/air/pressure"


@pytest.fixture(scope="module")
def folder(reference: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of hydro.h5 without the frequencies above 5 rad/s, where the tables have spikes."""
    source = reference / "owc" / "owc_wecsim" / "test17a" / "test17a.out"
    database, _ = hydrodae.hdb.import_database(source, rho=1000.0, cut=5.0)
    out = tmp_path_factory.mktemp("column")
    database.write(out / "hydro.h5")
    return out


@pytest.fixture(scope="module")
def answers(reference: Path) -> Any:
    return np.genfromtxt(
        reference / "owc" / "fixed_column" / "answers.csv", delimiter=",", names=True
    )


def column(
    folder: Path, outlet: str, height: float, omega: float, laminar: float = 0.01
) -> hydrodae.Scene:
    """Return the column with a plug or an orifice, in one regular wave."""
    scene = hydrodae.Scene("fixed column", directory=folder)
    scene.environment(air_density=1.2)
    scene.hydro(database="hydro.h5", radiation="constant", frequency=omega)
    scene.body(
        "hull", hydro="test17a", motion="fixed", mass=589.0, inertia=[147.0] * 3,
        center_of_gravity=[0.0, 0.0, 0.0],
    )  # fmt: skip
    scene.mode("mode7", body="hull", mass=1e-6, participation=[0.0, 0.0, 0.0])
    scene.chamber("air", volume=AREA)
    scene.piston("surface", chamber="air", mode="mode7", area=AREA)
    if outlet == "plug":
        scene.outlet.porous_plug("turbine", chamber="air", conductance=CONDUCTANCE)
    else:
        scene.outlet.orifice(
            "turbine", chamber="air", coefficient=COEFFICIENT, area=HOLE, laminar_pressure=laminar
        )
    period = 2.0 * np.pi / omega
    scene.wave.regular("sea", height=height, period=period)
    scene.sea(ramp=5.0 * period)
    scene.solver(end_time=25.0 * period, accuracy="none", rtol=1e-8)
    scene.output(step=period / 40.0)
    return scene


def test_linear_turbine(folder: Path, answers: Any) -> None:
    """|q|, |p|, its phase and the power at wavenumbers from 0.1 to 2 1/m."""
    model = LinearModel(column(folder, "plug", 0.1, 2.0))
    assert model.database is not None
    omega = model.database.omega[: len(answers)]
    np.testing.assert_allclose(omega, answers["w_rad_s"], rtol=1e-5)
    found = model.response(omega)
    np.testing.assert_allclose(np.abs(found[AMPLITUDE]), answers["turbine_q_m_m"], rtol=1e-4)
    np.testing.assert_allclose(np.abs(found[PRESSURE]), answers["turbine_p_Pa_m"], rtol=1e-4)
    phase = np.degrees(np.angle(found[PRESSURE]))
    np.testing.assert_allclose(phase, answers["turbine_p_phase_deg"], atol=6e-3)  # 1e-4 rad
    np.testing.assert_allclose(found.power["air"], answers["turbine_W_m2"], rtol=1e-4)


def test_orifice_by_its_describing_function(folder: Path, answers: Any) -> None:
    database = hydrodae.hdb.HydroDatabase.read(folder / "hydro.h5")
    for k in range(0, len(answers), 4):
        found = hydrodae.spectral(column(folder, "orifice", 0.1, float(database.omega[k])))
        row = answers[k]
        q, p = (0.05 * abs(found.channel(name)[0]) for name in (AMPLITUDE, PRESSURE))
        assert q == pytest.approx(row["orifice_q_m"], rel=1e-4)
        assert p == pytest.approx(row["orifice_p_Pa"], rel=1e-4)
        assert found.power["air"] == pytest.approx(row["orifice_W"], rel=1e-4)


def harmonic(run: Any, name: str, omega: float) -> complex:
    """First harmonic of the last five periods."""
    late = slice(-201, -1)
    values, time = run[name].values[late], run.time[late]
    return complex(2.0 * np.mean((values - values.mean()) * np.exp(-1j * omega * time)))


@pytest.mark.parametrize("k", [1, 5, 11, 17])
def test_regular_waves_in_time(folder: Path, answers: Any, k: int) -> None:
    """Waves of 1 cm: A and B of their frequency."""
    row = answers[k]
    omega = float(row["w_rad_s"])
    run = hydrodae.run(column(folder, "plug", 0.02, omega))
    q, p = (abs(harmonic(run, name, omega)) / 0.01 for name in (AMPLITUDE, PRESSURE))
    assert q == pytest.approx(row["turbine_q_m_m"], rel=5e-3)
    assert p == pytest.approx(row["turbine_p_Pa_m"], rel=5e-3)


@pytest.mark.parametrize("k", [1, 4, 11])
def test_orifice_in_time(folder: Path, answers: Any, k: int) -> None:
    """The describing function is within 5 % of the motion in runs, and about that of the pressure.

    Where the flow is harmonic its pressure goes with cos |cos|, whose harmonic is 8 / (3 pi): that
    is 8 / (3 pi) 1.1128^2 = 1.051 times the pressure of the describing function.
    """
    most = 8.0 / (3.0 * np.pi) * 1.1128**2 - 1.0
    row = answers[k]
    omega = float(row["w_rad_s"])
    run = hydrodae.run(column(folder, "orifice", 0.1, omega, laminar=0.5))
    q, p = (abs(harmonic(run, name, omega)) for name in (AMPLITUDE, PRESSURE))
    assert q == pytest.approx(row["orifice_q_m"], rel=0.05)
    assert p == pytest.approx(row["orifice_p_Pa"], rel=most + 2e-3)
