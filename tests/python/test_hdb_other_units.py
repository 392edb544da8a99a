"""Tables in other units than stated, and headings of another kind, do not pass the checks."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.checks.hulls import hull_findings
from hydrodae.hdb.checks.longwave import long_wave_findings
from hydrodae.hdb.checks.units import one_heading_findings, size_findings, unit_findings

ROOT = Path(__file__).parents[2]
#: A flat hull, and a hull below the water: without waves nothing shows the unit.
UNTOLD = ((0.1, "displaced_volume"), (1e-3, "waterplane_area"))


@pytest.fixture(scope="module")
def pair() -> hdb.HydroDatabase:
    """Two cylinders: the energy identity needs more headings than two."""
    water = hdb.Water(np.linspace(0.4, 9.0, 44), depth=4.0, heading=np.array([0.0, 0.5 * np.pi]))
    places = {"a": (0.0, 0.0), "b": (1.5, 0.4)}
    return hdb.cylinders(places, hdb.Cylinder(0.4, 0.5, -0.3), water, orders=2, modes=8)[0]


def errors(database: hdb.HydroDatabase) -> dict[str, str]:
    found = [
        *one_heading_findings(database),
        *size_findings(database),
        *hull_findings(database),
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
    found = errors(scaled(pair, tables, forces))["damping from one heading"]
    assert "in long waves implies" in found


@pytest.mark.parametrize("level", [0.01, 0.03, 0.1])
def test_noise_is_no_unit(pair, level):
    """A and B with noise of their largest over the frequencies, symmetric."""
    random = np.random.default_rng(7)
    noisy = {}
    for name in ("added_mass", "radiation_damping"):
        table = getattr(pair, name)
        noise = random.standard_normal(table.shape) * np.abs(table).max(axis=0)
        noisy[name] = table + 0.5 * level * (noise + noise.swapaxes(1, 2))
    assert not unit_errors(dataclasses.replace(pair, **noisy))


@pytest.mark.parametrize("first", [6, 12])
@pytest.mark.parametrize("motion", ["surge", "heave", "pitch"])
def test_tables_that_begin_late_are_in_no_other_unit(pair, first, motion):
    """Of one motion, to where B has nearly reached its peak."""
    one = pair.select([c for c in pair.coordinates if c.endswith(motion)])
    assert not unit_errors(one.at_frequencies(np.arange(one.omega.size) >= first))


def unit_errors(db: hdb.HydroDatabase) -> list[str]:
    return [f.message for f in unit_findings(db) if f.severity == "error"]


def hull(db: hdb.HydroDatabase, **factors: float) -> hdb.HydroDatabase:
    """Hydrostatics with some of their fields multiplied."""
    bodies = {}
    for name, body in db.bodies.items():
        assert body.hydrostatics is not None
        changed = {key: f * getattr(body.hydrostatics, key) for key, f in factors.items()}
        statics = dataclasses.replace(body.hydrostatics, **changed)
        bodies[name] = dataclasses.replace(body, hydrostatics=statics)
    return dataclasses.replace(db, bodies=bodies)


def without_waves(db: hdb.HydroDatabase, rows: slice = slice(None)) -> hdb.HydroDatabase:
    """The same without excitation, at some of the frequencies."""
    none = np.zeros((db.omega[rows].size, 0, len(db.coordinates)), complex)
    names = ("omega", "added_mass", "radiation_damping")
    kept = {name: getattr(db, name)[rows] for name in names}
    return dataclasses.replace(
        db, heading=np.zeros(0), froude_krylov=none, diffraction=none, **kept
    )


def test_added_mass_against_the_force(pair):
    for rows in (slice(0, 12), slice(None)):  # the first end before the damping falls
        part = without_waves(pair, rows)
        assert errors(part) == {}
    few = dataclasses.replace(
        without_waves(pair, slice(0, 12)),
        heading=pair.heading,
        froude_krylov=pair.froude_krylov[:12],
        diffraction=pair.diffraction[:12],
    )
    for split in (True, False):
        both = (
            few
            if split
            else dataclasses.replace(
                few,
                froude_krylov=np.zeros_like(few.diffraction),
                diffraction=few.excitation,
                excitation_split=False,
            )
        )
        assert errors(both) == {}
        for factor in (1000.0, 10.0, 1e-3):
            wrong = dataclasses.replace(both, added_mass=factor * both.added_mass)
            assert "added mass from force" in errors(wrong)


def test_sizes_against_the_hull(pair):
    dry = without_waves(pair)
    for factor in (1000.0, 9.81, 0.1, 1e-3):
        for fields in (("displaced_volume",), ("waterplane_area",)):
            if (factor, *fields) in UNTOLD:
                continue
            wrong = hull(dry, **dict.fromkeys(fields, factor))
            assert set(errors(wrong)) & {"size of the hull", "damping from hull"}, (factor, fields)
        wrong = dataclasses.replace(
            dry,
            added_mass=factor * dry.added_mass,
            added_mass_inf=factor * dry.added_mass_inf,
            radiation_damping=factor * dry.radiation_damping,
        )
        assert "damping from hull" in errors(wrong)


def test_a_table_that_ends_early_tells_another_unit_of_damping(pair):
    early = without_waves(pair, slice(0, 20))
    bodies = {n: dataclasses.replace(b, hydrostatics=None) for n, b in pair.bodies.items()}
    early = dataclasses.replace(early, bodies=bodies)
    assert errors(early) == {}
    wrong = dataclasses.replace(early, radiation_damping=early.radiation_damping / 9.81)
    assert "times as large" in errors(wrong)["units of frequency"]


def test_a_length_scale_of_millimetres(pair):
    lengths = np.where([c.endswith(("roll", "pitch", "yaw")) for c in pair.coordinates], 1e3, 1.0)
    tables = 1e9 * np.outer(lengths, lengths)
    wrong = dataclasses.replace(
        scaled(pair, 1.0, 1.0),
        added_mass=tables * pair.added_mass,
        added_mass_inf=tables * pair.added_mass_inf,
        radiation_damping=tables * pair.radiation_damping,
        froude_krylov=1e6 * lengths * pair.froude_krylov,
        diffraction=1e6 * lengths * pair.diffraction,
    )
    assert "damping from one heading" in errors(wrong)


def test_waves_between_walls_are_no_unit():
    section = hdb.read(ROOT / "cases" / "tank_section" / "hydro.h5")
    assert errors(section) == {}


def test_other_frequencies(pair):
    periods = dataclasses.replace(
        pair,
        omega=2.0 * np.pi / pair.omega[::-1],
        **{
            name: getattr(pair, name)[::-1]
            for name in ("added_mass", "radiation_damping", "froude_krylov", "diffraction")
        },
    )
    (told,) = hdb.check(periods).find("units of frequency")
    assert told.severity == "error"
    assert "right if the frequencies [rad/s] were periods [s]" in told.message


def test_headings_in_another_unit(pair):
    radians = dataclasses.replace(pair, heading=np.radians(pair.heading))
    found = errors(radians)["heading"]
    assert "heading 1.571 deg push towards 90 deg" in found
    turned = dataclasses.replace(pair, heading=pair.heading[::-1])
    assert "heading" in errors(turned)
    # the command's checks hold these
    told = {f.check for f in hdb.check(scaled(turned, 1e-3, 1.0)).of("error")}
    assert told >= {"heading", "damping from one heading"}
