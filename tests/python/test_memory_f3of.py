"""Memory of the F3OF flaps (reference database) against the decay without memory cut."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from tests.verification import cummins
from tests.verification.cummins import ALL_LABELS, FLAP_LABELS, nrms

from hydrodae.hdb.memory import ExponentialMemory, MemoryFitWarning, fit_memory

HINGE_LEVER = 3.5  # m, centre of gravity above the hinge
BASE_LABELS = tuple(label for label in ALL_LABELS if label.startswith("base"))


@pytest.fixture(scope="module")
def data(reference: Path) -> cummins.Radiation:
    return cummins.read_reference(reference / "f3of" / "hdb.h5")[0]


@pytest.fixture(scope="module")
def truth(reference: Path) -> cummins.CumminsModel:
    data, bodies = cummins.read_reference(reference / "f3of" / "hdb.h5")
    return cummins.f3of_dt3(data, bodies)


@pytest.fixture(scope="module")
def memory(data: cummins.Radiation) -> ExponentialMemory:
    return fit_memory(data, FLAP_LABELS, (*FLAP_LABELS, *BASE_LABELS), name="flaps_planar")


def reduced_system(memory: ExponentialMemory, truth: cummins.CumminsModel) -> np.ndarray:
    """State matrix of (angles, rates, Re z, Im z), the fit projected on the two hinge angles."""
    columns = [memory.inputs.index(label) for label in FLAP_LABELS]
    rows = [memory.outputs.index(label) for label in FLAP_LABELS]
    turn = np.zeros((6, 2))
    turn[:3, 0] = turn[3:, 1] = HINGE_LEVER, 0.0, 1.0
    inlet = memory.input_matrix[:, columns] @ turn
    outlet = turn.T @ memory.output_matrix[rows]
    inertia = truth.mass + turn.T @ memory.added_mass_inf[np.ix_(rows, columns)] @ turn
    m, poles = memory.poles.size, memory.poles
    system = np.zeros((4 + 2 * m, 4 + 2 * m))
    system[:2, 2:4] = np.eye(2)
    system[2:4, :2] = -np.linalg.solve(inertia, truth.stiffness)
    system[2:4, 4:] = -np.linalg.solve(inertia, np.hstack([outlet.real, -outlet.imag]))
    system[4:, 2:4] = np.vstack([inlet.real, inlet.imag])
    real, imag = np.diag(poles.real), np.diag(poles.imag)
    system[4:, 4:] = np.block([[real, -imag], [imag, real]])
    return system


def decay(memory: ExponentialMemory, truth: cummins.CumminsModel, time: np.ndarray) -> np.ndarray:
    values, vectors = np.linalg.eig(reduced_system(memory, truth))
    start = np.zeros(values.size, dtype=complex)
    start[0] = 1.0
    weights = np.linalg.solve(vectors, start)
    return ((vectors[:2] * weights) @ np.exp(np.outer(values, time))).real.T


def test_few_states_and_passive(memory: ExponentialMemory) -> None:
    assert memory.n_states <= 60
    assert memory.report["target_met"] is True
    assert memory.report["passive"] is True
    assert memory.passivity(4.8, points=20000).relative >= -1e-4


@pytest.mark.parametrize("end", [50.0, 100.0])
def test_linear_decay_against_the_truth(
    memory: ExponentialMemory, truth: cummins.CumminsModel, end: float
) -> None:
    time = np.arange(0.0, end + 0.05, 0.1)
    exact, fitted = truth.free_decay([1.0, 0.0], time), decay(memory, truth, time)
    assert nrms(fitted[:, 0], exact[:, 0]) <= 0.002
    assert nrms(fitted[:, 1], exact[:, 1]) <= 0.006


def test_all_coupled_modes_decay(memory: ExponentialMemory, truth: cummins.CumminsModel) -> None:
    assert np.linalg.eigvals(reduced_system(memory, truth)).real.max() < 0.0


def test_long_decay_keeps_its_amplitude(
    memory: ExponentialMemory, truth: cummins.CumminsModel
) -> None:
    time = np.arange(900.0, 1000.0, 0.25)
    exact = np.abs(truth.free_decay([1.0, 0.0], time)).max()
    assert np.abs(decay(memory, truth, time)).max() == pytest.approx(exact, rel=0.1)
    assert np.abs(decay(memory, truth, np.arange(0.0, 1000.0, 0.25))).max() <= 1.0 + 1e-9


def test_impedance_at_the_resonance(memory: ExponentialMemory, data: cummins.Radiation) -> None:
    # B and A about the hinge at 0.45 rad/s decide the decay; the peaks of B are 4e8 N m s
    k = int(np.argmin(np.abs(data.omega - 0.45)))
    index = [data.coordinates.index(label) for label in FLAP_LABELS]
    exact = (data.radiation_damping + 1j * data.omega[:, None, None] * data.added_mass)[k]
    omega = data.omega[k]
    fitted = memory.transfer(np.array([omega]))[0, :6] + 1j * omega * memory.added_mass_inf[:6]
    turn = np.zeros((6, 2))
    turn[:3, 0] = turn[3:, 1] = HINGE_LEVER, 0.0, 1.0
    off = turn.T @ (fitted - exact[np.ix_(index, index)]) @ turn
    assert np.abs(off.real).max() < 1.5e3
    assert np.abs(off.imag).max() / omega < 1e4


def test_loads_on_the_fixed_base(memory: ExponentialMemory, data: cummins.Radiation) -> None:
    assert memory.outputs == (*FLAP_LABELS, *BASE_LABELS)
    inside = data.omega <= 1.0
    omega = data.omega[inside]
    rows = [data.coordinates.index(label) for label in BASE_LABELS]
    columns = [data.coordinates.index(label) for label in FLAP_LABELS]
    pick = np.ix_(np.flatnonzero(inside), np.array(rows), np.array(columns))
    exact = data.radiation_damping[pick] + 1j * omega[:, None, None] * data.added_mass[pick]
    fitted = memory.transfer(omega)[:, 6:] + 1j * omega[:, None, None] * memory.added_mass_inf[6:]
    size = np.linalg.norm(exact, axis=(0, 2))
    assert np.all(np.linalg.norm(fitted - exact, axis=(0, 2)) < 5e-3 * size)


@pytest.mark.slow
def test_all_planar_coordinates(data: cummins.Radiation, truth: cummins.CumminsModel) -> None:
    with warnings.catch_warnings():
        # misses its target of 4.5e-4 by a tenth: 4.88e-4
        warnings.simplefilter("ignore", MemoryFitWarning)
        memory = fit_memory(data, ALL_LABELS, name="planar")
    assert memory.report["weighted_error_band"] <= 5.4e-4
    assert memory.n_states <= 110
    assert memory.report["passive"] is True
    time = np.arange(0.0, 100.05, 0.1)
    exact, fitted = truth.free_decay([1.0, 0.0], time), decay(memory, truth, time)
    assert nrms(fitted[:, 0], exact[:, 0]) <= 0.003
    assert nrms(fitted[:, 1], exact[:, 1]) <= 0.006
    assert np.linalg.eigvals(reduced_system(memory, truth)).real.max() < 0.0
