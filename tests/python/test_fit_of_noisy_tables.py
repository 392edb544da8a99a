"""Noisy tables get a fit at a stated error, nearer to the tables without noise than the noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase


def noisy(db: HydroDatabase, level: float) -> HydroDatabase:
    """Gaussian noise of a share of the largest value on B, and of a third of that share on A."""
    random = np.random.default_rng(1)
    tables = {}
    for name, share in (("added_mass", 0.3 * level), ("radiation_damping", level)):
        table = getattr(db, name)
        size = np.sqrt(np.abs(np.einsum("wii->wi", table)).max(axis=0))
        noise = random.standard_normal(table.shape)
        noise = (noise + noise.transpose(0, 2, 1)) / np.sqrt(2.0)
        tables[name] = table + share * np.outer(size, size) * noise
    return replace(db, **tables)


@pytest.mark.parametrize("level", [0.01, 0.1])
def test_a_fit_at_a_stated_error(sphere: HydroDatabase, level: float) -> None:
    found = hdb.fit(noisy(sphere, level), "sphere.heave").memory["default"]
    report = found.report
    assert report["passive"]
    assert report["weighted_error_band"] <= 1.5 * report["noise"]
    assert "loads of radiation are known to" in report["noisy"]
    i = sphere.coordinates.index("sphere.heave")
    low, high = report["band"]
    w = sphere.omega[(sphere.omega >= low) & (sphere.omega <= high)]
    at = np.isin(sphere.omega, w)
    true = sphere.radiation_damping[at, i, i] + 1j * w * sphere.added_mass[at, i, i]
    made = found.transfer(w)[:, 0, 0] + 1j * w * found.added_mass_inf[0, 0]
    off = np.abs(made - true) / sphere.radiation_damping[:, i, i].max()
    assert np.sqrt(np.mean(off**2)) < level


def test_a_target_of_the_user_stays_his(sphere: HydroDatabase) -> None:
    with pytest.raises(DatabaseError, match=r"misses its target .* keep this one by --accept"):
        hdb.fit(noisy(sphere, 0.01), "sphere.heave", target=1e-3)
