"""States that a radiation memory needs, judged by the motion: sphere, RM3, F3OF, four nodes.

Errors of decays: largest difference from the linear solution without memory cut over the release.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from tests.verification import cummins
from tests.verification.test_rm3 import FLOAT, decay_model

from hydrodae import hdb
from hydrodae.hdb.memory import ExponentialMemory, MemoryFitWarning, fit_memory
from hydrodae.linear import LinearModel, states
from hydrodae.study.band import working_band

PLANAR = tuple(f"{b}.{d}" for b in ("float", "spar") for d in ("surge", "heave", "pitch"))


def decay_error(
    model: LinearModel, memory: ExponentialMemory, coordinate: str, end: float
) -> np.ndarray:
    """Largest error of each coordinate over the release of one of them."""
    start = np.zeros(len(model.coordinates))
    start[model.coordinates.index(coordinate)] = 1.0
    time = np.arange(0.0, end, 0.05)
    exact = cummins.decay_of_case(model, start, time)
    return np.asarray(np.abs(states.decay(model, memory, start, time) - exact).max(axis=0))


def test_sphere_in_heave_needs_8_states(repository: Path) -> None:
    case = repository / "cases" / "sphere" / "decay.toml"
    model = LinearModel(case)
    assert model.database is not None
    stored = model.database.memory["heave"]
    band = working_band(str(case), model.database)
    ours = fit_memory(model.database, ["sphere.heave"], band=band, target=1e-4)
    for memory in (stored, ours):
        assert memory.n_states <= 8
        assert memory.report["passive"]
        assert decay_error(model, memory, "bodies/sphere/heave", 40.0)[0] <= 2e-4
        assert states.largest_growth(model, memory) < 0.0


def test_rm3_in_heave_needs_16_states(reference: Path, rm3: Path) -> None:
    model = decay_model(rm3 / "heave.h5")
    assert model.database is not None
    memory = model.database.memory["heave"]
    assert memory.n_states <= 16
    assert memory.report["passive"]
    assert decay_error(model, memory, FLOAT, 100.0).max() <= 1e-3
    assert states.largest_growth(model, memory) < 0.0


@pytest.mark.long
def test_rm3_in_the_plane_needs_40_states(reference: Path, rm3: Path) -> None:
    database = hdb.read(reference / "hdb" / "rm3_wamit", rho=1000.0)
    database.write(rm3 / "tables.h5")
    model = decay_model(rm3 / "tables.h5", motion="planar")
    band = working_band(str(rm3 / "decay.toml"), database)
    assert band == pytest.approx((0.1, 1.64), rel=0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MemoryFitWarning)  # noise of the tables, 1e-2 in B
        memory = fit_memory(database, PLANAR, band=(0.1, 1.6), max_states=40)
    assert memory.n_states <= 40
    assert memory.report["passive"]
    assert decay_error(model, memory, FLOAT, 100.0).max() <= 1e-3
    assert states.largest_growth(model, memory) < 0.0


@pytest.mark.long
def test_all_of_f3of_needs_200_states(reference: Path) -> None:
    """Planar and lateral motion apart; the flaps as in tests/python/test_memory_f3of.py."""
    from tests.python.test_memory_f3of import decay, reduced_system

    data, bodies = cummins.read_reference(reference / "f3of" / "hdb.h5")
    truth = cummins.f3of_dt3(data, bodies)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MemoryFitWarning)
        memory = fit_memory(data, data.coordinates)
    assert memory.n_states <= 200
    assert memory.report["passive"]
    assert len(memory.report["groups"].split(";")) == 2
    for end in (50.0, 100.0):
        time = np.arange(0.0, end + 0.05, 0.1)
        exact, fitted = truth.free_decay([1.0, 0.0], time), decay(memory, truth, time)
        assert cummins.nrms(fitted[:, 0], exact[:, 0]) <= 0.002
        assert cummins.nrms(fitted[:, 1], exact[:, 1]) <= 0.006
    assert np.linalg.eigvals(reduced_system(memory, truth)).real.max() < 0.0


@pytest.mark.long
def test_four_nodes_need_170_states(reference: Path) -> None:
    """Twenty coordinates that radiate, waves that travel between the bodies; H within 1 %."""
    database = hdb.read(reference / "hdb" / "own" / "4n3la.nc")
    with pytest.warns(MemoryFitWarning, match="no radiation in S3.yaw"):
        memory = fit_memory(database, database.coordinates, band=(1.0, 8.0), uniform=0.01)
    assert memory.n_states <= 170
    assert memory.report["passive"]
    assert memory.report["h_error_peak"] <= 0.01


@pytest.mark.long
def test_four_nodes_whose_table_ends_early(reference: Path) -> None:
    """The damping of pitch still grows at the last frequency: no K(t) of it is known."""
    source = reference / "hdb" / "own" / "4n3la.nc"
    database, _ = hdb.import_database(source, cut=9.0)
    with pytest.warns(MemoryFitWarning, match="no radiation in S3.yaw"):
        memory = fit_memory(database, database.coordinates, band=(0.6, 7.0), uniform=0.01)
    assert memory.n_states <= 150
    assert memory.report["passive"]
    assert memory.report["h_error_peak"] <= 0.01


def test_free_devices_come_to_rest(repository: Path) -> None:
    """All modes of the free device decay with every stored fit that covers it, without any PTO."""
    folder = repository / "cases" / "f3of"
    for name in ("flap_decay.toml", "surge_decay.toml", "rao.toml"):
        model = LinearModel(folder / name)
        if name == "rao.toml":
            model.damping[:] = 0.0
        assert model.database is not None
        for memory in model.database.memory.values():
            if set(model.hydro_labels) <= set(memory.inputs):
                assert states.largest_growth(model, memory) < 0.0, (name, memory.name)
