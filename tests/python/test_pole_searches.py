"""Searches of poles: the error that a relocation tells, and a look that serves the fit after it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.memory import fit_memory, poles
from hydrodae.hdb.memory.modes import Searches
from hydrodae.hdb.memory.reach import MOST_POLES, reach
from hydrodae.hdb.memory.vector_fitting import (
    Limits,
    Samples,
    basis,
    relocate,
    relocated,
    starting_poles,
)


def _least_error(found: np.ndarray, data: Samples) -> float:
    """Return the weighted error of the best residues by plain least squares, entry by entry."""
    s = np.asarray(1j * data.omega, dtype=complex)
    left = np.column_stack([basis(s, found), s])
    total = 0.0
    for value, weight in zip(data.value.T, data.weight.T, strict=True):
        system, target = weight[:, None] * left, weight * value
        system = np.concatenate([system.real, system.imag])
        target = np.concatenate([target.real, target.imag])
        solution = np.linalg.lstsq(system, target, rcond=None)[0]
        total += float(((system @ solution - target) ** 2).sum())
    return float(np.sqrt(total))


def test_a_relocation_tells_the_error_of_the_poles_it_started_from() -> None:
    rng = np.random.default_rng(3)
    omega = np.linspace(0.1, 4.0, 60)
    value = rng.normal(size=(60, 3)) + 1j * rng.normal(size=(60, 3))
    data = Samples(omega, value, rng.uniform(0.5, 2.0, (60, 3)))
    start = starting_poles(8, 2, 0.1, 4.0, 0.05, logarithmic=False)
    limits = Limits(omega, 0.01 * omega)
    moved, error = relocate(start, data, limits)
    assert error == pytest.approx(_least_error(start, data), rel=1e-9)
    assert relocate(moved, data, limits)[1] == pytest.approx(_least_error(moved, data), rel=1e-9)
    least, best = relocated(start, data, limits, 5, 3)
    assert least == pytest.approx(_least_error(best, data), rel=1e-9)


def test_a_fit_takes_the_searches_of_the_look_and_nothing_else(
    repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    made: list[int] = []

    def counted(start: np.ndarray, *rest: object) -> object:
        made.append(start.size)
        return relocated(start, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(poles, "relocated", counted)
    band, moving = (0.3, 3.0), ["sphere.heave"]

    def fitted(searches: Searches | None) -> tuple[int, np.ndarray]:
        made.clear()
        fit = fit_memory(table, moving, band=band, searches=searches)
        return len(made), fit.transfer(table.omega)

    alone, first = fitted(None)
    again, second = fitted(None)
    assert alone == again > 0
    searches: Searches = {}
    reach(table, moving, band=band, searches=searches)
    assert searches
    assert max(count for count, *_ in searches) <= MOST_POLES
    served, third = fitted(searches)
    assert served < alone
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first, third)
