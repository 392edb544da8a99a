"""Figures of the page on power take-offs, by the equations of its parts."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import hydrodae


def test_the_membrane_passes_what_is_above_the_osmotic_pressure(repository: Path) -> None:
    results = hydrodae.run(repository / "cases" / "pto" / "ro.toml")
    high, low, flow, power = (
        results[f"forces/fluid/{name}"].to_numpy()
        for name in ("pressure_high", "pressure_low", "motor_flow", "motor_power")
    )
    assert np.ptp(high) > 1e6
    assert np.ptp(low) < 100.0
    membrane = 1e-9 * np.maximum(high - low - 2.7e6, 0.0)  # m3/s
    np.testing.assert_allclose(flow, membrane, atol=5e-3 * membrane.max())
    np.testing.assert_allclose(power, flow * (high - low), rtol=1e-9)


def test_the_tables_of_the_page_are_those_of_the_studies(repository: Path, tmp_path: Path) -> None:
    page = (repository / "docs" / "pto.md").read_text()
    folder = repository / "cases" / "pto"
    found = hydrodae.sweep(folder / "ro_powers.toml", tmp_path / "ro.nc", jobs=1)
    told = re.findall(r"^\| (0\.\d+) \| (\S+) \| (\S+) \| (\S+) \|$", page, re.M)
    columns = np.array(told, dtype=float).T
    results = (("power_absorbed", 1e3), ("permeate", 1e-3), ("energy_per_volume", 1e6))
    for column, (name, unit) in zip(columns[1:], results, strict=True):
        np.testing.assert_allclose(found[name].values / unit, column, rtol=5e-3)
    powers = hydrodae.sweep(folder / "powers.toml", tmp_path / "powers.nc", jobs=1)
    shown = [float(x) for x in re.findall(r"efficiency.*# (.*)", page)[0].split(",")]
    assert powers["efficiency"].values == pytest.approx(shown, abs=6e-3)
    stages = [powers[f"power_{s}"].values for s in ("absorbed", "hydraulic", "shaft", "electric")]
    assert (np.diff(stages, axis=0) < 0.0).all()
