"""What the benchmark of arrays builds: water that gives no energy, units that are joined."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.benchmark import hexagonal_arrays

import hydrodae
from hydrodae import arrays, hdb


@pytest.fixture(scope="module")
def tables() -> hdb.HydroDatabase:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(hexagonal_arrays, "WATER", hdb.Water(np.linspace(1.2, 6.3, 6), 6.0))
        return hexagonal_arrays.water(3)


@pytest.mark.parametrize("limited", [False, True])
def test_water_is_passive_and_joins_what_it_should(
    tables: hdb.HydroDatabase, tmp_path: Path, limited: bool
) -> None:
    bodies, states = hexagonal_arrays.write(tables, 3, True, limited, tmp_path)
    assert bodies == 3 + 2
    fit = hdb.read(tmp_path / "hydro.h5").memory["bank"]
    assert fit.n_states == states
    assert fit.passivity().relative > -1e-9
    far = fit.transfer(np.array([2.0]))[0, :6, 6:12]
    assert bool(np.all(far == 0.0)) is limited
    report = str(hydrodae.check(tmp_path / "case.toml"))
    assert f"mobility: {5 * 6 - 4 * 3} degrees of freedom left by 12" in report


def test_arms_join_all_units_to_a_tree() -> None:
    units = arrays.hexagonal(19, 3.0)
    arms = hexagonal_arrays.joints(units)
    reached = {"u1_buoy"}
    for inner, outer in arms.values():
        assert inner in reached
        reached.add(outer)
    assert len(reached) == 19
