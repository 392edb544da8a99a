"""Headings that follow from the symmetry of the bodies, as far as the tables show it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.errors import refused, wrong

import hydrodae
from hydrodae import _core, hdb
from hydrodae.linear import LinearModel

TWINS = {"port": (0.0, 1.5), "starboard": (0.0, -1.5)}
ALONE = {"buoy": (0.0, 0.0)}


def cylinders(
    degrees: list[float] | NDArray[np.float64], places: dict[str, tuple[float, float]]
) -> hdb.HydroDatabase:
    water = hdb.Water(np.linspace(1.0, 3.0, 4), depth=4.0, heading=np.radians(degrees))
    return hdb.cylinders(places, hdb.Cylinder(0.4, 0.5, -0.3), water, orders=2, modes=8)[0]


def images(
    db: hdb.HydroDatabase, damping: float = 1.0
) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    """Headings [deg] and excitation (nw, nh, n) with the images."""
    heading, tables = _core.with_images(
        list(db.coordinates),
        {name: db.reference_point(name) for name in db.bodies},
        db.added_mass_inf,
        db.omega,
        list(damping * db.radiation_damping),
        db.heading,
        list(np.moveaxis(db.excitation, 1, 0)),
        [db.rho, db.gravity, db.water_depth],
    )
    return np.degrees(heading), np.stack(tables, axis=1)


@pytest.mark.parametrize("degrees", [[0.0], [30.0], [0.0, 20.0, 50.0]])
def test_one_heading_of_a_body_of_revolution_gives_all(degrees: list[float]) -> None:
    heading, force = images(cylinders(degrees, ALONE))
    np.testing.assert_allclose(heading, degrees[0] + np.arange(0.0, 361.0, 45.0), atol=1e-9)
    exact = cylinders(heading, ALONE).excitation
    np.testing.assert_allclose(force, exact, atol=1e-6 * abs(exact).max())


def test_one_heading_of_a_panelled_sphere_gives_all(sphere_tables: Any) -> None:
    """Irregular frequencies of a mesh (up to 8 % of the largest B) hide no revolution.

    About its centre a sphere has no moments but those of the mesh.
    """
    for point in ((0.0, 0.0, -2.0), (0.0, 0.0, 0.0)):
        db = sphere_tables.moved_to({"sphere": point})
        heading, force = images(db)
        np.testing.assert_allclose(heading, np.arange(0.0, 361.0, 45.0), atol=1e-9)
        at = {c.rpartition(".")[2]: i for i, c in enumerate(db.coordinates)}
        largest = np.abs(db.excitation).max()
        for dof, wanted in (("surge", 0.0), ("sway", 1.0), ("heave", 1.0)):
            source = db.excitation[:, 0, at["surge" if dof == "sway" else dof]]
            np.testing.assert_allclose(force[:, 2, at[dof]], wanted * source, atol=1e-9 * largest)


def test_one_heading_alone_shows_no_revolution_where_the_damping_is_another() -> None:
    """As of a square, which has the added mass of a circle."""
    one = cylinders([0.0], ALONE)
    heading, force = images(one, damping=1.1)
    np.testing.assert_allclose(heading, [0.0])
    np.testing.assert_allclose(force, one.excitation)


@pytest.mark.parametrize(
    "degrees", [np.arange(0, 91, 30), np.arange(-90, 91, 45), np.arange(0, 121, 30)]
)
def test_planes_of_symmetry_close_the_circle(degrees: NDArray[np.float64]) -> None:
    """Two buoys abreast are each other's image about y = 0, and each its own about x = 0."""
    heading, force = images(cylinders(degrees, TWINS))
    step = degrees[1] - degrees[0]
    np.testing.assert_allclose(heading, np.arange(heading[0], heading[0] + 361, step), atol=1e-9)
    exact = cylinders(heading, TWINS).excitation
    np.testing.assert_allclose(force, exact, atol=1e-6 * abs(exact).max())


def test_one_plane_doubles_the_fan() -> None:
    """Buoys one behind the other at unequal distance from the origin: the plane y = 0 alone."""
    places = {"bow": (2.0, 0.0), "stern": (-1.0, 0.0)}
    heading, force = images(cylinders(np.arange(0.0, 61.0, 20.0), places))
    np.testing.assert_allclose(heading, np.arange(-60, 61, 20), atol=1e-9)
    exact = cylinders(heading, places).excitation
    np.testing.assert_allclose(force, exact, atol=1e-6 * abs(exact).max())


@pytest.mark.parametrize(
    ("degrees", "places"),
    [
        ([0.0, 30.0, 60.0, 90.0], {"one": (0.0, 0.0), "other": (1.4, 0.5)}),  # no symmetry
        ([10.0, 30.0, 50.0], TWINS),  # no heading in a plane shows it
        ([0.0, 180.0], TWINS),  # steps too wide to go on
        (np.arange(0, 361, 60), TWINS),  # all round
    ],
)
def test_nothing_is_added(degrees: list[float], places: dict[str, tuple[float, float]]) -> None:
    heading, force = images(cylinders(degrees, places))
    np.testing.assert_allclose(heading, degrees, atol=1e-9)
    np.testing.assert_allclose(force, cylinders(degrees, places).excitation)


CASE = """
hydro = { database = "hydro.h5", axes = "yaw", radiation = "none" }
wave = [{ name = "swell", type = "regular", height = 0.1, period = 3.0, heading_deg = -20.0 }]
solver = { end_time = 0.4 }
[[body]]
name = "buoy"
hydro = "port"
motion = ["surge", "sway"]
mass = 500.0
center_of_gravity = [0.0, 1.5, -0.3]
[[body]]
name = "fixed"
hydro = "starboard"
motion = "fixed"
mass = 500.0
center_of_gravity = [0.0, -1.5, -0.3]
"""


def test_frequency_domain_and_runs_use_them_with_yaw_axes_only(tmp_path: Path) -> None:
    cylinders(np.arange(0.0, 91.0, 30.0), TWINS).write(tmp_path / "hydro.h5")
    (tmp_path / "case.toml").write_text(CASE)
    results = hydrodae.run(tmp_path / "case.toml")
    assert any("plane y = 0 and the plane x = 0" in note for note in results.notes)
    heading = np.radians(-20.0)
    force = LinearModel(tmp_path / "case.toml").excitation(np.array([2.0]), heading)[0]
    cylinders([-20.0], TWINS).write(tmp_path / "hydro.h5")
    exact = LinearModel(tmp_path / "case.toml").excitation(np.array([2.0]), heading)[0]
    np.testing.assert_allclose(force, exact, atol=1e-2 * abs(exact).max())  # 30 degrees apart
    cylinders(np.arange(0.0, 91.0, 30.0), TWINS).write(tmp_path / "hydro.h5")
    mean = hydrodae.Case.read(tmp_path / "case.toml").with_values({"hydro.axes": "mean"})
    with refused("range", "headings"):
        LinearModel(mean).excitation(np.array([2.0]), heading)
    with wrong("wave.swell.heading_deg"):
        hydrodae.run(mean)
