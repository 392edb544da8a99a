"""One change of convention, unit, label or place is named where it makes a table obey all laws."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.checks.changes import changes, scaled
from hydrodae.hdb.checks.search import law_findings
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding


@pytest.fixture(scope="module")
def buoy() -> HydroDatabase:
    """A cylinder beside the origin and waves along both axes, moments about the water's surface."""
    water = hdb.Water(np.linspace(0.4, 11.0, 32), depth=4.0, heading=np.array([0.0, 0.5 * np.pi]))
    return hdb.cylinders({"b": (1.5, 0.4)}, hdb.Cylinder(0.4, 0.5, -0.3), water, orders=2, modes=8)[
        0
    ]


def conjugate(db: HydroDatabase) -> HydroDatabase:
    return replace(db, froude_krylov=db.froude_krylov.conj(), diffraction=db.diffraction.conj())


#: What is done to the tables, and the words of the change that undoes it.
FAULTS: dict[str, tuple[Callable[[HydroDatabase], HydroDatabase], str]] = {
    "phases": (conjugate, "of the other time convention (--time-convention other)"),
    "waves": (lambda db: replace(db, heading=db.heading + np.pi), "from where the waves come"),
    "radians": (lambda db: replace(db, heading=np.radians(db.heading)), "radians where degrees"),
    "Hz": (lambda db: scaled(db, w=0.5 / np.pi), "Hz taken for rad/s"),
    "tonnes": (lambda db: scaled(db, A=1e-3, B=1e-3), "A and B were 1000 times as large"),
    "gravity": (lambda db: scaled(db, F=1.0 / db.gravity), "F was g times as large"),
    "a factor": (lambda db: scaled(db, A=1.0 / 40.0, B=1.0 / 40.0), "(fitted) times as large"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_the_change_that_undoes_a_fault_is_named(buoy: HydroDatabase, fault: str) -> None:
    made, words = FAULTS[fault]
    errors = hdb.check(made(buoy)).of("error")
    assert errors
    assert all("; right if" in f.message and words in f.message for f in errors), errors


def test_every_change_leaves_the_shapes(buoy: HydroDatabase) -> None:
    found = dict(changes(buoy))
    assert len(found) > 50
    for made in found.values():
        assert made.excitation.shape == buoy.excitation.shape
        assert np.all(np.diff(made.omega) > 0.0)
        assert made.coordinates == buoy.coordinates


def test_a_law_that_does_not_judge_the_changed_table_is_not_obeyed(buoy: HydroDatabase) -> None:
    def silent(db: HydroDatabase) -> list[Finding]:
        return [Finding("error", "law", "broken")] if db is buoy else []

    def worse(db: HydroDatabase) -> list[Finding]:
        severity = "info" if db is buoy else "error"
        return [Finding(severity, "other", "judged")]

    def mended(db: HydroDatabase) -> list[Finding]:
        severity = "error" if db is buoy else "info"
        return [Finding(severity, "law", "judged")]

    for laws in ([silent], [mended, worse]):
        found = law_findings(buoy, laws)
        assert found[0].message.endswith("; nothing tried here mends it")
    assert "; right if" in law_findings(buoy, [mended])[0].message
