"""Forces of the other time convention, all of them or some, against long waves in closed form."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused

from hydrodae import hdb
from hydrodae.hdb.readers.reading import read_source

OMEGA = np.linspace(0.2, 1.2, 11)
RHO, GRAVITY = 1000.0, 9.81
DOFS = ["Surge", "Heave"]


def forces(bodies=1):
    """Froude-Krylov and diffraction (nw, n) of a small body in e^(+iwt), about its place."""
    k = OMEGA**2 / GRAVITY
    surge, surge_added = 1e5 * 1j * k * GRAVITY, 0.5e5 * 1j * k * GRAVITY
    heave, damping = 3e5 - 1e5 * OMEGA**2, damping_of_heave()
    one = np.stack([surge, heave + 0j], axis=1)
    other = np.stack([surge_added, -0.6e5 * OMEGA**2 + 1j * OMEGA * damping], axis=1)
    return np.tile(one, bodies), np.tile(other, bodies)


def damping_of_heave():
    """Haskind's relation in deep water: B = k |F|^2 / (4 rho g c_g), nearly K33 there."""
    return (OMEGA**2 / GRAVITY) * 3e5**2 / (4.0 * RHO * GRAVITY * 0.5 * GRAVITY / OMEGA)


def write(path, turned=(), bodies=1, left_out=()):
    """Write a file of Capytaine, whose convention is e^(-iwt); `turned` are not of that."""
    fk, diffraction = forces(bodies)
    parts = {
        "excitation_force": fk + diffraction,
        "Froude_Krylov_force": fk,
        "diffraction_force": diffraction,
    }
    names = [f"b{i + 1}__{dof}" if bodies > 1 else dof for i in range(bodies) for dof in DOFS]
    n = len(names)
    a, b = np.zeros((OMEGA.size, n, n)), np.zeros((OMEGA.size, n, n))
    for i in range(n):
        a[:, i, i] = 0.5e5 if i % 2 == 0 else 0.6e5
        b[:, i, i] = damping_of_heave() * (1.0 if i % 2 else OMEGA**4 / 20.0)
    variables: dict[str, Any] = {
        "added_mass": (("omega", "influenced_dof", "radiating_dof"), a),
        "radiation_damping": (("omega", "influenced_dof", "radiating_dof"), b),
    }
    for name, value in parts.items():
        if name in left_out:
            continue
        kept = value if name in turned else np.conj(value)
        both = np.stack([kept.real, kept.imag])[:, :, None]
        variables[name] = (("complex", "omega", "wave_direction", "influenced_dof"), both)
    xr.Dataset(
        variables,
        coords={
            "omega": OMEGA,
            "complex": ["re", "im"],
            "wave_direction": [0.0],
            "influenced_dof": names,
            "radiating_dof": names,
            "rho": RHO,
            "g": GRAVITY,
            "water_depth": np.inf,
        },
    ).to_netcdf(path)
    return path


NAMES = ("excitation_force", "Froude_Krylov_force", "diffraction_force")


def told(source, **options):
    data: Any = read_source(source, **options)
    fk, diffraction = (np.asarray(f) for f in forces(len(data.coordinates) // 2))
    np.testing.assert_allclose(data.excitation[:, 0], fk + diffraction, atol=1e-3)
    np.testing.assert_allclose(data.froude_krylov[:, 0], fk, atol=1e-3)
    np.testing.assert_allclose(data.diffraction[:, 0], diffraction, atol=1e-3)
    return [f for f in data.findings if f.check == "time convention"]


@pytest.mark.parametrize(
    "turned", [c for n in range(4) for c in itertools.combinations(NAMES, n)], ids=str
)
def test_each_force_may_be_of_the_other_convention(tmp_path, turned):
    found = told(write(tmp_path / "buoy.nc", turned))
    assert [f.severity for f in found] == (["warning"] if turned else [])


def test_some_of_several_bodies_are_told_by_their_sum(tmp_path):
    found = told(write(tmp_path / "two.nc", ("Froude_Krylov_force", "diffraction_force"), 2))
    assert "--time-convention froude-krylov=other,diffraction=other" in found[0].message


def test_of_all_of_several_bodies_the_error_names_the_option(tmp_path):
    """Waves that bodies scatter hide what heave says: headings or phases, nothing decides."""
    path = write(tmp_path / "two.nc", NAMES, 2)
    points = {"b1": [0, 0, 0], "b2": [0, 0, 0]}
    report = hdb.import_database(path, source_points=points)[1]
    (finding,) = [f for f in report.findings if f.check == "phase convention"][:1]
    assert finding.severity == "error"
    assert "--time-convention other" in finding.message
    assert told(path, time_convention="other") == []
    report = hdb.import_database(path, source_points=points, time_convention="other")[1]
    assert all(f.severity == "info" for f in report.findings if f.check == "phase convention")


@pytest.mark.parametrize(
    ("stated", "reason", "subject"),
    [
        ("minus", "option", "time_convention"),
        ("drift=other", "option", "time_convention"),
        ("diffraction=minus", "option", "time_convention"),
        ("diffraction=other", "missing", "diffraction"),
    ],
)
def test_statements_that_cannot_be(tmp_path, stated, reason, subject):
    path = write(tmp_path / "buoy.nc", left_out=("diffraction_force",))
    with refused(reason, subject):
        hdb.read(path, time_convention=stated)


def test_a_finished_database_has_one_convention(tmp_path):
    path = tmp_path / "hydro.h5"
    points = {"buoy": [0, 0, 0]}
    database, _ = hdb.import_database(write(tmp_path / "buoy.nc"), source_points=points)
    database.write(path)
    with refused("option", file="hydro.h5"):
        hdb.import_database(path, time_convention="other")
