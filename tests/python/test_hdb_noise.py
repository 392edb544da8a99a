"""Rounding and noise of a table are no errors: checks judge above the noise of the table itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from hydrodae import hdb
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.relations.noise import last_digit, scatter
from hydrodae.support.arrays import Array

SEVERITY = {"info": 0, "warning": 1, "error": 2}


def longer(db: HydroDatabase) -> HydroDatabase:
    """Waves of 8 minutes to an hour put before the table, by their limits: A, B ~ w^3 .. w^7, F."""
    new = np.arange(1, 9) * 0.002
    old = db.omega[0]
    share, n = new / old, len(db.coordinates)
    translation = np.array([c.endswith(("surge", "sway", "heave")) for c in db.coordinates])
    heave = np.array([c.endswith("heave") for c in db.coordinates])
    power = np.where(heave[:, None] & heave, 3, 7)
    assert translation.any()

    def before(table: NDArray[Any], head: NDArray[Any]) -> NDArray[Any]:
        return np.concatenate([head, table])

    ones = np.ones((new.size, 1, 1))
    damping = db.radiation_damping[0] * share[:, None, None] ** power
    factor = np.where(heave, 1.0, share[:, None] ** 2)[:, None, :]
    return replace(
        db,
        omega=before(db.omega, new),
        added_mass=before(db.added_mass, db.added_mass[0] * ones),
        radiation_damping=before(db.radiation_damping, damping * np.ones((n, n))),
        froude_krylov=before(db.froude_krylov, db.froude_krylov[0] * factor),
        diffraction=before(db.diffraction, db.diffraction[0] * factor),
    )


def by_kind(db: HydroDatabase, size: Array) -> Array:
    """The largest of the coordinates of each kind, translations and rotations, (n,)."""
    turns = np.array([c.endswith(("roll", "pitch", "yaw")) for c in db.coordinates])
    return np.array([size[turns == kind].max(initial=0.0) for kind in turns])


def noisy(db: HydroDatabase, level: float) -> HydroDatabase:
    """Noise of a share of the largest value of its kind on every entry of A, B and F."""
    random = np.random.default_rng(1)

    def square(table: Array) -> Array:
        size = by_kind(db, np.sqrt(np.abs(np.einsum("wii->wi", table)).max(axis=0)))
        return table + level * np.outer(size, size) * random.uniform(-1.0, 1.0, table.shape)

    def force(table: NDArray[np.complex128]) -> NDArray[np.complex128]:
        size = by_kind(db, np.abs(db.excitation).max(axis=(0, 1)))
        noise = random.uniform(-1.0, 1.0, (2, *table.shape))
        return np.asarray(table + level * size * (noise[0] + 1j * noise[1]))

    return replace(
        db,
        added_mass=square(db.added_mass),
        radiation_damping=square(db.radiation_damping),
        froude_krylov=force(db.froude_krylov),
        diffraction=force(db.diffraction),
    )


def rounded(db: HydroDatabase, digits: int) -> HydroDatabase:
    """Every number to so many digits."""

    def cut(table: Array) -> Array:
        step = 10.0 ** (np.floor(np.log10(np.maximum(np.abs(table), 1e-300))) - digits + 1)
        return np.round(table / step) * step

    def both(table: NDArray[np.complex128]) -> NDArray[np.complex128]:
        return cut(table.real) + 1j * cut(table.imag)

    return replace(
        db,
        added_mass=cut(db.added_mass),
        radiation_damping=cut(db.radiation_damping),
        froude_krylov=both(db.froude_krylov),
        diffraction=both(db.diffraction),
    )


def negative(db: HydroDatabase) -> HydroDatabase:
    """B of -1e-11 of the peak wherever it is below a millionth of it, and so off the diagonal."""
    b = db.radiation_damping.copy()
    peak = np.sqrt(np.abs(np.einsum("wii->wi", b)).max(axis=0))
    peak = np.outer(peak, peak)
    return replace(db, radiation_damping=np.where(np.abs(b) < 1e-6 * peak, -1e-11 * peak, b))


CHANGES: dict[str, Callable[[HydroDatabase], HydroDatabase]] = {
    "noise of 1e-9": lambda db: noisy(db, 1e-9),
    "noise of 1e-6": lambda db: noisy(db, 1e-6),
    "noise of 1e-5": lambda db: noisy(db, 1e-5),
    "5 digits": lambda db: rounded(db, 5),
    "negative at low frequencies": negative,
}


def worst(db: HydroDatabase) -> dict[str, int]:
    found: dict[str, int] = {}
    for finding in hdb.check(db):
        found[finding.check] = max(found.get(finding.check, 0), SEVERITY[finding.severity])
    return found


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("table", ["as it is", "with waves of an hour"])
def test_rounding_makes_nothing_worse(sphere: HydroDatabase, table: str, change: str) -> None:
    clean = sphere if table == "as it is" else longer(sphere)
    before, after = worst(clean), worst(CHANGES[change](clean))
    worse = {check for check, level in after.items() if level > before.get(check, 0)}
    assert not worse, str(hdb.check(CHANGES[change](clean)))


def test_errors_above_the_noise_are_still_found(sphere: HydroDatabase) -> None:
    """Phases of the other convention, another displacement, in tables with waves of an hour."""
    db = noisy(longer(sphere), 1e-6)
    other = replace(
        db, froude_krylov=np.conj(db.froude_krylov), diffraction=np.conj(db.diffraction)
    )
    assert worst(other)["phase convention"] == SEVERITY["error"]
    statics = db.bodies["sphere"].hydrostatics
    assert statics is not None
    half = replace(statics, displaced_volume=0.5 * statics.displaced_volume)
    assert worst(db.with_hydrostatics({"sphere": half}))["displacement"] == SEVERITY["error"]


def test_scatter_is_the_noise_and_not_the_curve() -> None:
    w = np.asarray(0.2 * np.arange(1, 31), dtype=np.float64)
    smooth = np.exp(1j * w) / (1.0 + w**2)
    noise = 1e-3 * np.random.default_rng(0).standard_normal((2, 30, 400))
    found = scatter(w, smooth[:, None] + noise[0] + 1j * noise[1])
    # the median of |z| of two normal parts is 1.18 of theirs
    assert np.median(found) == pytest.approx(1.18e-3, rel=0.15)
    assert scatter(w, smooth) < 2e-4


def test_last_digit_of_printed_numbers() -> None:
    values = np.array([12.34, 12.34, 12.35, 12.39, 12.39])
    assert last_digit(values) == pytest.approx(0.01)
    assert last_digit(np.ones((3, 2))).tolist() == [0.0, 0.0]
