"""The untruncated linear Cummins model: closed form, convergence, published F3OF figures."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.verification import cummins
from tests.verification.cummins import nrms

# published figures of the reference data (README of f3of)
FLAP_EXTREMA_DEG = (-9.12, 9.02, -8.91, 8.78)
SURGE_EXTREMA = (-4.977, 4.969, -4.962, 4.956)


def extrema(x: np.ndarray) -> np.ndarray:
    turning = (x[1:-1] - x[:-2]) * (x[2:] - x[1:-1]) < 0
    return np.asarray(x[1:-1][turning])


def mean_period(time: np.ndarray, x: np.ndarray, cycles: int) -> float:
    down = np.flatnonzero((x[:-1] > 0) & (x[1:] <= 0))[: cycles + 1]
    crossing = time[down] + (time[down + 1] - time[down]) * x[down] / (x[down] - x[down + 1])
    return float(np.diff(crossing).mean())


@pytest.fixture(scope="module")
def flaps(reference: Path) -> cummins.CumminsModel:
    data, bodies = cummins.read_reference(reference / "f3of" / "hdb.h5")
    return cummins.f3of_dt3(data, bodies)


@pytest.fixture(scope="module")
def device(reference: Path) -> cummins.CumminsModel:
    data, bodies = cummins.read_reference(reference / "f3of" / "hdb.h5")
    return cummins.f3of_dt1(data, bodies)


def state_space_decay(
    stiffness: float, total_mass: float, pole: tuple[float, float], gain: float, time: np.ndarray
) -> np.ndarray:
    """Decay of one coordinate with the memory r s/(s^2 + 2 a s + w0^2), by eigenvectors."""
    a, w0 = pole
    # x = (q, v, y, y'): y'' + 2 a y' + w0^2 y = v, memory force r y'
    matrix = np.array(
        [
            [0.0, 1.0, 0.0, 0.0],
            [-stiffness / total_mass, 0.0, 0.0, -gain / total_mass],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 1.0, -(w0**2), -2.0 * a],
        ]
    )
    values, vectors = np.linalg.eig(matrix)
    start = np.linalg.solve(vectors, np.array([1.0, 0.0, 0.0, 0.0], dtype=complex))
    return np.asarray(((vectors[0] * start) @ np.exp(np.outer(values, time))).real)


def test_damped_cosine_memory_against_its_state_space() -> None:
    mass, added_mass, stiffness, gain, pole = 2.0, 1.0, 1.2, 0.5, (0.2, 0.9)
    omega = np.arange(0.025, 12.0, 0.025)
    s = 1j * omega
    transfer = gain * s / (s**2 + 2 * pole[0] * s + pole[1] ** 2)
    model = cummins.CumminsModel(
        mass=np.array([[mass]]),
        stiffness=np.array([[stiffness]]),
        omega=omega,
        added_mass=(added_mass + transfer.imag / omega)[:, None, None],
        radiation_damping=np.asarray(transfer.real, dtype=float)[:, None, None],
        added_mass_inf=np.array([[added_mass]]),
    )
    time = np.linspace(0.0, 60.0, 601)
    exact = state_space_decay(stiffness, mass + added_mass, pole, gain, time)
    assert nrms(model.free_decay([1.0], time)[:, 0], exact) < 1e-4


def test_hinge_stiffness_has_the_net_lift(flaps: cummins.CumminsModel) -> None:
    assert flaps.stiffness == pytest.approx(np.diag([9.339e6, 9.339e6]), rel=1e-4)


def test_assembly_stiffness(device: cummins.CumminsModel) -> None:
    assert np.diag(device.stiffness) == pytest.approx([1e5, 1.0202e6, 1.874e8], rel=2e-4)


def test_flap_decay_figures(flaps: cummins.CumminsModel) -> None:
    time = np.arange(0.0, 100.0, 0.1)
    angle = flaps.free_decay([10.0, 0.0], time)
    assert angle[0] == pytest.approx([10.0, 0.0], abs=2e-3)
    assert extrema(angle[:, 0])[:4] == pytest.approx(FLAP_EXTREMA_DEG, abs=0.012)
    assert mean_period(time, angle[:, 0], 5) == pytest.approx(14.07, abs=0.01)


def test_surge_decay_figures(device: cummins.CumminsModel) -> None:
    time = np.arange(0.0, 300.0, 0.1)
    surge = device.free_decay([5.0, 0.0, 0.0], time)[:, 0]
    assert extrema(surge)[:4] == pytest.approx(SURGE_EXTREMA, abs=1e-3)
    assert mean_period(time, surge, 5) == pytest.approx(47.66, abs=0.01)


@pytest.mark.parametrize(
    "change",
    [{"sigma": 0.0025}, {"sigma": 0.01}, {"omega_max": 80.0}],
    ids=["half sigma", "twice sigma", "longer line"],
)
def test_result_does_not_depend_on_the_line(
    flaps: cummins.CumminsModel, change: dict[str, float]
) -> None:
    # below the 1e-3 / 3e-3 that the grid of the data decides
    time = np.arange(0.0, 100.0, 0.1)
    base, other = (flaps.free_decay([1.0, 0.0], time, **options) for options in ({}, change))
    assert nrms(other[:, 0], base[:, 0]) < 2e-4
    assert nrms(other[:, 1], base[:, 1]) < 4e-4


def test_long_decay_is_bounded(flaps: cummins.CumminsModel) -> None:
    time = np.arange(900.0, 1000.0, 0.25)
    late = np.abs(flaps.free_decay([1.0, 0.0], time)).max()
    assert late == pytest.approx(0.51, abs=0.01)


@pytest.mark.parametrize(
    ("code", "build", "limit"),
    [("INW", "dt1", 0.02), ("WDN", "dt1", 0.02), ("PDS", "dt3", 0.06), ("WDN", "dt3", 0.08)],
)
def test_other_codes_in_the_first_50_seconds(
    reference: Path,
    flaps: cummins.CumminsModel,
    device: cummins.CumminsModel,
    code: str,
    build: str,
    limit: float,
) -> None:
    name, column, model, start = {
        "dt1": ("dt1_surge_decay.csv", f"{code}_surge_m", device, [5.0, 0.0, 0.0]),
        "dt3": ("dt3_flap1_decay.csv", f"{code}_flap1_deg", flaps, [10.0, 0.0]),
    }[build]
    table = np.genfromtxt(reference / "f3of" / name, delimiter=",", names=True)
    inside = table["t_s"] <= 50.0
    series = table[column][inside]
    time = table["t_s"][inside]
    assert nrms(model.free_decay(start, time)[:, 0], series) < limit
