"""Fits of the exponential memory: many coordinates, noise, fast poles and passivity."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.python.resonances import LABELS, exact_transfer, table
from tests.verification.point_absorbers import Table

from hydrodae import hdb
from hydrodae.hdb.memory import MemoryFitWarning, fit_memory
from hydrodae.hdb.memory import data as prepare
from hydrodae.hdb.memory.goal import Goal, measure
from hydrodae.hdb.memory.search import fit_problem
from hydrodae.hdb.memory.vector_fitting import SEEN


@pytest.fixture(scope="module")
def exact() -> Table:
    omega = np.arange(0.05, 5.01, 0.05)
    return table(exact_transfer(omega), omega)


def test_non_passive_data_give_a_passive_fit_that_says_so(exact: Table) -> None:
    damping = exact.radiation_damping.copy()
    # waves that give energy: more negative damping in heave than there is positive
    damping[:, 1, 1] -= 0.6 * damping[:, 1, 1].max() * np.exp(-(((exact.omega - 2.8) / 0.3) ** 2))
    bad = replace(exact, radiation_damping=damping)
    with pytest.warns(MemoryFitWarning, match="misses its target"):
        memory = fit_memory(bad, LABELS, max_states=20)
    assert memory.report["data_min_eig_relative"] < -0.1
    assert memory.report["target_met"] is False
    assert memory.report["passive"] == (memory.report["min_eig_re_h_relative"] >= -1e-4)
    assert memory.passivity().relative == pytest.approx(
        memory.report["min_eig_re_h_relative"], abs=1e-6
    )


def test_groups_of_many_coordinates_keep_to_the_states_allowed(exact: Table) -> None:
    """Modes leave a tenth at a time; the table ends early."""
    omega = np.arange(0.02, 0.83, 0.02)
    short = table(exact_transfer(omega), omega)
    data = prepare.gather(short, LABELS, LABELS)
    goal = Goal((0.1, 0.8), 10.0, 1e-3, 0.1, None, 1e-3)
    pick = np.arange(len(LABELS))
    matrices = prepare.scaled(data.square, data.scale, pick)
    problem = prepare.make_problem(data.omega, matrices, goal.band, goal.factor)
    said: list[str] = []
    found = fit_problem(problem, goal, None, True, said.append)
    assert found.passive
    assert goal.met(found.quality)
    assert found.modes.n_states <= 24
    assert any("vector fit with 12 poles" in text for text in said)
    few = fit_problem(problem, goal, 6, True, said.append)
    assert few.passive
    assert few.modes.n_states <= 6


def test_poles_stay_within_the_table_unless_the_fit_needs_faster_ones(
    exact: Table, repository: Path
) -> None:
    sphere = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    fit = fit_memory(sphere, ["sphere.heave"], band=(0.3, 3.0), target=1e-4)
    assert fit.report["target_met"] is True
    assert -fit.poles.real.min() <= SEEN * sphere.omega[-1] * (1.0 + 1e-9)
    # the same modes in a table that ends below their frequencies
    omega = np.arange(0.02, 0.83, 0.02)
    short = fit_memory(table(exact_transfer(omega), omega), LABELS, band=(0.1, 0.8), uniform=1e-3)
    assert short.report["passive"] is True
    assert short.report["target_met"] is True


def test_errors_that_alternate_rank_before_smaller_ones_that_stay(exact: Table) -> None:
    """A motion averages errors over the width of its resonance: noise that is followed is worse."""
    data = prepare.gather(exact, LABELS, LABELS)
    goal = Goal((0.1, 0.8), 10.0, 1e-3, 0.1, None)
    matrices = prepare.scaled(data.square, data.scale, np.arange(len(LABELS)))
    problem = prepare.make_problem(data.omega, matrices, goal.band, goal.factor)
    mass = np.zeros(problem.rows.size)
    size = np.full((data.omega.size, problem.rows.size), 1e-3 + 0j)
    turns = (-1.0) ** np.arange(data.omega.size)[:, None]
    noise = measure(1.5 * size * turns, mass, problem, goal.band)
    bias = measure(size, mass, problem, goal.band)
    assert noise.weighted_band == pytest.approx(1.5 * bias.weighted_band)
    assert noise.steady < 0.5 * bias.steady
    assert bias.steady == pytest.approx(bias.weighted_band)
    assert goal.distance(noise) < goal.distance(bias)
    assert goal.miss(noise) > goal.miss(bias)


def test_noise_that_gives_energy_is_not_followed(exact: Table) -> None:
    """B with eigenvalues down to -1 % of the largest: passive, and says what it misses."""
    noise = np.random.default_rng(1).standard_normal(exact.radiation_damping.shape)
    size = np.sqrt(np.einsum("wii->wi", exact.radiation_damping).max(axis=0))
    noise = 0.01 * (noise + noise.transpose(0, 2, 1)) * size * size[:, None]
    noisy = replace(exact, radiation_damping=exact.radiation_damping + noise)
    with pytest.warns(MemoryFitWarning, match="misses its target"):
        memory = fit_memory(noisy, LABELS, max_states=12)
    assert memory.report["data_min_eig_relative"] < -5e-3
    assert memory.report["passive"] is True
    assert memory.n_states <= 12
    # nearer to the truth than the tables are
    omega = noisy.omega[noisy.omega <= 1.0]
    off = (memory.transfer(omega) - exact_transfer(omega)).real / size / size[:, None]
    rough = noise[: omega.size] / size / size[:, None]
    assert np.sqrt(np.mean(off**2)) < 0.7 * np.sqrt(np.mean(rough**2))
