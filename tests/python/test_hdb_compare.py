"""`hydrodae hdb compare`: differences where they are, and what coarser tables cost."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from tests.errors import refused
from tests.python.hdb_command import call

from hydrodae.hdb.checks.compare import compare, grid_sensitivity, other_water


def test_a_database_equals_itself(sphere):
    assert max(d.value for d in compare(sphere, sphere)) < 1e-12


def test_a_change_is_found_where_it_is(sphere):
    b = sphere.radiation_damping.copy()
    b[20, 2, 2] += 0.1 * b[:, 2, 2].max()
    found = {d.table: d for d in compare(dataclasses.replace(sphere, radiation_damping=b), sphere)}
    assert found["radiation_damping"].value == pytest.approx(0.1)
    assert found["radiation_damping"].entry == "sphere.heave"
    assert found["radiation_damping"].at == " [w = 1.05 rad/s]"
    assert found["K(t)"].entry == "sphere.heave"
    assert found["added_mass"].value < 1e-12
    turned = dataclasses.replace(sphere, diffraction=sphere.diffraction * np.exp(0.1j))
    found = {d.table: d for d in compare(turned, sphere)}
    assert 0.02 < found["excitation"].value < 0.11


def test_what_cannot_be_compared(sphere):
    with refused("label"):
        compare(sphere, sphere.renamed({"sphere": "buoy"}))
    with refused("point", "sphere"):
        compare(sphere, sphere.moved_to({"sphere": (0, 0, -1)}))


def test_twins_in_other_water_are_told_apart(sphere):
    assert other_water(sphere, sphere) == []
    other = dataclasses.replace(sphere, water_depth=50.0)
    assert other_water(sphere, other) == ["water depth: inf m and 50 m"]


def test_sensitivity_of_the_sphere(sphere):
    rows = {text: (k, a) for text, k, a in grid_sensitivity(sphere)}
    assert rows["every second frequency"][0] < 0.01
    assert rows["every fourth frequency"][0] > rows["every second frequency"][0]
    assert rows["up to 0.5 w_max"][0] > rows["up to 0.75 w_max"][0]
    assert rows["up to 0.75 w_max"][1] < 0.02
    memory = [k for text, (k, _) in rows.items() if text.startswith("memory")]
    assert memory == sorted(memory, reverse=True)


def test_command(repository, sphere_file, capsys):
    device = repository / "cases" / "f3of" / "hydro.h5"
    assert call("compare", device, device) == 0
    assert "radiation_damping       0.00%" in capsys.readouterr().out
    assert call("compare", sphere_file) == 0
    assert "every second frequency" in capsys.readouterr().out
