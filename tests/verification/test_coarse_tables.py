"""Radiation kernels of tables with steps of any kind, against a memory known in closed form.

The memory is rational: H(s) = r s / (s^2 + 2 a s + w0^2), so that

    B = 2 a r w^2 / D,    A = A_inf + r (w0^2 - w^2) / D,    D = (w0^2 - w^2)^2 + (2 a w)^2,

and a heaving body with it is a linear system of four states.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import expm
from tests.attack.parts import body, case
from tests.verification.blocks import run_tables

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase, kernels
from hydrodae.hdb.database.radiation_kernel import LIMIT, make_kernel
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.support.arrays import Array

RHO, GRAVITY, VOLUME, AREA = 1000.0, 9.81, 200.0, 78.5
MASS, MASS_INF = RHO * VOLUME, 1.0e5  # kg
GAIN, SPREAD, CENTRE = 1.2e5, 0.6, 1.5  # r [N/m], a, w0 [rad/s]
BAND = (0.2, 3.0)
START = 0.1  # m

FINE = {
    "uniform in period": 2.0 * np.pi / np.arange(40.0, 0.4, -0.5),
    "uniform in period, from 1 s": 2.0 * np.pi / np.arange(30.0, 0.9, -0.5),
    "uniform in frequency": 0.1 * np.arange(1, 101),
    "log-spaced": np.geomspace(0.05, 10.0, 40),
    "a gap above the band": np.r_[0.1 * np.arange(1, 41), 0.1 * np.arange(60, 101)],
}
COARSE = {
    "uniform in period": 2.0 * np.pi / np.arange(20.0, 1.9, -2.0),
    "uniform in frequency": 0.7 * np.arange(1, 15),
    "log-spaced": np.geomspace(0.05, 10.0, 12),
    "a gap at the peak": np.r_[0.1 * np.arange(1, 9), 0.1 * np.arange(25, 101)],
}


def memory(w: Array) -> tuple[Array, Array]:
    """A(w) [kg] and B(w) [N s/m]."""
    d = (CENTRE**2 - w**2) ** 2 + (2.0 * SPREAD * w) ** 2
    return MASS_INF + GAIN * (CENTRE**2 - w**2) / d, 2.0 * SPREAD * GAIN * w**2 / d


def database(w: Array) -> HydroDatabase:
    a, b = memory(w)
    hull = Hydrostatics(
        VOLUME, np.array([0.0, 0.0, -1.3]), AREA, np.array([0.0, 0.0, 500.0, 500.0, 0.0])
    )
    return HydroDatabase(
        coordinates=("buoy.heave",),
        omega=w,
        added_mass=a[:, None, None],
        radiation_damping=b[:, None, None],
        added_mass_inf=np.full((1, 1), MASS_INF),
        added_mass_inf_std=np.zeros((1, 1)),
        heading=np.zeros(1),
        froude_krylov=np.zeros((w.size, 1, 1), dtype=complex),
        diffraction=np.zeros((w.size, 1, 1), dtype=complex),
        bodies={"buoy": Body("buoy", np.array([0.0, 0.0, -1.3]), hull)},
        rho=RHO,
        gravity=GRAVITY,
    )


def decay(time: Array) -> Array:
    """Heave after a release from START: x'' and y'' + 2 a y' + w0^2 y = x', force r y'."""
    whole, stiffness = MASS + MASS_INF, RHO * GRAVITY * AREA
    system = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [-stiffness / whole, 0.0, 0.0, -GAIN / whole],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 1.0, -(CENTRE**2), -2.0 * SPREAD],
        ]
    )
    return np.array([(expm(system * t) @ [START, 0.0, 0.0, 0.0])[0] for t in time])


def true_error(db: HydroDatabase, limit: float = np.inf) -> tuple[float, float]:
    """Rms error of H over the band, on a fine grid, and what the kernel says of itself."""
    kernel = make_kernel(db, ["buoy.heave"], band=BAND, limit=limit)
    w = np.linspace(*BAND, 2000)
    a, b = memory(w)
    h = b + 1j * w * (a - MASS_INF)
    found = kernel.transfer(w)[:, 0, 0] + 1j * w * (kernel.added_mass_inf[0, 0] - MASS_INF)
    said = np.hypot(kernel.report["h_error_band"], kernel.report["h_error_between"])
    return float(np.linalg.norm(found - h) / np.linalg.norm(h)), float(said)


@pytest.mark.parametrize("grid", FINE)
def test_fine_tables_make_right_kernels_whatever_their_steps(grid: str, tmp_path: Path) -> None:
    """The steps of half of these reach 6 rad/s, where nothing is left of the memory."""
    db = database(FINE[grid])
    error, said = true_error(db)
    assert error < 4e-3
    assert error < 1.5 * said
    db.with_kernel(band=BAND).write(tmp_path / "hydro.h5")
    start = [0.0, 0.0, START]
    buoy = body("buoy", "heave", MASS, [0.0, 0.0, -1.3], [1e6] * 3, displacement=start)
    water = {"database": "hydro.h5", "radiation": "convolution"}
    tables = case([buoy | {"hydro": "buoy"}], 20.0, hydro=water)
    run = run_tables(tables, tmp_path, rtol=1e-6)
    heave = run["bodies/buoy/position"].sel(component="z")
    exact = decay(heave["time"].values)
    assert np.abs(heave.values + 1.3 - exact).max() < 4e-3 * START


@pytest.mark.parametrize("grid", COARSE)
def test_coarse_tables_are_refused_and_their_error_is_known(grid: str) -> None:
    """What a kernel says of its error is within a factor of two; the remedy names frequencies."""
    db = database(COARSE[grid])
    error, said = true_error(db)
    assert error > LIMIT
    assert 0.5 * error < said < 2.0 * error
    with pytest.raises(DatabaseError, match=r"compute more frequencies, first between .* rad/s"):
        make_kernel(db, ["buoy.heave"], band=BAND)


def test_a_memory_cut_short_is_refused() -> None:
    db = database(FINE["uniform in frequency"])
    with pytest.raises(
        DatabaseError, match=r"a longer --length \(\d+% of int \|K\| is beyond 2 s\)"
    ):
        make_kernel(db, ["buoy.heave"], band=BAND, length=2.0)
    assert make_kernel(db, ["buoy.heave"], band=BAND, length=2.0, limit=1.0).length >= 2.0


def test_steps_without_damping_do_not_limit_the_memory() -> None:
    """`memory_length` covers e^{-a t} to a twentieth where the steps reach 6 rad/s."""
    for w in FINE.values():
        assert kernels.memory_length(database(w)) > np.log(18.0) / SPREAD


def test_excitation_kernel_of_log_spaced_tables() -> None:
    """F = c e^{-w/b} has K_ex = c b / (pi (1 + b^2 t^2)); F(0) is not c but rho g A_w = c."""
    w, b = np.geomspace(1e-3, 40.0, 200), 1.5
    c = RHO * GRAVITY * AREA
    db = database(w)
    db.diffraction = (c * np.exp(-w / b)).astype(complex)[:, None, None]
    t = np.array([-30.0, -2.0, 0.0, 0.7, 30.0, 200.0])
    exact = c * b / np.pi / (1.0 + (b * t) ** 2)
    assert np.abs(kernels.excitation_kernel(db, t)[:, 0, 0] - exact).max() < 1e-4 * exact.max()


def test_exact_memory_is_what_the_tables_say() -> None:
    """K(t) by numerical quadrature of B gives K(0) = r."""
    area = quad(lambda w: memory(np.array(w))[1], 0.0, np.inf)[0]
    assert 2.0 / np.pi * area == pytest.approx(GAIN, rel=1e-6)
