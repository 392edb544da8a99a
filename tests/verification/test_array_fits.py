"""Fits of arrays in blocks, held against tables that are passive and causal by construction.

Passivity is judged by the eigenvalues of the Hamiltonian matrix: Re H(i w) + e I is singular at w
where i w is one, so that none on the imaginary axis means positive at all frequencies.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.special import j0
from tests.verification.point_absorbers import GRAVITY, Table, array_table, hexagon, star

from hydrodae import hdb
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.memory import ExponentialMemory, MemoryFitWarning, fit_memory, symmetry

OMEGA = np.arange(0.1, 8.01, 0.1)
RADIATING = ("surge", "sway", "heave", "roll", "pitch")


def scales(table: Table) -> np.ndarray:
    """Roots of the largest damping, (n,)."""
    return np.asarray(np.sqrt(np.einsum("wii->wi", table.radiation_damping).max(axis=0)))


def state_space(memory: ExponentialMemory, scale: np.ndarray) -> tuple[np.ndarray, ...]:
    """Real matrices (A, B, C) of H(s) = C (s - A)^-1 B in scaled coordinates."""
    single = memory.poles.imag == 0.0
    inlet, outlet = [], []
    total = memory.n_states
    matrix, at = np.zeros((total, total)), 0
    for pole, one, b, c in zip(
        memory.poles,
        single,
        memory.input_matrix / scale,
        (memory.output_matrix.T) / scale,
        strict=True,
    ):
        if one:
            matrix[at, at] = pole.real
            inlet.append(b.real)
            outlet.append(c.real)
            at += 1
            continue
        matrix[at : at + 2, at : at + 2] = [[pole.real, -pole.imag], [pole.imag, pole.real]]
        inlet += [b.real, b.imag]
        outlet += [c.real, -c.imag]
        at += 2
    return matrix, np.array(inlet), np.array(outlet).T


def crossings(memory: ExponentialMemory, scale: np.ndarray, lift: float) -> np.ndarray:
    """Frequencies at which an eigenvalue of Re H + lift I passes zero [rad/s]."""
    a, b, c = state_space(memory, scale)
    inverse = np.eye(b.shape[1]) / (2.0 * lift)
    hamiltonian = np.block(
        [
            [a - b @ inverse @ c, b @ inverse @ b.T],
            [-c.T @ inverse @ c, -a.T + c.T @ inverse @ b.T],
        ]
    )
    values = np.linalg.eigvals(hamiltonian)
    on_axis = np.abs(values.real) < 1e-9 * np.abs(values).max()
    return np.asarray(np.abs(values[on_axis].imag))


def largest(memory: ExponentialMemory, scale: np.ndarray) -> float:
    """Largest eigenvalue of Re H, scaled."""
    values = memory.transfer(np.linspace(0.0, 12.0, 600)).real / scale / scale[:, None]
    return float(np.linalg.eigvalsh(values).max())


def error(memory: ExponentialMemory, table: Table, band: tuple[float, float]) -> float:
    """Largest error of an entry of H over the largest entry, scaled, in the band."""
    inside = (table.omega >= band[0] - 1e-9) & (table.omega <= band[1] + 1e-9)
    omega, scale = table.omega[inside], scales(table)
    slope = 1j * omega[:, None, None]
    exact = table.radiation_damping[inside] + slope * (
        table.added_mass[inside] - memory.added_mass_inf
    )
    off = (memory.transfer(omega) - exact) / scale / scale[:, None]
    return float(np.abs(off).max() / np.abs(exact / scale / scale[:, None]).max())


@pytest.fixture(scope="module")
def four() -> Table:
    return array_table(star(), OMEGA, dofs=RADIATING)


@pytest.fixture(scope="module")
def fitted(four: Table) -> ExponentialMemory:
    return fit_memory(four, four.coordinates, band=(1.0, 6.0), uniform=0.01)


def test_tables_are_those_of_point_absorbers(four: Table) -> None:
    """B_ij = B_ii J0(k d) in heave, and no eigenvalue below rounding."""
    heave = [i for i, label in enumerate(four.coordinates) if label.endswith("heave")]
    damping = four.radiation_damping[:, heave][:, :, heave]
    wavenumber = four.omega**2 / GRAVITY
    expected = damping[:, 0, 0] * j0(1.4 * wavenumber)
    assert damping[:, 0, 1] == pytest.approx(expected, abs=1e-9 * damping.max())
    assert np.linalg.eigvalsh(damping).min() > -1e-12 * damping.max()


def test_tables_are_causal(four: Table) -> None:
    """Int K cos and int K sin of K = 2/pi int B cos give B and w (A_inf - A) back, in heave."""
    fine = array_table(star()[:1], np.arange(0.02, 16.0, 0.02), dofs=("heave",))
    time = np.linspace(0.0, 60.0, 6001)
    damping, step = fine.radiation_damping[:, 0, 0], time[1]
    kernel = 2.0 / np.pi * 0.02 * np.cos(np.outer(time, fine.omega)) @ damping
    kernel[0] *= 0.5
    i = int(np.argmin(np.abs(fine.omega - 3.0)))
    memory = step * kernel @ np.sin(3.0 * time)
    beyond = fine.added_mass[i, 0, 0] + memory / 3.0
    mass = 1025.0 * np.pi * 0.3**2 * 0.6 * 0.35
    assert beyond == pytest.approx(mass, rel=1e-3)


def test_symmetry_of_the_triangle_is_found(four: Table) -> None:
    """Representations of the triangle: 4 symmetric, 2 antisymmetric, a pair of 7 coordinates."""
    impedance = four.radiation_damping + 1j * four.omega[:, None, None] * four.added_mass
    turned = [label.endswith(("roll", "pitch")) for label in four.coordinates]
    impedance *= np.where(np.outer(turned, turned), 100.0, 1.0)
    impedance *= np.where(np.logical_xor.outer(turned, turned), 10.0, 1.0)
    blocks = next(
        found
        for found in symmetry.candidates(impedance)
        if np.abs(symmetry.symmetrised(impedance, found) - impedance).max()
        < 1e-6 * np.abs(impedance).max()
    )
    assert sorted((block.size, len(block.bases)) for block in blocks) == [(2, 1), (4, 1), (7, 2)]
    basis = np.hstack([part for block in blocks for part in block.bases])
    assert basis.T @ basis == pytest.approx(np.eye(20), abs=1e-10)
    kept = symmetry.symmetrised(four.radiation_damping, blocks)
    assert kept == pytest.approx(four.radiation_damping, abs=1e-9 * four.radiation_damping.max())


def test_an_array_without_symmetry_has_no_blocks() -> None:
    crooked = star() * np.array([1.0, 0.7]) + np.array([[0.3, 0.1], [0, 0], [0, 0.2], [0.1, 0]])
    table = array_table(crooked, OMEGA, dofs=("heave",))
    assert symmetry.candidates(table.radiation_damping + 0j) == []


def test_array_meets_its_target(four: Table, fitted: ExponentialMemory) -> None:
    assert error(fitted, four, (1.0, 6.0)) <= 0.011
    assert fitted.report["h_error_peak"] <= 0.01
    assert fitted.report["target_met"] is True
    assert "2 x 7" in fitted.report["symmetry"]
    assert fitted.n_states <= 110


def test_array_is_passive_at_all_frequencies(four: Table, fitted: ExponentialMemory) -> None:
    scale = scales(four)
    lift = 1e-4 * largest(fitted, scale)
    assert crossings(fitted, scale, lift).size == 0
    beyond = np.concatenate([np.linspace(0.0, 30.0, 3000), np.geomspace(30.0, 3e3, 100)])
    values = np.linalg.eigvalsh(fitted.transfer(beyond).real / scale / scale[:, None])
    assert values.min() > -lift


def test_crossings_tell_a_fit_that_is_not_passive(four: Table, fitted: ExponentialMemory) -> None:
    """The test above can fail: with one mode turned round, eigenvalues pass zero."""
    outlet = fitted.output_matrix.copy()
    outlet[:, np.argmax(np.linalg.norm(outlet, axis=0))] *= -1.0
    bad = ExponentialMemory(
        "bad",
        fitted.inputs,
        fitted.outputs,
        fitted.poles,
        fitted.input_matrix,
        outlet,
        fitted.added_mass_inf,
    )
    scale = scales(four)
    assert crossings(bad, scale, 1e-4 * largest(bad, scale)).size > 0


def test_noise_is_symmetrised() -> None:
    """Noise of 0.02 % on tables that ought to be symmetric hides nothing."""
    table = array_table(star(), OMEGA, noise=2e-4, dofs=("heave", "surge", "sway"))
    memory = fit_memory(table, table.coordinates, band=(1.0, 6.0), uniform=0.01)
    assert memory.report["symmetry"]
    assert 0.0 < memory.report["symmetry_left_out"] < 2e-3
    assert memory.report["passive"] is True
    exact = array_table(star(), OMEGA, dofs=("heave", "surge", "sway"))
    assert error(memory, exact, (1.0, 6.0)) <= 0.012


def test_a_fit_that_misses_its_target_is_refused(repository: Path) -> None:
    """Unless it is accepted by name; with a number of states the best of so many is taken."""
    database = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    options: dict[str, Any] = {"band": (0.3, 3.0), "target": 1e-7}
    with pytest.raises(DatabaseError, match=r"misses its target .* Not kept: .* --accept target"):
        hdb.fit(database, "sphere.heave", **options)
    with pytest.warns(MemoryFitWarning, match="misses its target"):
        accepted = hdb.fit(database, "sphere.heave", name="a", accept=["target"], **options)
    with pytest.warns(MemoryFitWarning, match="misses its target with 4 states"):
        limited = hdb.fit(database, "sphere.heave", name="b", states=4, **options)
    assert accepted.memory["a"].n_states > limited.memory["b"].n_states == 4
    with pytest.raises(CaseError, match="accept 'all': expected one of passive, target"):
        hdb.fit(database, "sphere.heave", accept=["all"])


@pytest.mark.slow
def test_nine_bodies_in_a_hexagon() -> None:
    """54 coordinates in a minute: blocks of 9, 6 and a pair of 15."""
    table = array_table(hexagon(), OMEGA, dofs=RADIATING)
    said: list[str] = []
    memory = fit_memory(
        table, table.coordinates, band=(1.0, 6.0), uniform=0.01, progress=said.append
    )
    assert any("2 x 15" in line for line in said)
    assert len(said) > 10
    assert error(memory, table, (1.0, 6.0)) <= 0.011
    assert memory.n_states <= 190
    scale = scales(table)
    assert crossings(memory, scale, 1e-4 * largest(memory, scale)).size == 0
