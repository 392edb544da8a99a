"""What A and B alone tell: rows of other bodies, motions, units, or none at all."""

from __future__ import annotations

import dataclasses
import shutil

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.checks.places import place_findings
from hydrodae.hdb.checks.rows import row_findings
from hydrodae.hdb.checks.units import size_findings


@pytest.fixture(scope="module")
def pair() -> hdb.HydroDatabase:
    """Two cylinders 30 m apart, without their forces."""
    water = hdb.Water(np.linspace(0.1, 1.6, 16), depth=60.0)
    cylinder = hdb.Cylinder(5.0, 6.0, -3.0)
    places = {"a": (0.0, 0.0), "b": (24.0, 18.0)}
    made = hdb.cylinders(places, cylinder, water, orders=2, modes=20)[0]
    empty = made.diffraction[:, :0]
    return dataclasses.replace(
        made, heading=np.zeros(0), diffraction=empty, froude_krylov=empty.copy()
    )


def taken(database, order):
    """The tables with rows and columns in another order, under the labels that stand there."""
    order = np.array(order)
    return dataclasses.replace(
        database,
        added_mass=database.added_mass[:, order][:, :, order],
        added_mass_inf=database.added_mass_inf[np.ix_(order, order)],
        radiation_damping=database.radiation_damping[:, order][:, :, order],
    )


def errors(database):
    return {f.check: f.message for f in hdb.check(database).of("error")}


def test_what_is_right_is_told_to_be_unchecked_only(pair):
    found = row_findings(pair)
    passed = [*place_findings(pair), *size_findings(pair)]
    assert {f.severity for f in passed} == {"info"}
    assert [(f.severity, f.check) for f in found] == [("warning", "not checked")]
    assert "a factor of A and B together" in found[0].message
    assert "bodies in the order a, b" in found[0].message


def test_equal_bodies_in_each_others_places_are_told(pair):
    n = len(pair.coordinates) // 2
    found = errors(taken(pair, [*range(n, 2 * n), *range(n)]))
    assert "right if the rows of a and b were exchanged" in found["places of bodies"]


def test_rows_of_other_motions_of_a_body_are_told(pair):
    at = {label: i for i, label in enumerate(pair.coordinates)}
    for one, other in (("roll", "pitch"), ("surge", "sway")):
        order = list(range(len(at)))
        i, j = at[f"a.{one}"], at[f"a.{other}"]
        order[i], order[j] = j, i
        told = errors(taken(pair, order))["motions of a body"]
        assert "couples surge with roll" in told
        assert (
            f"right if the rows of a.{one} and a.{other} were exchanged" in told or "or if" in told
        )


def test_moments_about_another_point_are_told(pair):
    body = pair.bodies["a"]
    for height, told in ((250.0, "far above the water"), (-70.0, "below the ground")):
        point = np.array([0.0, 0.0, height])
        moved = {**pair.bodies, "a": dataclasses.replace(body, reference_point=point)}
        found = errors(dataclasses.replace(pair, bodies=moved))["motions of a body"]
        assert told in found


def test_frequencies_in_another_unit_are_told_by_hulls_or_not_checked(pair):
    """A(w) and B/w keep their values: causality holds, waves of another length do not."""

    def times(factor):
        return dataclasses.replace(
            pair, omega=factor * pair.omega, radiation_damping=factor * pair.radiation_damping
        )

    assert "damping from hull" in errors(times(0.5 / np.pi))
    # no wave is long against the hulls then
    (told,) = row_findings(times(2.0 * np.pi))
    assert "a factor of all frequencies" in told.message


def test_rows_that_no_water_makes_are_told(pair):
    i = pair.index("b.heave")[0]
    keep = np.arange(len(pair.coordinates)) != i
    hollow = keep[:, None] & keep
    without = dataclasses.replace(
        pair,
        added_mass=pair.added_mass * hollow,
        added_mass_inf=pair.added_mass_inf * hollow,
        radiation_damping=pair.radiation_damping * hollow,
    )
    assert errors(without)["added mass of zero"].startswith("A of b.heave is zero")
    mute = dataclasses.replace(pair, radiation_damping=pair.radiation_damping * hollow)
    assert errors(mute)["damping of zero"].startswith("B of b.heave is zero")
    keep = np.arange(len(pair.coordinates)) != pair.index("a.roll")[0]
    hollow = keep[:, None] & keep
    (lost, _) = row_findings(dataclasses.replace(pair, added_mass=pair.added_mass * hollow))
    assert lost.severity == "error"
    assert lost.message.startswith("A of a.roll is zero at all frequencies and that of a.pitch")
    # a body longer than wide may be one of revolution about its length
    long = np.where(np.array(pair.coordinates) == "a.surge", 0.5, 1.0)
    (told, _) = row_findings(
        dataclasses.replace(pair, added_mass=pair.added_mass * hollow * np.outer(long, long))
    )
    assert told.severity == "warning"
    negative = dataclasses.replace(
        pair, added_mass=-pair.added_mass, added_mass_inf=-pair.added_mass_inf
    )
    assert "sign of A" in errors(negative)
    still = dataclasses.replace(pair, radiation_damping=0.0 * pair.radiation_damping)
    assert "a column is missing" in errors(still)["damping of zero"]


def copied(reference, tmp_path, name, change):
    """A run of WAMIT without `.3` whose lines of five words are changed."""
    folder = shutil.copytree(
        reference / "hdb" / name, tmp_path / name, ignore=shutil.ignore_patterns("*.3", "*.png")
    )
    path = next(folder.rglob("*.1"))
    lines = [line.split() for line in path.read_text().splitlines()]
    kept = [change(words) if len(words) in (4, 5) else words for words in lines]
    path.write_text("\n".join(" ".join(words) for words in kept if words))
    return {f.check: f.message for f in hdb.import_database(folder)[1].of("error")}


def test_bodies_of_one_axis_exchanged_are_told(reference, tmp_path):
    def other(words):
        turned = [str((int(word) + 5) % 12 + 1) for word in words[1:3]]
        return [words[0], *turned, *words[3:]]

    found = copied(reference, tmp_path, "rm3_wamit", other)
    assert "right if the rows of float and spar were exchanged" in found["damping from hull"]


def test_rows_and_frequencies_that_were_asked_for_are_missed(reference, tmp_path):
    def third(words):
        return [] if "3" in words[1:3] else words

    found = copied(reference, tmp_path / "a", "cylinder_hams", third)
    assert "ControlFile.in asks for Buoy.heave" in found["motions asked for"]

    def cycles(words):
        time = float(words[0])
        return [f"{time / (2.0 * np.pi):.8E}" if time > 0.0 else words[0], *words[1:]]

    found = copied(reference, tmp_path / "b", "cylinder_hams", cycles)
    assert "asks for 0.9905..5.425 rad/s" in found["frequencies asked for"]
