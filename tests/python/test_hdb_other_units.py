"""Tables in other units than stated, and headings of another kind, do not pass the checks."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.checks.heave import heave_findings
from hydrodae.hdb.checks.longwave import long_wave_findings
from hydrodae.hdb.checks.units import unit_findings


@pytest.fixture(scope="module")
def pair() -> hdb.HydroDatabase:
    """Two cylinders: the energy identity needs more headings than two."""
    water = hdb.Water(np.linspace(0.4, 9.0, 44), depth=4.0, heading=np.array([0.0, 0.5 * np.pi]))
    places = {"a": (0.0, 0.0), "b": (1.5, 0.4)}
    return hdb.cylinders(places, hdb.Cylinder(0.4, 0.5, -0.3), water, orders=2, modes=8)[0]


def errors(database: hdb.HydroDatabase) -> dict[str, str]:
    found = [
        *heave_findings(database),
        *unit_findings(database),
        *long_wave_findings(database),
    ]
    return {f.check: f.message for f in found if f.severity == "error"}


def scaled(db: hdb.HydroDatabase, tables: float, forces: float) -> hdb.HydroDatabase:
    return dataclasses.replace(
        db,
        added_mass=tables * db.added_mass,
        added_mass_inf=tables * db.added_mass_inf,
        radiation_damping=tables * db.radiation_damping,
        froude_krylov=forces * db.froude_krylov,
        diffraction=forces * db.diffraction,
        bodies={n: dataclasses.replace(b, hydrostatics=None) for n, b in db.bodies.items()},
    )


@pytest.mark.parametrize(("tables", "forces"), [(1e-3, 1.0), (1.0, 1e-3), (1000.0, 1.0)])
def test_tonnes_and_kilonewtons(pair, tables, forces):
    assert errors(scaled(pair, 1.0, 1.0)) == {}
    found = errors(scaled(pair, tables, forces))["damping from heave force"]
    assert "in long waves implies" in found


def test_other_frequencies(pair):
    hertz = dataclasses.replace(pair, omega=pair.omega / (2.0 * np.pi))
    assert "Hz taken for rad/s?" in errors(hertz)["units of frequency"]
    periods = dataclasses.replace(
        pair,
        omega=2.0 * np.pi / pair.omega[::-1],
        **{
            name: getattr(pair, name)[::-1]
            for name in ("added_mass", "radiation_damping", "froude_krylov", "diffraction")
        },
    )
    assert "are periods" in errors(periods)["units of frequency"]


def test_headings_in_another_unit(pair):
    radians = dataclasses.replace(pair, heading=np.radians(pair.heading))
    found = errors(radians)["heading"]
    assert "heading 1.571 deg push towards 90 deg" in found
    turned = dataclasses.replace(pair, heading=pair.heading[::-1])
    assert "heading" in errors(turned)
    # the command's checks hold these
    told = {f.check for f in hdb.check(scaled(turned, 1e-3, 1.0)).of("error")}
    assert told >= {"heading", "damping from heave force"}
