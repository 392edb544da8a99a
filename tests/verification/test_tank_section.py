"""The section in the flume: forces, natural periods and heave against the tank."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

RESONANCE = "3061_2"


def load(repository: Path, name: str) -> ModuleType:
    path = repository / "cases" / "tank_section" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def compare(repository: Path) -> ModuleType:
    return load(repository, "compare")


def test_forces_on_the_fixed_section(compare: ModuleType) -> None:
    """Along the flume within 5 %; upwards within 5.6 %, 18 of 23 tests within 5 %."""
    rows = [row for row in compare.force_table() if row[1] >= 0.8]
    along = np.array([x / measured - 1.0 for _, _, measured, x, _, _ in rows])
    up = np.array([z / measured - 1.0 for _, _, _, _, measured, z in rows])
    assert len(rows) == 23
    assert np.abs(along).max() < 0.05
    assert np.abs(up).max() < 0.06
    assert np.count_nonzero(np.abs(up) < 0.05) >= 18


def test_natural_periods(compare: ModuleType) -> None:
    found = compare.natural_periods()
    for name in ("heave", "pitch"):
        assert found[name] == pytest.approx(compare.NATURAL[name], rel=0.02)


def test_friction_brings_heave_at_resonance_to_the_measured_one(compare: ModuleType) -> None:
    row = compare.measured("3")[RESONANCE]
    without, damped, friction = (
        compare.in_the_record(RESONANCE, row, stiction)["up"] / row["up"]
        for stiction in (None, compare.NONE, compare.FRICTION)
    )
    assert friction == pytest.approx(1.0, abs=0.06)
    assert 1.10 < damped < without
    assert without > 1.15


def test_away_from_resonance_friction_hardly_matters(compare: ModuleType) -> None:
    row = compare.measured("3")["3101_3"]
    for stiction in (None, compare.FRICTION):
        found = compare.in_the_record("3101_3", row, stiction)
        assert found["up"] == pytest.approx(row["up"], rel=0.06)


def test_the_spectral_rung_agrees_with_a_settled_run(compare: ModuleType) -> None:
    """Lorentz friction and damping against the law itself in the time domain, 40 s of waves."""
    row = compare.measured("3")[RESONANCE]
    spectral = compare.settled(row, compare.FRICTION)["up"]
    results = compare.hydrodae.run(
        compare.FOLDER / "section.toml",
        set={"wave.wave.period": row["period"], "wave.wave.height": 2.0 * row["incident"]},
    )
    values = results["joints/slide/displacement"].values
    omega = 2.0 * np.pi / row["period"]
    settled = compare.harmonic(results.time, values, omega, 30.0, 8) / row["incident"]
    assert spectral == pytest.approx(settled, rel=0.02)


def test_database_is_the_table_of_the_reference(repository: Path, reference: Path) -> None:
    made = load(repository, "make_database")
    table = np.genfromtxt(reference / "tank_section" / "hdb_2d.csv", delimiter=",", names=True)
    stored = made.hdb.HydroDatabase.read(repository / "cases" / "tank_section" / "hydro.h5")
    np.testing.assert_allclose(stored.added_mass[:, 1, 1], table["A22"], rtol=1e-12)
    np.testing.assert_allclose(stored.radiation_damping[:, 0, 0], table["B11"], rtol=1e-12)
    force = table["reF2"] - 1j * table["imF2"]
    np.testing.assert_allclose(stored.excitation[:, 0, 1], force, rtol=1e-12)
